// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/memory.h"
#include "base/memory_guard.h"

#include <deal.II/base/exceptions.h>

#include <atomic>
#include <new>
#include <stdexcept>

namespace taut
{
  namespace
  {
    std::atomic<bool> was_short{false};
    std::atomic<unsigned int> n_guards{0};

    /// Called by operator new when it finds no memory.
    void note_shortage()
    {
      was_short = true;
      if (n_guards > 0)
        std::terminate();
      throw std::bad_alloc();
    }
  } // namespace

  void watch_memory()
  {
    std::set_new_handler(note_shortage);
  }

  bool memory_was_short()
  {
    return was_short.exchange(false);
  }

  void check_memory()
  {
    if (memory_was_short())
      throw std::bad_alloc();
  }

  MemoryGuard::MemoryGuard()
  {
    ++n_guards;
  }

  MemoryGuard::~MemoryGuard()
  {
    --n_guards;
  }

  bool is_memory_shortage(const std::exception &e)
  {
    return dynamic_cast<const std::bad_alloc *>(&e) != nullptr ||
           dynamic_cast<const std::length_error *>(&e) != nullptr ||
           dynamic_cast<const dealii::StandardExceptions::ExcOutOfMemory *>(&e) != nullptr;
  }
} // namespace taut
