// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_series_h
#define taut_series_h

#include <taut/output/interval_table.h>
#include <taut/output/observer.h>

#include <memory>
#include <string>
#include <vector>

namespace taut
{
  /**
   * Time series as tables: sliding.csv (each sliding contact: position, force, gap), links.csv
   * (force and gap of every fixed link), supports.csv (force of every support on its wire),
   * probes.csv, certificate.csv; as binary tables .bin. A file without content is not made. With an
   * interval, tables but the last have the extremes since the line before, and of unilateral links
   * how often they opened or closed.
   */
  class Series : public Observer
  {
  public:
    /// @p interval and @p link_interval: least time between two lines [s]; 0: every step.
    /// @p resumes: the files go on, see resume().
    Series(const std::string &folder, const Scene &scene, const Constraints &constraints,
           TableFormat format, double interval, double link_interval, bool resumes = false);

    void record(const StepView &step) override;

    /// Writes the rest. Throws UserError when the disk is full.
    void finish() override;
    void save(OutputArchive &archive) override;
    void resume(InputArchive &archive, const StepView &step) override;

  private:
    void add_link(const ConstraintData &constraint);
    void record_links(const StepView &step, bool moving, IntervalTable &table);

    double interval, next = 0.;
    IntervalTable sliding, links, supports, probes;
    std::unique_ptr<TableFile> certificate;
    std::vector<double> values; ///< of one table and step
  };

  /// probes.csv of a run at rest: its only line, with the displacements @p probes [m, rad].
  void write_probes(const std::string &folder, const Scene &scene,
                    const std::vector<double> &probes);
} // namespace taut

#endif
