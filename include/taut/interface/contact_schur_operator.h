// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_contact_schur_operator_h
#define taut_contact_schur_operator_h

#include <taut/interface/body_constraints.h>
#include <taut/substructure/factored_structure.h>

#include <Epetra_LocalMap.h>
#include <Epetra_Operator.h>
#include <Epetra_SerialComm.h>

#include <vector>

namespace taut
{
  /**
   * The interface operator of FETI, F = sum_k B_k^T A_k^-1 B_k + S, applied through the factors of
   * A_k without being formed. Restricted to an active set it acts as the identity on the other
   * constraints, so that it stays definite and an iterative solver sees vectors of one length. Its
   * vectors are the same on all ranks.
   */
  class ContactSchurOperator : public Epetra_Operator
  {
  public:
    /// The arguments are kept by reference.
    ContactSchurOperator(const FactoredStructure &solvers, const BodyConstraints &body_constraints,
                         std::size_t n_constraints);

    /// Diagonal S [m/N, rad/(N m)].
    void set_compliance(const std::vector<double> &S) { compliance = S; }

    /// Rows on which F acts: those that are not 0; the identity elsewhere.
    void restrict_to(const std::vector<char> &set) { active = set; }
    void unrestrict();

    /// Adds shift * diagonal, one entry a constraint.
    void set_shift(double factor, const std::vector<double> &diagonal);

    /// Y = F X, for each column of the multivectors over the constraints.
    int Apply(const Epetra_MultiVector &X, Epetra_MultiVector &Y) const override;

    /// y = F x; both have one entry a constraint [m, rad; N, N m].
    void apply(const double *x, double *y) const;

    /// Products so far but those with zero, and systems of one A_k solved for them on this rank.
    long n_applications() const { return applications; }
    long n_local_solves() const { return local_solves; }

    int SetUseTranspose(bool) override { return 0; } // symmetric
    int ApplyInverse(const Epetra_MultiVector &, Epetra_MultiVector &) const override { return -1; }
    double NormInf() const override { return -1.; }
    const char *Label() const override { return "contact Schur complement"; }
    bool UseTranspose() const override { return false; }
    bool HasNormInf() const override { return false; }
    const Epetra_Comm &Comm() const override { return communicator; }
    const Epetra_Map &OperatorDomainMap() const override { return map; }
    const Epetra_Map &OperatorRangeMap() const override { return map; }

  private:
    const FactoredStructure &solvers;
    const BodyConstraints &body_constraints;
    Epetra_SerialComm communicator;
    Epetra_LocalMap map;
    std::vector<double> compliance, shift;
    std::vector<char> active;
    mutable std::vector<double> share, work;
    mutable long applications = 0, local_solves = 0;
  };
} // namespace taut

#endif
