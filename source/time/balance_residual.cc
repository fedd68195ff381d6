// SPDX-License-Identifier: LGPL-2.1-or-later
#include "time/balance_residual.h"
#include "base/instruction_set.h"
#include "base/text.h"

#include <algorithm>
#include <cmath>

namespace taut
{
  namespace
  {
    /// Part of |K||dU| and of the other terms up to which a residual is rounding: below a change of
    /// 1e-9, at which Newton's method ends, and above the 1e-11 of a step that is solved once.
    constexpr double rounding_of_increment = 1e-10;

    /// Relative residual that stands for the rounding of a body: a hundredth of the default Contact
    /// tolerance.
    constexpr double residual_of_rounding = 1e-10;

    /// Mean accelerations.
    void combine(const StepCoefficients &c, const double *A, const double *A0, const std::size_t n,
                 double *result)
    {
      const double old = c.old_inertia(), now = c.new_inertia();
      vectorised(
          [=]
          {
#pragma omp simd
            for (std::size_t i = 0; i < n; ++i)
              result[i] = now * A[i] + old * A0[i];
          });
    }

    /// Subtracts K U and C V from r, and r from the inertia in @p residual.
    void subtract_forces(const std::size_t size, const double factor, const double kappa,
                         const double *KU, const double *CV, const double *r0, double *r,
                         double *residual)
    {
      vectorised(
          [=]
          {
#pragma omp simd
            for (std::size_t i = 0; i < size; ++i)
              r[i] -= KU[i] + CV[i];
            if (kappa == 0.)
#pragma omp simd
              for (std::size_t i = 0; i < size; ++i)
                residual[i] = factor * residual[i] - r[i];
            else
#pragma omp simd
              for (std::size_t i = 0; i < size; ++i)
                residual[i] = factor * residual[i] - (r[i] + kappa * r0[i]);
          });
    }

    /// dU . (r + kappa r0)
    double work_of(const double *dU, const double *r, const double *r0, const double kappa,
                   const std::size_t size)
    {
      double result = 0.;
      vectorised(
          [=, &result]
          {
            double sum = 0.;
#pragma omp simd reduction(+ : sum)
            for (std::size_t i = 0; i < size; ++i)
              sum += dU[i] * (r[i] + kappa * r0[i]);
            result = sum;
          });
      return result;
    }
  } // namespace

  BalanceResidual::BalanceResidual(const Structure &structure, const Constraints &constraints,
                                   const Reference &reference, const StepMethod &method,
                                   const NonlinearBodies &nonlinear)
      : structure(structure), constraints(constraints), method(method), nonlinear(nonlinear),
        impulses(structure.zero())
  {
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      const Substructure &body = structure[k];
      norms.push_back({RowSumNorm(body, body.mass()), RowSumNorm(body, body.damping()),
                       RowSumNorm(body, body.stiffness())});
      reference_force.push_back(max_norms(body, reference.force[k]));
      for (std::vector<double> *v : {&mean_A, &inertia, &damping})
        v->resize(std::max<std::size_t>(v->size(), body.n_dofs()));
    }
  }

  void BalanceResidual::measure(const StepForces &forces, const std::vector<double> &in_balance,
                                const std::vector<double> &impulsive, State &state)
  {
    for (std::size_t k = 0; k < structure.size(); ++k)
      std::copy(forces.P[k].begin(), forces.P[k].end(), state.balance[k].begin());
    constraints.add_forces(in_balance, state.balance);
    const bool has_impulses = !impulsive.empty();
    if (has_impulses)
    {
      for (std::vector<double> &f : impulses)
        std::fill(f.begin(), f.end(), 0.);
      constraints.add_forces(impulsive, impulses);
    }
    constraints.largest_forces(state.multiplier, contact_force);

    largest_residual = 0.;
    work_of_balance.assign(structure.size(), 0.);
    may_be_cancellation = true;
    worst = 0;
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      const Sizes sizes = measure_body(k, forces, has_impulses, state);
      const double relative = relative_residual(k, forces, sizes, state.time);
      if (!(relative <= largest_residual) && !std::isnan(largest_residual))
      {
        largest_residual = relative;
        worst = k;
      }
    }
  }

  BalanceResidual::Sizes BalanceResidual::measure_body(const std::size_t k,
                                                       const StepForces &forces,
                                                       const bool has_impulses, State &state)
  {
    const StepCoefficients &c = method.c;
    const double kappa = c.old_balance();
    const bool has_old_inertia = c.old_inertia() != 0.;
    const Substructure &body = structure[k];
    const std::size_t n = body.n_dofs();
    const double *r0 = forces.old_balance[k].data(), *mass_A = state.A[k].data();
    double *r = state.balance[k].data(), *KU = state.KU[k].data(), *residual = inertia.data();
    if (body.is_linear())
      body.stiffness().vmult(state.U[k].data(), KU);
    else
      nonlinear.set_end_force(k, state);
    body.damping().vmult(state.V[k].data(), damping.data());
    if (has_old_inertia)
    {
      combine(c, state.A[k].data(), forces.old_A[k].data(), n, mean_A.data());
      mass_A = mean_A.data();
    }
    body.mass().vmult(mass_A, residual);
    subtract_forces(n, has_old_inertia ? 1. : c.new_inertia(), kappa, KU, damping.data(), r0, r,
                    residual);
    if (has_impulses)
      for (std::size_t i = 0; i < n; ++i)
        residual[i] -= impulses[k][i];
    if (method.has_means())
      work_of_balance[k] = (1. - c.alpha_f) * work_of(state.dU[k].data(), r, r0, kappa, n);
    for (const ConstrainedDof &constraint : body.constraints())
      residual[constraint.dof] = 0.;
    return {max_norms(body, residual), max_norms(body, state.dU[k]), max_norms(body, state.V[k]),
            max_norms(body, state.U[k])};
  }

  double BalanceResidual::relative_residual(const std::size_t k, const StepForces &forces,
                                            const Sizes &sizes, const double time)
  {
    const StepCoefficients &c = method.c;
    // P and B N may cancel each other and the forces of the reference: each counts.
    ByKind force = forces.external_size[k];
    for (int kind = 0; kind < 2; ++kind)
      force[kind] += contact_force[k][kind] + reference_force[k][kind];
    for (int kind = 0; kind < 2; ++kind)
      if (!(std::max({force[kind], sizes.velocity[kind], sizes.displacement[kind]}) <=
            largest_number) ||
          std::isnan(sizes.velocity[kind]) || std::isnan(sizes.displacement[kind]))
        check_size(structure[k], force, sizes.displacement, sizes.velocity,
                   c.is_at_rest() ? "static equilibrium: " : to_text("at t = ", time, " s: "));

    ByKind inertial = sizes.increment;
    for (double &d : inertial)
      d *= c.mass_factor();
    const ByKind by_mass = norms[k][0].times(inertial),
                 by_damping = norms[k][1].times(sizes.velocity),
                 by_stiffness = norms[k][2].times(sizes.displacement),
                 of_increment = norms[k][2].times(sizes.increment);
    double result = 0.;
    for (int kind = 0; kind < 2; ++kind)
    {
      double size = force[kind] + by_mass[kind] + by_damping[kind] + by_stiffness[kind] +
                    structure[k].rounding_of_force(kind) / residual_of_rounding;
      if (sizes.residual[kind] > rounding_of_increment * (size + of_increment[kind]))
        may_be_cancellation = false;
      // There is no refinement with mean forces.
      if (method.has_means())
        size += of_increment[kind];
      // Numbers close to underflow have few digits.
      const double relative =
          sizes.residual[kind] <= 1. / largest_number / largest_number / largest_number
              ? 0.
              : sizes.residual[kind] / size;
      if (!(relative <= result) && !std::isnan(result))
        result = relative;
    }
    return result;
  }
} // namespace taut
