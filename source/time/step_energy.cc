// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/time/time_stepper.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace taut
{
  /// Adds v . M v / 2 of a velocity of each body to the entry of its group.
  void TimeStepper::add_kinetic_energies(const BodyVectors &V, std::vector<double> &of_groups)
  {
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      std::vector<double> &product = work_a;
      std::fill(product.begin(), product.end(), 0.);
      structure[k].mass().vmult_add(.5, V[k].data(), product.data());
      of_groups[groups.of_body(k)] +=
          std::inner_product(V[k].begin(), V[k].end(), product.begin(), 0.);
    }
  }

  /// What a constraint with a mean force adds to the gain of its group: what its spring stores, and
  /// if it moves, its work, which is that of what moves it.
  double TimeStepper::gain_of_spring(const std::size_t i) const
  {
    const ConstraintData &constraint = constraints[i];
    if (!conditions.mean_force(i))
      return 0.;
    if (constraint.moving)
      return -current.constraint_work[i];
    if (std::isinf(constraint.stiffness))
      return 0.;
    const State::LinkSpring &spring = current.link_springs[i];
    const double before = spring.u - spring.du;
    return constraint.law ? constraint.law->mean_force(before, spring.u) * spring.du
                          : .5 * constraint.stiffness * (spring.u * spring.u - before * before);
  }

  /**
   * Of each group of connected bodies the change of kinetic energy, minus the work of all forces
   * but those of fixed constraints with a mean force, plus what the springs of these take: not
   * positive but for rounding. Where supports move it would be the work of their forces, too, and
   * is not measured. The energies of bodies that are not linear are their own, so that a mean force
   * that is not theirs shows.
   */
  void TimeStepper::measure_energy()
  {
    const std::size_t n = groups.n_groups();
    work_of_groups.assign(2 * n, 0.);
    structure.communicator().agree(
        [&]
        {
          for (const std::size_t k : nonlinear.indices())
            work_of_groups[n + groups.of_body(k)] += nonlinear.energy_surplus(k, .5, current);
        });
    for (std::size_t k = 0; k < structure.size(); ++k)
      work_of_groups[n + groups.of_body(k)] -= balance.work(k);
    add_kinetic_energies(current.V, work_of_groups);
    structure.communicator().sum(work_of_groups);
    for (std::size_t i = 0; i < constraints.size(); ++i)
      work_of_groups[n + groups.of_constraint(i)] += gain_of_spring(i);
    current.energy_gains.assign(n, 0.);
    last.kinetic_energy = last.energy_gain = 0.;
    for (std::size_t g = 0; g < n; ++g)
    {
      if (!supports_move)
        current.energy_gains[g] =
            work_of_groups[g] - current.kinetic_energies[g] + work_of_groups[n + g];
      current.kinetic_energies[g] = work_of_groups[g];
      last.kinetic_energy += work_of_groups[g];
      last.energy_gain += current.energy_gains[g];
    }
  }

  /**
   * Backward Euler with forces at the ends of steps: kinetic energy falls by the work of inertia
   * and by that of the change of velocity with itself, and the energies of bodies rise by more than
   * the work of their forces at the end where they are not convex. What the sum of both gains comes
   * from nowhere.
   */
  void TimeStepper::measure_energy_at_ends()
  {
    std::vector<double> &gains = work_of_groups, lost(groups.n_groups(), 0.);
    gains.assign(groups.n_groups(), 0.);
    structure.communicator().agree(
        [&]
        {
          for (const std::size_t k : nonlinear.indices())
            gains[groups.of_body(k)] += nonlinear.energy_surplus(k, 1., current);
        });
    BodyVectors change = current.V;
    for (std::size_t k = 0; k < change.size(); ++k)
      for (std::size_t i = 0; i < change[k].size(); ++i)
        change[k][i] -= current.V_old[k][i];
    add_kinetic_energies(change, lost);
    for (std::size_t g = 0; g < gains.size(); ++g)
      gains[g] -= lost[g];
    structure.communicator().sum(gains);
    for (std::size_t i = constraints.n_fixed(); i < constraints.first_moving(); ++i)
      gains[groups.of_constraint(i)] +=
          turning.surplus(i, current.multiplier[i], conditions.gaps().increments()[i]);
    current.energy_gains = gains;
    last.energy_gain = std::accumulate(gains.begin(), gains.end(), 0.);
  }
} // namespace taut
