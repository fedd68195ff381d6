// SPDX-License-Identifier: LGPL-2.1-or-later
// The allocation functions of glibc with a counter before them, and a table of call stacks.
#include "allocation_hook.h"

#include "function_names.h"

#include <execinfo.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <map>

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
    constexpr int deepest = 24;

    /// Calls with one call stack.
    struct Stack
    {
      long count = 0;
      int depth = 0;
      std::array<void *, deepest> frames = {};
    };

    std::atomic<long> n_allocations(0);
    thread_local bool records = false;
    std::array<Stack, 1 << 14> stacks; ///< a hash table with open addresses: it cannot allocate
    long n_lost = 0;                   ///< calls without room in the table

    void add(const Stack &stack)
    {
      std::uint64_t hash = 0xcbf29ce484222325ull;
      for (int i = 0; i < stack.depth; ++i)
        hash = (hash ^ reinterpret_cast<std::uintptr_t>(stack.frames[i])) * 0x100000001b3ull;
      const std::size_t first = (hash ^ (hash >> 29)) % stacks.size();
      for (std::size_t n = 0; n < stacks.size(); ++n)
      {
        Stack &entry = stacks[(first + n) % stacks.size()];
        if (entry.count > 0 && (entry.depth != stack.depth || entry.frames != stack.frames))
          continue;
        const long before = entry.count;
        entry = stack;
        entry.count = before + 1;
        return;
      }
      ++n_lost;
    }

    void count_one()
    {
      n_allocations.fetch_add(1, std::memory_order_relaxed);
      if (!records)
        return;
      records = false; // of what the recording itself allocates
      Stack stack;
      stack.depth = backtrace(stack.frames.data(), deepest);
      add(stack);
      records = true;
    }
  } // namespace

  long count()
  {
    return n_allocations.load(std::memory_order_relaxed);
  }

  void start_recording()
  {
    void *frame;
    backtrace(&frame, 1); // the first call loads a library
    stacks.fill({});
    n_lost = 0;
    records = true;
  }

  std::vector<Site> stop_recording(const std::size_t n_callers)
  {
    records = false;
    std::vector<void *> addresses;
    for (const Stack &stack : stacks)
      addresses.insert(addresses.end(), stack.frames.begin(), stack.frames.begin() + stack.depth);
    const std::map<void *, std::string> names = function_names(addresses);

    // Stacks that differ only outside of Taut or further up are one site.
    std::map<std::vector<std::string>, long> sites;
    for (const Stack &stack : stacks)
    {
      std::vector<std::string> callers;
      for (int i = 0; i < stack.depth; ++i)
      {
        const auto name = names.find(stack.frames[i]);
        if (name != names.end() && name->second.find("_Function_handler") == std::string::npos &&
            callers.size() < n_callers && (callers.empty() || callers.back() != name->second))
          callers.push_back(name->second);
      }
      if (stack.count > 0)
        sites[callers] += stack.count;
    }
    if (n_lost > 0)
      sites[{"(without room in the table)"}] = n_lost;
    std::vector<Site> sorted;
    for (const auto &[callers, n] : sites)
      sorted.push_back({n, callers});
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const Site &a, const Site &b) { return a.count > b.count; });
    return sorted;
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
