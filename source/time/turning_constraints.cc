// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/time/turning_constraints.h>

#include <algorithm>
#include <cmath>

namespace taut
{
  namespace
  {
    /// Newton's method ends at 1e-9 of its changes: directions then are known to 1e-11, and gaps to
    /// 1e-12 of the distance of the ends.
    constexpr double weight_of_direction = 1e2, weight_of_gap = 1e3;

    /// A mean direction shorter than that turns by more than 120 degrees in a step.
    constexpr double shortest_mean = .5;

    Coordinates scaled(const double s, const Coordinates &a)
    {
      return {s * a.x, s * a.y, s * a.z};
    }
  } // namespace

  TurningConstraints::TurningConstraints(Constraints &constraints, const Reference &reference)
      : constraints(constraints), reference(reference)
  {
  }

  void TurningConstraints::prepare(const StepCoefficients &c) const
  {
    if (!empty() && c.mean_force && !c.velocity_projection)
      throw EntryError("Time/Moreau-Jean/Conditions",
                       "link '" + constraints[constraints.n_fixed()].name +
                           "' turns, and its length would drift with conditions on velocities. "
                           "Take 'gaps then velocities', or 'Scheme = automatic'");
  }

  void TurningConstraints::follow(const State &state)
  {
    if (empty())
      return;
    start = constraints.differences(reference.displacement, state.U);
    next.clear();
    for (std::size_t k = 0; k < start.size(); ++k)
      next.push_back(constraints[constraints.n_fixed() + k].direction->at(start[k]));
    turn();
  }

  void TurningConstraints::begin(const StepCoefficients &c)
  {
    is_mean = c.mean_force;
    next.clear();
    for (std::size_t k = 0; k < start.size(); ++k)
      next.push_back(constraints[constraints.n_fixed() + k].direction->at(start[k]));
    used = next;
    turn();
    offsets.assign(start.size(), 0.);
    next_offsets = increments = offsets;
  }

  double TurningConstraints::set_guess(const BodyVectors &dU, const State &before,
                                       const std::vector<double> &N,
                                       const std::vector<double> &history)
  {
    const std::vector<Coordinates> motion = constraints.differences(dU);
    used = next;
    offsets = next_offsets;
    double result = 0.;
    for (std::size_t k = 0; k < motion.size(); ++k)
    {
      const std::size_t i = constraints.n_fixed() + k;
      const TurningDirection &turning = *constraints[i].direction;
      const Coordinates end = add_scaled(start[k], 1., motion[k]),
                        sum = add_scaled(start[k], 1., end);
      const double size = norm(end), sizes = norm(start[k]) + size;
      // Without cancellation.
      increments[k] = sizes > 0. ? turning.sign * dot(sum, motion[k]) / sizes : 0.;
      const double linear = offsets[k] + turning.sign * dot(used[k], motion[k]),
                   gap = before.geometric_gap[i] + increments[k] + history[i];
      const bool is_open = constraints[i].unilateral && N[i] == 0. && gap >= 0.;
      if (turning.vanishes(end) || turning.vanishes(start[k]))
      {
        if (is_open)
          continue;
        throw UserError("link '" + constraints[i].name +
                        "' has a force, and its ends meet: it has no direction. Give it a "
                        "stiffness that keeps its ends apart, or join them by a ball joint");
      }
      next[k] = is_mean ? scaled(1. / sizes, sum) : scaled(1. / size, end);
      next_offsets[k] = is_mean ? 0. : increments[k] - turning.sign * dot(next[k], motion[k]);
      if (is_open)
        continue;
      if (norm(next[k]) < shortest_mean)
        throw UserError("link '" + constraints[i].name +
                        "' turns by more than 120 degrees in a step. Take a smaller step");
      const double change = std::max(weight_of_direction * norm(next[k] - used[k]),
                                     weight_of_gap * std::fabs(increments[k] - linear) / size);
      if (!(change <= result) && !std::isnan(result))
        result = change;
    }
    return result;
  }

  double TurningConstraints::surplus(const std::vector<double> &N,
                                     const std::vector<double> &motion) const
  {
    double sum = 0.;
    for (std::size_t k = 0; k < increments.size() && !is_mean; ++k)
    {
      const std::size_t i = constraints.n_fixed() + k;
      sum += N[i] * (motion[i] - increments[k]);
    }
    return sum;
  }
} // namespace taut
