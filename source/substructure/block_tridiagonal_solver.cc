// SPDX-License-Identifier: LGPL-2.1-or-later
#include "substructure/block_tridiagonal_solver.h"
#include "substructure/decoupled_block.h"

#include <stdexcept>

namespace taut
{
  namespace
  {
    /// The solver of cables. Motions in the plane of x and y and along z that do not act on each
    /// other are solved apart, with blocks of 4 x 4 and 2 x 2.
    class CableSolver : public LocalSolver
    {
    public:
      void factor(const std::vector<ScaledMatrix> &summands,
                  const std::vector<unsigned int> &constrained_dofs) override
      {
        constexpr int b = DecoupledBlock::n_dofs;
        bool decoupled = true;
        for (const auto &[factor, matrix] : summands)
          if (const auto *const own = dynamic_cast<const BlockTridiagonalMatrix<b> *>(matrix))
            decoupled = decoupled && own->decouples();
          else
            matrix->visit(
                [&](const unsigned int i, const unsigned int j, const double value) {
                  decoupled =
                      decoupled && (value == 0. || DecoupledBlock::are_together(i % b, j % b));
                });
        if (decoupled)
          solver = &apart;
        else
          solver = &together;
        solver->factor(summands, constrained_dofs);
      }

      void solve(std::vector<double> &x) const override { solver->solve(x); }
      void column(const LinearForm &rhs, WindowedVector &x) const override
      {
        solver->column(rhs, x);
      }
      double flexibility(const LinearForm &rhs) const override { return solver->flexibility(rhs); }

    private:
      BlockTridiagonalSolver<DecoupledBlock> apart;
      BlockTridiagonalSolver<Block<DecoupledBlock::n_dofs>> together;
      LocalSolver *solver = &together; ///< the one that is factored
    };
  } // namespace

  std::unique_ptr<LocalSolver> make_block_tridiagonal_solver(const unsigned int block_size)
  {
    switch (block_size)
    {
    case 1:
      return std::make_unique<BlockTridiagonalSolver<Block<1>>>();
    case 2:
      return std::make_unique<BlockTridiagonalSolver<Block<2>>>();
    case 3:
      return std::make_unique<BlockTridiagonalSolver<Block<3>>>();
    case 4:
      return std::make_unique<BlockTridiagonalSolver<Block<4>>>();
    case 6:
      return std::make_unique<CableSolver>();
    default:
      throw std::logic_error(
          "block size of a block-tridiagonal solver that is none of 1, 2, 3, 4, 6");
    }
  }
} // namespace taut
