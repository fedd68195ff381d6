// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_step_check_h
#define taut_step_check_h

#include <taut/interface/constraints.h>
#include <taut/time/certificate.h>

#include <functional>
#include <optional>
#include <string>

namespace taut
{
  /// What a step must satisfy, in time or at rest, and how it says that it does not: each function
  /// throws an EntryError that says when, what and what to do.
  class StepCheck
  {
  public:
    /// The arguments are kept by reference; @p tolerance is that of the certificate.
    StepCheck(const Structure &structure, const Constraints &constraints, const double tolerance)
        : structure(structure), constraints(constraints), tolerance(tolerance)
    {
    }

    /// The end of the step [s]; none: an equilibrium at rest.
    void set_time(const std::optional<double> &end) { time = end; }

    /// Calls @p work, which solves for multipliers, and names the constraints if it cannot.
    void solve(const std::function<void()> &work) const;

    /// That the constraints hold.
    void check_constraints(const Certificate &certificate) const;

    /// That the equations of motion hold. Called by all ranks together; @p own_balance is that of
    /// the bodies of this rank.
    void check_balance(const Certificate &certificate, double own_balance) const;

    /// "at t = 0.1 s: ", or "static equilibrium: ".
    std::string when() const;

  private:
    [[noreturn]] void fail(const std::string &what, const std::string &entry = "") const;
    std::string remedy() const;

    const Structure &structure;
    const Constraints &constraints;
    const double tolerance;
    std::optional<double> time;
  };
} // namespace taut

#endif
