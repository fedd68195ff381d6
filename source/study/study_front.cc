// SPDX-License-Identifier: LGPL-2.1-or-later
#include "study/study.h"

#include <algorithm>
#include <limits>

namespace taut
{
  namespace
  {
    /// The bound of a coarser setting is never less, so the coarsest is that of the largest bound.
    template <typename Test>
    const StudySetting *least_cost(const std::vector<StudySetting> &settings, const Test &suits)
    {
      const StudySetting *best = nullptr;
      for (const StudySetting &setting : settings)
        if (setting.message.empty() && suits(setting) &&
            (!best || setting.cost() < best->cost() ||
             (setting.cost() == best->cost() && setting.bound > best->bound)))
          best = &setting;
      return best;
    }
  } // namespace

  double StudySetting::least_seconds() const
  {
    return *std::min_element(seconds.begin(), seconds.end());
  }

  double StudySetting::cost() const
  {
    return std::max(least_seconds(), coarser_seconds);
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
              { return a->cost() != b->cost() ? a->cost() < b->cost() : a->bound < b->bound; });
    double least = std::numeric_limits<double>::infinity();
    for (StudySetting *setting : sorted)
    {
      setting->is_on_front = setting->bound < least;
      least = std::min(least, setting->bound);
    }
  }

  const StudySetting *cheapest(const std::vector<StudySetting> &settings, const double accuracy)
  {
    return least_cost(settings, [&](const StudySetting &setting)
                      { return setting.bound + setting.reference_error <= accuracy; });
  }

  const StudySetting *cheapest(const StudyResult &result, const std::size_t quantity,
                               const double accuracy)
  {
    const QuantityReference &reference = result.references[quantity];
    return least_cost(
        result.settings, [&](const StudySetting &setting)
        { return setting.bounds[quantity] + reference.error / reference.scale <= accuracy; });
  }
} // namespace taut
