// SPDX-License-Identifier: LGPL-2.1-or-later
// The allocation functions of glibc, with what is allocated at most: preload it, and a program ends
// with a line `heap: <bytes at most>` for each process.
#include <malloc.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdio>

extern "C"
{
  // The allocator of glibc under the names that nobody replaces.
  void *__libc_malloc(std::size_t);
  void *__libc_calloc(std::size_t, std::size_t);
  void *__libc_realloc(void *, std::size_t);
  void *__libc_memalign(std::size_t, std::size_t);
  void __libc_free(void *);
}

namespace
{
  std::atomic<long> now(0), most(0);

  void *add(void *memory)
  {
    if (!memory)
      return memory;
    const long bytes = static_cast<long>(malloc_usable_size(memory)), sum = now += bytes;
    for (long before = most; sum > before && !most.compare_exchange_weak(before, sum);)
      ;
    return memory;
  }

  void take(void *memory)
  {
    if (memory)
      now -= static_cast<long>(malloc_usable_size(memory));
  }

  struct AtEnd
  {
    ~AtEnd() { std::fprintf(stderr, "heap: %ld\n", most.load()); }
  } at_end;
} // namespace

extern "C"
{
  void *malloc(const std::size_t size)
  {
    return add(__libc_malloc(size));
  }
  void *calloc(const std::size_t n, const std::size_t size)
  {
    return add(__libc_calloc(n, size));
  }
  void *realloc(void *memory, const std::size_t size)
  {
    take(memory);
    return add(__libc_realloc(memory, size));
  }
  void *memalign(const std::size_t alignment, const std::size_t size)
  {
    return add(__libc_memalign(alignment, size));
  }
  void *aligned_alloc(const std::size_t alignment, const std::size_t size)
  {
    return memalign(alignment, size);
  }
  int posix_memalign(void **memory, const std::size_t alignment, const std::size_t size)
  {
    *memory = memalign(alignment, size);
    return *memory == nullptr ? ENOMEM : 0;
  }
  void free(void *memory)
  {
    take(memory);
    __libc_free(memory);
  }
}
