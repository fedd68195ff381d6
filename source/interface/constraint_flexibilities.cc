// SPDX-License-Identifier: LGPL-2.1-or-later
#include "interface/constraint_flexibilities.h"

#include "base/groups.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace taut
{
  namespace
  {
    /// Number of cuts of a body above which flexibilities are estimated, and size of the sample. An
    /// exact one costs a solution; an estimate only scales the norm in which an iteration ends.
    constexpr std::size_t most_exact = 100, n_sampled_cuts = 16;

    /// b^T diag(A)^-1 b.
    double local_flexibility(const LinearForm &form, const std::vector<double> &diagonal)
    {
      double sum = 0.;
      for (std::size_t e = 0; e < form.index.size(); ++e)
        if (diagonal[form.index[e]] > 0.)
          sum += form.value[e] * form.value[e] / diagonal[form.index[e]];
      return sum;
    }
  } // namespace

  RowFlexibilities::RowFlexibilities(const FactoredStructure &solvers,
                                     const BodyConstraints &constraints, std::vector<char> is_cut)
      : solvers(solvers), constraints(constraints), is_cut(std::move(is_cut)),
        parts(constraints.size()), group_of(constraints.size()), n_groups(constraints.size(), 1)
  {
  }

  std::vector<double> RowFlexibilities::diagonal_of(const std::size_t k) const
  {
    std::vector<double> diagonal(solvers.structure()[k].n_dofs(), 0.);
    solvers.visit(k,
                  [&](unsigned int i, unsigned int j, double value)
                  {
                    if (i == j)
                      diagonal[i] += value;
                  });
    return diagonal;
  }

  /// True if the body has so many cuts; @p samples are some of them, spread evenly.
  bool RowFlexibilities::estimates(const std::size_t k,
                                   std::vector<const BodyConstraints::Entry *> &samples) const
  {
    std::vector<const BodyConstraints::Entry *> cuts;
    for (const BodyConstraints::Entry &entry : constraints[k])
      if (is_cut[entry.constraint])
        cuts.push_back(&entry);
    if (cuts.size() <= most_exact || n_groups[k] > 1 ||
        solvers.structure()[k].stiffness().block_size() > 0)
      return false;
    for (std::size_t s = 0; s < n_sampled_cuts; ++s)
      samples.push_back(cuts[s * cuts.size() / n_sampled_cuts]);
    return true;
  }

  /// After factoring: of body k.
  void RowFlexibilities::find_coupling(const std::size_t k)
  {
    Groups coupled(solvers.structure()[k].n_dofs());
    solvers.visit(k,
                  [&](unsigned int i, unsigned int j, double value)
                  {
                    if (i != j && value != 0.)
                      coupled.join(i, j);
                  });
    n_groups[k] = coupled.members().size();
    group_of[k] = n_groups[k] > 1 ? coupled.numbers() : std::vector<std::size_t>();
  }

  /// Of the constraints of body k, after they or its factor have changed.
  void RowFlexibilities::compute(const std::size_t k)
  {
    parts[k].clear();
    const std::vector<double> diagonal = diagonal_of(k);
    std::vector<const BodyConstraints::Entry *> samples;
    const bool has_estimates = estimates(k, samples);
    double ratio = 0.;
    for (const BodyConstraints::Entry *entry : samples)
      if (const double local = local_flexibility(entry->form, diagonal); local > 0.)
        ratio = std::max(ratio, solvers[k].flexibility(entry->form) / local);
    std::vector<LinearForm> forms; // of the parts that are not estimated
    std::vector<std::size_t> of_part;
    const auto add_form =
        [&](const std::size_t constraint, const unsigned int group, const LinearForm &form)
    {
      of_part.push_back(parts[k].size());
      parts[k].push_back({constraint, group, 0.});
      forms.push_back(form);
    };
    for (const BodyConstraints::Entry &entry : constraints[k])
    {
      if (has_estimates && is_cut[entry.constraint])
      {
        parts[k].push_back({entry.constraint, 0, ratio * local_flexibility(entry.form, diagonal)});
        continue;
      }
      if (n_groups[k] <= 1)
      {
        add_form(entry.constraint, 0, entry.form);
        continue;
      }
      std::vector<LinearForm> by_group(n_groups[k]);
      for (std::size_t e = 0; e < entry.form.index.size(); ++e)
        by_group[group_of[k][entry.form.index[e]]].add(entry.form.index[e], entry.form.value[e]);
      for (unsigned int g = 0; g < by_group.size(); ++g)
        if (!by_group[g].index.empty())
          add_form(entry.constraint, g, by_group[g]);
    }
    std::vector<const LinearForm *> rows;
    for (const LinearForm &form : forms)
      rows.push_back(&form);
    std::vector<double> F;
    solvers[k].own_flexibilities(rows, F);
    for (std::size_t r = 0; r < rows.size(); ++r)
      parts[k][of_part[r]].flexibility = F[r];
  }

  void RowFlexibilities::setup(const std::vector<double> &S)
  {
    compliance = S;
    for (std::size_t k = 0; k < parts.size(); ++k)
    {
      find_coupling(k);
      compute(k);
    }
    sum_up();
  }

  void RowFlexibilities::update(const std::set<std::size_t> &bodies)
  {
    for (const std::size_t k : bodies)
      compute(k);
    sum_up();
  }

  /// What the bodies give to the diagonals, on all ranks.
  void RowFlexibilities::sum_up()
  {
    of_bodies.assign(is_cut.size(), 0.);
    for (const std::vector<Part> &of_body : parts)
      for (const Part &part : of_body)
        of_bodies[part.constraint] += part.flexibility;
    constraints.all().sum(of_bodies);
    local_of_bodies = of_bodies;
    if (solvers.is_generalised_inverse())
    {
      local_of_bodies.assign(is_cut.size(), 0.);
      for (std::size_t k = 0; k < parts.size(); ++k)
      {
        const std::vector<double> own = diagonal_of(k);
        for (const BodyConstraints::Entry &entry : constraints[k])
          local_of_bodies[entry.constraint] += local_flexibility(entry.form, own);
      }
      constraints.all().sum(local_of_bodies);
    }
    set_compliance(compliance);
  }

  void RowFlexibilities::set_compliance(const std::vector<double> &S)
  {
    compliance = S;
    entries.resize(is_cut.size());
    scales.assign(is_cut.size(), 1.);
    for (std::size_t i = 0; i < is_cut.size(); ++i)
    {
      entries[i] = of_bodies[i] + compliance[i];
      const double local = local_of_bodies[i] + compliance[i],
                   size = local > 0. ? local : entries[i];
      if (size > 0.)
        scales[i] = 1. / std::sqrt(size);
    }
  }

  void RowFlexibilities::bound(const std::vector<double> &x, std::vector<double> &y) const
  {
    share.assign(x.size(), 0.);
    for (std::size_t k = 0; k < parts.size(); ++k)
    {
      sums.assign(n_groups[k], 0.);
      for (const Part &part : parts[k])
        sums[part.group] += std::sqrt(part.flexibility) * std::fabs(x[part.constraint]);
      for (const Part &part : parts[k])
        share[part.constraint] += std::sqrt(part.flexibility) * sums[part.group];
    }
    constraints.all().sum(share);
    y.resize(x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
      y[i] = share[i] + compliance[i] * std::fabs(x[i]);
  }
} // namespace taut
