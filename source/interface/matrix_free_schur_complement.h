// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_matrix_free_schur_complement_h
#define taut_matrix_free_schur_complement_h

#include "interface/coarse_space.h"
#include "interface/constraint_flexibilities.h"
#include "interface/interface_preconditioner.h"
#include "interface/natural_coarse_problem.h"

#include "interface/schur_complement.h"
#include <taut/interface/contact_schur_operator.h>

#include <memory>
#include <vector>

namespace taut
{
  /**
   * F applied through the factors of the bodies, its systems solved by preconditioned conjugate
   * gradients; see SchurComplement. Rows are scaled by RowFlexibilities::scale(): forces and
   * moments, stiff and soft constraints then have one norm.
   */
  class MatrixFreeSchurComplement : public SchurComplement, private ComplementarityOperator
  {
  public:
    MatrixFreeSchurComplement(const InterfaceParameters &parameters,
                              const FactoredStructure &solvers, const Constraints &constraints);

    void setup(const std::vector<double> &S) override;
    void set_compliance(const std::vector<double> &S) override;
    void update_moving() override;
    void contact_free_predictor(const BodyVectors &P, std::vector<double> &d,
                                std::vector<double> &terms_size) const override;
    ComplementarityOperator &matrix() override { return *this; }
    std::string description() const override;
    InterfaceStatistics statistics() const override;

  private:
    /// Preconditioner of the scaled constraints for Belos.
    class Inverse;

    std::size_t size() const override { return constraints.size(); }
    double diagonal(std::size_t i) const override { return flexibilities.diagonal()[i]; }
    void apply(const std::vector<double> &x, std::vector<double> &y) const override;
    void apply_absolute(const std::vector<double> &x, std::vector<double> &y) const override
    {
      flexibilities.bound(x, y);
    }
    bool solve(const std::vector<std::size_t> &set, const std::vector<double> &rhs, double shift,
               std::vector<double> &x) override;

    bool solve_with_null_space(const std::vector<std::size_t> &set, const std::vector<double> &rhs,
                               const std::vector<LinearForm> &null_space,
                               const std::vector<double> &load, double shift,
                               std::vector<double> &x, std::vector<double> &alpha) override;
    bool has_null_space_solver() const override
    {
      return parameters.coarse_space == "rigid body modes";
    }

    bool is_iterative() const override { return true; }
    void set_tolerance(double wanted) override;

    const RowMap &rows() const { return F.rows(); }
    std::vector<LinearForm> on_blocks(const std::vector<LinearForm> &null_space,
                                      const std::vector<std::size_t> &rows_of_blocks) const;
    const std::vector<double> &scale() const { return flexibilities.scale(); }
    std::vector<double> scaled(const std::vector<double> &rhs) const;
    void set_solution(const std::vector<double> &scaled_x, std::vector<double> &x) const;
    void prepare(const std::vector<std::size_t> &set, double shift);
    void divide_by_scale(std::vector<double> &x) const;
    void scaled_precondition(const std::vector<double> &r, std::vector<double> &z);
    void follow_sets_if_worth(int n_iterations);
    bool refine(const NaturalCoarseProblem *null_space, const std::vector<double> &b,
                std::vector<double> &x);

    const InterfaceParameters parameters;
    const FactoredStructure &solvers;
    const Constraints &constraints;
    BodyConstraints body_constraints;
    ContactSchurOperator F;
    InterfacePreconditioner preconditioner;
    RowFlexibilities flexibilities;
    std::unique_ptr<CoarseSpace> coarse_space; ///< null: none, or in statics
    std::vector<double> compliance;
    std::vector<char> active;     ///< constraints that everything is prepared for
    std::vector<char> is_changed; ///< bodies that it is not prepared for
    bool follows_sets = false;    ///< the preconditioner is made for each set, in statics
    bool follows_in_vain = false; ///< it was, and a system took as many iterations
    bool is_stale = true;         ///< a matrix, compliance or moving constraint has changed
    double tolerance;             ///< relative residual at which a solve ends
    int most_iterations = 0;      ///< of a system that was solved since setup()
    InterfaceStatistics counts;
    std::vector<double> constraint_work, coarse_part, coarse_motion;
    mutable BodyVectors work;
  };
} // namespace taut

#endif
