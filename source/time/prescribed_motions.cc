// SPDX-License-Identifier: LGPL-2.1-or-later
#include "time/prescribed_motions.h"
#include "substructure/motion_rate.h"

#include <algorithm>
#include <cmath>

namespace taut
{
  PrescribedMotions::PrescribedMotions(const Structure &structure, const Reference &reference,
                                       const StepMethod &method)
      : structure(structure), reference(reference), method(method), moving(structure.size()),
        dU(structure.zero()), body_lifts(structure.size(), 0)
  {
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      const std::vector<ConstrainedDof> &all = structure[k].constraints();
      for (std::size_t j = 0; j < all.size(); ++j)
        if (all[j].motion)
          moving[k].push_back({j, all[j].dof});
      some_move = some_move || !moving[k].empty();
    }
    some_move = structure.communicator().any(some_move);
  }

  /// What does not move in time is where it belongs after its first increment.
  void PrescribedMotions::set(const State &state)
  {
    lifts = false;
    has_rates = some_move && method.has_velocity_conditions();
    if (has_rates && rate_lift.empty())
      rate_lift = structure.zero();
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      body_lifts[k] = 0;
      if (!structure[k].has_displaced_constraints())
        continue;
      for (const ConstrainedDof &constraint : structure[k].constraints())
      {
        const unsigned int dof = constraint.dof;
        dU[k][dof] = constraint.at(state.time) - (reference.displacement[k][dof] + state.U[k][dof]);
        body_lifts[k] = body_lifts[k] || dU[k][dof] != 0.;
      }
      lifts = lifts || body_lifts[k];
      if (!method.c.is_at_rest())
        for (Moving &one : moving[k])
          set_rates(k, one, state);
    }
  }

  void PrescribedMotions::set_rates(const std::size_t k, Moving &one, const State &state)
  {
    const StepCoefficients &c = method.c;
    const std::function<double(double)> &u = structure[k].constraints()[one.constraint].motion;
    const unsigned int dof = one.dof;
    const double step = state.last_step, way = dU[k][dof], v0 = state.V[k][dof];
    one.v = rate_of_motion(u, state.time, step);
    one.mean_v = way / step + .5 * (one.v - v0);
    one.a = (one.v - v0) / step;
    if (has_rates)
      rate_lift[k][dof] = step * (v0 + (1. - c.alpha_f) * (one.v - v0)) - way;
    // From the middles of two steps to the time of the acceleration.
    if (before > 0.)
      one.a += (1. + 2. * (c.alpha_m - c.alpha_f)) * step / (step + before) *
               (one.a - (v0 - state.V_old[k][dof]) / before);
  }

  void PrescribedMotions::impose_increments(BodyVectors &U) const
  {
    for (std::size_t k = 0; k < structure.size(); ++k)
      if (structure[k].has_displaced_constraints())
        for (const ConstrainedDof &constraint : structure[k].constraints())
          U[k][constraint.dof] = dU[k][constraint.dof];
  }

  void PrescribedMotions::impose_velocities(State &state) const
  {
    for (std::size_t k = 0; k < moving.size(); ++k)
      for (const Moving &one : moving[k])
        state.V[k][one.dof] = one.v;
  }

  void PrescribedMotions::impose_velocities_of_step(State &state) const
  {
    for (std::size_t k = 0; k < moving.size(); ++k)
      for (const Moving &one : moving[k])
        state.V[k][one.dof] = one.mean_v;
  }

  void set_prescribed_velocities(const Structure &structure, const double step, State &state)
  {
    for (std::size_t k = 0; k < structure.size(); ++k)
      for (const ConstrainedDof &constraint : structure[k].constraints())
        if (constraint.motion)
          state.V[k][constraint.dof] = rate_of_motion(constraint.motion, state.time, step);
  }
} // namespace taut
