// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/study/study.h>

#include <algorithm>
#include <limits>

namespace taut
{
  double StudySetting::least_seconds() const
  {
    return *std::min_element(seconds.begin(), seconds.end());
  }

  double StudySetting::median_seconds() const
  {
    std::vector<double> sorted = seconds;
    std::sort(sorted.begin(), sorted.end());
    const std::size_t n = sorted.size();
    return .5 * (sorted[(n - 1) / 2] + sorted[n / 2]);
  }

  void find_bounds(const std::vector<ParameterList> &parameter_lists,
                   std::vector<StudySetting> &settings)
  {
    const auto is_finer = [&](const StudySetting &finer, const StudySetting &setting)
    {
      for (std::size_t k = 0; k < parameter_lists.size(); ++k)
        if (parameter_lists[k].refined ? std::stod(finer.values[k]) > std::stod(setting.values[k])
                                       : finer.values[k] != setting.values[k])
          return false;
      return finer.message.empty();
    };
    for (StudySetting &setting : settings)
    {
      setting.bounds = setting.errors;
      if (!setting.message.empty())
        continue;
      for (const StudySetting &other : settings)
        if (is_finer(other, setting))
          for (std::size_t i = 0; i < setting.bounds.size(); ++i)
            setting.bounds[i] = std::max(setting.bounds[i], other.errors[i]);
      setting.bound = *std::max_element(setting.bounds.begin(), setting.bounds.end());
    }
  }

  void find_front(std::vector<StudySetting> &settings)
  {
    std::vector<StudySetting *> sorted;
    for (StudySetting &setting : settings)
      if (setting.message.empty())
        sorted.push_back(&setting);
    std::sort(sorted.begin(), sorted.end(),
              [](const StudySetting *a, const StudySetting *b)
              {
                const double x = a->least_seconds(), y = b->least_seconds();
                return x != y ? x < y : a->bound < b->bound;
              });
    double least = std::numeric_limits<double>::infinity();
    for (StudySetting *setting : sorted)
    {
      setting->is_on_front = setting->bound < least;
      least = std::min(least, setting->bound);
    }
  }

  const StudySetting *cheapest(const std::vector<StudySetting> &settings, const double accuracy)
  {
    const StudySetting *best = nullptr;
    for (const StudySetting &setting : settings)
      if (setting.message.empty() && setting.bound + setting.reference_error <= accuracy &&
          (!best || setting.least_seconds() < best->least_seconds()))
        best = &setting;
    return best;
  }

  const StudySetting *cheapest(const StudyResult &result, const std::size_t quantity,
                               const double accuracy)
  {
    const QuantityReference &reference = result.references[quantity];
    const StudySetting *best = nullptr;
    for (const StudySetting &setting : result.settings)
      if (setting.message.empty() &&
          setting.bounds[quantity] + reference.error / reference.scale <= accuracy &&
          (!best || setting.least_seconds() < best->least_seconds()))
        best = &setting;
    return best;
  }
} // namespace taut
