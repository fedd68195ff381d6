// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/archive.h>
#include <taut/output/low_pass.h>
#include <taut/output/reactions.h>
#include <taut/output/statistics.h>

#include <taut/base/exceptions.h>
#include <taut/scene/travel.h>

#include <deal.II/base/parameter_handler.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>

namespace taut
{
  namespace
  {
    /// Samples in a period that the filter needs.
    constexpr double least_samples = 4.;

    /// Distance by which a position may miss the end of the window [m].
    double slack(const std::vector<double> &window)
    {
      return 1e-9 * (1. + std::fabs(window[1]));
    }

    const char *const expected_quantities[] = {"Mean",
                                               "Standard deviation",
                                               "Mean + 3 standard deviations",
                                               "Mean - 3 standard deviations",
                                               "Maximum",
                                               "Minimum",
                                               "Contact loss",
                                               "Uplift"};

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

  void StatisticsParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.enter_subsection("Statistics");
    prm.add_parameter("Window", window,
                      "First and last position of a sliding contact on its wire between which its "
                      "force is evaluated; empty: the whole run [m]",
                      List(Double(), 0, 2));
    prm.add_parameter("Filter frequency", filter_frequency,
                      "Low-pass filter of the contact force, third-order Butterworth forwards and "
                      "backwards, -3 dB in total at this frequency; 0: none. Expected ranges of "
                      "the force are of the filtered one: a step that does not resolve the "
                      "frequency is not compared with them [Hz]",
                      Double(0., Double::max_double_value));
    prm.enter_subsection("Expected ranges");
    for (const char *name : expected_quantities)
      prm.add_parameter(name, expected[name],
                        "Lower and upper bound, printed beside the quantity; empty: none " +
                            std::string(std::string(name) == "Contact loss" ? "[%]"
                                        : std::string(name) == "Uplift"     ? "[mm]"
                                                                            : "[N]"),
                        List(Double(), 0, 2));
    prm.leave_subsection();
    prm.leave_subsection();
  }

  void StatisticsParameters::check_window(const Scene &scene, const double end_time) const
  {
    if (window.size() < 2 || !(end_time > 0.))
      return;
    std::ostringstream ways;
    for (const Link &link : scene.links)
    {
      if (!link.moving())
        continue;
      if (link.straight)
        return; // the end of a run shows how far it slides on its cable
      const double start = link.to.position, end = start + way(link, end_time);
      const TravelRange range = travel_range(link, end_time);
      if (start + range.greatest >= window[0] - slack(window) &&
          start + range.least <= window[1] + slack(window))
        return;
      ways << (ways.tellp() > 0 ? ", '" : "'") << link.name << "' goes from " << start << " to "
           << end << " m";
    }
    if (ways.tellp() > 0)
      throw EntryError("Statistics/Window", "no contact comes there until Time/End: " + ways.str() +
                                                ". Move the window, run longer, or leave it empty "
                                                "to evaluate the whole run");
  }

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

  Statistics::Statistics(const StatisticsParameters &parameters, const Scene &scene,
                         const Constraints &rows)
      : parameters(parameters)
  {
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (rows.slides(i))
        contacts.push_back({rows[i].name, rows[i].link, {}, {}, {}});
      else if (rows[i].is_link())
        links.push_back({rows[i].name, rows[i].cone.may_open(), rows[i].rotational});
    for (const Probe &probe : scene.probes)
      probes.push_back({probe.name, probe.rotational});
    for (const SupportPoint &point : support_points(scene))
      supports.push_back({point.name, point.is_moment});
  }

  void Statistics::record_links(const StepView &step, const double dt)
  {
    std::size_t n = 0;
    for (std::size_t i = 0; i < rows->size() && !rows->slides(i); ++i)
    {
      if (!(*rows)[i].is_link())
        continue;
      LinkQuantities &link = links[n++];
      const double force = step.state.multiplier[i];
      (force == 0. ? link.open_time : link.closed_time) += dt;
      link.impulse += force * dt;
      const double mean = link.unilateral ? step.measures.mean_force(i) : force;
      if (std::fabs(mean) > std::fabs(link.largest_force))
        link.largest_force = mean;
      link.largest_impulse = step.measures.largest_impulse(i);
    }
  }

  void Statistics::record(const StepView &step)
  {
    const State &state = step.state;
    const bool is_start = times.empty();
    const double dt = is_start ? 0. : state.time - times.back();
    times.push_back(state.time);
    measures = &step.measures;
    rows = &step.constraints;
    for (Contact &contact : contacts)
    {
      const std::size_t row = rows->index_of_link(contact.link);
      contact.position.push_back(rows->position(row, state.time));
      contact.force.push_back(state.multiplier[row]);
      contact.mean_force.push_back(step.measures.mean_force(row));
    }
    record_links(step, dt);
    for (std::size_t i = 0; i < probes.size(); ++i)
    {
      ProbeQuantities &probe = probes[i];
      probe.last = step.probes[i];
      probe.largest = std::max(probe.largest, probe.last);
      probe.smallest = std::min(probe.smallest, probe.last);
    }
    for (std::size_t i = 0; i < supports.size(); ++i)
    {
      SupportQuantities &support = supports[i];
      const double force = step.supports[i];
      if (is_start)
        support.start = support.largest = support.smallest = force;
      support.largest = std::max(support.largest, force);
      support.smallest = std::min(support.smallest, force);
    }
    if (dt != 0.) // the start is no step
      record_certificate(step);
  }

  void Statistics::record_certificate(const StepView &step)
  {
    ++n_steps;
    n_iterations += step.certificate.iterations;
    n_fallbacks += step.certificate.fallback;
    if (step.certificate.complementarity > worst.complementarity)
    {
      worst.complementarity = step.certificate.complementarity;
      worst_complementarity_time = step.state.time;
    }
    if (step.certificate.balance > worst.balance)
    {
      worst.balance = step.certificate.balance;
      worst_balance_time = step.state.time;
    }
    worst.drift = std::max(worst.drift, step.certificate.drift);
  }

  template <typename Archive>
  void Statistics::store(Archive &archive)
  {
    archive &times &n_steps &n_iterations &n_fallbacks;
    archive &worst.complementarity &worst.balance &worst.drift;
    archive &worst_complementarity_time &worst_balance_time;
    for (Contact &contact : contacts)
      archive &contact.position &contact.force &contact.mean_force;
    for (LinkQuantities &link : links)
      archive &link.open_time &link.closed_time &link.largest_force &link.impulse &link
          .largest_impulse;
    for (ProbeQuantities &probe : probes)
      archive &probe.largest &probe.smallest &probe.last;
    for (SupportQuantities &support : supports)
      archive &support.start &support.largest &support.smallest;
  }

  void Statistics::save(OutputArchive &archive)
  {
    store(archive);
  }

  void Statistics::resume(InputArchive &archive, const StepView &step)
  {
    store(archive);
    measures = &step.measures;
    rows = &step.constraints;
  }

  Statistics::ContactQuantities Statistics::quantities(const Contact &recorded) const
  {
    ContactQuantities result;
    // Unequal steps count by length: the record is resampled at the shortest interval.
    Contact contact = recorded;
    constexpr double most_samples = 4e6;
    const double shortest = shortest_of_unequal_steps(times);
    if (shortest > 0.)
    {
      const double interval = std::max(shortest, (times.back() - times.front()) / most_samples);
      contact.position = resample(times, recorded.position, interval);
      contact.force = resample(times, recorded.force, interval);
      contact.mean_force = resample(times, recorded.mean_force, interval);
    }
    const auto in_window = [&](const std::vector<double> &record)
    {
      if (parameters.window.size() < 2)
        return record;
      const double slack = taut::slack(parameters.window);
      std::vector<double> inside;
      for (std::size_t i = 0; i < record.size(); ++i)
        if (contact.position[i] >= parameters.window[0] - slack &&
            contact.position[i] <= parameters.window[1] + slack)
          inside.push_back(record[i]);
      return inside;
    };
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
    if (parameters.filter_frequency > 0.)
      result.longest_step = 1. / (least_samples * parameters.filter_frequency);
    if (step > 0. && step < result.longest_step)
    {
      result.filtered =
          Moments::of(in_window(low_pass(contact.force, step, parameters.filter_frequency)));
      result.is_filtered = true;
    }
    return result;
  }

  std::vector<Statistics::NamedQuantity> Statistics::named_quantities() const
  {
    std::vector<NamedQuantity> list;
    for (const Contact &contact : contacts)
    {
      const ContactQuantities f = quantities(contact);
      const Moments &m = f.filtered;
      list.insert(list.end(), {{contact.name, "mean", m.mean, "N"},
                               {contact.name, "standard deviation", m.deviation, "N"},
                               {contact.name, "maximum", m.maximum, "N"},
                               {contact.name, "minimum", m.minimum, "N"},
                               {contact.name, "contact loss", f.loss, "1"}});
    }
    for (const LinkQuantities &f : links)
    {
      const std::string force = f.rotates ? "N m" : "N";
      list.insert(list.end(), {{f.name, "open time", f.open_time, "s"},
                               {f.name, "closed time", f.closed_time, "s"},
                               {f.name, "largest force", f.largest_force, force},
                               {f.name, "impulse", f.impulse, force + " s"},
                               {f.name, "largest impulse", f.largest_impulse, force + " s"}});
    }
    for (const ProbeQuantities &probe : probes)
    {
      const std::string unit = probe.rotates ? "rad" : "m";
      list.insert(list.end(), {{probe.name, "largest", probe.largest, unit},
                               {probe.name, "smallest", probe.smallest, unit},
                               {probe.name, "last", probe.last, unit}});
    }
    return list;
  }
} // namespace taut
