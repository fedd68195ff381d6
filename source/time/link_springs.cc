// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/time/link_springs.h>

#include <algorithm>
#include <cmath>

namespace taut
{
  LinkSprings::LinkSprings(const Constraints &constraints)
      : constraints(constraints), laws(constraints), mean(constraints.size(), 0),
        S(constraints.size(), 0.), history(constraints.size(), 0.)
  {
  }

  void LinkSprings::prepare(const StepCoefficients &coefficients, const double tau,
                            const std::vector<char> &is_mean)
  {
    c = coefficients;
    step = tau;
    mean = is_mean;
    for (std::size_t i = 0; i < S.size(); ++i)
      S[i] = constraints[i].spring.compliance(c.velocity);
  }

  double LinkSprings::begin(const std::size_t i, const State &before)
  {
    const ConstraintData &constraint = constraints[i];
    const double damping = constraint.spring.damping;
    history[i] = 0.;
    if (!is_mean(i) && !laws.has(i) && !(damping > 0.))
      return 0.;
    const State::LinkSpring &spring = before.link_springs[i];
    const double theta = 1. - c.alpha_f,
                 known = c.v_V * spring.v + c.v_A * spring.a + c.v_dU * spring.du;
    if (is_mean(i) && constraint.spring.conserving)
      laws.begin_conserving(i, spring.u > 0. ? spring.u : -before.geometric_gap[i],
                            2. * damping / step);
    else if (laws.has(i) && is_mean(i))
      laws.begin_mean(i, spring.u, theta, damping / (theta * step));
    else if (laws.has(i) && c.is_at_rest())
      laws.begin_at_end(i, spring.u);
    else if (laws.has(i))
      laws.begin_at_end(i, spring.u, c.velocity * damping, spring.u - known / c.velocity);
    else if (is_mean(i))
    {
      const double rate = damping / step;
      history[i] = -((1. - theta) * constraint.spring.stiffness - rate) /
                   (theta * constraint.spring.stiffness + rate) * spring.u;
    }
    else
      history[i] = S[i] * damping * (c.velocity * spring.u - known);
    return history[i];
  }

  const MixedComplementaritySolution &LinkSprings::solve(MixedComplementarityProblem &problem,
                                                         StepEquations &system,
                                                         const StepCheck &check,
                                                         Certificate &certificate)
  {
    return laws.empty() ? system.find_multipliers(problem, check, certificate)
                        : laws.solve(problem, system, check, certificate, S, history);
  }

  /// A gap that is a small difference of motions has a more exact value from its force.
  double LinkSprings::conserving_compression(const std::size_t i, const double gap, const double N,
                                             const double scale) const
  {
    constexpr double small = 1e-4;
    return std::fabs(gap) > small * scale || !(N > 0.) ? -gap : laws.polished(i, -gap, N);
  }

  double LinkSprings::accept(const std::size_t i, const double gap, const double N,
                             const double scale, State &state) const
  {
    State::LinkSpring &spring = state.link_springs[i];
    const double known_v = c.v_V * spring.v + c.v_A * spring.a + c.v_dU * spring.du,
                 known_a = c.a_V * spring.v + c.a_A * spring.a + c.a_dU * spring.du;
    double u = compression(i, N);
    if (is_mean(i) && constraints[i].spring.conserving)
      u = std::max(0., conserving_compression(i, gap, N, scale));
    else if (is_mean(i))
      u = constraints[i].cone.project(u);
    spring.du = u - spring.u;
    spring.u = u;
    spring.v = c.velocity * spring.du + known_v;
    spring.a = c.acceleration * spring.du + known_a;
    const double D = gap + spring.u;
    return constraints[i].spring.law && !is_mean(i) ? D + laws.lack(i, u, N) : D;
  }

  void LinkSprings::correct(const std::size_t i, const double dN, State &state) const
  {
    State::LinkSpring &spring = state.link_springs[i];
    const double du = S[i] * dN;
    spring.u += du;
    spring.du += du;
    spring.v += c.velocity * du;
    spring.a += c.acceleration * du;
    state.gap[i] = state.geometric_gap[i] + spring.u;
  }
} // namespace taut
