// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_instruction_set_h
#define taut_instruction_set_h

#include <string>

// A build for any x86-64 processor also has its hot loops for newer processors. With TAUT_NATIVE,
// and on other kinds of processors, the loops are compiled once, with the flags of the compiler.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__AVX2__)
#define TAUT_SEVERAL_INSTRUCTION_SETS
#endif

namespace taut
{
  /// The instructions of the hot loops: those of the whole program, or with AVX2 and FMA.
  enum class InstructionSet
  {
    baseline,
    avx2
  };

  /**
   * The best instruction set of the processor, or the set that the environment variable
   * TAUT_INSTRUCTION_SET names: baseline or avx2. It is constant during a run. Throws
   * UserError if the variable names no set, or a set that this processor or this build does not
   * have.
   */
  InstructionSet instruction_set();

  /// For the log: "avx2", "baseline (TAUT_INSTRUCTION_SET)".
  std::string instruction_set_in_use();

#ifdef TAUT_SEVERAL_INSTRUCTION_SETS
  /// Functions that the loops call are compiled into this function, and hence for its instructions,
  /// as far as the compiler sees them; no other function changes. @p loops is passed by value, so
  /// that the loops cannot write to their own members.
  template <typename Loops>
  [[gnu::target("avx2,fma"), gnu::flatten]] void run_with_avx2(const Loops loops)
  {
    loops();
  }
#endif

  /// Calls loops(), compiled for the instruction set in use. A call costs some nanoseconds: wrap a
  /// loop over a body, not over a node.
  template <typename Loops>
  inline void vectorised(const Loops &loops)
  {
#ifdef TAUT_SEVERAL_INSTRUCTION_SETS
    if (instruction_set() == InstructionSet::avx2)
      return run_with_avx2(loops);
#endif
    loops();
  }
} // namespace taut

#endif
