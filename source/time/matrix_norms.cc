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
  } // namespace

  ByKind max_norms(const Substructure &body, const double *const x)
  {
    // Some periods of kinds at once: their lanes compare in parallel. A comparison loses
    // not-a-number, a sum keeps it.
    constexpr std::size_t most_lanes = 24, vector_length = 8;
    const std::size_t n = body.n_dofs(), period = body.kind_pattern().size(),
                      lanes = period * ((vector_length + period - 1) / period),
                      n_full = lanes > most_lanes ? 0 : n - n % lanes;
    std::array<double, most_lanes> largest = {}, sums = {};
    vectorised(
        [&, x, n_full, lanes]
        {
          for (std::size_t i = 0; i < n_full; i += lanes)
#pragma omp simd
            for (std::size_t k = 0; k < lanes; ++k)
            {
              const double a = std::fabs(x[i + k]);
              largest[k] = a > largest[k] ? a : largest[k];
              sums[k] += a;
            }
        });
    ByKind norms = {0., 0.};
    for (std::size_t k = 0; n_full > 0 && k < lanes; ++k)
      raise(norms[body.kind(k)], std::isnan(sums[k]) ? sums[k] : largest[k]);
    for (std::size_t i = n_full; i < n; ++i)
      raise(norms[body.kind(i)], std::fabs(x[i]));
    return norms;
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
