// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_balance_certificate_h
#define taut_balance_certificate_h

#include <taut/interface/constraints.h>
#include <taut/time/integrator.h>
#include <taut/time/matrix_norms.h>
#include <taut/time/nonlinear_bodies.h>
#include <taut/time/state.h>

#include <functional>
#include <string>
#include <vector>

namespace taut
{
  /// What acts on the bodies of this rank from outside, and the step before.
  struct StepForces
  {
    BodyVectors P;                      ///< external force minus the reference's [N, N m]
    std::vector<PerKind> external_size; ///< largest of P of each body
    BodyVectors old_A;                  ///< of the step before [m/s^2, rad/s^2]
    BodyVectors old_balance;            ///< r of the step before [N, N m]
  };

  /**
   * How well a step satisfies the equation of motion of each body (see StepCoefficients). It is
   * measured by products with M, C and K of the new state, and not with what was factored: the
   * largest residual over the size of the terms that it is the difference of, displacements and
   * slopes each for themselves.
   */
  class BalanceCertificate
  {
  public:
    /// The arguments are kept by reference.
    BalanceCertificate(const Structure &structure, const Constraints &constraints,
                       const Reference &reference, const NonlinearBodies &nonlinear);

    /// Sets rows begin to end - 1 of displacement, velocity and acceleration of body k.
    using SetRows = std::function<void(std::size_t k, std::size_t begin, std::size_t end)>;

    /**
     * Forms K U and r = P + B N - C V - K U of the state of a step, and the residual() of its
     * equation of motion. @p in_balance are the multipliers in
     * r, @p impulsive those that are forces of this step only, empty: none. Coefficients of zero
     * are those of an equilibrium at rest. @p set_rows, if there is one, is called for all rows
     * just before they are read first: their caches serve both. Throws an EntryError on the section
     * of a body whose numbers are beyond largest_number.
     */
    void measure(const StepCoefficients &c, const StepForces &forces,
                 const std::vector<double> &in_balance, const std::vector<double> &impulsive,
                 State &state, const SetRows &set_rows = {});

    /// The largest relative residual of this rank's bodies after measure(); not-a-number if one is.
    double residual() const { return largest_residual; }

    /// dU . [(1 - alpha_f) r + alpha_f r0] of this rank's bodies after measure(), with mean forces:
    /// the work of all forces but the means of this step [J].
    double work(const std::size_t k) const { return work_of_balance[k]; }

    /// Body of the largest residual.
    std::size_t worst_body() const { return worst; }

    /// True if no residual of this rank's bodies is more than 1e-10 of its terms and of |K||dU|,
    /// which cancels where an increment is large against the displacement that it ends with.
    bool is_cancellation() const { return may_be_cancellation; }

  private:
    /// Largest entries of a body, of what the residual is a difference of.
    struct Sizes
    {
      PerKind residual = {0., 0.}, increment = {0., 0.}, velocity = {0., 0.},
              displacement = {0., 0.};
    };

    Sizes measure_body(std::size_t k, const StepCoefficients &c, const StepForces &forces,
                       bool has_impulses, State &state, const SetRows &set_rows);
    double relative_residual(std::size_t k, const StepCoefficients &c, const StepForces &forces,
                             const Sizes &sizes, double time);

    const Structure &structure;
    const Constraints &constraints;
    const NonlinearBodies &nonlinear;
    std::vector<std::array<KindNorm, 3>> norms; ///< of M, C, K of each body
    std::vector<PerKind> reference_force;       ///< largest of K U_ref of each body [N, N m]
    std::vector<PerKind> contact_force;         ///< largest of one constraint on each body [N, N m]
    BodyVectors impulses;                       ///< forces of this step only
    std::vector<double> mean_A;                 ///< accelerations that M acts on, of one body
    std::vector<double> inertia, damping;       ///< forces of a tile
    std::vector<double> work_of_balance;        ///< of each body
    double largest_residual = 0.;
    std::size_t worst = 0;
    bool may_be_cancellation = true;
  };
} // namespace taut

#endif
