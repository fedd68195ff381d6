// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/substructure/constrained_body.h>
#include <taut/time/time_stepper.h>

#include <algorithm>

namespace taut
{
  void TimeStepper::set_step(const double length)
  {
    if (length == step)
      return;
    step = length;
    segment_start = current.time;
    n_in_segment = 0;
  }

  /// A shorter step may have what this one misses.
  void TimeStepper::attempt(const std::function<void()> &work)
  {
    try
    {
      work();
    }
    catch (const UserError &why)
    {
      if (!is_linear())
        throw StepNotSolved(why);
      throw;
    }
  }

  void TimeStepper::restore(const State &before)
  {
    current = before;
    turning.follow(current);
    motion_size = before_step.motion;
    constraint_motions.set_sizes(before_step.of_constraints);
    constraints.set_courses(before_step.courses);
    if (projection && !before_step.rates.empty())
      projection->set_largest_rates(before_step.rates);
    --n_steps;
    segment_start = current.time;
    n_in_segment = 0;
  }

  double TimeStepper::local_error()
  {
    PerKind error = {0., 0.}, size = {0., 0.};
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      // Multipliers of conditions inside a body are no motions, and may be rounding.
      const std::vector<unsigned int> multipliers =
          dynamic_cast<const ConstrainedBody *>(&structure[k]) ? structure[k].dofs_without_mass()
                                                               : std::vector<unsigned int>();
      const auto largest_motion = [&](std::vector<double> &x)
      {
        for (const unsigned int dof : multipliers)
          x[dof] = 0.;
        return largest(structure[k], x);
      };
      const std::vector<double> &dU = current.dU[k], &V = current.V_old[k], &A = current.A[k],
                                &A0 = forces.old_A[k];
      const double mean = step * step / (6. * (1. + step_before / step));
      for (std::size_t i = 0; i < dU.size(); ++i)
        work_v[i] = coefficients.mean_force
                        ? mean * (A[i] - A0[i])
                        : dU[i] - step * (V[i] + step * (A0[i] / 3. + A[i] / 6.));
      const PerKind e = largest_motion(work_v);
      std::copy(V.begin(), V.end(), work_v.begin());
      const PerKind v = largest_motion(work_v);
      for (std::size_t i = 0; i < dU.size(); ++i)
        work_v[i] = reference_state.displacement[k][i] + current.U[k][i];
      const PerKind u = largest_motion(work_v);
      for (int kind = 0; kind < 2; ++kind)
      {
        error[kind] = std::max(error[kind], e[kind]);
        size[kind] = std::max(size[kind], u[kind] + step * v[kind]);
      }
    }
    double result = 0.;
    for (int kind = 0; kind < 2; ++kind)
    {
      motion_size[kind] = std::max(motion_size[kind], structure.communicator().max(size[kind]));
      const double all = structure.communicator().max(error[kind]);
      if (all > 0.)
        result = std::max(result, all / motion_size[kind]);
    }
    return result;
  }

  bool TimeStepper::rigid_constraint_changed(const State &before)
  {
    const std::vector<double> &S = constraint_motions.compliance();
    for (std::size_t i = 0; i < constraints.size(); ++i)
      if (constraints[i].unilateral && 2. * S[i] < system->interface().matrix().diagonal(i) &&
          (before.multiplier[i] > 0.) != (current.multiplier[i] > 0.))
        return true;
    return false;
  }
} // namespace taut
