// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_constraint_flexibilities_h
#define taut_constraint_flexibilities_h

#include <taut/interface/constraint_operator.h>
#include <taut/substructure/factored_structure.h>

#include <set>
#include <vector>

namespace taut
{
  /**
   * The sizes of the rows of F where no entry of it is known: the diagonal, a scale, and a bound of
   * products. Use it with an F that is applied only.
   *
   * They come from what each constraint moves under its own unit force, B_ik^T A_k^-1 B_ik, by body
   * and by DoFs of a body that nothing couples: a deflection and a rotation of a mass may share no
   * entry of A_k. Of a body with many cuts those of the cuts are estimated from some of them, by
   * the largest ratio to what the diagonal of A_k alone would give: each exact one is a system with
   * A_k.
   */
  class RowFlexibilities
  {
  public:
    /// @p is_cut marks bilateral rigid constraints between parts of a body. The other arguments are
    /// kept by reference.
    RowFlexibilities(const FactoredStructure &solvers, const BodyConstraints &constraints,
                     std::vector<char> is_cut);

    /// After factoring, with compliances @p S. Called by all ranks together, as are the next ones.
    void setup(const std::vector<double> &S);

    /// After the constraints of some bodies of this rank have changed.
    void update(const std::set<std::size_t> &bodies);

    void set_compliance(const std::vector<double> &S);

    /// A bound of sum_j |F_ij| |x_j|, from |F_ij| <= sqrt(f_i f_j) over what both constraints act
    /// on.
    void bound(const std::vector<double> &x, std::vector<double> &y) const;

    /// F_ii.
    const std::vector<double> &diagonal() const { return entries; }

    /// F_ii^-1/2; in statics with B^T diag(A)^-1 B, as the diagonal of F depends there on how a
    /// generalised inverse holds the bodies.
    const std::vector<double> &scale() const { return scales; }

  private:
    struct Part
    {
      std::size_t constraint;
      unsigned int group;
      double flexibility;
    };

    void find_coupling(std::size_t k);
    void compute(std::size_t k);
    void sum_up();
    std::vector<double> diagonal_of(std::size_t k) const;
    bool estimates(std::size_t k, std::vector<const BodyConstraints::Entry *> &samples) const;

    const FactoredStructure &solvers;
    const BodyConstraints &constraints;
    const std::vector<char> is_cut;
    std::vector<std::vector<Part>> parts;           ///< of each body
    std::vector<std::vector<std::size_t>> group_of; ///< group of each DoF; empty: one group
    std::vector<unsigned int> n_groups;
    std::vector<double> compliance, entries, scales;
    std::vector<double> of_bodies, local_of_bodies; ///< without compliances
    mutable std::vector<double> sums, share;
  };
} // namespace taut

#endif
