// SPDX-License-Identifier: LGPL-2.1-or-later
#include "interface/assembled_schur_complement.h"

#include "base/gather_entries.h"
#include "base/instruction_set.h"

#include <algorithm>

namespace taut
{
  bool have_long_columns(const Structure &structure)
  {
    bool has_blocks = false;
    for (std::size_t k = 0; k < structure.size(); ++k)
      has_blocks = has_blocks || structure[k].stiffness().block_size() > 0;
    return !structure.communicator().any(has_blocks);
  }

  AssembledSchurComplement::AssembledSchurComplement(const FactoredStructure &solvers,
                                                     const Constraints &constraints)
      : solvers(solvers), constraints(constraints), processes(solvers.structure().communicator()),
        diagonal_of_bodies(constraints.size(), 0.), columns(constraints.size()),
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

  void AssembledSchurComplement::compute_fixed()
  {
    std::size_t in_columns = 0;
    for (const std::size_t i : constraints.fixed_rows())
    {
      compute(i);
      for (const Response &response : columns[i])
        in_columns += response.x.value.size();
    }
    // Work of a solution: 4 products of b x b blocks a node, b of order 2. Work of a column: two
    // sums of products an entry, see ScalarProduct.
    by_columns = constraints.size() > 0 && 2 * in_columns < 8 * solvers.structure().n_dofs();
  }

  /// Computes the column of constraint i, in the memory of the one before.
  void AssembledSchurComplement::compute(const std::size_t i)
  {
    std::vector<Response> &column = columns[i];
    std::size_t n = 0;
    for (const auto &[k, form, of] : constraints[i].terms)
    {
      const auto known = std::find_if(column.begin(), column.begin() + n,
                                      [k = k](const Response &r) { return r.body == k; });
      if (known == column.begin() + n)
      {
        column.resize(std::max(++n, column.size()));
        column[n - 1].body = k;
        solvers[k].column(form, column[n - 1].x);
        continue;
      }
      // Columns of both ends on one body add, as full vectors.
      solvers[k].column(form, second);
      sum.first = 0;
      sum.value.assign(solvers.structure()[k].n_dofs(), 0.);
      for (const WindowedVector *const x : {&std::as_const(known->x), &std::as_const(second)})
        for (std::size_t e = 0; e < x->value.size(); ++e)
          sum.value[x->first + e] += x->value[e];
      std::swap(known->x, sum);
    }
    column.resize(n);
  }

  double AssembledSchurComplement::entry(const std::size_t i, const std::size_t j) const
  {
    double sum = 0.;
    for (const auto &[k, form, of] : constraints[j].terms)
      for (const auto &[body, x] : columns[i])
        if (body == k)
          sum += x.dot(form);
    return sum;
  }

  template <typename Visit>
  void AssembledSchurComplement::visit_reached(const std::size_t i, const Visit &visit) const
  {
    for (const auto &[body, x] : columns[i])
    {
      const unsigned int begin = x.first, end = begin + static_cast<unsigned int>(x.value.size());
      const auto &list = reach[body];
      auto at = std::lower_bound(list.begin(), list.end(), begin,
                                 [most = widest[body]](const Reach &r, const unsigned int dof)
                                 { return r.first + most < dof; });
      for (; at != list.end() && at->first < end; ++at)
        if (at->last >= begin && at->constraint <= i)
          visit(at->constraint);
    }
  }

  void AssembledSchurComplement::set_compliance(const std::vector<double> &S)
  {
    for (std::size_t i = 0; i < constraints.size(); ++i)
      if (S[i] != compliance[i])
        set_diagonal(i, diagonal_of_bodies[i] + S[i]);
    compliance = S;
  }

  void AssembledSchurComplement::update_moving()
  {
    const std::size_t n = constraints.size();
    const auto &moving = constraints.varying_rows();
    for (const std::size_t i : moving)
      compute(i);
    shares.assign(moving.size() * n, 0.);
    double *share = shares.data();
    for (const std::size_t i : moving)
    {
      visit_reached(i, [&](const std::size_t j) { share[j] = entry(i, j); });
      for (const std::size_t j : moving)
        share[j] = entry(i, j);
      share += n;
    }
    processes.sum(shares);
    share = shares.data();
    for (const std::size_t i : moving)
    {
      diagonal_of_bodies[i] = share[i];
      set_row(i, share);
      share += n;
    }
  }

  void AssembledSchurComplement::contact_free_predictor(const BodyVectors &P,
                                                        std::vector<double> &d,
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
            ScalarProduct product;
            for (const Response &response : columns[i])
              product.add(response.x, P[response.body]);
            d[i] = product.value();
            terms_size[i] = product.size();
          }
        });
  }

  DenseSchurComplement::DenseSchurComplement(const FactoredStructure &solvers,
                                             const Constraints &constraints)
      : AssembledSchurComplement(solvers, constraints),
        stores_columns(constraints.size() <= most_dense_rows ||
                       !have_long_columns(solvers.structure())),
        F(constraints.size())
  {
  }

  void DenseSchurComplement::setup(const std::vector<double> &S)
  {
    compliance = S;
    const std::size_t n = constraints.fixed_rows().size();
    shares.assign(n * (n + 1) / 2, 0.);
    if (stores_columns)
    {
      compute_fixed();
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j <= i; ++j)
          shares[i * (i + 1) / 2 + j] = entry(i, j);
    }
    else
      add_flexibilities();
    processes.sum(shares);
    for (std::size_t i = 0; i < n; ++i)
    {
      const double *const row = shares.data() + i * (i + 1) / 2;
      diagonal_of_bodies[i] = row[i];
      set_row(i, row);
    }
    update_moving();
  }

  /// Adds the lower triangle of the fixed rows of this rank's bodies to `shares`, row after row.
  void DenseSchurComplement::add_flexibilities()
  {
    const std::size_t n_bodies = solvers.structure().size();
    std::vector<std::vector<std::size_t>> row(n_bodies);
    std::vector<std::vector<const LinearForm *>> forms(n_bodies);
    for (const std::size_t i : constraints.fixed_rows())
      for (const Term &term : constraints[i].terms)
      {
        row[term.substructure].push_back(i);
        forms[term.substructure].push_back(&term.form);
      }
    std::vector<double> of_body;
    for (std::size_t k = 0; k < n_bodies; ++k)
    {
      solvers[k].flexibilities(forms[k], of_body);
      auto entry = of_body.begin();
      for (std::size_t a = 0; a < row[k].size(); ++a)
        for (std::size_t b = 0; b <= a; ++b, ++entry)
        {
          const std::size_t i = row[k][a], j = row[k][b];
          shares[i * (i + 1) / 2 + j] += a != b && i == j ? 2. * *entry : *entry;
        }
    }
  }

  void DenseSchurComplement::set_row(const std::size_t i, const double *of_bodies)
  {
    for (std::size_t j = 0; j < i; ++j)
      F.set(i, j, of_bodies[j]);
    F.set(i, i, of_bodies[i] + compliance[i]);
  }

  std::string DenseSchurComplement::description() const
  {
    return "assembled dense, " + std::to_string(constraints.size()) + " constraints" +
           (stores_columns ? "" : ", by half columns");
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
    compute_fixed();
    SymmetricEntries entries;
    std::vector<std::size_t> last_visit(constraints.fixed_rows().size(), constraints.size());
    for (const std::size_t i : constraints.fixed_rows())
      visit_reached(i,
                    [&](const std::size_t j)
                    {
                      if (last_visit[j] != i)
                        entries.add(i, j, entry(i, j));
                      last_visit[j] = i;
                    });
    gather(processes, entries);
    F.set_interior(entries);
    for (const std::size_t i : constraints.fixed_rows())
    {
      diagonal_of_bodies[i] = F.diagonal(i);
      F.set_diagonal(i, diagonal_of_bodies[i] + S[i]);
    }
    update_moving();
  }

  void SparseSchurComplement::set_row(const std::size_t i, const double *of_bodies)
  {
    border.assign(of_bodies, of_bodies + constraints.size());
    border[i] += compliance[i];
    F.set_border(i, border);
  }

  std::string SparseSchurComplement::description() const
  {
    return "assembled sparse, " + std::to_string(constraints.size()) + " constraints, " +
           std::to_string(F.n_entries()) + " entries";
  }
} // namespace taut
