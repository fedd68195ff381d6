// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/instruction_set.h"
#include "base/pivots.h"
#include <taut/base/exceptions.h>
#include <taut/base/sparse_cholesky.h>
#include <taut/substructure/local_solver.h>

#include <algorithm>

namespace taut
{
  namespace
  {
    constexpr std::size_t lanes = SparseHalves::lanes;

    /// Adds the products of all vectors of @p sparse with @p lanes full vectors, whose rows are
    /// interleaved; @p to has a row for each vector of @p sparse.
    void add_products(const SparseHalves &sparse, const double *const full, double *const to)
    {
      double sums[lanes][lanes] = {};
      for (std::size_t e = 0; e < sparse.index.size(); ++e)
      {
        const double *const other = full + lanes * sparse.index[e];
        const double *const own = sparse.value.data() + lanes * e;
        for (std::size_t j = 0; j < lanes; ++j)
#pragma omp simd
          for (std::size_t i = 0; i < lanes; ++i)
            sums[j][i] += own[j] * other[i];
      }
      for (std::size_t j = 0; j < lanes; ++j)
        for (std::size_t i = 0; i < lanes; ++i)
          to[lanes * j + i] += sums[j][i];
    }

    class SparseDirectSolver : public LocalSolver
    {
    public:
      void factor(const std::vector<ScaledMatrix> &summands,
                  const std::vector<unsigned int> &constrained_dofs) override;
      void solve(std::vector<double> &x) const override;
      void column(const LinearForm &rhs, WindowedVector &x) const override;
      double flexibility(const LinearForm &rhs) const override;
      void own_flexibilities(const std::vector<const LinearForm *> &rows,
                             std::vector<double> &F) const override;
      void flexibilities(const std::vector<const LinearForm *> &rows,
                         std::vector<double> &F) const override;

    private:
      void halves_of(const std::vector<const LinearForm *> &rows, std::size_t first,
                     SparseHalves &y) const;

      std::size_t n = 0;
      std::vector<unsigned int> constrained;
      std::vector<char> is_constrained;
      mutable std::vector<double> full; ///< 0 but within flexibilities()
      SparseCholesky factors{CholeskyMethod::automatic};
    };

    void SparseDirectSolver::factor(const std::vector<ScaledMatrix> &summands,
                                    const std::vector<unsigned int> &constrained_dofs)
    {
      constrained = constrained_dofs;
      n = summands.front().second->size();
      is_constrained.assign(n, 0);
      for (const unsigned int dof : constrained)
        is_constrained[dof] = 1;

      SymmetricEntries entries;
      for (const auto &[factor, matrix] : summands)
        matrix->visit(
            [&, factor = factor](unsigned int i, unsigned int j, double value)
            {
              if (!is_constrained[i] && !is_constrained[j])
                entries.add(i, j, factor * value);
            });
      for (const unsigned int dof : constrained)
        entries.add(dof, dof, 1.);

      const std::size_t bad = factors.factor(n, entries, free_pivot);
      if (bad != n)
        throw BodyNotHeld("the matrix is singular to working precision at DoF " +
                          std::to_string(bad) + ": nothing holds it there");
    }

    void SparseDirectSolver::solve(std::vector<double> &x) const
    {
      for (const unsigned int dof : constrained)
        x[dof] = 0.;
      factors.solve(x);
    }

    void SparseDirectSolver::column(const LinearForm &rhs, WindowedVector &x) const
    {
      x.first = 0;
      x.value.assign(n, 0.);
      rhs.add_to(1., x.value);
      solve(x.value);
    }

    double SparseDirectSolver::flexibility(const LinearForm &rhs) const
    {
      std::vector<double> result;
      own_flexibilities({&rhs}, result);
      return result.front();
    }

    /// Half solutions for the rows from @p first on, as many as there are lanes.
    void SparseDirectSolver::halves_of(const std::vector<const LinearForm *> &rows,
                                       const std::size_t first, SparseHalves &y) const
    {
      std::vector<LinearForm> free(std::min(lanes, rows.size() - first));
      std::vector<const LinearForm *> b;
      for (std::size_t l = 0; l < free.size(); ++l)
      {
        const LinearForm &row = *rows[first + l];
        for (std::size_t e = 0; e < row.index.size(); ++e)
          if (!is_constrained[row.index[e]])
            free[l].add(row.index[e], row.value[e]);
        b.push_back(&free[l]);
      }
      factors.half_solutions(b, y);
    }

    void SparseDirectSolver::own_flexibilities(const std::vector<const LinearForm *> &rows,
                                               std::vector<double> &F) const
    {
      F.resize(rows.size());
      SparseHalves y;
      for (std::size_t first = 0; first < rows.size(); first += lanes)
      {
        halves_of(rows, first, y);
        double sums[lanes] = {};
        for (std::size_t e = 0; e < y.value.size(); e += lanes)
          for (std::size_t l = 0; l < lanes; ++l)
            sums[l] += y.value[e + l] * y.value[e + l];
        std::copy_n(sums, std::min(lanes, rows.size() - first), F.begin() + first);
      }
    }

    void SparseDirectSolver::flexibilities(const std::vector<const LinearForm *> &rows,
                                           std::vector<double> &F) const
    {
      std::vector<SparseHalves> halves;
      for (std::size_t first = 0; first < rows.size(); first += lanes)
        halves_of(rows, first, halves.emplace_back());
      F.resize(rows.size() * (rows.size() + 1) / 2);
      full.resize(n * lanes, 0.);
      for (std::size_t I = 0; I < halves.size(); ++I)
      {
        for (std::size_t e = 0; e < halves[I].index.size(); ++e)
          std::copy_n(&halves[I].value[lanes * e], lanes, &full[lanes * halves[I].index[e]]);
        for (std::size_t J = 0; J <= I; ++J)
        {
          double sums[lanes * lanes] = {};
          vectorised([&half = halves[J], from = full.data(), to = sums]
                     { add_products(half, from, to); });
          for (std::size_t i = lanes * I; i < std::min(lanes * (I + 1), rows.size()); ++i)
            for (std::size_t j = lanes * J; j < std::min(lanes * (J + 1), i + 1); ++j)
              F[i * (i + 1) / 2 + j] = sums[lanes * (j % lanes) + i % lanes];
        }
        for (const int k : halves[I].index)
          std::fill_n(&full[lanes * k], lanes, 0.);
      }
    }
  } // namespace

  std::unique_ptr<LocalSolver> make_sparse_direct_solver()
  {
    return std::make_unique<SparseDirectSolver>();
  }
} // namespace taut
