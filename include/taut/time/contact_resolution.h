// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_contact_resolution_h
#define taut_contact_resolution_h

#include <taut/complementarity/operator.h>
#include <taut/interface/constraints.h>
#include <taut/time/solver_parameters.h>

#include <cstddef>
#include <vector>

namespace taut
{
  /**
   * How well a step resolves the unilateral constraints of a system: what a scheme is chosen by.
   * Use it before the first step.
   *
   * Ratio: of the elastic constraints that can close together, the largest eigenvalue of
   * F x = ratio S x, where F = B^T A^-1 B is that of generalised-alpha with rigid bilateral
   * constraints imposed and the entries by which one constraint opens another left out. A mass m on
   * a stop of stiffness k has k step^2 / (3.9 m): its contact lasts 1.6 steps at 1, 12 at 0.018.
   *
   * Share: the part of the kinetic energy of a body that moves as a whole which impacts without
   * rebound at these constraints would take, sum (1 / f_ii) / mass with f = B^T M^-1 B. 1 for a
   * mass on a stop, the mass of a node over that of its wire for a wire.
   *
   * A constraint is resolved if its ratio is at most 1 and ratio times share at most 0.018: then an
   * impact changes the energy of its body by at most a percent in generalised-alpha. A constraint
   * whose ratio is above 1 acts as rigid. A rigid one does unless it presses on DoFs without mass,
   * and on nothing else that is joined to them stiffly.
   */
  class ContactResolution
  {
  public:
    /**
     * For steps of @p step [s]. Adaptive ones may be as long as @p longest [s] when they meet an
     * impact, so that one that moves a body as a whole counts as not resolved, and moving
     * constraints, which press all the time, are judged by these. They are judged along their way
     * until @p until [s]. The arguments are not kept. Called by all ranks together.
     */
    ContactResolution(const Structure &structure, const Constraints &constraints,
                      const SolverParameters &parameters, double step, double longest,
                      double until);

    bool acts_as_rigid(const std::size_t i) const { return of[i].ratio > 1.; }
    bool is_resolved(std::size_t i) const;

    /// The first unilateral constraint that is not resolved; size(): none.
    std::size_t first_unresolved() const;
    std::size_t size() const { return of.size(); }

    double ratio(const std::size_t i) const { return of[i].ratio; }
    double share(const std::size_t i) const { return of[i].share; }

    /// Fixed elastic constraints whose impacts move their bodies as a whole: their mean force has
    /// to keep the energy of their springs, see ConstraintData::conserving. With 0.7 of the
    /// critical damping or more, and steps that resolve it, there is none to keep; the spring of
    /// such a link is slow to come back after a contact, and bodies may meet it on its way.
    std::vector<char> conserving() const;

    /// Of those with a damper, the longest step that resolves a contact [s]; infinite elsewhere.
    std::vector<double> longest_steps() const;

  private:
    struct Row
    {
      double ratio = 0., share = 1.;
      bool unilateral = false, elastic = false, may_conserve = false;
      double contact_time = 0.;       ///< of the constraint alone on its bodies [s]
      double damping_ratio = 0.;      ///< damping over the critical one
      bool comes_back_slowly = false; ///< its spring, after a contact
    };
    class Search;
    const bool adaptive;
    std::vector<Row> of;
  };

  /**
   * F_ii of the constraints @p wanted as the bodies have it with their rigid bilateral constraints
   * closed, F_ii - F_ib F_bb^-1 F_bi: bodies that are cut in pieces answer as if they were whole. 0
   * for the others. Called by all ranks together [m/N, rad/(N m)].
   */
  std::vector<double> flexibilities_of_whole_bodies(const Constraints &constraints,
                                                    const std::vector<std::size_t> &wanted,
                                                    ComplementarityOperator &F);
} // namespace taut

#endif
