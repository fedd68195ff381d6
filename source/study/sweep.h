// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_sweep_h
#define taut_sweep_h

#include "base/data_files.h"
#include "study/case_runner.h"
#include <taut/base/communicator.h>
#include <taut/simulation/parameters.h>

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace taut
{
  /**
   * Runs a scene once for each case of its section Sweep, and writes sweep.csv with one line per
   * case, in order. A line has the values of the entries, with the unit in the head, all quantities
   * that are one number (Statistics::named_quantities), the largest residuals of the run, and the
   * reason of a failure.
   *
   * Ranks are workers. Each worker runs its cases alone, so that the lines do not depend on the
   * number of workers. Workers meet after each batch of cases, and the lines of the batch go to the
   * disk in order.
   */
  class Sweep
  {
  public:
    /// @p overrides as for Parameters::read(). Throws UserError. Messages go to @p log.
    Sweep(const std::string &file, const std::vector<std::string> &overrides,
          const Communicator &workers, std::ostream &log);

    /// Whether to replace an earlier sweep, or to go on after its last complete line.
    void set_overwrite(bool value) { overwrite = value; }
    void set_resume(bool value) { resume = value; }

    /// As Simulation::stop_if(), asked after each step of each run.
    void stop_if(std::function<int()> asked) { runner.stop_if(stop_asked = std::move(asked)); }

    /**
     * Runs all cases without a line. A case that cannot be run is a line with its error. Throws
     * UserError, and Interrupted if stop_if() asked to stop: the lines of the cases until then are
     * written. Called by all ranks together.
     */
    void run();

  private:
    std::string sweep_folder() const;
    std::string title_of(const SweptParameter &parameter) const;
    void name_columns();
    void prepare_folder();
    void keep_data_files();
    void continue_table(const std::string &table);
    void share_columns();
    std::size_t run_batch(std::size_t n_each);
    std::string run_case(std::size_t number);
    std::string numbers_of(std::size_t number);
    void append(const std::string &lines) const;

    const Communicator workers;
    std::ostream &log;
    bool overwrite = false, resume = false;
    Parameters parameters;
    CaseRunner runner;
    std::vector<SweptParameter> swept;
    std::vector<std::vector<std::string>> cases;
    std::vector<std::string> names; ///< of the quantities, "item: quantity [unit]"
    std::string header;
    std::size_t n_done = 0;
    bool is_resumed = false;
    DataFiles kept; ///< in the folder, as this worker read them
    std::function<int()> stop_asked;
  };
} // namespace taut

#endif
