// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_results_folder_h
#define taut_results_folder_h

#include <taut/simulation/parameters.h>

#include <string>

namespace taut
{
  /// Throws an EntryError on Output/Folder if it is a file or has results of another run that must
  /// not be replaced or resumed.
  void check_folder(const Parameters &parameters);

  /// Makes the folder, removes results of an earlier run, and writes used.prm with @p comments,
  /// lines without '#', before the entries, beside copies of the files that the run read. Throws an
  /// EntryError.
  void prepare_folder(const Parameters &parameters, const std::vector<std::string> &comments);
} // namespace taut

#endif
