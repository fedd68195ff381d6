// SPDX-License-Identifier: LGPL-2.1-or-later
#include "door_script.h"

#include <iostream>

namespace door
{
  using taut::Constraint;

  double Calls::any_number()
  {
    static const double numbers[] = {0.,     -0.,    -1.,      1.,   1e300,    -1e300,
                                     1e-300, 1e308,  1e-9,     1e9,  1e20,     -1e20,
                                     1e154,  1e-154, 4.9e-324, 3.,   -1e-12,   1e100,
                                     1e-100, .5,     2.,       -1e9, infinite, not_a_number};
    return below(2) == 0 ? numbers[below(24)]
                         : std::ldexp(between(-1., 1.), static_cast<int>(below(81)) - 40);
  }

  void Calls::refuse(const std::string &what, const std::string &name,
                     const std::function<void()> &call)
  {
    std::string message;
    try
    {
      call();
    }
    catch (const taut::UserError &e)
    {
      message = e.what();
    }
    if (message.empty())
      throw Failure(what + " is not refused");
    if (message.find(name) == std::string::npos || message.find('\n') != std::string::npos)
      throw Failure(what + ": the message does not name '" + name + "' in one line: " + message);
    if (std::getenv("TAUT_PRINT_MESSAGES"))
      std::cout << what << ": " << message << '\n';
    ++counts.refused;
  }

  void Calls::expect(const std::string &what, const double value, const double expected,
                     const double tolerance)
  {
    if (!(std::fabs(value - expected) <= tolerance))
      throw Failure(what + " is " + std::to_string(value) + ", not " + std::to_string(expected) +
                    ": off by " + std::to_string(std::fabs(value - expected) / tolerance) +
                    " tolerances");
    ++counts.checked;
  }

  void Calls::expect_true(const std::string &what, const bool value)
  {
    if (!value)
      throw Failure(what);
    ++counts.checked;
  }

  namespace
  {
    using Mistakes = std::vector<std::pair<std::string, std::function<Constraint()>>>;

    const std::string bad_link = "bad link";

    /// Numbers of a constraint that System::add() refuses.
    void make_bad_numbers(Calls &calls, taut::System &system, const std::size_t chain)
    {
      const taut::Displacement up = system.displacement(chain, {}, {0., 1., 0.});
      const taut::LinkEnd end = system.link_end(chain, {}, {0., 0., 0.}), above{{0., 1., 0.}};
      const auto law = std::make_shared<taut::TableLaw>(
          std::vector<std::pair<double, double>>{{.1, 10.}, {.2, 40.}});
      const double bad = calls.bad_number(), negative = -calls.between(1e-9, 1e9);
      const auto good = [&] { return Constraint::unilateral(bad_link, up); };
      const Mistakes list = {
          {"negative stiffness", [&] { return good().stiffness(negative); }},
          {"zero stiffness", [&] { return good().stiffness(0.); }},
          {"stiffness NaN", [&] { return good().stiffness(not_a_number); }},
          {"gap", [&] { return good().gap(bad); }},
          {"damping", [&] { return good().stiffness(1e3).damping(bad); }},
          {"negative damping", [&] { return good().stiffness(1e3).damping(negative); }},
          {"damping of a rigid one", [&] { return good().damping(1.); }},
          {"no law", [&] { return good().law(nullptr); }},
          {"law and stiffness", [&] { return good().law(law).stiffness(7.); }},
          {"law of a bilateral one", [&] { return Constraint::bilateral(bad_link, up).law(law); }},
          {"length", [&] { return Constraint::rope(bad_link, above, end, negative); }},
          {"length NaN", [&] { return Constraint::prop(bad_link, above, end, not_a_number); }},
          {"infinite length", [&] { return Constraint::rod(bad_link, above, end, infinite); }},
          {"ends at one place", [&] { return Constraint::rod(bad_link, {{}}, end, 1.); }},
          {"place of an end",
           [&] {
             return Constraint::rod(bad_link, {{0., bad, 0.}}, end, 1.);
           }},
          {"gap of a rope", [&] { return Constraint::rope(bad_link, above, end, 1.).gap(.1); }}};
      const auto &[what, make] = list[calls.below(list.size())];
      calls.refuse(what, bad_link, [&] { system.add(make()); });
    }

    /// Forms of a constraint that System::add() refuses.
    void make_bad_form(Calls &calls, taut::System &system, const std::size_t chain)
    {
      taut::Displacement form = system.displacement(chain, {}, {0., 1., 0.});
      taut::LinkEnd end = system.link_end(chain, {}, {0., 0., 0.});
      const taut::LinkEnd above{{0., 1., 0.}}, below{{0., -1., 0.}};
      const std::size_t foreign = 1000 + calls.below(1000000);
      const std::string &name = bad_link;
      taut::System other;
      const std::size_t body =
          other.add("other", [] { return std::make_unique<Bob>("other", 1.); });
      const taut::Displacement of_other = other.displacement(body, {}, {0., 1., 0.});
      taut::Displacement foreign_body = form, foreign_dof = form, ragged = form, value = form;
      foreign_body[0].substructure = foreign;
      foreign_dof[0].form.index[0] = static_cast<unsigned int>(foreign);
      ragged[0].form.value.clear();
      value[0].form.value[0] = calls.bad_number();
      end.motion[1][0].substructure = foreign;
      const Mistakes list = {
          {"no place", [&] { return Constraint::unilateral(name, nullptr); }},
          {"empty", [&] { return Constraint::bilateral(name, {}); }},
          {"empty form",
           [&] {
             return Constraint::bilateral(name, {{0, {}}});
           }},
          {"foreign body", [&] { return Constraint::unilateral(name, foreign_body); }},
          {"foreign DoF", [&] { return Constraint::unilateral(name, {}, foreign_dof); }},
          {"ragged form", [&] { return Constraint::unilateral(name, ragged); }},
          {"value", [&] { return Constraint::bilateral(name, value); }},
          {"both ends stand", [&] { return Constraint::rope(name, above, below, 1.); }},
          {"foreign end", [&] { return Constraint::rope(name, above, end, 1.); }},
          {"form on another system", [&] { return Constraint::unilateral(name, of_other); }}};
      const auto &[what, make] = list[calls.below(list.size())];
      calls.refuse(what, name, [&] { system.add(make()); });
    }

    void make_bad_body(Calls &calls, taut::System &system)
    {
      const auto defect = static_cast<Defect>(1 + calls.below(first_of_places - 1));
      const auto make = [&] { return chain_of("bad body", {1., 2.}, {1e3, 1e3}, defect); };
      const std::string what = "defect " + std::to_string(static_cast<int>(defect));
      switch (calls.below(6))
      {
      case 0:
        return calls.refuse("nullptr", "bad body",
                            [&] { system.add("bad body", [] { return nullptr; }); });
      case 1:
        return calls.refuse("no factory", "bad body",
                            [&] { system.add("bad body", taut::Structure::Factory()); });
      case 2:
        return calls.refuse("owner", "bad body",
                            [&] { system.add("bad body", 1 + calls.below(1000), make); });
      default:
        return calls.refuse(what, defect == Defect::prescribes_twice ? "" : "bad body",
                            [&] { system.add("bad body", make); });
      }
    }

    /// A body whose mistake shows later, in a system of its own.
    void ask_bad_body(Calls &calls)
    {
      const auto defect =
          static_cast<Defect>(first_of_places + calls.below(n_defects - first_of_places));
      const std::string what = "defect " + std::to_string(static_cast<int>(defect));
      taut::System system;
      const std::size_t body =
          system.add("late body",
                     [&] {
                       return chain_of("late body", {1., 2.}, {1e3, 1e3}, defect);
                     });
      if (static_cast<int>(defect) < first_of_starts)
        return calls.refuse(what, "late body",
                            [&] {
                              system.displacement(body, {}, {0., 1., 0.});
                            });
      taut::StepperOptions options;
      options.start = taut::Start::given;
      calls.refuse(what, "late body", [&] { taut::Stepper(system, options).advance(); });
    }
  } // namespace

  void make_mistake(Calls &calls, taut::System &system, const std::size_t chain)
  {
    const std::size_t n_bodies = system.n_bodies(), n_constraints = system.n_constraints(),
                      foreign = n_bodies + calls.below(100000);
    const taut::Coordinates up = {0., 1., 0.};
    const std::string number = "number " + std::to_string(foreign);
    const double bad = calls.bad_number();
    const std::function<void()> mistakes[] = {
        [&]
        { calls.refuse("displacement", number, [&] { system.displacement(foreign, {}, up); }); },
        [&] { calls.refuse("link_end", number, [&] { system.link_end(foreign, {}); }); },
        [&] { calls.refuse("body", number, [&] { system.body(foreign); }); },
        [&] {
          calls.refuse("place", "finite", [&] { system.displacement(chain, {bad, 0., 0.}, up); });
        },
        [&] {
          calls.refuse("direction", "finite",
                       [&] {
                         system.displacement(chain, {}, {0., bad, 0.});
                       });
        },
        [&] { make_bad_body(calls, system); },
        [&] { ask_bad_body(calls); },
        [&] { make_bad_form(calls, system, chain); },
        [&] { make_bad_form(calls, system, chain); }};
    const std::size_t kind = calls.below(12);
    if (kind < std::size(mistakes))
      mistakes[kind]();
    else
      make_bad_numbers(calls, system, chain);
    if (system.n_bodies() != n_bodies || system.n_constraints() != n_constraints)
      throw Failure("a call that was refused left a trace");
  }

  namespace
  {
    /// Of the scheme, with a part of the message.
    std::string spoil_scheme(Calls &calls, taut::StepperOptions &options)
    {
      static const std::pair<std::string, std::string> entries[] = {
          {"Moreau-Jean/Thta", "0.5"},
          {"Moreau-Jean/Theta", "0.2"},
          {"Moreau-Jean/Theta", "nan"},
          {"Moreau-Jean/Theta", "much"},
          {"Theta", "0.5"},
          {"", ""},
          {"/", "1"},
          {"Newmark/Beta", "0.25"},
          {"Moreau-Jean/Conditions", "x"},
          {"Moreau-Jean/Restitution", "2"}};
      const auto &[path, value] = entries[calls.below(sizeof(entries) / sizeof(entries[0]))];
      switch (calls.below(4))
      {
      case 0:
        options.scheme = "Moreau-Jaen";
        return "did you mean 'Moreau-Jean'";
      case 1:
        options.scheme_entries["Newmark/Beta"] = "0.25";
        return "Newmark/Beta";
      case 2:
        options.scheme = "Newmark";
        options.restitution = .5;
        return "StepperOptions::restitution";
      default:
        options.scheme = "Moreau-Jean";
        options.scheme_entries[path] = value;
        return "'" + path + "'";
      }
    }

    std::string spoil_solver(Calls &calls, taut::SolverParameters &solver)
    {
      std::string *const names[] = {&solver.local_solver, &solver.complementarity,
                                    &solver.interface.form, &solver.interface.preconditioner,
                                    &solver.interface.coarse_space};
      const std::size_t k = calls.below(6);
      if (k == 5)
      {
        solver.contact_tolerance = calls.below(2) == 0 ? calls.bad_number() : -1.;
        return "Contact tolerance";
      }
      *names[k] = "best";
      return "'best'";
    }
  } // namespace

  void make_mistake_with_options(Calls &calls, const taut::System &system)
  {
    static const double steps[] = {0.,       -1.,       -1e-3,  not_a_number,
                                   infinite, -infinite, 1e-320, 1e200},
                        ratios[] = {-1e-9, 1.1, not_a_number, infinite, -1.};
    taut::StepperOptions options;
    std::string name;
    switch (calls.below(4))
    {
    case 0:
      options.step = steps[calls.below(8)];
      name = "StepperOptions::step";
      break;
    case 1:
      options.restitution = ratios[calls.below(5)];
      name = "StepperOptions::restitution";
      break;
    case 2:
      name = spoil_scheme(calls, options);
      break;
    default:
      name = spoil_solver(calls, options.solver);
    }
    calls.refuse("options", name, [&] { taut::Stepper(system, options); });
  }

  void make_mistake_with_stepper(Calls &calls, taut::System &system, taut::Stepper &stepper)
  {
    const std::size_t n = system.n_constraints(), foreign = n + calls.below(100);
    taut::LinearForm one;
    one.add(0, 1.);
    switch (calls.below(6))
    {
    case 0:
      return calls.refuse("multiplier", "number " + std::to_string(foreign),
                          [&] { stepper.multiplier(foreign); });
    case 1:
      return calls.refuse("gap", "number " + std::to_string(foreign),
                          [&] { stepper.gap(foreign); });
    case 2:
      return calls.refuse("displacement of a body", "number",
                          [&] { stepper.displacement(system.n_bodies() + calls.below(10)); });
    case 3:
      return calls.refuse(
          "form on a foreign body", "body number",
          [&] {
            stepper.displacement(taut::Displacement{{system.n_bodies() + 1000, one}});
          });
    case 4:
      one.index[0] = 77777;
      return calls.refuse("velocity of a foreign DoF", "DoF 77777",
                          [&] {
                            stepper.velocity(taut::Displacement{{0, one}});
                          });
    default:
      one.index.clear();
      return calls.refuse("ragged form", "indices",
                          [&] {
                            stepper.displacement(taut::Displacement{{0, one}});
                          });
    }
  }
} // namespace door
