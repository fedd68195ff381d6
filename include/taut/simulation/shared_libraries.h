// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_shared_libraries_h
#define taut_shared_libraries_h

#include <string>
#include <vector>

namespace taut
{
  /**
   * Loads libraries into the process, each once; what they register with Register is known from
   * then on. A relative path with a '/' counts from the working folder, a name without one is
   * sought like any library of the system. Throws EntryError about @p entry if one cannot be
   * loaded.
   */
  void load_shared_libraries(const std::vector<std::string> &names, const std::string &entry);
} // namespace taut

#endif
