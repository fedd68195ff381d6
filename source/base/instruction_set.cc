// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/instruction_set.h"
#include <taut/base/exceptions.h>

#include <cstdlib>
#include <vector>

namespace taut
{
  namespace
  {
    constexpr char variable[] = "TAUT_INSTRUCTION_SET";

    std::string asked_for()
    {
      const char *const value = std::getenv(variable);
      return value == nullptr ? "" : value;
    }

    struct NamedSet
    {
      InstructionSet set;
      const char *name;
      bool is_there; ///< this processor and this build have it
    };

    /// From the plainest to the best.
    std::vector<NamedSet> instruction_sets()
    {
#ifdef TAUT_SEVERAL_INSTRUCTION_SETS
      const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
      const bool avx2 = false;
#endif
      return {{InstructionSet::baseline, "baseline", true}, {InstructionSet::avx2, "avx2", avx2}};
    }

    InstructionSet choose()
    {
      const std::string name = asked_for();
      InstructionSet best = InstructionSet::baseline;
      for (const NamedSet &known : instruction_sets())
      {
        if (known.is_there)
          best = known.set;
        if (name == known.name && !known.is_there)
          throw UserError(std::string(variable) + " = " + name +
                          ": this processor does not have it, or Taut is compiled without it. "
                          "Leave the environment variable out, or give it the value baseline");
        if (name == known.name)
          return known.set;
      }
      if (!name.empty())
        throw UserError("environment variable " + std::string(variable) + " = '" + name +
                        "' names no instruction set: give it the value baseline or avx2, "
                        "or leave it out");
      return best;
    }
  } // namespace

  InstructionSet instruction_set()
  {
    static const InstructionSet chosen = choose();
    return chosen;
  }

  std::string instruction_set_in_use()
  {
    const std::string name = instruction_sets()[static_cast<std::size_t>(instruction_set())].name;
    return asked_for().empty() ? name : name + " (" + variable + ")";
  }
} // namespace taut
