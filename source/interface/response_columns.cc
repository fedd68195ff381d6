// SPDX-License-Identifier: LGPL-2.1-or-later
#include "response_columns.h"

#include <taut/base/instruction_set.h>

#include <algorithm>

namespace taut
{
  ResponseColumns::ResponseColumns(const FactoredStructure &solvers, const Constraints &constraints)
      : solvers(solvers), constraints(constraints), columns(constraints.size()),
        reach(solvers.structure().size()), widest(solvers.structure().size(), 0)
  {
    for (const std::size_t i : constraints.fixed_rows())
      for (const auto &[k, form, of] : constraints[i].terms)
      {
        if (form.index.empty())
          continue;
        const auto [first, last] = std::minmax_element(form.index.begin(), form.index.end());
        reach[k].push_back({*first, *last, i});
        widest[k] = std::max(widest[k], *last - *first);
      }
    for (std::vector<Reach> &list : reach)
      std::sort(list.begin(), list.end(),
                [](const Reach &a, const Reach &b) { return a.first < b.first; });
  }

  void ResponseColumns::setup()
  {
    std::size_t in_columns = 0;
    for (const std::size_t i : constraints.fixed_rows())
    {
      compute(i);
      for (std::size_t p = 0; p < columns[i].substructure.size(); ++p)
        in_columns += columns[i].part[p].value.size();
    }
    // Work of a solution: 4 products of b x b blocks a node, b of order 2. Work of a column: two
    // sums of products an entry, see ScalarProduct.
    by_columns = constraints.size() > 0 && 2 * in_columns < 8 * solvers.structure().n_dofs();
  }

  void ResponseColumns::compute(const std::size_t i)
  {
    Column &column = columns[i];
    column.substructure.clear();
    const std::vector<Term> &terms = constraints[i].terms;
    std::size_t used = 0;
    for (std::size_t a = 0; a < terms.size(); ++a)
    {
      if (column.part.size() <= used)
        column.part.emplace_back();
      // Columns of both ends on one substructure add, as full vectors.
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

  double ResponseColumns::entry(const std::size_t i, const std::size_t j) const
  {
    double sum = 0.;
    const Column &c = columns[i];
    for (const Term &term : constraints[j].terms)
      for (std::size_t p = 0; p < c.substructure.size(); ++p)
        if (c.substructure[p] == term.substructure)
          sum += c.part[p].dot(term.form);
    return sum;
  }

  void ResponseColumns::contact_free_predictor(const BodyVectors &P, std::vector<double> &d,
                                               std::vector<double> &terms_size) const
  {
    d.resize(constraints.size());
    terms_size.resize(constraints.size());
    if (!by_columns)
    {
      work = P;
      solvers.solve(work);
      constraints.share_of_motions(work, d, terms_size);
      return;
    }
    vectorised(
        [&]
        {
          for (std::size_t i = 0; i < constraints.size(); ++i)
          {
            const Column &column = columns[i];
            ScalarProduct product;
            for (std::size_t p = 0; p < column.substructure.size(); ++p)
              product.add(column.part[p], P[column.substructure[p]]);
            d[i] = product.value();
            terms_size[i] = product.size();
          }
        });
  }
} // namespace taut
