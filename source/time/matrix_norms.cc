// SPDX-License-Identifier: LGPL-2.1-or-later
#include "time/matrix_norms.h"
#include "base/instruction_set.h"
#include "base/text.h"
#include <taut/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace taut
{
  namespace
  {
    /// Takes the maximum; keeps not-a-number.
    void raise(double &largest, const double a)
    {
      largest = a > largest || std::isnan(a) ? a : largest;
    }

    /// Joins the halves of @p n lanes.
    template <std::size_t n, typename Lanes>
    void fold(Lanes &largest, Lanes &sums)
    {
      for (std::size_t k = 0; k < n / 2; ++k)
      {
        largest[k] = std::max(largest[k], largest[k + n / 2]);
        sums[k] += sums[k + n / 2];
      }
    }
  } // namespace

  template <std::size_t n_vectors>
  Largest<n_vectors>::Largest(const Substructure &body)
      : body(body), period(body.kind_pattern().size()),
        lanes(8 % period == 0            ? 8
              : most_lanes % period == 0 ? most_lanes
                                         : 0)
  {
    for (std::size_t v = 0; v < n_vectors; ++v)
      for (Lanes *const all : {&largest, &sums})
        std::fill_n((*all)[v].begin(), lanes, 0.);
  }

  /// Adds rows of whole lanes.
  template <std::size_t n_vectors>
  template <std::size_t lanes>
  void Largest<n_vectors>::add_rows(const std::array<const double *, n_vectors> &x,
                                    const std::size_t n)
  {
    vectorised(
        [this, x, n]
        {
          std::array<std::array<double, lanes>, n_vectors> m, s;
          for (std::size_t v = 0; v < n_vectors; ++v)
          {
            std::copy_n(largest[v].begin(), lanes, m[v].begin());
            std::copy_n(sums[v].begin(), lanes, s[v].begin());
          }
          for (std::size_t i = 0; i < n; i += lanes)
            for (std::size_t v = 0; v < n_vectors; ++v)
#pragma omp simd
              for (std::size_t k = 0; k < lanes; ++k)
              {
                const double a = std::fabs(x[v][i + k]);
                m[v][k] = a > m[v][k] ? a : m[v][k];
                s[v][k] += a;
              }
          for (std::size_t v = 0; v < n_vectors; ++v)
          {
            std::copy(m[v].begin(), m[v].end(), largest[v].begin());
            std::copy(s[v].begin(), s[v].end(), sums[v].begin());
          }
        });
  }

  template <std::size_t n_vectors>
  void Largest<n_vectors>::add(const std::array<const double *, n_vectors> &x, const std::size_t n)
  {
    // A rest of many rows is padded with zeros to whole lanes.
    const std::size_t rest = lanes == 0 ? n : n % lanes, n_full = n - rest;
    const bool is_padded = lanes > 0 && rest >= lanes / 2;
    const auto add_full =
        [&](const std::array<const double *, n_vectors> &rows, const std::size_t size)
    {
      if (lanes == most_lanes)
        add_rows<most_lanes>(rows, size);
      else
        add_rows<8>(rows, size);
    };
    if (n_full > 0)
      add_full(x, n_full);
    if (is_padded)
    {
      Lanes padded;
      std::array<const double *, n_vectors> rows;
      for (std::size_t v = 0; v < n_vectors; ++v)
      {
        double *const end = std::copy(x[v] + n_full, x[v] + n, padded[v].data());
        std::fill(end, padded[v].data() + lanes, 0.);
        rows[v] = padded[v].data();
      }
      add_full(rows, lanes);
    }
    else
      for (std::size_t v = 0; v < n_vectors; ++v)
        for (std::size_t i = n_full; i < n; ++i)
          raise(others[v][body.kind(i)], std::fabs(x[v][i]));
  }

  template <std::size_t n_vectors>
  std::array<ByKind, n_vectors> Largest<n_vectors>::result()
  {
    std::size_t n = lanes;
    if (lanes == 8 && period <= 2)
      for (std::size_t v = 0; v < n_vectors; ++v)
      {
        fold<8>(largest[v], sums[v]);
        fold<4>(largest[v], sums[v]);
        n = 2;
      }
    for (std::size_t v = 0; v < n_vectors; ++v)
      for (std::size_t k = 0; k < n; ++k)
        raise(others[v][body.kind(k)], std::isnan(sums[v][k]) ? sums[v][k] : largest[v][k]);
    return others;
  }

  template class Largest<1>;
  template class Largest<4>;

  ByKind largest(const Substructure &body, const std::vector<double> &x)
  {
    Largest<1> found(body);
    found.add({x.data()}, body.n_dofs());
    return found.result()[0];
  }

  void check_size(const Substructure &body, const ByKind &force, const ByKind &displacement,
                  const ByKind &velocity, const std::string &when)
  {
    for (int kind = 0; kind < 2; ++kind)
      if (!(force[kind] <= largest_number && displacement[kind] <= largest_number &&
            velocity[kind] <= largest_number))
      {
        throw EntryError(body.origin(),
                         to_text(when, "body '", body.name(), "' has numbers beyond ",
                                 largest_number, ": force ", force[kind], ", displacement ",
                                 displacement[kind], ", velocity ", velocity[kind],
                                 ". Check loads, stiffnesses and masses for extreme values."));
      }
  }

  double largest_on_diagonal(const SymmetricMatrix &matrix)
  {
    double largest = 0.;
    matrix.visit(
        [&](const unsigned int i, const unsigned int j, const double value)
        {
          if (i == j)
            largest = std::max(largest, value);
        });
    return largest;
  }

  std::vector<double> total_masses(const Structure &structure)
  {
    std::vector<double> result;
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      const Substructure &body = structure[k];
      std::vector<double> e(body.n_dofs()), Me(body.n_dofs(), 0.);
      for (unsigned int i = 0; i < e.size(); ++i)
        e[i] = body.kind(i) == 0 ? 1. : 0.;
      body.mass().vmult_add(1., e.data(), Me.data());
      result.push_back(std::max(0., std::inner_product(e.begin(), e.end(), Me.begin(), 0.)));
    }
    return result;
  }

  RowSumNorm::RowSumNorm(const Substructure &body, const SymmetricMatrix &matrix)
  {
    std::vector<ByKind> rows(body.n_dofs(), ByKind{0., 0.});
    matrix.visit(
        [&](unsigned int i, unsigned int j, double value)
        {
          rows[i][body.kind(j)] += std::fabs(value);
          if (i != j)
            rows[j][body.kind(i)] += std::fabs(value);
        });
    for (const ConstrainedDof &constraint : body.constraints())
      rows[constraint.dof] = {0., 0.};
    sums = {};
    for (unsigned int i = 0; i < rows.size(); ++i)
      for (int c = 0; c < 2; ++c)
        sums[body.kind(i)][c] = std::max(sums[body.kind(i)][c], rows[i][c]);
  }

  ByKind RowSumNorm::times(const ByKind &x) const
  {
    return {sums[0][0] * x[0] + sums[0][1] * x[1], sums[1][0] * x[0] + sums[1][1] * x[1]};
  }
} // namespace taut
