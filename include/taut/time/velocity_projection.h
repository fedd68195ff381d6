// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_velocity_projection_h
#define taut_velocity_projection_h

#include <taut/complementarity/solver.h>
#include <taut/interface/schur_complement.h>
#include <taut/time/contact_conditions.h>
#include <taut/time/solver_parameters.h>
#include <taut/time/state.h>

#include <memory>
#include <vector>

namespace taut
{
  /**
   * The second part of a step whose first part has put conditions on gaps, with impulses p:
   * impulses P after which the gaps do not close either,
   *
   *     V = V* + M^-1 B (P - p),    0 <= P _|_ D' >= 0 on the unilateral constraints with p > 0,
   *                                 D' = 0 on all rigid bilateral constraints.
   *
   * U stays. An elastic constraint with p > 0 is softened, so that its compliance S fades from
   * rigid to none: 0 <= P _|_ D' + f_ii (theta S / (alpha F_ii))^2 (P - p) >= 0 with F = B^T A^-1 B
   * and f = B^T M^-1 B. S of a law is that at the end of the step. With
   * Newton's restitution e the condition is D' + e min(0, D'_0), and P goes only so far from the
   * solution without it that the contacts do not give energy. DoFs without mass and damping have no
   * velocity of their own: theirs is the mean over the step.
   */
  class VelocityProjection
  {
  public:
    /// The arguments but @p parameters are kept by reference.
    VelocityProjection(const Structure &structure, const Constraints &constraints,
                       const SolverParameters &parameters, const Reference &reference);

    /// For steps with these coefficients from now on. @p F is the matrix of their first part, with
    /// S on its diagonal.
    void prepare(const StepCoefficients &c, double step, const std::vector<double> &S,
                 ComplementarityOperator &F);

    /**
     * Changes V, D' and multipliers of a state after the first part of a step, and takes the change
     * of velocities' share of C V off its balance; @p rates are those of the conditions. @p F as in
     * prepare(), with the moving constraints in their places. Throws what ComplementaritySolver
     * does. Called by all ranks together.
     */
    void project(const ContactConditions &conditions, GapRates &rates, State &state,
                 ComplementarityOperator &F);

    /// Of the last step: largest residual of a rate, recomputed from the velocities, and its
    /// constraint.
    double residual() const { return found; }
    std::size_t worst_constraint() const { return worst; }

    /// Of each body: DoFs without mass and damping, where the step ends in equilibrium.
    const std::vector<std::vector<unsigned int>> &quasi_static_dofs() const { return quasi_static; }

    /// Largest size of each constraint's rate so far, what came to rest rounds with it: of another
    /// projection of the same constraints [m/s, rad/s].
    const std::vector<double> &largest_rates() const { return largest_scale; }
    void set_largest_rates(const std::vector<double> &sizes) { largest_scale = sizes; }

    /// Work of the impulses P - p on the bodies in the last step, of each constraint [J].
    const std::vector<double> &work() const { return work_of_rows; }

  private:
    bool has_to_act(const ContactConditions &conditions, const State &state);
    void find_flexibilities(const std::vector<std::size_t> &elastic, const std::vector<double> &S,
                            ComplementarityOperator &F);
    void find_mass_flexibilities(const std::vector<std::size_t> &elastic);
    void set_relative_softening(const std::vector<double> &S);
    void set_softening();
    void update_moving();
    void factor_masses(const State &state);
    void setup();
    void set_problem(const State &state);
    double kinetic_energy(const State &state);
    void solve(const ContactConditions &conditions, const State &state);
    double largest_part(const ContactConditions &conditions, const State &state,
                        const std::vector<double> &plain, const std::vector<double> &rebounding);
    void set_velocities(GapRates &rates, State &state);
    void move_quasi_static(State &state);
    void change_velocities(State &state);

    const Structure &structure;
    const Constraints &constraints;
    const Reference &reference;
    FactoredStructure solvers;                 ///< of M
    std::vector<std::size_t> with_constraints; ///< bodies of this rank, see ConstrainedBody
    bool some_with_constraints = false;        ///< of some rank
    std::unique_ptr<SchurComplement> schur;
    ComplementaritySolver complementarity;
    bool is_set_up = false, has_softening = false, has_laws = false;
    StepCoefficients c;
    double step = 0.;

    std::vector<std::vector<unsigned int>>
        quasi_static; ///< DoFs of each body without mass and damping
    bool some_quasi_static = false;
    std::vector<std::size_t> moving_elastic;   ///< unilateral constraints
    std::vector<double> flexibility, of_mass;  ///< F_ii and f_ii of the elastic constraints
    std::vector<double> relative_softening;    ///< (S / (alpha F_ii))^2 of each constraint
    std::vector<double> softening;             ///< f_ii times that
    std::vector<char> takes_part, has_no_mass; ///< constraints; the latter act on DoFs without mass
    MixedComplementarityProblem problem;
    std::vector<double> p, q, change; ///< impulses, P - p, f (P - p)
    std::vector<double> rate, work_of_rows, work_vector;
    std::vector<double> largest_scale; ///< of each constraint's rate so far
    BodyVectors dV;
    double found = 0.;
    std::size_t worst = 0;
  };
} // namespace taut

#endif
