// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_folder_lock_h
#define taut_folder_lock_h

#include <string>

namespace taut
{
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
