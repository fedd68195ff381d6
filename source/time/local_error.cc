// SPDX-License-Identifier: LGPL-2.1-or-later
#include "time/local_error.h"
#include <taut/substructure/body_traits.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace taut
{
  LocalError::LocalError(const Structure &structure, const Constraints &constraints,
                         const Reference &reference)
      : structure(structure), reference(reference),
        wholes(structure, constraints,
               [&](const std::size_t i) { return constraints[i].is_cut(); }),
        mass_of_whole(wholes.n_groups(), 0.)
  {
    const std::vector<double> of_bodies = total_masses(structure);
    for (std::size_t k = 0; k < structure.size(); ++k)
      if (!structure[k].is_lumped())
        mass_of_whole[wholes.of_body(k)] += of_bodies[k];
    structure.communicator().sum(mass_of_whole);
  }

  /// Sets the error of the motion of a body in a step, and the further change of velocities by
  /// impulses times the step.
  void LocalError::set_error(const OfStep &of, const std::size_t k)
  {
    const std::vector<double> &dU = of.state.dU[k], &V = of.state.V[k], &V0 = of.state.V_old[k],
                              &A = of.state.A[k], &A0 = of.old_A[k];
    const double step = of.state.last_step,
                 mean = step * step / (6. * (1. + of.step_before / step));
    motion.resize(dU.size());
    impulse.resize(dU.size());
    for (std::size_t i = 0; i < dU.size(); ++i)
    {
      motion[i] = of.method.has_means() ? mean * (A[i] - A0[i])
                                        : dU[i] - step * (V0[i] + step * (A0[i] / 3. + A[i] / 6.));
      impulse[i] = of.method.corrects_velocities ? step * (V[i] - V0[i] - step * A[i]) : 0.;
    }
    // A prescribed place has no error, but its kinks and jumps need short steps.
    for (const ConstrainedDof &constraint : structure[k].constraints())
    {
      const unsigned int i = constraint.dof;
      motion[i] = dU[i] - .5 * step * (V0[i] + V[i]);
      impulse[i] = 0.;
    }
  }

  /// Multipliers of internal constraints are no motions, and may be rounding.
  ByKind LocalError::largest_of(const std::size_t k, std::vector<double> &x) const
  {
    if (dynamic_cast<const ConstrainedBody *>(&structure[k]))
      for (const unsigned int dof : structure[k].dofs_without_mass())
        x[dof] = 0.;
    return max_norms(structure[k], x);
  }

  double LocalError::measure(const State &state, const StepMethod &method, const double step_before,
                             const BodyVectors &old_A)
  {
    ByKind error = {0., 0.}, size = {0., 0.};
    std::array<std::vector<double>, 2> squares; // errors of elements: motions and impulses
    for (std::vector<double> &of_wholes : squares)
      of_wholes.assign(wholes.n_groups(), 0.);
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      set_error({state, method, step_before, old_A}, k);
      const std::size_t whole = wholes.of_body(k);
      if (!structure[k].is_lumped() && mass_of_whole[whole] > 0.)
      {
        squares[0][whole] += square(k, motion);
        squares[1][whole] += square(k, impulse);
      }
      else
        for (std::vector<double> *const e : {&motion, &impulse})
        {
          const ByKind all = largest_of(k, *e);
          for (int kind = 0; kind < 2; ++kind)
            error[kind] = std::max(error[kind], all[kind]);
        }
      motion = state.V_old[k];
      const ByKind v = largest_of(k, motion);
      copy_displacement(reference, state, k, motion);
      const ByKind u = largest_of(k, motion);
      for (int kind = 0; kind < 2; ++kind)
        size[kind] = std::max(size[kind], u[kind] + state.last_step * v[kind]);
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
      largest_motions[kind] =
          std::max(largest_motions[kind], structure.communicator().max(size[kind]));
      const double all = structure.communicator().max(error[kind]);
      if (all > 0.)
        result = std::max(result, all / largest_motions[kind]);
    }
    return result;
  }

  double LocalError::square(const std::size_t k, const std::vector<double> &x)
  {
    product.assign(structure[k].n_dofs(), 0.);
    structure[k].mass().vmult_add(1., x.data(), product.data());
    return std::inner_product(product.begin(), product.end(), x.begin(), 0.);
  }
} // namespace taut
