// SPDX-License-Identifier: LGPL-2.1-or-later
#include "time/step_check.h"
#include "base/text.h"
#include <taut/base/exceptions.h>
#include <taut/time/step_parameters.h>

namespace taut
{
  std::string StepCheck::when() const
  {
    if (!time)
      return "static equilibrium: ";
    return to_text("at t = ", *time, " s: ");
  }

  std::string StepCheck::remedy(const double residual) const
  {
    if (const double usual = SolverParameters().contact_tolerance; residual <= usual)
      return to_text("Rounding may leave as much: take the default 'Contact tolerance', ", usual);
    return std::string(time ? "Take a smaller step, or check" : "Check") +
           " stiffness and mass for extreme ratios";
  }

  void StepCheck::fail(const std::string &what, const std::string &entry) const
  {
    throw EntryError(entry, when() + what + ".");
  }

  void StepCheck::named(const std::function<void()> &work) const
  {
    try
    {
      work();
    }
    catch (const NotSolved &e)
    {
      fail(e.what());
    }
    catch (const ContradictoryRows &e)
    {
      structure.communicator().agree([&] { fail_contradictory(constraints.here(e.rows())); });
      throw;
    }
  }

  void StepCheck::fail_contradictory(const std::vector<std::size_t> &rows) const
  {
    if (rows.empty())
      return;
    const bool is_one = rows.size() == 1;
    fail((is_one ? "no force satisfies link " + constraints.names(rows) +
                       ": its ends are held where it does not let them be. Remove it, give it"
                 : "the links " + constraints.names(rows) +
                       " contradict each other, or what holds their ends: no contact forces "
                       "satisfy them all. Remove one of them, give one") +
             " a finite stiffness, or check the initial gaps",
         constraints.origin(rows.front()));
  }

  void StepCheck::check_constraints(const Residuals &residuals,
                                    const std::vector<std::size_t> &partners) const
  {
    if (residuals.complementarity <= tolerance)
      return;
    const std::size_t worst = residuals.worst_constraint;
    structure.communicator().agree(
        [&]
        {
          fail_contradictory(partners);
          if (worst < constraints.size())
            fail(to_text("link '", constraints[worst].name,
                         "' misses the contact tolerance: residual ", residuals.complementarity,
                         " > ", tolerance, ". ", remedy(residuals.complementarity)),
                 constraints.origin(worst));
        });
    fail(to_text("the contact tolerance is missed: residual ", residuals.complementarity, " > ",
                 tolerance, ". ", remedy(residuals.complementarity)));
  }

  void StepCheck::check_balance(const Residuals &residuals, const double own_balance) const
  {
    if (residuals.balance <= tolerance)
      return;
    structure.communicator().agree(
        [&]
        {
          if (own_balance < residuals.balance || structure.size() == 0)
            return;
          const Substructure &body = structure[residuals.worst_body];
          fail(to_text("body '", body.name(), "' misses the contact tolerance in its equation of ",
                       time ? "motion" : "equilibrium", ": residual ", residuals.balance, " > ",
                       tolerance, ". ", remedy(residuals.balance)),
               body.origin());
        });
  }
} // namespace taut
