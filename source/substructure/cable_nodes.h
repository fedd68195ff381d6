// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_cable_nodes_h
#define taut_cable_nodes_h

#include "substructure/decoupled_block.h"

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace taut
{
  /**
   * Entries of a block-tridiagonal matrix of a cable, node by node: entries in the plane of x and
   * y, entries along z, and couplings of the two if there are any.
   */
  class CableNodes
  {
  public:
    static constexpr int b = DecoupledBlock::n_dofs;

    /// @p n rows.
    explicit CableNodes(const std::size_t n) : nodes(n / b + 1) {} // with a last one of zeros

    void set_zero()
    {
      std::fill(nodes.begin(), nodes.end(), Entries());
      couplings.clear();
    }

    bool decouples() const { return couplings.empty(); }

    /// Adds to the entry (@p row, @p column) with column <= row, and to its mirror image.
    void add(const std::size_t row, const std::size_t column, const double value)
    {
      const int r = row % b, c = column % b;
      if (DecoupledBlock::are_together(r, c))
        add_together(row / b, row / b == column / b, r, c, value);
      else if (value != 0.)
        add_coupling(row / b, row / b == column / b, r, c, value);
    }

    /// The entry with column <= row; zero outside the band.
    double operator()(const std::size_t row, const std::size_t column) const
    {
      const std::size_t node = row / b;
      if (node > column / b + 1)
        return 0.;
      const int r = row % b, c = column % b, p = DecoupledBlock::place(r),
                q = DecoupledBlock::place(c);
      const bool own = node == column / b, lateral = DecoupledBlock::is_lateral(r);
      if (DecoupledBlock::are_together(r, c))
      {
        const DecoupledBlock &block = own ? nodes[node].diagonal : nodes[node].before;
        return lateral ? block.lateral[2 * p + q] : block.plane[4 * p + q];
      }
      if (couplings.empty())
        return 0.;
      const Coupling &coupling = couplings[node];
      return lateral ? (own ? coupling.diagonal : coupling.lateral_before)[p][q]
                     : (own ? coupling.diagonal : coupling.plane_before)[q][p];
    }

    /// For blocks with or without couplings; for blocks without couplings only if decouples().
    template <typename AnyBlock>
    void add_to(const double factor, std::vector<AnyBlock> &D, std::vector<AnyBlock> &L) const
    {
      for (std::size_t i = 0; i < D.size(); ++i)
      {
        taut::add(factor, nodes[i].diagonal, D[i]);
        taut::add(factor, nodes[i].before, L[i]);
      }
      if constexpr (std::is_same_v<AnyBlock, Block<b>>)
        for (std::size_t i = 0; i < couplings.size() && i < D.size(); ++i)
          add_coupling_to(factor, couplings[i], D[i], L[i]);
    }

    /// y_i = result(y_i, (A x)_i) in the rows from @p from to @p to - 1, which are whole inner
    /// nodes.
    template <typename Result>
    void product(const std::size_t from, const std::size_t to, const double *x, double *y,
                 const Result &result) const
    {
      if (decouples())
        product<false>(from / b, to / b, x, y, result);
      else
        product<true>(from / b, to / b, x, y, result);
    }

  private:
    /// Whole cache lines.
    struct alignas(64) Entries
    {
      DecoupledBlock diagonal{}, before{}; ///< before: with the node before, rows of this one
      DecoupledBlock transposed{};         ///< before
    };

    /// One row of four for each of the two lateral DoFs.
    using Rows = std::array<std::array<double, 4>, 2>;
    struct Coupling
    {
      Rows diagonal{};
      Rows lateral_before{}; ///< lateral DoFs here with those of the plane at the node before
      Rows plane_before{};   ///< lateral DoFs at the node before with those of the plane here
    };

    void add_together(const std::size_t node, const bool own, const int r, const int c,
                      const double value)
    {
      Entries &entries = nodes[node];
      const auto add_to_part = [&](auto DecoupledBlock::*part, const int size)
      {
        const int p = DecoupledBlock::place(r), q = DecoupledBlock::place(c);
        (own ? entries.diagonal.*part : entries.before.*part)[size * p + q] += value;
        if (!own || r != c)
          (own ? entries.diagonal.*part : entries.transposed.*part)[size * q + p] += value;
      };
      if (DecoupledBlock::is_lateral(r))
        add_to_part(&DecoupledBlock::lateral, 2);
      else
        add_to_part(&DecoupledBlock::plane, 4);
    }

    void add_coupling(const std::size_t node, const bool own, const int r, const int c,
                      const double value)
    {
      if (couplings.empty())
        couplings.resize(nodes.size());
      Coupling &coupling = couplings[node];
      const int p = DecoupledBlock::place(r), q = DecoupledBlock::place(c);
      if (DecoupledBlock::is_lateral(r))
        (own ? coupling.diagonal : coupling.lateral_before)[p][q] += value;
      else
        (own ? coupling.diagonal : coupling.plane_before)[q][p] += value;
    }

    static void add_coupling_to(const double factor, const Coupling &coupling, Block<b> &D,
                                Block<b> &L)
    {
      for (int p = 0; p < 2; ++p)
        for (int q = 0; q < 4; ++q)
        {
          const int r = DecoupledBlock::lateral_dofs[p], c = DecoupledBlock::plane_dofs[q];
          add_entry(D, r, c, factor * coupling.diagonal[p][q]);
          add_entry(D, c, r, factor * coupling.diagonal[p][q]);
          add_entry(L, r, c, factor * coupling.lateral_before[p][q]);
          add_entry(L, c, r, factor * coupling.plane_before[p][q]);
        }
    }

    template <bool coupled, typename Result>
    void product(const std::size_t from, const std::size_t to, const double *x, double *y,
                 const Result &result) const
    {
      constexpr double zero[b] = {};
      DecoupledNode before, here, behind;
      before.read(x + b * (from - 1));
      here.read(x + b * from);
      for (std::size_t i = from; i < to; ++i)
      {
        behind.read(x + b * (i + 1));
        DecoupledNode sum;
        sum.read(zero);
        add_transposed(nodes[i].diagonal, here, sum);
        add_transposed(nodes[i].transposed, before, sum);
        add_transposed(nodes[i + 1].before, behind, sum);
        if constexpr (coupled)
          add_couplings(i, before, here, behind, sum);
        double of_node[b];
        sum.write(of_node);
        for (int k = 0; k < b; ++k)
          y[b * i + k] = result(y[b * i + k], of_node[k]);
        before = here;
        here = behind;
      }
    }

    void add_couplings(const std::size_t i, const DecoupledNode &before, const DecoupledNode &here,
                       const DecoupledNode &behind, DecoupledNode &sum) const
    {
      constexpr double zero[4] = {};
      double along_z[2];
      for (int p = 0; p < 2; ++p)
      {
        const auto &own = couplings[i].diagonal[p], &to_before = couplings[i].lateral_before[p],
                   &to_behind = couplings[i + 1].plane_before[p];
        sum.plane.add(here.lateral[p], own.data());
        sum.plane.add(before.lateral[p], couplings[i].plane_before[p].data());
        sum.plane.add(behind.lateral[p], couplings[i + 1].lateral_before[p].data());
        Node<4> products;
        products.read(zero);
        products.add_products(here.plane, own.data());
        products.add_products(before.plane, to_before.data());
        products.add_products(behind.plane, to_behind.data());
        along_z[p] = sum.lateral[p] + ((products[0] + products[1]) + (products[2] + products[3]));
      }
      sum.lateral.read(along_z);
    }

    std::vector<Entries> nodes;
    std::vector<Coupling> couplings;
  };
} // namespace taut

#endif
