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
    double *const entry = find(i, j);
    if (!entry)
      return added.add(i, j, v);
    *entry += v;
    if (i != j)
      *find(j, i) += v;
  }

  void CompressedMatrix::set_zero()
  {
    std::fill(value.begin(), value.end(), 0.);
    added = {};
  }

  /// The entry (i, j) of the rows, or nullptr.
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
        if (column[e] <= i)
          added.add(i, column[e], value[e]);
    SymmetricEntries lower;
    std::swap(lower, added);
    lower.compress();
    begin_row.assign(n + 1, 0);
    for (std::size_t k = 0; k < lower.size(); ++k)
    {
      ++begin_row[lower.row[k] + 1];
      if (lower.row[k] != lower.column[k])
        ++begin_row[lower.column[k] + 1];
    }
    for (unsigned int i = 0; i < n; ++i)
      begin_row[i + 1] += begin_row[i];
    column.resize(begin_row[n]);
    value.resize(begin_row[n]);
    std::vector<std::size_t> next(begin_row.begin(), begin_row.end() - 1);
    const auto put = [&](const std::size_t i, const std::size_t j, const double v)
    {
      column[next[i]] = j;
      value[next[i]++] = v;
    };
    for (std::size_t k = 0; k < lower.size(); ++k)
    {
      put(lower.row[k], lower.column[k], lower.value[k]);
      if (lower.row[k] != lower.column[k])
        put(lower.column[k], lower.row[k], lower.value[k]);
    }
  }

  void CompressedMatrix::vmult_add(const double factor, const double *x, double *y) const
  {
    compress();
    for (unsigned int i = 0; i < n; ++i)
    {
      double sum = 0.;
      for (std::size_t e = begin_row[i]; e < begin_row[i + 1]; ++e)
        sum += value[e] * x[column[e]];
      y[i] += factor * sum;
    }
  }

  void CompressedMatrix::visit(const Visitor &visitor) const
  {
    compress();
    for (unsigned int i = 0; i < n; ++i)
      for (std::size_t e = begin_row[i]; e < begin_row[i + 1]; ++e)
        if (column[e] <= i)
          visitor(i, column[e], value[e]);
  }

  std::unique_ptr<SymmetricMatrix> CompressedMatrix::clone() const
  {
    return std::make_unique<CompressedMatrix>(*this);
  }
} // namespace taut
