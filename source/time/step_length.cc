// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/base/text.h>
#include <taut/time/contact_resolution.h>
#include <taut/time/time_stepper.h>

namespace taut
{
  /// Reports a nonlinear step without solution, so that a shorter step can replace it.
  void TimeStepper::attempt(const std::function<void()> &work)
  {
    try
    {
      work();
    }
    catch (const UserError &why)
    {
      if (!is_linear())
        throw StepNotSolved(why);
      throw;
    }
  }

  void TimeStepper::check_moving_contacts()
  {
    if (coefficients.mean_force || !coefficients.rings())
      return;
    const std::vector<double> &S = step.conditions().springs().compliance();
    ComplementarityOperator &F = step.equations().interface().matrix();
    for (const std::size_t i : constraints.sliding_rows())
      if (constraints[i].cone.may_open() && S[i] > 0. && F.diagonal(i) > 2. * S[i] &&
          WholeBodies(constraints).flexibilities({i}, F)[i] > 2. * S[i])
      {
        throw EntryError(
            constraints.origin(i),
            to_text("link '", constraints[i].name, "' acts as rigid at t = ", current.time,
                    " s: there it is stiffer than the bodies in one step, which ", clock.scheme(),
                    " does not suit. Take 'Moreau-Jean', or a smaller step"));
      }
  }
} // namespace taut
