// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_assembled_schur_complement_h
#define taut_assembled_schur_complement_h

#include "complementarity/dense_operator.h"
#include "complementarity/sparse_operator.h"
#include "interface/schur_complement.h"

#include <vector>

namespace taut
{
  /// Rows up to which a dense F is as fast as a sparse one: both cost the same with 91 constraints
  /// of a line, and the sparse one 60 % with 260 on 72 bodies (doc/decomposition.md).
  constexpr std::size_t most_dense_rows = 150;

  /// True if no body of any rank is block-tridiagonal: columns of A_k^-1 then do not decay. Called
  /// by all ranks together.
  bool have_long_columns(const Structure &structure);

  /// The columns A_k^-1 B_k of the constraints, without decayed tails, and their products: what the
  /// assembled forms of F share.
  class AssembledSchurComplement : public SchurComplement
  {
  public:
    AssembledSchurComplement(const FactoredStructure &solvers, const Constraints &constraints);

    void set_compliance(const std::vector<double> &S) override;
    void update_moving() override;
    void contact_free_predictor(const BodyVectors &P, std::vector<double> &d,
                                std::vector<double> &terms_size) const override;

  protected:
    /// Sets the entries F_ij of a row of the bodies, j < i of a fixed row and all j of a sliding or
    /// turning one, with the compliance on the diagonal.
    virtual void set_row(std::size_t i, const double *of_bodies) = 0;
    virtual void set_diagonal(std::size_t i, double value) = 0;

    /// Computes the columns of the fixed constraints.
    void compute_fixed();

    /// Part of this rank in F_ij, without compliance, from the column of constraint i.
    double entry(std::size_t i, std::size_t j) const;

    /// Calls @p visit(j), perhaps repeatedly, for each fixed constraint j <= i that the column of
    /// constraint i reaches.
    template <typename Visit>
    void visit_reached(std::size_t i, const Visit &visit) const;

    const FactoredStructure &solvers;
    const Constraints &constraints;
    const Communicator &processes;
    std::vector<double> compliance, shares;
    std::vector<double> diagonal_of_bodies; ///< without compliances

  private:
    /// A_k^-1 B_k of one constraint on one of its bodies.
    struct Response
    {
      std::size_t body;
      WindowedVector x;
    };

    /// First and last DoF of a fixed constraint on a body.
    struct Reach
    {
      unsigned int first, last;
      std::size_t constraint;
    };

    void compute(std::size_t i);

    std::vector<std::vector<Response>> columns; ///< of each constraint
    std::vector<std::vector<Reach>> reach;      ///< for each body, by first DoF
    std::vector<unsigned int> widest;           ///< largest last - first of each body
    WindowedVector second, sum;                 ///< in compute()
    bool by_columns = false; ///< contact_free_predictor() from the columns is cheaper than a solve
    mutable BodyVectors work;
  };

  /**
   * F as a dense matrix; see SchurComplement. Where columns are long and many, the block of the
   * fixed constraints comes from products of half columns (LocalSolver::flexibilities()), and their
   * columns are not stored.
   */
  class DenseSchurComplement : public AssembledSchurComplement
  {
  public:
    DenseSchurComplement(const FactoredStructure &solvers, const Constraints &constraints);

    void setup(const std::vector<double> &S) override;
    ComplementarityOperator &matrix() override { return F; }
    std::string description() const override;

  private:
    void add_flexibilities();
    void set_row(std::size_t i, const double *of_bodies) override;
    void set_diagonal(const std::size_t i, const double value) override { F.set(i, i, value); }

    const bool stores_columns;
    DenseOperator F;
  };

  /// F as a sparse matrix with sliding and turning constraints as its border; see SchurComplement.
  class SparseSchurComplement : public AssembledSchurComplement
  {
  public:
    SparseSchurComplement(const FactoredStructure &solvers, const Constraints &constraints);

    void setup(const std::vector<double> &S) override;
    ComplementarityOperator &matrix() override { return F; }
    std::string description() const override;

  private:
    void set_row(std::size_t i, const double *of_bodies) override;
    void set_diagonal(const std::size_t i, const double value) override
    {
      F.set_diagonal(i, value);
    }

    SparseOperator F;
    std::vector<double> border; ///< a row of it
  };
} // namespace taut

#endif
