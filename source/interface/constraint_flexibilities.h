// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_constraint_flexibilities_h
#define taut_constraint_flexibilities_h

#include <taut/interface/body_constraints.h>
#include <taut/substructure/factored_structure.h>

#include <vector>

namespace taut
{
  /**
   * The motion of each constraint under its own unit force, B_ik^T A_k^-1 B_ik, for each body and
   * each group of coupled DoFs. Deflection and rotation of a mass, for example, may share no entry
   * of A_k. These flexibilities bound unknown entries of F. A body with many cuts has exact values
   * for a sample only, each by one system with A_k. The other cuts are estimated by the largest
   * ratio to the flexibility of diag(A_k).
   */
  class RowFlexibilities
  {
  public:
    /// @p is_cut marks bilateral rigid constraints between parts of a body. The other arguments are
    /// kept by reference.
    RowFlexibilities(const FactoredStructure &solvers, const BodyConstraints &constraints,
                     std::vector<char> is_cut);

    /// Finds the coupled DoFs of body k, after factoring.
    void find_coupling(std::size_t k);

    /// Computes the constraints of body k, after a change of these or of its factor.
    void compute(std::size_t k);

    /// Adds the part of this rank in the diagonal of B^T A^-1 B.
    void add_to_diagonal(std::vector<double> &diagonal) const;

    /// Adds the part of this rank in the diagonal of B^T diag(A)^-1 B.
    void add_to_local_diagonal(std::vector<double> &diagonal) const;

    /// Adds the part of this rank in a bound of sum_j |(B^T A^-1 B)_ij| |x_j|, from
    /// |F_ij| <= sqrt(f_i f_j) for each group of DoFs.
    void add_bound(const std::vector<double> &x, std::vector<double> &y) const;

  private:
    struct Part
    {
      std::size_t constraint;
      unsigned int group;
      double flexibility;
    };

    std::vector<double> diagonal_of(std::size_t k) const;
    bool estimates(std::size_t k, std::vector<const BodyConstraints::Entry *> &samples) const;

    const FactoredStructure &solvers;
    const BodyConstraints &constraints;
    const std::vector<char> is_cut;
    std::vector<std::vector<Part>> parts;            ///< of each body
    std::vector<std::vector<unsigned int>> group_of; ///< group of each DoF; empty: one group
    std::vector<unsigned int> n_groups;
    mutable std::vector<double> sums;
  };
} // namespace taut

#endif
