// SPDX-License-Identifier: LGPL-2.1-or-later
#include "time/stored_rows.h"

namespace taut
{
  namespace
  {
    constexpr int n_of_springs = 4, n_of_rules = 3;
  }

  /// All vectors as vectors of numbers; empty ones stay empty.
  std::vector<std::vector<double>> StoredRows::numbers() const
  {
    const RowStates &s = of.states;
    std::vector<std::vector<double>> result = {
        s.multiplier, s.complementarity_gap, s.distance, s.rate, of.report.work, of.gaps, of.terms};
    const std::size_t first_spring = result.size(), first_rule = first_spring + n_of_springs;
    result.resize(first_rule + n_of_rules);
    for (const RowStates::Spring &spring : s.springs)
    {
      const double values[n_of_springs] = {spring.u, spring.v, spring.a, spring.du};
      for (int c = 0; c < n_of_springs; ++c)
        result[first_spring + c].push_back(values[c]);
    }
    for (const RowRule &rule : of.report.method.rules)
    {
      const double values[n_of_rules] = {static_cast<double>(rule.condition),
                                         static_cast<double>(rule.force),
                                         static_cast<double>(rule.corrected)};
      for (int c = 0; c < n_of_rules; ++c)
        result[first_rule + c].push_back(values[c]);
    }
    return result;
  }

  void StoredRows::set(const std::vector<std::vector<double>> &numbers) const
  {
    RowStates &s = of.states;
    auto next = numbers.begin();
    for (std::vector<double> *const v : {&s.multiplier, &s.complementarity_gap, &s.distance,
                                         &s.rate, &of.report.work, &of.gaps, &of.terms})
      *v = *next++;
    s.springs.clear();
    for (std::size_t i = 0; i < next[0].size(); ++i)
      s.springs.push_back({next[0][i], next[1][i], next[2][i], next[3][i]});
    next += n_of_springs;
    std::vector<RowRule> &rules = of.report.method.rules;
    rules.clear();
    for (std::size_t i = 0; i < next[0].size(); ++i)
      rules.push_back({static_cast<RowRule::Condition>(static_cast<char>(next[0][i])),
                       static_cast<ForceTime>(static_cast<char>(next[1][i])), next[2][i] != 0.});
  }

  void StoredRows::gather() const
  {
    if (!constraints.shared())
      return;
    std::vector<std::vector<double>> all = numbers();
    for (std::vector<double> &values : all)
      if (constraints.any(!values.empty()))
      {
        const std::vector<double> own = values;
        constraints.gather(own, values);
      }
    set(all);
  }

  void StoredRows::pick() const
  {
    if (!constraints.shared())
      return;
    std::vector<std::vector<double>> own = numbers();
    for (std::vector<double> &values : own)
      if (!values.empty())
        constraints.pick(values);
    set(own);
  }
} // namespace taut
