// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/substructure/local_solver.h>

namespace taut
{
  void LocalSolver::own_flexibilities(const std::vector<const LinearForm *> &rows,
                                      std::vector<double> &F) const
  {
    F.clear();
    for (const LinearForm *row : rows)
      F.push_back(flexibility(*row));
  }

  void LocalSolver::flexibilities(const std::vector<const LinearForm *> &rows,
                                  std::vector<double> &F) const
  {
    F.clear();
    WindowedVector x;
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      column(*rows[i], x);
      for (std::size_t j = 0; j <= i; ++j)
        F.push_back(x.dot(*rows[j]));
    }
  }

  std::unique_ptr<LocalSolver> make_local_solver(const std::string &name,
                                                 const SymmetricMatrix &matrix)
  {
    if (name == "sparse direct" || matrix.block_size() == 0)
      return make_sparse_direct_solver();
    if (name == "block tridiagonal")
      return make_block_tridiagonal_solver(matrix.block_size());
    throw UserError("unknown local solver '" + name +
                    "'; known are: block tridiagonal, sparse direct");
  }
} // namespace taut
