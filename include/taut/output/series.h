// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_series_h
#define taut_series_h

#include <taut/output/csv_file.h>
#include <taut/output/observer.h>

#include <memory>
#include <string>
#include <vector>

namespace taut
{
  /**
   * Time series as CSV: sliding.csv (each sliding contact: position, force, gap), links.csv (force
   * and gap of every fixed link), supports.csv (force of every support on its wire), probes.csv,
   * certificate.csv. A file without content is not made.
   */
  class Series : public Observer
  {
  public:
    /// @p interval and @p link_interval: least time between two lines [s]; 0: every step.
    Series(const std::string &folder, const Scene &scene, const ContactRows &rows, double interval,
           double link_interval);

    void record(const StepView &step) override;

    /// Writes the rest. Throws UserError when the disk is full.
    void close();

  private:
    void open(std::unique_ptr<CsvFile> &file, const std::string &name,
              std::vector<std::string> columns);

    std::string folder;
    double interval, link_interval;
    double next = 0., next_link = 0.;
    std::unique_ptr<CsvFile> sliding, links, supports, probes, certificate;
  };
} // namespace taut

#endif
