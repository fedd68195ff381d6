// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_turning_constraints_h
#define taut_turning_constraints_h

#include <taut/interface/constraints.h>
#include <taut/time/state.h>
#include <taut/time/step_report.h>

#include <array>
#include <string>
#include <vector>

namespace taut
{
  /**
   * The constraints that turn with their ends, through a step from Delta_0 to Delta_1. With mean
   * forces the direction is
   *
   *     (Delta_0 + Delta_1) / (|Delta_0| + |Delta_1|),
   *
   * which times Delta_1 - Delta_0 is |Delta_1| - |Delta_0|: gaps do not drift, and the work of the
   * force is that of its gap (O. Gonzalez, J. Nonlinear Sci. 6 (1996)). With forces at the ends of
   * steps it is that of Delta_1, and D is linear about the last guess. Newton's method makes
   * the guesses. Where a constraint runs through rings, each segment has its Delta, and the gap the
   * sum of |Delta|. Indices count all constraints. All functions that take vectors of bodies are
   * called by all ranks together.
   */
  class TurningConstraints
  {
  public:
    /// The arguments are kept by reference.
    TurningConstraints(const Constraints &constraints, const Reference &reference,
                       const StepMethod &method);

    bool empty() const { return constraints.turning_rows().empty(); }

    /// After a change of the method. Throws EntryError for a scheme without gaps at the ends of
    /// steps.
    void check_method() const;

    /// Sets the directions at a state.
    void follow(const State &state);

    /// Begins a step from the state that follow() knows; the first guess is no motion.
    void begin();

    /**
     * Takes the increments of an iteration as the next guess, whose multipliers are @p N, and the
     * parts of D besides Delta and N @p history. Returns by how much that guess misses: relative
     * changes of directions, and errors of gaps over |Delta|, of constraints that carry a force or
     * should, see weights in the source. Throws UserError, with time and both places, where ends
     * meet under a force.
     */
    double set_guess(const BodyVectors &dU, const State &before, const std::vector<double> &N,
                     const std::vector<double> &history);

    /// Directions of the last guess, or at the state of follow(), for Constraints::turn().
    const std::vector<Coordinates> &directions() const { return next; }

    /// What the gap of the form B_i differs by from that of the state before, at dU = 0 [m].
    double offset(const std::size_t i) const { return offsets[constraints.turning_index(i)]; }

    /// The part of D_1 - D_0 by a change of the length, as a winch makes it [m].
    double reeled(const std::size_t i) const { return reels[constraints.turning_index(i)]; }

    /// D_1 - D_0 of the last guess, without a spring [m].
    double increment(const std::size_t i) const { return increments[constraints.turning_index(i)]; }

    /// |Delta_0| [m].
    double distance(std::size_t i) const;

    /// Work of a force N on the bodies in the step, in which B^T dU is @p motion, beyond N times
    /// the motion of the ends along the link: 0 with mean forces [J].
    double surplus(std::size_t i, double N, double motion) const;

  private:
    void face_start();
    double set_directions(std::size_t i, bool is_mean);
    void check_turn(std::size_t i, std::size_t segment, const State &before) const;

    const Constraints &constraints;
    const Reference &reference;
    const StepMethod &method;
    double time = 0.;                                             ///< of Delta_0 [s]
    std::vector<Coordinates> start;                               ///< Delta_0
    std::vector<Coordinates> used;                                ///< directions of B_i
    std::vector<Coordinates> next;                                ///< directions of the guess
    std::vector<double> offsets, next_offsets, increments, reels; ///< one a row
    std::vector<Coordinates> end;                                 ///< Delta_1 of the last guess
    std::vector<Coordinates> motion; ///< Delta_1 - Delta_0 of the last guess
  };

  /// What to say of a constraint that turns and has a force where its ends meet, at time @p t [s];
  /// @p ends are their places.
  std::string message_of_meeting(const std::string &name, double t,
                                 const std::array<Coordinates, 2> &ends);
} // namespace taut

#endif
