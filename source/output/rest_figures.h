// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_rest_figures_h
#define taut_rest_figures_h

#include "output/contact_tables.h"
#include <taut/output/observer.h>
#include <taut/output/statistics.h>

#include <string>
#include <vector>

namespace taut
{
  /// The answer of a run at rest: what contacts of surfaces and links carry, and the largest
  /// displacement, for the log and statistics.json.
  class RestFigures : public Observer
  {
  public:
    /// @p tables, which records before this, has the contacts; nullptr: there are none, or no
    /// files.
    RestFigures(const Scene &scene, const ContactTables *tables) : scene(scene), tables(tables) {}

    void record(const StepView &step) override;
    void report(std::ostream &log, bool failed) const override;

    /// Throws UserError if the file cannot be written.
    void write(const std::string &path, const RunDescription &run,
               const std::vector<NamedQuantity> &others) const;

  private:
    struct LinkAtRest
    {
      std::string name;
      double force, gap;
      bool rotational;
    };

    const Scene &scene;
    const ContactTables *tables;
    std::vector<LinkAtRest> links;
    double displacement = 0.; ///< largest component [m]
    std::string moved;        ///< the body with it
  };
} // namespace taut

#endif
