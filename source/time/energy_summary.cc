// SPDX-License-Identifier: LGPL-2.1-or-later
// What an account of energy says of all ranks: the worst contact, and large motions.
#include <taut/time/energy_account.h>

#include <algorithm>
#include <cmath>

namespace taut
{
  void EnergyAccount::find_worst() const
  {
    using Worst = WorstOfGroups;
    Worst &result = worst;
    result.largest.assign(Worst::n_of_largest * groups.size(), 0.);
    result.number.assign(Worst::n_of_largest * groups.size(), no_link);
    result.sums.assign(2 * groups.size(), 0.);
    for (const std::size_t i : constraints.rows_but_cuts())
    {
      if (!constraints[i].cone.may_open())
        continue;
      const Contacts contacts = contacts_of(i);
      const std::size_t g = connected.of_constraint(i);
      const auto raise = [&](const Worst::Of of, const double value)
      {
        const std::size_t at = Worst::n_of_largest * g + of;
        if (!(value > result.largest[at]))
          return;
        result.largest[at] = value;
        result.number[at] = i;
      };
      raise(Worst::energy, contacts.given + contacts.taken);
      raise(Worst::momentum, contacts.momentum);
      raise(Worst::impulse, contacts.impulse);
      if (!constraints.counts(i))
        continue;
      result.sums[2 * g] += contacts.given;
      result.sums[2 * g + 1] += contacts.taken;
    }
    constraints.take_largest(result.largest, result.number);
    constraints.add_up(result.sums);
  }

  EnergySummary EnergyAccount::summary() const
  {
    find_worst();
    EnergySummary result;
    find_energy(result);
    find_momentum(result);
    return result;
  }

  /// Finds the group with most contact energy, and its worst constraint.
  void EnergyAccount::find_energy(EnergySummary &result) const
  {
    for (std::size_t g = 0; g < groups.size(); ++g)
    {
      const std::size_t first = groups[g].first_one_sided,
                        number = worst.number_of(g, WorstOfGroups::energy);
      const double taken = worst.sums[2 * g + 1],
                   energy = groups[g].contact_gains + worst.sums[2 * g] + taken,
                   scale = groups[g].scale();
      if (first != no_link && energy > result.relative_energy * scale)
      {
        result.relative_energy = energy / scale;
        result.contact_energy = energy;
        result.taken = taken;
        result.scale = scale;
        result.energy_constraint = number == no_link ? first : number;
      }
      const double gain = groups[g].motion_gains - n_steps * groups[g].rest_of_step;
      result.motion_energy += groups[g].motion_gains;
      if (gain > 0.)
        result.relative_motion_energy = std::max(result.relative_motion_energy, gain / scale);
    }
    if (result.energy_constraint == no_link)
      return;
    std::vector<double> &of_worst = worst.contact;
    of_worst.assign(4, 0.);
    if (const std::size_t i = constraints.index(result.energy_constraint);
        i < rows.size() && constraints.counts(i))
    {
      const Contacts contacts = contacts_of(i);
      of_worst = {contacts.begin, contacts.end, contacts.shortest, contacts.step};
    }
    constraints.add_up(of_worst);
    result.energy_begin = of_worst[0];
    result.energy_end = of_worst[1];
    result.contact_time = std::isfinite(of_worst[2]) ? of_worst[2] : 0.;
    result.step = of_worst[3];
  }

  void EnergyAccount::find_momentum(EnergySummary &result) const
  {
    for (std::size_t g = 0; g < groups.size(); ++g)
      if (const double impulse = worst.of(g, WorstOfGroups::impulse),
          momentum = worst.of(g, WorstOfGroups::momentum);
          impulse > 0. && momentum > result.relative_momentum * impulse)
      {
        result.momentum = momentum;
        result.relative_momentum = momentum / impulse;
        result.momentum_constraint = worst.number_of(g, WorstOfGroups::momentum);
      }
  }
} // namespace taut
