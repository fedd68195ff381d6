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

  void CoordinateMatrix::vmult(const double *x, double *y) const
  {
    std::fill(y, y + n, 0.);
    vmult_add(1., x, y);
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
  BlockTridiagonalMatrix<b>::BlockTridiagonalMatrix(const unsigned int n) : n_nodes(n / b)
  {
    if (n % b != 0)
      throw std::logic_error(
          "the size of a block-tridiagonal matrix is a multiple of its block size");
    for (auto &entries : diagonal)
      entries.assign(n_nodes, 0.);
    for (auto &entries : left)
      entries.assign(n_nodes + 1, 0.);
  }

  template <int b>
  void BlockTridiagonalMatrix<b>::add(const unsigned int i, const unsigned int j,
                                      const double value)
  {
    const unsigned int r = std::max(i, j), c = std::min(i, j);
    if (r / b == c / b)
    {
      diagonal[(r % b) * b + c % b][r / b] += value;
      if (r != c)
        diagonal[(c % b) * b + r % b][r / b] += value;
    }
    else if (r / b == c / b + 1)
      left[(r % b) * b + c % b][r / b] += value;
    else
      throw std::logic_error("entry outside the band of a block-tridiagonal matrix");
  }

  template <int b>
  void BlockTridiagonalMatrix<b>::vmult_add(const double factor, const double *x, double *y) const
  {
    product(x, y,
            [factor](const double before, const double sum) { return before + factor * sum; });
  }

  template <int b>
  void BlockTridiagonalMatrix<b>::vmult(const double *x, double *y) const
  {
    product(x, y, [](double, const double sum) { return sum; });
  }

  /// y_i = result(y_i, (A x)_i)
  template <int b>
  template <typename Result>
  void BlockTridiagonalMatrix<b>::product(const double *x, double *y, const Result &result) const
  {
    const std::size_t n = n_nodes;
    const double *d[b * b], *l[b * b];
    for (int k = 0; k < b * b; ++k)
    {
      d[k] = diagonal[k].data();
      l[k] = left[k].data();
    }
    // y_i += D_i x_i, + L_i x_{i-1} + L_{i+1}^T x_{i+1} where these exist.
    const auto end_node = [&](const std::size_t i)
    {
      for (int r = 0; r < b; ++r)
      {
        double sum = 0.;
        for (int c = 0; c < b; ++c)
        {
          sum += d[r * b + c][i] * x[b * i + c];
          if (i > 0)
            sum += l[r * b + c][i] * x[b * (i - 1) + c];
          if (i + 1 < n)
            sum += l[c * b + r][i + 1] * x[b * (i + 1) + c];
        }
        y[b * i + r] = result(y[b * i + r], sum);
      }
    };
    if (n == 0)
      return;
    end_node(0);
#pragma omp simd
    for (std::size_t i = 1; i < n - 1; ++i)
      for (int r = 0; r < b; ++r)
      {
        double sum = 0.;
        for (int c = 0; c < b; ++c)
          sum += d[r * b + c][i] * x[b * i + c] + l[r * b + c][i] * x[b * (i - 1) + c] +
                 l[c * b + r][i + 1] * x[b * (i + 1) + c];
        y[b * i + r] = result(y[b * i + r], sum);
      }
    if (n > 1)
      end_node(n - 1);
  }

  template <int b>
  void BlockTridiagonalMatrix<b>::visit(const Visitor &visitor) const
  {
    for (std::size_t i = 0; i < n_nodes; ++i)
    {
      if (i > 0)
        for (int r = 0; r < b; ++r)
          for (int c = 0; c < b; ++c)
            visitor(b * i + r, b * (i - 1) + c, left[r * b + c][i]);
      for (int r = 0; r < b; ++r)
        for (int c = 0; c <= r; ++c)
          visitor(b * i + r, b * i + c, diagonal[r * b + c][i]);
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
