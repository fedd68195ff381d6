// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/output/contact_figures.h>
#include <taut/output/low_pass.h>

#include <algorithm>
#include <cmath>

namespace taut
{
  namespace
  {
    /// Samples in a period that the filter needs.
    constexpr double least_samples = 4.;

    /// The part of a record between two frequencies.
    std::vector<double> band_pass(const std::vector<double> &record, const double step,
                                  const double from, const double to)
    {
      std::vector<double> result = low_pass(record, step, to);
      if (!(from > 0.))
        return result;
      const std::vector<double> slow = low_pass(result, step, from);
      for (std::size_t i = 0; i < result.size(); ++i)
        result[i] -= slow[i];
      return result;
    }
  } // namespace

  std::vector<std::size_t> lengths_of_losses(const std::vector<double> &force)
  {
    std::vector<std::size_t> lengths;
    for (std::size_t i = 0; i < force.size(); ++i)
    {
      if (force[i] != 0.)
        continue;
      if (i == 0 || force[i - 1] != 0.)
        lengths.push_back(0);
      ++lengths.back();
    }
    return lengths;
  }

  Histogram histogram(const std::vector<double> &record, const double width)
  {
    Histogram result;
    if (record.empty())
      return result;
    const auto [least, most] = std::minmax_element(record.begin(), record.end());
    const double first = std::floor(*least / width);
    result.begin = first * width;
    result.width = width;
    result.number.assign(static_cast<std::size_t>(std::floor(*most / width) - first) + 1, 0);
    for (const double x : record)
      ++result.number[static_cast<std::size_t>(std::floor(x / width) - first)];
    return result;
  }

  ContactFigures ContactFigures::of(const ContactRecord &recorded, const std::vector<double> &times,
                                    const StatisticsParameters &parameters)
  {
    ContactFigures result;
    const ContactRecord contact = recorded.at_equal_steps(times);
    const std::vector<double> force = contact.in_window(contact.force, parameters);
    if (force.size() < 2)
      return result;
    const double step = (times.back() - times.front()) / (contact.force.size() - 1);
    for (Band &band : result.bands)
    {
      band.is_resolved = least_samples * band.to * step < 1.;
      if (band.is_resolved)
        band.deviation =
            Moments::of(
                contact.in_window(band_pass(contact.force, step, band.from, band.to), parameters))
                .deviation;
    }
    constexpr double rounding = 1e-9;
    for (const std::size_t length : lengths_of_losses(force))
      for (Losses &losses : result.losses)
        if (length * step > losses.longer_than * (1. + rounding))
        {
          ++losses.number;
          losses.share += static_cast<double>(length) / force.size();
        }
    if (!contact.height.empty())
    {
      const Moments height = Moments::of(contact.in_window(contact.height, parameters));
      result.height_range = height.maximum - height.minimum;
    }
    return result;
  }
} // namespace taut
