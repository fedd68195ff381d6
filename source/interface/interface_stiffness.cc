// SPDX-License-Identifier: LGPL-2.1-or-later
#include "interface/interface_stiffness.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace taut
{
  namespace
  {
    /// Part of the diagonal of A_k below which a Schur complement is rounding: the body follows
    /// freely. As a difference it has lost nine of sixteen digits there.
    constexpr double smallest_stiffness = 1e-9;

    /// Number of DoFs up to which the Schur complement of a body of any pattern is formed, with a
    /// solution for each. Applying it costs one solution an iteration, and a system takes some 20
    /// to 40 iterations (doc/decomposition.md): a few systems pay for it.
    constexpr std::size_t most_formed = 100;

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

  InterfaceStiffness::InterfaceStiffness(const FactoredStructure &solvers,
                                         const BodyConstraints &body_constraints)
      : solvers(solvers), body_constraints(body_constraints), blocks(body_constraints.size())
  {
  }

  void InterfaceStiffness::setup(const std::vector<char> &active,
                                 const std::vector<char> &is_changed)
  {
    solvers.structure().communicator().agree(
        [&]
        {
          for (std::size_t k = 0; k < body_constraints.size(); ++k)
            if (is_changed[k])
              compute_block(k, active);
        });
    std::size_t first = 0;
    T = {};
    B = {};
    substitute = {};
    for (std::size_t k = 0; k < blocks.size(); ++k)
    {
      Block &block = blocks[k];
      block.first = first;
      SymmetricEntries &to = block.interior ? substitute : T;
      for (std::size_t e = 0; e < block.entries.size(); ++e)
        to.add(first + block.entries.row[e], first + block.entries.column[e],
               block.entries.value[e]);
      for (const BodyConstraints::Entry &entry : body_constraints[k])
        for (std::size_t e = 0; active[entry.constraint] && e < entry.form.index.size(); ++e)
        {
          const auto at =
              std::lower_bound(block.dofs.begin(), block.dofs.end(), entry.form.index[e]);
          if (at != block.dofs.end() && *at == entry.form.index[e])
            B.add(body_constraints.all().number(entry.constraint),
                  first + (at - block.dofs.begin()), entry.form.value[e]);
        }
      first += block.dofs.size();
    }
    n_constrained = first;
    T.compress();
    B.compress();
  }

  /// The DoFs of active constraints that may move.
  std::vector<unsigned int>
  InterfaceStiffness::constrained_together(const std::size_t k,
                                           const std::vector<char> &active) const
  {
    const std::vector<unsigned int> held = solvers.structure()[k].constrained_dofs();
    std::vector<unsigned int> dofs;
    for (const BodyConstraints::Entry &entry : body_constraints[k])
      if (active[entry.constraint])
        for (const unsigned int dof : entry.form.index)
          if (!std::binary_search(held.begin(), held.end(), dof))
            dofs.push_back(dof);
    std::sort(dofs.begin(), dofs.end());
    dofs.erase(std::unique(dofs.begin(), dofs.end()), dofs.end());
    return dofs;
  }

  /// A_k on b.
  void InterfaceStiffness::set_entries(const std::size_t k, Block &block) const
  {
    const auto position = positions(block.dofs, solvers.structure()[k].n_dofs());
    solvers.visit(k,
                  [&](unsigned int i, unsigned int j, double value)
                  {
                    if (position[i] != nowhere && position[j] != nowhere)
                      block.entries.add(position[i], position[j], value);
                  });
  }

  std::vector<std::size_t> InterfaceStiffness::applied_bodies(const std::vector<char> &active,
                                                              const bool coarse) const
  {
    std::vector<std::size_t> result;
    for (std::size_t k = 0; k < blocks.size(); ++k)
      if (blocks[k].interior &&
          (!coarse || blocks[k].dofs.size() > constrained_together(k, active).size()))
        result.push_back(k);
    return result;
  }

  void InterfaceStiffness::compute_block(const std::size_t k, const std::vector<char> &active)
  {
    Block block;
    if (solvers.structure()[k].stiffness().block_size() == 0)
    {
      block.dofs = constrained_together(k, std::vector<char>(active.size(), 1));
      if (block.dofs.size() > most_formed)
      {
        if (follows_sets)
          block.dofs = constrained_together(k, active);
        if (blocks[k].interior && blocks[k].dofs == block.dofs)
          return;
        block.interior = solvers.solver_with_held(k, block.dofs);
        set_entries(k, block);
        block.entries.compress();
        blocks[k] = std::move(block);
        return;
      }
    }
    block.dofs = constrained_together(k, active);
    set_entries(k, block);
    std::vector<double> diagonal(block.dofs.size(), 0.);
    for (std::size_t e = 0; e < block.entries.size(); ++e)
      if (block.entries.row[e] == block.entries.column[e])
        diagonal[block.entries.row[e]] += block.entries.value[e];
    if (!block.dofs.empty())
      condense(k, block);
    block.entries.compress();
    for (std::size_t e = 0; e < block.entries.size(); ++e)
    {
      const int p = block.entries.row[e];
      if (p == block.entries.column[e] &&
          !(block.entries.value[e] > smallest_stiffness * diagonal[p]))
        block.entries.value[e] = 0.;
    }
    blocks[k] = std::move(block);
  }

  /// Subtracts A_bi A_ii^-1 A_ib, column by column: each lives near its DoF.
  void InterfaceStiffness::condense(const std::size_t k, Block &block) const
  {
    const std::size_t n = block.dofs.size();
    const auto position = positions(block.dofs, solvers.structure()[k].n_dofs());
    std::vector<char> is_constrained(solvers.structure()[k].n_dofs(), 0);
    for (const unsigned int dof : solvers.structure()[k].constrained_dofs())
      is_constrained[dof] = 1;
    std::vector<LinearForm> couplings(n); // columns of A_ib
    solvers.visit(k,
                  [&](unsigned int i, unsigned int j, double value)
                  {
                    for (const auto &[to, from] : {std::make_pair(i, j), std::make_pair(j, i)})
                      if (position[to] != nowhere && position[from] == nowhere &&
                          !is_constrained[from] && value != 0.)
                        couplings[position[to]].add(from, value);
                  });
    // The band tells which columns a window meets, by the distance of their DoFs.
    unsigned int band = 0;
    for (std::size_t p = 0; p < n; ++p)
      for (const unsigned int i : couplings[p].index)
        band = std::max(band, std::max(i, block.dofs[p]) - std::min(i, block.dofs[p]));

    const std::unique_ptr<LocalSolver> interior = solvers.solver_with_held(k, block.dofs);
    const unsigned int block_size = solvers.structure()[k].stiffness().block_size();
    WindowedVector response;
    for (std::size_t p = 0; p < n; ++p)
    {
      // A right-hand side is on one element: each side of the node has its own.
      LinearForm sides[2];
      for (std::size_t e = 0; e < couplings[p].index.size(); ++e)
      {
        const unsigned int i = couplings[p].index[e];
        const bool is_right = block_size > 0 && i / block_size > block.dofs[p] / block_size;
        sides[is_right].add(i, couplings[p].value[e]);
      }
      for (const LinearForm &side : sides)
      {
        if (side.index.empty())
          continue;
        interior->column(side, response);
        const unsigned int end = response.first + static_cast<unsigned int>(response.value.size());
        const unsigned int begin = response.first > band ? response.first - band : 0;
        for (std::size_t q =
                 std::lower_bound(block.dofs.begin(), block.dofs.end(), begin) - block.dofs.begin();
             q <= p && block.dofs[q] < end + band; ++q)
        {
          const double product = response.dot(couplings[q]);
          if (product != 0.)
            block.entries.add(p, q, -product);
        }
      }
    }
  }

  SymmetricEntries InterfaceStiffness::entries() const
  {
    SymmetricEntries result = T;
    for (std::size_t e = 0; e < substitute.size(); ++e)
      result.add(substitute.row[e], substitute.column[e], substitute.value[e]);
    result.compress();
    return result;
  }

  std::vector<double> InterfaceStiffness::diagonal() const
  {
    std::vector<double> D(n_constrained, 0.);
    for (const SymmetricEntries *matrix : {&T, &substitute})
      for (std::size_t e = 0; e < matrix->size(); ++e)
        if (matrix->row[e] == matrix->column[e])
          D[matrix->row[e]] += matrix->value[e];
    return D;
  }

  /// Sets f = T_k u of the blocks of this rank that are not formed.
  void InterfaceStiffness::apply_substituted(const std::vector<double> &u,
                                             std::vector<double> &f) const
  {
    for (std::size_t k = 0; k < blocks.size(); ++k)
    {
      const Block &block = blocks[k];
      if (!block.interior)
        continue;
      const std::size_t n = block.dofs.size();
      whole.assign(solvers.structure()[k].n_dofs(), 0.);
      for (std::size_t p = 0; p < n; ++p)
        whole[block.dofs[p]] = u[block.first + p];
      solvers.multiply(k, whole, image);
      for (std::size_t p = 0; p < n; ++p)
        f[block.first + p] = image[block.dofs[p]];
      block.interior->solve(image);
      solvers.multiply(k, image, whole);
      for (std::size_t p = 0; p < n; ++p)
        f[block.first + p] -= whole[block.dofs[p]];
    }
  }

  void InterfaceStiffness::multiply(const std::vector<double> &u, std::vector<double> &f) const
  {
    f.assign(n_constrained, 0.);
    if (substitute.size() > 0)
      apply_substituted(u, f);
    T.vmult_add(u, f);
  }
} // namespace taut
