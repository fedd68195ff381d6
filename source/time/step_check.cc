// SPDX-License-Identifier: LGPL-2.1-or-later
#include "time/step_check.h"
#include "base/text.h"
#include <taut/base/exceptions.h>
#include <taut/time/step_parameters.h>

#include <set>
#include <string>
#include <vector>

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
      fail_contradictory(constraints.labels(e.rows()));
      throw;
    }
  }

  void StepCheck::fail_contradictory(const std::vector<Constraints::Label> &rows) const
  {
    if (rows.empty())
      return;
    // Springs across a link that turns have its name.
    std::vector<Constraints::Label> links;
    std::set<std::string> known;
    for (const Constraints::Label &row : rows)
      if (known.insert(row.name).second)
        links.push_back(row);
    const std::string names = Constraints::names(links);
    fail((links.size() == 1
              ? "no force satisfies link " + names +
                    ": its ends are held where it does not let them be. Remove it, give it"
              : "the links " + names +
                    " contradict each other, or what holds their ends: no contact forces "
                    "satisfy them all. Remove one of them, give one") +
             " a finite stiffness, or check the initial gaps",
         rows.front().origin);
  }

  void StepCheck::check_constraints(const Residuals &residuals,
                                    const std::vector<std::size_t> &partners) const
  {
    if (residuals.complementarity <= tolerance)
      return;
    fail_contradictory(constraints.labels(partners));
    const std::string missed =
        to_text("the contact tolerance: residual ", residuals.complementarity, " > ", tolerance,
                ". ", remedy(residuals.complementarity));
    for (const Constraints::Label &worst : constraints.labels({residuals.worst_constraint}))
      fail("link '" + worst.name + "' misses " + missed, worst.origin);
    fail("the step misses " + missed);
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
