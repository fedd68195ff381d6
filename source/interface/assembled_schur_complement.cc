// SPDX-License-Identifier: LGPL-2.1-or-later
#include "assembled_schur_complement.h"

#include "matrix_free_schur_complement.h"

#include <taut/base/exceptions.h>

#include <algorithm>

namespace taut
{
  AssembledSchurComplement::AssembledSchurComplement(const FactoredStructure &solvers,
                                                     const ContactRows &rows)
      : solvers(solvers), rows(rows), F(rows.size()), columns(rows.size())
  {
  }

  void AssembledSchurComplement::compute_column(const std::size_t i)
  {
    Column &column = columns[i];
    column.substructure.clear();
    const std::vector<Term> &terms = rows[i].terms;
    std::size_t used = 0;
    for (std::size_t a = 0; a < terms.size(); ++a)
    {
      if (column.part.size() <= used)
        column.part.emplace_back();
      // Both ends of a row on one substructure: their columns add, as full vectors.
      const auto known =
          std::find(column.substructure.begin(), column.substructure.end(), terms[a].substructure);
      if (known == column.substructure.end())
      {
        solvers[terms[a].substructure].column(terms[a].form, column.part[used]);
        column.substructure.push_back(terms[a].substructure);
        ++used;
        continue;
      }
      WindowedVector &sum = column.part[known - column.substructure.begin()], second;
      solvers[terms[a].substructure].column(terms[a].form, second);
      std::vector<double> full(solvers.structure()[terms[a].substructure].n_dofs(), 0.);
      for (const WindowedVector *part : {&std::as_const(sum), &std::as_const(second)})
        for (std::size_t k = 0; k < part->value.size(); ++k)
          full[part->first + k] += part->value[k];
      sum.first = 0;
      sum.value = std::move(full);
    }
  }

  double AssembledSchurComplement::entry(const std::size_t column,
                                         const std::vector<Term> &terms) const
  {
    double sum = 0.;
    const Column &c = columns[column];
    for (const Term &term : terms)
      for (std::size_t p = 0; p < c.substructure.size(); ++p)
        if (c.substructure[p] == term.substructure)
          sum += c.part[p].dot(term.form);
    return sum;
  }

  void AssembledSchurComplement::setup(const std::vector<double> &S)
  {
    compliance = S;
    const std::size_t n = rows.size();
    for (std::size_t i = 0; i < rows.n_fixed(); ++i)
      compute_column(i);
    for (std::size_t i = 0; i < rows.n_fixed(); ++i)
      set_rows(i, i + 1);

    // Work of a solve: 4 products of b x b blocks a node, b of order 2; of a column: one product an
    // entry.
    std::size_t in_columns = 0;
    for (std::size_t i = 0; i < rows.n_fixed(); ++i)
      for (const WindowedVector &part : columns[i].part)
        in_columns += part.value.size();
    by_columns = n > 0 && in_columns < 8 * solvers.structure().n_dofs();
    work = solvers.structure().zero();
    update_moving();
  }

  void AssembledSchurComplement::update_moving()
  {
    for (std::size_t i = rows.n_fixed(); i < rows.size(); ++i)
      compute_column(i);
    set_rows(rows.n_fixed(), rows.size());
  }

  /// The rows of F from the columns, left of the diagonal and on it.
  void AssembledSchurComplement::set_rows(const std::size_t begin, const std::size_t end)
  {
    shares.clear();
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t j = 0; j <= i; ++j)
        shares.push_back(entry(i, rows[j].terms));
    solvers.structure().communicator().sum(shares);
    const double *share = shares.data();
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t j = 0; j <= i; ++j, ++share)
        F.set(i, j, *share + (i == j ? compliance[i] : 0.));
  }

  void AssembledSchurComplement::free_motion(const BlockVector &P, std::vector<double> &d) const
  {
    d.resize(rows.size());
    if (by_columns)
    {
      for (std::size_t i = 0; i < rows.size(); ++i)
      {
        d[i] = 0.;
        const Column &column = columns[i];
        for (std::size_t p = 0; p < column.substructure.size(); ++p)
          d[i] += column.part[p].dot(P[column.substructure[p]]);
      }
      return;
    }
    work = P;
    solvers.solve(work);
    for (std::size_t i = 0; i < rows.size(); ++i)
      d[i] = evaluate(rows[i].terms, work);
  }

  std::unique_ptr<SchurComplement> make_schur_complement(const std::string &form,
                                                         const FactoredStructure &solvers,
                                                         const ContactRows &rows)
  {
    if (form == "assembled")
      return std::make_unique<AssembledSchurComplement>(solvers, rows);
    if (form == "matrix-free")
      return std::make_unique<MatrixFreeSchurComplement>(solvers, rows);
    throw UserError("unknown form of the interface operator '" + form +
                    "'; known are: assembled, matrix-free");
  }
} // namespace taut
