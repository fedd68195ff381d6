// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_contact_schur_operator_h
#define taut_contact_schur_operator_h

#include <taut/interface/constraint_operator.h>
#include <taut/substructure/factored_structure.h>

#include <vector>

namespace taut
{
  class NaturalCoarseProblem;

  /**
   * The interface operator of FETI, F = sum_k B_k^T A_k^-1 B_k + S, applied through the factors of
   * A_k without being assembled. On an active set F is the identity for the other constraints: it
   * stays definite, and an iterative solver sees vectors of one length.
   *
   * A product takes the multipliers of the rows that a rank holds from their owners, solves with
   * the bodies of the rank, and adds the motions of these rows at their owners: ranks exchange what
   * their common rows have, and nothing else.
   *
   * Belos applies P^T D F D P with a scale D of the constraints and, in statics, the projector P of
   * the natural coarse problem.
   */
  class ContactSchurOperator : public ConstraintOperator
  {
  public:
    /// The arguments are kept by reference. Called by all ranks together.
    ContactSchurOperator(Lasting<FactoredStructure> solvers,
                         Lasting<BodyConstraints> body_constraints);

    /// Sets the diagonal S [m/N, rad/(N m)].
    void set_compliance(const std::vector<double> &S) { compliance = S; }

    /// Restricts F to rows i with set[i] other than 0; F is the identity on other rows.
    void restrict_to(const std::vector<char> &set) { active = set; }
    void unrestrict();

    /// Adds factor * diagonal to F, one entry a constraint.
    void set_shift(double factor, const std::vector<double> &diagonal);

    /// Sets D > 0, kept by reference; without it D is the identity.
    void set_scale(const std::vector<double> &D) { scale = &D; }

    /// Sets P, kept by reference; null: the identity.
    void set_projector(const NaturalCoarseProblem *P) { projector = P; }

    /// After BodyConstraints::update(): sliding constraints may be on bodies of other ranks. Called
    /// by all ranks together.
    void update_rows();

    /// y = F x with one entry for each constraint that this rank has [m, rad; N, N m].
    void apply(const std::vector<double> &x, std::vector<double> &y) const;

    /// y = D F D x on the rows of F; the identity on other rows. On owned rows.
    void scaled_apply(const std::vector<double> &x, std::vector<double> &y) const;

    /// The constraints of the rows that this rank owns.
    const std::vector<std::size_t> &owned() const { return own; }

    /// Number of products, and of systems with one A_k for these on this rank.
    long n_applications() const { return applications; }
    long n_local_solves() const { return local_solves; }

  private:
    void multiply(const std::vector<double> &x, std::vector<double> &y) const override;
    void apply_owned(const std::vector<double> &x, std::vector<double> &y) const;
    void add_solves() const;
    void set_positions();

    const FactoredStructure &solvers;
    const BodyConstraints &body_constraints;
    const std::vector<double> *scale = nullptr;
    const NaturalCoarseProblem *projector = nullptr;
    std::vector<double> compliance, shift;
    std::vector<char> active;
    std::vector<std::size_t> own;                   ///< constraint of each owned row
    std::vector<std::size_t> position;              ///< of a constraint among the held rows
    mutable std::vector<double> multiplier, motion; ///< of held rows
    mutable std::vector<double> work, scaled, projected;
    mutable long applications = 0, local_solves = 0;
  };
} // namespace taut

#endif
