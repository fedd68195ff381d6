// SPDX-License-Identifier: LGPL-2.1-or-later
// statistics.json: each quantity is an object with value and unit. If a range is expected, it has
// also the range in this unit and whether the value is inside. Keys are identifiers, except for
// names of items, which are in the order of the scene.
#include "base/write_file.h"
#include "output/json_values.h"
#include <taut/base/version.h>
#include <taut/output/table_file.h>

#include <boost/algorithm/string/replace.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace taut
{
  using json = nlohmann::ordered_json;

  namespace
  {
    /// "mean_plus_3_standard_deviations" for "mean + 3 standard deviations".
    std::string identifier(std::string name)
    {
      boost::replace_all(name, "+", "plus");
      boost::replace_all(name, " - ", " minus ");
      std::replace(name.begin(), name.end(), ' ', '_');
      return name;
    }

    /// Entries of the objects in a file by their names: an ordered object looks for a key from its
    /// first one on, which takes long for all droppers of a line.
    class Sections
    {
    public:
      explicit Sections(json &root) : root(root) {}

      json &operator()(const std::string &section, const std::string &name)
      {
        auto &entries = root[section].get_ref<json::object_t &>();
        const auto [at, is_new] = index.emplace(std::pair(section, name), entries.size());
        if (is_new)
          entries.emplace_back(name, json::object());
        return (entries.begin() + static_cast<std::ptrdiff_t>(at->second))->second;
      }

    private:
      json &root;
      std::map<std::pair<std::string, std::string>, std::size_t> index;
    };
  } // namespace

  json json_quantity(const double value, const std::string &unit)
  {
    return {{"value", value + 0.}, {"unit", unit}}; // no -0
  }

  json json_time(const double value)
  {
    return json_quantity(std::stod(time_text(value)), "s");
  }

  void add_observers(const std::vector<NamedQuantity> &all, json &root)
  {
    for (const NamedQuantity &q : all)
      root["observers"][q.item][identifier(q.quantity)] = json_quantity(q.value, q.unit);
  }

  void add_warnings(const std::vector<Warning> &all, json &root)
  {
    json &warnings = root["warnings"] = json::array();
    for (const Warning &warning : all)
      warnings.push_back({{"kind", warning.kind},
                          {"message", warning.message},
                          {"value", warning.value},
                          {"limit", warning.limit},
                          {"unit", warning.unit},
                          {"time", json_time(warning.time)}});
  }

  class Statistics::Json
  {
  public:
    static json of(const Statistics &all, const Contact &contact)
    {
      const ContactQuantities f = all.measure(contact);
      json entry = {{"samples", f.n_samples}};
      if (all.parameters.window.size() == 2)
        entry["window"] = {{"value", all.parameters.window},
                           {"unit", "m"},
                           {"evaluated", json::array()},
                           {"complete", f.is_complete}};
      if (f.n_samples == 0)
        return entry;
      if (all.parameters.window.size() == 2)
        entry["window"]["evaluated"] = {f.begin, f.end};
      if (f.longest_step > 0.)
        entry["filter_frequency"] = {{"value", all.parameters.filter_frequency},
                                     {"unit", "Hz"},
                                     {"resolved", f.is_filtered}};
      add_force(all.figures_of(f, true), f.are_judged(), f.is_filtered, entry);
      if (const std::string source = all.parameters.source_of_largest_mean(); !source.empty())
        entry["largest_mean_force"] = {{"supply", all.parameters.supply}, {"source", source}};
      return entry;
    }

    /// Figures by identifiers, or those of the unfiltered force.
    static json of(const std::vector<Figure> &figures, const bool judged, const bool raw = false)
    {
      json result = json::object();
      for (const Figure &figure : figures)
      {
        if (std::isnan(raw ? figure.raw : figure.value))
          continue;
        json &entry = result[identifier(figure.name)] =
            json_quantity(raw ? figure.raw : figure.value, figure.unit_in_files());
        if (figure.expected.empty() || !judged || raw)
          continue;
        const double low = figure.expected[0], high = figure.expected[1];
        entry["expected"] = {low / figure.factor(), high / figure.factor()};
        entry["inside"] = figure.shown() >= low && figure.shown() <= high;
      }
      return result;
    }

    static void add_force(const std::vector<Figure> &figures, const bool judged,
                          const bool is_filtered, json &entry)
    {
      entry["raw"] = of(figures, false, true);
      json evaluated = of(figures, judged);
      entry["contact_loss"] = evaluated["contact_loss"];
      evaluated.erase("contact_loss");
      if (judged)
        entry[is_filtered ? "filtered" : "raw"] = evaluated;
    }

    static json of(const Statistics &all, const ContactSum &sum)
    {
      const ContactQuantities f = all.measure(sum);
      json entry = {{"of", sum.of}, {"samples", f.n_samples}};
      if (f.n_samples == 0)
        return entry;
      add_force(all.figures_of(f, false), f.is_filtered, true, entry);
      return entry;
    }

    static json of_certificates(const Statistics &all)
    {
      const auto residual = [](const double value, const double at)
      {
        json entry = json_quantity(value, "1");
        entry["time"] = json_time(at);
        return entry;
      };
      json entry = {
          {"complementarity", residual(all.worst.complementarity, all.worst_complementarity_time)},
          {"balance", residual(all.worst.balance, all.worst_balance_time)},
          {"drift", json_quantity(all.worst.drift, "m or rad")},
          {"steps", all.n_steps},
          {"iterations_per_step", all.n_steps > 0 ? double(all.n_iterations) / all.n_steps : 0.},
          {"fallbacks", all.n_fallbacks}};
      if (!all.measures || all.rows->n_of_all() == 0)
        return entry;
      const ContactMeasures::Summary s = all.measures->summary();
      const auto measure = [&](const double value, const std::string &unit, const std::size_t row)
      {
        json entry = json_quantity(value, unit);
        if (row != no_link)
          entry["largest_at"] = all.measures->label(row).name;
        return entry;
      };
      entry["contact_energy"] = measure(s.contact_energy, "J", s.energy_constraint);
      entry["relative_contact_energy"] = measure(s.relative_energy, "1", s.energy_constraint);
      entry["energy_of_large_motions"] = json_quantity(s.motion_energy, "J");
      entry["contact_gap"] = measure(s.gap, "m or rad", s.gap_constraint);
      entry["peak_over_mean"] = measure(s.resolution, "1", s.resolution_row);
      return entry;
    }
  };

  void Statistics::write(const std::string &path, const RunDescription &run,
                         const std::vector<NamedQuantity> &others) const
  {
    json root = {
        {"schema", statistics_schema}, {"scene", run.scene},        {"generator", run.generator},
        {"version", version()},        {"scheme", run.scheme},      {"step", json_time(run.step)},
        {"end", json_time(run.end)},   {"partial", run.is_partial}, {"until", until()},
        {"verdict", verdict().text()}};
    for (const char *const section :
         {"line_constants", "sliding_contacts", "sums", "probes", "links", "supports", "spans"})
      root[section] = json::object();
    Sections entry(root);
    for (const Contact &contact : contacts)
      entry("sliding_contacts", contact.of.name) = Json::of(*this, contact);
    for (const ContactSum &sum : sums)
      entry("sums", sum.name) = Json::of(*this, sum);
    for (const LineConstants &line : lines)
      entry("line_constants", line.contact)["wire"] = line.wire;
    for (const SupportFigures::Figures &f : supports.of_supports())
      entry("supports", f.name) = {{"wire", f.wire}, {"position", json_quantity(f.position, "m")}};
    for (const SpannedWire &wire : spanned)
      for (const Span &span : wire.spans)
        entry("spans", span.name) = {{"wire", wire.name},
                                     {"from", json_quantity(span.from, "m")},
                                     {"to", json_quantity(span.to, "m")}};
    for (const Item &item : items())
      if (!item.is_force) // which is above, with its ranges
      {
        json *at = &entry(item.path[0], item.path[1]);
        for (std::size_t i = 2; i < item.path.size(); ++i)
          at = &(*at)[item.path[i]];
        at->update(Json::of(item.figures, true));
      }
    add_observers(others, root);
    root["certificate"] = Json::of_certificates(*this);
    add_warnings(run.warnings, root);
    write_file(path, root.dump(2) + '\n');
  }
} // namespace taut
