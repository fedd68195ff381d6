// SPDX-License-Identifier: LGPL-2.1-or-later
#include "output/fixed_links.h"
#include "output/reactions.h"
#include <taut/base/archive.h>
#include <taut/output/series.h>

#include <algorithm>
#include <limits>

namespace taut
{
  void Series::begin(const RunView &run)
  {
    is_open = run.communicator.is_root();
    if (!is_open)
      return;
    interval = run.interval;
    for (IntervalTable *table : {&sliding, &probes})
      *table = IntervalTable(constraints ? interval : 0.);
    for (IntervalTable *table : {&links, &supports})
      *table = IntervalTable(link_interval);
    for (const FixedLink &link :
         constraints ? fixed_links(scene, *constraints) : std::vector<FixedLink>())
    {
      add_link(link.name, link.may_open, link.rotates, false);
      fixed.emplace_back(link.link, link.may_open);
    }
    if (constraints)
      contacts = sliding_contacts(scene, *constraints);
    for (const SlidingContact &contact : contacts)
    {
      if (contact.is_strip)
        add_strip(contact.name);
      for (const std::size_t link : contact.links)
      {
        const ConstraintData &row = (*constraints)[constraints->index_of_link(link)];
        add_link(row.name, row.cone.may_open(), row.rotational, true);
      }
    }
    for (const SupportPoint &point : support_points(scene))
      supports.add_quantity(point.name + (point.is_moment ? " moment" : " force"),
                            point.is_moment ? "N m" : "N");
    for (const Probe &probe : scene.probes)
      probes.add_quantity(probe.name, probe.unit());
    const std::pair<IntervalTable *, const char *> tables[] = {
        {&sliding, "/sliding"}, {&links, "/links"}, {&supports, "/supports"}, {&probes, "/probes"}};
    for (const auto &[table, name] : tables)
      if (table == &links && has_long_links && !links.is_empty())
        links.open_long(run.folder + name, {"force [N or N m]", "gap [m or rad]"}, run.resumes);
      else if (!table->is_empty())
        table->open(format, run.folder + name, run.resumes);
    const std::vector<std::string> columns = {"time [s]",
                                              "complementarity [1]",
                                              "balance [1]",
                                              "drift [m or rad]",
                                              "iterations [1]",
                                              "contact energy [J]",
                                              "contact gap [m or rad]",
                                              "peak over mean [1]"};
    if (constraints)
      certificate =
          std::make_unique<TableFile>(format, run.folder + "/certificate", columns, run.resumes);
  }

  void Series::add_link(const std::string &name, const bool may_open, const bool rotates,
                        const bool slides)
  {
    IntervalTable &table = slides ? sliding : links;
    table.begin_item(name);
    if (slides)
      table.add_value(name + " position", "m");
    table.add_quantity(name + (rotates ? " moment" : " force"), rotates ? "N m" : "N");
    const std::string gap = name + " gap", unit = rotates ? "rad" : "m";
    if (may_open)
    {
      table.add_quantity(gap, unit);
      table.add_state(name);
    }
    else
      table.add_value(gap, unit);
  }

  void Series::add_strip(const std::string &name)
  {
    sliding.add_value(name + " position", "m");
    sliding.add_quantity(name + " force", "N");
    sliding.add_quantity(name + " gap", "m");
    sliding.add_state(name);
  }

  void Series::record_link(const StepView &step, const std::size_t link, const bool may_open)
  {
    values.push_back(step.links.force[link]);
    values.push_back(step.links.gap[link]);
    if (may_open)
      values.push_back(step.links.force[link] != 0.);
  }

  /// The strip touches where it touches one of its wires.
  void Series::record_strip(const StepView &step, const SlidingContact &contact)
  {
    const State &state = step.state;
    double force = 0., gap = std::numeric_limits<double>::infinity();
    for (const std::size_t link : contact.links)
    {
      const std::size_t row = step.constraints.index_of_link(link);
      force += state.multiplier[row];
      gap = std::min(gap, state.distance[row]);
    }
    values.push_back(
        step.constraints.position(step.constraints.index_of_link(contact.links[0]), state.time));
    values.insert(values.end(), {force, gap, double(force != 0.)});
  }

  void Series::record_links(const StepView &step)
  {
    values.clear();
    for (const auto &[link, may_open] : fixed)
      record_link(step, link, may_open);
    if (!values.empty())
      links.record(step.state.time, values);
  }

  void Series::record_sliding(const StepView &step)
  {
    values.clear();
    for (const SlidingContact &contact : contacts)
    {
      if (contact.is_strip)
        record_strip(step, contact);
      for (const std::size_t link : contact.links)
      {
        const std::size_t row = step.constraints.index_of_link(link);
        values.push_back(step.constraints.position(row, step.state.time));
        record_link(step, link, step.constraints[row].cone.may_open());
      }
    }
    if (!values.empty())
      sliding.record(step.state.time, values);
  }

  void Series::record(const StepView &step)
  {
    if (!is_open)
      return;
    const double time = step.state.time;
    if (constraints)
    {
      record_sliding(step);
      record_links(step);
    }
    if (!step.supports.empty())
      supports.record(time, step.supports);
    if (!step.probes.empty())
      probes.record(time, step.probes);
    if (!certificate || !(time >= next - 1e-9 * interval))
      return;
    next = time + interval;
    const Residuals &found = step.residuals;
    const ContactMeasures::Summary contacts = step.measures.summary();
    values = {found.complementarity,   found.balance, found.drift,        double(found.iterations),
              contacts.contact_energy, contacts.gap,  contacts.resolution};
    certificate->add_line(time, values);
  }

  void Series::save(OutputArchive &archive)
  {
    if (!is_open)
      return;
    for (IntervalTable *table : {&sliding, &links, &supports, &probes})
      table->save(archive);
    const std::size_t length = certificate->save();
    archive << next << length;
  }

  void Series::resume(InputArchive &archive, const StepView &)
  {
    if (!is_open)
      return;
    for (IntervalTable *table : {&sliding, &links, &supports, &probes})
      table->load(archive);
    std::size_t length = 0;
    archive >> next >> length;
    certificate->resume(length);
  }

  void Series::finish()
  {
    for (IntervalTable *table : {&sliding, &links, &supports, &probes})
      table->close();
    if (certificate)
      certificate->close();
  }
} // namespace taut
