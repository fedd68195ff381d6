// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/gather_entries.h"
#include "base/groups.h"
#include <taut/interface/connected_bodies.h>

#include <algorithm>

namespace taut
{
  ConnectedBodies::ConnectedBodies(const Structure &structure, const Constraints &constraints,
                                   const std::function<bool(std::size_t)> &connects)
  {
    constexpr double joined = 1., apart = 0.;
    MatrixEntries acts_on;
    for (std::size_t i = 0; i < constraints.size(); ++i)
      for (const std::vector<Term> *const form : constraints[i].forms())
        for (const Term &term : *form)
          acts_on.add(constraints.number(i), structure.number(term.substructure),
                      !connects || connects(i) ? joined : apart);
    Groups groups(structure.all_bodies().size());
    constraints.sum_entries(acts_on, structure.all_bodies().size());
    std::vector<std::size_t> first(constraints.size(), no_link); // body of each row
    MatrixEntries joins;
    for (std::size_t e = 0; e < acts_on.size(); ++e)
    {
      const auto k = static_cast<std::size_t>(acts_on.column[e]);
      if (std::size_t &other = first[constraints.index(acts_on.row[e])]; other == no_link)
        other = k;
      else if (acts_on.value[e] != apart && !groups.are_joined(k, other))
      {
        groups.join(k, other);
        joins.add(k, other, joined);
      }
    }
    if (constraints.shared()) // other ranks see other rows
      gather(structure.communicator(), joins);
    for (std::size_t e = 0; e < joins.size(); ++e)
      groups.join(joins.row[e], joins.column[e]);

    const std::vector<std::size_t> group = groups.numbers();
    for (const std::size_t number : group)
      n = std::max(n, number + 1);
    for (std::size_t k = 0; k < structure.size(); ++k)
      body.push_back(group[structure.number(k)]);
    for (const std::size_t k : first)
      constraint.push_back(k == no_link ? 0 : group[k]);
  }
} // namespace taut
