// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_constraint_laws_h
#define taut_constraint_laws_h

#include "time/step_equations.h"

#include <memory>
#include <vector>

namespace taut
{
  /**
   * The constraints of one step whose springs follow a nonlinear law N = f(u). Their multiplier L
   * is an increasing function of the compression u at the end of the step, by the scheme:
   *
   *     L = phi(u) = a f(u) + b f_mean(u_0, u) + d (u - u_d).
   *
   * f_mean is the mean of f between the compressions before and after the step: with it the spring
   * stores the work of its force. The last term is the damper. The condition is
   * 0 <= L _|_ g + phi^-1(L) >= 0 with g the gap without the spring.
   *
   * Newton's method linearises phi at u_j. The law then is a compliance S = 1 / phi'(u_j) on the
   * diagonal of F, and a shift u_j - S phi(u_j) of the gap. The complementarity problem is solved
   * exactly (N. H. Josephy, 1979). The next u_j is -g, or for an open constraint the zero of phi.
   *
   * This is the optimality condition of a convex energy. If it may have grown, a line search
   * minimises it without products with F: its derivative is the change of the gaps times L - phi.
   */
  class ConstraintLaws
  {
  public:
    /// The argument is kept by reference. Called by all ranks together, as is solve().
    explicit ConstraintLaws(const Constraints &constraints);

    /// Whether no constraint of any rank has a law.
    bool empty() const { return !has_some; }

    /// Begins a step, or statics, from compression @p u [m, rad]. The constraint follows its law at
    /// the end of the step, with a damper @p damping (u - @p undamped) [N/m; m].
    void begin_at_end(std::size_t i, double u, double damping = 0., double undamped = 0.);

    /// Begins a step where theta L is the mean 2 (1 - theta) f_mean + (2 theta - 1) f(u). It
    /// conserves energy at theta = 1/2 and dissipates beyond. The damper acts on changes of u.
    void begin_mean(std::size_t i, double u, double theta, double damping);

    /// Begins a step at theta = 1/2 for a conserving constraint. f_mean is (W(u) - W(u_0)) / (u -
    /// u_0) with the energy W of a spring under compression, and W = 0 for u < 0. Hence @p u is
    /// minus the gap where the constraint is open. The damper acts on compressions.
    void begin_conserving(std::size_t i, double u, double damping);

    /// Solves @p problem, whose free gaps of constraints with a law are g without multipliers; adds
    /// the shifts of the laws to these. @p S and @p shift become those of the last linearisation.
    /// Errors come from @p check. The result is valid until the next call.
    const MixedComplementaritySolution &solve(MixedComplementarityProblem &problem,
                                              StepEquations &system, const StepCheck &check,
                                              Residuals &residuals, std::vector<double> &S,
                                              std::vector<double> &shift);

    /// Whether the spring of a constraint follows a law in this step.
    bool has(const std::size_t i) const { return row_of[i] < rows.size(); }

    /// Residual of the law at compression @p u and multiplier @p L, as a gap:
    /// (L - phi(u)) / phi'(u). 0 for a constraint without a law.
    double lack(std::size_t i, double u, double L) const;

    /// Compression at the end of a step without force, where the ends are @p u apart: a damper lets
    /// the spring come back no faster than its force does.
    double relaxed(std::size_t i, double u) const;

    /// phi^-1(L) near @p u, as exact as L: @p u may be the small difference of large motions.
    double polished(std::size_t i, double u, double L) const;

  private:
    /// phi of a constraint.
    struct Row
    {
      std::size_t index;
      const ForceLaw *law;
      double u0 = 0., at_end = 1., of_mean = 0., damping = 0., undamped = 0.;
      bool conserving = false; ///< u and u0 below zero mean open
      double open = 0.;        ///< zero of phi; minus infinity: none

      double force(double u) const;
      double slope(double u) const;
      double mean_force(double u) const;
      double slope_of_mean(double u) const;
    };

    /// Gaps without springs, and multipliers.
    struct Point
    {
      std::vector<double> gap, multiplier;
    };
    struct Error
    {
      double gap = 0., force = 0.;
    };
    void begin(std::size_t i, Row row, double low, double high);
    void set_compressions(const std::vector<double> &gap, std::vector<double> &result) const;
    void linearise(const std::vector<double> &u, std::vector<double> &S,
                   std::vector<double> &shift) const;
    Error error(const Point &at, const MixedComplementarityProblem &problem,
                const ComplementarityOperator &F);
    double slope_of_energy(const Point &from, const Point &to, double s,
                           const std::vector<double> &S) const;
    void shorten(const Point &from, Point &to, const std::vector<double> &S) const;

    const Constraints &constraints;
    std::vector<std::shared_ptr<const ForceLaw>> linear; ///< laws of conserving constraints
    std::vector<Row> rows;
    std::vector<std::size_t> row_of; ///< row of each constraint; rows.size(): no law
    bool has_some = false;           ///< laws on any rank

    // In solve(): gaps of the problem and their scales, compressions, and the last two iterates.
    std::vector<double> free_gap, scale, compression, in_error;
    Point last, now;
  };
} // namespace taut

#endif
