// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_results_folder_h
#define taut_results_folder_h

#include <taut/simulation/parameters.h>

#include <string>

namespace taut
{
  /// Throws an EntryError on Output/Folder if it is a file or holds the results of another run that
  /// may neither be replaced nor resumed.
  void check_folder(const Parameters &parameters);

  /// Makes the folder, takes the results of an earlier run out of it, and writes used.prm with
  /// @p comments, lines without '#', before the entries. Throws an EntryError.
  void prepare_folder(const Parameters &parameters, const std::vector<std::string> &comments);
} // namespace taut

#endif
