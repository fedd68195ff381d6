// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_json_values_h
#define taut_json_values_h

#include <taut/output/observer.h>
#include <taut/output/statistics.h>

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace taut
{
  /// Of statistics.json: grows with each change of a key or its meaning.
  constexpr int statistics_schema = 2;

  /// A value with its unit.
  nlohmann::ordered_json json_quantity(double value, const std::string &unit);

  /// A time as in tables [s].
  nlohmann::ordered_json json_time(double value);

  /// Adds the results of observers by item and quantity, and the warnings.
  void add_observers(const std::vector<NamedQuantity> &all, nlohmann::ordered_json &root);
  void add_warnings(const std::vector<Warning> &all, nlohmann::ordered_json &root);
} // namespace taut

#endif
