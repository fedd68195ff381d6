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
    gather(structure.communicator(), acts_on);

    Groups groups(structure.all_bodies().size());
    constexpr std::size_t none = no_link;
    std::vector<std::size_t> first(constraints.n_of_all(), none);
    for (std::size_t e = 0; e < acts_on.size(); ++e)
      if (std::size_t &other = first[acts_on.row[e]]; other == none)
        other = acts_on.column[e];
      else if (acts_on.value[e] == joined)
        groups.join(acts_on.column[e], other);

    const std::vector<std::size_t> group = groups.numbers();
    for (const std::size_t number : group)
      n = std::max(n, number + 1);
    for (std::size_t k = 0; k < structure.size(); ++k)
      body.push_back(group[structure.number(k)]);
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      const std::size_t b = first[constraints.number(i)];
      constraint.push_back(b == none ? 0 : group[b]);
    }
  }
} // namespace taut
