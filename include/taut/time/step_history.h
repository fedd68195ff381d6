// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_step_history_h
#define taut_step_history_h

#include <taut/time/balance_certificate.h>
#include <taut/time/integrator.h>
#include <taut/time/state.h>
#include <taut/time/step_equations.h>

#include <vector>

namespace taut
{
  /**
   * What a step inherits: of each body of this rank the right-hand side P^ before the multipliers,
   * and the state at the end of the step once its increments are known. Vectors that are not needed
   * at the same time share their storage; each has a name of its own here.
   */
  class StepHistory
  {
  public:
    /// The structure and the reference are kept by reference.
    StepHistory(const Structure &structure, const Reference &reference);

    /// External forces at a time [s], minus the forces of the reference.
    void set_external_forces(double time);

    /**
     * P^_k = P - K U + kappa r - C v* - M a*, with the balance r of the step before, v* the part of
     * the velocity that is known and a* that of the mean acceleration, see StepCoefficients; and
     * what moving supports prescribe. Into loads().
     */
    void set_loads(const StepCoefficients &c, const StepEquations &equations, State &state);

    /// P^ after set_loads().
    BodyVectors &loads() { return shared; }

    /// dU, which StepEquations::find_increments() makes of loads().
    BodyVectors &increments() { return shared; }

    /// Increments of the DoFs that moving supports prescribe; the others are zero [m, rad].
    const BodyVectors &lift() const { return prescribed; }

    /// Puts them into @p dU.
    void impose_lift(BodyVectors &dU) const;

    /// Hands the increments over to the state, and takes what the step began with in exchange.
    void exchange(State &state);

    /// After exchange(): displacement, velocity and acceleration of rows begin to end - 1 of body
    /// k.
    void accept(const StepCoefficients &c, std::size_t k, std::size_t begin, std::size_t end,
                State &state) const;

    /// What the balance at the end of the step lacks of each body, into loads(): the right-hand
    /// side of a refinement.
    void set_lacking(const StepCoefficients &c, const StepEquations &equations, State &state);

    /// Adds a correction, which is in increments(), to the state.
    void add_correction(const StepCoefficients &c, State &state);

    const StepForces &forces() const { return step_forces; }

  private:
    void set_external_force(std::size_t k, double time);
    void set_load(std::size_t k, const StepCoefficients &c, const State &state);

    const Structure &structure;
    const Reference &reference;
    StepForces step_forces;
    BodyVectors shared, prescribed;
    std::vector<double> known_v, mean_a; ///< as long as the longest body
    std::vector<double> damping_of_tile, inertia_of_tile;
  };
} // namespace taut

#endif
