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

  /// Keeps a results folder for one run until its end. The lock is the system's, of the folder
  /// itself: it leaves no file, and a run that is killed leaves no lock.
  class FolderLock
  {
  public:
    FolderLock() = default;
    FolderLock(const FolderLock &) = delete;
    FolderLock &operator=(const FolderLock &) = delete;
    ~FolderLock() { release(); }

    /// Throws an EntryError on Output/Folder if another run has it. Where the system knows no locks
    /// nothing happens.
    void take(const std::string &folder);
    void release();

  private:
    int file = -1;
  };
} // namespace taut

#endif
