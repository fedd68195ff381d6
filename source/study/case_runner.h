// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_case_runner_h
#define taut_case_runner_h

#include "model/shared_parts.h"
#include "study/quantity_recorder.h"
#include <taut/output/statistics.h>
#include <taut/simulation/parameters.h>

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace taut
{
  /// The result of a case of a sweep.
  struct CaseResult
  {
    std::vector<NamedQuantity> quantities;
    Residuals worst; ///< largest residuals of any step
    std::vector<Warning> warnings;
  };

  /**
   * Runs cases of one parameter file one after the other, on this process alone and without files;
   * Sweep uses it. Parts that cases have in common are made once: the parameters, the form of the
   * line, the wires (SharedParts). Each case has the bits of a run of its own.
   */
  class CaseRunner
  {
  public:
    /// @p overrides of all cases, as for Parameters::read().
    CaseRunner(std::string file, std::vector<std::string> overrides)
        : file(std::move(file)), overrides(std::move(overrides))
    {
    }

    /// As Parameters::set_origin(), for all cases to come.
    void set_origin(const std::string &entry, const std::string &place) { origins[entry] = place; }

    /// As Simulation::stop_if(), asked after each step.
    void stop_if(std::function<int()> asked) { stop_asked = std::move(asked); }

    /// The quantities of a case, from the scene in the file and without a run. Throws UserError.
    std::vector<NamedQuantity> quantities();

    /// Runs the case with these entries, "Section/Entry=value": the same entries in each case.
    /// Throws UserError, and Interrupted if stop_if() asked to stop.
    CaseResult run(const std::vector<std::string> &entries);

  private:
    void set_parameters(const std::vector<std::string> &entries);

    std::string file;
    std::vector<std::string> overrides;
    std::map<std::string, std::string> origins;
    std::function<int()> stop_asked;
    std::unique_ptr<Parameters> parameters; ///< of the last case; none before the first one
    SharedParts shared;
  };

  /// The quantities and the cost of one run of a study.
  struct MeasuredRun
  {
    std::vector<StudyQuantity> quantities;
    double seconds = 0.;     ///< processor time of the loop over the steps [s]
    double certificate = 0.; ///< largest residual of any step [1]
    long n_steps = 0;
    std::string unseen; ///< what lies between its steps, in words; empty: nothing
  };

  /// Throws EntryError if the scene cannot be built, or lacks a quantity of its section Study.
  void check_quantities(const Parameters &parameters);

  /// Runs a scene with fixed steps. Without @p with_quantities it measures the cost alone.
  /// @p stop_asked as for Simulation::stop_if(). Throws UserError and Interrupted.
  MeasuredRun measure_run(const Parameters &parameters, bool with_quantities,
                          const std::function<int()> &stop_asked);
} // namespace taut

#endif
