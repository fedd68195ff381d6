// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_nonlinear_bodies_h
#define taut_nonlinear_bodies_h

#include "time/matrix_norms.h"
#include "time/prescribed_motions.h"
#include <taut/substructure/factored_structure.h>
#include <taut/time/state.h>
#include <taut/time/step_report.h>

#include <array>
#include <memory>
#include <vector>

namespace taut
{
  /// Largest entries of a force on a body, or 0 below the rounding of its internal force, see
  /// Substructure::rounding_of_force() [N, N m].
  ByKind significant_part(const Substructure &body, const ByKind &largest_force);

  /**
   * The bodies of this rank with an internal force f other than K U, through one step. Their f at
   * the end of the step replaces K U. With mean forces, f makes its average with f0 the mean force
   * of an energy-momentum scheme (J. C. Simo, N. Tarnow, Z. angew. Math. Phys. 43 (1992); O.
   * Gonzalez, J. Nonlinear Sci. 6 (1996)),
   *
   *     f = 2 f_mean(U0, U) - f0,
   *
   * so that the equation of motion is that of a linear body.
   */
  class NonlinearBodies
  {
  public:
    /// The arguments are kept by reference.
    NonlinearBodies(const Structure &structure, const Reference &reference,
                    const StepMethod &method);

    /// Indices of the nonlinear bodies among the bodies of this rank.
    const std::vector<std::size_t> &indices() const { return bodies; }

    /// Begins a step from a state. The first guess of its increments is zero.
    void begin(const State &before);

    /// After begin(): sets the known velocities of DoFs with prescribed motions.
    void prescribe(const PrescribedMotions &motions);

    /// The tangent of f at the last guess. @p attempt 0 is exact, 1 is definite, and from 2 on an
    /// increasing part of the mass matrix is added.
    std::unique_ptr<SymmetricMatrix> tangent(std::size_t k, int attempt) const;

    /// Addition of Newton's method to P^ with the tangent K: K dU - (f - f0) at the last guess.
    const std::vector<double> &remainder(std::size_t k) const { return steps[k].remainder; }

    /// Sets @p K as the tangent at the last guess.
    void set_tangent(std::size_t k, const SymmetricMatrix &K);

    /**
     * Sets @p dU, the solution with the last remainder, as the next guess and evaluates f. Returns
     * its error: the largest change from the last guess over the largest entry. If smaller, returns
     * a hundred times the residual force, the change of the remainder, over the largest internal
     * force. Displacements and slopes count separately. Not-a-number if f is.
     */
    double set_guess(std::size_t k, const std::vector<double> &dU, const SymmetricMatrix &K);

    /// Sets KU = f - f_ref at the end of a step with the end @p state.
    void set_end_force(std::size_t k, State &state) const;

    /// Change of the energy of body k of indices() in the step to @p state, minus the work of its
    /// force: @p part_of_end of that at the end, the rest at the start. At 1/2 it is zero if the
    /// mean force conserves energy, and negative with material damping [J].
    double energy_surplus(std::size_t k, double part_of_end, const State &state);

    /// After a step with mean forces: sets the internal force of the state, and its balance.
    void set_own_force(State &state);

  private:
    struct Step
    {
      std::vector<double> U0;      ///< displacement from the undeformed body [m, rad]
      std::vector<double> seen_U0; ///< where its forces see the body, see SlenderBody::disturb()
      std::vector<double> f0;      ///< minus the force of the reference [N, N m]
      std::vector<double> known_V; ///< velocity at the end without the part of the increment
      std::vector<double> dU;      ///< the guess
      std::vector<double> f;       ///< internal force of the guess
      std::vector<double> remainder;
      std::vector<double> U1;       ///< as U0, at the end of the last step
      double energy = 0.;           ///< at U1 [J]
      bool energy_is_known = false; ///< U0 is U1
    };
    const std::vector<double> &end_of_step(std::size_t k, const State &state);
    /// Sets end_U and end_V, those of the increments @p dU.
    void set_end(const Step &own, const std::vector<double> &dU) const;
    void end_force(std::size_t k, const Step &own, const std::vector<double> &dU,
                   std::vector<double> &f) const;

    const Structure &structure;
    const Reference &reference;
    const StepMethod &method;
    std::vector<std::size_t> bodies;
    std::vector<Step> steps; ///< for each body of this rank, linear or not
    std::vector<double> last_dU, last_remainder, whole_force, own_force;
    mutable std::vector<double> end_U, end_V; ///< see set_end()
  };
} // namespace taut

#endif
