// SPDX-License-Identifier: LGPL-2.1-or-later
#include "row_preconditioner.h"

#include <taut/base/exceptions.h>
#include <taut/base/gather_entries.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace taut
{
  namespace
  {
    /// A Schur complement's diagonal below this part of the matrix's own is rounding: the body is
    /// free to follow.
    constexpr double smallest_stiffness = 1e-9;

    constexpr std::size_t nowhere = std::numeric_limits<std::size_t>::max();

    /// Position of each DoF in a sorted list.
    std::vector<std::size_t> positions(const std::vector<unsigned int> &dofs, const std::size_t n)
    {
      std::vector<std::size_t> result(n, nowhere);
      for (std::size_t p = 0; p < dofs.size(); ++p)
        result[dofs[p]] = p;
      return result;
    }
  } // namespace

  RowPreconditioner::RowPreconditioner(const std::string &name, const FactoredStructure &solvers,
                                       const BodyRows &body_rows)
      : solvers(solvers), body_rows(body_rows), is_diagonal(name == "diagonal"),
        is_dirichlet(name == "Dirichlet"), blocks(body_rows.size())
  {
    if (!is_diagonal && !is_dirichlet && name != "lumped")
      throw UserError("unknown preconditioner '" + name +
                      "'; known are: diagonal, lumped, Dirichlet. Correct the name");
  }

  void RowPreconditioner::setup(const std::vector<char> &active,
                                const std::vector<char> &is_changed,
                                const std::vector<double> &compliance,
                                const std::vector<double> &diagonal)
  {
    L = {};
    has_compliance = false;
    own.assign(active.size(), 0.);
    for (std::size_t i = 0; is_diagonal && i < active.size(); ++i)
      own[i] = active[i] && diagonal[i] > 0. ? 1. / diagonal[i] : 0.;
    if (is_diagonal)
      return;
    solvers.structure().communicator().agree(
        [&]
        {
          for (std::size_t k = 0; k < body_rows.size(); ++k)
            if (is_changed[k])
              compute_block(k, active);
        });
    assemble(active, diagonal);
    factor_compliant_part(compliance);
  }

  void RowPreconditioner::compute_block(const std::size_t k, const std::vector<char> &active)
  {
    const std::vector<unsigned int> constrained = solvers.structure()[k].constrained_dofs();
    Block block;
    for (const BodyRows::Entry &entry : body_rows[k])
      if (active[entry.row])
        for (const unsigned int dof : entry.form.index)
          if (!std::binary_search(constrained.begin(), constrained.end(), dof))
            block.dofs.push_back(dof);
    std::sort(block.dofs.begin(), block.dofs.end());
    block.dofs.erase(std::unique(block.dofs.begin(), block.dofs.end()), block.dofs.end());

    const std::size_t n = block.dofs.size();
    const auto position = positions(block.dofs, solvers.structure()[k].n_dofs());
    std::vector<double> diagonal(n, 0.);
    solvers.visit(k,
                  [&](unsigned int i, unsigned int j, double value)
                  {
                    if (position[i] == nowhere || position[j] == nowhere)
                      return;
                    block.entries.add(position[i], position[j], value);
                    if (i == j)
                      diagonal[position[i]] += value;
                  });
    if (is_dirichlet && n > 0)
      condense(k, block);
    block.entries.compress();
    block.inverse_diagonal.assign(n, 0.);
    for (std::size_t e = 0; e < block.entries.size(); ++e)
    {
      const int p = block.entries.row[e];
      if (p == block.entries.column[e] &&
          block.entries.value[e] > smallest_stiffness * diagonal[p])
        block.inverse_diagonal[p] = 1. / block.entries.value[e];
    }
    factorisations += is_dirichlet && n > 0;
    blocks[k] = std::move(block);
  }

  /// Subtracts A_bi A_ii^-1 A_ib, column by column: each lives near its DoF.
  void RowPreconditioner::condense(const std::size_t k, Block &block) const
  {
    const std::size_t n = block.dofs.size();
    const auto position = positions(block.dofs, solvers.structure()[k].n_dofs());
    std::vector<char> is_constrained(solvers.structure()[k].n_dofs(), 0);
    for (const unsigned int dof : solvers.structure()[k].constrained_dofs())
      is_constrained[dof] = 1;
    std::vector<SparseVector> couplings(n); // columns of A_ib
    solvers.visit(k,
                  [&](unsigned int i, unsigned int j, double value)
                  {
                    for (const auto &[to, from] : {std::make_pair(i, j), std::make_pair(j, i)})
                      if (position[to] != nowhere && position[from] == nowhere &&
                          !is_constrained[from] && value != 0.)
                        couplings[position[to]].add(from, value);
                  });
    // A band: which columns a window meets follows from the distance of their DoFs.
    unsigned int band = 0;
    for (std::size_t p = 0; p < n; ++p)
      for (const unsigned int i : couplings[p].index)
        band = std::max(band, std::max(i, block.dofs[p]) - std::min(i, block.dofs[p]));

    const std::unique_ptr<LocalSolver> interior = solvers.solver_with_held(k, block.dofs);
    const unsigned int block_size = solvers.structure()[k].stiffness().block_size();
    WindowedVector response;
    for (std::size_t p = 0; p < n; ++p)
    {
      // A column's right-hand side lives on one element: one for each side of the node.
      SparseVector sides[2];
      for (std::size_t e = 0; e < couplings[p].index.size(); ++e)
      {
        const unsigned int i = couplings[p].index[e];
        const bool is_right = block_size > 0 && i / block_size > block.dofs[p] / block_size;
        sides[is_right].add(i, couplings[p].value[e]);
      }
      for (const SparseVector &side : sides)
      {
        if (side.index.empty())
          continue;
        interior->column(side, response);
        const unsigned int end = response.first + static_cast<unsigned int>(response.value.size());
        const unsigned int begin = response.first > band ? response.first - band : 0;
        for (std::size_t q = std::lower_bound(block.dofs.begin(), block.dofs.end(), begin) -
                             block.dofs.begin();
             q <= p && block.dofs[q] < end + band; ++q)
        {
          const double product = response.dot(couplings[q]);
          if (product != 0.)
            block.entries.add(p, q, -product);
        }
      }
    }
  }

  /// L, and what is to be done on rows that it does not reach.
  void RowPreconditioner::assemble(const std::vector<char> &active,
                                   const std::vector<double> &diagonal)
  {
    const Communicator &processes = solvers.structure().communicator();
    std::vector<double> Q(active.size(), 0.);

    // Of each body: the rows at each DoF, with D^-1 B.
    std::vector<std::vector<std::vector<std::pair<std::size_t, double>>>> scaled(body_rows.size());
    for (std::size_t k = 0; k < body_rows.size(); ++k)
    {
      const Block &block = blocks[k];
      scaled[k].resize(block.dofs.size());
      for (const BodyRows::Entry &entry : body_rows[k])
        for (std::size_t e = 0; active[entry.row] && e < entry.form.index.size(); ++e)
        {
          const auto at =
              std::lower_bound(block.dofs.begin(), block.dofs.end(), entry.form.index[e]);
          if (at == block.dofs.end() || *at != entry.form.index[e])
            continue;
          const std::size_t p = at - block.dofs.begin();
          auto &here = scaled[k][p];
          if (here.empty() || here.back().first != entry.row)
            here.emplace_back(entry.row, 0.);
          here.back().second += block.inverse_diagonal[p] * entry.form.value[e];
        }
      for (std::size_t p = 0; p < block.dofs.size(); ++p)
        for (const auto &[row, value] : scaled[k][p])
          if (value != 0.)
            Q[row] += value * value / block.inverse_diagonal[p];
    }
    processes.sum(Q);

    for (std::size_t k = 0; k < body_rows.size(); ++k)
      for (std::size_t e = 0; e < blocks[k].entries.size(); ++e)
      {
        const int p = blocks[k].entries.row[e], q = blocks[k].entries.column[e];
        const double entry = blocks[k].entries.value[e];
        for (const auto &[i, b_i] : scaled[k][p])
          for (const auto &[j, b_j] : scaled[k][q])
          {
            if (b_i == 0. || b_j == 0. || (p == q && j > i))
              continue;
            // Off the diagonal of S_k each entry counts twice, above and below.
            const double twice = p != q && i == j ? 2. : 1.;
            L.add(i, j, twice * entry * b_i * b_j / (Q[i] * Q[j]));
          }
      }
    gather(processes, L);
    L.compress();
    for (std::size_t i = 0; i < active.size(); ++i)
      if (active[i] && Q[i] == 0. && diagonal[i] > 0.)
        own[i] = 1. / diagonal[i];
  }

  void RowPreconditioner::factor_compliant_part(const std::vector<double> &compliance)
  {
    const std::size_t n = compliance.size();
    root_compliance.resize(n);
    for (std::size_t i = 0; i < n; ++i)
    {
      root_compliance[i] = std::sqrt(compliance[i]);
      has_compliance = has_compliance || compliance[i] > 0.;
    }
    if (!has_compliance)
      return;
    SymmetricEntries entries;
    for (std::size_t e = 0; e < L.size(); ++e)
    {
      const int i = L.row[e], j = L.column[e];
      if (compliance[i] > 0. && compliance[j] > 0.)
        entries.add(i, j, root_compliance[i] * L.value[e] * root_compliance[j]);
    }
    for (std::size_t i = 0; i < n; ++i)
      entries.add(i, i, 1.);
    if (compliant_part.factor(n, entries, 0.) != n)
      throw std::logic_error("the preconditioner of the rows is not definite");
  }

  void RowPreconditioner::apply(const std::vector<double> &r, std::vector<double> &z) const
  {
    z.resize(r.size());
    for (std::size_t i = 0; i < r.size(); ++i)
      z[i] = own[i] * r[i];
    if (is_diagonal)
      return;
    L.vmult_add(r, z);
    if (!has_compliance)
      return;
    work.resize(r.size());
    for (std::size_t i = 0; i < r.size(); ++i)
      work[i] = own[i] > 0. ? 0. : root_compliance[i] * z[i];
    compliant_part.solve(work);
    for (std::size_t i = 0; i < r.size(); ++i)
      work[i] *= -root_compliance[i];
    L.vmult_add(work, z);
  }
} // namespace taut
