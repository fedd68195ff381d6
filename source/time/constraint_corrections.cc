// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/complementarity/solver.h>
#include <taut/time/constraint_motions.h>

#include <cmath>

namespace taut
{
  /// The unknowns are the multipliers as they become and not their changes, so that conditions and
  /// search are those of a step.
  bool ConstraintMotions::correct(const State &state, SchurComplement &schur,
                                  const FactoredStructure &solvers, const BodyVectors &left)
  {
    MixedComplementarityProblem problem;
    problem.unilateral = conditions.unilateral;
    schur.contact_free_predictor(left, problem.free_gap, problem.gap_scale);
    share({&problem.free_gap, &problem.gap_scale});
    if (!conditions.null_space_resistance.empty())
      set_rigid_body_modes(solvers, left, problem);
    correction.reset(problem);
    if (constraints.size() == 0 && problem.n_null_space() == 0)
      return true;

    std::vector<double> before(constraints.size());
    std::vector<char> closed(constraints.size());
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      problem.free_gap[i] += state.gap[i];
      problem.gap_scale[i] += std::fabs(state.gap[i]) + terms_size[i];
      if (constraints[i].moving)
        problem.gap_scale[i] += std::fabs(constraints[i].gap);
      before[i] = -applied_multiplier[i];
      closed[i] = applied_multiplier[i] != 0. || problem.free_gap[i] < 0.;
    }
    gaps(problem, schur.matrix(), before, correction.mode_amplitude, work);
    problem.free_gap.swap(work);
    for (std::size_t k = 0; k < problem.n_null_space(); ++k)
      problem.null_space_load[k] += problem.null_space[k].dot(before);
    try
    {
      ComplementaritySolver search;
      search.start_from(closed);
      correction = search.solve(problem, schur.matrix()).solution;
    }
    catch (const UserError &)
    {
      return false;
    }
    for (std::size_t i = 0; i < constraints.size(); ++i)
      correction.multiplier[i] -= applied_multiplier[i];
    return true;
  }

  void ConstraintMotions::add_correction(const BodyVectors &dU, State &state)
  {
    const std::vector<double> moved = constraints.motions(dU);
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      const double dN = correction.multiplier[i], du = S[i] * dN;
      applied_multiplier[i] += dN;
      balanced[i] += dN;
      state.multiplier[i] += dN;
      motion[i] += moved[i];
      position[i] += moved[i];
      state.geometric_gap[i] += moved[i];
      State::LinkSpring &spring = state.link_springs[i];
      spring.u += du;
      spring.du += du;
      spring.v += c.velocity * du;
      spring.a += c.acceleration * du;
      state.gap[i] = state.geometric_gap[i] + spring.u;
    }
    for (std::size_t k = 0; k < amplitude.size(); ++k)
      amplitude[k] += correction.mode_amplitude[k];
  }
} // namespace taut
