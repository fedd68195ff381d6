// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_sparse_vector_h
#define taut_sparse_vector_h

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace taut
{
  /// A few entries of a long vector. Indices may repeat: their values add.
  struct SparseVector
  {
    std::vector<unsigned int> index;
    std::vector<double> value;

    void add(unsigned int i, double v)
    {
      index.push_back(i);
      value.push_back(v);
    }

    /// Scalar product with a full vector.
    double dot(const std::vector<double> &x) const
    {
      double sum = 0.;
      for (std::size_t k = 0; k < index.size(); ++k)
        sum += value[k] * x[index[k]];
      return sum;
    }

    /// y += factor * this.
    void add_to(double factor, std::vector<double> &y) const
    {
      for (std::size_t k = 0; k < index.size(); ++k)
        y[index[k]] += factor * value[k];
    }
  };

  /// Consecutive entries first, first + 1, ... of a long vector that is zero (to working precision)
  /// elsewhere.
  struct WindowedVector
  {
    unsigned int first = 0;
    std::vector<double> value;

    double operator[](unsigned int i) const
    {
      return (i < first || i - first >= value.size()) ? 0. : value[i - first];
    }

    /// Scalar product with a sparse vector.
    double dot(const SparseVector &x) const
    {
      double sum = 0.;
      for (std::size_t k = 0; k < x.index.size(); ++k)
        sum += x.value[k] * (*this)[x.index[k]];
      return sum;
    }

    /// Scalar product with a full vector, and the sum of its absolute terms, which it rounds with.
    std::pair<double, double> dot_and_size(const std::vector<double> &x) const
    {
      const double *a = value.data(), *b = x.data() + first;
      const std::size_t n = value.size();
      double sum = 0., size = 0.;
#pragma omp simd reduction(+ : sum, size)
      for (std::size_t k = 0; k < n; ++k)
      {
        sum += a[k] * b[k];
        size += std::fabs(a[k] * b[k]);
      }
      return {sum, size};
    }
  };
} // namespace taut

#endif
