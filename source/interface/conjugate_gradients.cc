// SPDX-License-Identifier: LGPL-2.1-or-later
#include "conjugate_gradients.h"

#include <BelosEpetraAdapter.hpp>
#include <BelosPseudoBlockCGSolMgr.hpp>
#include <Epetra_LocalMap.h>
#include <Epetra_SerialComm.h>

#include <algorithm>
#include <cmath>

namespace taut
{
  namespace
  {
    /// A function on vectors over constraints as Epetra operator; its inverse is the
    /// preconditioner.
    class FunctionOperator : public Epetra_Operator
    {
    public:
      FunctionOperator(const RowOperator &function, const Epetra_Map &map)
          : function(function), map(map), in(map.NumMyElements())
      {
      }
      int Apply(const Epetra_MultiVector &X, Epetra_MultiVector &Y) const override
      {
        for (int v = 0; v < X.NumVectors(); ++v)
        {
          ++applications;
          std::copy(X[v], X[v] + in.size(), in.begin());
          function(in, out);
          std::copy(out.begin(), out.end(), Y[v]);
        }
        return 0;
      }
      int ApplyInverse(const Epetra_MultiVector &X, Epetra_MultiVector &Y) const override
      {
        return Apply(X, Y);
      }
      int SetUseTranspose(bool) override { return 0; } // symmetric
      double NormInf() const override { return -1.; }
      const char *Label() const override { return "constraints"; }
      bool UseTranspose() const override { return false; }
      bool HasNormInf() const override { return false; }
      const Epetra_Comm &Comm() const override { return map.Comm(); }
      const Epetra_Map &OperatorDomainMap() const override { return map; }
      const Epetra_Map &OperatorRangeMap() const override { return map; }

      int n_applications() const { return applications; }

    private:
      const RowOperator &function;
      const Epetra_Map &map;
      mutable std::vector<double> in, out;
      mutable int applications = 0;
    };
  } // namespace

  int conjugate_gradients(const RowOperator &A, const RowOperator &preconditioner,
                          const std::vector<double> &b, const double tolerance, const int bound,
                          std::vector<double> &x)
  {
    const Epetra_SerialComm communicator;
    const Epetra_LocalMap map(static_cast<int>(b.size()), 0, communicator);
    const FunctionOperator matrix(A, map);
    FunctionOperator inverse(preconditioner, map);
    Epetra_MultiVector solution(map, 1), rhs(map, 1);
    std::copy(b.begin(), b.end(), rhs[0]);

    using Problem = Belos::LinearProblem<double, Epetra_MultiVector, Epetra_Operator>;
    Problem problem(Teuchos::rcpFromRef<const Epetra_Operator>(matrix),
                    Teuchos::rcpFromRef(solution),
                    Teuchos::rcpFromRef<const Epetra_MultiVector>(rhs));
    problem.setLeftPrec(
        Teuchos::rcp(new Belos::EpetraPrecOp(Teuchos::rcpFromRef<Epetra_Operator>(inverse))));
    problem.setProblem();
    const auto parameters = Teuchos::parameterList();
    parameters->set("Convergence Tolerance", tolerance);
    parameters->set("Maximum Iterations", bound);
    parameters->set("Residual Scaling", "Norm of Initial Residual");
    parameters->set("Verbosity", 0);
    Belos::PseudoBlockCGSolMgr<double, Epetra_MultiVector, Epetra_Operator> solver(
        Teuchos::rcpFromRef(problem), parameters);
    const int before = matrix.n_applications();
    try
    {
      solver.solve();
    }
    catch (const Belos::CGIterateFailure &)
    {
      // Not positive: the constraints depend on each other, or only rounding is left. What was
      // found so far is kept.
    }
    catch (const Belos::StatusTestError &)
    {
      // A residual that is not a number: the preconditioned residual was zero, or the numbers are
      // beyond their range.
    }
    x.assign(solution[0], solution[0] + b.size());
    if (!std::all_of(x.begin(), x.end(), [](const double v) { return std::isfinite(v); }))
      x.assign(b.size(), 0.);
    return matrix.n_applications() - before;
  }
} // namespace taut
