// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/base/write_file.h>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace taut
{
  namespace
  {
    /// True if all of it is on the disk.
    bool write_through(const std::string &path, const std::string &bytes)
    {
      const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
      if (file < 0)
        return false;
      std::size_t done = 0;
      while (done < bytes.size())
      {
        const ssize_t n = ::write(file, bytes.data() + done, bytes.size() - done);
        if (n < 0 && errno == EINTR)
          continue;
        if (n <= 0)
          break;
        done += n;
      }
      const bool is_written = done == bytes.size() && fsync(file) == 0;
      return ::close(file) == 0 && is_written;
    }

    /// The new name in a folder, too.
    bool sync_folder(const std::filesystem::path &folder)
    {
      const int directory = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
      if (directory < 0)
        return false;
      const bool is_synced = fsync(directory) == 0;
      ::close(directory);
      return is_synced;
    }
  } // namespace

  void replace_file(const std::string &path, const std::string &bytes)
  {
    const std::string next = path + ".tmp";
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    if (write_through(next, bytes) && std::rename(next.c_str(), path.c_str()) == 0 &&
        sync_folder(folder.empty() ? "." : folder))
      return;
    const std::string reason = std::strerror(errno);
    std::remove(next.c_str());
    throw UserError("cannot write '" + path + "': " + reason +
                    "; check that its folder is writable and the disk not full");
  }

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
