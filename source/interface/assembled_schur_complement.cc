// SPDX-License-Identifier: LGPL-2.1-or-later
#include "assembled_schur_complement.h"

#include <taut/base/gather_entries.h>

namespace taut
{
  AssembledSchurComplement::AssembledSchurComplement(const FactoredStructure &solvers,
                                                     const ContactRows &rows)
      : rows(rows), processes(solvers.structure().communicator()), columns(solvers, rows)
  {
  }

  void AssembledSchurComplement::free_motion(const BlockVector &P, std::vector<double> &d,
                                             std::vector<double> &terms_size) const
  {
    columns.free_motion(P, d, terms_size);
  }

  const std::vector<double> &AssembledSchurComplement::compute_moving()
  {
    const std::size_t n = rows.size(), n_fixed = rows.n_fixed();
    for (std::size_t i = n_fixed; i < n; ++i)
      columns.compute(i);
    shares.assign((n - n_fixed) * n, 0.);
    for (std::size_t i = n_fixed; i < n; ++i)
    {
      double *share = shares.data() + (i - n_fixed) * n;
      columns.visit_reached(i, [&](const std::size_t j) { share[j] = columns.entry(i, j); });
      for (std::size_t j = n_fixed; j < n; ++j)
        share[j] = columns.entry(i, j);
    }
    processes.sum(shares);
    return shares;
  }

  DenseSchurComplement::DenseSchurComplement(const FactoredStructure &solvers,
                                             const ContactRows &rows)
      : AssembledSchurComplement(solvers, rows), F(rows.size())
  {
  }

  void DenseSchurComplement::setup(const std::vector<double> &S)
  {
    compliance = S;
    columns.setup();
    for (std::size_t i = 0; i < rows.n_fixed(); ++i)
    {
      shares.clear();
      for (std::size_t j = 0; j <= i; ++j)
        shares.push_back(columns.entry(i, j));
      processes.sum(shares);
      set_row(i, shares.data());
    }
    update_moving();
  }

  void DenseSchurComplement::update_moving()
  {
    const double *share = compute_moving().data();
    for (std::size_t i = rows.n_fixed(); i < rows.size(); ++i, share += rows.size())
      set_row(i, share);
  }

  void DenseSchurComplement::set_row(const std::size_t i, const double *entries)
  {
    for (std::size_t j = 0; j < i; ++j)
      F.set(i, j, entries[j]);
    F.set(i, i, entries[i] + compliance[i]);
  }

  std::string DenseSchurComplement::description() const
  {
    return "assembled dense, " + std::to_string(rows.size()) + " rows";
  }

  SparseSchurComplement::SparseSchurComplement(const FactoredStructure &solvers,
                                               const ContactRows &rows)
      : AssembledSchurComplement(solvers, rows)
  {
    F.reinit(rows.size(), rows.size() - rows.n_fixed());
  }

  void SparseSchurComplement::setup(const std::vector<double> &S)
  {
    compliance = S;
    columns.setup();
    SymmetricEntries entries;
    std::vector<std::size_t> last_visit(rows.n_fixed(), rows.size());
    for (std::size_t i = 0; i < rows.n_fixed(); ++i)
    {
      columns.visit_reached(i,
                            [&](const std::size_t j)
                            {
                              if (last_visit[j] != i)
                                entries.add(i, j, columns.entry(i, j));
                              last_visit[j] = i;
                            });
    }
    gather(processes, entries);
    for (std::size_t i = 0; i < rows.n_fixed(); ++i)
      entries.add(i, i, S[i]);
    F.set_interior(entries);
    update_moving();
  }

  void SparseSchurComplement::update_moving()
  {
    const double *share = compute_moving().data();
    for (std::size_t i = rows.n_fixed(); i < rows.size(); ++i, share += rows.size())
    {
      std::vector<double> border(share, share + rows.size());
      border[i] += compliance[i];
      F.set_border(i, border);
    }
  }

  std::string SparseSchurComplement::description() const
  {
    return "assembled sparse, " + std::to_string(rows.size()) + " rows, " +
           std::to_string(F.n_entries()) + " entries";
  }
} // namespace taut
