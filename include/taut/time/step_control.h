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
    std::string control = "fixed";                 ///< or "adaptive"
    double tolerance = 1e-4;                       ///< of TimeStepper::local_error() [1]
    unsigned int n_halvings = 10, n_doublings = 4; ///< bounds of the step, from Step
    double largest = 0.;                           ///< longest step; 0: by the doublings [s]

    /// Declares the members in the current subsection.
    void declare_parameters(dealii::ParameterHandler &prm);
    bool adaptive() const { return control == "adaptive"; }

    /// How often a Step [s] may be doubled.
    unsigned int most_doublings(double step) const;

    /// The longest step that a Step [s] becomes [s].
    double longest(double step) const
    {
      return adaptive() ? std::ldexp(step, static_cast<int>(most_doublings(step))) : step;
    }
  };

  /**
   * Steps of a length times a power of two, so that matrices are factored anew only at a change and
   * times are multiples of the shortest step. An adaptive step is repeated with a shorter one if
   * its local error is above the tolerance, down to the shortest one, which counts as it is. An
   * impact is such an error, as it is a jump of the velocities: it ends up in a step in which the
   * bodies move by the tolerance. So does a jump of a load or of a given motion, which is looked
   * for inside of each step beforehand. After two steps with a tenth of the tolerance the length
   * doubles, at a multiple of the new one.
   *
   * Fixed steps, too, are made in parts where a body that is not linear has no answer to the whole,
   * and while a constraint with a damper is closed whose contacts they do not resolve.
   */
  class StepControl
  {
  public:
    /// From t = 0 to @p n_steps times @p step [s]. @p may_halve: bodies are not linear. @p
    /// longest_steps: of each constraint the longest step while it is closed [s]; empty: any.
    StepControl(const StepParameters &parameters, double step, long n_steps, bool may_halve = false,
                std::vector<double> longest_steps = {});

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
      archive &position &repeated &level &n_calm;
    }

  private:
    long length() const { return 1L << level; }

    void solve(TimeStepper &stepper);
    bool is_moving_contact(std::size_t i, const State &state) const;
    bool is_too_long_for_contacts(const State &state) const;
    void take_back(TimeStepper &stepper, unsigned int n_levels_down);
    void advance_fixed(TimeStepper &stepper);
    void advance_adaptive(TimeStepper &stepper);

    const StepParameters parameters;
    const std::vector<double> longest_steps;
    const unsigned int n_levels; ///< how often a step may be halved
    const double step, shortest; ///< [s]
    const long end;              ///< in shortest steps
    long position = 0, repeated = 0;
    unsigned int level, n_calm = 0;
    State before; ///< the step
  };
} // namespace taut

#endif
