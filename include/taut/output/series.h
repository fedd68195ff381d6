// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_series_h
#define taut_series_h

#include <taut/output/interval_table.h>
#include <taut/output/observer.h>
#include <taut/output/sliding_contacts.h>

#include <memory>
#include <string>
#include <vector>

namespace taut
{
  /**
   * Writes time series as tables: sliding.csv (position, force, gap of each sliding contact; of a
   * strip the sum of the forces and the least gap, and beside them those of each wire),
   * links.csv (force and gap of each fixed link; in its long form a line for each of them),
   * supports.csv (force of each support on its wire),
   * probes.csv, certificate.csv; .bin for binary tables. Empty files are not made. With an
   * interval, all tables but the last have the extremes since the line before, and for unilateral
   * links the number of openings and closings.
   */
  class Series : public Observer
  {
  public:
    /// @p scene and @p constraints are kept by reference. @p link_interval: least time between
    /// lines of links.csv and supports.csv [s], 0: each step. Others have the interval of the run.
    Series(const Scene &scene, const Constraints &constraints,
           const TableFormat format = TableFormat::csv, const double link_interval = 0.,
           const bool has_long_links = false)
        : scene(scene), constraints(&constraints), format(format), link_interval(link_interval),
          has_long_links(has_long_links)
    {
    }

    /// For a scene at rest: supports.csv and probes.csv, with one line.
    explicit Series(const Scene &scene)
        : scene(scene), constraints(nullptr), format(TableFormat::csv), link_interval(0.)
    {
    }

    /// The root makes the files.
    void begin(const RunView &run) override;
    void record(const StepView &step) override;

    /// Writes the remaining lines. Throws UserError if the disk is full.
    void finish() override;
    void save(OutputArchive &archive) override;
    void resume(InputArchive &archive, const StepView &step) override;

  private:
    void add_link(const std::string &name, bool may_open, bool rotates, bool slides);
    void add_strip(const std::string &name);
    void record_link(const StepView &step, std::size_t link, bool may_open);
    void record_strip(const StepView &step, const SlidingContact &contact);
    void record_links(const StepView &step);
    void record_sliding(const StepView &step);

    const Scene &scene;
    const Constraints *const constraints; ///< nullptr: at rest
    const TableFormat format;
    const double link_interval;
    const bool has_long_links = false;
    bool is_open = false; ///< on the root
    double interval = 0., next = 0.;
    std::vector<SlidingContact> contacts;
    std::vector<std::pair<std::size_t, bool>> fixed; ///< links, and whether they may open
    IntervalTable sliding, links, supports, probes;
    std::unique_ptr<TableFile> certificate;
    std::vector<double> values; ///< of one table and step
  };
} // namespace taut

#endif
