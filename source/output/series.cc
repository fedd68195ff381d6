// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/archive.h>
#include <taut/output/reactions.h>
#include <taut/output/series.h>

namespace taut
{
  Series::Series(const std::string &folder, const Scene &scene, const Constraints &constraints,
                 const TableFormat format, const double interval, const double link_interval,
                 const bool resumes)
      : interval(interval), sliding(interval), links(link_interval), supports(link_interval),
        probes(interval)
  {
    for (std::size_t i = 0; i < constraints.size(); ++i)
      if (constraints[i].is_link())
        add_link(constraints[i]);
    for (const SupportPoint &point : support_points(scene))
      supports.add_quantity(point.name + (point.is_moment ? " moment" : " force"),
                            point.is_moment ? "N m" : "N");
    for (const Probe &probe : scene.probes)
      probes.add_quantity(probe.name, probe.rotational ? "rad" : "m");
    const std::pair<IntervalTable *, const char *> tables[] = {
        {&sliding, "/sliding"}, {&links, "/links"}, {&supports, "/supports"}, {&probes, "/probes"}};
    for (const auto &[table, name] : tables)
      if (!table->is_empty())
        table->open(format, folder + name, resumes);
    const std::vector<std::string> columns = {"time [s]",
                                              "complementarity [1]",
                                              "balance [1]",
                                              "drift [m or rad]",
                                              "iterations [1]",
                                              "contact energy [J]",
                                              "contact gap [m or rad]",
                                              "peak over mean [1]"};
    certificate = std::make_unique<TableFile>(format, folder + "/certificate", columns, resumes);
  }

  void Series::add_link(const ConstraintData &constraint)
  {
    const bool slides = constraint.kind() == Geometry::Kind::sliding;
    IntervalTable &table = slides ? sliding : links;
    if (slides)
      table.add_value(constraint.name + " position", "m");
    table.add_quantity(constraint.name + (constraint.rotational ? " moment" : " force"),
                       constraint.rotational ? "N m" : "N");
    const std::string gap = constraint.name + " gap", unit = constraint.rotational ? "rad" : "m";
    if (constraint.cone.may_open())
    {
      table.add_quantity(gap, unit);
      table.add_state(constraint.name);
    }
    else
      table.add_value(gap, unit);
  }

  void Series::record_links(const StepView &step, const bool moving, IntervalTable &table)
  {
    const State &state = step.state;
    values.clear();
    for (std::size_t i = 0; i < step.constraints.size(); ++i)
    {
      const ConstraintData &constraint = step.constraints[i];
      if (step.constraints.slides(i) != moving || !constraint.is_link())
        continue;
      if (moving)
        values.push_back(step.constraints.position(i, state.time));
      values.push_back(state.multiplier[i]);
      values.push_back(state.geometric_gap[i]);
      if (constraint.cone.may_open())
        values.push_back(state.multiplier[i] != 0.);
    }
    if (!values.empty())
      table.record(state.time, values);
  }

  void Series::record(const StepView &step)
  {
    const double time = step.state.time;
    record_links(step, true, sliding);
    record_links(step, false, links);
    if (!step.supports.empty())
      supports.record(time, step.supports);
    if (!step.probes.empty())
      probes.record(time, step.probes);
    if (!(time >= next - 1e-9 * interval))
      return;
    next = time + interval;
    const Certificate &found = step.certificate;
    const ContactMeasures::Summary contacts = step.measures.summary();
    values = {found.complementarity,   found.balance, found.drift,        double(found.iterations),
              contacts.contact_energy, contacts.gap,  contacts.resolution};
    certificate->add_line(time, values);
  }

  void Series::save(OutputArchive &archive)
  {
    for (IntervalTable *table : {&sliding, &links, &supports, &probes})
      table->save(archive);
    const std::size_t length = certificate->save();
    archive << next << length;
  }

  void Series::resume(InputArchive &archive, const StepView &)
  {
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
    certificate->close();
  }

  void write_probes(const std::string &folder, const Scene &scene,
                    const std::vector<double> &probes)
  {
    if (scene.probes.empty())
      return;
    IntervalTable table(0.);
    for (const Probe &probe : scene.probes)
      table.add_quantity(probe.name, probe.rotational ? "rad" : "m");
    table.open(TableFormat::csv, folder + "/probes");
    table.record(0., probes);
    table.close();
  }
} // namespace taut
