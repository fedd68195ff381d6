// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_body_step_h
#define taut_body_step_h

#include "time/balance_residual.h"
#include "time/prescribed_motions.h"
#include "time/step_equations.h"
#include <taut/time/state.h>
#include <taut/time/step_report.h>

#include <vector>

namespace taut
{
  /// The history of a step: the right-hand side P^ of each body of this rank without multipliers,
  /// and the state at the end of the step for known increments. Vectors with separate lifetimes
  /// share storage under different names.
  class BodyStep
  {
  public:
    /// The arguments are kept by reference.
    BodyStep(const Structure &structure, const Reference &reference, const StepMethod &method);

    /// Sets the external forces at a time [s], minus the forces of the reference.
    void set_external_forces(double time);

    /// Sets loads() to P^_k = P - K U + kappa r - C v* - M a* plus prescribed motions. r is the
    /// balance of the step before, v* the known part of the velocity, and a* the known part of the
    /// mean acceleration, see StepCoefficients.
    void set_loads(const StepEquations &equations, State &state);

    /// P^ after set_loads().
    BodyVectors &loads() { return shared; }

    /// dU, after StepEquations::find_increments() replaced loads().
    BodyVectors &increments() { return shared; }

    const PrescribedMotions &prescribed() const { return motions; }
    PrescribedMotions &prescribed() { return motions; }

    /// Puts the vectors of the state at the start of the step aside, and the increments in.
    void exchange(State &state);

    /// Begins a step.
    void keep() { is_exchanged = false; }

    /// Puts back what exchange() put aside since keep(), if anything.
    void take_back(State &state);

    /// After exchange(): sets displacement, velocity and acceleration of body k.
    void accept(std::size_t k, State &state) const;

    /// Sets loads() for a refinement: the residual of the balance at the end of the step.
    void set_lacking(const StepEquations &equations, State &state);

    /// Adds the correction in increments() to the state.
    void add_correction(State &state);

    const StepForces &forces() const { return step_forces; }

  private:
    void exchange_old(State &state);
    void set_external_force(std::size_t k, double time);
    void set_load(std::size_t k, const State &state);

    const Structure &structure;
    const Reference &reference;
    const StepMethod &method;
    StepForces step_forces;
    PrescribedMotions motions;
    BodyVectors shared;
    bool is_exchanged = false;
    std::vector<double> known_v, mean_a, damping, inertia; ///< as long as the longest body
  };
} // namespace taut

#endif
