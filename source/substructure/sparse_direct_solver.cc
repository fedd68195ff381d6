// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/substructure/local_solver.h>

#include <cholmod.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace taut
{
  namespace
  {
    constexpr double smallest_pivot = 1e-15;

    class SparseDirectSolver : public LocalSolver
    {
    public:
      SparseDirectSolver()
      {
        cholmod_start(&common);
        common.supernodal = CHOLMOD_SIMPLICIAL;
        common.final_ll = 0;
        common.print = 0;
      }
      SparseDirectSolver(const SparseDirectSolver &) = delete;
      SparseDirectSolver &operator=(const SparseDirectSolver &) = delete;
      ~SparseDirectSolver() override
      {
        cholmod_free_dense(&result, &common);
        cholmod_free_dense(&workspace_y, &common);
        cholmod_free_dense(&workspace_e, &common);
        cholmod_free_factor(&factors, &common);
        cholmod_finish(&common);
      }

      void factor(const std::vector<ScaledMatrix> &summands,
                  const std::vector<unsigned int> &constrained_dofs) override;
      void solve(std::vector<double> &x) const override;
      void column(const SparseVector &rhs, WindowedVector &x) const override;

    private:
      void check_pivots(const std::vector<double> &diagonal) const;

      std::size_t n = 0;
      std::vector<unsigned int> constrained;
      cholmod_factor *factors = nullptr;
      mutable cholmod_common common;
      mutable cholmod_dense *result = nullptr, *workspace_y = nullptr, *workspace_e = nullptr;
    };

    void SparseDirectSolver::factor(const std::vector<ScaledMatrix> &summands,
                                    const std::vector<unsigned int> &constrained_dofs)
    {
      constrained = constrained_dofs;
      n = summands.front().second->size();
      std::vector<char> is_constrained(n, 0);
      for (const unsigned int dof : constrained)
        is_constrained[dof] = 1;

      std::vector<int> rows, columns;
      std::vector<double> values, diagonal(n, 0.);
      const auto add = [&](unsigned int i, unsigned int j, double value)
      {
        rows.push_back(i);
        columns.push_back(j);
        values.push_back(value);
        if (i == j)
          diagonal[i] += value;
      };
      for (const auto &[factor, matrix] : summands)
        matrix->visit(
            [&, factor = factor](unsigned int i, unsigned int j, double value)
            {
              if (!is_constrained[i] && !is_constrained[j])
                add(i, j, factor * value);
            });
      for (const unsigned int dof : constrained)
        add(dof, dof, 1.);

      cholmod_triplet triplet{};
      triplet.nrow = triplet.ncol = n;
      triplet.nzmax = triplet.nnz = values.size();
      triplet.i = rows.data();
      triplet.j = columns.data();
      triplet.x = values.data();
      triplet.stype = -1; // lower triangle
      triplet.itype = CHOLMOD_INT;
      triplet.xtype = CHOLMOD_REAL;
      triplet.dtype = CHOLMOD_DOUBLE;
      cholmod_sparse *matrix = cholmod_triplet_to_sparse(&triplet, values.size(), &common);
      cholmod_free_factor(&factors, &common);
      factors = cholmod_analyze(matrix, &common);
      cholmod_factorize(matrix, factors, &common);
      cholmod_free_sparse(&matrix, &common);
      if (common.status == CHOLMOD_OUT_OF_MEMORY)
        throw std::bad_alloc();
      check_pivots(diagonal);
    }

    void SparseDirectSolver::check_pivots(const std::vector<double> &diagonal) const
    {
      const auto *permutation = static_cast<const int *>(factors->Perm);
      const auto *start = static_cast<const int *>(factors->p);
      const auto *value = static_cast<const double *>(factors->x);
      for (std::size_t k = 0; k < n; ++k)
      {
        // The diagonal entry of a simplicial LDL^T is D.
        const bool reached = k < factors->minor;
        if (!reached || !(value[start[k]] > smallest_pivot * diagonal[permutation[k]]))
          throw BodyNotHeld("the matrix is singular to working precision at DoF " +
                            std::to_string(permutation[std::min(k, n - 1)]) +
                            ": nothing holds it there");
      }
    }

    void SparseDirectSolver::solve(std::vector<double> &x) const
    {
      for (const unsigned int dof : constrained)
        x[dof] = 0.;
      cholmod_dense rhs{};
      rhs.nrow = rhs.d = rhs.nzmax = n;
      rhs.ncol = 1;
      rhs.x = x.data();
      rhs.xtype = CHOLMOD_REAL;
      rhs.dtype = CHOLMOD_DOUBLE;
      if (!cholmod_solve2(CHOLMOD_A, factors, &rhs, nullptr, &result, nullptr, &workspace_y,
                          &workspace_e, &common))
        throw std::runtime_error("CHOLMOD failed to solve");
      const auto *solution = static_cast<const double *>(result->x);
      std::copy(solution, solution + n, x.begin());
    }

    void SparseDirectSolver::column(const SparseVector &rhs, WindowedVector &x) const
    {
      x.first = 0;
      x.value.assign(n, 0.);
      rhs.add_to(1., x.value);
      solve(x.value);
    }
  } // namespace

  std::unique_ptr<LocalSolver> make_sparse_direct_solver()
  {
    return std::make_unique<SparseDirectSolver>();
  }
} // namespace taut
