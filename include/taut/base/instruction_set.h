// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_instruction_set_h
#define taut_instruction_set_h

#include <string>

// A build for any x86-64 processor has its hot loops once more for newer ones. TAUT_NATIVE and
// processors of other kinds have them once, as the compiler's flags say.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__AVX2__)
#define TAUT_SEVERAL_INSTRUCTION_SETS
#endif

namespace taut
{
  /// What the hot loops run with: the instructions that the whole program is compiled for, those
  /// and AVX2 with FMA, or these and AVX-512 with its long registers.
  enum class InstructionSet
  {
    baseline,
    avx2,
    avx512
  };

  /**
   * The best set that the processor has, or the one that the environment variable
   * TAUT_INSTRUCTION_SET names: baseline, avx2 or avx512. It is the same throughout a run. Throws a
   * UserError if the variable names no set, or one that this processor or this build does not have.
   */
  InstructionSet instruction_set();

  /// For the log: "avx512", "baseline (TAUT_INSTRUCTION_SET)".
  std::string instruction_set_in_use();

#ifdef TAUT_SEVERAL_INSTRUCTION_SETS
  /// What the loops call is compiled into this function, and hence for its instructions, as far as
  /// the compiler sees it; no other function changes. By value, so that what they write cannot be
  /// what they hold.
  template <typename Loops>
  [[gnu::target("avx2,fma"), gnu::flatten]] void run_with_avx2(const Loops loops)
  {
    loops();
  }

  /// The same for AVX-512, with registers of eight doubles also where the compiler holds four for
  /// enough.
  template <typename Loops>
  [[gnu::target("avx2,fma,avx512f,avx512dq,avx512bw,avx512vl,prefer-vector-width=512"),
    gnu::flatten]] void
  run_with_avx512(const Loops loops)
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
    switch (instruction_set())
    {
    case InstructionSet::avx512:
      run_with_avx512(loops);
      return;
    case InstructionSet::avx2:
      run_with_avx2(loops);
      return;
    case InstructionSet::baseline:
      break;
    }
#endif
    loops();
  }
} // namespace taut

#endif
