// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/output/contact_quantities.h>
#include <taut/output/low_pass.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace taut
{
  namespace
  {
    /// Samples in a period that the filter needs.
    constexpr double samples_in_filter = 4.;

    /// Shortest step between increasing times; 0 for equal steps [s].
    double shortest_of_unequal_steps(const std::vector<double> &times)
    {
      double shortest = std::numeric_limits<double>::infinity(), longest = 0.;
      for (std::size_t i = 1; i < times.size(); ++i)
      {
        shortest = std::min(shortest, times[i] - times[i - 1]);
        longest = std::max(longest, times[i] - times[i - 1]);
      }
      return longest > 1.001 * shortest ? shortest : 0.;
    }

    /// The record at equal intervals, by linear interpolation.
    std::vector<double> resample(const std::vector<double> &times,
                                 const std::vector<double> &record, const double interval)
    {
      const auto n =
          static_cast<std::size_t>((times.back() - times.front()) / interval * (1. + 1e-12)) + 1;
      std::vector<double> result(n);
      std::size_t i = 0;
      for (std::size_t k = 0; k < n; ++k)
      {
        const double t = times.front() + k * interval;
        while (i + 2 < times.size() && times[i + 1] <= t)
          ++i;
        const double part = std::min(1., (t - times[i]) / (times[i + 1] - times[i]));
        // Between two open samples a contact is open.
        result[k] = record[i] + part * (record[i + 1] - record[i]);
      }
      return result;
    }
  } // namespace

  Moments Moments::of(const std::vector<double> &record)
  {
    Moments m;
    if (record.empty())
      return m;
    m.mean = std::accumulate(record.begin(), record.end(), 0.) / record.size();
    for (const double x : record)
      m.deviation += (x - m.mean) * (x - m.mean);
    m.deviation = std::sqrt(m.deviation / record.size());
    m.minimum = *std::min_element(record.begin(), record.end());
    m.maximum = *std::max_element(record.begin(), record.end());
    return m;
  }

  void ContactRecord::add(const ContactRecord &wire)
  {
    for (std::size_t i = 0; i < force.size(); ++i)
    {
      force[i] += wire.force[i];
      mean_force[i] += wire.mean_force[i];
    }
  }

  ContactRecord ContactRecord::at_equal_steps(const std::vector<double> &times) const
  {
    constexpr double most_samples = 4e6;
    const double shortest = shortest_of_unequal_steps(times);
    if (!(shortest > 0.))
      return *this;
    const double interval = std::max(shortest, (times.back() - times.front()) / most_samples);
    return {resample(times, position, interval), resample(times, force, interval),
            resample(times, mean_force, interval),
            height.empty() ? height : resample(times, height, interval)};
  }

  std::vector<double> ContactRecord::in_window(const std::vector<double> &values,
                                               const StatisticsParameters &parameters) const
  {
    std::vector<double> inside;
    for (std::size_t i = 0; i < values.size(); ++i)
      if (parameters.is_in_window(position[i]))
        inside.push_back(values[i]);
    return inside;
  }

  ContactQuantities ContactQuantities::of(const ContactRecord &recorded,
                                          const std::vector<double> &times,
                                          const StatisticsParameters &parameters)
  {
    ContactQuantities result;
    // Unequal steps count by length.
    const ContactRecord contact = recorded.at_equal_steps(times);
    const auto in_window = [&](const std::vector<double> &values)
    { return contact.in_window(values, parameters); };
    const std::vector<double> raw = in_window(contact.force), places = in_window(contact.position);
    result.n_samples = raw.size();
    if (!raw.empty())
    {
      result.begin = places.front();
      result.end = places.back();
    }
    if (parameters.window.size() == 2 && !contact.position.empty())
    {
      const auto [least, most] =
          std::minmax_element(contact.position.begin(), contact.position.end());
      constexpr double rounding = 1e-6;
      result.is_complete =
          *least <= parameters.window[0] + rounding && *most >= parameters.window[1] - rounding;
    }
    result.raw = result.filtered = Moments::of(raw);
    // Peaks of impulses depend on the step, so that peaks are those of mean forces.
    result.raw.maximum = Moments::of(in_window(contact.mean_force)).maximum;
    result.filtered.maximum = result.raw.maximum;
    if (!raw.empty())
      result.loss = static_cast<double>(std::count(raw.begin(), raw.end(), 0.)) / raw.size();
    const double step =
        contact.force.size() > 1 ? (times.back() - times.front()) / (contact.force.size() - 1) : 0.;
    if (step > 0. && raw.size() > 1)
      result.speed = std::fabs(result.end - result.begin) / (step * (raw.size() - 1));
    if (parameters.filter_frequency > 0.)
      result.longest_step = 1. / (samples_in_filter * parameters.filter_frequency);
    if (step > 0. && step < result.longest_step)
    {
      result.filtered =
          Moments::of(in_window(low_pass(contact.force, step, parameters.filter_frequency)));
      result.is_filtered = true;
    }
    return result;
  }
} // namespace taut
