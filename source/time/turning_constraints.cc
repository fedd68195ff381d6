// SPDX-License-Identifier: LGPL-2.1-or-later
#include "time/turning_constraints.h"
#include "base/text.h"
#include <taut/base/exceptions.h>

#include <algorithm>
#include <cmath>

namespace taut
{
  namespace
  {
    /// Newton's method ends at a change of 1e-9: directions are exact to 1e-11 then, gaps to 1e-12
    /// of the distance of the ends.
    constexpr double weight_of_direction = 1e2, weight_of_gap = 1e3;

    /// Cosine of the largest rotation of a link with a force in a step, 120 degrees: the mean of
    /// both directions has half of its length there, and none at 180 degrees.
    constexpr double largest_turn = -.5;

    /// Distance, as a part of the length, below which ends that rotate further meet. It only
    /// chooses between two messages.
    constexpr double nearest_pass = 1e-3;
  } // namespace

  TurningConstraints::TurningConstraints(const Constraints &constraints, const Reference &reference,
                                         const StepMethod &method)
      : constraints(constraints), reference(reference), method(method)
  {
  }

  void TurningConstraints::check_method() const
  {
    if (!empty() && method.has_means() && !method.corrects_velocities)
      throw EntryError("Time/Moreau-Jean/Conditions",
                       "link '" + constraints[constraints.turning_rows().front()].name +
                           "' turns, and its length would drift with conditions on velocities. "
                           "Take 'gaps then velocities', or 'Scheme = automatic'");
  }

  void TurningConstraints::follow(const State &state)
  {
    if (empty())
      return;
    time = state.time;
    constraints.copy_differences(reference.displacement, state.U, start);
    face_start();
  }

  void TurningConstraints::face_start()
  {
    next.clear();
    for (const std::size_t i : constraints.turning_rows())
      for (std::size_t k = 0; k < constraints.turning(i).size(); ++k)
        next.push_back(constraints.turning(i).at(k, start[next.size()]));
  }

  void TurningConstraints::begin()
  {
    face_start();
    used = next;
    reels.clear();
    for (const std::size_t i : constraints.turning_rows())
      reels.push_back(constraints.turning(i).reeled(time, time + method.length));
    offsets = next_offsets = increments = reels;
  }

  double TurningConstraints::set_guess(const BodyVectors &dU, const State &before,
                                       const std::vector<double> &N,
                                       const std::vector<double> &history)
  {
    constraints.copy_differences(dU, motion);
    end.resize(motion.size());
    used = next;
    offsets = next_offsets;
    const bool is_mean = method.has_means();
    double result = 0.;
    for (const std::size_t i : constraints.turning_rows())
    {
      const std::size_t k = constraints.turning_index(i);
      const double sign = constraints.turning(i).sign;
      double size = 0., linear = offsets[k];
      increments[k] = reels[k];
      for (const std::size_t j : constraints.segments(i))
      {
        end[j] = add_scaled(start[j], 1., motion[j]);
        const Coordinates sum = add_scaled(start[j], 1., end[j]);
        const double sizes = norm(start[j]) + norm(end[j]);
        // Avoids cancellation.
        increments[k] += sizes > 0. ? sign * dot(sum, motion[j]) / sizes : 0.;
        linear += sign * dot(used[j], motion[j]);
        size += norm(end[j]);
      }
      const bool is_open =
          constraints[i].cone.rests_open(N[i], before.distance[i] + increments[k] + history[i]);
      if (!is_open)
        for (const std::size_t j : constraints.segments(i))
          check_turn(i, j, before);
      const double turned = set_directions(i, is_mean);
      if (is_open || !(size > 0.))
        continue;
      const double change = std::max(weight_of_direction * turned,
                                     weight_of_gap * std::fabs(increments[k] - linear) / size);
      if (!(change <= result) && !std::isnan(result))
        result = change;
    }
    return result;
  }

  /// Directions and offset of a constraint for the next guess. Returns the largest change of a
  /// direction. A segment whose ends meet keeps its own.
  double TurningConstraints::set_directions(const std::size_t i, const bool is_mean)
  {
    const TurningDirection &turning = constraints.turning(i);
    const std::size_t k = constraints.turning_index(i);
    double turned = 0., along = 0.;
    for (const std::size_t j : constraints.segments(i))
    {
      const double size = norm(end[j]), sizes = norm(start[j]) + size;
      if (!turning.vanishes(end[j]) && !turning.vanishes(start[j]))
        next[j] = is_mean ? add_scaled({}, 1. / sizes, add_scaled(start[j], 1., end[j]))
                          : add_scaled({}, 1. / size, end[j]);
      turned = std::max(turned, norm(next[j] - used[j]));
      along += dot(next[j], motion[j]);
    }
    next_offsets[k] = is_mean ? reels[k] : increments[k] - turning.sign * along;
    return turned;
  }

  /// Checks that the ends of a segment with a force neither meet nor pass each other.
  void TurningConstraints::check_turn(const std::size_t i, const std::size_t segment,
                                      const State &before) const
  {
    const TurningDirection &turning = constraints.turning(i);
    const Coordinates &a = start[segment], &b = end[segment], way = b - a;
    const bool vanishes = turning.vanishes(a) || turning.vanishes(b);
    if (!vanishes && !(dot(a, b) < largest_turn * norm(a) * norm(b)))
      return;
    const double part = std::clamp(-dot(a, way) / dot(way, way), 0., 1.);
    const std::string &name = constraints[i].name;
    if (vanishes || norm(add_scaled(a, part, way)) < nearest_pass * turning.length)
      throw UserError(message_of_meeting(
          name, before.time, constraints.ends(i, segment, reference.displacement, before.U)));
    throw UserError(to_text("at t = ", before.time, " s: link '", name,
                            "' turns by more than 120 degrees in a step. Take a smaller step"));
  }

  double TurningConstraints::distance(const std::size_t i) const
  {
    return constraints.turning(i).distance(start.data() + *constraints.segments(i).begin());
  }

  std::string message_of_meeting(const std::string &name, const double t,
                                 const std::array<Coordinates, 2> &ends)
  {
    return to_text("at t = ", t, " s: the ends of link '", name, "' meet, from (", ends[0],
                   ") m and (", ends[1],
                   ") m, while it has a force: it has no direction there. Give it a stiffness that "
                   "keeps its ends apart, keep them apart by a stop, or join them by a ball joint");
  }

  double TurningConstraints::surplus(const std::size_t i, const double N, const double motion) const
  {
    return method.has_means() ? 0. : N * (motion - (increment(i) - reeled(i)));
  }
} // namespace taut
