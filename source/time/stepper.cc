// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/text.h"
#include "interface/check_constraint.h"
#include "time/named_scheme.h"
#include <taut/base/exceptions.h>
#include <taut/time/stepper.h>

#include <boost/algorithm/string/replace.hpp>

#include <array>
#include <cmath>

namespace taut
{
  namespace
  {
    /// Checks that the system has a body and the options are possible.
    const System &checked(const System &system, const StepperOptions &options)
    {
      if (system.n_bodies() == 0)
        throw UserError("the system of a Stepper has no body; add one");
      // A step with a square out of range has no coefficients.
      const double inverse_square = 1. / (options.step * options.step);
      if (!(options.step > 0.) || !std::isfinite(inverse_square) || !(inverse_square > 0.))
        throw UserError("StepperOptions::step is " + to_text(options.step) +
                        " s; take a positive number");
      if (!(options.restitution >= 0.) || !(options.restitution <= 1.))
        throw UserError("StepperOptions::restitution is " + to_text(options.restitution) +
                        "; take a number from 0 to 1");
      if (options.scheme == "automatic" && !options.scheme_entries.empty())
        throw UserError("StepperOptions::scheme_entries has '" +
                        options.scheme_entries.begin()->first +
                        "', and the scheme 'automatic' sets its entries itself; name a scheme");
      if (options.scheme != "automatic" && options.restitution != 0.)
        throw UserError("StepperOptions::restitution is for the scheme 'automatic'; set the entry "
                        "'Moreau-Jean/Restitution' of the scheme 'Moreau-Jean'");
      if (options.scheme != "automatic")
        make_named_scheme(options.scheme, options.scheme_entries)->coefficients(options.step);
      check_solver_names(options.solver);
      return system;
    }

    /// Errors name entries of parameter files: these are the same for a program.
    constexpr std::array<std::array<const char *, 2>, 7> options_of_entries = {
        {{"'Time/Allow unsuitable scheme'", "StepperOptions::allow_unsuitable_scheme"},
         {"set 'Time/Mass redistribution'", "take bodies without mass where it acts"},
         {"Time/Mass redistribution: ", ""},
         {"Time/Scheme: ", "StepperOptions::scheme: "},
         {"Time/Step: ", "StepperOptions::step: "},
         {"Time/Moreau-Jean/", "StepperOptions::scheme_entries, Moreau-Jean/"},
         {"'Contact tolerance'", "StepperOptions::solver.contact_tolerance"}}};

    [[noreturn]] void throw_with_options(const UserError &error)
    {
      const std::string before = error.what();
      std::string message = before;
      for (const auto &[entry, option] : options_of_entries)
        boost::algorithm::replace_all(message, entry, option);
      if (message == before)
        throw;
      throw UserError(message);
    }

    void check_form(const Displacement &form, const System &system, const Structure &structure)
    {
      system.communicator().agree(
          [&]
          {
            for (const Term &term : form)
              if (term.substructure >= structure.size())
                throw UserError("a displacement acts on body number " +
                                std::to_string(term.substructure) +
                                " of this rank, and the Stepper has " +
                                std::to_string(structure.size()) + ", counted from 0");
            const std::string fault = fault_of(form, system.structure());
            if (!fault.empty())
              throw UserError("a displacement " + fault);
          });
    }
  } // namespace

  Stepper::Stepper(const Lasting<System> lasting, const StepperOptions &options)
  try : system(checked(lasting, options)), n_constraints(system.n_constraints()),
      structure(system.structure()), constraints(system.constraints(structure)),
      motion(structure, constraints, options)
  {
    motion.choose_scheme();
    motion.prepare();
  }
  catch (const UserError &error)
  {
    throw_with_options(error);
  }

  void Stepper::advance()
  {
    try
    {
      do
        motion.advance();
      while (!motion.is_at_step());
    }
    catch (const UserError &error)
    {
      throw_with_options(error);
    }
  }

  std::size_t Stepper::row(const std::size_t constraint) const
  {
    if (constraint >= n_constraints)
      throw UserError("the Stepper knows no constraint number " + std::to_string(constraint) +
                      "; the system had " + std::to_string(n_constraints) +
                      ", counted from 0, when it was made. Make a Stepper after the last one");
    return constraints.index_of_link(constraint);
  }

  double Stepper::multiplier(const std::size_t constraint) const
  {
    return state().multiplier[row(constraint)];
  }

  double Stepper::gap(const std::size_t constraint) const
  {
    return state().distance[row(constraint)];
  }

  double Stepper::displacement(const Displacement &form) const
  {
    check_form(form, system, structure);
    double value = evaluate(form, reference().displacement) + evaluate(form, state().U);
    system.communicator().sum(&value, 1);
    return value;
  }

  double Stepper::velocity(const Displacement &form) const
  {
    check_form(form, system, structure);
    double value = evaluate(form, state().V);
    system.communicator().sum(&value, 1);
    return value;
  }

  std::vector<double> Stepper::displacement(const std::size_t body) const
  {
    const std::size_t k = system.index_here(body);
    if (body >= structure.all_bodies().size())
      throw UserError("the Stepper has no body number " + std::to_string(body) +
                      "; it was added after the Stepper was made");
    return k == Structure::elsewhere ? std::vector<double>()
                                     : taut::displacement(reference(), state(), k);
  }
} // namespace taut
