// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_matrix_free_schur_complement_h
#define taut_matrix_free_schur_complement_h

#include <taut/interface/contact_schur_operator.h>
#include <taut/interface/schur_complement.h>

#include <vector>

namespace taut
{
  /// F applied through the factors of the bodies, its systems solved by conjugate gradients; see
  /// SchurComplement.
  class MatrixFreeSchurComplement : public SchurComplement, private ComplementarityOperator
  {
  public:
    MatrixFreeSchurComplement(const FactoredStructure &solvers, const ContactRows &rows);

    void setup(const std::vector<double> &S) override;
    void update_moving() override;
    void free_motion(const BlockVector &P, std::vector<double> &d,
                     std::vector<double> &terms_size) const override;
    ComplementarityOperator &matrix() override { return *this; }
    std::string description() const override;

  private:
    std::size_t size() const override { return rows.size(); }
    double diagonal(std::size_t i) const override { return diagonal_entries[i]; }
    void apply(const std::vector<double> &x, std::vector<double> &y) const override;
    void apply_absolute(const std::vector<double> &x, std::vector<double> &y) const override;
    bool solve(const std::vector<std::size_t> &set, const std::vector<double> &rhs, double shift,
               std::vector<double> &x) override;

    void compute_diagonal(std::size_t i);

    const FactoredStructure &solvers;
    const ContactRows &rows;
    ContactSchurOperator F;
    std::vector<double> compliance, diagonal_entries;
    mutable BlockVector work;
  };
} // namespace taut

#endif
