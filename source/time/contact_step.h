// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_contact_step_h
#define taut_contact_step_h

#include "complementarity/problem.h"
#include "time/constraint_laws.h"
#include "time/contact_residual.h"
#include "time/prescribed_motions.h"
#include "time/step_equations.h"
#include "time/turning_constraints.h"
#include <taut/time/state.h>
#include <taut/time/step_report.h>

#include <cstddef>
#include <vector>

namespace taut
{
  /**
   * The rows of the constraints through a step: the complementarity problem that the rules of the
   * scheme make of them, the meaning of its multipliers, and gaps, rates and springs at the end.
   *
   * A condition on a gap is 0 <= D at the end of the step. A condition on a velocity (Moreau 1988,
   * Jean 1999) is 0 <= D' + e D'_0 for a rigid constraint that was closed or has D_0 + step
   * D'_0 / 2 <= 0; other rigid constraints take no part. Times (1 - alpha_f) step it is B^T dU plus
   * known terms, so that F is the same. A mean force acts in this step only and with full weight.
   *
   * The gap of a fixed row is summed from increments: a gap rounds at eps times its size, and
   * F^-1 = O(1/step^2) turns this into noise of the force. The gap of a sliding row comes from the
   * displacements at its place.
   *
   * The compression of a spring with its damper at the end of a step is u = S N + h (Kelvin-Voigt).
   * With forces at the end of the step
   *
   *     S = 1 / (k + c v),    h = S c (v u_0 - known rate),    v = dV/dU of the scheme.
   *
   * If a unilateral constraint has a mean force N over the step,
   *
   *     S = 1 / (k + c / (theta step)),    h = -((1 - theta) k - c / step) / (theta k + c / step)
   *                                            u_0,
   *
   * and u = max(0, S N + h). Conserving springs, and springs with a law, have S and h of their
   * linearisation, see ConstraintLaws.
   *
   * The rate D' of a gap is B^T V plus the motion of the place of a sliding row: of a corrected row
   * v (dB/dx)^T U + r' at the end of the step, otherwise the mean ((B - B_0)^T U_0 + D0 - D0_0) /
   * step. Functions with a state are called by all ranks together. Units are m, or rad for
   * rotational constraints.
   */
  class ContactStep
  {
  public:
    /// All but @p start are kept by reference; @p constraints are at their initial places.
    ContactStep(const Structure &structure, const Constraints &constraints,
                const TurningConstraints &turning, const Reference &reference,
                const StepMethod &method, const State &start);

    /// After a change of the method.
    void prepare();

    /// Before each step: whether it is the first step of the run.
    void begin_step(const bool first) { is_first = first; }

    /// Sets the problem of the step from the state before it. The constraints are in their places
    /// at the end of the step, @p P is P^.
    void set_problem(const State &before, const StepEquations &system, const BodyVectors &P,
                     const PrescribedMotions &prescribed);

    /// Solves the problem for multipliers L with A dU = P^ + B L. state.multiplier becomes the
    /// force at the end of the step, or the mean force over the step. Errors come from @p check,
    /// iterations go into @p residuals.
    void find_multipliers(StepEquations &system, const StepCheck &check, Residuals &residuals,
                          State &state);

    /// The problem of the step, after set_problem().
    const MixedComplementarityProblem &problem_of_step() const { return problem; }

    /// L and the amplitudes of rigid body modes.
    const MixedComplementaritySolution &applied() const { return solved; }

    /// The part of L in the balance of forces at the end of the step, and the remaining part; empty
    /// for a scheme without mean forces.
    const std::vector<double> &in_balance() const { return balanced; }
    const std::vector<double> &impulsive() const { return method.has_means() ? impulses : none; }

    /// Mean forces of sliding rows that are corrected act half in their previous place. Returns
    /// minus their part in the new place; empty without such rows [N, N m].
    const std::vector<double> &forces_at_previous_place(const State &before);

    /// S of the springs including the dampers; 0 for a rigid constraint [m/N, rad/(N m)].
    const std::vector<double> &compliance() const { return S; }

    /// h of the springs.
    const std::vector<double> &histories() const { return history; }

    /// B^T dU of the step, after update().
    const std::vector<double> &increments() const { return motion; }

    /// B^T V after update() or update_rates(), the sum of the sizes of its terms, and D' before the
    /// step.
    const std::vector<double> &velocities() const { return velocity; }
    const std::vector<double> &velocity_sizes() const { return velocity_size; }
    const std::vector<double> &rates_before_step() const { return rates_before; }

    /// Whether the force of a row is a mean over the step.
    bool is_mean(const std::size_t i) const { return method.rules[i].is_mean(); }

    /// True for a rigid turning constraint that was closed before the step, except in the first
    /// step if initial velocities open or close it. Its rate after the step, in @p state, is of
    /// second order; impulses against it would take energy in each step.
    bool remains_in_contact(std::size_t i, const State &state) const;

    /// Updates gaps, rates and springs of the state, whose displacements are those after the step,
    /// and reports the work of mean forces.
    void update(State &state, StepReport &report);

    /// After a change of the velocities of @p state: sets its rates again.
    void update_rates(State &state);

    /// After update(), with schemes without mean forces: solves for the correction of the
    /// constraints under the residual forces @p left of the bodies, and @p on_modes of their rigid
    /// body modes. False if there is no solution.
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

    /// Largest gap of a bilateral rigid constraint with conditions on velocities.
    double drift(const State &state) const;

    /// Gaps from now on round with all motions @p U that brought the bodies here, whatever their
    /// directions.
    void count_motions(const BodyVectors &U);

    /// What persists between steps beside the state: largest sizes of gaps and of their terms.
    struct Sizes
    {
      std::vector<double> gaps, terms;

      template <typename Archive>
      void serialize(Archive &archive, unsigned int)
      {
        archive &gaps &terms;
      }
    };
    const Sizes &largest_sizes() const { return largest; }
    void set_largest_sizes(const Sizes &sizes) { largest = sizes; }

  private:
    /// Whether a row has a spring with a mean force.
    bool has_mean_spring(const std::size_t i) const
    {
      return method.rules[i].is_mean() && S[i] > 0.;
    }

    void predict_motions(const State &before, const StepEquations &system, const BodyVectors &P,
                         const BodyVectors *lift);
    double gap_of_place(std::size_t i) const;
    double free_gap(std::size_t i, const State &before) const;
    double gap_scale(std::size_t i, const State &before, double other);
    void set_rates_of_prescribed(const BodyVectors *lift);
    void set_velocity_condition(std::size_t i, const State &before);
    double begin_spring(std::size_t i, const State &before);
    double end_spring(std::size_t i, State &state) const;
    void measure_motions(const State &state);
    void measure_velocities(const State &state);
    void measure_rates(State &state);
    void set_recomputed_gaps(const State &state);
    double stray(const State &state, std::size_t &worst);
    double agreed(double own, std::size_t &worst) const;
    double largest_stray(const State &state, std::size_t &worst);
    std::vector<double> body_terms(const BodyVectors &U) const;
    void add_body_terms(const BodyVectors &U);

    const Structure &structure;
    const Constraints &constraints;
    const TurningConstraints &turning;
    const Reference &reference;
    const StepMethod &method;
    bool is_first = false; ///< whether this is the first step of the run

    // The problem and its solution.
    MixedComplementarityProblem problem;
    MixedComplementaritySolution solved, correction;
    std::vector<double> balanced, impulses, previous_place;
    std::vector<double> of_prescribed; ///< what increments lack for velocities; empty: nothing
    const std::vector<double> none;    ///< empty

    // Gaps.
    std::vector<double> reference_gap;  ///< of fixed rows
    std::vector<double> gap_correction; ///< of sliding rows: first gap minus that from
                                        ///< displacements, as rounding would be a force
    std::vector<double> motion;         ///< B^T dU
    std::vector<double> motion_size;    ///< rounding scale of motion
    std::vector<double> position;       ///< B^T U; with U_ref for a sliding row
    std::vector<double> terms_size;     ///< sum of the sizes of the terms of position
    std::vector<double> scale_of_step;  ///< of each gap, without the minimum for rows at rest
    Sizes largest;                      ///< gaps at rest round with the largest scale so far

    // Rates, for schemes with mean forces.
    std::vector<double> velocity, velocity_size, rates_before;
    std::vector<double> convection;    ///< change of a gap in the step by the motion of its place
    std::vector<double> rate_of_place; ///< D' minus B^T V of a corrected row, or of one that turns

    // Springs.
    ConstraintLaws laws;
    std::vector<double> S, history;

    ContactResidual of_conditions;
    MixedComplementaritySolution recomputed; ///< the solution with gaps from the displacements
  };
} // namespace taut

#endif
