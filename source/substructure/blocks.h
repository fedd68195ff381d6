// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_blocks_h
#define taut_blocks_h

#include "base/pivots.h"
#include <taut/base/exceptions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

/// Small dense blocks, row by row.
namespace taut
{
  template <int b>
  struct Block : std::array<double, b * b>
  {
    static constexpr int n_dofs = b; ///< of a node
  };

  template <int b>
  inline void add(const double factor, const Block<b> &A, Block<b> &sum)
  {
    for (int k = 0; k < b * b; ++k)
      sum[k] += factor * A[k];
  }

  template <int b>
  inline void clear_row(Block<b> &A, const int i)
  {
    std::fill_n(A.begin() + b * i, b, 0.);
  }
  template <int b>
  inline void clear_column(Block<b> &A, const int i)
  {
    for (int r = 0; r < b; ++r)
      A[b * r + i] = 0.;
  }
  template <int b>
  inline void add_entry(Block<b> &A, const int r, const int c, const double value)
  {
    A[b * r + c] += value;
  }

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
    for (int c = 0; c < b; ++c)
      for (int r = 0; r < b; ++r)
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

  /// For blocks of a whole node.
  inline constexpr int all_dofs[] = {0, 1, 2, 3, 4, 5};

  /// Inverse of a definite block through its Cholesky factor. @p original has the diagonal before
  /// elimination, @p dofs the DoFs of @p node that the message names.
  template <int b>
  Block<b> invert(const Block<b> &A, const Block<b> &original, const std::size_t node,
                  const int *const dofs = all_dofs)
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
        else if (sum > free_pivot * original[r * b + r])
          L[r][r] = std::sqrt(sum);
        else
          throw BodyNotHeld("the matrix is singular to working precision at node " +
                            std::to_string(node) + ", DoF " + std::to_string(dofs[r]) +
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
} // namespace taut

#endif
