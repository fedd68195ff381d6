// SPDX-License-Identifier: LGPL-2.1-or-later
#include "study/refined_reference.h"
#include <taut/scene/expression.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace taut
{
  namespace
  {
    constexpr double highest_order = 2.;

    QuantityReference extrapolate_number(const std::vector<StudyQuantity> &levels)
    {
      const std::size_t n = levels.size();
      const double last = levels[n - 1].value, change = last - levels[n - 2].value,
                   before = n > 2 ? levels[n - 2].value - levels[n - 3].value : 0.;
      QuantityReference reference;
      reference.quantity.value = last;
      if (n == 2)
        reference.error = std::fabs(change);
      else if (change * before > 0. && std::fabs(change) < std::fabs(before))
      {
        reference.order = std::log2(before / change);
        const double correction =
            change / (std::exp2(std::min(highest_order, reference.order)) - 1.);
        reference.quantity.value += correction;
        reference.error =
            std::max({std::fabs(correction), std::fabs(change), .25 * std::fabs(before)});
      }
      else
      {
        const auto [low, high] = std::minmax({last, levels[n - 2].value, levels[n - 3].value});
        reference.error = high - low;
      }
      return reference;
    }

    QuantityReference last_history(const std::vector<StudyQuantity> &levels)
    {
      const std::size_t n = levels.size();
      const double change = distance(levels[n - 2], levels[n - 1]),
                   before = n > 2 ? distance(levels[n - 3], levels[n - 2]) : 0.;
      QuantityReference reference;
      reference.quantity = levels[n - 1];
      reference.error = std::max(change, before);
      // If the changes fall more slowly than the square root of the step, their sum is a guess.
      constexpr double slowest = .75;
      if (n > 2 && change < slowest * before)
      {
        reference.order = std::log2(before / change);
        const double quotient = std::max(std::exp2(-highest_order), change / before);
        reference.error = change * quotient / (1. - quotient);
      }
      return reference;
    }
  } // namespace

  QuantityReference extrapolate(const std::vector<StudyQuantity> &levels)
  {
    if (levels.size() > 1)
      return levels.back().is_history() ? last_history(levels) : extrapolate_number(levels);
    QuantityReference reference;
    reference.quantity = levels.back();
    reference.error = std::numeric_limits<double>::infinity();
    return reference;
  }

  StudyQuantity exact_quantity(const std::string &formula, const std::string &entry,
                               const StudyQuantity &quantity)
  {
    const Expression exact(formula, entry);
    StudyQuantity result;
    result.value = exact(0., 0.);
    if (!quantity.is_history())
      return result;
    result.time = quantity.time;
    double sum = 0.;
    for (const double t : quantity.time)
    {
      result.history.push_back(exact(0., t));
      sum += result.history.back() * result.history.back();
    }
    result.value = std::sqrt(sum / quantity.time.size());
    return result;
  }
} // namespace taut
