// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_diagonals_h
#define taut_diagonals_h

#include "substructure/blocks.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace taut
{
  /// Entries of a block-tridiagonal matrix by diagonals, so that products run over many rows at
  /// once.
  template <int b>
  class Diagonals
  {
  public:
    static constexpr int width = 2 * b - 1; ///< diagonals below the main one

    /// @p n rows.
    explicit Diagonals(const std::size_t n)
    {
      for (auto &entries : diagonals)
        entries.assign(n + width, 0.);
    }

    void set_zero()
    {
      for (auto &entries : diagonals)
        std::fill(entries.begin(), entries.end(), 0.);
    }

    /// Adds to the entry (@p row, @p column) with column <= row, and to its mirror image.
    void add(const std::size_t row, const std::size_t column, const double value)
    {
      diagonals[row - column][row] += value;
    }

    /// The entry with column <= row <= column + width.
    double operator()(const std::size_t row, const std::size_t column) const
    {
      return diagonals[row - column][row];
    }

    void add_to(const double factor, std::vector<Block<b>> &D, std::vector<Block<b>> &L) const
    {
      for (std::size_t i = 0; i < D.size(); ++i)
        for (int r = 0; r < b; ++r)
        {
          for (int c = 0; c < r; ++c)
          {
            const double value = factor * (*this)(b * i + r, b * i + c);
            D[i][b * r + c] += value;
            D[i][b * c + r] += value;
          }
          D[i][b * r + r] += factor * (*this)(b * i + r, b * i + r);
          for (int c = 0; i > 0 && c < b; ++c)
            L[i][b * r + c] += factor * (*this)(b * i + r, b * (i - 1) + c);
        }
    }

    /// y_i = result(y_i, (A x)_i) in the rows from @p from to @p to - 1, all with complete
    /// diagonals on both sides.
    template <typename Result>
    void product(const std::size_t from, const std::size_t to, const double *x, double *y,
                 const Result &result) const
    {
      const double *d[width + 1];
      for (int o = 0; o <= width; ++o)
        d[o] = diagonals[o].data();
#pragma omp simd
      for (std::size_t i = from; i < to; ++i)
      {
        double sum = d[0][i] * x[i];
        for (int o = 1; o <= width; ++o)
          sum += d[o][i] * x[i - o] + d[o][i + o] * x[i + o];
        y[i] = result(y[i], sum);
      }
    }

  private:
    std::array<std::vector<double>, width + 1> diagonals; ///< [o][i] = A(i, i - o), else zeros
  };
} // namespace taut

#endif
