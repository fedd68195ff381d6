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
  /// Throws UserError about the first section or entry of @p file that @p prm does not declare, or
  /// whose value does not match its pattern. The message has place, expectation and similar names.
  void check_entries(const ParameterFile &file, dealii::ParameterHandler &prm);
} // namespace taut

#endif
