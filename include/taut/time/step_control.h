// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_step_control_h
#define taut_step_control_h

#include <taut/time/time_stepper.h>

#include <cmath>
#include <string>

namespace dealii
{
  class ParameterHandler;
}

namespace taut
{
  /// How long steps are.
  struct StepParameters
  {
    std::string control = "fixed";                ///< or "adaptive"
    double tolerance = 1e-4;                      ///< of TimeStepper::local_error() [1]
    unsigned int n_halvings = 6, n_doublings = 4; ///< bounds of the step, from Step

    /// Declares the members in the current subsection.
    void declare_parameters(dealii::ParameterHandler &prm);
    bool adaptive() const { return control == "adaptive"; }

    /// The shortest step that a Step [s] becomes [s].
    double shortest(double step) const
    {
      return adaptive() ? std::ldexp(step, -static_cast<int>(n_halvings)) : step;
    }
  };

  /**
   * Steps of a length times a power of two, so that matrices are factored anew only at a change and
   * times are multiples of the shortest step. A step is repeated at half its length if its local
   * error is above the tolerance, down to the shortest one, which counts as it is; the error is not
   * known, and the length stays, in a step where a rigid unilateral constraint opens or closes and
   * in the next one, whose accelerations are jumps. After four steps with a tenth of the tolerance
   * the length doubles, at a multiple of the new one.
   */
  class StepControl
  {
  public:
    /// From t = 0 to @p n_steps times @p step [s]. @p may_halve: fixed steps, too, are made in
    /// parts where bodies that are not linear have no answer to the whole.
    StepControl(const StepParameters &parameters, double step, long n_steps,
                bool may_halve = false);

    bool is_finished() const { return position == end; }

    /// True at multiples of the step that was given.
    bool is_at_step() const { return position % (1L << n_levels) == 0; }

    /// One step that counts.
    void advance(TimeStepper &stepper);

    long n_repeated() const { return repeated; }

    /// Where it is, for a checkpoint.
    template <typename Archive>
    void serialize(Archive &archive, unsigned int)
    {
      archive &position &repeated &level &n_calm &had_changed;
    }

  private:
    long length() const { return 1L << level; }

    void solve(TimeStepper &stepper);

    const StepParameters parameters;
    const unsigned int n_levels; ///< how often a step may be halved
    const double shortest;       ///< [s]
    const long end;              ///< in shortest steps
    long position = 0, repeated = 0;
    unsigned int level, n_calm = 0;
    State before;             ///< the step
    bool had_changed = false; ///< a rigid constraint in the last step: its accelerations are a jump
  };
} // namespace taut

#endif
