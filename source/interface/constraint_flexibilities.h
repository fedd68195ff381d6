// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_constraint_flexibilities_h
#define taut_constraint_flexibilities_h

#include <taut/interface/body_constraints.h>
#include <taut/substructure/factored_structure.h>

#include <vector>

namespace taut
{
  /**
   * What each constraint moves under its own unit force, B_ik^T A_k^-1 B_ik, by body and by DoFs of
   * a body that nothing couples: a deflection and a rotation of a mass may share no entry of A_k.
   * They bound F where no entry of it is known. Of a body with many cuts those of the cuts are
   * estimated from some of them, by the largest ratio to what the diagonal of A_k alone would give:
   * each exact one is a system with A_k.
   */
  class RowFlexibilities
  {
  public:
    /// @p is_cut says of each constraint that it ties parts, bilateral and rigid. The other
    /// arguments are kept by reference.
    RowFlexibilities(const FactoredStructure &solvers, const BodyConstraints &constraints,
                     std::vector<char> is_cut);

    /// After factoring: of body k.
    void find_coupling(std::size_t k);

    /// Of the constraints of body k, after they or its factor have changed.
    void compute(std::size_t k);

    /// Adds the share of this rank to the diagonal of B^T A^-1 B.
    void add_to_diagonal(std::vector<double> &diagonal) const;

    /// Adds the share of this rank to that of B^T diag(A)^-1 B.
    void add_to_local_diagonal(std::vector<double> &diagonal) const;

    /// Adds the share of this rank to a bound of sum_j |(B^T A^-1 B)_ij| |x_j|, |F_ij| <= sqrt(f_i
    /// f_j) over what both constraints act on.
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
    std::vector<std::vector<Part>> parts;            ///< by body
    std::vector<std::vector<unsigned int>> group_of; ///< of the DoFs; empty if there is one
    std::vector<unsigned int> n_groups;
    mutable std::vector<double> sums;
  };
} // namespace taut

#endif
