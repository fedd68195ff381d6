// SPDX-License-Identifier: LGPL-2.1-or-later
// The rows of constraints that turn: places of their ends, directions, and springs across them.
#include "interface/motion_along.h"

#include <taut/interface/constraints.h>

#include <cmath>

namespace taut
{
  void Constraints::copy_differences(const BodyVectors &U, std::vector<Coordinates> &to) const
  {
    sums.clear();
    for (const std::size_t i : turning_rows())
      for (const std::vector<Term> &motion : turning(i).motion)
        sums.push_back(evaluate(motion, U));
    structure.communicator().sum(sums);
    to.clear();
    for (std::size_t k = 0; k < sums.size(); k += 3)
      to.push_back({sums[k], sums[k + 1], sums[k + 2]});
  }

  void Constraints::copy_differences(const BodyVectors &reference, const BodyVectors &U,
                                     std::vector<Coordinates> &to) const
  {
    to.clear();
    if (turning_rows().empty())
      return;
    sums.clear();
    for (const BodyVectors *const X : {&reference, &U})
      for (const std::size_t i : turning_rows())
        for (const std::vector<Term> &motion : turning(i).motion)
          sums.push_back(evaluate(motion, *X));
    structure.communicator().sum(sums);
    for (const std::size_t i : turning_rows())
    {
      const double *const r = sums.data() + 3 * turning_index(i), *const u = r + sums.size() / 2;
      to.push_back(
          add_scaled(add_scaled(turning(i).start, 1., {r[0], r[1], r[2]}), 1., {u[0], u[1], u[2]}));
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

  std::array<Coordinates, 2> Constraints::ends(const std::size_t i, const BodyVectors &reference,
                                               const BodyVectors &U) const
  {
    const LinkEnd &first = turning(i).first;
    double motion[3];
    for (unsigned int c = 0; c < 3; ++c)
      motion[c] = evaluate(first.motion[c], reference) + evaluate(first.motion[c], U);
    structure.communicator().sum(motion, 3);
    const Coordinates place = add_scaled(first.position, 1., {motion[0], motion[1], motion[2]});
    return {place, add_scaled(place, 1., differences(reference, U)[turning_index(i)])};
  }

  void Constraints::turn(const std::vector<Coordinates> &directions)
  {
    for (std::size_t i = 0; i < directions.size(); ++i)
    {
      const TurningDirection &link = turning(first_turning + i);
      const Coordinates &d = directions[i];
      set_motion_along(link, {link.sign * d.x, link.sign * d.y, link.sign * d.z},
                       constraints[first_turning + i].terms);
    }
    append_varying();
  }

  void Constraints::turn_to(const BodyVectors &reference, const BodyVectors &U)
  {
    if (turning_rows().empty())
      return;
    std::vector<Coordinates> d = differences(reference, U);
    for (std::size_t i = 0; i < d.size(); ++i)
      d[i] = turning(first_turning + i).at(d[i]);
    turn(d);
  }

  void Constraints::keep_directions(const BodyVectors &reference, const std::vector<double> &N)
  {
    const std::vector<Coordinates> motions = differences(reference);
    std::vector<ConstraintData> springs;
    for (std::size_t k = 0; k < motions.size(); ++k)
    {
      const std::size_t i = first_turning + k;
      ConstraintData &link = constraints[i];
      const TurningDirection::Linear linear = turning(i).linearised(motions[k]);
      if (turning(i).sign * N[i] < 0.)
        for (const Coordinates &direction : across(linear.direction))
          springs.push_back(geometric_spring(link.name + " across", link, direction,
                                             std::fabs(N[i]) / linear.distance, motions[k]));
      link.terms = linear.terms;
      link.gap = linear.gap;
      link.geometry = nullptr;
    }
    constraints.insert(constraints.begin() + first_sliding, springs.begin(), springs.end());
    sort();
    arrange();
  }
} // namespace taut
