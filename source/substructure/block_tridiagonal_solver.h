// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_block_tridiagonal_solver_h
#define taut_block_tridiagonal_solver_h

#include "substructure/block_elimination.h"
#include "substructure/block_tridiagonal_matrix.h"

#include "base/instruction_set.h"
#include <taut/substructure/local_solver.h>

#include <algorithm>
#include <numeric>

namespace taut
{
  /**
   * Twisted block LDL^T. With the blocks D_i and L_i of A (L_i couples node i to i - 1), the
   * elimination from the left has pivots Dl_i = D_i - L_i Dl_{i-1}^-1 L_i^T and multipliers G_i =
   * L_i Dl_{i-1}^-1. The elimination from the right has Dr_i = D_i - L_{i+1}^T Dr_{i+1}^-1 L_{i+1}
   * and H_i = L_{i+1}^T Dr_{i+1}^-1. A solve runs both to the middle node.
   */
  template <typename AnyBlock>
  class BlockTridiagonalSolver : public LocalSolver
  {
    static constexpr int b = AnyBlock::n_dofs; ///< of a node

    /// Relative size below which the tail of a column is left out, a hundredth of rounding, and for
    /// how many nodes in a row: a column that oscillates is small where it changes its sign, too.
    static constexpr double negligible = 1e-18;
    static constexpr int negligible_nodes = 3;

  public:
    void factor(const std::vector<ScaledMatrix> &summands,
                const std::vector<unsigned int> &constrained_dofs) override;
    void solve(std::vector<double> &x) const override;
    void column(const LinearForm &rhs, WindowedVector &x) const override;
    double flexibility(const LinearForm &rhs) const override;

  private:
    AnyBlock pivot_from_left(std::size_t i, const AnyBlock &G) const;
    AnyBlock pivot_from_right(std::size_t i, const AnyBlock &H) const;
    void eliminate_from_left(std::size_t begin, std::size_t end) const;
    void eliminate_from_right(std::size_t begin, std::size_t end) const;
    bool complete() const;
    void solve_nodes(double *x) const;

    bool element_of(const LinearForm &rhs, unsigned int &node, std::array<double, 2 * b> &r) const;
    void solve_element(unsigned int node, const std::array<double, 2 * b> &rhs, double *x) const;

    std::size_t n = 0, middle = 0;
    std::vector<AnyBlock> D, L;
    mutable Eliminations<AnyBlock> from_left, from_right;

    /// A cable's matrix changes in each step, and a step without contacts needs no columns.
    static constexpr bool all_at_once = b < 6;
    mutable bool is_whole = false, is_halves = false;
    AnyBlock middle_inverse;
    std::vector<unsigned int> constrained;
    mutable std::vector<double> work; ///< of column()
  };

  template <typename AnyBlock>
  void BlockTridiagonalSolver<AnyBlock>::factor(const std::vector<ScaledMatrix> &summands,
                                                const std::vector<unsigned int> &constrained_dofs)
  {
    constrained = constrained_dofs;
    n = summands.front().second->size() / b;
    middle = n / 2;
    D.assign(n, {});
    L.assign(n, {});
    for (const auto &[factor, matrix] : summands)
      if (const auto *const own = dynamic_cast<const BlockTridiagonalMatrix<b> *>(matrix))
        own->add_to(factor, D, L);
      else
        matrix->visit(
            [&, factor = factor](unsigned int i, unsigned int j, double value)
            {
              add_entry(i / b == j / b ? D[i / b] : L[i / b], i % b, j % b, factor * value);
              if (i / b == j / b && i != j)
                add_entry(D[i / b], j % b, i % b, factor * value);
            });
    for (const unsigned int dof : constrained)
    {
      const std::size_t node = dof / b;
      clear_row(D[node], dof % b);
      clear_column(D[node], dof % b);
      clear_row(L[node], dof % b);
      if (node + 1 < n)
        clear_column(L[node + 1], dof % b);
      add_entry(D[node], dof % b, dof % b, 1.);
    }

    from_left.reinit(n);
    from_right.reinit(n);
    is_whole = all_at_once;
    is_halves = false;
    if (is_whole)
    {
      eliminate_from_left(0, n);
      eliminate_from_right(n, 0);
    }
    else
      vectorised(
          [this]
          {
            eliminate_from_left(0, middle + 1);
            eliminate_from_right(n, middle);
          });
    AnyBlock pivot = pivot_from_left(middle, from_left[middle].multiplier);
    if (middle + 1 < n)
      pivot = symmetric_difference(pivot, multiply(from_right[middle].multiplier, L[middle + 1]));
    middle_inverse = invert(pivot, D[middle], middle);
  }

  /// Dl_i, with G_i.
  template <typename AnyBlock>
  AnyBlock BlockTridiagonalSolver<AnyBlock>::pivot_from_left(const std::size_t i,
                                                             const AnyBlock &G) const
  {
    return i == 0 ? D[i] : symmetric_difference(D[i], multiply(G, transpose(L[i])));
  }

  /// Dr_i, with H_i.
  template <typename AnyBlock>
  AnyBlock BlockTridiagonalSolver<AnyBlock>::pivot_from_right(const std::size_t i,
                                                              const AnyBlock &H) const
  {
    return i + 1 == n ? D[i] : symmetric_difference(D[i], multiply(H, L[i + 1]));
  }

  /// Eliminates nodes begin to end - 1, after the nodes before them.
  template <typename AnyBlock>
  void BlockTridiagonalSolver<AnyBlock>::eliminate_from_left(const std::size_t begin,
                                                             const std::size_t end) const
  {
    for (std::size_t i = begin; i < end; ++i)
    {
      Elimination<AnyBlock> e{};
      if (i > 0)
        e.multiplier = multiply(L[i], from_left[i - 1].inverse);
      e.transposed = transpose(e.multiplier);
      e.inverse = invert(pivot_from_left(i, e.multiplier), D[i], i);
      from_left.set(i, e);
    }
  }

  /// Eliminates nodes begin - 1 down to end, after the nodes behind them.
  template <typename AnyBlock>
  void BlockTridiagonalSolver<AnyBlock>::eliminate_from_right(const std::size_t begin,
                                                              const std::size_t end) const
  {
    for (std::size_t i = begin; i-- > end;)
    {
      Elimination<AnyBlock> e{};
      if (i + 1 < n)
        e.multiplier = multiply(transpose(L[i + 1]), from_right[i + 1].inverse);
      e.transposed = transpose(e.multiplier);
      e.inverse = invert(pivot_from_right(i, e.multiplier), D[i], i);
      from_right.set(i, e);
    }
  }

  /// Factors the halves that only columns need. Returns false if a pivot is rounding, although the
  /// elimination to the middle has no such pivot.
  template <typename AnyBlock>
  bool BlockTridiagonalSolver<AnyBlock>::complete() const
  {
    if (is_whole || is_halves)
      return is_whole;
    try
    {
      eliminate_from_left(middle + 1, n);
      eliminate_from_right(middle, 0);
      is_whole = true;
    }
    catch (const BodyNotHeld &)
    {
      is_halves = true;
    }
    return is_whole;
  }

  /// From both ends to the middle, and back, with both ends in one loop: the two chains of
  /// operations do not wait for each other, and their nodes stay in registers.
  template <typename AnyBlock>
  void BlockTridiagonalSolver<AnyBlock>::solve_nodes(double *x) const
  {
    const Elimination<AnyBlock> *const *const G = from_left.data(), *const *const H =
                                                                        from_right.data();
    const std::ptrdiff_t m = middle, last = n - 1, behind = last - m;
    NodeOf<AnyBlock> left, right;
    const auto eliminate_left = [&](const std::ptrdiff_t i)
    { left = eliminate(G[i]->transposed, left, x + b * i); };
    const auto eliminate_right = [&](const std::ptrdiff_t i)
    { right = eliminate(H[i]->transposed, right, x + b * i); };
    left.read(x);
    right.read(x + b * last);
    std::ptrdiff_t k = 1;
    for (; k < std::min(m, behind); ++k)
    {
      eliminate_left(k);
      eliminate_right(last - k);
    }
    for (std::ptrdiff_t i = k; i < m; ++i)
      eliminate_left(i);
    for (std::ptrdiff_t i = k; i < behind; ++i)
      eliminate_right(last - i);

    double *const at_middle = x + b * m, solution[b];
    if (m > 0)
      subtract(G[m]->multiplier, at_middle - b, at_middle);
    if (behind > 0)
      subtract(H[m]->multiplier, at_middle + b, at_middle);
    multiply(middle_inverse, at_middle, solution);
    std::copy(solution, solution + b, at_middle);

    const auto substitute_left = [&](const std::ptrdiff_t i)
    { left = substitute(G[i]->inverse, G[i + 1]->multiplier, left, x + b * i); };
    const auto substitute_right = [&](const std::ptrdiff_t i)
    { right = substitute(H[i]->inverse, H[i - 1]->multiplier, right, x + b * i); };
    left.read(at_middle);
    right = left;
    for (k = 1; k <= std::min(m, behind); ++k)
    {
      substitute_left(m - k);
      substitute_right(m + k);
    }
    for (std::ptrdiff_t i = k; i <= m; ++i)
      substitute_left(m - i);
    for (std::ptrdiff_t i = k; i <= behind; ++i)
      substitute_right(m + i);
  }

  template <typename AnyBlock>
  void BlockTridiagonalSolver<AnyBlock>::solve(std::vector<double> &x) const
  {
    for (const unsigned int dof : constrained)
      x[dof] = 0.;
    vectorised([this, all = x.data()] { solve_nodes(all); });
  }

  /// Solves on nodes @p node and the next one with everything outside them eliminated.
  template <typename AnyBlock>
  void BlockTridiagonalSolver<AnyBlock>::solve_element(const unsigned int node,
                                                       const std::array<double, 2 * b> &rhs,
                                                       double *x) const
  {
    // [Dl  L^T] [x0]   [r0]
    // [L   Dr ] [x1] = [r1]
    const AnyBlock &coupling = L[node + 1];
    const AnyBlock pivot =
        symmetric_difference(pivot_from_right(node + 1, from_right[node + 1].multiplier),
                             multiply(from_left[node + 1].multiplier, transpose(coupling)));
    const AnyBlock inverse = invert(pivot, D[node + 1], node + 1);
    double r0[b], r1[b];
    std::copy(rhs.begin(), rhs.begin() + b, r0);
    std::copy(rhs.begin() + b, rhs.end(), r1);
    subtract(from_left[node + 1].multiplier, r0, r1);
    multiply(inverse, r1, x + b);
    subtract_transposed(coupling, x + b, r0);
    multiply(from_left[node].inverse, r0, x);
  }

  /// Finds the element on which @p rhs acts, by its first node, and the entries there; returns
  /// false if @p rhs acts on several elements.
  template <typename AnyBlock>
  bool BlockTridiagonalSolver<AnyBlock>::element_of(const LinearForm &rhs, unsigned int &node,
                                                    std::array<double, 2 * b> &r) const
  {
    node = rhs.index.empty() ? 0 : *std::min_element(rhs.index.begin(), rhs.index.end()) / b;
    node = std::min<unsigned int>(node, n - 2);
    for (std::size_t k = 0; k < rhs.index.size(); ++k)
    {
      if (rhs.index[k] / b > node + 1)
        return false;
      if (!std::binary_search(constrained.begin(), constrained.end(), rhs.index[k]))
        r[rhs.index[k] - b * node] += rhs.value[k];
    }
    return true;
  }

  template <typename AnyBlock>
  double BlockTridiagonalSolver<AnyBlock>::flexibility(const LinearForm &rhs) const
  {
    unsigned int node;
    std::array<double, 2 * b> r{}, x{};
    if (n > 1 && complete() && element_of(rhs, node, r))
    {
      solve_element(node, r, x.data());
      return std::inner_product(r.begin(), r.end(), x.begin(), 0.);
    }
    std::vector<double> full(b * n, 0.);
    rhs.add_to(1., full);
    solve(full);
    return rhs.dot(full);
  }

  template <typename AnyBlock>
  void BlockTridiagonalSolver<AnyBlock>::column(const LinearForm &rhs, WindowedVector &x) const
  {
    x.first = 0;
    x.value.clear();
    std::vector<double> &full = work;
    full.resize(b * n);
    unsigned int node;
    std::array<double, 2 * b> r{};
    if (n == 1 || !complete() || !element_of(rhs, node, r))
    {
      std::fill(full.begin(), full.end(), 0.);
      rhs.add_to(1., full);
      solve(full);
      x.value = full;
      return;
    }

    double *p = full.data();
    solve_element(node, r, p + b * node);

    double limit[b];
    for (int c = 0; c < b; ++c)
      limit[c] = negligible * std::max(std::fabs(p[b * node + c]), std::fabs(p[b * node + b + c]));
    const auto small = [&](const std::size_t k)
    {
      bool all = true;
      for (int c = 0; c < b; ++c)
      {
        limit[c] = std::max(limit[c], negligible * std::fabs(p[b * k + c]));
        all = all && std::fabs(p[b * k + c]) <= limit[c];
      }
      return all;
    };
    std::size_t first = node, last = node + 1;
    for (int quiet = 0; first > 0 && quiet < negligible_nodes; --first)
    {
      std::fill(p + b * (first - 1), p + b * first, 0.);
      subtract_transposed(from_left[first].multiplier, p + b * first, p + b * (first - 1));
      quiet = small(first - 1) ? quiet + 1 : 0;
    }
    for (int quiet = 0; last + 1 < n && quiet < negligible_nodes; ++last)
    {
      std::fill(p + b * (last + 1), p + b * (last + 2), 0.);
      subtract_transposed(from_right[last].multiplier, p + b * last, p + b * (last + 1));
      quiet = small(last + 1) ? quiet + 1 : 0;
    }
    if (first == 0 && last + 1 == n)
    {
      // Without decay the matrix may be nearly singular (statics). The columns then have to round
      // like the displacements of solve(): the difference would be an error of the contact forces.
      std::fill(full.begin(), full.end(), 0.);
      rhs.add_to(1., full);
      solve(full);
    }
    x.first = b * first;
    x.value.assign(p + b * first, p + b * (last + 1));
    x.pad(ScalarProduct::lanes, b * n);
  }
} // namespace taut

#endif
