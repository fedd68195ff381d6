// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_entry_check_h
#define taut_entry_check_h

#include <taut/simulation/parameter_file.h>

namespace dealii
{
  class ParameterHandler;
}

namespace taut
{
  /// Throws UserError about the first section or entry of @p file that is not declared in @p prm,
  /// or whose value its pattern does not allow: place, what is expected and what is near.
  void check_entries(const ParameterFile &file, dealii::ParameterHandler &prm);
} // namespace taut

#endif
