// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_balance_residual_h
#define taut_balance_residual_h

#include "time/matrix_norms.h"
#include "time/nonlinear_bodies.h"
#include <taut/interface/constraints.h>
#include <taut/time/state.h>
#include <taut/time/step_report.h>

#include <functional>
#include <string>
#include <vector>

namespace taut
{
  /// External forces on the bodies of this rank, and their state before the step.
  struct StepForces
  {
    BodyVectors P;                     ///< external force minus that of the reference [N, N m]
    std::vector<ByKind> external_size; ///< largest entries of P of each body

    BodyVectors old_U, old_V_old, old_A; ///< as in State
    BodyVectors old_dU, old_KU, old_balance;
  };

  /**
   * The residual of the equation of motion of each body (see StepCoefficients): a measure of how
   * well a step solves it. Products with M, C and K of the new state give the residual; the factors
   * of A take no part. It is relative to the size of its terms, for displacements and for slopes
   * separately.
   */
  class BalanceResidual
  {
  public:
    /// The arguments are kept by reference.
    BalanceResidual(const Structure &structure, const Constraints &constraints,
                    const Reference &reference, const StepMethod &method,
                    const NonlinearBodies &nonlinear);

    /**
     * Forms K U and r = P + B N - C V - K U of the state after a step, and the residual() of its
     * equation of motion. @p in_balance are the multipliers in r. @p impulsive are the forces that
     * act in this step only; empty: none. Throws an EntryError on the section of a body with
     * numbers beyond largest_number.
     */
    void measure(const StepForces &forces, const std::vector<double> &in_balance,
                 const std::vector<double> &impulsive, State &state);

    /// Largest relative residual of this rank's bodies after measure(); not-a-number if one is.
    double residual() const { return largest_residual; }

    /// With mean forces, after measure(): work dU . [(1 - alpha_f) r + alpha_f r0] on body k of
    /// this rank by all forces but the mean forces of this step [J].
    double work(const std::size_t k) const { return work_of_balance[k]; }

    std::size_t worst_body() const { return worst; }

    /// True if all residuals of this rank's bodies are at most 1e-10 of their terms plus |K||dU|:
    /// |K||dU| cancels if the increment is large against the displacement after the step.
    bool is_cancellation() const { return may_be_cancellation; }

  private:
    /// Largest entries of the residual of a body and of its terms.
    struct Sizes
    {
      ByKind residual = {0., 0.}, increment = {0., 0.}, velocity = {0., 0.},
             displacement = {0., 0.};
    };

    Sizes measure_body(std::size_t k, const StepForces &forces, bool has_impulses, State &state);
    double relative_residual(std::size_t k, const StepForces &forces, const Sizes &sizes,
                             double time);

    const Structure &structure;
    const Constraints &constraints;
    const StepMethod &method;
    const NonlinearBodies &nonlinear;
    std::vector<std::array<RowSumNorm, 3>> norms; ///< of M, C, K of each body
    std::vector<ByKind> reference_force;          ///< largest entry, of each body [N, N m]
    std::vector<ByKind> contact_force;    ///< largest of a constraint, on each body [N, N m]
    BodyVectors impulses;                 ///< forces in this step only
    std::vector<double> mean_A;           ///< mean acceleration of one body in the step
    std::vector<double> inertia, damping; ///< forces of one body
    std::vector<double> work_of_balance;  ///< of each body [J]
    double largest_residual = 0.;
    std::size_t worst = 0;
    bool may_be_cancellation = true;
  };
} // namespace taut

#endif
