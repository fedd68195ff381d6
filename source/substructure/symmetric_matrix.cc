// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/substructure/symmetric_matrix.h>

#include <algorithm>
#include <stdexcept>

namespace taut
{
  void CoordinateMatrix::add(const unsigned int i, const unsigned int j, const double value)
  {
    entries[{std::max(i, j), std::min(i, j)}] += value;
  }

  void CoordinateMatrix::vmult_add(const double factor, const double *x, double *y) const
  {
    for (const auto &[position, value] : entries)
    {
      const auto [i, j] = position;
      y[i] += factor * value * x[j];
      if (i != j)
        y[j] += factor * value * x[i];
    }
  }

  void CoordinateMatrix::visit(const Visitor &visitor) const
  {
    for (const auto &[position, value] : entries)
      visitor(position.first, position.second, value);
  }

  std::unique_ptr<SymmetricMatrix> CoordinateMatrix::clone() const
  {
    return std::make_unique<CoordinateMatrix>(*this);
  }

  template <int b>
  BlockTridiagonalMatrix<b>::BlockTridiagonalMatrix(const unsigned int n) : rows(n / b)
  {
    if (n % b != 0)
      throw std::logic_error(
          "the size of a block-tridiagonal matrix is a multiple of its block size");
  }

  template <int b>
  void BlockTridiagonalMatrix<b>::add(const unsigned int i, const unsigned int j,
                                      const double value)
  {
    const unsigned int r = std::max(i, j), c = std::min(i, j);
    if (r / b == c / b)
    {
      Block &block = rows[r / b].diagonal;
      block[(r % b) * b + c % b] += value;
      if (r != c)
        block[(c % b) * b + r % b] += value;
    }
    else if (r / b == c / b + 1)
      rows[r / b].left[(r % b) * b + c % b] += value;
    else
      throw std::logic_error("entry outside the band of a block-tridiagonal matrix");
  }

  template <int b>
  void BlockTridiagonalMatrix<b>::vmult_add(const double factor, const double *x, double *y) const
  {
    const std::size_t n = rows.size();
    // Row by row: D_i x_i + L_i x_{i-1} into y_i, and L_i^T x_i into y_{i-1}, which is complete
    // after it.
    for (std::size_t i = 0; i < n; ++i)
    {
      const Row &row = rows[i];
      const double *xi = x + b * i;
      double *yi = y + b * i;
      for (int r = 0; r < b; ++r)
      {
        double sum = 0.;
        for (int c = 0; c < b; ++c)
          sum += row.diagonal[r * b + c] * xi[c];
        if (i > 0)
          for (int c = 0; c < b; ++c)
            sum += row.left[r * b + c] * xi[c - b];
        yi[r] += factor * sum;
      }
      if (i > 0)
        for (int c = 0; c < b; ++c)
        {
          double sum = 0.;
          for (int r = 0; r < b; ++r)
            sum += row.left[r * b + c] * xi[r];
          yi[c - b] += factor * sum;
        }
    }
  }

  template <int b>
  void BlockTridiagonalMatrix<b>::visit(const Visitor &visitor) const
  {
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      if (i > 0)
        for (int r = 0; r < b; ++r)
          for (int c = 0; c < b; ++c)
            visitor(b * i + r, b * (i - 1) + c, rows[i].left[r * b + c]);
      for (int r = 0; r < b; ++r)
        for (int c = 0; c <= r; ++c)
          visitor(b * i + r, b * i + c, rows[i].diagonal[r * b + c]);
    }
  }

  template <int b>
  std::unique_ptr<SymmetricMatrix> BlockTridiagonalMatrix<b>::clone() const
  {
    return std::make_unique<BlockTridiagonalMatrix<b>>(*this);
  }

  template class BlockTridiagonalMatrix<1>;
  template class BlockTridiagonalMatrix<2>;
  template class BlockTridiagonalMatrix<3>;
  template class BlockTridiagonalMatrix<4>;

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
    default:
      throw std::logic_error("block size of a wire outside 1..4");
    }
  }
} // namespace taut
