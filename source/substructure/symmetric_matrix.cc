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

  void CoordinateMatrix::vmult_rows(const std::size_t begin, const std::size_t end, const double *x,
                                    double *y) const
  {
    if (begin != 0 || end != n)
      throw std::logic_error("a matrix without blocks has only all of its rows at once");
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
} // namespace taut
