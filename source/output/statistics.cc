// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/output/low_pass.h>
#include <taut/output/reactions.h>
#include <taut/output/statistics.h>

#include <deal.II/base/parameter_handler.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <limits>
#include <numeric>
#include <ostream>

namespace taut
{
  namespace
  {
    const char *const expected_figures[] = {"Mean",
                                            "Standard deviation",
                                            "Mean + 3 standard deviations",
                                            "Mean - 3 standard deviations",
                                            "Maximum",
                                            "Minimum",
                                            "Contact loss",
                                            "Uplift"};
  }

  namespace
  {
    bool is_inside(const double value, const std::vector<double> &range)
    {
      return value >= range[0] && value <= range[1];
    }

    /// Shortest of the steps between increasing times if they differ, else 0 [s].
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

    /// The record at equal intervals, linear between its samples.
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
        // A contact that is open at both ends is open between them.
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
                      "backwards, -3 dB in total at this frequency [Hz]",
                      Double(0., Double::max_double_value));
    prm.enter_subsection("Expected ranges");
    for (const char *name : expected_figures)
      prm.add_parameter(name, expected[name],
                        "Lower and upper bound, printed beside the figure; empty: none " +
                            std::string(std::string(name) == "Contact loss" ? "[%]"
                                        : std::string(name) == "Uplift"     ? "[mm]"
                                                                            : "[N]"),
                        List(Double(), 0, 2));
    prm.leave_subsection();
    prm.leave_subsection();
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
                         const ContactRows &rows)
      : parameters(parameters)
  {
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      if (rows[i].moving)
        contacts.push_back({rows[i].name, i, {}, {}});
      else if (!rows[i].is_cut())
      {
        link_names.push_back(rows[i].name);
        link_unilateral.push_back(rows[i].unilateral);
      }
    }
    link_figures.resize(link_names.size());
    for (const Probe &probe : scene.probes)
    {
      probe_names.push_back(probe.name);
      probe_rotates.push_back(probe.rotational);
    }
    for (const SupportPoint &point : support_points(scene))
      support_names.push_back(point.name);
    uplift.assign(probe_names.size(), 0.);
    lowering.assign(probe_names.size(), 0.);
    last.assign(probe_names.size(), 0.);
  }

  void Statistics::record(const StepView &step)
  {
    const State &state = step.state;
    const double dt = times.empty() ? 0. : state.time - times.back();
    times.push_back(state.time);
    for (Contact &contact : contacts)
    {
      contact.position.push_back(step.rows.position(contact.row, state.time));
      contact.force.push_back(state.multiplier[contact.row]);
    }
    for (std::size_t i = 0; i < link_figures.size(); ++i)
    {
      LinkFigures &link = link_figures[i];
      const double force = state.multiplier[i];
      if (force == 0.)
        link.open_time += dt;
      else
        link.closed_time += dt;
      link.impulse += force * dt;
      if (std::fabs(force) > std::fabs(link.largest_force))
        link.largest_force = force;
    }
    for (std::size_t i = 0; i < uplift.size(); ++i)
    {
      uplift[i] = std::max(uplift[i], step.probes[i]);
      lowering[i] = std::min(lowering[i], step.probes[i]);
      last[i] = step.probes[i];
    }
    support_figures.resize(support_names.size());
    for (std::size_t i = 0; i < support_figures.size(); ++i)
    {
      SupportFigures &support = support_figures[i];
      const double force = step.supports[i];
      if (times.size() == 1)
        support = {force, force, force};
      support.largest = std::max(support.largest, force);
      support.smallest = std::min(support.smallest, force);
    }
    if (dt == 0.)
      return; // the start is no step
    ++n_steps;
    n_iterations += step.certificate.iterations;
    n_fallbacks += step.certificate.fallback;
    if (step.certificate.complementarity > worst.complementarity)
    {
      worst.complementarity = step.certificate.complementarity;
      worst_complementarity_time = state.time;
    }
    if (step.certificate.balance > worst.balance)
    {
      worst.balance = step.certificate.balance;
      worst_balance_time = state.time;
    }
  }

  Statistics::ContactFigures Statistics::figures(const Contact &recorded) const
  {
    ContactFigures result;
    // Of unequal steps each counts by its length: at equal intervals, as short as the shortest.
    Contact contact = recorded;
    constexpr double most_samples = 4e6;
    const double shortest = shortest_of_unequal_steps(times);
    if (shortest > 0.)
    {
      const double interval = std::max(shortest, (times.back() - times.front()) / most_samples);
      contact.position = resample(times, recorded.position, interval);
      contact.force = resample(times, recorded.force, interval);
    }
    const auto in_window = [&](const std::vector<double> &record)
    {
      if (parameters.window.size() < 2)
        return record;
      const double slack = 1e-9 * (1. + std::fabs(parameters.window[1]));
      std::vector<double> inside;
      for (std::size_t i = 0; i < record.size(); ++i)
        if (contact.position[i] >= parameters.window[0] - slack &&
            contact.position[i] <= parameters.window[1] + slack)
          inside.push_back(record[i]);
      return inside;
    };
    const std::vector<double> raw = in_window(contact.force);
    result.n_samples = raw.size();
    result.raw = result.filtered = Moments::of(raw);
    if (!raw.empty())
      result.loss = static_cast<double>(std::count(raw.begin(), raw.end(), 0.)) / raw.size();
    const double step =
        contact.force.size() > 1 ? (times.back() - times.front()) / (contact.force.size() - 1) : 0.;
    // The filter needs some samples a period.
    if (step > 0. && parameters.filter_frequency > 0. &&
        4. * parameters.filter_frequency * step < 1.)
    {
      result.filtered =
          Moments::of(in_window(low_pass(contact.force, step, parameters.filter_frequency)));
      result.is_filtered = true;
    }
    return result;
  }

  std::vector<Statistics::Figure> Statistics::table(const ContactFigures &f) const
  {
    const Moments &m = f.filtered;
    return {{"Mean", "N", m.mean},
            {"Standard deviation", "N", m.deviation},
            {"Mean + 3 standard deviations", "N", m.mean + 3. * m.deviation},
            {"Mean - 3 standard deviations", "N", m.mean - 3. * m.deviation},
            {"Maximum", "N", m.maximum},
            {"Minimum", "N", m.minimum},
            {"Contact loss", "%", 100. * f.loss}};
  }

  std::vector<Statistics::NamedFigure> Statistics::named_figures() const
  {
    std::vector<NamedFigure> list;
    for (const Contact &contact : contacts)
    {
      const ContactFigures f = figures(contact);
      const Moments &m = f.filtered;
      list.insert(list.end(), {{contact.name, "mean", m.mean},
                               {contact.name, "standard deviation", m.deviation},
                               {contact.name, "maximum", m.maximum},
                               {contact.name, "minimum", m.minimum},
                               {contact.name, "contact loss", f.loss}});
    }
    for (std::size_t i = 0; i < link_figures.size(); ++i)
    {
      const LinkFigures &f = link_figures[i];
      list.insert(list.end(), {{link_names[i], "open time", f.open_time},
                               {link_names[i], "closed time", f.closed_time},
                               {link_names[i], "largest force", f.largest_force},
                               {link_names[i], "impulse", f.impulse}});
    }
    for (std::size_t i = 0; i < probe_names.size(); ++i)
      list.insert(list.end(), {{probe_names[i], "largest", uplift[i]},
                               {probe_names[i], "smallest", lowering[i]},
                               {probe_names[i], "last", last[i]}});
    return list;
  }

  const std::vector<double> *Statistics::uplift_range(const std::size_t probe) const
  {
    const auto range = parameters.expected.find("Uplift");
    return range != parameters.expected.end() && range->second.size() == 2 && !probe_rotates[probe]
               ? &range->second
               : nullptr;
  }

  void Statistics::print(std::ostream &out) const
  {
    const auto flags = out.flags();
    out << std::fixed << std::setprecision(2);
    const auto line = [&](const std::string &name, const std::string &unit, const double value,
                          const std::string &raw)
    {
      out << "  " << std::left << std::setw(36) << name << std::right << std::setw(10) << value
          << ' ' << std::left << std::setw(3) << unit << std::right << std::setw(12) << raw;
      const auto range = parameters.expected.find(name);
      if (range != parameters.expected.end() && range->second.size() == 2)
      {
        const auto &r = range->second;
        out << "   expected " << r[0] << " to " << r[1]
            << (is_inside(value, r) ? "   inside" : "   OUTSIDE");
      }
      out << '\n';
    };
    for (const Contact &contact : contacts)
    {
      const ContactFigures f = figures(contact);
      out << "Contact force of '" << contact.name << "'";
      if (parameters.window.size() == 2)
        out << ", " << parameters.window[0] << " to " << parameters.window[1] << " m";
      out << " (" << f.n_samples << " samples, "
          << (f.is_filtered ? "low-passed; unfiltered beside it"
                            : "not filtered: the step is too long")
          << ")\n";
      if (f.n_samples == 0)
      {
        out << "  no sample in the window\n";
        continue;
      }
      const double raw[] = {f.raw.mean,
                            f.raw.deviation,
                            f.raw.mean + 3. * f.raw.deviation,
                            f.raw.mean - 3. * f.raw.deviation,
                            f.raw.maximum,
                            f.raw.minimum};
      const std::vector<Figure> rows = table(f);
      for (std::size_t i = 0; i < rows.size(); ++i)
      {
        std::ostringstream text;
        if (i < 6)
          text << std::fixed << std::setprecision(2) << raw[i];
        line(rows[i].name, rows[i].unit, rows[i].value, text.str());
      }
    }
    if (!uplift.empty())
      out << "Displacement of the probes along their directions: largest, smallest\n";
    for (std::size_t i = 0; i < uplift.size(); ++i)
    {
      out << "  " << std::left << std::setw(36) << probe_names[i] << std::right << std::setw(10)
          << 1e3 * uplift[i] << std::setw(10) << 1e3 * lowering[i]
          << (probe_rotates[i] ? " mrad" : " mm  ");
      const std::vector<double> *range = uplift_range(i);
      if (range)
        out << "       expected " << (*range)[0] << " to " << (*range)[1]
            << (is_inside(1e3 * uplift[i], *range) ? "   inside" : "   OUTSIDE");
      out << '\n';
    }
    std::size_t n_opened = 0;
    double longest = 0.;
    std::string longest_name;
    for (std::size_t i = 0; i < link_figures.size(); ++i)
      if (link_unilateral[i] && link_figures[i].open_time > 0.)
      {
        ++n_opened;
        if (link_figures[i].open_time > longest)
        {
          longest = link_figures[i].open_time;
          longest_name = link_names[i];
        }
      }
    const std::size_t n_unilateral = std::count(link_unilateral.begin(), link_unilateral.end(), 1);
    if (n_unilateral > 0)
    {
      out << "One-sided links that opened: " << n_opened << " of " << n_unilateral;
      if (n_opened > 0)
        out << "; longest '" << longest_name << "', " << std::setprecision(4) << longest << " s";
      out << '\n';
    }
    if (n_steps > 0)
    {
      out << std::scientific << std::setprecision(1) << "Certificate: complementarity "
          << worst.complementarity << ", balance " << worst.balance << std::fixed
          << std::setprecision(3) << "; " << static_cast<double>(n_iterations) / n_steps
          << " active-set iterations a step, " << n_fallbacks << " fallbacks in " << n_steps
          << " steps\n";
    }
    out.flags(flags);
  }

  void Statistics::write(const std::string &path) const
  {
    // In the order of the scene.
    using json = nlohmann::ordered_json;
    const auto moments = [](const Moments &m)
    {
      return json{{"mean [N]", m.mean},
                  {"standard deviation [N]", m.deviation},
                  {"mean + 3 standard deviations [N]", m.mean + 3. * m.deviation},
                  {"mean - 3 standard deviations [N]", m.mean - 3. * m.deviation},
                  {"maximum [N]", m.maximum},
                  {"minimum [N]", m.minimum}};
    };
    json root;
    root["sliding contacts"] = json::object();
    for (const Contact &contact : contacts)
    {
      const ContactFigures f = figures(contact);
      json &entry = root["sliding contacts"][contact.name];
      entry = {{"samples", f.n_samples},
               {"window [m]", parameters.window},
               {"raw", moments(f.raw)},
               {"contact loss [1]", f.loss}};
      if (f.is_filtered)
      {
        entry["filtered"] = moments(f.filtered);
        entry["filter frequency [Hz]"] = parameters.filter_frequency;
      }
      for (const Figure &figure : table(f))
      {
        const auto range = parameters.expected.find(figure.name);
        if (range != parameters.expected.end() && range->second.size() == 2)
          entry["expected"][figure.name] = {{"range", range->second},
                                            {"value", figure.value},
                                            {"inside", is_inside(figure.value, range->second)}};
      }
    }
    root["probes"] = json::object();
    for (std::size_t i = 0; i < uplift.size(); ++i)
    {
      root["probes"][probe_names[i]] = {{"largest [m, rad]", uplift[i]},
                                        {"smallest [m, rad]", lowering[i]}};
      if (const std::vector<double> *range = uplift_range(i))
        root["probes"][probe_names[i]]["expected"] = {
            {"range [mm]", *range}, {"inside", is_inside(1e3 * uplift[i], *range)}};
    }
    root["links"] = json::object();
    for (std::size_t i = 0; i < link_figures.size(); ++i)
      root["links"][link_names[i]] = {{"open time [s]", link_figures[i].open_time},
                                      {"largest force [N, N m]", link_figures[i].largest_force},
                                      {"impulse [N s, N m s]", link_figures[i].impulse}};
    root["supports"] = json::object();
    for (std::size_t i = 0; i < support_figures.size(); ++i)
      root["supports"][support_names[i]] = {
          {"force at the start [N, N m]", support_figures[i].start},
          {"largest force [N, N m]", support_figures[i].largest},
          {"smallest force [N, N m]", support_figures[i].smallest}};
    root["certificate"] = {
        {"complementarity", worst.complementarity},
        {"complementarity, worst at [s]", worst_complementarity_time},
        {"balance", worst.balance},
        {"balance, worst at [s]", worst_balance_time},
        {"steps", n_steps},
        {"active-set iterations a step", n_steps > 0 ? double(n_iterations) / n_steps : 0.},
        {"fallbacks", n_fallbacks}};
    std::ofstream file(path);
    file << root.dump(2) << '\n';
    file.close();
    if (!file)
      throw UserError("cannot write '" + path +
                      "': check that its folder is writable and the disk not full");
  }
} // namespace taut
