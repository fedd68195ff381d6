// SPDX-License-Identifier: LGPL-2.1-or-later
#include "interface/conjugate_gradients.h"

#include <BelosEpetraAdapter.hpp>
#include <BelosPseudoBlockCGSolMgr.hpp>

#include <algorithm>
#include <cmath>

namespace taut
{
  int conjugate_gradients(const ConstraintOperator &A, ConstraintOperator &preconditioner,
                          const std::vector<double> &b, const double tolerance, const int bound,
                          std::vector<double> &x)
  {
    const Epetra_Map &map = A.OperatorDomainMap();
    Epetra_MultiVector solution(map, 1), rhs(map, 1);
    std::copy(b.begin(), b.end(), rhs[0]);

    using Problem = Belos::LinearProblem<double, Epetra_MultiVector, Epetra_Operator>;
    Problem problem(Teuchos::rcpFromRef<const Epetra_Operator>(A), Teuchos::rcpFromRef(solution),
                    Teuchos::rcpFromRef<const Epetra_MultiVector>(rhs));
    problem.setLeftPrec(Teuchos::rcp(
        new Belos::EpetraPrecOp(Teuchos::rcpFromRef<Epetra_Operator>(preconditioner))));
    problem.setProblem();
    const auto parameters = Teuchos::parameterList();
    parameters->set("Convergence Tolerance", tolerance);
    parameters->set("Maximum Iterations", bound);
    parameters->set("Residual Scaling", "Norm of Initial Residual");
    parameters->set("Verbosity", 0);
    Belos::PseudoBlockCGSolMgr<double, Epetra_MultiVector, Epetra_Operator> solver(
        Teuchos::rcpFromRef(problem), parameters);
    const int before = A.n_products();
    try
    {
      solver.solve();
    }
    catch (const Belos::CGIterateFailure &)
    {
      // A is not positive: constraints are dependent, or only rounding remains. The present
      // solution is kept.
    }
    catch (const Belos::StatusTestError &)
    {
      // The residual is not a number: the preconditioned one was zero, or numbers are out of range.
    }
    x.assign(solution[0], solution[0] + b.size());
    if (!std::all_of(x.begin(), x.end(), [](const double v) { return std::isfinite(v); }))
      x.assign(b.size(), 0.);
    return A.n_products() - before;
  }
} // namespace taut
