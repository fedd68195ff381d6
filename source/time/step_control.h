// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_step_control_h
#define taut_step_control_h

#include "time/longest_step.h"
#include "time/matrix_norms.h"
#include <taut/interface/connected_bodies.h>
#include <taut/time/state.h>
#include <taut/time/step_parameters.h>
#include <taut/time/step_report.h>

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
    /// @p longest_steps: for each constraint of this rank the longest step in a contact; empty:
    /// any. @p constraints is kept by reference. Called by all ranks together, as advance() is.
    StepControl(const Constraints &constraints, const StepParameters &parameters, double step,
                long n_steps, bool may_halve, std::vector<LongestStep> longest_steps);

    bool is_finished() const { return position == end; }

    /// True at multiples of the given step.
    bool is_at_step() const { return position % (1L << n_levels) == 0; }

    /// Of the given step.
    long n_steps() const { return end >> n_levels; }

    /// Advances by one accepted step. After any exception it and the motion are as before.
    void advance(Motion &motion);

    long n_repeated() const { return repeated; }

    /// The time when each constraint was open, stored with the position [s].
    std::vector<double> &times_of_opening() { return last_open; }

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
    bool is_in_short_contact(const Motion &motion) const;
    void shorten(unsigned int n_levels_down);
    void advance_fixed(Motion &motion);
    void advance_adaptive(Motion &motion);

    const Constraints &constraints;
    const StepParameters parameters;
    const std::vector<LongestStep> longest_steps;
    const bool some_longest_steps; ///< of any rank
    const unsigned int n_levels;   ///< number of possible halvings of a step
    const double step, shortest;   ///< [s]
    const long end;                ///< in shortest steps
    long position = 0, repeated = 0;
    unsigned int level, n_calm = 0;
    std::vector<double> last_open; ///< time when each constraint was open [s]
  };

  /**
   * Largest local error of a step over the largest displacement so far. The third derivative comes
   * from the accelerations before and after the step: dU - step V0 - step^2 (A0/3 + A/6) (O. C.
   * Zienkiewicz, Y. M. Xie, Earthquake Engineering and Structural Dynamics 20 (1991)).
   *
   * Schemes with mean forces have mean accelerations and dU = step V0 + step^2 A/2. Their error is
   * step^3/12 of that derivative, step^2 (A - A0) / (6 (1 + last step / step)). Further changes dV
   * of velocities by impulses count as step dV. A body of elements, cut or not, has the root mean
   * square error by mass, sqrt(e . M e / m). Masses and rigid bodies have the largest error, for
   * displacements and slopes separately.
   */
  class LocalError
  {
  public:
    /// The arguments are kept by reference.
    LocalError(const Structure &structure, const Constraints &constraints,
               const Reference &reference);

    /// Local error of a step to @p state, after a step of @p step_before [s] with final
    /// accelerations
    /// @p old_A. Called by all ranks together.
    double measure(const State &state, const StepMethod &method, double step_before,
                   const BodyVectors &old_A);

    /// Largest displacements so far, which persist between steps [m, rad].
    ByKind largest_motions = {0., 0.};

  private:
    struct OfStep
    {
      const State &state;
      const StepMethod &method;
      double step_before;
      const BodyVectors &old_A;
    };
    void set_error(const OfStep &step, std::size_t k);
    ByKind largest_of(std::size_t k, std::vector<double> &x) const;
    double square(std::size_t k, const std::vector<double> &x);

    const Structure &structure;
    const Reference &reference;
    const ConnectedBodies wholes;      ///< groups of parts of one body
    std::vector<double> mass_of_whole; ///< mass of the elements of each group [kg]
    std::vector<double> motion, impulse, product;
  };
} // namespace taut

#endif
