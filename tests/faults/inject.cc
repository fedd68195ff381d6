// SPDX-License-Identifier: LGPL-2.1-or-later
// A library for LD_PRELOAD that runs a program again and again, each time with one fault: it takes
// the place of main(), and for each line "<fault> <n> <folder>" of the standard input forks a
// process that runs the program in that folder until its n-th allocation or its n-th operation on a
// file of that folder fails. Counting begins with the program's own main(), after all libraries
// have been initialised. Outputs go to <folder>.out and <folder>.err, the operations on files to
// <folder>.log; the answer to a line is "<status of waitpid> <calls that were counted> <calls that
// failed>".
//
// Faults, of files: EIO and ENOSPC (that call alone fails), short (half of the bytes are written,
// the call after it has ENOSPC), full (the disk is full from then on: files shrink and change, but
// do not grow). Of memory: new (that operator new alone), all_new (it and all later ones), malloc
// (that call of malloc, calloc, realloc, posix_memalign or aligned_alloc alone). Counted only:
// files, memory, c_memory. No faults, but another rounding: up, down, to_zero, to_nearest.
//
// A program that mpirun starts is run as it is. The variable TAUT_FAULT, "<fault> <n> <rank>",
// gives one rank its fault: one of memory, or an exception in its n-th collective call of MPI,
// throw for one that the program knows nothing of and throw_user for a taut::UserError. That rank
// appends the number of its calls in a run without a fault to the file TAUT_FAULT_COUNT.
#include <taut/base/exceptions.h>

#include <dlfcn.h>
#include <fcntl.h>
#include <mpi.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cfenv>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <stdexcept>
#include <string>

extern "C"
{
  // The allocator of glibc under the names that nobody replaces.
  void *__libc_malloc(std::size_t);
  void *__libc_calloc(std::size_t, std::size_t);
  void *__libc_realloc(void *, std::size_t);
  void *__libc_memalign(std::size_t, std::size_t);
}

namespace
{
  constexpr unsigned int patience = 120; ///< of a run; it ends by SIGALRM [s]

  enum class Counted
  {
    nothing,
    files,
    memory,
    c_memory,
    collectives
  };
  struct Fault
  {
    const char *name;
    Counted counted;
    int error; ///< errno of that call; 0: none
    bool cuts, stays;
    int rounding = FE_TONEAREST;
  };
  constexpr Fault faults[] = {{"files", Counted::files, 0, false, false},
                              {"EIO", Counted::files, EIO, false, false},
                              {"ENOSPC", Counted::files, ENOSPC, false, false},
                              {"short", Counted::files, ENOSPC, true, false},
                              {"full", Counted::files, ENOSPC, false, true},
                              {"memory", Counted::memory, 0, false, false},
                              {"new", Counted::memory, ENOMEM, false, false},
                              {"all_new", Counted::memory, ENOMEM, false, true},
                              {"c_memory", Counted::c_memory, 0, false, false},
                              {"malloc", Counted::c_memory, ENOMEM, false, false},
                              {"collectives", Counted::collectives, 0, false, false},
                              {"throw", Counted::collectives, EIO, false, false},
                              {"throw_user", Counted::collectives, EINVAL, false, false},
                              {"to_nearest", Counted::nothing, 0, false, false},
                              {"up", Counted::nothing, 0, false, false, FE_UPWARD},
                              {"down", Counted::nothing, 0, false, false, FE_DOWNWARD},
                              {"to_zero", Counted::nothing, 0, false, false, FE_TOWARDZERO}};

  Fault fault = {"", Counted::nothing, 0, false, false};
  long at = 0; ///< number of the call that fails
  /// In memory that the parent sees: calls of the counted kind, and those that failed.
  struct Numbers
  {
    long counted, failed;
  };
  Numbers own_numbers = {0, 0}, *numbers = &own_numbers;
  int log_file = -1;
  bool fails_next = false; ///< after half of a write
  char folder[4096];       ///< its own files are counted, with a '/' at its end

  bool is_due(const Counted what)
  {
    if (fault.counted != what)
      return false;
    const long n = ++numbers->counted;
    return fault.error != 0 && (n == at || (fault.stays && n >= at));
  }

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

  template <typename Function>
  Function *next(const char *name)
  {
    return reinterpret_cast<Function *>(dlsym(RTLD_NEXT, name));
  }

  bool c_memory_fails()
  {
    if (!is_due(Counted::c_memory))
      return false;
    ++numbers->failed;
    errno = ENOMEM;
    return true;
  }

  void *allocate(const std::size_t size, const std::size_t alignment)
  {
    void *memory = nullptr;
    while (is_due(Counted::memory) ||
           (memory = alignment == 0 ? __libc_malloc(size == 0 ? 1 : size)
                                    : __libc_memalign(alignment, size)) == nullptr)
    {
      ++numbers->failed;
      const std::new_handler handler = std::get_new_handler();
      if (handler == nullptr)
        throw std::bad_alloc();
      handler();
    }
    return memory;
  }

  using Main = int(int, char **, char **);
  Main *program = nullptr;

  [[noreturn]] void run(const Fault &wanted, const long n, const std::string &where, int argc,
                        char **argv, char **environment)
  {
    constexpr int how = O_WRONLY | O_CREAT | O_TRUNC;
    dup2(syscall(SYS_openat, AT_FDCWD, "/dev/null", O_RDONLY), STDIN_FILENO);
    dup2(syscall(SYS_openat, AT_FDCWD, (where + ".out").c_str(), how, 0666), STDOUT_FILENO);
    dup2(syscall(SYS_openat, AT_FDCWD, (where + ".err").c_str(), how, 0666), STDERR_FILENO);
    log_file = syscall(SYS_openat, AT_FDCWD, (where + ".log").c_str(), how, 0666);
    if (chdir(where.c_str()) != 0 || getcwd(folder, sizeof folder - 1) == nullptr)
      _exit(99);
    std::strcat(folder, "/");
    alarm(patience);
    std::fesetround(wanted.rounding);
    at = n;
    fault = wanted;
    std::exit(program(argc, argv, environment));
  }

  /// The program as one of many ranks, with the fault of this one.
  int run_rank(int argc, char **argv, char **environment)
  {
    char name[32];
    int rank = 0;
    const char *const text = std::getenv("TAUT_FAULT");
    if (text != nullptr && std::sscanf(text, "%31s %ld %d", name, &at, &rank) == 3 &&
        rank == std::atoi(std::getenv("OMPI_COMM_WORLD_RANK")))
      for (const Fault &known : faults)
        if (std::strcmp(known.name, name) == 0)
          fault = known;
    alarm(patience);
    return program(argc, argv, environment);
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

  int serve(int argc, char **argv, char **environment)
  {
    numbers = static_cast<Numbers *>(
        mmap(nullptr, sizeof(Numbers), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
    char text[4096];
    // No standard streams: their buffers would be the children's too.
    const auto read_line = [&]
    {
      std::size_t length = 0;
      while (length + 1 < sizeof text && read(STDIN_FILENO, text + length, 1) == 1 &&
             text[length] != '\n')
        ++length;
      text[length] = '\0';
      return length > 0;
    };
    while (read_line())
    {
      char name[32], where[4000];
      long n = 0;
      if (std::sscanf(text, "%31s %ld %3999[^\n]", name, &n, where) != 3)
        return 99;
      *numbers = {0, 0};
      const pid_t child = fork();
      if (child == 0)
      {
        for (const Fault &known : faults)
          if (std::strcmp(known.name, name) == 0)
            run(known, n, where, argc, argv, environment);
        _exit(99);
      }
      int status = -1;
      waitpid(child, &status, 0);
      const int length = std::snprintf(text, sizeof text, "%d %ld %ld\n", status, numbers->counted,
                                       numbers->failed);
      syscall(SYS_write, STDOUT_FILENO, text, length);
    }
    _exit(0);
  }
} // namespace

void *operator new(const std::size_t size)
{
  return allocate(size, 0);
}

void *operator new(const std::size_t size, const std::align_val_t alignment)
{
  return allocate(size, static_cast<std::size_t>(alignment));
}

void operator delete(void *memory) noexcept
{
  std::free(memory);
}

void operator delete(void *memory, std::size_t) noexcept
{
  std::free(memory);
}

void operator delete(void *memory, std::align_val_t) noexcept
{
  std::free(memory);
}

void operator delete(void *memory, std::size_t, std::align_val_t) noexcept
{
  std::free(memory);
}

extern "C"
{
  int __libc_start_main(Main *main, int argc, char **argv, void (*begin)(), void (*end)(),
                        void (*unload)(), void *stack)
  {
    using Start = int(Main *, int, char **, void (*)(), void (*)(), void (*)(), void *);
    program = main;
    return next<Start>("__libc_start_main")(std::getenv("TAUT_FAULTS") != nullptr ? serve
                                            : std::getenv("OMPI_COMM_WORLD_RANK") != nullptr
                                                ? run_rank
                                                : main,
                                            argc, argv, begin, end, unload, stack);
  }

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

  int MPI_Finalize()
  {
    meet(true);
    return PMPI_Finalize();
  }

  void *malloc(const std::size_t size)
  {
    return c_memory_fails() ? nullptr : __libc_malloc(size);
  }

  void *calloc(const std::size_t n, const std::size_t size)
  {
    return c_memory_fails() ? nullptr : __libc_calloc(n, size);
  }

  void *realloc(void *memory, const std::size_t size)
  {
    return c_memory_fails() ? nullptr : __libc_realloc(memory, size);
  }

  int posix_memalign(void **memory, const std::size_t alignment, const std::size_t size)
  {
    *memory = c_memory_fails() ? nullptr : __libc_memalign(alignment, size);
    return *memory == nullptr ? ENOMEM : 0;
  }

  void *aligned_alloc(const std::size_t alignment, const std::size_t size)
  {
    return c_memory_fails() ? nullptr : __libc_memalign(alignment, size);
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

  int open64(const char *path, int flags, ...)
  {
    va_list rest;
    va_start(rest, flags);
    const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(rest, mode_t) : 0;
    va_end(rest);
    return open(path, flags, mode);
  }

  FILE *fopen(const char *path, const char *mode)
  {
    return open_fails(path, std::strpbrk(mode, "wa+") != nullptr,
                      std::strpbrk(mode, "wa") != nullptr)
               ? nullptr
               : next<FILE *(const char *, const char *)>("fopen")(path, mode);
  }

  FILE *fopen64(const char *path, const char *mode)
  {
    return fopen(path, mode);
  }

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

  ssize_t pwrite64(const int file, const void *bytes, const std::size_t size, const off_t position)
  {
    return pwrite(file, bytes, size, position);
  }

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

  int ftruncate64(const int file, const off_t length)
  {
    return ftruncate(file, length);
  }

  int truncate(const char *path, const off_t length)
  {
    return is_in_folder(path) && file_fails("truncate", path, false)
               ? -1
               : syscall(SYS_truncate, path, length);
  }

  int truncate64(const char *path, const off_t length)
  {
    return truncate(path, length);
  }

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
