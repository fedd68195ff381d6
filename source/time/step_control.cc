// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/time/step_control.h>

#include <deal.II/base/parameter_handler.h>

#include <algorithm>
#include <limits>

namespace taut
{
  namespace
  {
    /// How often a step is halved that Newton's method does not converge in.
    constexpr unsigned int most_halvings = 8;
  } // namespace

  void StepParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.add_parameter("Step control", control,
                      "'fixed': all steps have the length Step. 'adaptive': Step times powers of "
                      "two, by the local error",
                      Selection("fixed|adaptive"));
    prm.enter_subsection("Adaptive step");
    prm.add_parameter("Tolerance", tolerance,
                      "Largest local error of a step over the largest displacement so far [1]",
                      Double(1e-14, 1.));
    prm.add_parameter("Halvings", n_halvings,
                      "The shortest step is Step over two to this power [1]", Integer(0, 20));
    prm.add_parameter("Doublings", n_doublings,
                      "The longest step is Step times two to this power [1]", Integer(0, 20));
    prm.leave_subsection();
  }

  StepControl::StepControl(const StepParameters &parameters, const double step, const long n_steps,
                           const bool may_halve)
      : parameters(parameters), n_levels(parameters.adaptive() ? parameters.n_halvings
                                         : may_halve           ? most_halvings
                                                               : 0),
        shortest(std::ldexp(step, -static_cast<int>(n_levels))),
        end(std::min(n_steps, std::numeric_limits<long>::max() >> n_levels) << n_levels),
        level(n_levels)
  {
  }

  /// The step of the present length, or a shorter one if it has no answer.
  void StepControl::solve(TimeStepper &stepper)
  {
    for (;;)
    {
      stepper.set_step(shortest * length());
      try
      {
        stepper.advance();
        return;
      }
      catch (const StepNotSolved &)
      {
        if (level == 0)
          throw;
      }
      stepper.restore(before);
      --level;
      ++repeated;
      n_calm = 0;
    }
  }

  void StepControl::advance(TimeStepper &stepper)
  {
    if (!parameters.adaptive())
    {
      if (n_levels == 0)
        stepper.advance();
      else
      {
        before = stepper.state();
        solve(stepper);
      }
      position += length();
      while (level < n_levels && position % (2 * length()) == 0)
        ++level;
      return;
    }
    before = stepper.state();
    const bool is_first = position == 0;
    while (position + length() > end)
      --level;
    double error;
    bool has_changed;
    for (;;)
    {
      solve(stepper);
      error = stepper.local_error() / parameters.tolerance;
      has_changed = stepper.rigid_constraint_changed(before);
      if (level == 0 || has_changed || had_changed || !(error > 1.))
        break;
      stepper.restore(before);
      --level;
      ++repeated;
      n_calm = 0;
    }
    position += length();
    n_calm = error < .1 && !is_first && !has_changed && !had_changed ? n_calm + 1 : 0;
    had_changed = has_changed;
    if (n_calm >= 4 && level < parameters.n_halvings + parameters.n_doublings &&
        position % (2 * length()) == 0)
    {
      ++level;
      n_calm = 0;
    }
  }
} // namespace taut
