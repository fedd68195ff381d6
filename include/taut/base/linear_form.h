// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_linear_form_h
#define taut_linear_form_h

#include <boost/container/small_vector.hpp>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace taut
{
#if __GNUC__ >= 11
  // GCC 12 takes a small vector with memory of its own for one without, where it is moved.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wstringop-overread"
#endif

  /// A linear form: a few entries of a long vector. Indices may repeat: their values add. As many
  /// entries as an element of a cable has need no memory of their own.
  struct LinearForm
  {
    static constexpr std::size_t n_inside = 12;
    boost::container::small_vector<unsigned int, n_inside> index;
    boost::container::small_vector<double, n_inside> value;

    void add(unsigned int i, double v)
    {
      index.push_back(i);
      value.push_back(v);
    }

    /// The fault that makes this no form on vectors of @p n entries, as a part of a message; empty:
    /// none.
    std::string fault(const std::size_t n) const
    {
      if (index.size() != value.size())
        return "has " + std::to_string(index.size()) + " indices and " +
               std::to_string(value.size()) + " values";
      for (std::size_t k = 0; k < index.size(); ++k)
        if (index[k] >= n)
          return "acts on DoF " + std::to_string(index[k]) + ", and there are " +
                 std::to_string(n) + ", counted from 0";
        else if (!std::isfinite(value[k]))
          return "has a value that is no finite number, at DoF " + std::to_string(index[k]);
      return "";
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

#if __GNUC__ >= 11
#pragma GCC diagnostic pop
#endif

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
    double dot(const LinearForm &x) const
    {
      double sum = 0.;
      for (std::size_t k = 0; k < x.index.size(); ++k)
        sum += x.value[k] * (*this)[x.index[k]];
      return sum;
    }

    /// Adds zeros until the window has a multiple of @p n entries, if the vector of length @p size
    /// has room.
    void pad(const std::size_t n, const std::size_t size)
    {
      const std::size_t missing = (n - value.size() % n) % n, behind = size - first - value.size();
      if (missing <= behind)
        value.resize(value.size() + missing, 0.);
      else if (missing <= first)
      {
        value.insert(value.begin(), missing, 0.);
        first -= static_cast<unsigned int>(missing);
      }
    }
  };

  /// A sum of scalar products of windows with full vectors, and the sum of the absolute values of
  /// the terms, the scale of its rounding error.
  class ScalarProduct
  {
  public:
    /// Windows of a multiple of this number of entries are the fastest.
    static constexpr std::size_t lanes = 8;

    void add(const WindowedVector &window, const std::vector<double> &x)
    {
      const double *a = window.value.data(), *b = x.data() + window.first;
      const std::size_t n = window.value.size(), n_full = n - n % lanes;
      // Several sums side by side, which do not wait for each other.
      double own_sums[lanes] = {}, own_sizes[lanes] = {};
      for (std::size_t k = 0; k < n_full; k += lanes)
#pragma omp simd
        for (std::size_t l = 0; l < lanes; ++l)
        {
          const double term = a[k + l] * b[k + l];
          own_sums[l] += term;
          own_sizes[l] += std::fabs(term);
        }
      for (std::size_t k = n_full; k < n; ++k)
      {
        const double term = a[k] * b[k];
        own_sums[k - n_full] += term;
        own_sizes[k - n_full] += std::fabs(term);
      }
      for (std::size_t l = 0; l < lanes; ++l)
      {
        sums[l] += own_sums[l];
        sizes[l] += own_sizes[l];
      }
    }

    double value() const
    {
      return total(sums);
    }
    double size() const
    {
      return total(sizes);
    }

  private:
    static double total(const double (&x)[lanes])
    {
      return ((x[0] + x[4]) + (x[1] + x[5])) + ((x[2] + x[6]) + (x[3] + x[7]));
    }

    double sums[lanes] = {}, sizes[lanes] = {};
  };
} // namespace taut

#endif
