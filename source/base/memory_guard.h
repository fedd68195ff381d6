// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_memory_guard_h
#define taut_memory_guard_h

namespace taut
{
  /**
   * Put an object of this class around calls of a library that go on with a null pointer after a
   * stream swallowed std::bad_alloc. While the object lives, and after watch_memory(), an
   * allocation that fails ends the program by std::terminate.
   */
  class MemoryGuard
  {
  public:
    MemoryGuard();
    ~MemoryGuard();
    MemoryGuard(const MemoryGuard &) = delete;
    MemoryGuard &operator=(const MemoryGuard &) = delete;
  };
} // namespace taut

#endif
