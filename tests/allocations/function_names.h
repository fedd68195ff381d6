// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_allocations_function_names_h
#define taut_allocations_function_names_h

#include <map>
#include <string>
#include <vector>

namespace allocations
{
  /// Short names of the functions of Taut to which these addresses belong, each that to which a
  /// call returns. Addresses in other code have no name. Needs addr2line, and libraries that are
  /// not stripped.
  std::map<void *, std::string> function_names(const std::vector<void *> &addresses);
} // namespace allocations

#endif
