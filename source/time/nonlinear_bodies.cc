// SPDX-License-Identifier: LGPL-2.1-or-later
#include "time/nonlinear_bodies.h"
#include "time/matrix_norms.h"
#include <taut/substructure/body_traits.h>

#include <algorithm>
#include <cmath>

namespace taut
{
  namespace
  {
    /// Weight of a relative force beside a relative displacement: Newton's method ends at 1e-9, and
    /// what lacks of the force is then 1e-11, as in the balance of a linear step.
    constexpr double weight_of_force = 100.;

    /// Part of the largest stiffness over mass that is added as mass where a tangent is not
    /// definite, and by how much it grows from attempt to attempt. The last attempt of
    /// StepEquations adds 1e-10 30^7 = 2.2 times the largest stiffness.
    constexpr double first_shift = 1e-10, growth_of_shift = 30.;
  } // namespace

  ByKind significant_part(const Substructure &body, const ByKind &largest_force)
  {
    // The solution rounds, too.
    constexpr double of_all = 4.;
    ByKind result = largest_force;
    for (int kind = 0; kind < 2; ++kind)
      result[kind] = result[kind] <= of_all * body.rounding_of_force(kind) ? 0. : result[kind];
    return result;
  }

  NonlinearBodies::NonlinearBodies(const Structure &structure, const Reference &reference,
                                   const StepMethod &method)
      : structure(structure), reference(reference), method(method), steps(structure.size())
  {
    for (std::size_t k = 0; k < structure.size(); ++k)
      if (!structure[k].is_linear())
        bodies.push_back(k);
  }

  void NonlinearBodies::begin(const State &before)
  {
    const StepCoefficients &c = method.c;
    for (const std::size_t k : bodies)
    {
      Step &own = steps[k];
      own.U0 = reference.displacement[k];
      own.known_V.resize(own.U0.size());
      for (std::size_t i = 0; i < own.U0.size(); ++i)
      {
        own.U0[i] += before.U[k][i];
        own.known_V[i] = c.v_V * before.V[k][i] + c.v_A * before.A[k][i] + c.v_dU * before.dU[k][i];
      }
      own.energy_is_known = own.U0 == own.U1;
      own.seen_U0 = own.U0;
      const auto *const slender = dynamic_cast<const SlenderBody *>(&structure[k]);
      if (slender && !c.is_at_rest())
        slender->disturb(own.seen_U0);
      own.f0 = own.f = before.KU[k];
      own.dU.assign(own.U0.size(), 0.);
      own.remainder = own.dU;
    }
  }

  void NonlinearBodies::prescribe(const PrescribedMotions &motions)
  {
    for (const std::size_t k : bodies)
      motions.visit(k, [&](const unsigned int i, const double V, double)
                    { steps[k].known_V[i] = V - method.c.velocity * motions.increments(k)[i]; });
  }

  std::unique_ptr<SymmetricMatrix> NonlinearBodies::tangent(const std::size_t k,
                                                            const int attempt) const
  {
    const Substructure &body = structure[k];
    const Step &own = steps[k];
    const double velocity = method.c.velocity;
    set_end(own, own.dU);
    std::unique_ptr<SymmetricMatrix> K =
        method.has_means() ? body.mean_tangent(own.seen_U0, end_U, velocity, attempt > 0)
                           : body.tangent(end_U, end_V, velocity, attempt > 0);
    if (attempt > 1)
      K->add(first_shift * std::pow(growth_of_shift, attempt - 2) * largest_on_diagonal(*K) /
                 largest_on_diagonal(body.mass()),
             body.mass());
    return K;
  }

  void NonlinearBodies::set_tangent(const std::size_t k, const SymmetricMatrix &K)
  {
    Step &own = steps[k];
    own.remainder.resize(own.f.size());
    for (std::size_t i = 0; i < own.f.size(); ++i)
      own.remainder[i] = own.f0[i] - own.f[i];
    K.vmult_add(1., own.dU.data(), own.remainder.data());
  }

  double NonlinearBodies::set_guess(const std::size_t k, const std::vector<double> &dU,
                                    const SymmetricMatrix &K)
  {
    Step &own = steps[k];
    const Substructure &body = structure[k];
    last_dU.swap(own.dU);
    last_remainder.swap(own.remainder);
    own.dU = dU;
    end_force(k, own, dU, own.f);
    set_tangent(k, K);

    // The vectors of the last guess become differences.
    const std::size_t n = dU.size();
    for (std::size_t i = 0; i < n; ++i)
    {
      last_dU[i] -= dU[i];
      last_remainder[i] -= own.remainder[i];
    }
    whole_force.resize(n);
    for (std::size_t i = 0; i < n; ++i)
      whole_force[i] = own.f[i] + reference.force[k][i];
    const ByKind change = max_norms(body, last_dU), size = max_norms(body, dU),
                 unbalanced = max_norms(body, last_remainder), force = max_norms(body, whole_force);
    const ByKind lack = significant_part(body, unbalanced);
    double result = 0.;
    for (int kind = 0; kind < 2; ++kind)
    {
      if (!(change[kind] <= largest_number) || !(force[kind] <= largest_number))
        return std::nan("");
      if (change[kind] > 0. && lack[kind] > 0.)
        result = std::max(result, std::min(change[kind] / size[kind],
                                           weight_of_force * lack[kind] / force[kind]));
    }
    return result;
  }

  void NonlinearBodies::set_end(const Step &own, const std::vector<double> &dU) const
  {
    end_U.resize(dU.size());
    end_V.resize(dU.size());
    for (std::size_t i = 0; i < dU.size(); ++i)
    {
      end_U[i] = own.seen_U0[i] + dU[i];
      end_V[i] = own.known_V[i] + method.c.velocity * dU[i];
    }
  }

  void NonlinearBodies::end_force(const std::size_t k, const Step &own,
                                  const std::vector<double> &dU, std::vector<double> &f) const
  {
    const Substructure &body = structure[k];
    set_end(own, dU);
    const std::vector<double> &f_ref = reference.force[k];
    if (method.has_means())
    {
      body.mean_internal_force(own.seen_U0, end_U, method.length, f);
      for (std::size_t i = 0; i < f.size(); ++i)
        f[i] = 2. * (f[i] - f_ref[i]) - own.f0[i];
      return;
    }
    body.internal_force(end_U, end_V, f);
    for (std::size_t i = 0; i < f.size(); ++i)
      f[i] -= f_ref[i];
  }

  void NonlinearBodies::set_end_force(const std::size_t k, State &state) const
  {
    if (!method.c.is_at_rest())
    {
      const Step &own = steps[k];
      if (state.dU[k] == own.dU) // the last guess
        state.KU[k] = own.f;
      else
        end_force(k, own, state.dU[k], state.KU[k]);
      return;
    }
    std::vector<double> &KU = state.KU[k];
    structure[k].internal_force(displacement(reference, state, k), {}, KU);
    for (std::size_t i = 0; i < KU.size(); ++i)
      KU[i] -= reference.force[k][i];
  }

  const std::vector<double> &NonlinearBodies::end_of_step(const std::size_t k, const State &state)
  {
    copy_displacement(reference, state, k, steps[k].U1);
    return steps[k].U1;
  }

  double NonlinearBodies::energy_surplus(const std::size_t k, const double part_of_end,
                                         const State &state)
  {
    const Substructure &body = structure[k];
    Step &own = steps[k];
    const double before = own.energy_is_known ? own.energy : body.strain_energy(own.U0);
    own.energy = body.strain_energy(end_of_step(k, state));
    double sum = own.energy - before;
    for (std::size_t i = 0; i < own.dU.size(); ++i)
      sum -= ((1. - part_of_end) * own.f0[i] + part_of_end * own.f[i] + reference.force[k][i]) *
             own.dU[i];
    return sum;
  }

  void NonlinearBodies::set_own_force(State &state)
  {
    if (!method.has_means())
      return;
    for (const std::size_t k : bodies)
    {
      std::vector<double> &KU = state.KU[k], &f = own_force;
      structure[k].internal_force(end_of_step(k, state), {}, f);
      for (std::size_t i = 0; i < f.size(); ++i)
      {
        const double own = f[i] - reference.force[k][i];
        state.balance[k][i] += KU[i] - own;
        KU[i] = own;
      }
    }
  }
} // namespace taut
