// SPDX-License-Identifier: LGPL-2.1-or-later
// statistics.json: each quantity an object with value and unit, and where something is expected of
// it the range in the same unit and whether it is inside. Keys are identifiers, but for the names
// of items, which are in the order of the scene.
#include <taut/base/version.h>
#include <taut/base/write_file.h>
#include <taut/output/statistics.h>
#include <taut/output/table_file.h>

#include <nlohmann/json.hpp>

#include <cctype>

namespace taut
{
  namespace
  {
    using json = nlohmann::ordered_json;

    /// "mean_plus_3_standard_deviations" for "Mean + 3 standard deviations".
    std::string identifier(const std::string &name)
    {
      std::string key;
      for (const char c : name)
        key += c == '+'   ? std::string("plus")
               : c == '-' ? std::string("minus")
               : c == ' ' ? std::string("_")
                          : std::string(1, std::tolower(static_cast<unsigned char>(c)));
      return key;
    }

    json quantity(const double value, const std::string &unit)
    {
      return {{"value", value}, {"unit", unit}};
    }

    json time(const double value)
    {
      return quantity(std::stod(time_text(value)), "s");
    }

    /// @p rows is a table of Statistics.
    template <typename Rows>
    json quantities_of(const Rows &rows, const bool judged)
    {
      json result = json::object();
      for (const auto &row : rows)
      {
        json &entry = result[identifier(row.name)] = quantity(row.value, row.unit);
        if (row.expected == nullptr || !judged)
          continue;
        const double low = (*row.expected)[0], high = (*row.expected)[1];
        entry["expected"] = {low, high};
        entry["inside"] = row.value >= low && row.value <= high;
      }
      return result;
    }
  } // namespace

  void Statistics::write(const std::string &path, const RunDescription &run) const
  {
    json root = {
        {"scene", run.scene},        {"generator", run.generator}, {"version", version()},
        {"scheme", run.scheme},      {"step", time(run.step)},     {"end", time(run.end)},
        {"partial", run.is_partial}, {"until", until()},           {"verdict", verdict().text()}};

    json &all_contacts = root["sliding_contacts"] = json::object();
    for (const Contact &contact : contacts)
    {
      const ContactQuantities f = quantities(contact);
      json &entry = all_contacts[contact.name] = {{"samples", f.n_samples}};
      if (parameters.window.size() == 2)
        entry["window"] = {{"value", parameters.window},
                           {"unit", "m"},
                           {"evaluated", json::array()},
                           {"complete", f.is_complete}};
      if (f.n_samples == 0)
        continue;
      if (parameters.window.size() == 2)
        entry["window"]["evaluated"] = {f.begin, f.end};
      if (f.longest_step > 0.)
        entry["filter_frequency"] = {
            {"value", parameters.filter_frequency}, {"unit", "Hz"}, {"resolved", f.is_filtered}};
      entry["raw"] = quantities_of(table(f, true), false);
      json evaluated = quantities_of(table(f, false), f.are_judged());
      entry["contact_loss"] = evaluated["contact_loss"];
      evaluated.erase("contact_loss");
      if (f.are_judged())
        entry[f.is_filtered ? "filtered" : "raw"] = evaluated;
    }

    json &probes = root["probes"] = json::object();
    for (std::size_t i = 0; i < uplift.size(); ++i)
      probes[probe_names[i]] = quantities_of(table(i), true);
    json &links = root["links"] = json::object();
    for (std::size_t i = 0; i < link_quantities.size(); ++i)
    {
      const std::string unit = link_rotates[i] ? "N m" : "N";
      links[link_names[i]] = {
          {"open_time", time(link_quantities[i].open_time)},
          {"largest_force", quantity(link_quantities[i].largest_force, unit)},
          {"impulse", quantity(link_quantities[i].impulse, unit + " s")},
          {"largest_impulse", quantity(link_quantities[i].largest_impulse, unit + " s")}};
    }
    json &supports = root["supports"] = json::object();
    for (std::size_t i = 0; i < support_quantities.size(); ++i)
    {
      const std::string unit = support_is_moment[i] ? "N m" : "N";
      supports[support_names[i]] = {{"start", quantity(support_quantities[i].start, unit)},
                                    {"largest", quantity(support_quantities[i].largest, unit)},
                                    {"smallest", quantity(support_quantities[i].smallest, unit)}};
    }
    const auto residual = [](const double value, const double at)
    {
      json entry = quantity(value, "1");
      entry["time"] = time(at);
      return entry;
    };
    root["certificate"] = {
        {"complementarity", residual(worst.complementarity, worst_complementarity_time)},
        {"balance", residual(worst.balance, worst_balance_time)},
        {"drift", quantity(worst.drift, "m or rad")},
        {"steps", n_steps},
        {"iterations_per_step", n_steps > 0 ? double(n_iterations) / n_steps : 0.},
        {"fallbacks", n_fallbacks}};
    if (measures && rows->size() > 0)
    {
      const ContactMeasures::Summary s = measures->summary();
      const auto measure = [&](const double value, const std::string &unit, const std::size_t row)
      {
        json entry = quantity(value, unit);
        entry["largest_at"] = (*rows)[row].name;
        return entry;
      };
      json &certificate = root["certificate"];
      certificate["contact_energy"] = measure(s.contact_energy, "J", s.energy_constraint);
      certificate["relative_contact_energy"] = measure(s.relative_energy, "1", s.energy_constraint);
      certificate["energy_of_large_motions"] = quantity(s.motion_energy, "J");
      certificate["contact_gap"] = measure(s.gap, "m or rad", s.gap_constraint);
      certificate["peak_over_mean"] = measure(s.resolution, "1", s.resolution_row);
    }
    json &warnings = root["warnings"] = json::array();
    for (const Warning &warning : run.warnings)
      warnings.push_back({{"kind", warning.kind},
                          {"message", warning.message},
                          {"value", warning.value},
                          {"limit", warning.limit},
                          {"unit", warning.unit},
                          {"time", time(warning.time)}});
    write_file(path, root.dump(2) + '\n');
  }
} // namespace taut
