// SPDX-License-Identifier: LGPL-2.1-or-later
#include "library_script.h"

#include <iostream>

namespace library
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

    struct Refusal
    {
      std::string what, name;
      std::function<void()> call;
    };

    void make(Calls &calls, const Refusal &mistake)
    {
      calls.refuse(mistake.what, mistake.name, mistake.call);
    }

    const std::string bad_link = "bad link";

    void make_bad_numbers(Calls &calls, taut::System &system, const std::size_t chain)
    {
      const taut::Displacement up = system.displacement(chain, {}, {0., 1., 0.});
      using Points = std::vector<std::pair<double, double>>;
      const auto law = std::make_shared<taut::TableLaw>(Points{{.1, 10.}, {.2, 40.}});
      const double bad = calls.bad_number(), negative = -calls.between(1e-9, 1e9);
      const taut::LinkEnd end = system.link_end(chain, {}, {0., 0., 0.}), above{{0., 1., 0.}},
                          bad_end{{0., bad, 0.}};
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
          {"place of an end", [&] { return Constraint::rod(bad_link, bad_end, end, 1.); }},
          {"gap of a rope", [&] { return Constraint::rope(bad_link, above, end, 1.).gap(.1); }}};
      const auto &[what, make] = list[calls.below(list.size())];
      calls.refuse(what, bad_link, [&] { system.add(make()); });
    }

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
      const taut::Displacement empty = {{0, {}}};
      const Mistakes list = {
          {"no place", [&] { return Constraint::unilateral(name, nullptr); }},
          {"empty", [&] { return Constraint::bilateral(name, {}); }},
          {"empty form", [&] { return Constraint::bilateral(name, empty); }},
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
      const std::string name = "bad body";
      const auto make = [&] { return chain_of(name, {1., 2.}, {1e3, 1e3}, defect); };
      const std::pair<std::string, std::function<void()>> list[] = {
          {"nullptr", [&] { system.add(name, [] { return nullptr; }); }},
          {"no factory", [&] { system.add(name, taut::Structure::Factory()); }},
          {"owner", [&] { system.add(name, 1 + calls.below(1000), make); }},
          {"defect " + std::to_string(static_cast<int>(defect)), [&] { system.add(name, make); }}};
      const std::size_t kind = std::min<std::size_t>(calls.below(6), 3);
      const bool is_named = kind < 3 || defect != Defect::prescribes_twice;
      calls.refuse(list[kind].first, is_named ? name : "", list[kind].second);
    }

    /// A body whose mistake shows later, in a system of its own.
    void ask_bad_body(Calls &calls)
    {
      const auto defect =
          static_cast<Defect>(first_of_places + calls.below(n_defects - first_of_places));
      const std::string what = "defect " + std::to_string(static_cast<int>(defect));
      taut::System system;
      const auto make = [&] { return chain_of("late body", {1., 2.}, {1e3, 1e3}, defect); };
      const std::size_t body = system.add("late body", make);
      const taut::Coordinates up = {0., 1., 0.};
      if (static_cast<int>(defect) < first_of_starts)
        return calls.refuse(what, "late body", [&] { system.displacement(body, {}, up); });
      taut::StepperOptions options;
      options.start = taut::Start::given;
      calls.refuse(what, "late body", [&] { taut::Stepper(system, options).advance(); });
    }
  } // namespace

  void make_mistake(Calls &calls, taut::System &system, const std::size_t chain)
  {
    const std::size_t n_bodies = system.n_bodies(), n_constraints = system.n_constraints(),
                      foreign = n_bodies + calls.below(100000);
    const taut::Coordinates up = {0., 1., 0.}, bad = {0., calls.bad_number(), 0.};
    const std::string number = "number " + std::to_string(foreign);
    const Refusal list[] = {{"displacement", number, [&] { system.displacement(foreign, {}, up); }},
                            {"link_end", number, [&] { system.link_end(foreign, {}); }},
                            {"body", number, [&] { system.body(foreign); }},
                            {"place", "finite",
                             [&] {
                               system.displacement(chain, {bad.y, 0., 0.}, up);
                             }},
                            {"direction", "finite", [&] { system.displacement(chain, {}, bad); }}};
    const std::size_t kind = calls.below(12);
    if (kind < std::size(list))
      make(calls, list[kind]);
    else if (kind == 5)
      make_bad_body(calls, system);
    else if (kind == 6)
      ask_bad_body(calls);
    else if (kind < 9)
      make_bad_form(calls, system, chain);
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
      const auto &[path, value] = entries[calls.below(std::size(entries))];
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
    const std::size_t kind = calls.below(4);
    std::string name = kind == 0 ? "StepperOptions::step" : "StepperOptions::restitution";
    if (kind == 0)
      options.step = steps[calls.below(8)];
    else if (kind == 1)
      options.restitution = ratios[calls.below(5)];
    else
      name = kind == 2 ? spoil_scheme(calls, options) : spoil_solver(calls, options.solver);
    calls.refuse("options", name, [&] { taut::Stepper(system, options); });
  }

  void make_mistake_with_stepper(Calls &calls, taut::System &system, taut::Stepper &stepper)
  {
    const std::size_t foreign = system.n_constraints() + calls.below(100),
                      body = system.n_bodies() + calls.below(10);
    taut::LinearForm one;
    one.add(0, 1.);
    const taut::Displacement foreign_body = {{system.n_bodies() + 1000, one}};
    taut::Displacement foreign_dof = {{0, one}}, ragged = foreign_dof;
    foreign_dof[0].form.index[0] = 77777;
    ragged[0].form.index.clear();
    const std::string number = "number " + std::to_string(foreign);
    const Refusal list[] = {
        {"multiplier", number, [&] { stepper.multiplier(foreign); }},
        {"gap", number, [&] { stepper.gap(foreign); }},
        {"displacement of a body", "number", [&] { stepper.displacement(body); }},
        {"form on a foreign body", "body number", [&] { stepper.displacement(foreign_body); }},
        {"velocity of a foreign DoF", "DoF 77777", [&] { stepper.velocity(foreign_dof); }},
        {"ragged form", "indices", [&] { stepper.displacement(ragged); }}};
    make(calls, list[calls.below(std::size(list))]);
  }
} // namespace library
