// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_nonlinear_bodies_h
#define taut_nonlinear_bodies_h

#include <taut/substructure/factored_structure.h>
#include <taut/time/integrator.h>
#include <taut/time/matrix_norms.h>
#include <taut/time/state.h>

#include <array>
#include <memory>
#include <vector>

namespace taut
{
  /// The largest entries of a force on a body, as far as they stand out against what rounding
  /// leaves of its internal force, see Substructure::rounding_of_force() [N, N m].
  PerKind significant_part(const Substructure &body, const PerKind &largest_force);

  /**
   * The bodies of this rank whose internal force f is not K U, through one step. Their f at the end
   * of the step takes the place of K U. With mean forces it is what makes its average with f0 the
   * mean force of an energy-momentum scheme (J. C. Simo, N. Tarnow, Z. angew. Math. Phys. 43
   * (1992); O. Gonzalez, J. Nonlinear Sci. 6 (1996)),
   *
   *     f = 2 f_mean(U0, U) - f0,
   *
   * so that the equation of motion reads as that of a linear body.
   */
  class NonlinearBodies
  {
  public:
    /// Of no body.
    NonlinearBodies() = default;

    /// The references are kept.
    NonlinearBodies(const Structure &structure, const Reference &reference);

    /// Their indices among the bodies of this rank.
    const std::vector<std::size_t> &indices() const { return bodies; }

    /// Begins a step [s] from a state; the first guess of its increments is zero.
    void begin(const State &before, const StepCoefficients &c, double step);

    /**
     * The tangent of f for the last guess. @p attempt 0 is the exact one, 1 the definite one, from
     * 2 on with more and more of the mass matrix added.
     */
    std::unique_ptr<SymmetricMatrix> tangent(std::size_t k, int attempt) const;

    /// What Newton's method adds to P^, with the tangent K: K dU - (f - f0) for the last guess.
    const std::vector<double> &remainder(std::size_t k) const { return steps[k].remainder; }

    /// Takes @p K as the tangent for the last guess.
    void set_tangent(std::size_t k, const SymmetricMatrix &K);

    /**
     * Takes @p dU, the solution with the last remainder, as the next guess and evaluates f. Returns
     * what it misses: the largest change from the last guess over the largest entry, or, if that is
     * less, a hundred times the force that its balance lacks, which is the change of the remainder,
     * over the largest internal force. Displacements and slopes each for themselves; not-a-number
     * if f is.
     */
    double set_guess(std::size_t k, const std::vector<double> &dU, const SymmetricMatrix &K);

    /// KU = f - f_ref at the end of a step that ends in @p state.
    void set_end_force(std::size_t k, const StepCoefficients &c, State &state) const;

    /// Of a body of indices(), the change of its energy in the step to @p state minus the work that
    /// went into it, of a force that is @p part_of_end that of the end and else that of the start.
    /// Half: zero where the mean force is that of the energy, negative where material damping takes
    /// some [J].
    double energy_surplus(std::size_t k, double part_of_end, const State &state);

    /// After a step with mean forces: the internal force of the state itself, and the balance
    /// with it.
    void set_own_force(State &state);

  private:
    struct Step
    {
      std::vector<double> U0;      ///< from the undeformed body [m, rad]
      std::vector<double> f0;      ///< minus that of the reference [N, N m]
      std::vector<double> known_V; ///< velocity at the end without the increment's part
      std::vector<double> dU;      ///< the guess
      std::vector<double> f;       ///< with it
      std::vector<double> remainder;
      std::vector<double> U1;       ///< that the last step ended with, as U0
      double energy = 0.;           ///< there [J]
      bool energy_is_known = false; ///< U0 is U1
    };
    const std::vector<double> &end_of_step(std::size_t k, const State &state);
    void end_force(std::size_t k, const StepCoefficients &c, const Step &own,
                   const std::vector<double> &dU, std::vector<double> &f) const;

    const Structure *structure = nullptr;
    const Reference *reference = nullptr;
    std::vector<std::size_t> bodies;
    std::vector<Step> steps; ///< of each body of this rank, linear ones too
    StepCoefficients c;
    double step = 0.;
    std::vector<double> last_dU, last_remainder, own_force;
    std::array<std::vector<double>, 3> tile;  ///< rows of set_guess()
    mutable std::vector<double> end_U, end_V; ///< of end_force()
  };
} // namespace taut

#endif
