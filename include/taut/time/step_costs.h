// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_step_costs_h
#define taut_step_costs_h

#include <array>
#include <chrono>
#include <cstddef>
#include <iosfwd>

namespace taut
{
  /// Parts of a step whose time is measured. A part has the calls since the part before.
  enum class StepPart
  {
    places,      ///< of constraints that slide or turn
    factors,     ///< of bodies, with tangents and the interface operator F
    moving_rows, ///< of F
    loads,       ///< and history of the bodies
    free_gaps,   ///< gaps without multipliers
    contacts,    ///< the complementarity problem
    bodies,      ///< solve of the bodies with the multipliers
    nonlinear,   ///< forces of bodies of large motions
    state,       ///< and balance at the end of the step
    residuals,
    projection, ///< of velocities
    energy,
    measures, ///< of the contacts
    control,  ///< of the length of the step, and states to return to
    output    ///< probes, tables, statistics, fields, checkpoints
  };

  constexpr std::size_t n_step_parts = static_cast<std::size_t>(StepPart::output) + 1;

  /// Name of a part in tables and the log.
  const char *name_of(StepPart part);

  /**
   * Wall times of the parts of steps on this rank. Use it to see where the time of a run goes:
   *
   *     costs.begin_step();
   *     ...                              // a part of the step
   *     costs.lap(StepPart::contacts);   // ends here
   *     costs.end_step();                // output follows until the next begin_step()
   *
   * A step has some 12 parts, and a clock takes some 30 ns. Nothing is measured between end_step()
   * and begin_step(), and in programs that call neither.
   */
  class StepCosts
  {
  public:
    /// Sums over the steps so far.
    struct Sums
    {
      long n_steps = 0;
      double stepping = 0.;                        ///< time of all steps without output [s]
      std::array<double, n_step_parts> parts = {}; ///< [s]
      long n_newton = 0;                           ///< solves of Newton's method
    };

    void begin_step();
    void end_step();

    /// Ends a part of the step.
    void lap(const StepPart part)
    {
      if (is_in_step)
        add(part);
    }

    void count_newton() { ++all.n_newton; }

    const Sums &sums() const { return all; }

    /// Mean time of a part in a step of @p sums [s]; 0 without steps.
    static double mean(const Sums &sums, StepPart part);

    /// Writes a line for each part that took time: its mean time in a step [us], and its share [%].
    static void print(const Sums &sums, std::ostream &log);

  private:
    using Clock = std::chrono::steady_clock;

    static double seconds(const Clock::time_point from, const Clock::time_point to)
    {
      return std::chrono::duration<double>(to - from).count();
    }

    void add(StepPart part);

    Sums all;
    Clock::time_point begun, before, ended;
    bool is_in_step = false;
  };
} // namespace taut

#endif
