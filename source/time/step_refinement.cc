// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/time/time_stepper.h>

namespace taut
{
  /**
   * Iterative refinement of an accepted step. A step whose increment is large against the
   * displacement that it ends with loses digits by cancellation; what the balance at its end lacks
   * is solved for. False, and nothing changes, if the constraints have no answer to it.
   */
  bool TimeStepper::refine()
  {
    const StepCoefficients &c = coefficients;
    const double kappa = c.old_balance();
    const double old = c.old_inertia(), now = c.new_inertia();
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      const Substructure &body = structure[k];
      system->bodies().remove_rounding(k, current.KU[k], current.balance[k]);
      std::vector<double> &left = right_hand_side[k];
      for (std::size_t i = 0; i < left.size(); ++i)
      {
        left[i] = current.balance[k][i] + kappa * forces.old_balance[k][i];
        work_a[i] = now * current.A[k][i] + old * forces.old_A[k][i];
      }
      body.mass().vmult_add(-1., work_a.data(), left.data());
      for (const ConstrainedDof &constraint : body.constraints())
        left[constraint.dof] = 0.;
    }
    if (!conditions.correct(current, *system, right_hand_side))
      return false;
    system->find_increments(conditions.corrections().multiplier,
                            conditions.corrections().mode_amplitude, right_hand_side);
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      std::vector<double> &dU = right_hand_side[k];
      for (const ConstrainedDof &constraint : structure[k].constraints())
        dU[constraint.dof] = 0.;
      for (std::size_t i = 0; i < dU.size(); ++i)
      {
        current.U[k][i] += dU[i];
        current.dU[k][i] += dU[i];
        current.V[k][i] += c.velocity * dU[i];
        current.A[k][i] += c.acceleration * dU[i];
      }
    }
    conditions.add_correction(right_hand_side, current);
    return true;
  }
} // namespace taut
