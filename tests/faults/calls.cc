// SPDX-License-Identifier: LGPL-2.1-or-later
// The calls that may fail, in the place of those of libc, libstdc++ and MPI.
#include "fault.h"

#include <taut/base/exceptions.h>

#include <fcntl.h>
#include <mpi.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>

namespace
{
  using namespace faults;

  bool fails_next = false; ///< after half of a write

  bool is_in_folder(const char *path)
  {
    return path[0] != '/' || std::strncmp(path, folder, std::strlen(folder)) == 0;
  }

  /// Path of an open file of the folder; false if it is none.
  bool path_of(const int file, char (&path)[4096])
  {
    char link[64];
    std::snprintf(link, sizeof link, "/proc/self/fd/%d", file);
    const ssize_t n = readlink(link, path, sizeof path - 1);
    if (n <= 0)
      return false;
    path[n] = '\0';
    return path[0] == '/' && is_in_folder(path);
  }

  /**
   * True if this operation on a file of the folder is to fail, with errno set. @p grows says
   * whether a full disk has no room for it.
   */
  bool file_fails(const char *operation, const char *path, const bool grows)
  {
    if (fault.counted != Counted::files)
      return false;
    char line[4200];
    const int n = std::snprintf(line, sizeof line, "%s %s\n", operation, path);
    syscall(SYS_write, log_file, line, n);
    const bool due = is_due(Counted::files) || fails_next;
    if (!due || (fault.stays && !grows))
      return false;
    if (fault.cuts && !fails_next && std::strcmp(operation, "write") != 0)
      return false; // only writes are cut
    fails_next = false;
    ++numbers->failed;
    errno = fault.error;
    return true;
  }

  bool open_fails(const char *path, const bool writes, const bool creates)
  {
    struct stat status;
    return fault.counted == Counted::files && writes && is_in_folder(path) &&
           file_fails("open", path, creates && stat(path, &status) != 0);
  }

  bool file_fails(const char *operation, const int file, const bool grows)
  {
    char path[4096];
    return fault.counted == Counted::files && path_of(file, path) &&
           file_fails(operation, path, grows);
  }

  /// A write of @p size bytes at @p position, of which @p write writes as many as it is told.
  template <typename Write>
  ssize_t faulty_write(const char *operation, const int file, const off_t position,
                       const std::size_t size, const Write &write)
  {
    struct stat status = {};
    const bool grows =
        fault.stays && fstat(file, &status) == 0 && position + off_t(size) > status.st_size;
    if (!file_fails(operation, file, grows))
      return write(size);
    // A call that follows half a write fails; the other faults write nothing.
    if (!fault.cuts || size < 2 || numbers->counted != at)
      return -1;
    fails_next = true;
    return write(size / 2);
  }

  off_t position_of(const int file)
  {
    struct stat status = {};
    return (fcntl(file, F_GETFL) & O_APPEND) != 0 && fstat(file, &status) == 0
               ? status.st_size
               : lseek(file, 0, SEEK_CUR);
  }

  /// Before a collective call; at the last one, MPI_Finalize, the number of them is told.
  void meet(const bool is_last = false)
  {
    if (is_last && fault.error == 0 && fault.counted != Counted::nothing)
    {
      const char *const path = std::getenv("TAUT_FAULT_COUNT");
      char line[64];
      const int n = std::snprintf(line, sizeof line, "%ld\n", numbers->counted);
      const int file = path == nullptr ? -1
                                       : syscall(SYS_openat, AT_FDCWD, path,
                                                 O_WRONLY | O_CREAT | O_APPEND, 0666);
      syscall(SYS_write, file, line, n);
    }
    else if (is_due(Counted::collectives))
    {
      if (fault.error == EINVAL)
        throw taut::UserError("injected into a collective call");
      throw std::runtime_error("injected into a collective call");
    }
  }
} // namespace

extern "C"
{
  int MPI_Allreduce(const void *own, void *all, int n, MPI_Datatype type, MPI_Op operation,
                    MPI_Comm ranks)
  {
    meet();
    return PMPI_Allreduce(own, all, n, type, operation, ranks);
  }

  int MPI_Bcast(void *values, int n, MPI_Datatype type, int root, MPI_Comm ranks)
  {
    meet();
    return PMPI_Bcast(values, n, type, root, ranks);
  }

  int MPI_Allgather(const void *own, int n, MPI_Datatype type, void *all, int n_all,
                    MPI_Datatype type_of_all, MPI_Comm ranks)
  {
    meet();
    return PMPI_Allgather(own, n, type, all, n_all, type_of_all, ranks);
  }

  int MPI_Gatherv(const void *own, int n, MPI_Datatype type, void *all, const int *n_all,
                  const int *first, MPI_Datatype type_of_all, int root, MPI_Comm ranks)
  {
    meet();
    return PMPI_Gatherv(own, n, type, all, n_all, first, type_of_all, root, ranks);
  }

  int MPI_Allgatherv(const void *own, int n, MPI_Datatype type, void *all, const int *n_all,
                     const int *first, MPI_Datatype type_of_all, MPI_Comm ranks)
  {
    meet();
    return PMPI_Allgatherv(own, n, type, all, n_all, first, type_of_all, ranks);
  }

  int MPI_Finalize()
  {
    meet(true);
    return PMPI_Finalize();
  }

  int open(const char *path, int flags, ...)
  {
    va_list rest;
    va_start(rest, flags);
    const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(rest, mode_t) : 0;
    va_end(rest);
    return open_fails(path, (flags & O_ACCMODE) != O_RDONLY, (flags & O_CREAT) != 0)
               ? -1
               : syscall(SYS_openat, AT_FDCWD, path, flags, mode);
  }

  int open64(const char *path, int flags, ...) __attribute__((alias("open")));

  FILE *fopen(const char *path, const char *mode)
  {
    return open_fails(path, std::strpbrk(mode, "wa+") != nullptr,
                      std::strpbrk(mode, "wa") != nullptr)
               ? nullptr
               : next<FILE *(const char *, const char *)>("fopen")(path, mode);
  }

  FILE *fopen64(const char *path, const char *mode) __attribute__((alias("fopen")));

  ssize_t write(const int file, const void *bytes, const std::size_t size)
  {
    return faulty_write("write", file, position_of(file), size,
                        [&](const std::size_t n) { return syscall(SYS_write, file, bytes, n); });
  }

  ssize_t writev(const int file, const iovec *pieces, const int n_pieces)
  {
    std::size_t size = 0;
    for (int i = 0; i < n_pieces; ++i)
      size += pieces[i].iov_len;
    return faulty_write("write", file, position_of(file), size,
                        [&](const std::size_t n) -> ssize_t
                        {
                          if (n == size)
                            return syscall(SYS_writev, file, pieces, n_pieces);
                          std::string bytes;
                          for (int i = 0; i < n_pieces; ++i)
                            bytes.append(static_cast<const char *>(pieces[i].iov_base),
                                         pieces[i].iov_len);
                          return syscall(SYS_write, file, bytes.data(), n);
                        });
  }

  ssize_t pwrite(const int file, const void *bytes, const std::size_t size, const off_t position)
  {
    return faulty_write("write", file, position, size,
                        [&](const std::size_t n)
                        { return syscall(SYS_pwrite64, file, bytes, n, position); });
  }

  ssize_t pwrite64(int file, const void *bytes, std::size_t size, off_t position)
      __attribute__((alias("pwrite")));

  int fsync(const int file)
  {
    return file_fails("fsync", file, false) ? -1 : syscall(SYS_fsync, file);
  }

  int close(const int file)
  {
    struct stat status;
    const bool writes = fault.counted == Counted::files &&
                        (fcntl(file, F_GETFL) & O_ACCMODE) != O_RDONLY &&
                        fstat(file, &status) == 0 && S_ISREG(status.st_mode);
    const bool fails = writes && file_fails("close", file, false);
    const int error = errno, result = syscall(SYS_close, file);
    return fails ? (errno = error, -1) : result;
  }

  int ftruncate(const int file, const off_t length)
  {
    return file_fails("truncate", file, false) ? -1 : syscall(SYS_ftruncate, file, length);
  }

  int ftruncate64(int file, off_t length) __attribute__((alias("ftruncate")));

  int truncate(const char *path, const off_t length)
  {
    return is_in_folder(path) && file_fails("truncate", path, false)
               ? -1
               : syscall(SYS_truncate, path, length);
  }

  int truncate64(const char *path, off_t length) __attribute__((alias("truncate")));

  int rename(const char *from, const char *to)
  {
    return is_in_folder(to) && file_fails("rename", to, false)
               ? -1
               : syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0);
  }

  int mkdir(const char *path, const mode_t mode)
  {
    return is_in_folder(path) && file_fails("mkdir", path, true)
               ? -1
               : syscall(SYS_mkdirat, AT_FDCWD, path, mode);
  }
}
