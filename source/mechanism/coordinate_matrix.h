// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_coordinate_matrix_h
#define taut_coordinate_matrix_h

#include <taut/substructure/symmetric_matrix.h>

#include <algorithm>
#include <map>
#include <memory>
#include <utility>

namespace taut
{
  /// Entry by entry, for small lumped mechanisms. With the rows of CompressedMatrix 11 of 275
  /// extreme scenes of masses, with stiffnesses of ratio 1e12, lose their answer to rounding.
  class CoordinateMatrix : public SymmetricMatrix
  {
  public:
    explicit CoordinateMatrix(const unsigned int n) : n(n) {}

    using SymmetricMatrix::add;
    unsigned int size() const override { return n; }
    unsigned int block_size() const override { return 0; }
    void add(const unsigned int i, const unsigned int j, const double value) override
    {
      entries[{std::max(i, j), std::min(i, j)}] += value;
    }
    void set_zero() override
    {
      for (auto &[position, value] : entries)
        value = 0.;
    }
    void vmult_add(const double factor, const double *x, double *y) const override
    {
      for (const auto &[position, value] : entries)
      {
        const auto [i, j] = position;
        y[i] += factor * value * x[j];
        if (i != j)
          y[j] += factor * value * x[i];
      }
    }
    void visit(const Visitor &visitor) const override
    {
      for (const auto &[position, value] : entries)
        visitor(position.first, position.second, value);
    }
    std::unique_ptr<SymmetricMatrix> clone() const override
    {
      return std::make_unique<CoordinateMatrix>(*this);
    }

  private:
    unsigned int n;
    std::map<std::pair<unsigned int, unsigned int>, double> entries;
  };
} // namespace taut

#endif
