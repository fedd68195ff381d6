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

  void AssembledSchurComplement::compute_moving()
  {
    for (std::size_t i = rows.n_fixed(); i < rows.size(); ++i)
      columns.compute(i);
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
      set_rows(i, i + 1);
    update_moving();
  }

  void DenseSchurComplement::update_moving()
  {
    compute_moving();
    set_rows(rows.n_fixed(), rows.size());
  }

  /// The rows of F from the columns, left of the diagonal and on it.
  void DenseSchurComplement::set_rows(const std::size_t begin, const std::size_t end)
  {
    shares.clear();
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t j = 0; j <= i; ++j)
        shares.push_back(columns.entry(i, j));
    processes.sum(shares);
    const double *share = shares.data();
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t j = 0; j <= i; ++j, ++share)
        F.set(i, j, *share + (i == j ? compliance[i] : 0.));
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
    compute_moving();
    const std::size_t n = rows.size(), n_fixed = rows.n_fixed();
    shares.assign((n - n_fixed) * n, 0.);
    for (std::size_t i = n_fixed; i < n; ++i)
    {
      double *share = shares.data() + (i - n_fixed) * n;
      columns.visit_reached(i, [&](const std::size_t j) { share[j] = columns.entry(i, j); });
      for (std::size_t j = n_fixed; j < n; ++j)
        share[j] = columns.entry(i, j);
    }
    processes.sum(shares);
    for (std::size_t i = n_fixed; i < n; ++i)
    {
      const auto begin = shares.begin() + (i - n_fixed) * n;
      begin[i] += compliance[i];
      F.set_border(i, std::vector<double>(begin, begin + n));
    }
  }

  std::string SparseSchurComplement::description() const
  {
    return "assembled sparse, " + std::to_string(rows.size()) + " rows, " +
           std::to_string(F.n_entries()) + " entries";
  }
} // namespace taut
