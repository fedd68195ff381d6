// SPDX-License-Identifier: LGPL-2.1-or-later
// statistics.json: each quantity is an object with value and unit. If a range is expected, it has
// also the range in this unit and whether the value is inside. Keys are identifiers, except for
// names of items, which are in the order of the scene.
#include "base/write_file.h"
#include <taut/base/version.h>
#include <taut/output/statistics.h>
#include <taut/output/table_file.h>

#include <nlohmann/json.hpp>

#include <cctype>
#include <cmath>
#include <map>

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
  } // namespace

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
      add_figures(all.figures(contact), entry);
      if (contact.of.is_strip)
        entry["wires"] = shares(all, contact);
      return entry;
    }

    /// Figures by identifiers, or those of the unfiltered force.
    static json of(const std::vector<Figure> &figures, const bool judged, const bool raw = false)
    {
      json result = json::object();
      for (const Figure &figure : figures)
      {
        if (raw && std::isnan(figure.raw))
          continue;
        json &entry = result[identifier(figure.name)] =
            quantity(raw ? figure.raw : figure.shown(), figure.unit_shown());
        if (figure.expected.empty() || !judged || raw)
          continue;
        const double low = figure.expected[0], high = figure.expected[1];
        entry["expected"] = {low, high};
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

    static void add_figures(const ContactFigures &f, json &entry)
    {
      json &bands = entry["bands"] = json::array();
      for (const ContactFigures::Band &band : f.bands)
      {
        bands.push_back({{"from", band.from}, {"to", band.to}, {"unit", "Hz"}});
        if (band.is_resolved)
          bands.back()["standard_deviation"] = quantity(band.deviation, "N");
      }
      json &losses = entry["losses"] = json::array();
      for (const ContactFigures::Losses &l : f.losses)
        losses.push_back({{"longer_than", quantity(1e3 * l.longer_than, "ms")},
                          {"number", l.number},
                          {"share", quantity(100. * l.share, "%")}});
      entry["height_range"] = quantity(1e3 * f.height_range, "mm");
    }

    static json of(const LineConstants &line)
    {
      json entry = {{"wire", line.wire},
                    {"speed", quantity(line.speed, "m/s")},
                    {"wave_speed", quantity(line.wave_speed, "m/s")},
                    {"speed_over_wave_speed", quantity(line.speed / line.wave_speed, "1")},
                    {"doppler_factor", quantity(line.doppler, "1")}};
      if (line.reflection > 0.)
      {
        entry["reflection_at_droppers"] = quantity(line.reflection, "1");
        entry["amplification"] = quantity(line.amplification, "1");
      }
      return entry;
    }

    static json of(const SupportFigures::Figures &f)
    {
      json entry = {{"wire", f.wire},
                    {"position", quantity(f.position, "m")},
                    {"at_start", quantity(f.at_start, f.unit)}};
      if (f.n_samples > 0)
      {
        entry["mean"] = quantity(f.window.mean, f.unit);
        entry["maximum"] = quantity(f.window.largest, f.unit);
        entry["minimum"] = quantity(f.window.least, f.unit);
      }
      return entry;
    }

    /// By wire.
    static json of_spans(const Statistics &all)
    {
      std::map<std::string, std::size_t> n_slackenings;
      for (const LinkQuantities &link : all.links)
        n_slackenings[link.name] = link.dropper.n_slackenings;
      json result = json::object();
      for (const SpannedWire &wire : all.spanned)
      {
        json &entries = result[wire.name] = json::array();
        for (const Span &span : wire.spans)
        {
          std::size_t n = 0;
          for (const std::string &dropper : span.droppers)
            n += n_slackenings[dropper];
          entries.push_back({{"from", quantity(span.from, "m")},
                             {"to", quantity(span.to, "m")},
                             {"sag", quantity(1e3 * span.sag, "mm")},
                             {"slackenings", n}});
        }
        for (const Contact &contact : all.contacts)
          if (contact.wire == wire.wire)
            add_forces(all, contact, wire.spans, entries);
      }
      return result;
    }

    static void add_forces(const Statistics &all, const Contact &contact,
                           const std::vector<Span> &spans, json &entries)
    {
      const ContactRecord record = all.judged(contact);
      for (std::size_t i = 0; i < spans.size(); ++i)
      {
        const SpanForce f = SpanForce::of(spans[i], record, all.parameters);
        if (f.n_samples > 0)
          entries[i]["contact_forces"][contact.of.name] = {
              {"samples", f.n_samples},
              {"mean", quantity(f.moments.mean, "N")},
              {"standard_deviation", quantity(f.moments.deviation, "N")},
              {"maximum", quantity(f.moments.maximum, "N")},
              {"minimum", quantity(f.moments.minimum, "N")}};
      }
    }

    static json shares(const Statistics &all, const Contact &contact)
    {
      json result = json::object();
      for (std::size_t i = 0; i < contact.wires.size(); ++i)
      {
        const ContactQuantities f = all.measure(contact, contact.wires[i]);
        json &entry = result[contact.of.names[i]] = of(all.figures_of(f, false), false, true);
        entry["not_touched"] = quantity(100. * f.loss, "%");
      }
      return result;
    }

    static json of_certificates(const Statistics &all)
    {
      const auto residual = [](const double value, const double at)
      {
        json entry = quantity(value, "1");
        entry["time"] = time(at);
        return entry;
      };
      json entry = {
          {"complementarity", residual(all.worst.complementarity, all.worst_complementarity_time)},
          {"balance", residual(all.worst.balance, all.worst_balance_time)},
          {"drift", quantity(all.worst.drift, "m or rad")},
          {"steps", all.n_steps},
          {"iterations_per_step", all.n_steps > 0 ? double(all.n_iterations) / all.n_steps : 0.},
          {"fallbacks", all.n_fallbacks}};
      if (!all.measures || all.rows->size() == 0)
        return entry;
      const ContactMeasures::Summary s = all.measures->summary();
      const auto measure = [&](const double value, const std::string &unit, const std::size_t row)
      {
        json entry = quantity(value, unit);
        entry["largest_at"] = (*all.rows)[row].name;
        return entry;
      };
      entry["contact_energy"] = measure(s.contact_energy, "J", s.energy_constraint);
      entry["relative_contact_energy"] = measure(s.relative_energy, "1", s.energy_constraint);
      entry["energy_of_large_motions"] = quantity(s.motion_energy, "J");
      entry["contact_gap"] = measure(s.gap, "m or rad", s.gap_constraint);
      entry["peak_over_mean"] = measure(s.resolution, "1", s.resolution_row);
      return entry;
    }
  };

  void Statistics::write(const std::string &path, const RunDescription &run,
                         const std::vector<NamedQuantity> &others) const
  {
    json root = {
        {"scene", run.scene},        {"generator", run.generator}, {"version", version()},
        {"scheme", run.scheme},      {"step", time(run.step)},     {"end", time(run.end)},
        {"partial", run.is_partial}, {"until", until()},           {"verdict", verdict().text()}};
    json &of_lines = root["line_constants"] = json::object();
    for (const LineConstants &line : lines)
      of_lines[line.contact] = Json::of(line);
    json &of_contacts = root["sliding_contacts"] = json::object();
    for (const Contact &contact : contacts)
      of_contacts[contact.of.name] = Json::of(*this, contact);
    json &of_sums = root["sums"] = json::object();
    for (const ContactSum &sum : sums)
      of_sums[sum.name] = Json::of(*this, sum);
    json &of_probes = root["probes"] = json::object();
    for (const ProbeQuantities &probe : probes)
      of_probes[probe.name] = Json::of(figures_of(probe), true);
    json &of_links = root["links"] = json::object();
    for (const LinkQuantities &link : links)
      of_links[link.name] = Json::of(figures_of(link), false);
    json &of_supports = root["supports"] = json::object();
    for (const SupportFigures::Figures &support : supports.of_supports())
      of_supports[support.name] = Json::of(support);
    root["spans"] = Json::of_spans(*this);
    for (const NamedQuantity &q : others)
      root["observers"][q.item][q.quantity] = quantity(q.value, q.unit);
    root["certificate"] = Json::of_certificates(*this);
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
