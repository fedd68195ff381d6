// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_static_step_h
#define taut_static_step_h

#include "time/step.h"
#include <taut/time/static_equilibrium.h>

#include <vector>

namespace taut
{
  /// The step at rest from a state U, at first the undeformed one, to f(U) + K dU = P + B N. No
  /// constraint turns in it.
  class StaticStep
  {
  public:
    /// All but @p U, a displacement from the undeformed bodies [m, rad], are kept by reference; t
    /// in s.
    StaticStep(const Structure &structure, const Constraints &constraints,
               const SolverParameters &parameters, double t, const BodyVectors &U);
    StaticState solve();

    /// After solve(): which constraints are closed. Another step near this one starts from them.
    const std::vector<char> &closed() const { return step.contacts().applied().closed; }
    void start_from(const std::vector<char> &rows) { step.equations().start_from(rows); }

    /// After solve(): the residuals of its result.
    Residuals certify();

    /// True if all tangents are those of the bodies and positive definite.
    bool has_own_tangents() const { return step.equations().has_own_tangents(); }

    /**
     * After solve(): the displacements along springs of the constraints, given by their @p rows,
     * that unit forces along each of them cause, with all other closed constraints closed and
     * those that just touch, too [m/N]. False if there is no such answer, as of a body that nothing
     * holds.
     */
    bool flexibility(const std::vector<std::size_t> &rows,
                     std::vector<std::vector<double>> &result);

    const FactoredStructure &bodies() const { return step.equations().bodies(); }

    /// Joints that repeat others, found by solve(), or before it by that of an earlier step.
    const RepeatedRows &repeated_rows() const { return step.equations().repeated_rows(); }
    void set_repeated_rows(const RepeatedRows &rows) { step.equations().set_repeated_rows(rows); }

  private:
    void find_increments();
    void fail_not_held(const BodyNotHeld &e) const;
    double relative_remainder() const;
    void refine();

    const Structure &structure;
    const Constraints &constraints;
    const Reference undeformed;
    State state;
    const StepMethod method;
    NonlinearBodies nonlinear;
    const TurningConstraints none;
    Step step;
    BodyVectors P; ///< P^ of the step
    Residuals residuals;
  };
} // namespace taut

#endif
