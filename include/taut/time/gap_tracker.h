// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_gap_tracker_h
#define taut_gap_tracker_h

#include <taut/time/state.h>
#include <taut/time/step_equations.h>
#include <taut/time/turning_constraints.h>

#include <cstddef>
#include <vector>

namespace taut
{
  /**
   * Geometric gaps of the constraints through the steps, and their rounding scales.
   *
   * A gap of a fixed constraint is summed from increments: a gap rounds at eps times its size, and
   * F^-1 = O(1/step^2) turns this into noise of the force. A gap of a moving constraint comes from
   * the displacements at its place. Functions with vectors of bodies are called by all ranks
   * together. Units are m, or rad for rotational constraints.
   */
  class GapTracker
  {
  public:
    /// All but @p start are kept by reference; @p constraints are at their initial places.
    GapTracker(const Structure &structure, const Constraints &constraints,
               const TurningConstraints &turning, const Reference &reference, const State &start);

    /// Gaps from now on round with all motions @p U that brought the bodies here, whatever their
    /// directions.
    void count_motions(const BodyVectors &U);

    /// Begins a step: motion of the constraints without multipliers, under P^ = @p P and the
    /// prescribed motion @p lift (null: none), and the places of moving constraints.
    void predict(const State &before, const StepEquations &system, const BodyVectors &P,
                 const BodyVectors *lift);

    /// Gap at the end of the step without the motion of the constraint, after predict().
    double free_gap(std::size_t i, const State &before) const;

    /// B^T dU of the step, after predict() without multipliers, after measure() with multipliers.
    const std::vector<double> &increments() const { return motion; }

    /// Scale of the rounding of a gap in this step. @p other is the size of its terms that are not
    /// motions of the bodies.
    double set_scale(std::size_t i, const State &before, double other);

    /// The last result of set_scale(), without the minimum for constraints at rest.
    double scale(const std::size_t i) const { return scale_of_step[i]; }

    /// Sizes of the terms of B^T U at the end of the step.
    const std::vector<double> &term_sizes() const { return terms_size; }

    /// After the step: computes B^T dU and B^T U of the new state.
    void measure(const State &state);

    /// After measure(): gap at the end of the step.
    double new_gap(std::size_t i, const State &state);

    /// Adds a correction @p dU of the bodies to the gaps of @p state.
    void correct(const BodyVectors &dU, State &state);

    /// Largest difference between a tracked gap and the gap from displacements, over the terms of
    /// the gap, and its constraint.
    double largest_stray(const State &state, std::size_t &worst);

    /// The data that persist between steps beside the state: largest sizes of gaps and their terms.
    struct Sizes
    {
      std::vector<double> scale, terms;
    };
    void copy_sizes(Sizes &to) const
    {
      to.scale = largest_scale;
      to.terms = gap_terms;
    }
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

  private:
    double gap_of_place(std::size_t i) const;
    double stray(const State &state, std::size_t &worst);
    std::vector<double> body_terms(const BodyVectors &U) const;
    void add_body_terms(const BodyVectors &U);

    const Structure &structure;
    const Constraints &constraints;
    const TurningConstraints &turning;
    const Reference &reference;
    std::vector<double> reference_gap;  ///< of fixed constraints
    std::vector<double> gap_correction; ///< of moving constraints: first gap minus that from
                                        ///< displacements, as rounding would be a force
    std::vector<double> motion;         ///< B^T dU
    std::vector<double> motion_size;    ///< rounding scale of motion
    std::vector<double> position;       ///< B^T U; with U_ref for a moving constraint
    std::vector<double> terms_size;     ///< sum of the sizes of the terms of position
    std::vector<double> scale_of_step;  ///< of each gap, with the last guess
    std::vector<double> largest_scale;  ///< largest scale so far: gaps at rest round with it
    std::vector<double> gap_terms;      ///< largest terms of the gaps of fixed constraints
  };
} // namespace taut

#endif
