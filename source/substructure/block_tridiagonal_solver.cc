// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/substructure/local_solver.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace taut
{
  namespace
  {
    /// Smallest accepted ratio of a pivot to the diagonal entry it came from.
    constexpr double smallest_pivot = 1e-15;

    /// Relative size below which the tail of a column is left out, and for how many nodes in a row.
    constexpr double negligible = 1e-18;
    constexpr int negligible_nodes = 3;

    template <int b>
    using Block = std::array<double, b * b>;

    /// y -= A x
    template <int b>
    inline void subtract(const Block<b> &A, const double *x, double *y)
    {
      for (int r = 0; r < b; ++r)
        for (int c = 0; c < b; ++c)
          y[r] -= A[r * b + c] * x[c];
    }

    /// y -= A^T x
    template <int b>
    inline void subtract_transposed(const Block<b> &A, const double *x, double *y)
    {
      for (int r = 0; r < b; ++r)
        for (int c = 0; c < b; ++c)
          y[r] -= A[c * b + r] * x[c];
    }

    /// y = A x
    template <int b>
    inline void multiply(const Block<b> &A, const double *x, double *y)
    {
      for (int r = 0; r < b; ++r)
      {
        double sum = A[r * b] * x[0];
        for (int c = 1; c < b; ++c)
          sum += A[r * b + c] * x[c];
        y[r] = sum;
      }
    }

    /// x -= A y, and y becomes x: one node of the elimination.
    template <int b>
    inline void advance(const Block<b> &A, double *y, double *x)
    {
      double sum[b] = {};
      std::copy(x, x + b, sum);
      subtract<b>(A, y, sum);
      std::copy(sum, sum + b, x);
      std::copy(sum, sum + b, y);
    }

    /// x = D x - A^T y, and y becomes x: one node of the substitution.
    template <int b>
    inline void retreat(const Block<b> &D, const Block<b> &A, double *y, double *x)
    {
      double sum[b] = {};
      multiply<b>(D, x, sum);
      subtract_transposed<b>(A, y, sum);
      std::copy(sum, sum + b, x);
      std::copy(sum, sum + b, y);
    }

    template <int b>
    Block<b> transpose(const Block<b> &A)
    {
      Block<b> T;
      for (int r = 0; r < b; ++r)
        for (int c = 0; c < b; ++c)
          T[r * b + c] = A[c * b + r];
      return T;
    }

    template <int b>
    Block<b> multiply(const Block<b> &A, const Block<b> &B)
    {
      Block<b> C{};
      for (int r = 0; r < b; ++r)
        for (int k = 0; k < b; ++k)
          for (int c = 0; c < b; ++c)
            C[r * b + c] += A[r * b + k] * B[k * b + c];
      return C;
    }

    /// A - B, made symmetric.
    template <int b>
    Block<b> symmetric_difference(const Block<b> &A, const Block<b> &B)
    {
      Block<b> C;
      for (int r = 0; r < b; ++r)
        for (int c = 0; c < b; ++c)
          C[r * b + c] = .5 * ((A[r * b + c] - B[r * b + c]) + (A[c * b + r] - B[c * b + r]));
      return C;
    }

    /// Inverse of a definite block through its Cholesky factor. @p original has the diagonal before
    /// elimination.
    template <int b>
    Block<b> invert(const Block<b> &A, const Block<b> &original, const std::size_t node)
    {
      double L[b][b] = {};
      for (int r = 0; r < b; ++r)
        for (int c = 0; c <= r; ++c)
        {
          double sum = A[r * b + c];
          for (int k = 0; k < c; ++k)
            sum -= L[r][k] * L[c][k];
          if (r != c)
            L[r][c] = sum / L[c][c];
          else if (sum > smallest_pivot * original[r * b + r])
            L[r][r] = std::sqrt(sum);
          else
            throw BodyNotHeld("the matrix is singular to working precision at node " +
                              std::to_string(node) + ", DoF " + std::to_string(r) +
                              " of the node: nothing holds it there");
        }
      Block<b> inverse{};
      for (int column = 0; column < b; ++column)
      {
        double x[b] = {};
        x[column] = 1.;
        for (int r = 0; r < b; ++r)
        {
          for (int k = 0; k < r; ++k)
            x[r] -= L[r][k] * x[k];
          x[r] /= L[r][r];
        }
        for (int r = b - 1; r >= 0; --r)
        {
          for (int k = r + 1; k < b; ++k)
            x[r] -= L[k][r] * x[k];
          x[r] /= L[r][r];
          inverse[r * b + column] = x[r];
        }
      }
      return inverse;
    }

    /**
     * With D_i and L_i the blocks of A (L_i couples node i to i - 1), the elimination from the left
     * has pivots Dl_i = D_i - L_i Dl_{i-1}^-1 L_i^T and multipliers G_i = L_i Dl_{i-1}^-1; the one
     * from the right Dr_i = D_i - L_{i+1}^T Dr_{i+1}^-1 L_{i+1} and H_i = L_{i+1}^T Dr_{i+1}^-1. A
     * solve runs both to the middle node.
     */
    template <int b>
    class BlockTridiagonalSolver : public LocalSolver
    {
    public:
      void factor(const std::vector<ScaledMatrix> &summands,
                  const std::vector<unsigned int> &constrained_dofs) override;
      void solve(std::vector<double> &x) const override;
      void column(const SparseVector &rhs, WindowedVector &x) const override;
      double flexibility(const SparseVector &rhs) const override;

    private:
      bool element_of(const SparseVector &rhs, unsigned int &node,
                      std::array<double, 2 * b> &r) const;
      void solve_element(unsigned int node, const std::array<double, 2 * b> &rhs, double *x) const;

      std::size_t n = 0, middle = 0;
      std::vector<Block<b>> D, L;
      std::vector<Block<b>> left_pivot, left_inverse, G;
      std::vector<Block<b>> right_pivot, right_inverse, H;
      Block<b> middle_inverse;
      std::vector<unsigned int> constrained;
      mutable std::vector<double> work; ///< of column()
    };

    template <int b>
    void BlockTridiagonalSolver<b>::factor(const std::vector<ScaledMatrix> &summands,
                                           const std::vector<unsigned int> &constrained_dofs)
    {
      constrained = constrained_dofs;
      n = summands.front().second->size() / b;
      middle = n / 2;
      std::vector<char> is_constrained(b * n, 0);
      for (const unsigned int dof : constrained)
        is_constrained[dof] = 1;

      D.assign(n, {});
      L.assign(n, {});
      for (const auto &[factor, matrix] : summands)
        matrix->visit(
            [&, factor = factor](unsigned int i, unsigned int j, double value)
            {
              if (is_constrained[i] || is_constrained[j])
                return;
              if (i / b != j / b)
                L[i / b][(i % b) * b + j % b] += factor * value;
              else
              {
                D[i / b][(i % b) * b + j % b] += factor * value;
                if (i != j)
                  D[i / b][(j % b) * b + i % b] += factor * value;
              }
            });
      for (const unsigned int dof : constrained)
        D[dof / b][(dof % b) * (b + 1)] = 1.;

      left_pivot = right_pivot = D;
      for (auto *blocks : {&left_inverse, &right_inverse, &G, &H})
        blocks->assign(n, {});
      for (std::size_t i = 0; i < n; ++i)
      {
        if (i > 0)
        {
          G[i] = multiply<b>(L[i], left_inverse[i - 1]);
          left_pivot[i] = symmetric_difference<b>(D[i], multiply<b>(G[i], transpose<b>(L[i])));
        }
        left_inverse[i] = invert<b>(left_pivot[i], D[i], i);
      }
      for (std::size_t i = n; i-- > 0;)
      {
        if (i + 1 < n)
        {
          H[i] = multiply<b>(transpose<b>(L[i + 1]), right_inverse[i + 1]);
          right_pivot[i] = symmetric_difference<b>(D[i], multiply<b>(H[i], L[i + 1]));
        }
        right_inverse[i] = invert<b>(right_pivot[i], D[i], i);
      }
      Block<b> pivot = left_pivot[middle];
      if (middle + 1 < n)
        pivot = symmetric_difference<b>(pivot, multiply<b>(H[middle], L[middle + 1]));
      middle_inverse = invert<b>(pivot, D[middle], middle);
    }

    template <int b>
    void BlockTridiagonalSolver<b>::solve(std::vector<double> &x) const
    {
      for (const unsigned int dof : constrained)
        x[dof] = 0.;
      double *p = x.data();

      // Towards the middle, both ends interleaved: two independent chains for the processor, the
      // last node of each in registers.
      double l[b] = {}, r[b] = {};
      std::copy(p, p + b, l);
      std::copy(p + b * (n - 1), p + b * n, r);
      const auto from_left = [&](const std::size_t k) { advance<b>(G[k], l, p + b * k); };
      const auto from_right = [&](const std::size_t k) { advance<b>(H[k], r, p + b * k); };
      std::size_t i = 1, j = n - 1;
      for (; i < middle && j > middle + 1; ++i, --j)
      {
        from_left(i);
        from_right(j - 1);
      }
      for (; i < middle; ++i)
        from_left(i);
      for (; j > middle + 1; --j)
        from_right(j - 1);

      double *m = p + b * middle;
      if (middle > 0)
        subtract<b>(G[middle], m - b, m);
      if (middle + 1 < n)
        subtract<b>(H[middle], m + b, m);
      multiply<b>(middle_inverse, m, l);
      std::copy(l, l + b, m);
      std::copy(l, l + b, r);

      // And back outwards.
      const auto leftwards = [&](const std::size_t k)
      { retreat<b>(left_inverse[k], G[k + 1], l, p + b * k); };
      const auto rightwards = [&](const std::size_t k)
      { retreat<b>(right_inverse[k], H[k - 1], r, p + b * k); };
      i = middle;
      j = middle + 1;
      for (; i > 0 && j < n; --i, ++j)
      {
        leftwards(i - 1);
        rightwards(j);
      }
      for (; i > 0; --i)
        leftwards(i - 1);
      for (; j < n; ++j)
        rightwards(j);
    }

    /// Solves on nodes @p node and the next one with everything outside them eliminated.
    template <int b>
    void BlockTridiagonalSolver<b>::solve_element(const unsigned int node,
                                                  const std::array<double, 2 * b> &rhs,
                                                  double *x) const
    {
      // [Dl  L^T] [x0]   [r0]
      // [L   Dr ] [x1] = [r1]
      const Block<b> &coupling = L[node + 1];
      const Block<b> pivot = symmetric_difference<b>(
          right_pivot[node + 1], multiply<b>(G[node + 1], transpose<b>(coupling)));
      const Block<b> inverse = invert<b>(pivot, D[node + 1], node + 1);
      double r0[b], r1[b];
      std::copy(rhs.begin(), rhs.begin() + b, r0);
      std::copy(rhs.begin() + b, rhs.end(), r1);
      subtract<b>(G[node + 1], r0, r1);
      multiply<b>(inverse, r1, x + b);
      subtract_transposed<b>(coupling, x + b, r0);
      multiply<b>(left_inverse[node], r0, x);
    }

    /// The element that @p rhs lives on, by its first node, and the entries there; false if it is
    /// more than one.
    template <int b>
    bool BlockTridiagonalSolver<b>::element_of(const SparseVector &rhs, unsigned int &node,
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

    template <int b>
    double BlockTridiagonalSolver<b>::flexibility(const SparseVector &rhs) const
    {
      unsigned int node;
      std::array<double, 2 * b> r{}, x{};
      if (n > 1 && element_of(rhs, node, r))
      {
        solve_element(node, r, x.data());
        return std::inner_product(r.begin(), r.end(), x.begin(), 0.);
      }
      std::vector<double> full(b * n, 0.);
      rhs.add_to(1., full);
      solve(full);
      return rhs.dot(full);
    }

    template <int b>
    void BlockTridiagonalSolver<b>::column(const SparseVector &rhs, WindowedVector &x) const
    {
      x.first = 0;
      x.value.clear();
      std::vector<double> &full = work;
      full.resize(b * n);
      if (n == 1)
      {
        std::fill(full.begin(), full.end(), 0.);
        rhs.add_to(1., full);
        solve(full);
        x.value = full;
        return;
      }

      unsigned int node;
      std::array<double, 2 * b> r{};
      if (!element_of(rhs, node, r))
        throw std::logic_error("the right-hand side of a column spans more than one element");
      double *p = full.data();
      solve_element(node, r, p + b * node);

      double limit[b];
      for (int c = 0; c < b; ++c)
        limit[c] =
            negligible * std::max(std::fabs(p[b * node + c]), std::fabs(p[b * node + b + c]));
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
        subtract_transposed<b>(G[first], p + b * first, p + b * (first - 1));
        quiet = small(first - 1) ? quiet + 1 : 0;
      }
      for (int quiet = 0; last + 1 < n && quiet < negligible_nodes; ++last)
      {
        std::fill(p + b * (last + 1), p + b * (last + 2), 0.);
        subtract_transposed<b>(H[last], p + b * last, p + b * (last + 1));
        quiet = small(last + 1) ? quiet + 1 : 0;
      }
      if (first == 0 && last + 1 == n)
      {
        // Without decay the matrix may be as good as singular (statics): then the columns have to
        // round like the displacements that solve() gives, or the contact forces pay for the
        // difference.
        std::fill(full.begin(), full.end(), 0.);
        rhs.add_to(1., full);
        solve(full);
      }
      x.first = b * first;
      x.value.assign(p + b * first, p + b * (last + 1));
    }
  } // namespace

  std::unique_ptr<LocalSolver> make_block_tridiagonal_solver(const unsigned int block_size)
  {
    switch (block_size)
    {
    case 1:
      return std::make_unique<BlockTridiagonalSolver<1>>();
    case 2:
      return std::make_unique<BlockTridiagonalSolver<2>>();
    case 3:
      return std::make_unique<BlockTridiagonalSolver<3>>();
    case 4:
      return std::make_unique<BlockTridiagonalSolver<4>>();
    default:
      throw std::logic_error("block size of a block-tridiagonal solver outside 1..4");
    }
  }

  std::unique_ptr<LocalSolver> make_local_solver(const std::string &name,
                                                 const SymmetricMatrix &matrix)
  {
    if (name == "sparse direct" || matrix.block_size() == 0)
      return make_sparse_direct_solver();
    if (name == "block tridiagonal")
      return make_block_tridiagonal_solver(matrix.block_size());
    throw UserError("unknown local solver '" + name +
                    "'; known are: block tridiagonal, sparse direct");
  }
} // namespace taut
