// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/simulation/shared_libraries.h>

#include <dlfcn.h>

namespace taut
{
  void load_shared_libraries(const std::vector<std::string> &names, const std::string &entry)
  {
    for (const std::string &name : names)
      // What is registered lives as long as the process, so it is never closed.
      if (dlopen(name.c_str(), RTLD_NOW | RTLD_GLOBAL) == nullptr)
      {
        const char *reason = dlerror();
        throw EntryError(entry, "cannot load '" + name +
                                    "': " + (reason ? reason : "no reason is given") +
                                    ". Give the path of the library, as seen from the folder where "
                                    "the program runs; a name without '/' is sought beside "
                                    "libtaut.so and where the system keeps libraries");
      }
  }
} // namespace taut
