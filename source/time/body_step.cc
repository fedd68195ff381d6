// SPDX-License-Identifier: LGPL-2.1-or-later
#include "time/body_step.h"
#include "base/instruction_set.h"

#include <algorithm>

namespace taut
{
  namespace
  {
    /// Known parts v* and a* of velocity and acceleration at the end of a step.
    class Predictor
    {
    public:
      Predictor(const StepCoefficients &c, const std::vector<double> &V,
                const std::vector<double> &A, const std::vector<double> &dU,
                const std::vector<double> &V_old)
          : c(c), n(V.size()), V(V.data()), A(A.data()), dU(dU.data()), V_old(V_old.data())
      {
      }

      /// Calls visit(i, v*, a*) for all DoFs; reads only the vectors in use.
      template <typename Visitor>
      void visit(const Visitor &visitor) const
      {
        if (c.looks_back())
#pragma omp simd
          for (std::size_t i = 0; i < n; ++i)
            visitor(i, c.v_V * V[i] + c.v_A * A[i] + c.v_dU * dU[i],
                    c.a_V * V[i] + c.a_A * A[i] + c.a_dU * dU[i] + c.a_V_old * V_old[i]);
        else if (c.v_A != 0. || c.a_A != 0.)
#pragma omp simd
          for (std::size_t i = 0; i < n; ++i)
            visitor(i, c.v_V * V[i] + c.v_A * A[i], c.a_V * V[i] + c.a_A * A[i]);
        else
#pragma omp simd
          for (std::size_t i = 0; i < n; ++i)
            visitor(i, c.v_V * V[i], c.a_V * V[i]);
      }

    private:
      const StepCoefficients c;
      const std::size_t n;
      const double *V, *A, *dU, *V_old;
    };
  } // namespace

  BodyStep::BodyStep(const Structure &structure, const Reference &reference,
                     const StepMethod &method)
      : structure(structure), reference(reference), method(method),
        motions(structure, reference, method)
  {
    StepForces &f = step_forces;
    for (BodyVectors *v :
         {&f.P, &shared, &f.old_U, &f.old_V_old, &f.old_A, &f.old_dU, &f.old_KU, &f.old_balance})
      *v = structure.zero();
    step_forces.external_size.resize(structure.size());
    for (std::size_t k = 0; k < structure.size(); ++k)
      for (std::vector<double> *v : {&known_v, &mean_a, &damping, &inertia})
        v->resize(std::max<std::size_t>(v->size(), structure[k].n_dofs()));
  }

  void BodyStep::set_external_forces(const double time)
  {
    for (std::size_t k = 0; k < structure.size(); ++k)
      set_external_force(k, time);
  }

  void BodyStep::set_external_force(const std::size_t k, const double time)
  {
    const Substructure &body = structure[k];
    std::vector<double> &P = step_forces.P[k];
    body.external_force(time, P);
    const double *f = reference.force[k].data();
    for (std::size_t i = 0; i < P.size(); ++i)
      P[i] -= f[i];
    step_forces.external_size[k] = max_norms(body, P);
  }

  void BodyStep::set_loads(const StepEquations &equations, State &state)
  {
    motions.set(state);
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      const Substructure &body = structure[k];
      if (body.external_force_varies())
        set_external_force(k, state.time);
      equations.bodies().remove_rounding(k, state.KU[k], state.balance[k]);
      set_load(k, state);
      if (motions.lifts_body(k))
        equations.lift(k, motions.increments(k), shared[k]);
    }
  }

  void BodyStep::set_load(const std::size_t k, const State &state)
  {
    const StepCoefficients &c = method.c;
    const Substructure &body = structure[k];
    const Predictor known(c, state.V[k], state.A[k], state.dU[k], state.V_old[k]);
    const bool old_forces_count = c.alpha_m != 0. || c.alpha_f != 0.,
               moves = body.has_moving_constraints() && !c.is_at_rest(),
               velocity_is_known = c.v_V != 0. || c.v_A != 0. || c.v_dU != 0. || moves;
    const double kappa = c.old_balance(), old = c.old_inertia(), now = c.new_inertia();
    const double *A = state.A[k].data(), *p = step_forces.P[k].data(), *KU = state.KU[k].data(),
                 *r = state.balance[k].data();
    double *v = known_v.data(), *a = mean_a.data(), *Cv = damping.data(), *Ma = inertia.data(),
           *R = shared[k].data();
    vectorised(
        [=]
        {
          known.visit(
              [=](const std::size_t i, const double v0, const double a0)
              {
                v[i] = v0;
                a[i] = old_forces_count ? now * a0 + old * A[i] : a0;
              });
        });
    if (moves)
      motions.visit(k,
                    [&](const unsigned int i, const double V, const double mean)
                    {
                      const double du = motions.increments(k)[i];
                      v[i] = V - c.velocity * du;
                      a[i] = now * mean + old * A[i] - now * c.acceleration * du;
                    });
    if (velocity_is_known)
      body.damping().vmult(v, Cv);
    body.mass().vmult(a, Ma);
    vectorised(
        [=, n = shared[k].size()]
        {
#pragma omp simd
          for (std::size_t i = 0; i < n; ++i)
          {
            double sum = p[i] - KU[i];
            if (old_forces_count)
              sum += kappa * r[i];
            if (velocity_is_known)
              sum -= Cv[i];
            R[i] = sum - Ma[i];
          }
        });
  }

  void BodyStep::exchange(State &state)
  {
    exchange_old(state);
    state.V_old.swap(state.V);
    state.dU.swap(shared);
    motions.impose_increments(state.dU);
    is_exchanged = true;
  }

  void BodyStep::take_back(State &state)
  {
    if (!is_exchanged)
      return;
    state.V.swap(state.V_old);
    exchange_old(state);
    is_exchanged = false;
  }

  void BodyStep::exchange_old(State &state)
  {
    StepForces &f = step_forces;
    state.U.swap(f.old_U);
    state.V_old.swap(f.old_V_old);
    state.A.swap(f.old_A);
    state.dU.swap(f.old_dU);
    state.KU.swap(f.old_KU);
    state.balance.swap(f.old_balance);
  }

  void BodyStep::accept(const std::size_t k, State &state) const
  {
    const StepCoefficients &c = method.c;
    const double velocity = c.velocity, acceleration = c.acceleration;
    const double *dU = state.dU[k].data();
    const double *U0 = step_forces.old_U[k].data();
    double *U = state.U[k].data(), *V = state.V[k].data(), *A = state.A[k].data();
    const auto visitor = [=](const std::size_t i, const double v, const double a)
    {
      U[i] = U0[i] + dU[i];
      V[i] = velocity * dU[i] + v;
      A[i] = acceleration * dU[i] + a;
    };
    const Predictor known(c, state.V_old[k], step_forces.old_A[k], step_forces.old_dU[k],
                          step_forces.old_V_old[k]);
    vectorised([=] { known.visit(visitor); });
    if (structure[k].has_moving_constraints() && !c.is_at_rest())
      motions.visit(k,
                    [&](const unsigned int i, const double mean_v, const double a)
                    {
                      V[i] = mean_v;
                      A[i] = a;
                    });
  }

  void BodyStep::set_lacking(const StepEquations &equations, State &state)
  {
    const StepCoefficients &c = method.c;
    const double kappa = c.old_balance(), old = c.old_inertia(), now = c.new_inertia();
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      const Substructure &body = structure[k];
      equations.bodies().remove_rounding(k, state.KU[k], state.balance[k]);
      std::vector<double> &left = shared[k];
      for (std::size_t i = 0; i < left.size(); ++i)
      {
        left[i] = state.balance[k][i] + kappa * step_forces.old_balance[k][i];
        mean_a[i] = now * state.A[k][i] + old * step_forces.old_A[k][i];
      }
      body.mass().vmult_add(-1., mean_a.data(), left.data());
      for (const ConstrainedDof &constraint : body.constraints())
        left[constraint.dof] = 0.;
    }
  }

  void BodyStep::add_correction(State &state)
  {
    const StepCoefficients &c = method.c;
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      std::vector<double> &dU = shared[k];
      for (const ConstrainedDof &constraint : structure[k].constraints())
        dU[constraint.dof] = 0.;
      for (std::size_t i = 0; i < dU.size(); ++i)
      {
        state.U[k][i] += dU[i];
        state.dU[k][i] += dU[i];
        state.V[k][i] += c.velocity * dU[i];
        state.A[k][i] += c.acceleration * dU[i];
      }
    }
  }
} // namespace taut
