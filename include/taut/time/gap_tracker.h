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
   * Geometric gaps of the constraints through the steps, and what they round with.
   *
   * Gaps of fixed constraints are carried as increments: a gap rounds at eps times its size, and
   * F^-1 = O(1/step^2) makes force noise of that. Gaps of moving constraints are those of the
   * displacements at their places. All functions that take vectors of bodies are called by all
   * ranks together; units are m, or rad of rotational constraints.
   */
  class GapTracker
  {
  public:
    /// The arguments but @p start are kept by reference; @p constraints are where they are at the
    /// start.
    GapTracker(const Structure &structure, const Constraints &constraints,
               const TurningConstraints &turning, const Reference &reference, const State &start);

    /// Begins a step: how the constraints would move without multipliers, under P^ = @p P and the
    /// given motions @p lift, and where the moving ones are.
    void predict(const State &before, const StepEquations &system, const BodyVectors &P,
                 const BodyVectors &lift);

    /// The gap of a constraint at the end of the step without its motion, after predict().
    double free_gap(std::size_t i, const State &before) const;

    /// B^T dU of the step: without multipliers after predict(), with them after measure().
    const std::vector<double> &increments() const { return motion; }

    /// What the gap of a step rounds with, whose terms besides those of the bodies have the size
    /// @p other.
    double set_scale(std::size_t i, const State &before, double other);

    /// The scale that set_scale() found last, without the least scale of constraints at rest.
    double scale(const std::size_t i) const { return scale_of_step[i]; }

    /// Sizes of the terms of B^T U at the end of the step.
    const std::vector<double> &term_sizes() const { return terms_size; }

    /// After the step: B^T dU and B^T U of the new state.
    void measure(const State &state);

    /// Then: the gap of a constraint at the end of the step.
    double new_gap(std::size_t i, const State &state);

    /// A correction of the bodies by @p dU moves the gaps of @p state.
    void correct(const BodyVectors &dU, State &state);

    /// Largest distance of a carried gap from that of the displacements, over the terms of the gap,
    /// and its constraint.
    double largest_stray(const State &state, std::size_t &worst);

    /// What is kept from step to step beside the state: sizes of gaps and of their terms so far.
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

  private:
    double gap_of_place(std::size_t i) const;
    double stray(const State &state, std::size_t &worst);
    void add_body_terms(const BodyVectors &U);

    const Structure &structure;
    const Constraints &constraints;
    const TurningConstraints &turning;
    const Reference &reference;
    bool supports_move = false;         ///< of a body of this rank
    std::vector<double> reference_gap;  ///< of the fixed constraints
    std::vector<double> gap_correction; ///< of the moving ones: gap of the start minus the one of
                                        ///< its displacements, as rounding would be a force
    std::vector<double> motion;         ///< B^T dU
    std::vector<double> motion_size;    ///< what it rounds with
    std::vector<double> position;       ///< B^T U, with the reference's of a moving constraint
    std::vector<double> terms_size;     ///< sum of the sizes of the terms of it
    std::vector<double> scale_of_step;  ///< of each gap, as the last guess has it
    std::vector<double> largest_scale;  ///< so far: what came to rest rounds with it
    std::vector<double> gap_terms;      ///< largest terms of the gaps of the fixed constraints
  };
} // namespace taut

#endif
