// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/write_file.h"
#include "base/text.h"
#include <taut/base/exceptions.h>
#include <taut/base/growing_file.h>

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

namespace taut
{
  namespace
  {
    namespace fs = std::filesystem;

    /// Brings the new name in the folder to the disk, too.
    bool sync_folder(const fs::path &folder)
    {
      const int directory = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
      if (directory < 0)
        return false;
      const bool is_synced = fsync(directory) == 0;
      ::close(directory);
      return is_synced;
    }

    void write_new(const std::string &path, const std::string &bytes, const bool syncs)
    {
      GrowingFile file;
      file.create(path);
      file.append(bytes);
      if (syncs)
        file.sync();
      file.close();
    }

    void rename(const std::string &from, const fs::path &path, const bool syncs)
    {
      const fs::path folder = path.parent_path();
      if (std::rename(from.c_str(), path.c_str()) != 0 ||
          (syncs && !sync_folder(folder.empty() ? "." : folder)))
        throw NotWritten("cannot write '" + path.string() + "': " + std::strerror(errno) +
                         "; check that its folder is writable and the disk not full");
    }

    /// Writes the file beside its place, and renames it.
    void put_in_place(const fs::path &path, const std::string &bytes, const bool syncs)
    {
      const std::string next = unfinished_name(path.string());
      try
      {
        write_new(next, bytes, syncs);
        rename(next, path, syncs);
      }
      catch (...)
      {
        std::remove(next.c_str());
        throw;
      }
    }
  } // namespace

  void write_file(const std::string &path, const std::string &bytes)
  {
    std::error_code error;
    if (fs::exists(path, error) && !fs::is_regular_file(path, error))
      write_new(path, bytes, false);
    else
      put_in_place(fs::is_symlink(path, error) ? fs::weakly_canonical(path) : fs::path(path), bytes,
                   false);
  }

  void replace_file(const std::string &path, const std::string &bytes)
  {
    put_in_place(path, bytes, true);
  }

  std::string unfinished_name(const std::string &path)
  {
    char host[256] = "";
    gethostname(host, sizeof(host) - 1);
    static std::atomic<unsigned long> n_calls{0};
    return to_text(path, ".", host, ".", getpid(), ".", ++n_calls, ".tmp");
  }

  void finish_file(const std::string &unfinished, const std::string &path)
  {
    rename(unfinished, path, true);
  }
} // namespace taut
