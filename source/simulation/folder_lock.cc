// SPDX-License-Identifier: LGPL-2.1-or-later
#include "simulation/folder_lock.h"

#include <taut/base/exceptions.h>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>

namespace taut
{
  void FolderLock::take(const std::string &folder)
  {
    release();
    file = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (file < 0 || flock(file, LOCK_EX | LOCK_NB) == 0)
      return;
    const bool is_taken = errno == EWOULDBLOCK;
    release();
    if (is_taken)
      throw EntryError("Output/Folder",
                       "another run writes its results to '" + folder +
                           "' at this moment; name another folder, or wait until it has ended");
  }

  void FolderLock::release()
  {
    if (file >= 0)
      close(file);
    file = -1;
  }
} // namespace taut
