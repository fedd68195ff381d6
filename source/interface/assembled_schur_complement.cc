// SPDX-License-Identifier: LGPL-2.1-or-later
#include "assembled_schur_complement.h"

#include <taut/base/gather_entries.h>

namespace taut
{
  AssembledSchurComplement::AssembledSchurComplement(const FactoredStructure &solvers,
                                                     const Constraints &constraints)
      : solvers(solvers), constraints(constraints), processes(solvers.structure().communicator()),
        columns(solvers, constraints), of_bodies(constraints.size(), 0.)
  {
  }

  void AssembledSchurComplement::contact_free_predictor(const BodyVectors &P,
                                                        std::vector<double> &d,
                                                        std::vector<double> &terms_size) const
  {
    columns.contact_free_predictor(P, d, terms_size);
  }

  const std::vector<double> &AssembledSchurComplement::compute_moving()
  {
    const std::size_t n = constraints.size(), n_fixed = constraints.fixed_rows().size();
    for (const std::size_t i : constraints.varying_rows())
      columns.compute(i);
    shares.assign((n - n_fixed) * n, 0.);
    for (const std::size_t i : constraints.varying_rows())
    {
      double *share = shares.data() + (i - n_fixed) * n;
      columns.visit_reached(i, [&](const std::size_t j) { share[j] = columns.entry(i, j); });
      for (const std::size_t j : constraints.varying_rows())
        share[j] = columns.entry(i, j);
    }
    processes.sum(shares);
    return shares;
  }

  DenseSchurComplement::DenseSchurComplement(const FactoredStructure &solvers,
                                             const Constraints &constraints)
      : AssembledSchurComplement(solvers, constraints), F(constraints.size())
  {
  }

  void DenseSchurComplement::setup(const std::vector<double> &S)
  {
    compliance = S;
    columns.setup();
    // Few exchanges, and little memory beside that of F.
    constexpr std::size_t most_numbers = 1000000;
    const auto &rows = constraints.fixed_rows();
    for (std::size_t begin = 0, end = 0; begin < rows.size(); begin = end)
    {
      shares.clear();
      for (; end < rows.size() && (end == begin || shares.size() < most_numbers); ++end)
        for (std::size_t j = 0; j <= rows[end]; ++j)
          shares.push_back(columns.entry(rows[end], j));
      processes.sum(shares);
      const double *share = shares.data();
      for (std::size_t r = begin; r < end; share += rows[r] + 1, ++r)
        set_row(rows[r], share);
    }
    update_moving();
  }

  void DenseSchurComplement::update_moving()
  {
    const double *share = compute_moving().data();
    for (const std::size_t i : constraints.varying_rows())
    {
      set_row(i, share);
      share += constraints.size();
    }
  }

  void DenseSchurComplement::set_row(const std::size_t i, const double *entries)
  {
    for (std::size_t j = 0; j < i; ++j)
      F.set(i, j, entries[j]);
    of_bodies[i] = entries[i];
    F.set(i, i, entries[i] + compliance[i]);
  }

  void DenseSchurComplement::set_compliance(const std::vector<double> &S)
  {
    compliance = S;
    for (std::size_t i = 0; i < constraints.size(); ++i)
      F.set(i, i, of_bodies[i] + compliance[i]);
  }

  std::string DenseSchurComplement::description() const
  {
    return "assembled dense, " + std::to_string(constraints.size()) + " constraints";
  }

  void CondensedSchurComplement::setup(const std::vector<double> &S)
  {
    compliance = S;
    const std::size_t n = constraints.fixed_rows().size();
    const std::size_t n_bodies = solvers.structure().size();
    std::vector<std::vector<std::size_t>> row(n_bodies);
    std::vector<std::vector<const LinearForm *>> forms(n_bodies);
    for (std::size_t i = 0; i < n; ++i)
      for (const Term &term : constraints[i].terms)
      {
        row[term.substructure].push_back(i);
        forms[term.substructure].push_back(&term.form);
      }
    std::vector<double> entries(n * (n + 1) / 2, 0.), of_body;
    for (std::size_t k = 0; k < n_bodies; ++k)
    {
      solvers[k].flexibilities(forms[k], of_body);
      auto entry = of_body.begin();
      for (std::size_t a = 0; a < row[k].size(); ++a)
        for (std::size_t b = 0; b <= a; ++b, ++entry)
        {
          const std::size_t i = row[k][a], j = row[k][b];
          entries[i * (i + 1) / 2 + j] += a != b && i == j ? 2. * *entry : *entry;
        }
    }
    processes.sum(entries);
    for (std::size_t i = 0; i < n; ++i)
      set_row(i, entries.data() + i * (i + 1) / 2);
    update_moving();
  }

  std::string CondensedSchurComplement::description() const
  {
    return "condensed, " + std::to_string(constraints.size()) + " constraints";
  }

  SparseSchurComplement::SparseSchurComplement(const FactoredStructure &solvers,
                                               const Constraints &constraints)
      : AssembledSchurComplement(solvers, constraints)
  {
    F.reinit(constraints.size(), constraints.varying_rows().size());
  }

  void SparseSchurComplement::setup(const std::vector<double> &S)
  {
    compliance = S;
    columns.setup();
    entries.row.clear();
    entries.column.clear();
    entries.value.clear();
    last_visit.assign(constraints.fixed_rows().size(), constraints.size());
    for (const std::size_t i : constraints.fixed_rows())
      columns.visit_reached(i,
                            [&](const std::size_t j)
                            {
                              if (last_visit[j] != i)
                                entries.add(i, j, columns.entry(i, j));
                              last_visit[j] = i;
                            });
    gather(processes, entries);
    F.set_interior(entries);
    for (const std::size_t i : constraints.fixed_rows())
    {
      of_bodies[i] = F.diagonal(i);
      F.set_diagonal(i, of_bodies[i] + S[i]);
    }
    update_moving();
  }

  void SparseSchurComplement::set_compliance(const std::vector<double> &S)
  {
    for (std::size_t i = 0; i < constraints.size(); ++i)
      if (S[i] != compliance[i])
        F.set_diagonal(i, of_bodies[i] + S[i]);
    compliance = S;
  }

  void SparseSchurComplement::update_moving()
  {
    const double *share = compute_moving().data();
    for (const std::size_t i : constraints.varying_rows())
    {
      border.assign(share, share + constraints.size());
      of_bodies[i] = border[i];
      border[i] += compliance[i];
      F.set_border(i, border);
      share += constraints.size();
    }
  }

  std::string SparseSchurComplement::description() const
  {
    return "assembled sparse, " + std::to_string(constraints.size()) + " constraints, " +
           std::to_string(F.n_entries()) + " entries";
  }
} // namespace taut
