// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/substructure/symmetric_matrix.h>

#include <algorithm>

namespace taut
{
  void SymmetricMatrix::vmult(const double *x, double *y) const
  {
    std::fill(y, y + size(), 0.);
    vmult_add(1., x, y);
  }

  void CompressedMatrix::add(const unsigned int i, const unsigned int j, const double v)
  {
    if (double *const entry = find(std::max(i, j), std::min(i, j)))
      *entry += v;
    else
      added.add(i, j, v);
  }

  void CompressedMatrix::set_zero()
  {
    std::fill(value.begin(), value.end(), 0.);
    added = {};
  }

  /// The entry (i, j <= i) of the rows, or nullptr.
  double *CompressedMatrix::find(const unsigned int i, const unsigned int j)
  {
    if (begin_row.empty())
      return nullptr;
    const auto begin = column.begin() + begin_row[i], end = column.begin() + begin_row[i + 1],
               found = std::lower_bound(begin, end, j);
    return found != end && *found == j ? &value[found - column.begin()] : nullptr;
  }

  void CompressedMatrix::compress() const
  {
    if (added.size() == 0 && !begin_row.empty())
      return;
    for (unsigned int i = 0; i + 1 < begin_row.size(); ++i)
      for (std::size_t e = begin_row[i]; e < begin_row[i + 1]; ++e)
        added.add(i, column[e], value[e]);
    added.compress();
    begin_row.assign(n + 1, 0);
    for (const int row : added.row)
      ++begin_row[row + 1];
    for (unsigned int i = 0; i < n; ++i)
      begin_row[i + 1] += begin_row[i];
    column.assign(added.column.begin(), added.column.end());
    value = std::move(added.value);
    added = {};
  }

  void CompressedMatrix::vmult_add(const double factor, const double *x, double *y) const
  {
    compress();
    for (unsigned int i = 0; i < n; ++i)
    {
      const double x_i = factor * x[i];
      double sum = 0.;
      std::size_t e = begin_row[i];
      for (; e < begin_row[i + 1] && column[e] < i; ++e)
      {
        sum += value[e] * x[column[e]];
        y[column[e]] += value[e] * x_i;
      }
      y[i] += factor * sum;
      if (e < begin_row[i + 1])
        y[i] += value[e] * x_i;
    }
  }

  void CompressedMatrix::visit(const Visitor &visitor) const
  {
    compress();
    for (unsigned int i = 0; i < n; ++i)
      for (std::size_t e = begin_row[i]; e < begin_row[i + 1]; ++e)
        visitor(i, column[e], value[e]);
  }

  std::unique_ptr<SymmetricMatrix> CompressedMatrix::clone() const
  {
    return std::make_unique<CompressedMatrix>(*this);
  }
} // namespace taut
