// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/sum_together.h>
#include <taut/time/gap_rates.h>

namespace taut
{
  GapRates::GapRates(const Structure &structure, const Constraints &constraints,
                     const Reference &reference)
      : structure(structure), constraints(constraints), reference(reference)
  {
    for (auto *v : {&velocity, &velocity_size, &convection, &rates_before, &rate_of_place})
      v->assign(constraints.size(), 0.);
  }

  void GapRates::prepare(const StepCoefficients &c, const double tau)
  {
    is_projected = c.velocity_projection;
    step = tau;
  }

  void GapRates::begin(const State &before)
  {
    constraints.share_of_motions(before.V, velocity);
    sum_together(structure.communicator(), {&velocity});
  }

  void GapRates::measure(const State &state)
  {
    constraints.share_of_motions(state.V, velocity, velocity_size);
    sum_together(structure.communicator(), {&velocity, &velocity_size});
  }

  /// Places of sliding constraints count exactly.
  void GapRates::measure_convection(const State &state)
  {
    if (constraints.sliding_rows().empty())
      return;
    for (const std::size_t i : constraints.sliding_rows())
      rate_of_place[i] =
          constraints.share_of_convection(i, state.time, reference.displacement, state.U);
    sum_together(structure.communicator(), {&rate_of_place});
    for (const std::size_t i : constraints.sliding_rows())
      rate_of_place[i] += constraints.profile_rate(i, state.time, step);
  }

  void GapRates::accept(State &state)
  {
    measure(state);
    if (is_projected)
      measure_convection(state);
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      rates_before[i] = state.gap_rate[i];
      state.gap_rate[i] = velocity[i] + (is_projected ? rate_of_place[i] : convection[i] / step);
    }
  }

  void GapRates::update(State &state)
  {
    measure(state);
    for (std::size_t i = 0; i < constraints.size(); ++i)
      state.gap_rate[i] = velocity[i] + rate_of_place[i];
  }
} // namespace taut
