// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/nearest_name.h"
#include "output/signals.h"
#include "scene/travel.h"
#include <taut/base/exceptions.h>
#include <taut/output/contact_quantities.h>

#include <deal.II/base/parameter_handler.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <sstream>

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

  namespace
  {
    /// Distance by which a position may miss the end of the window [m].
    double slack(const std::vector<double> &window)
    {
      return 1e-9 * (1. + std::fabs(window[1]));
    }

    /**
     * Largest mean force over the speed [km/h: N], as `StatisticsParameters::largest_mean`, by EN
     * 50367 as second-hand sources quote it: AC above 200 km/h several, below one
     * (staspika/python-klmast); DC one (showhoo/ocs-calculators), none below 200 km/h.
     */
    const std::map<std::string, std::vector<double>> &curves_of_supplies()
    {
      constexpr double change = 200., none = std::numeric_limits<double>::infinity();
      static const std::map<std::string, std::vector<double>> curves = {
          {"none", {}},
          {"AC", {.00047, 90., change, .00097, 70.}},
          {"DC 3 kV", {0., none, change, .00097, 110.}},
          {"DC 1.5 kV", {0., none, change, .00097, 140.}}};
      return curves;
    }

    const char *const expected_quantities[] = {"Mean",
                                               "Standard deviation",
                                               "Mean + 3 standard deviations",
                                               "Mean - 3 standard deviations",
                                               "Maximum",
                                               "Minimum",
                                               "Standard deviation over mean",
                                               "Contact loss",
                                               "Uplift"};
  } // namespace

  void StatisticsParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.enter_subsection("Statistics");
    prm.add_parameter(
        "Window", window,
        "First and last position of a sliding contact on its wire between which its "
        "force is evaluated, of a strip on its first wire, also beyond the ends of it; "
        "empty: the whole run [m]",
        List(Double(), 0, 2));
    prm.add_parameter("Filter frequency", filter_frequency,
                      "Low-pass filter of the contact force, third-order Butterworth forwards and "
                      "backwards, -3 dB in total at this frequency; 0: none. Expected ranges of "
                      "the force are of the filtered one: a step that does not resolve the "
                      "frequency is not compared with them [Hz]",
                      Double(0., Double::max_double_value));
    const std::string curve =
        " mean of the force over the speed v in km/h: 'a, b' for a v^2 + b, 'a, b, v1, c, d' for c "
        "v^2 + d above v1. Give the curve of your edition of EN 50367 or the TSI for your supply; "
        "empty: no limit [N]";
    prm.add_parameter("Least mean force", least_mean, "Least" + curve, List(Double()));
    prm.add_parameter("Largest mean force", largest_mean, "Largest" + curve, List(Double()));
    prm.add_parameter(
        "Supply", supply,
        "Largest mean force where that entry is empty, with v in km/h. 'AC': 0.00047 v^2 + 90 up "
        "to 200 km/h, and 0.00097 v^2 + 70 above. 'DC 3 kV', 'DC 1.5 kV': 0.00097 v^2 + 110 and + "
        "140 above 200 km/h, and no limit up to it. EN 50367 as quoted by second-hand sources; "
        "check against your edition. There is no least mean force",
        Selection("none|AC|DC 3 kV|DC 1.5 kV"));
    prm.add_parameter("Sums", sums,
                      "Sums of contact forces at equal times, 'NAME: CONTACT + CONTACT', separated "
                      "by commas, of sliding contacts, strips or links of strips. The log, "
                      "statistics.json, sweeps and studies have mean, standard deviation, maximum "
                      "and minimum of each, filtered as the other forces, and the share of the "
                      "time in which all are open. The window is for the position of the first one",
                      List(Anything(), 0));
    prm.add_parameter("Tables", tables,
                      "Which files to write beside statistics.json. 'histogram': samples of the "
                      "contact force in the window by classes, contact_<name>_histogram.csv. "
                      "'spectrum': its power spectral density by Welch's method, "
                      "contact_<name>_spectrum.csv. 'cycles': rainflow cycles of the force of each "
                      "dropper by ASTM E1049, dropper_cycles.csv",
                      List(Selection("histogram|spectrum|cycles")));
    prm.add_parameter("Histogram class width", class_width, "Width of a class of the histogram [N]",
                      Double(1e-6, Double::max_double_value));
    prm.enter_subsection("Expected ranges");
    for (const char *name : expected_quantities)
      prm.add_parameter(name, expected[name],
                        "Lower and upper bound, printed beside the quantity; empty: none " +
                            std::string(std::string(name) == "Contact loss" ? "[%]"
                                        : std::string(name) == "Uplift"     ? "[mm]"
                                        : std::string(name) == "Standard deviation over mean"
                                            ? "[1]"
                                            : "[N]"),
                        List(Double(), 0, 2));
    prm.add_parameter(
        "Uplift probes", uplift_probes,
        "Names of the probes that Uplift is for, separated by commas; empty: all that "
        "record displacements",
        List(Anything(), 0));
    prm.leave_subsection();
    prm.leave_subsection();
  }

  void StatisticsParameters::check() const
  {
    for (const auto &[curve, entry] : {std::pair(&least_mean, "Statistics/Least mean force"),
                                       {&largest_mean, "Statistics/Largest mean force"}})
      if (!curve->empty() && curve->size() % 3 != 2)
        throw EntryError(entry, "it has " + std::to_string(curve->size()) +
                                    " numbers; give 'a, b' for a v^2 + b, or 'a, b, v1, c, d' "
                                    "for c v^2 + d above the speed v1");
  }

  void StatisticsParameters::check_probes(const Scene &scene) const
  {
    const std::string entry = "Statistics/Expected ranges/Uplift probes";
    std::vector<std::string> known;
    for (const Probe &probe : scene.probes)
      if (probe.unit() == "m")
        known.push_back(probe.name);
    for (const std::string &name : uplift_probes)
      if (std::count(known.begin(), known.end(), name) == 0)
        throw EntryError(entry, "there is no probe '" + name +
                                    "' that records a displacement in m" + suggestion(name, known));
    const auto range = expected.find("Uplift");
    if (!uplift_probes.empty() && (range == expected.end() || range->second.empty()))
      throw EntryError(entry, "there is no range for them; set Uplift, too");
  }

  bool StatisticsParameters::has_uplift(const std::string &probe) const
  {
    return uplift_probes.empty() ||
           std::find(uplift_probes.begin(), uplift_probes.end(), probe) != uplift_probes.end();
  }

  bool StatisticsParameters::has_table(const std::string &name) const
  {
    return std::find(tables.begin(), tables.end(), name) != tables.end();
  }

  std::string StatisticsParameters::source_of_largest_mean() const
  {
    if (supply == "none" || !largest_mean.empty())
      return "";
    return "EN 50367 as quoted by second-hand sources; check against your edition";
  }

  std::vector<double> StatisticsParameters::mean_force_range(const double speed) const
  {
    const std::vector<double> &largest =
        largest_mean.empty() ? curves_of_supplies().at(supply) : largest_mean;
    const double v = 3.6 * speed;
    const auto value = [&](const std::vector<double> &curve, const double none)
    {
      if (curve.empty())
        return none;
      std::size_t i = 0;
      while (i + 4 < curve.size() && v > curve[i + 2])
        i += 3;
      return curve[i] * v * v + curve[i + 1];
    };
    const double infinity = std::numeric_limits<double>::infinity();
    const double low = value(least_mean, -infinity), high = value(largest, infinity);
    if (std::isinf(low) && std::isinf(high))
      return {};
    return {low, high};
  }

  bool StatisticsParameters::is_in_window(const double position) const
  {
    if (window.size() < 2)
      return true;
    const double slack = taut::slack(window);
    return position >= window[0] - slack && position <= window[1] + slack;
  }

  void StatisticsParameters::check_window(const Scene &scene, const double end_time) const
  {
    if (window.size() < 2 || !(end_time > 0.))
      return;
    std::ostringstream ways;
    std::set<std::string> strips;
    for (const Link &link : scene.links)
    {
      if (!link.moving() || !strips.insert(link.strip.empty() ? link.name : link.strip).second)
        continue; // the position of a strip is that on its first wire
      if (link.straight)
        return; // the end of a run shows how far it slides on its cable
      const double start = link.to.position, end = start + way(link, end_time);
      const TravelRange range = travel_range(link, end_time);
      if (start + range.greatest >= window[0] - slack(window) &&
          start + range.least <= window[1] + slack(window))
        return;
      ways << (ways.tellp() > 0 ? ", '" : "'") << (link.strip.empty() ? link.name : link.strip)
           << "' goes from " << start << " to " << end << " m";
    }
    if (ways.tellp() > 0)
      throw EntryError("Statistics/Window", "no contact comes there until Time/End: " + ways.str() +
                                                ". Move the window, run longer, or leave it empty "
                                                "to evaluate the whole run");
  }
} // namespace taut
