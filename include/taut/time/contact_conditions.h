// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_contact_conditions_h
#define taut_contact_conditions_h

#include <taut/complementarity/problem.h>
#include <taut/time/gap_rates.h>
#include <taut/time/gap_tracker.h>
#include <taut/time/link_springs.h>
#include <taut/time/prescribed_motions.h>

#include <vector>

namespace taut
{
  /**
   * The conditions of a scheme on the constraints in a step: the complementarity problem, and the
   * meaning of its multipliers.
   *
   * A condition on a gap is 0 <= D at the end of the step. A condition on a velocity (Moreau 1988,
   * Jean 1999) is 0 <= D' + e D'_0 for a rigid constraint that was closed or has D_0 + step
   * D'_0 / 2 <= 0; other rigid constraints take no part. Times (1 - alpha_f) step it is B^T dU plus
   * known terms, so that F is the same.
   *
   * With either condition the force of a rigid constraint may be a mean over the step, which acts
   * in this step only and with full weight. Bilateral constraints with mean forces have the
   * condition D' = 0: under D = 0 their velocities alternate for ever at theta = 1/2. A scheme with
   * a velocity projection has conditions on gaps of all constraints, and mean forces of elastic
   * unilateral ones, too. On DoFs without mass and damping, forces remain those at the end of the
   * step, where they hold these DoFs in equilibrium.
   */
  class ContactConditions
  {
  public:
    /// All but @p start are kept by reference; @p constraints are at their initial places.
    ContactConditions(const Structure &structure, const Constraints &constraints,
                      const TurningConstraints &turning, const Reference &reference,
                      const State &start);

    /// Sets the coefficients and the length [s] of the steps to come.
    void prepare(const StepCoefficients &c, double step);

    /// Before each step: whether it is the first step of the run.
    void begin_step(const bool first) { is_first = first; }

    /// Sets the problem of the step from the state before it. The constraints are in their places
    /// at the end of the step, @p P is P^.
    void set_problem(const State &before, const StepEquations &system, const BodyVectors &P,
                     const PrescribedMotions &prescribed);

    /// Solves the problem for multipliers L with A dU = P^ + B L. state.multiplier becomes the
    /// force at the end of the step, or the mean force over the step. Errors come from @p check,
    /// iterations go into @p certificate.
    void find_multipliers(StepEquations &system, const StepCheck &check, Certificate &certificate,
                          State &state);

    /// The problem of the step, after set_problem().
    const MixedComplementarityProblem &problem_of_step() const { return problem; }

    /// L and the amplitudes of rigid body modes.
    const MixedComplementaritySolution &applied() const { return solved; }

    /// The part of L in the balance of forces at the end of the step, and the remaining part.
    const std::vector<double> &in_balance() const { return balanced; }
    const std::vector<double> &impulsive() const { return c.mean_force ? impulses : none; }

    /// Mean forces of moving constraints act half in their previous place. Returns minus their part
    /// in the new place; empty without such constraints [N, N m].
    const std::vector<double> &forces_at_previous_place(const State &before);

    /// True if the force of the constraint is a mean over the step.
    bool mean_force(const std::size_t i) const { return mean[i]; }

    const GapTracker &gaps() const { return gap_tracker; }
    GapTracker &gaps() { return gap_tracker; }
    const LinkSprings &springs() const { return link_springs; }

    /// Rates, for schemes with mean forces.
    const GapRates &rates() const { return gap_rates; }
    GapRates &rates() { return gap_rates; }

    /// True for a rigid turning constraint that was closed before the step, except in the first
    /// step if initial velocities open or close it. Its rate after the step, in @p state, is of
    /// second order; impulses against it would take energy in each step.
    bool remains_in_contact(std::size_t i, const State &state) const;

    /// Updates gaps, rates and springs of the state, whose displacements are those after the step.
    void update(State &state);

    /// After update(), with schemes without mean forces: solves for the correction of the
    /// constraints under the residual forces @p left of the bodies, and @p on_modes of their rigid
    /// body modes. False if there is no solution. Called by all ranks together.
    bool correct(const State &state, StepEquations &system, const BodyVectors &left,
                 const BodyVectors &on_modes);

    /// Corrections of multipliers [N, N m] and amplitudes.
    const MixedComplementaritySolution &corrections() const { return correction; }

    /// Adds the corrections, and the motions @p dU of the bodies, to gaps, springs and multipliers.
    void add_correction(const BodyVectors &dU, State &state);

    /// Takes corrections back: returns to an earlier applied() and its state.
    void restore(const MixedComplementaritySolution &earlier, const State &state);

    /// Largest residual of a constraint with D or D' recomputed from displacements, and its index.
    double residual(const State &state, StepEquations &system, std::size_t &worst);

    /// Largest gap of a bilateral rigid constraint with conditions on velocities [m, rad].
    double drift(const State &state) const;

  private:
    bool on_velocities(const std::size_t i) const
    {
      return mean[i] && !c.velocity_projection &&
             (c.velocity_level || !constraints[i].cone.may_open());
    }
    void set_rates_of_prescribed(const BodyVectors *lift);
    void set_velocity_condition(std::size_t i, const State &before);
    void set_recomputed_gaps(const State &state);
    void add_decayed_columns(const ComplementarityOperator &F);
    void add_inertial_terms(const State &state, const ComplementarityOperator &F);
    void add_elastic_terms(const State &state, const FactoredStructure &bodies);
    void measure_residual(const ComplementarityOperator &F);

    const Structure &structure;
    const Constraints &constraints;
    StepCoefficients c;
    double step = 0.;
    bool is_first = false; ///< whether this is the first step of the run

    const TurningConstraints &turning;
    GapTracker gap_tracker;
    GapRates gap_rates;
    LinkSprings link_springs;
    std::vector<char> mean;         ///< see mean_force()
    std::vector<char> quasi_static; ///< constraints on DoFs without mass and damping

    MixedComplementarityProblem problem;
    MixedComplementaritySolution solved, correction;
    std::vector<double> balanced, impulses, previous_place;
    std::vector<double> of_prescribed; ///< what increments lack for velocities; empty: nothing
    const std::vector<double> none;    ///< empty

    /// The solution with gaps from the displacements, its residuals and their scales.
    struct Residual
    {
      MixedComplementaritySolution at;
      ComplementarityResidual found;
      std::vector<double> weights, terms;
    };
    Residual recomputed;
  };
} // namespace taut

#endif
