// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_entry_check_h
#define taut_entry_check_h

#include <taut/simulation/parameter_file.h>

#include <nlohmann/json_fwd.hpp>

namespace dealii
{
  class ParameterHandler;
}

namespace taut
{
  /// Sections within each other, and of each entry value, default_value, documentation and
  /// pattern_description.
  nlohmann::json listing_of(const dealii::ParameterHandler &prm);

  /// Throws UserError about the first section or entry of @p file that is not in @p listing, or
  /// whose value does not match its pattern. The message has place, expectation and similar names.
  void check_entries(const ParameterFile &file, const nlohmann::json &listing);
} // namespace taut

#endif
