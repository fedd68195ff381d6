// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_study_h
#define taut_study_h

#include "study/case_runner.h"
#include "study/refined_reference.h"
#include <taut/simulation/parameters.h>

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace taut
{
  /// One setting of a study: a value for each parameter list, and the results of its runs.
  struct StudySetting
  {
    std::vector<std::string> values;
    std::string message;            ///< reason of a failure; empty if the setting ran
    std::vector<double> quantities; ///< [unit of each quantity]
    std::vector<double> errors;     ///< relative, of each quantity
    std::vector<double> bounds;     ///< largest errors of this and all finer settings
    double error = 0.;              ///< the largest of the errors
    double bound = 0.;              ///< the largest of the bounds
    double reference_error = 0.;    ///< relative, the largest of all references
    std::vector<double> seconds;    ///< of the loop over the steps without output, of each run
    double seconds_with_output = 0.;
    /// The most of a coarser setting, where each runs once and one of them may be disturbed [s].
    double coarser_seconds = 0.;
    double certificate = 0.; ///< largest residual of any step [1]
    long n_steps = 0;
    bool is_on_front = false; ///< no other setting is both cheaper and surely more accurate

    double least_seconds() const;

    /// What a choice compares: the least seconds, but no less than coarser_seconds.
    double cost() const;
    double median_seconds() const;
  };

  /// The results of a study.
  struct StudyResult
  {
    std::vector<ParameterList> parameter_lists;
    std::vector<std::string> quantity_names;
    std::vector<QuantityReference> references;
    std::vector<StudySetting> settings;
    double end_time = 0.;    ///< [s]
    bool is_partial = false; ///< ended early: settings or repeated runs are missing
  };

  /**
   * Measures error against cost (work-precision diagram). A study runs a scene with every
   * combination of the values of the parameter lists in its section Study. It measures the cost of
   * each setting, and the errors of its quantities against their references. Cost is processor
   * time, on which other work on the machine has less effect.
   */
  class Study
  {
  public:
    /// @p overrides as for Parameters::read(). Throws UserError. Messages go to @p log.
    Study(const std::string &file, const std::vector<std::string> &overrides, bool overwrite,
          std::ostream &log);

    /// As Simulation::stop_if(), asked after each step of each run.
    void stop_if(std::function<int()> asked) { stop_asked = std::move(asked); }

    /**
     * Runs all settings and writes work_precision.csv and study.json. A setting that cannot be run
     * is a row with its error. Throws UserError, and Interrupted if stop_if() asked to stop: the
     * files then have the settings measured until then, and no file is written without any.
     */
    const StudyResult &run();

  private:
    void make_settings();
    void measure_settings();
    void keep_measured_settings();
    void write_results();
    void find_references();
    std::vector<std::string> reference_values(unsigned int level) const;
    MeasuredRun run_once(const std::vector<std::string> &values, bool with_output,
                         bool with_quantities) const;
    void set_origins(Parameters &chosen) const;
    void run_setting(StudySetting &setting, bool first) const;
    void compare(StudySetting &setting, const std::vector<StudyQuantity> &quantities) const;

    std::string file;
    std::vector<std::string> overrides;
    bool overwrite;
    std::ostream &log;
    Parameters parameters;
    StudyResult result;
    std::function<int()> stop_asked;
  };

  /**
   * Sets StudySetting::bounds and bound. A setting is finer than another if its values on the
   * refined parameter lists are at most those of the other setting, and equal elsewhere. Errors of
   * step and mesh may cancel by chance, and a scheme may fail at small steps. So an accuracy counts
   * only if all finer settings that ran have it, too.
   */
  void find_bounds(const std::vector<ParameterList> &parameter_lists,
                   std::vector<StudySetting> &settings);

  /// Sets StudySetting::is_on_front, by cost and bound.
  void find_front(std::vector<StudySetting> &settings);

  /// The setting of least cost, of several with the same the coarsest, for which the sum of its
  /// bound and of the error of the reference is at most @p accuracy, or null.
  const StudySetting *cheapest(const std::vector<StudySetting> &settings, double accuracy);

  /// The cheapest setting for one quantity alone.
  const StudySetting *cheapest(const StudyResult &result, std::size_t quantity, double accuracy);
} // namespace taut

#endif
