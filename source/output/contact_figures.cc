// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/output/contact_figures.h>
#include <taut/output/power_spectrum.h>

#include <algorithm>
#include <cmath>

namespace taut
{
  namespace
  {
    /// Samples in a period of the upper frequency of a band.
    constexpr double samples_in_band = 4.;
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
    const PowerSpectrum spectrum = power_spectrum(force, step);
    for (Band &band : result.bands)
    {
      band.is_resolved = !spectrum.density.empty() && samples_in_band * band.to * step < 1.;
      if (band.is_resolved)
        band.deviation = spectrum.deviation(band.from, band.to);
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
