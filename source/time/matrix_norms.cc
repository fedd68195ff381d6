// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/time/matrix_norms.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace taut
{
  namespace
  {
    /// Largest absolute entries at the positions of a pattern of p DoFs; not-a-number stays.
    template <int p>
    void largest_in_pattern(const double *x, const std::size_t n, double (&result)[p])
    {
      // Several accumulators a position, so that they do not wait for each other. A comparison
      // loses what is not a number, a sum keeps it.
      constexpr int lanes = 8;
      double m[lanes * p] = {}, sums[lanes * p] = {};
      const std::size_t n_full = n - n % (lanes * p);
      for (std::size_t i = 0; i < n_full; i += lanes * p)
#pragma omp simd
        for (int k = 0; k < lanes * p; ++k)
        {
          const double a = std::fabs(x[i + k]);
          m[k] = a > m[k] ? a : m[k];
          sums[k] += a;
        }
      for (std::size_t i = n_full; i < n; ++i)
      {
        const double a = std::fabs(x[i]);
        m[i % p] = a > m[i % p] ? a : m[i % p];
        sums[i % p] += a;
      }
      for (int k = 0; k < lanes * p; ++k)
        if (std::isnan(sums[k]))
          result[k % p] = sums[k];
        else if (m[k] > result[k % p])
          result[k % p] = m[k];
    }
  } // namespace

  PerKind largest(const Substructure &body, const double *x)
  {
    PerKind result = {0., 0.};
    const std::size_t n = body.n_dofs();
    const std::vector<unsigned char> &kinds = body.kind_pattern();
    if (kinds.size() == 1)
    {
      double m[1] = {};
      largest_in_pattern<1>(x, n, m);
      result[kinds[0]] = m[0];
    }
    else if (kinds.size() == 2)
    {
      double m[2] = {};
      largest_in_pattern<2>(x, n, m);
      for (int k = 0; k < 2; ++k)
        if (!(m[k] <= result[kinds[k]]) && !std::isnan(result[kinds[k]]))
          result[kinds[k]] = m[k];
    }
    else
      for (std::size_t i = 0; i < n; ++i)
      {
        double &largest = result[body.kind(i)];
        const double a = std::fabs(x[i]);
        largest = a > largest || a != a ? a : largest;
      }
    return result;
  }

  void check_size(const Substructure &body, const PerKind &force, const PerKind &displacement,
                  const PerKind &velocity, const std::string &when)
  {
    for (int kind = 0; kind < 2; ++kind)
      if (!(force[kind] <= largest_number && displacement[kind] <= largest_number &&
            velocity[kind] <= largest_number))
      {
        std::ostringstream out;
        out << when << "body '" << body.name() << "' has numbers beyond " << largest_number
            << ": force " << force[kind] << ", displacement " << displacement[kind] << ", velocity "
            << velocity[kind] << ". Check loads, stiffnesses and masses for extreme values.";
        throw EntryError(body.origin(), out.str());
      }
  }

  void largest_contact_forces(const Structure &structure, const ContactRows &rows,
                              const std::vector<double> &N, std::vector<PerKind> &result)
  {
    result.assign(structure.size(), PerKind{0., 0.});
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (N[i] != 0.)
        for (const auto &[k, form] : rows[i].terms)
          for (std::size_t j = 0; j < form.index.size(); ++j)
          {
            double &largest = result[k][structure[k].kind(form.index[j])];
            const double force = std::fabs(form.value[j] * N[i]);
            largest = force > largest || std::isnan(force) ? force : largest;
          }
  }

  KindNorm::KindNorm(const Substructure &body, const SymmetricMatrix &matrix)
  {
    std::vector<PerKind> rows(body.n_dofs(), PerKind{0., 0.});
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

  PerKind KindNorm::times(const PerKind &x) const
  {
    return {sums[0][0] * x[0] + sums[0][1] * x[1], sums[1][0] * x[0] + sums[1][1] * x[1]};
  }
} // namespace taut
