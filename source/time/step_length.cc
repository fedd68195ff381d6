// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/base/text.h>
#include <taut/substructure/constrained_body.h>
#include <taut/time/contact_resolution.h>
#include <taut/time/time_stepper.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

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
    conditions.gaps().set_sizes(before_step.of_gaps);
    constraints.set_courses(before_step.courses);
    if (projection && !before_step.rates.empty())
      projection->set_largest_rates(before_step.rates);
    --n_steps;
    segment_start = current.time;
    n_in_segment = 0;
  }

  /// What the motion of a body misses in the last step, into work_v; and what impulses change of
  /// its velocities besides, times the step, into work_a.
  void TimeStepper::set_local_error(const std::size_t k)
  {
    const std::vector<double> &dU = current.dU[k], &V = current.V[k], &V0 = current.V_old[k],
                              &A = current.A[k], &A0 = forces.old_A[k];
    const double mean = step * step / (6. * (1. + step_before / step));
    for (std::size_t i = 0; i < dU.size(); ++i)
      work_v[i] = coefficients.mean_force
                      ? mean * (A[i] - A0[i])
                      : dU[i] - step * (V0[i] + step * (A0[i] / 3. + A[i] / 6.));
    for (std::size_t i = 0; i < dU.size(); ++i)
      work_a[i] = coefficients.velocity_projection ? step * (V[i] - V0[i] - step * A[i]) : 0.;
  }

  double TimeStepper::local_error()
  {
    PerKind error = {0., 0.}, size = {0., 0.};
    std::array<std::vector<double>, 2> squares; // of motions and impulses of elements
    for (std::vector<double> &of_wholes : squares)
      of_wholes.assign(wholes.n_groups(), 0.);
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
      set_local_error(k);
      const std::size_t whole = wholes.of_body(k);
      if (!structure[k].is_lumped() && mass_of_whole[whole] > 0.)
      {
        squares[0][whole] += square(k, work_v);
        squares[1][whole] += square(k, work_a);
      }
      else
        for (std::vector<double> *const e : {&work_v, &work_a})
        {
          const PerKind all = largest_motion(*e);
          for (int kind = 0; kind < 2; ++kind)
            error[kind] = std::max(error[kind], all[kind]);
        }
      const std::vector<double> &V0 = current.V_old[k];
      std::copy(V0.begin(), V0.end(), work_v.begin());
      const PerKind v = largest_motion(work_v);
      for (std::size_t i = 0; i < V0.size(); ++i)
        work_v[i] = reference_state.displacement[k][i] + current.U[k][i];
      const PerKind u = largest_motion(work_v);
      for (int kind = 0; kind < 2; ++kind)
        size[kind] = std::max(size[kind], u[kind] + step * v[kind]);
    }
    for (std::vector<double> &of_wholes : squares)
    {
      structure.communicator().sum(of_wholes);
      for (std::size_t w = 0; w < of_wholes.size(); ++w)
        if (of_wholes[w] > 0.)
          error[0] = std::max(error[0], std::sqrt(of_wholes[w] / mass_of_whole[w]));
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

  /// x . M x [kg m^2].
  double TimeStepper::square(const std::size_t k, const std::vector<double> &x)
  {
    std::vector<double> &product = work_rows;
    product.assign(structure[k].n_dofs(), 0.);
    structure[k].mass().vmult_add(1., x.data(), product.data());
    return std::inner_product(product.begin(), product.end(), x.begin(), 0.);
  }

  void TimeStepper::check_moving_contacts()
  {
    if (coefficients.mean_force || !coefficients.rings())
      return;
    const std::vector<double> &S = conditions.springs().compliance();
    ComplementarityOperator &F = system->interface().matrix();
    for (std::size_t i = constraints.first_moving(); i < constraints.size(); ++i)
      if (constraints[i].unilateral && S[i] > 0. && F.diagonal(i) > 2. * S[i] &&
          flexibilities_of_whole_bodies(constraints, {i}, F)[i] > 2. * S[i])
      {
        throw EntryError(constraints.origin(i),
                         to_text("link '", constraints[i].name,
                                 "' acts as rigid at t = ", current.time,
                                 " s: there it is stiffer than the bodies in one step, which ",
                                 integrator.description(),
                                 " does not suit. Take 'Moreau-Jean', or a smaller step"));
      }
  }
} // namespace taut
