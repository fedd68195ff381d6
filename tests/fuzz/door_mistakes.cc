// SPDX-License-Identifier: LGPL-2.1-or-later
#include "door_script.h"

#include <cmath>
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
    /// What System::add() refuses, of a constraint on mass 0 of a chain.
    void make_bad_constraint(Calls &calls, taut::System &system, const std::size_t chain)
    {
      const taut::Displacement up = system.displacement(chain, {}, {0., 1., 0.});
      const auto law = std::make_shared<taut::TableLaw>(
          std::vector<std::pair<double, double>>{{.1, 10.}, {.2, 40.}});
      const std::string name = "bad link";
      const auto good = [&] { return Constraint::unilateral(name, up); };
      taut::Displacement spoilt = up;
      taut::LinkEnd end = system.link_end(chain, {}, {0., 0., 0.});
      const double bad = calls.bad_number(), negative = -calls.between(1e-9, 1e9);
      const std::vector<std::pair<std::string, std::function<Constraint()>>> list = {
          {"negative stiffness", [&] { return good().stiffness(negative); }},
          {"zero stiffness", [&] { return good().stiffness(0.); }},
          {"stiffness NaN", [&] { return good().stiffness(not_a_number); }},
          {"gap", [&] { return good().gap(bad); }},
          {"damping", [&] { return good().stiffness(1e3).damping(bad); }},
          {"negative damping", [&] { return good().stiffness(1e3).damping(negative); }},
          {"damping of a rigid one", [&] { return good().damping(1.); }},
          {"no law", [&] { return good().law(nullptr); }},
          {"law and stiffness", [&] { return good().law(law).stiffness(7.); }},
          {"law of a bilateral one", [&] { return Constraint::bilateral(name, up).law(law); }},
          {"no place", [&] { return Constraint::unilateral(name, nullptr); }},
          {"empty", [&] { return Constraint::bilateral(name, {}); }},
          {"empty form",
           [&] {
             return Constraint::bilateral(name, {{0, {}}});
           }},
          {"foreign body",
           [&]
           {
             spoilt[0].substructure = system.n_bodies() + calls.below(1000000);
             return Constraint::unilateral(name, spoilt);
           }},
          {"foreign DoF",
           [&]
           {
             spoilt[0].form.index[0] = 1000 + calls.below(1000000);
             return Constraint::unilateral(name, {}, spoilt);
           }},
          {"ragged form",
           [&]
           {
             spoilt[0].form.value.clear();
             return Constraint::unilateral(name, spoilt);
           }},
          {"value",
           [&]
           {
             spoilt[0].form.value[0] = bad;
             return Constraint::bilateral(name, spoilt);
           }},
          {"length",
           [&] {
             return Constraint::rope(name, {{0., 1., 0.}}, end, negative);
           }},
          {"length NaN",
           [&] {
             return Constraint::prop(name, {{0., 1., 0.}}, end, not_a_number);
           }},
          {"infinite length",
           [&] {
             return Constraint::rod(name, {{0., 1., 0.}}, end, infinite);
           }},
          {"ends at one place",
           [&] {
             return Constraint::rod(name, {{0., 0., 0.}}, end, 1.);
           }},
          {"place of an end",
           [&] {
             return Constraint::rod(name, {{0., bad, 0.}}, end, 1.);
           }},
          {"both ends stand",
           [&] {
             return Constraint::rope(name, {{0., 0., 0.}}, {{1., 0., 0.}}, 1.);
           }},
          {"gap of a rope",
           [&] {
             return Constraint::rope(name, {{0., 1., 0.}}, end, 1.).gap(.1);
           }},
          {"foreign end",
           [&]
           {
             end.motion[1][0].substructure += 5000;
             return Constraint::rope(name, {{0., 1., 0.}}, end, 1.);
           }},
          {"form on another system",
           [&]
           {
             taut::System other;
             const std::size_t body =
                 other.add("other", [] { return std::make_unique<Bob>("other", 1.); });
             return Constraint::unilateral(name, other.displacement(body, {}, {0., 1., 0.}));
           }},
      };
      const auto &[what, make] = list[calls.below(list.size())];
      calls.refuse(what, name, [&] { system.add(make()); });
    }

    void make_bad_body(Calls &calls, taut::System &system)
    {
      const auto defect = static_cast<Defect>(1 + calls.below(first_of_places - 1));
      const auto make = [&]
      {
        return std::make_unique<Chain>("bad body", std::vector<double>{1., 2.},
                                       std::vector<double>{1e3, 1e3}, defect);
      };
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
                     [&]
                     {
                       return std::make_unique<Chain>("late body", std::vector<double>{1., 2.},
                                                      std::vector<double>{1e3, 1e3}, defect);
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
    switch (calls.below(10))
    {
    case 0:
      calls.refuse("displacement", number, [&] { system.displacement(foreign, {}, up); });
      break;
    case 1:
      calls.refuse("link_end", number, [&] { system.link_end(foreign, {}); });
      break;
    case 2:
      calls.refuse("body", number, [&] { system.body(foreign); });
      break;
    case 3:
      calls.refuse("place", "finite", [&] { system.displacement(chain, {bad, 0., 0.}, up); });
      break;
    case 4:
      calls.refuse("direction", "finite", [&] { system.displacement(chain, {}, {0., bad, 0.}); });
      break;
    case 5:
      make_bad_body(calls, system);
      break;
    case 6:
      ask_bad_body(calls);
      break;
    default:
      make_bad_constraint(calls, system, chain);
    }
    if (system.n_bodies() != n_bodies || system.n_constraints() != n_constraints)
      throw Failure("a call that was refused left a trace");
  }

  void make_mistake_with_options(Calls &calls, const taut::System &system)
  {
    taut::StepperOptions options;
    std::string name;
    static const double bad_steps[] = {0.,       -1.,       -1e-3,  not_a_number,
                                       infinite, -infinite, 1e-320, 1e200};
    static const double bad_ratios[] = {-1e-9, 1.1, not_a_number, infinite, -1.};
    static const std::pair<std::string, std::string> bad_entries[] = {
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
    const std::size_t n_entries = sizeof(bad_entries) / sizeof(bad_entries[0]);
    switch (calls.below(9))
    {
    case 0:
      options.step = bad_steps[calls.below(8)];
      name = "StepperOptions::step";
      break;
    case 1:
      options.restitution = bad_ratios[calls.below(5)];
      name = "StepperOptions::restitution";
      break;
    case 2:
      options.scheme = "Moreau-Jaen";
      name = "did you mean 'Moreau-Jean'";
      break;
    case 3:
    {
      const auto &[path, value] = bad_entries[calls.below(n_entries)];
      options.scheme = "Moreau-Jean";
      options.scheme_entries[path] = value;
      name = "'" + path + "'";
      break;
    }
    case 4:
      options.scheme_entries["Newmark/Beta"] = "0.25";
      name = "Newmark/Beta";
      break;
    case 5:
      options.scheme = "Newmark";
      options.restitution = .5;
      name = "StepperOptions::restitution";
      break;
    case 6:
      options.solver.contact_tolerance = calls.below(2) == 0 ? calls.bad_number() : -1.;
      name = "Contact tolerance";
      break;
    case 7:
      (calls.below(2) == 0 ? options.solver.local_solver : options.solver.complementarity) = "best";
      name = "'best'";
      break;
    default:
    {
      std::string *const names[] = {&options.solver.interface.form,
                                    &options.solver.interface.preconditioner,
                                    &options.solver.interface.coarse_space};
      *names[calls.below(3)] = "any";
      name = "'any'";
    }
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
