// SPDX-License-Identifier: LGPL-2.1-or-later
// The rows of constraints that turn: places of their ends, directions, and springs across them.
#include "interface/motion_along.h"

#include <taut/interface/constraints.h>

#include <cmath>

namespace taut
{
  void Constraints::add_motions_of_places(const BodyVectors &U, double *sum) const
  {
    for (const std::size_t i : turning_rows())
      for (const LinkEnd &place : turning(i).places)
        for (const std::vector<Term> &motion : place.motion)
          *sum++ += evaluate(motion, U);
  }

  void Constraints::copy_differences(const BodyVectors &U, std::vector<Coordinates> &to) const
  {
    to.clear();
    if (turning_rows().empty())
      return;
    sums.assign(3 * (n_segments() + turning_rows().size()), 0.);
    add_motions_of_places(U, sums.data());
    structure.communicator().sum(sums);
    const double *a = sums.data();
    for (const std::size_t i : turning_rows())
    {
      for (std::size_t k = 0; k < turning(i).size(); ++k, a += 3)
        to.push_back({a[3] - a[0], a[4] - a[1], a[5] - a[2]});
      a += 3;
    }
  }

  void Constraints::copy_differences(const BodyVectors &reference, const BodyVectors &U,
                                     std::vector<Coordinates> &to) const
  {
    to.clear();
    if (turning_rows().empty())
      return;
    const std::size_t n = 3 * (n_segments() + turning_rows().size());
    sums.assign(2 * n, 0.);
    add_motions_of_places(reference, sums.data());
    add_motions_of_places(U, sums.data() + n);
    structure.communicator().sum(sums);
    const double *r = sums.data();
    const auto difference = [](const double *const a) {
      return Coordinates{a[3] - a[0], a[4] - a[1], a[5] - a[2]};
    };
    for (const std::size_t i : turning_rows())
    {
      for (const Coordinates &start : turning(i).start)
      {
        to.push_back(add_scaled(add_scaled(start, 1., difference(r)), 1., difference(r + n)));
        r += 3;
      }
      r += 3;
    }
  }

  std::vector<Coordinates> Constraints::differences(const BodyVectors &U) const
  {
    std::vector<Coordinates> result;
    copy_differences(U, result);
    return result;
  }

  std::vector<Coordinates> Constraints::differences(const BodyVectors &reference,
                                                    const BodyVectors &U) const
  {
    std::vector<Coordinates> result;
    copy_differences(reference, U, result);
    return result;
  }

  std::array<Coordinates, 2> Constraints::ends(const std::size_t i, const std::size_t segment,
                                               const BodyVectors &reference,
                                               const BodyVectors &U) const
  {
    const std::size_t k = segment - *segments(i).begin();
    const LinkEnd &first = turning(i).places[k];
    double motion[3];
    for (unsigned int c = 0; c < 3; ++c)
      motion[c] = evaluate(first.motion[c], reference) + evaluate(first.motion[c], U);
    structure.communicator().sum(motion, 3);
    const Coordinates place = add_scaled(first.position, 1., {motion[0], motion[1], motion[2]});
    return {place, add_scaled(place, 1., differences(reference, U)[segment])};
  }

  void Constraints::turn(const std::vector<Coordinates> &directions)
  {
    for (const std::size_t i : turning_rows())
      set_motion_along(turning(i), directions.data() + *segments(i).begin(), constraints[i].terms);
    append_varying();
  }

  void Constraints::turn_to(const BodyVectors &reference, const BodyVectors &U)
  {
    if (turning_rows().empty())
      return;
    std::vector<Coordinates> d = differences(reference, U);
    for (const std::size_t i : turning_rows())
      for (const std::size_t k : segments(i))
        d[k] = turning(i).at(k - *segments(i).begin(), d[k]);
    turn(d);
  }

  void Constraints::keep_directions(const BodyVectors &reference, const std::vector<double> &N)
  {
    const std::vector<Coordinates> motions = differences(reference);
    std::vector<ConstraintData> springs;
    for (const std::size_t i : turning_rows())
    {
      ConstraintData &link = constraints[i];
      const Coordinates *const moved = motions.data() + *segments(i).begin();
      const TurningDirection::Linear linear = turning(i).linearised(moved);
      const double force = N[turning_index(i)];
      for (std::size_t k = 0; k < turning(i).size() && turning(i).sign * force < 0.; ++k)
        for (const Coordinates &direction : across(linear.directions[k]))
          springs.push_back(geometric_spring(link.name + " across", link, k, direction,
                                             std::fabs(force) / linear.distances[k], moved[k]));
      link.terms = linear.terms;
      link.gap = linear.gap;
      link.geometry = nullptr;
    }
    constraints.insert(constraints.begin() + first_sliding, springs.begin(), springs.end());
    sort();
    if (shared_rows)
      share_like(*shared_rows);
    arrange();
  }
} // namespace taut
