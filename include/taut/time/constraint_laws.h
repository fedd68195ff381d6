// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_constraint_laws_h
#define taut_constraint_laws_h

#include <taut/time/step_equations.h>

#include <memory>
#include <vector>

namespace taut
{
  /**
   * The constraints whose springs follow a law N = f(u) that is not linear, in one step. What their
   * multiplier L is as an increasing function of the compression u at the end of the step depends
   * on the scheme,
   *
   *     L = phi(u) = a f(u) + b f_mean(u_0, u) + d (u - u_d),
   *
   * with the mean of f between the compressions before and after, so that the step stores what the
   * force works, and the damper beside the spring. Condition is 0 <= L _|_ g + phi^-1(L) >= 0, g
   * the gap without the spring.
   *
   * Newton's method: with phi linearised at u_j the law is a compliance S = 1 / phi'(u_j), an entry
   * of the diagonal of F, and a shift u_j - S phi(u_j) of the gap; the complementarity problem is
   * solved exactly (N. H. Josephy, 1979), and the next u_j is -g, or where phi vanishes if the
   * constraint is open. All this is the optimality condition of a convex energy. Where the
   * energy may have grown on the way to a solution, it is made least along the way, which needs no
   * products with F: its derivative there is the change of the gaps times L - phi.
   */
  class ConstraintLaws
  {
  public:
    /// Kept by reference.
    explicit ConstraintLaws(const Constraints &constraints);

    bool empty() const { return rows.empty(); }

    /// Begins a step, or statics, from compression @p u [m, rad]: the constraint follows its law at
    /// the end of it, with a damper @p damping (u - @p undamped) [N/m; m].
    void begin_at_end(std::size_t i, double u, double damping = 0., double undamped = 0.);

    /**
     * The same where theta L is a mean over the step, 2 (1 - theta) f_mean + (2 theta - 1) f(u):
     * that of the energy at theta = 1/2, and beyond it what takes more. The damper acts on the
     * change of u.
     */
    void begin_mean(std::size_t i, double u, double theta, double damping);

    /**
     * The same at theta = 1/2 for a conserving constraint: f_mean is the quotient of what a spring
     * that only resists compression stores, (W(u) - W(u_0)) / (u - u_0) with W = 0 for u < 0, so
     * that @p u is minus the gap where the constraint is open. The damper acts on compressions.
     */
    void begin_conserving(std::size_t i, double u, double damping);

    /**
     * Solves @p problem, whose free gaps are g without multipliers where a constraint has a law,
     * and leaves there the shifts of the law. @p S and @p shift become those of the last
     * linearisation; errors are those of @p check. The result is kept until the next call.
     */
    const MixedComplementaritySolution &solve(MixedComplementarityProblem &problem,
                                              StepEquations &system, const StepCheck &check,
                                              Certificate &certificate, std::vector<double> &S,
                                              std::vector<double> &shift);

    /// Whether the spring of a constraint follows a law in this step.
    bool has(const std::size_t i) const { return row_of[i] < rows.size(); }

    /// What compression @p u and multiplier @p L lack of the law, as a gap: (L - phi(u)) / phi'(u).
    /// 0 for a constraint without a law.
    double lack(std::size_t i, double u, double L) const;

    /// phi^-1(L) beside @p u, as exact as L is: @p u may be the small difference of large motions.
    double polished(std::size_t i, double u, double L) const;

  private:
    /// phi of a constraint.
    struct Row
    {
      std::size_t index;
      const ForceLaw *law;
      double u0 = 0., at_end = 1., of_mean = 0., damping = 0., undamped = 0.;
      bool conserving = false; ///< u and u0 below zero count as open
      double open = 0.;        ///< where phi vanishes; minus infinity: nowhere

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
    std::vector<double> compressions(const std::vector<double> &gap) const;
    void linearise(const std::vector<double> &u, std::vector<double> &S,
                   std::vector<double> &shift) const;
    Error error(const Point &at, const MixedComplementarityProblem &problem,
                const ComplementarityOperator &F) const;
    double slope_of_energy(const Point &from, const Point &to, double s,
                           const std::vector<double> &S) const;
    void shorten(const Point &from, Point &to, const std::vector<double> &S) const;

    const Constraints &constraints;
    std::vector<std::shared_ptr<const ForceLaw>> linear; ///< laws of conserving constraints
    std::vector<Row> rows;
    std::vector<std::size_t> row_of; ///< of each constraint, rows.size() of one without a law
  };
} // namespace taut

#endif
