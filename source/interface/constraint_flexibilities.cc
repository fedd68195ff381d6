// SPDX-License-Identifier: LGPL-2.1-or-later
#include "constraint_flexibilities.h"

#include <cmath>
#include <numeric>

namespace taut
{
  RowFlexibilities::RowFlexibilities(const FactoredStructure &solvers,
                                     const BodyConstraints &constraints)
      : solvers(solvers), constraints(constraints), parts(constraints.size()),
        group_of(constraints.size()), n_groups(constraints.size(), 1)
  {
  }

  void RowFlexibilities::find_coupling(const std::size_t k)
  {
    std::vector<unsigned int> root(solvers.structure()[k].n_dofs());
    std::iota(root.begin(), root.end(), 0);
    const auto find = [&](unsigned int i)
    {
      while (root[i] != i)
        i = root[i] = root[root[i]];
      return i;
    };
    solvers.visit(k,
                  [&](unsigned int i, unsigned int j, double value)
                  {
                    if (i != j && value != 0.)
                      root[find(i)] = find(j);
                  });
    std::vector<unsigned int> number(root.size(), 0);
    n_groups[k] = 0;
    for (unsigned int i = 0; i < root.size(); ++i)
      if (root[i] == i)
        number[i] = n_groups[k]++;
    group_of[k].clear();
    for (unsigned int i = 0; i < root.size() && n_groups[k] > 1; ++i)
      group_of[k].push_back(number[find(i)]);
  }

  void RowFlexibilities::compute(const std::size_t k)
  {
    parts[k].clear();
    for (const BodyConstraints::Entry &entry : constraints[k])
    {
      if (n_groups[k] <= 1)
      {
        parts[k].push_back({entry.constraint, 0, solvers[k].flexibility(entry.form)});
        continue;
      }
      std::vector<LinearForm> forms(n_groups[k]);
      for (std::size_t e = 0; e < entry.form.index.size(); ++e)
        forms[group_of[k][entry.form.index[e]]].add(entry.form.index[e], entry.form.value[e]);
      for (unsigned int g = 0; g < forms.size(); ++g)
        if (!forms[g].index.empty())
          parts[k].push_back({entry.constraint, g, solvers[k].flexibility(forms[g])});
    }
  }

  void RowFlexibilities::add_to_diagonal(std::vector<double> &diagonal) const
  {
    for (const std::vector<Part> &of_body : parts)
      for (const Part &part : of_body)
        diagonal[part.constraint] += part.flexibility;
  }

  void RowFlexibilities::add_bound(const std::vector<double> &x, std::vector<double> &y) const
  {
    for (std::size_t k = 0; k < parts.size(); ++k)
    {
      sums.assign(n_groups[k], 0.);
      for (const Part &part : parts[k])
        sums[part.group] += std::sqrt(part.flexibility) * std::fabs(x[part.constraint]);
      for (const Part &part : parts[k])
        y[part.constraint] += std::sqrt(part.flexibility) * sums[part.group];
    }
  }
} // namespace taut
