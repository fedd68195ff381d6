// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_step_check_h
#define taut_step_check_h

#include <taut/interface/constraints.h>
#include <taut/time/residuals.h>

#include <functional>
#include <optional>
#include <string>

namespace taut
{
  /// The tests that a step must pass, in time or at rest. Each function throws an EntryError with
  /// the time, the failure and a remedy.
  class StepCheck
  {
  public:
    /// The arguments are kept by reference; @p tolerance is the bound of the residuals.
    StepCheck(const Structure &structure, const Constraints &constraints, const double tolerance)
        : structure(structure), constraints(constraints), tolerance(tolerance)
    {
    }

    /// Sets the end of the step [s]; none: an equilibrium at rest.
    void set_time(const std::optional<double> &end) { time = end; }

    /// Calls @p work, which solves for multipliers, and names the constraints on failure.
    template <typename Work>
    void solve(const Work &work) const
    {
      named(std::cref(work)); // a reference allocates nothing
    }

    /// Checks that the constraints hold. @p partners are the numbers of those that the worst one
    /// repeats. Called by all ranks together.
    void check_constraints(const Residuals &residuals,
                           const std::vector<std::size_t> &partners = {}) const;

    /// Checks that the equations of motion hold. @p own_balance is the residual of this rank's
    /// bodies. Called by all ranks together.
    void check_balance(const Residuals &residuals, double own_balance) const;

    /// "at t = 0.1 s: " or "static equilibrium: ".
    std::string when() const;

  private:
    void named(const std::function<void()> &work) const;
    void fail_contradictory(const std::vector<Constraints::Label> &rows) const;
    [[noreturn]] void fail(const std::string &what, const std::string &entry = "") const;
    std::string remedy(double residual) const;

    const Structure &structure;
    const Constraints &constraints;
    const double tolerance;
    std::optional<double> time;
  };
} // namespace taut

#endif
