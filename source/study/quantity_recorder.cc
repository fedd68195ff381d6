// SPDX-License-Identifier: LGPL-2.1-or-later

#include "study/quantity_recorder.h"
#include "base/nearest_name.h"
#include "output/reactions.h"
#include <taut/base/exceptions.h>
#include <taut/output/table_file.h>
#include <taut/simulation/simulation.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace taut
{
  double distance(const StudyQuantity &quantity, const StudyQuantity &reference)
  {
    if (!quantity.is_history())
      return std::fabs(quantity.value - reference.value);
    double sum = 0.;
    std::size_t k = 0;
    const std::vector<double> &t = reference.time, &u = reference.history;
    for (std::size_t i = 0; i < quantity.time.size(); ++i)
    {
      while (k + 2 < t.size() && t[k + 1] < quantity.time[i])
        ++k;
      double there = u[k];
      if (k + 1 < t.size() && t[k + 1] > t[k])
      {
        const double weight = std::clamp((quantity.time[i] - t[k]) / (t[k + 1] - t[k]), 0., 1.);
        there += weight * (u[k + 1] - u[k]);
      }
      sum += (quantity.history[i] - there) * (quantity.history[i] - there);
    }
    return std::sqrt(sum / quantity.time.size());
  }

  std::vector<NamedQuantity> quantities_of(const Simulation &simulation)
  {
    std::vector<NamedQuantity> all = simulation.statistics().named_quantities();
    const std::vector<NamedQuantity> others = simulation.observed_quantities();
    all.insert(all.end(), others.begin(), others.end());
    return all;
  }

  QuantityRecorder::QuantityRecorder(const StudyParameters &study, const Simulation &simulation)
      : simulation(simulation)
  {
    for (std::size_t i = 0; i < study.quantities.items.size(); ++i)
      sources.push_back(find(study.quantities.items[i], study.quantities.title(i)));
  }

  QuantityRecorder::Source QuantityRecorder::find(const StudyParameters::QuantityItem &item,
                                                  const std::string &title) const
  {
    const Scene &scene = simulation.scene();
    const Constraints &rows = simulation.constraints();
    const std::vector<NamedQuantity> known = quantities_of(simulation);
    std::vector<std::string> items, quantities;
    for (std::size_t i = 0; i < known.size(); ++i)
    {
      if (known[i].item == item.of)
      {
        if (known[i].quantity == item.quantity)
          return {Source::Kind::number, i};
        quantities.push_back(known[i].quantity);
      }
      if (items.empty() || items.back() != known[i].item)
        items.push_back(known[i].item);
    }
    if (quantities.empty())
      throw EntryError(title + "/Of", "the scene has no contact, link, probe, support or span '" +
                                          item.of + "'" + suggestion(item.of, items));
    quantities.push_back("history");
    if (item.quantity != "history")
      throw EntryError(title + "/Quantity", "'" + item.of + "' has no '" + item.quantity + "'" +
                                                suggestion(item.quantity, quantities));
    for (std::size_t i = 0; i < scene.probes.size(); ++i)
      if (scene.probes[i].name == item.of)
        return {Source::Kind::probe, i};
    for (const SlidingContact &contact : sliding_contacts(scene, rows))
      if (contact.is_strip && contact.name == item.of)
        return {Source::Kind::force_of_links, 0, contact.links};
    if (const std::vector<std::size_t> links = simulation.statistics().links_of_sum(item.of);
        !links.empty())
      return {Source::Kind::force_of_links, 0, links};
    for (std::size_t l = 0; l < scene.links.size(); ++l)
      if (scene.links[l].name == item.of)
        return {Source::Kind::force_of_links, 0, {l}};
    const std::vector<SupportPoint> supports = support_points(scene);
    for (std::size_t i = 0; i < supports.size(); ++i)
      if (supports[i].name == item.of)
        return {Source::Kind::support, i};
    throw EntryError(title + "/Quantity", "'" + item.of +
                                              "' is measured as a number, and has no history; "
                                              "take one of its quantities");
  }

  void QuantityRecorder::record(const StepView &step)
  {
    times.push_back(step.state.time);
    for (Source &source : sources)
      if (source.kind == Source::Kind::probe)
        source.history.push_back(step.probes[source.index]);
      else if (source.kind == Source::Kind::support)
        source.history.push_back(step.supports[source.index]);
      else if (source.kind == Source::Kind::force_of_links)
      {
        double force = 0.;
        for (const std::size_t link : source.links)
          force += step.links.force[link];
        source.history.push_back(force);
      }
  }

  std::vector<StudyQuantity> QuantityRecorder::study_quantities() const
  {
    const std::vector<NamedQuantity> all = quantities_of(simulation);
    std::vector<StudyQuantity> list;
    for (const Source &source : sources)
    {
      StudyQuantity quantity;
      if (source.kind == Source::Kind::number)
        quantity.value = all[source.index].value;
      else
      {
        quantity.time = times;
        quantity.history = source.history;
        double sum = 0.;
        for (const double x : source.history)
          sum += x * x;
        quantity.value = std::sqrt(sum / times.size());
      }
      list.push_back(std::move(quantity));
    }
    return list;
  }

  namespace
  {
    using Named = NamedQuantity;

    std::vector<Named> quantities_of_kind(const std::vector<Named> &known,
                                          const std::vector<std::string> &kinds)
    {
      std::vector<Named> list;
      for (const Named &q : known)
        if (std::isfinite(q.value) && q.value != 0. &&
            std::count(kinds.begin(), kinds.end(), q.quantity) > 0)
          list.push_back(q);
      return list;
    }

    std::vector<Named> strongest_link(const std::vector<Named> &known)
    {
      std::vector<Named> list = quantities_of_kind(known, {"largest force", "impulse"});
      const Named *strongest = nullptr;
      for (const Named &q : list)
        if (q.quantity == "largest force" && (!strongest || q.value > strongest->value))
          strongest = &q;
      const std::string item = strongest ? strongest->item : "";
      list.erase(
          std::remove_if(list.begin(), list.end(), [&](const Named &q) { return q.item != item; }),
          list.end());
      return list;
    }
  } // namespace

  std::vector<std::string> default_quantities(const std::vector<Named> &known)
  {
    std::vector<Named> chosen = quantities_of_kind(known, {"mean", "standard deviation"});
    chosen = chosen.empty() ? quantities_of_kind(known, {"largest", "smallest"})
                            : quantities_of_kind(known, {"mean", "standard deviation", "largest"});
    if (chosen.empty())
      chosen = strongest_link(known);
    if (chosen.empty())
      throw EntryError("Study/Quantities", "the scene has no probe and no force of a link by "
                                           "itself; name quantities of interest");
    std::map<std::string, double> extreme; // of each probe: one scale for both its extremes
    for (const Named &q : chosen)
      extreme[q.item] = std::max(extreme[q.item], std::fabs(q.value));
    std::string names;
    std::vector<std::string> entries(1);
    for (const Named &q : chosen)
    {
      const std::string name = q.item + " " + q.quantity, section = "Study/Quantity " + name;
      names += (names.empty() ? "" : ", ") + name;
      entries.push_back(section + "/Of=" + q.item);
      entries.push_back(section + "/Quantity=" + q.quantity);
      if (q.quantity == "largest" || q.quantity == "smallest")
        entries.push_back(section + "/Scale=" + csv_number(extreme[q.item]));
    }
    entries[0] = "Study/Quantities=" + names;
    return entries;
  }
} // namespace taut
