// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_step_control_h
#define taut_step_control_h

#include "time/longest_step.h"
#include <taut/time/step_parameters.h>

#include <vector>

namespace taut
{
  class Motion;

  /**
   * Controls the length of steps, which is Step times a power of two. Matrices are hence factored
   * only at a change of length, and times are multiples of the shortest step.
   *
   * An adaptive step with a local error above the tolerance is repeated with a shorter one, down to
   * the shortest step, which always counts. An impact, a jump of velocities, is such an error: it
   * ends up in a step in which the bodies move by the tolerance. So does a jump of a load or a
   * prescribed motion, which is searched before each step. After two steps with a tenth of the
   * tolerance the length doubles, at a multiple of the new length.
   *
   * A fixed step, too, is divided if a nonlinear body has no solution for it. So is a step that
   * does not resolve a contact of a constraint with a damper, from closing until no rebound can
   * come.
   */
  class StepControl
  {
  public:
    /// From t = 0 to @p n_steps times @p step [s]. @p may_halve: some bodies are not linear.
    /// @p longest_steps: for each constraint the longest step in a contact; empty: any.
    StepControl(const StepParameters &parameters, double step, long n_steps, bool may_halve = false,
                std::vector<LongestStep> longest_steps = {});

    bool is_finished() const { return position == end; }

    /// True at multiples of the given step.
    bool is_at_step() const { return position % (1L << n_levels) == 0; }

    /// Advances by one accepted step. After any exception it and the motion are as before.
    void advance(Motion &motion);

    long n_repeated() const { return repeated; }

    /// Stores the position, for a checkpoint.
    template <typename Archive>
    void serialize(Archive &archive, unsigned int)
    {
      archive &position &repeated &level &n_calm &last_open;
    }

  private:
    long length() const { return 1L << level; }

    void solve(Motion &motion);
    double longest_step(std::size_t i, const Motion &motion) const;
    bool is_moving_contact(std::size_t i, const Motion &motion) const;
    bool is_too_long_for_contacts(const Motion &motion) const;
    void shorten(unsigned int n_levels_down);
    void advance_fixed(Motion &motion);
    void advance_adaptive(Motion &motion);

    const StepParameters parameters;
    const std::vector<LongestStep> longest_steps;
    const unsigned int n_levels; ///< number of possible halvings of a step
    const double step, shortest; ///< [s]
    const long end;              ///< in shortest steps
    long position = 0, repeated = 0;
    unsigned int level, n_calm = 0;
    std::vector<double> last_open; ///< time when each constraint was open [s]
  };
} // namespace taut

#endif
