// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/base/growing_file.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace taut
{
  GrowingFile::GrowingFile(GrowingFile &&other) noexcept
      : path(std::move(other.path)), descriptor(std::exchange(other.descriptor, -1)),
        n_bytes(other.n_bytes)
  {
  }

  GrowingFile::~GrowingFile()
  {
    if (is_open())
      ::close(descriptor);
  }

  void GrowingFile::create(const std::string &name)
  {
    open(name, O_CREAT | O_TRUNC);
    n_bytes = 0;
  }

  void GrowingFile::resume(const std::string &name, const std::size_t length)
  {
    struct stat status = {};
    if (::stat(name.c_str(), &status) != 0 || static_cast<std::size_t>(status.st_size) < length)
      throw UserError("'" + name +
                      "' is shorter than when the checkpoint was written, or gone: a "
                      "run resumes in the folder with its results as they were");
    open(name, 0);
    if (::ftruncate(descriptor, static_cast<off_t>(length)) != 0 ||
        ::lseek(descriptor, 0, SEEK_END) < 0)
      fail(errno);
    n_bytes = length;
  }

  void GrowingFile::go_on(const std::string &name, const std::size_t length)
  {
    open(name, 0);
    struct stat status = {};
    if (::fstat(descriptor, &status) != 0 || ::lseek(descriptor, 0, SEEK_END) < 0)
      fail(errno);
    if (static_cast<std::size_t>(status.st_size) != length)
      throw NotWritten("cannot write '" + name +
                       "': it is not as another rank left it; put the results on a disk that all "
                       "ranks share");
    n_bytes = length;
  }

  void GrowingFile::append(const std::string &bytes)
  {
    if (write(bytes))
    {
      n_bytes += bytes.size();
      return;
    }
    // A device has no length; its own error is reported.
    const int error = errno;
    if (::ftruncate(descriptor, static_cast<off_t>(n_bytes)) == 0)
      ::lseek(descriptor, static_cast<off_t>(n_bytes), SEEK_SET);
    fail(error);
  }

  void GrowingFile::insert(const std::string &bytes, const std::string &tail)
  {
    const off_t length = static_cast<off_t>(n_bytes),
                end = length - static_cast<off_t>(tail.size());
    if (::lseek(descriptor, end, SEEK_SET) == end && write(bytes + tail))
    {
      n_bytes += bytes.size();
      return;
    }
    // The tail has its old place, for which there is room.
    const int error = errno;
    if (::lseek(descriptor, end, SEEK_SET) == end && write(tail) &&
        ::ftruncate(descriptor, length) == 0)
      ::lseek(descriptor, length, SEEK_SET);
    fail(error);
  }

  void GrowingFile::sync()
  {
    if (::fsync(descriptor) != 0)
      fail(errno);
  }

  void GrowingFile::close()
  {
    if (!is_open())
      return;
    if (::close(std::exchange(descriptor, -1)) != 0)
      fail(errno);
  }

  void GrowingFile::open(const std::string &name, const int flags)
  {
    close();
    path = name;
    descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC | flags, 0666);
    if (!is_open())
      fail(errno);
  }

  /// Writes at the current position. Returns true if all bytes were written; otherwise errno has
  /// the reason.
  bool GrowingFile::write(const std::string &bytes)
  {
    for (std::size_t done = 0; done < bytes.size();)
    {
      const ssize_t n = ::write(descriptor, bytes.data() + done, bytes.size() - done);
      if (n == 0)
        errno = ENOSPC;
      if (n == 0 || (n < 0 && errno != EINTR))
        return false;
      if (n > 0)
        done += static_cast<std::size_t>(n);
    }
    return true;
  }

  void GrowingFile::fail(const int error) const
  {
    throw NotWritten("cannot write '" + path + "': " + std::strerror(error) +
                     "; check that its folder is writable and the disk not full");
  }
} // namespace taut
