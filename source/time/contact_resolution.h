// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_contact_resolution_h
#define taut_contact_resolution_h

#include "complementarity/operator.h"
#include "time/longest_step.h"
#include <taut/interface/constraints.h>
#include <taut/time/step_parameters.h>

#include <cstddef>
#include <vector>

namespace taut
{
  /**
   * How well a step resolves the unilateral constraints of a system; it decides the choice of the
   * scheme. Use it before the first step.
   *
   * Ratio: the largest eigenvalue of F x = ratio S x for elastic constraints that can close
   * together. F = B^T A^-1 B is that of generalised-alpha with rigid bilateral constraints imposed;
   * entries by which one constraint opens another are left out. A mass m on a stop of stiffness k
   * has the ratio k step^2 / (3.9 m): its contact lasts 1.6 steps at 1, and 12 steps at 0.018.
   *
   * Share: the part of its translational energy that a body would lose in impacts without rebound
   * at these constraints, sum (1 / f_ii) / mass with f = B^T M^-1 B. It is 1 for a mass on a stop,
   * and the mass of a node over the mass of the wire for a wire.
   *
   * A constraint is resolved if its ratio is at most 1 and ratio times share at most 0.018: an
   * impact then changes the energy of its body by at most a percent in generalised-alpha. A
   * constraint with a ratio above 1 acts as rigid. So does a rigid one, unless it presses on
   * massless DoFs and on nothing else that is stiffly joined to them.
   */
  class ContactResolution
  {
  public:
    /**
     * For steps of @p step [s]. Adaptive steps may be as long as @p longest [s] at an impact. An
     * impact that moves a body as a whole then counts as not resolved, and moving constraints,
     * which always press, are judged with the longest step. They are judged along their way until
     * @p until [s]. The arguments are not kept. Called by all ranks together.
     */
    ContactResolution(const Structure &structure, const Constraints &constraints,
                      const SolverParameters &parameters, double step, double longest,
                      double until);

    bool acts_as_rigid(const std::size_t i) const { return of[i].ratio > 1.; }
    bool is_resolved(std::size_t i) const;

    /// The first unilateral constraint that acts as rigid, and that is not resolved, and whether
    /// this one acts as rigid: by their numbers, the same on all ranks; no_link: none.
    std::size_t first_rigid() const { return rigid; }
    std::size_t first_unresolved() const { return unresolved; }
    bool is_unresolved_rigid() const { return unresolved_is_rigid; }

    double ratio(const std::size_t i) const { return of[i].ratio; }
    double share(const std::size_t i) const { return of[i].share; }

    /// Fixed elastic constraints whose impacts move their bodies as a whole: their mean force has
    /// to conserve the energy of their springs, see ConstraintData::conserving. Excluded are
    /// springs that return slowly after a contact, with 0.7 of the critical damping or more and
    /// steps that resolve it.
    std::vector<char> conserving() const;

    /// Of each of these constraints, whose laws it keeps; any step for one without a damper.
    std::vector<LongestStep> longest_steps(const Constraints &constraints) const;

  private:
    struct Row
    {
      double ratio = 0., share = 1.;
      bool unilateral = false, elastic = false, may_conserve = false;
      double contact_time = 0.;       ///< of the constraint alone on its bodies [s]
      double damping_ratio = 0.;      ///< damping over the critical one
      bool comes_back_slowly = false; ///< the spring, after a contact
    };
    class Search;
    void judge(const Structure &structure, const Constraints &all,
               const SolverParameters &parameters, double step, double longest, double until);
    void find_first(const Constraints &constraints);

    const bool adaptive;
    std::vector<Row> of;
    std::size_t rigid = no_link, unresolved = no_link;
    bool unresolved_is_rigid = false;
  };

  /// Flexibilities of bodies at single constraints, where bodies that are cut in parts respond as a
  /// whole.
  class WholeBodies
  {
  public:
    /// The argument is kept by reference.
    explicit WholeBodies(const Constraints &constraints) : constraints(constraints) {}

    /// F_ii - F_ib F_bb^-1 F_bi of the constraints that any rank has in @p wanted, with the rigid
    /// bilateral constraints b closed; 0 for the other constraints. Valid until the next call, by
    /// all ranks together [m/N, rad/(N m)].
    const std::vector<double> &flexibilities(const std::vector<std::size_t> &wanted,
                                             ComplementarityOperator &F);

  private:
    const Constraints &constraints;
    std::vector<std::size_t> joints, rows;
    std::vector<double> result;
  };
} // namespace taut

#endif
