// SPDX-License-Identifier: LGPL-2.1-or-later
#include "substructure/block_tridiagonal_matrix.h"

#include "base/instruction_set.h"

#include <algorithm>
#include <stdexcept>
#include <type_traits>

namespace taut
{

  template <int b>
  BlockTridiagonalMatrix<b>::BlockTridiagonalMatrix(const unsigned int n) : n(n), entries(n)
  {
    if (n % b != 0)
      throw std::logic_error(
          "the size of a block-tridiagonal matrix is a multiple of its block size");
  }

  template <int b>
  void BlockTridiagonalMatrix<b>::add(const unsigned int i, const unsigned int j,
                                      const double value)
  {
    const unsigned int row = std::max(i, j), column = std::min(i, j);
    if (row / b > column / b + 1)
      throw std::logic_error("entry outside the band of a block-tridiagonal matrix");
    entries.add(row, column, value);
    repetitions.clear();
  }

  template <int b>
  void BlockTridiagonalMatrix<b>::set_zero()
  {
    entries.set_zero();
    repetitions.clear();
  }

  /// A(i, i + offset), at the third node and before the last two.
  template <int b>
  double BlockTridiagonalMatrix<b>::entry(const std::size_t i, const int offset) const
  {
    return offset > 0 ? entries(i + offset, i) : entries(i, i + offset);
  }

  template <int b>
  void BlockTridiagonalMatrix<b>::find_repetitions()
  {
    repetitions.clear();
    const auto is_as_before = [this](const std::size_t node)
    {
      for (std::size_t i = b * node; i < b * (node + 1); ++i)
        for (int o = -width; o <= width; ++o)
          if (entry(i, o) != entry(i - b, o))
            return false;
      return true;
    };
    constexpr std::size_t least = 4 * lanes / b; // for fewer nodes repetition is no faster
    const std::size_t last = n / b - std::min<std::size_t>(n / b, 2);
    for (std::size_t begin = 2; begin < last;)
    {
      std::size_t end = begin + 1;
      while (end < last && is_as_before(end))
        ++end;
      if (end - begin >= least)
      {
        Repetition repetition{b * begin, b * end, true, {}};
        bool directions_are_apart = true; // as those of the masses of cables
        for (int o = -width; o <= width; ++o)
          for (int k = 0; k < lanes; ++k)
          {
            const double value = entry(b * begin + k % b, o);
            repetition.rows[o + width][k] = value;
            if (value == 0.)
              continue;
            repetition.is_zero = false;
            if (o % n_directions != 0)
              directions_are_apart = false;
          }
        if (!is_cable || directions_are_apart)
          repetitions.push_back(repetition);
      }
      begin = end;
    }
  }

  template <int b>
  void BlockTridiagonalMatrix<b>::vmult_add(const double factor, const double *x, double *y) const
  {
    vectorised(
        [=]
        {
          product(x, y,
                  [factor](const double before, const double sum)
                  { return before + factor * sum; });
        });
  }

  template <int b>
  void BlockTridiagonalMatrix<b>::vmult(const double *x, double *y) const
  {
    vectorised([=] { product(x, y, [](double, const double sum) { return sum; }); });
  }

  /// The product for one node with known neighbours, so that short loops are unrolled.
  template <int b>
  template <bool has_before, bool has_after, typename Result>
  void BlockTridiagonalMatrix<b>::product_at_node(const std::size_t node, const double *x,
                                                  double *y, const Result &result) const
  {
    for (int r = 0; r < b; ++r)
    {
      const std::size_t i = node + r;
      double sum = 0.;
      for (int o = has_before ? -b - r : -r; o < (has_after ? 2 * b : b) - r; ++o)
        sum += entry(i, o) * x[static_cast<std::ptrdiff_t>(i) + o];
      y[i] = result(y[i], sum);
    }
  }

  /// The product for the first or last nodes, rows begin to end - 1.
  template <int b>
  template <typename Result>
  void BlockTridiagonalMatrix<b>::product_at_end(const std::size_t begin, const std::size_t end,
                                                 const double *x, double *y,
                                                 const Result &result) const
  {
    for (std::size_t node = begin; node < end; node += b)
      if (const bool has_after = node + b < n; node == 0)
        has_after ? product_at_node<false, true>(node, x, y, result)
                  : product_at_node<false, false>(node, x, y, result);
      else
        has_after ? product_at_node<true, true>(node, x, y, result)
                  : product_at_node<true, false>(node, x, y, result);
  }

  /// y_i = result(y_i, (A x)_i)
  template <int b>
  template <typename Result>
  void BlockTridiagonalMatrix<b>::product(const double *x, double *y, const Result &result) const
  {
    const std::size_t first = std::min<std::size_t>(n, 2 * b),
                      last = std::max(first, n - std::min<std::size_t>(n, 2 * b));
    product_at_end(0, first, x, y, result);
    std::size_t done = first;
    for (const Repetition &repetition : repetitions)
    {
      if (done < repetition.begin)
        entries.product(done, repetition.begin, x, y, result);
      done = repetition.begin;
      if (repetition.is_zero)
      {
        for (; done < repetition.end; ++done)
          y[done] = result(y[done], 0.);
        continue;
      }
      const auto repeat = [&](const auto stride, const auto &rows)
      {
        for (; done + lanes <= repetition.end; done += lanes)
#pragma omp simd
          for (int k = 0; k < lanes; ++k)
          {
            double sum = 0.;
            for (int o = width % stride; o <= 2 * width; o += stride)
              sum += rows[o][k] * x[done + k + o - width];
            y[done + k] = result(y[done + k], sum);
          }
      };
      if constexpr (is_cable)
        repeat(std::integral_constant<int, n_directions>(), repetition.rows);
      else
      {
        const auto rows = repetition.rows; // a copy in registers: writes cannot change it
        repeat(std::integral_constant<int, 1>(), rows);
      }
    }
    if (done < last)
      entries.product(done, last, x, y, result);
    product_at_end(std::max(done, last), n, x, y, result);
  }

  template <int b>
  void BlockTridiagonalMatrix<b>::visit(const Visitor &visitor) const
  {
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = i < b ? 0 : (i / b - 1) * b; j <= i; ++j)
        visitor(i, j, entries(i, j));
  }

  template <int b>
  std::unique_ptr<SymmetricMatrix> BlockTridiagonalMatrix<b>::clone() const
  {
    return std::make_unique<BlockTridiagonalMatrix<b>>(*this);
  }
  std::unique_ptr<SymmetricMatrix> make_block_tridiagonal(const unsigned int block_size,
                                                          const unsigned int n)
  {
    switch (block_size)
    {
    case 1:
      return std::make_unique<BlockTridiagonalMatrix<1>>(n);
    case 2:
      return std::make_unique<BlockTridiagonalMatrix<2>>(n);
    case 3:
      return std::make_unique<BlockTridiagonalMatrix<3>>(n);
    case 4:
      return std::make_unique<BlockTridiagonalMatrix<4>>(n);
    case 6:
      return std::make_unique<BlockTridiagonalMatrix<6>>(n);
    default:
      throw std::logic_error("block size of a wire that is none of 1, 2, 3, 4, 6");
    }
  }
} // namespace taut
