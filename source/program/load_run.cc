// SPDX-License-Identifier: LGPL-2.1-or-later
#include "command_line.h"
#include "libraries.h"

#include <taut/base/exceptions.h>

#include <dlfcn.h>

namespace taut
{
  Run *load_run()
  {
    // deal.II brings two hundred libraries. A symbol is sought in all that were opened together,
    // one after the other, until it is found. Opened one by one, from the bottom, each library is
    // the first in which its own symbols are sought: that halves the time to load them. What cannot
    // be opened here, the last call opens or reports.
    for (const char *library : libraries)
      dlopen(library, RTLD_LAZY | RTLD_LOCAL);
    void *run = nullptr;
    if (void *opened = dlopen("libtaut_run.so", RTLD_LAZY | RTLD_GLOBAL))
      run = dlsym(opened, "taut_run");
    if (run == nullptr)
    {
      const char *reason = dlerror();
      throw UserError(std::string("cannot load what runs scenes: ") +
                      (reason ? reason : "no reason is given"));
    }
    return reinterpret_cast<Run *>(run);
  }
} // namespace taut
