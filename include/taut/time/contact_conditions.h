// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_contact_conditions_h
#define taut_contact_conditions_h

#include <taut/complementarity/problem.h>
#include <taut/time/gap_rates.h>
#include <taut/time/gap_tracker.h>
#include <taut/time/link_springs.h>

#include <vector>

namespace taut
{
  /**
   * What a scheme asks of the constraints in a step: the complementarity problem, and what its
   * multipliers mean.
   *
   * A constraint with conditions on gaps asks for 0 <= D at the end of the step. With conditions on
   * velocities (Moreau 1988, Jean 1999) the rigid constraints ask for 0 <= D' + e D'_0 instead, if
   * they were closed or if D_0 + step D'_0 / 2 <= 0, and take no part otherwise. Times (1 -
   * alpha_f) step, that is B^T dU plus something known: the same F.
   *
   * With either the force of a rigid constraint may be a mean over the step: it acts in this step
   * only and with all its weight. Bilateral constraints of such schemes ask for D' = 0: D = 0 would
   * let their velocities alternate for ever at theta = 1/2. A scheme with a velocity projection
   * asks for gaps of all constraints, and its elastic unilateral constraints have mean forces, too.
   * Rows on DoFs without mass and damping keep forces at the ends of steps there, where they hold
   * these DoFs in equilibrium.
   */
  class ContactConditions
  {
  public:
    /// The arguments but @p start are kept by reference; @p constraints are where they are at the
    /// start.
    ContactConditions(const Structure &structure, const Constraints &constraints,
                      const TurningConstraints &turning, const Reference &reference,
                      const State &start);

    /// For steps with these coefficients from now on [s].
    void prepare(const StepCoefficients &c, double step);

    /// Before each step: whether it is the first one of all.
    void begin_step(const bool first) { is_first = first; }

    /// Sets the problem of the step from the state before it. The constraints are at its end, @p P
    /// is P^, @p lift the given motions.
    void set_problem(const State &before, const StepEquations &system, const BodyVectors &P,
                     const BodyVectors &lift);

    /**
     * Solves it for multipliers L with A dU = P^ + B L. state.multiplier becomes the force at the
     * end of the step, or its mean over the step. Errors are those of @p check, iterations go into
     * @p certificate.
     */
    void find_multipliers(StepEquations &system, const StepCheck &check, Certificate &certificate,
                          State &state);

    /// L and the amplitudes of rigid body modes.
    const MixedComplementaritySolution &applied() const { return solved; }

    /// The part of L that the balance of forces at the end of the step has, and the rest of it.
    const std::vector<double> &in_balance() const { return balanced; }
    const std::vector<double> &impulsive() const { return c.mean_force ? impulses : none; }

    /// Forces of moving constraints with a mean force, which the step counts half in their previous
    /// place: minus their part in the new place. Empty without such constraints [N, N m].
    const std::vector<double> &forces_at_previous_place(const State &before);

    /// True if the force of the constraint is a mean over the step.
    bool mean_force(const std::size_t i) const { return mean[i]; }

    const GapTracker &gaps() const { return gap_tracker; }
    GapTracker &gaps() { return gap_tracker; }
    const LinkSprings &springs() const { return link_springs; }

    /// Of schemes with mean forces.
    const GapRates &rates() const { return gap_rates; }
    GapRates &rates() { return gap_rates; }

    /**
     * True of a rigid constraint that turns and was closed before the step, unless that is the
     * first one, from velocities that open or close it. Its rate after the step, which ends in @p
     * state, is of second order, and impulses that make it zero would take energy in each step.
     */
    bool remains_in_contact(std::size_t i, const State &state) const;

    /// Gaps, rates and springs of the state, whose displacements are at the end of the step
    /// already.
    void update(State &state);

    /**
     * After update(), with schemes without mean forces: what the constraints answer to forces @p
     * left that the balance of the bodies lacks, so that their conditions hold again. False if no
     * answer is found. Called by all ranks together.
     */
    bool correct(const State &state, StepEquations &system, const BodyVectors &left);

    /// The answer: changes of multipliers [N, N m] and amplitudes.
    const MixedComplementaritySolution &corrections() const { return correction; }

    /// Adds these changes, and the motions @p dU that they are a part of, to gaps, springs and
    /// multipliers.
    void add_correction(const BodyVectors &dU, State &state);

    /// Largest residual of a constraint, with D or D' recomputed from the displacements; and its
    /// index.
    double residual(const State &state, const ComplementarityOperator &F, std::size_t &worst);

    /// Largest gap of a bilateral rigid constraint with conditions on velocities [m, rad].
    double drift(const State &state) const;

  private:
    bool on_velocities(const std::size_t i) const
    {
      return mean[i] && !c.velocity_projection &&
             (c.velocity_level || !constraints[i].cone.may_open());
    }
    void set_velocity_condition(std::size_t i, const State &before);
    void set_recomputed_gaps(const State &state);
    void add_decayed_columns(const ComplementarityOperator &F);
    void add_inertial_terms(const State &state, const ComplementarityOperator &F);
    void measure_residual(const ComplementarityOperator &F);

    const Structure &structure;
    const Constraints &constraints;
    StepCoefficients c;
    double step = 0.;
    bool is_first = false; ///< step of all

    const TurningConstraints &turning;
    GapTracker gap_tracker;
    GapRates gap_rates;
    LinkSprings link_springs;
    std::vector<char> mean;         ///< see mean_force()
    std::vector<char> quasi_static; ///< constraints on DoFs without mass and damping

    MixedComplementarityProblem problem;
    MixedComplementaritySolution solved, correction;
    std::vector<double> balanced, impulses, previous_place;
    const std::vector<double> none; ///< empty

    /// The solution with gaps from the displacements, its residuals and what these are relative to.
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
