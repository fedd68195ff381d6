// SPDX-License-Identifier: LGPL-2.1-or-later
// The allocation functions of glibc with a counter before them.
#include "allocation_hook.h"

#include <atomic>
#include <cerrno>
#include <cstddef>

extern "C"
{
  // The allocator of glibc under the names that nobody replaces.
  void *__libc_malloc(std::size_t);
  void *__libc_calloc(std::size_t, std::size_t);
  void *__libc_realloc(void *, std::size_t);
  void *__libc_memalign(std::size_t, std::size_t);
}

namespace allocations
{
  namespace
  {
    std::atomic<long> n_allocations(0);

    void count_one()
    {
      n_allocations.fetch_add(1, std::memory_order_relaxed);
    }
  } // namespace

  long count()
  {
    return n_allocations.load(std::memory_order_relaxed);
  }
} // namespace allocations

extern "C"
{
  void *malloc(const std::size_t size)
  {
    allocations::count_one();
    return __libc_malloc(size);
  }

  void *calloc(const std::size_t n, const std::size_t size)
  {
    allocations::count_one();
    return __libc_calloc(n, size);
  }

  void *realloc(void *memory, const std::size_t size)
  {
    allocations::count_one();
    return __libc_realloc(memory, size);
  }

  void *memalign(const std::size_t alignment, const std::size_t size)
  {
    allocations::count_one();
    return __libc_memalign(alignment, size);
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
}
