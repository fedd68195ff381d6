// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/write_file.h>
#include <taut/output/statistics.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <iomanip>
#include <ostream>
#include <sstream>

namespace taut
{
  namespace
  {
    bool is_inside(const double value, const std::vector<double> &range)
    {
      return value >= range[0] && value <= range[1];
    }
  } // namespace

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

  void Statistics::write(const std::string &path, const bool is_partial) const
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
    root["partial"] = is_partial;
    root["until"] = until();
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
      root["links"][link_names[i]] = {
          {"open time [s]", link_figures[i].open_time},
          {"largest force [N, N m]", link_figures[i].largest_force},
          {"impulse [N s, N m s]", link_figures[i].impulse},
          {"largest impulse [N s, N m s]", link_figures[i].largest_impulse}};
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
        {"drift [m, rad]", worst.drift},
        {"steps", n_steps},
        {"active-set iterations a step", n_steps > 0 ? double(n_iterations) / n_steps : 0.},
        {"fallbacks", n_fallbacks}};
    if (measures && rows->size() > 0)
    {
      const ContactMeasures::Summary s = measures->summary();
      root["certificate"]["contact energy [J]"] = s.contact_energy;
      root["certificate"]["contact energy over the largest energies [1]"] = s.relative_energy;
      root["certificate"]["contact energy, most at"] = (*rows)[s.energy_row].name;
      root["certificate"]["contact gap [m, rad]"] = s.gap;
      root["certificate"]["contact gap at"] = (*rows)[s.gap_row].name;
      root["certificate"]["peak over mean [1]"] = s.resolution;
      root["certificate"]["peak over mean at"] = (*rows)[s.resolution_row].name;
    }
    write_file(path, root.dump(2));
  }
} // namespace taut
