// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_assembled_schur_complement_h
#define taut_assembled_schur_complement_h

#include <taut/complementarity/dense_operator.h>
#include <taut/interface/schur_complement.h>

#include <vector>

namespace taut
{
  /// F as a dense matrix; see SchurComplement.
  class AssembledSchurComplement : public SchurComplement
  {
  public:
    AssembledSchurComplement(const FactoredStructure &solvers, const ContactRows &rows);

    void setup(const std::vector<double> &S) override;
    void update_moving() override;
    void free_motion(const BlockVector &P, std::vector<double> &d) const override;
    ComplementarityOperator &matrix() override { return F; }

  private:
    /// A_k^-1 B_k of one row, for the substructures that it touches.
    struct Column
    {
      std::vector<std::size_t> substructure;
      std::vector<WindowedVector> part;
    };

    void compute_column(std::size_t i);
    double entry(std::size_t column, const std::vector<Term> &terms) const;
    void set_rows(std::size_t begin, std::size_t end);

    const FactoredStructure &solvers;
    const ContactRows &rows;
    DenseOperator F;
    std::vector<double> compliance, shares;
    std::vector<Column> columns;
    bool by_columns = false; ///< free_motion() from the stored columns is cheaper than a solve
    mutable BlockVector work;
  };
} // namespace taut

#endif
