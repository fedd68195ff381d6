// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/time/constraint_motions.h>

#include <cmath>

namespace taut
{
  bool ConstraintMotions::correct(const State &state, StepSystem &system, const BodyVectors &left)
  {
    MixedComplementarityProblem remainder;
    remainder.unilateral = conditions.unilateral;
    system.interface().contact_free_predictor(left, remainder.free_gap, remainder.gap_scale);
    share({&remainder.free_gap, &remainder.gap_scale});
    if (system.has_modes())
      system.set_modes(left, remainder);
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      remainder.free_gap[i] += state.gap[i];
      remainder.gap_scale[i] += std::fabs(state.gap[i]) + terms_size[i];
      if (constraints[i].moving)
        remainder.gap_scale[i] += std::fabs(constraints[i].gap);
    }
    return system.correct(remainder, solved, correction);
  }

  void ConstraintMotions::add_correction(const BodyVectors &dU, State &state)
  {
    const std::vector<double> moved = constraints.motions(dU);
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      const double dN = correction.multiplier[i], du = S[i] * dN;
      solved.multiplier[i] += dN;
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
    for (std::size_t k = 0; k < solved.mode_amplitude.size(); ++k)
      solved.mode_amplitude[k] += correction.mode_amplitude[k];
  }
} // namespace taut
