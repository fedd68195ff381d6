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
  /// The columns A_k^-1 B_k and their products, shared by the assembled forms of F.
  class AssembledSchurComplement : public SchurComplement
  {
  public:
    AssembledSchurComplement(const FactoredStructure &solvers, const Constraints &constraints);

    void contact_free_predictor(const BodyVectors &P, std::vector<double> &d,
                                std::vector<double> &terms_size) const override;

  protected:
    /// Computes the columns of the sliding and turning constraints. Returns their rows of B^T A^-1
    /// B, each of constraints.size() numbers, one after the other.
    const std::vector<double> &compute_moving();

    const FactoredStructure &solvers;
    const Constraints &constraints;
    const Communicator &processes;
    ResponseColumns columns;
    std::vector<double> compliance, shares;
    std::vector<double> of_bodies; ///< diagonal without compliances
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

  /// F as a dense matrix from products of half columns (LocalSolver::flexibilities()). It stores no
  /// columns, which for most bodies except wires are longer than F; see SchurComplement.
  class CondensedSchurComplement : public DenseSchurComplement
  {
  public:
    using DenseSchurComplement::DenseSchurComplement;

    void setup(const std::vector<double> &S) override;
    std::string description() const override;
  };

  /// F as a sparse matrix with sliding and turning constraints as its border; see SchurComplement.
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

    /// Of the fixed rows, in setup(); and a row of the border.
    SymmetricEntries entries;
    std::vector<std::size_t> last_visit;
    std::vector<double> border;
  };
} // namespace taut

#endif
