// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_assembled_schur_complement_h
#define taut_assembled_schur_complement_h

#include "response_columns.h"

#include <taut/complementarity/dense_operator.h>
#include <taut/complementarity/sparse_operator.h>
#include <taut/interface/schur_complement.h>

#include <vector>

namespace taut
{
  /// What both assembled forms share: the columns A_k^-1 B_k and what follows from them.
  class AssembledSchurComplement : public SchurComplement
  {
  public:
    AssembledSchurComplement(const FactoredStructure &solvers, const Constraints &constraints);

    void contact_free_predictor(const BodyVectors &P, std::vector<double> &d,
                                std::vector<double> &terms_size) const override;

  protected:
    /// The columns of the moving constraints anew. Returns these constraints of B^T A^-1 B, each of
    /// constraints.size() numbers, one after the other.
    const std::vector<double> &compute_moving();

    const FactoredStructure &solvers;
    const Constraints &constraints;
    const Communicator &processes;
    ResponseColumns columns;
    std::vector<double> compliance, shares;
    std::vector<double> of_bodies; ///< the diagonal without compliances
  };

  /// F as a dense matrix; see SchurComplement.
  class DenseSchurComplement : public AssembledSchurComplement
  {
  public:
    DenseSchurComplement(const FactoredStructure &solvers, const Constraints &constraints);

    void setup(const std::vector<double> &S) override;
    void set_compliance(const std::vector<double> &S) override;
    void update_moving() override;
    ComplementarityOperator &matrix() override { return F; }
    std::string description() const override;

  protected:
    void set_row(std::size_t i, const double *entries);

  private:
    DenseOperator F;
  };

  /**
   * F as a dense matrix from products of half columns (LocalSolver::flexibilities()), without the
   * columns themselves, which as a rule are longer than F for a body that is no wire; see
   * SchurComplement.
   */
  class CondensedSchurComplement : public DenseSchurComplement
  {
  public:
    using DenseSchurComplement::DenseSchurComplement;

    void setup(const std::vector<double> &S) override;
    std::string description() const override;
  };

  /// F as a sparse matrix, the moving constraints as its border; see SchurComplement.
  class SparseSchurComplement : public AssembledSchurComplement
  {
  public:
    SparseSchurComplement(const FactoredStructure &solvers, const Constraints &constraints);

    void setup(const std::vector<double> &S) override;
    void set_compliance(const std::vector<double> &S) override;
    void update_moving() override;
    ComplementarityOperator &matrix() override { return F; }
    std::string description() const override;

  private:
    SparseOperator F;
  };
} // namespace taut

#endif
