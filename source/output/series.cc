// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/output/reactions.h>
#include <taut/output/series.h>

namespace taut
{
  namespace
  {
    void write_line(CsvFile &file, const double time, const std::vector<double> &values)
    {
      file << time;
      for (const double value : values)
        file << value;
      file.end_line();
    }
  } // namespace

  Series::Series(const std::string &folder, const Scene &scene, const ContactRows &rows,
                 const double interval, const double link_interval)
      : folder(folder), interval(interval), link_interval(link_interval)
  {
    std::vector<std::string> sliding_columns, link_columns, support_columns, probe_columns;
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      if (rows[i].is_cut())
        continue;
      const bool angular = scene.links[rows[i].link].rotational;
      const std::string force = rows[i].name + (angular ? " moment [N m]" : " force [N]"),
                        gap = rows[i].name + (angular ? " gap [rad]" : " gap [m]");
      if (rows[i].moving)
        sliding_columns.push_back(rows[i].name + " position [m]");
      auto &columns = rows[i].moving ? sliding_columns : link_columns;
      columns.push_back(force);
      columns.push_back(gap);
    }
    for (const SupportPoint &point : support_points(scene))
      support_columns.push_back(support_column(point));
    for (const Probe &probe : scene.probes)
      probe_columns.push_back(probe.name + (probe.rotational ? " [rad]" : " [m]"));
    if (!sliding_columns.empty())
      open(sliding, "sliding.csv", sliding_columns);
    if (!link_columns.empty())
      open(links, "links.csv", link_columns);
    if (!support_columns.empty())
      open(supports, "supports.csv", support_columns);
    if (!probe_columns.empty())
      open(probes, "probes.csv", probe_columns);
    open(certificate, "certificate.csv",
         {"complementarity [1]", "balance [1]", "drift [m, rad]", "iterations [1]",
          "contact energy [J]", "contact gap [m, rad]", "peak over mean [1]"});
  }

  void Series::open(std::unique_ptr<CsvFile> &file, const std::string &name,
                    std::vector<std::string> columns)
  {
    columns.insert(columns.begin(), "time [s]");
    file = std::make_unique<CsvFile>(folder + "/" + name, columns);
  }

  void Series::record(const StepView &step)
  {
    const State &state = step.state;
    // A step counts as due if it is within rounding of its time.
    const double tolerance = 1e-9 * interval;
    const bool due = state.time >= next - tolerance;
    const bool links_due = state.time >= next_link - 1e-9 * link_interval;
    const auto write = [&](CsvFile &file, const bool moving)
    {
      file << state.time;
      for (std::size_t i = 0; i < step.rows.size(); ++i)
        if (step.rows[i].moving == moving && !step.rows[i].is_cut())
        {
          if (moving)
            file << step.rows.position(i, state.time);
          file << state.multiplier[i] << state.geometric_gap[i];
        }
      file.end_line();
    };
    if (links && links_due)
      write(*links, false);
    if (supports && links_due)
      write_line(*supports, state.time, step.supports);
    if (links_due)
      next_link = state.time + link_interval;
    if (!due)
      return;
    next = state.time + interval;
    if (sliding)
      write(*sliding, true);
    if (probes)
      write_line(*probes, state.time, step.probes);
    *certificate << state.time << step.certificate.complementarity << step.certificate.balance
                 << step.certificate.drift << step.certificate.iterations;
    const ContactMeasures::Summary contacts = step.measures.summary();
    *certificate << contacts.contact_energy << contacts.gap << contacts.resolution;
    certificate->end_line();
  }

  void Series::close()
  {
    for (CsvFile *file :
         {sliding.get(), links.get(), supports.get(), probes.get(), certificate.get()})
      if (file)
        file->close();
  }
} // namespace taut
