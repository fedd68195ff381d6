// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matrix_free_schur_complement.h"

#include <AztecOO.h>
#include <Epetra_LinearProblem.h>
#include <Epetra_Vector.h>

#include <algorithm>
#include <cmath>

namespace taut
{
  namespace
  {
    /// Relative residual at which conjugate gradients stop, and the one that still counts as
    /// solved.
    constexpr double wanted_residual = 1e-15, accepted_residual = 1e-11;

    /// Division by the diagonal, as a preconditioner.
    class DiagonalPreconditioner : public Epetra_Operator
    {
    public:
      DiagonalPreconditioner(const Epetra_Operator &F, const std::vector<double> &diagonal)
          : F(F), diagonal(diagonal)
      {
      }
      int ApplyInverse(const Epetra_MultiVector &X, Epetra_MultiVector &Y) const override
      {
        for (int v = 0; v < X.NumVectors(); ++v)
          for (std::size_t i = 0; i < diagonal.size(); ++i)
            Y[v][i] = X[v][i] / diagonal[i];
        return 0;
      }
      int Apply(const Epetra_MultiVector &, Epetra_MultiVector &) const override { return -1; }
      int SetUseTranspose(bool) override { return 0; }
      double NormInf() const override { return -1.; }
      const char *Label() const override { return "diagonal"; }
      bool UseTranspose() const override { return false; }
      bool HasNormInf() const override { return false; }
      const Epetra_Comm &Comm() const override { return F.Comm(); }
      const Epetra_Map &OperatorDomainMap() const override { return F.OperatorDomainMap(); }
      const Epetra_Map &OperatorRangeMap() const override { return F.OperatorRangeMap(); }

    private:
      const Epetra_Operator &F;
      std::vector<double> diagonal;
    };
  } // namespace

  MatrixFreeSchurComplement::MatrixFreeSchurComplement(const FactoredStructure &solvers,
                                                       const ContactRows &rows)
      : solvers(solvers), rows(rows), F(solvers, rows), diagonal_entries(rows.size(), 0.),
        work(solvers.structure().zero())
  {
  }

  void MatrixFreeSchurComplement::compute_diagonal(const std::size_t i)
  {
    std::vector<double> unit(rows.size(), 0.), column(rows.size());
    unit[i] = 1.;
    F.apply(unit.data(), column.data());
    diagonal_entries[i] = column[i];
  }

  void MatrixFreeSchurComplement::setup(const std::vector<double> &S)
  {
    compliance = S;
    F.set_compliance(S);
    for (std::size_t i = 0; i < rows.size(); ++i)
      compute_diagonal(i);
  }

  void MatrixFreeSchurComplement::update_moving()
  {
    for (std::size_t i = rows.n_fixed(); i < rows.size(); ++i)
      compute_diagonal(i);
  }

  void MatrixFreeSchurComplement::free_motion(const BlockVector &P, std::vector<double> &d) const
  {
    work = P;
    solvers.solve(work);
    d.resize(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
      d[i] = evaluate(rows[i].terms, work);
  }

  void MatrixFreeSchurComplement::apply(const std::vector<double> &x, std::vector<double> &y) const
  {
    y.resize(x.size());
    F.apply(x.data(), y.data());
  }

  void MatrixFreeSchurComplement::apply_absolute(const std::vector<double> &x,
                                                 std::vector<double> &y) const
  {
    double sum = 0.;
    for (std::size_t i = 0; i < x.size(); ++i)
      sum += std::sqrt(diagonal_entries[i]) * std::fabs(x[i]);
    y.resize(x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
      y[i] = std::sqrt(diagonal_entries[i]) * sum;
  }

  bool MatrixFreeSchurComplement::solve(const std::vector<std::size_t> &set,
                                        const std::vector<double> &rhs, const double shift,
                                        std::vector<double> &x)
  {
    x.assign(rows.size(), 0.);
    std::vector<double> b(rows.size(), 0.), scale(rows.size(), 1.);
    for (const std::size_t i : set)
    {
      b[i] = rhs[i];
      if (diagonal_entries[i] > 0.)
        scale[i] = (1. + shift) * diagonal_entries[i];
    }
    if (std::all_of(b.begin(), b.end(), [](const double v) { return v == 0.; }))
      return true;

    F.restrict_to(set);
    F.set_shift(shift, diagonal_entries);
    Epetra_Vector solution(View, F.OperatorDomainMap(), x.data()),
        right_hand_side(View, F.OperatorRangeMap(), b.data());
    Epetra_LinearProblem problem(&F, &solution, &right_hand_side);
    DiagonalPreconditioner preconditioner(F, scale);
    AztecOO solver(problem);
    solver.SetAztecOption(AZ_solver, AZ_cg);
    solver.SetPrecOperator(&preconditioner);
    solver.SetAztecOption(AZ_output, AZ_none);
    solver.SetAztecOption(AZ_conv, AZ_rhs);
    const int bound = 100 + 10 * static_cast<int>(set.size());
    solver.Iterate(bound, wanted_residual);

    // What counts is the true residual, not the one of the recursion; rows are compared by their
    // own scale.
    std::vector<double> Fx(rows.size());
    F.apply(x.data(), Fx.data());
    F.unrestrict();
    F.set_shift(0., diagonal_entries);
    double error = 0., size = 0.;
    for (const std::size_t i : set)
    {
      error = std::max(error, std::fabs(Fx[i] - b[i]) / std::sqrt(scale[i]));
      size = std::max(
          {size, std::fabs(b[i]) / std::sqrt(scale[i]), std::sqrt(scale[i]) * std::fabs(x[i])});
    }
    return std::isfinite(error) && error <= accepted_residual * size;
  }
} // namespace taut
