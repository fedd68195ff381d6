// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/base/sparse_cholesky.h>
#include <taut/substructure/local_solver.h>

namespace taut
{
  namespace
  {
    constexpr double smallest_pivot = 1e-15;

    class SparseDirectSolver : public LocalSolver
    {
    public:
      void factor(const std::vector<ScaledMatrix> &summands,
                  const std::vector<unsigned int> &constrained_dofs) override;
      void solve(std::vector<double> &x) const override;
      void column(const LinearForm &rhs, WindowedVector &x) const override;
      double flexibility(const LinearForm &rhs) const override;

    private:
      std::size_t n = 0;
      std::vector<unsigned int> constrained;
      SparseCholesky factors{CholeskyMethod::automatic};
    };

    void SparseDirectSolver::factor(const std::vector<ScaledMatrix> &summands,
                                    const std::vector<unsigned int> &constrained_dofs)
    {
      constrained = constrained_dofs;
      n = summands.front().second->size();
      std::vector<char> is_constrained(n, 0);
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

      const std::size_t bad = factors.factor(n, entries, smallest_pivot);
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
      WindowedVector x;
      column(rhs, x);
      return x.dot(rhs);
    }
  } // namespace

  std::unique_ptr<LocalSolver> make_sparse_direct_solver()
  {
    return std::make_unique<SparseDirectSolver>();
  }
} // namespace taut
