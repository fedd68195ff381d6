// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_constraint_motions_h
#define taut_constraint_motions_h

#include <taut/complementarity/problem.h>
#include <taut/time/constraint_laws.h>
#include <taut/time/integrator.h>
#include <taut/time/state.h>
#include <taut/time/step_system.h>
#include <taut/time/turning_constraints.h>

#include <initializer_list>
#include <vector>

namespace taut
{
  /**
   * The constraints through a step: gaps, springs of elastic links, and what complementarity is
   * about.
   *
   * A constraint at position level asks for 0 <= D at the end of the step. Gaps of fixed
   * constraints are carried as increments, because the gap rounds at eps times its size and F^-1 =
   * O(1/step^2) makes force noise of that. With a scheme at velocity level (Moreau 1988, Jean 1999)
   * the rigid constraints ask for 0 <= D' + e D'_0 instead, if they were closed or if D_0 + step
   * D'_0 / 2 <= 0, and take no part otherwise. The rate of a moving constraint has its convective
   * part,
   *
   *     D' = B^T V + ((B - B_0)^T U_0 + D0 - D0_0) / step.
   *
   * Times (1 - alpha_f) step, it is B^T dU plus something known: the same F as at position level.
   *
   * At either level the force of a rigid constraint may be a mean over the step: it acts in this
   * step only and with all its weight. Bilateral constraints of such schemes ask for D' = 0: D = 0
   * would let their velocities alternate for ever at theta = 1/2.
   *
   * A scheme with a velocity projection asks for gaps of all constraints, and its elastic
   * unilateral constraints have mean forces, too: with u the compression of their springs,
   *
   *     0 <= N  _|_  D + S N + h >= 0,    h = -((1 - theta) k - c / step) / (theta k + c / step)
   * u_0,
   *
   * S = 1 / (k + c / (theta step)) and u = max(0, S N + h). Springs that follow a law have its mean
   * between u_0 and u, see ConstraintLaws; S and h are then those of its linearisation. Rows on
   * DoFs without mass and damping keep forces at the ends of steps, where they hold these DoFs in
   * equilibrium.
   */
  class ConstraintMotions
  {
  public:
    /// The arguments but @p start are kept by reference; @p constraints are where they are at the
    /// start.
    ConstraintMotions(const Structure &structure, const Constraints &constraints,
                      const TurningConstraints &turning, const Reference &reference,
                      const State &start);

    /// For steps with these coefficients from now on.
    void prepare(const StepCoefficients &c, double step);

    /// Before each step: whether it is the first one of all.
    void begin_step(const bool first) { is_first = first; }

    /// S with the dampers of the links [m/N, rad/(N m)].
    const std::vector<double> &compliance() const { return S; }

    /// Sets the problem of the step from the state before it. @p constraints are at its end, @p P
    /// is P^.
    void set_problem(const State &before, const StepSystem &system, const BodyVectors &P,
                     const BodyVectors &lift);

    /**
     * Solves it for multipliers L with A dU = P^ + B L. state.multiplier becomes the force at the
     * end of the step, or its mean over the step. Errors are those of @p check, iterations go into
     * @p certificate.
     */
    void find_multipliers(StepSystem &system, const StepCheck &check, Certificate &certificate,
                          State &state);

    /// L and the amplitudes of rigid body modes.
    const MixedComplementaritySolution &applied() const { return solved; }

    /// The part of L that the balance of forces at the end of the step has, and the rest of it.
    const std::vector<double> &in_balance() const { return balanced; }
    const std::vector<double> &impulsive() const { return c.mean_force ? impulses : none; }

    /// Forces of moving constraints with a mean force, which the step counts half in their old
    /// place: minus their part in the new place. Empty without such constraints. [N, N m]
    const std::vector<double> &old_place(const State &before);

    /// True if the force of the constraint is a mean over the step.
    bool mean_force(std::size_t i) const { return mean[i]; }

    /// With mean forces: B^T V at the end of the step, the sums of its absolute terms, and D' at
    /// the start of the step [m/s, rad/s].
    const std::vector<double> &velocities() const { return velocity; }
    const std::vector<double> &velocity_sizes() const { return velocity_size; }
    const std::vector<double> &rates_before_step() const { return rates_before; }

    /**
     * True of a rigid constraint that turns and was closed before the step, unless that is the
     * first one, from velocities that open or close it. Its rate after the step, which ends in @p
     * state, is of second order, and impulses that make it zero would take energy in each step.
     */
    bool stays_closed(std::size_t i, const State &state) const;

    /// B^T dU [m, rad].
    const std::vector<double> &increments() const { return motion; }

    /// Of each constraint, what its gap has of springs besides S N [m, rad].
    const std::vector<double> &spring_histories() const { return link_history; }

    /// After a change of the velocities: B^T V and D' anew. Called by all ranks together.
    void update_rates(State &state);

    /// Gaps and springs of the state, whose displacements are those of the end of the step.
    void update(State &state);

    /**
     * After update(), with schemes without mean forces: what the constraints answer to forces @p
     * left that the balance of the bodies lacks, so that their conditions hold again. False if no
     * answer is found. Called by all ranks together.
     */
    bool correct(const State &state, StepSystem &system, const BodyVectors &left);

    /// The answer: changes of multipliers [N, N m] and amplitudes.
    const MixedComplementaritySolution &corrections() const { return correction; }

    /// Adds these changes, and the motions @p dU that they are a part of, to gaps, springs and
    /// multipliers.
    void add_correction(const BodyVectors &dU, State &state);

    /// Largest residual of a constraint, with D or D' recomputed from the displacements; and its
    /// index.
    double residual(const State &state, const ComplementarityOperator &F, std::size_t &worst);

    /// What is kept from step to step beside the state: the sizes of gaps and of their terms so
    /// far.
    struct Sizes
    {
      std::vector<double> scale, terms;
    };
    Sizes sizes() const { return {largest_scale, gap_terms}; }
    void set_sizes(const Sizes &sizes)
    {
      largest_scale = sizes.scale;
      gap_terms = sizes.terms;
    }

    template <typename Archive>
    void serialize(Archive &archive, unsigned int)
    {
      archive &largest_scale &gap_terms;
    }

    /// Largest gap of a bilateral rigid constraint at velocity level [m, rad].
    double drift(const State &state) const;

  private:
    double moving_gap(std::size_t i) const;
    void add_inertial_terms(const State &state, const ComplementarityOperator &F);
    double largest_stray(const State &state, std::size_t &worst);
    void add_body_terms(const BodyVectors &U);
    bool elastic_mean(std::size_t i) const { return mean[i] && S[i] > 0.; }
    bool conserves(std::size_t i) const { return constraints[i].conserving && elastic_mean(i); }
    bool velocity_level(std::size_t i) const
    {
      return mean[i] && !c.velocity_projection && (c.velocity_level || !constraints[i].unilateral);
    }
    double spring_history(std::size_t i, const State &before) const;
    double compression(std::size_t i, double gap) const;
    void begin_law(std::size_t i, const State &before);
    void set_multipliers(const MixedComplementaritySolution &solution, State &state);
    void share_convection(const State &state);
    void set_velocity_condition(std::size_t i, const State &before);
    void share_contact_free_predictor(const State &before, const StepSystem &system,
                                      const BodyVectors &P, const BodyVectors &lift);
    void share_motions(const State &state);
    void share(std::initializer_list<std::vector<double> *> vectors);

    const Structure &structure;
    const Constraints &constraints;
    const TurningConstraints &turning;
    const Reference &reference;
    StepCoefficients c;
    double step = 0.;
    bool supports_move = false; ///< of a body of this rank
    bool is_first = false;      ///< step of all

    MixedComplementarityProblem conditions;
    ConstraintLaws laws;
    std::vector<double> S;
    std::vector<char> mean;         ///< see mean_force()
    std::vector<char> quasi_static; ///< constraints on DoFs without mass and damping
    MixedComplementaritySolution solved;
    std::vector<double> balanced, impulses;
    const std::vector<double> none; ///< empty
    std::vector<double>
        link_history; ///< part of a link spring's compression that does not depend on N
    std::vector<double> reference_gap; ///< gap of the fixed constraints at the reference
    std::vector<double> scale_of_step; ///< of each constraint's gap, as the last guess has it
    std::vector<double> largest_scale; ///< so far: what came to rest rounds with it
    std::vector<double> gap_terms; ///< largest terms of the gaps of the fixed constraints so far
    /// Of the moving constraints: gap of the start minus the one of its displacements, rounding
    /// that would be a force over a small compliance.
    std::vector<double> gap_correction;
    std::vector<double> motion;        ///< B^T dU
    std::vector<double> position;      ///< B^T U, with the reference's of a moving constraint
    std::vector<double> terms_size;    ///< sum of the absolute terms of these
    std::vector<double> velocity;      ///< B^T V
    std::vector<double> velocity_size; ///< sum of the absolute terms of it
    std::vector<double>
        rate_of_place;           ///< D' of a constraint besides B^T V, with a velocity projection
    std::vector<double> shifted; ///< of old_place()
    std::vector<double> motion_size;         ///< what B^T dU rounds with
    std::vector<double> convection;          ///< (B - B_0)^T U_0 + D0 - D0_0
    std::vector<double> rates_before;        ///< D'_0
    MixedComplementaritySolution correction; ///< of correct()
    MixedComplementaritySolution recomputed; ///< of residual()
    ComplementarityResidual found;
    std::vector<double> weights;
    std::vector<double> work;
  };
} // namespace taut

#endif
