// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/base/instruction_set.h>

#include <cstdlib>

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

    bool has_avx2()
    {
#ifdef TAUT_SEVERAL_INSTRUCTION_SETS
      return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
      return false;
#endif
    }

    InstructionSet choose()
    {
      const std::string name = asked_for();
      if (name == "baseline")
        return InstructionSet::baseline;
      if (name == "avx2" && !has_avx2())
        throw UserError(std::string(variable) +
                        " = avx2: this processor does not have it, or Taut is compiled without it. "
                        "Leave the environment variable out, or give it the value baseline");
      if (name != "" && name != "avx2")
        throw UserError("environment variable " + std::string(variable) + " = '" + name +
                        "' names no instruction set: give it the value baseline or avx2, or leave "
                        "it out");
      return has_avx2() ? InstructionSet::avx2 : InstructionSet::baseline;
    }
  } // namespace

  InstructionSet instruction_set()
  {
    static const InstructionSet chosen = choose();
    return chosen;
  }

  std::string instruction_set_in_use()
  {
    const std::string name = instruction_set() == InstructionSet::avx2 ? "avx2" : "baseline";
    return asked_for().empty() ? name : name + " (" + variable + ")";
  }
} // namespace taut
