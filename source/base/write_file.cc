// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/base/write_file.h>

#include <fstream>

namespace taut
{
  void write_file(const std::string &path, const std::string &text)
  {
    std::ofstream file(path);
    file << text << '\n';
    file.close();
    if (!file)
      throw UserError("cannot write '" + path +
                      "': check that its folder is writable and the disk not full");
  }
} // namespace taut
