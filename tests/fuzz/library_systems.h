// SPDX-License-Identifier: LGPL-2.1-or-later
// Systems of a random sequence of calls, with their exact results.
#ifndef taut_tests_door_systems_h
#define taut_tests_door_systems_h

#include "library_script.h"

#include <algorithm>
#include <numeric>

namespace library
{
  using taut::Constraint;
  using taut::Displacement;
  using taut::Stepper;
  using taut::StepperOptions;
  using taut::System;

  constexpr taut::Coordinates up = {0., 1., 0.};

  /// A stop that stands, as one that moves.
  class StandingPlace : public taut::MovingPlace
  {
  public:
    StandingPlace(Displacement form, const double height) : form(std::move(form)), height(height) {}
    double position(double) const override { return 0.; }
    void append_terms(double, Displacement &terms) const override { terms = form; }
    void append_rates(double, Displacement &) const override {}
    double gap(double) const override { return height; }

  private:
    const Displacement form;
    const double height;
  };

  /// What a result at rest or in motion has to be.
  struct Expected
  {
    Displacement form;
    double displacement;
  };
  struct ExpectedForce
  {
    std::size_t constraint;
    double multiplier, gap;
  };

  class Script
  {
  public:
    Script(Calls &calls, const double mistakes) : calls(calls), mistakes(mistakes) {}

    void rest()
    {
      for (std::size_t k = 1 + calls.below(3); k > 0; --k)
      {
        add_hanging();
        if (calls.below(2) == 0)
          add_standing();
        if (calls.below(4) == 0)
          add_bob();
      }
      StepperOptions options;
      options.step = std::pow(10., calls.between(-4., -2.));
      const std::string schemes[] = {"automatic", "backward Euler", "Moreau-Jean"};
      options.scheme = schemes[calls.below(3)];
      if (options.scheme == "Moreau-Jean" && calls.below(2) == 0)
        options.scheme_entries["Moreau-Jean/Theta"] = "0.5";
      spoil_options();
      Stepper stepper(system, options);
      check(stepper, 0.);
      for (std::size_t k = 1 + calls.below(3); k > 0; --k)
      {
        stepper.advance();
        check(stepper, stepper.time());
      }
    }

    void motion()
    {
      StepperOptions options;
      options.start = taut::Start::undeformed;
      options.step = std::pow(10., calls.between(-4., -2.));
      const bool implicit = calls.below(2) == 0;
      options.scheme = implicit ? "backward Euler" : "Moreau-Jean";
      std::vector<double> rates; // of vibration at each mass
      for (std::size_t k = 1 + calls.below(3); k > 0; --k)
      {
        const double mass = calls.between(.1, 10.),
                     spring = calls.below(2) == 0 ? 0. : calls.between(10., 1e4);
        add_body({mass}, {spring});
        expected.push_back({form(system.n_bodies() - 1, 0), 0.});
        rates.push_back(std::sqrt(spring / mass));
        spoil();
      }
      spoil_options();
      Stepper stepper(system, options);
      std::vector<double> velocities(rates.size(), 0.);
      for (int n = 1; n <= 6; ++n)
      {
        stepper.advance();
        for (std::size_t k = 0; k < rates.size(); ++k)
          expected[k].displacement =
              implicit ? euler(rates[k], options.step, expected[k].displacement, velocities[k])
                       : trapezoidal(rates[k], options.step, n);
        check(stepper, n * options.step);
      }
    }

    /// Numbers of any size: refused, or results that are finite and certified.
    void extremes()
    {
      try
      {
        ++calls.counts.open;
        const double mass = calls.any_number(), spring = calls.any_number();
        const auto make = [&] { return chain_of("body", {mass, 1.}, {1e3, spring}); };
        const std::size_t body = system.add("body", make);
        ++calls.counts.open;
        Constraint link = Constraint::unilateral("link", system.displacement(body, {1.}, up));
        link.gap(calls.any_number());
        if (calls.below(2) == 0)
          link.stiffness(calls.any_number()).damping(calls.any_number());
        const std::size_t number = system.add(link);
        StepperOptions options;
        options.start = static_cast<taut::Start>(calls.below(3));
        options.step = calls.any_number();
        ++calls.counts.open;
        Stepper stepper(system, options);
        for (int k = 0; k < 3; ++k)
        {
          ++calls.counts.open;
          stepper.advance();
          check_finite(stepper, body, number, options.solver.contact_tolerance);
        }
      }
      catch (const taut::UserError &e)
      {
        const std::string message = e.what();
        if (message.empty() || message.find('\n') != std::string::npos)
          throw Failure("the message is not one line: " + message);
      }
    }

  private:
    /// u" = -rate^2 u - g from rest by backward Euler, one step from u and v.
    static double euler(const double rate, const double step, const double u, double &v)
    {
      v = (v - step * (gravity + rate * rate * u)) / (1. + step * step * rate * rate);
      return u + step * v;
    }

    /// The same after n steps of the trapezoidal rule: tan(w step / 2) = rate step / 2.
    static double trapezoidal(const double rate, const double step, const int n)
    {
      const double t = n * step, sine = std::sin(t / step * std::atan(.5 * rate * step));
      return rate == 0. ? -.5 * gravity * t * t : -2. * gravity / (rate * rate) * sine * sine;
    }

    static void check_finite(const Stepper &stepper, const std::size_t body,
                             const std::size_t constraint, const double tolerance)
    {
      std::vector<double> values = stepper.displacement(body);
      values.insert(values.end(), {stepper.multiplier(constraint), stepper.gap(constraint)});
      for (const double value : values)
        if (!std::isfinite(value))
          throw Failure("a result is not finite");
      if (!(stepper.residuals().max() <= tolerance))
        throw Failure("the certificate of an accepted step misses the tolerance");
    }

    bool wrong() { return calls.between(0., 1.) < mistakes; }

    void spoil()
    {
      while (system.n_bodies() > 0 && wrong())
        make_mistake(calls, system, 0);
    }
    void spoil_options()
    {
      while (wrong())
        make_mistake_with_options(calls, system);
    }

    Displacement form(const std::size_t body, const std::size_t mass)
    {
      const Displacement result = system.displacement(body, {static_cast<double>(mass)}, up);
      calls.expect_true("a form is not that of the body", result.size() == 1 &&
                                                              result[0].form.index[0] == mass &&
                                                              result[0].form.value[0] == 1.);
      return result;
    }

    std::size_t add_body(const std::vector<double> &masses, const std::vector<double> &springs)
    {
      const std::size_t n = system.n_bodies();
      const std::string name = "body " + std::to_string(n);
      const std::size_t body =
          system.add(name, [&] { return std::make_unique<Chain>(name, masses, springs); });
      calls.expect_true("the number of a body", body == n && system.n_bodies() == n + 1);
      return body;
    }

    std::size_t add_link(const Constraint &link)
    {
      const std::size_t n = system.n_constraints(), result = system.add(link);
      calls.expect_true("the number of a constraint",
                        result == n && system.n_constraints() == n + 1);
      return result;
    }

    /// Masses that hang from the ground, and perhaps one more that the last one carries.
    void add_hanging()
    {
      std::vector<double> masses, springs;
      for (std::size_t i = 1 + calls.below(4); i > 0; --i)
      {
        masses.push_back(calls.between(.1, 10.));
        springs.push_back(std::pow(10., calls.between(2., 6.)));
      }
      const bool carries = calls.below(3) == 0;
      const double carried = carries ? calls.between(.1, 10.) : 0.;
      const std::size_t body = add_body(masses, springs);
      double weight = gravity * (std::accumulate(masses.begin(), masses.end(), carried)), u = 0.;
      for (std::size_t i = 0; i < masses.size(); ++i)
      {
        u -= weight / springs[i];
        weight -= gravity * masses[i];
        expected.push_back({form(body, i), u});
        spoil();
      }
      if (carries)
        add_carried(body, masses.size() - 1, carried, u);
    }

    void add_carried(const std::size_t carrier, const std::size_t place, const double mass,
                     const double u)
    {
      const std::size_t body = add_body({mass}, {0.});
      const bool rigid = calls.below(2) == 0;
      const double gap = calls.between(-.1, .1), k = std::pow(10., calls.between(2., 6.)),
                   spring = rigid ? 0. : gravity * mass / k;
      Constraint link = Constraint::bilateral("carrier " + std::to_string(body), form(body, 0),
                                              form(carrier, place))
                            .gap(gap);
      if (!rigid)
        link.stiffness(k);
      forces.push_back({add_link(link), gravity * mass, -spring});
      expected.push_back({form(body, 0), u - gap - spring});
      spoil();
    }

    /// Masses that stand on a stop below the last one.
    void add_standing()
    {
      std::vector<double> masses, springs = {0.};
      for (std::size_t i = 1 + calls.below(3); i > 0; --i)
        masses.push_back(calls.between(.1, 10.));
      while (springs.size() < masses.size())
        springs.push_back(std::pow(10., calls.between(2., 6.)));
      const std::size_t body = add_body(masses, springs);
      const double N = gravity * std::accumulate(masses.begin(), masses.end(), 0.),
                   gap = calls.between(0., .1);
      const Displacement last = form(body, masses.size() - 1);
      const std::string name = "stop " + std::to_string(body);
      Constraint link = Constraint::unilateral(name, last).gap(gap);
      double compression = 0.;
      const std::size_t kind = calls.below(4);
      if (kind == 0)
      {
        const double k = std::pow(10., calls.between(2., 6.));
        link.stiffness(k).damping(calls.below(2) == 0 ? 0. : calls.between(0., 10.));
        compression = N / k;
      }
      else if (kind == 1)
      {
        // 100 N/m to 10 N, then 300 N/m.
        using Points = std::vector<std::pair<double, double>>;
        link.law(std::make_shared<taut::TableLaw>(Points{{.1, 10.}, {.2, 40.}}));
        compression = N < 10. ? N / 100. : .1 + (N - 10.) / 300.;
      }
      else if (kind == 2)
        link = Constraint::unilateral(name, std::make_shared<StandingPlace>(last, gap));
      forces.push_back({add_link(link), N, -compression});
      double u = -gap - compression, weight = N;
      for (std::size_t i = masses.size(); i-- > 0;)
      {
        expected.push_back({form(body, i), u});
        weight -= gravity * masses[i];
        if (i > 0)
          u -= weight / springs[i];
      }
      spoil();
    }

    /// A mass in space below a rope or a rod.
    void add_bob()
    {
      const double mass = calls.between(.5, 5.), length = calls.between(.5, 2.),
                   k = std::pow(10., calls.between(3., 5.)), N = gravity * mass;
      const std::size_t n = system.n_bodies();
      const std::string name = "bob " + std::to_string(n);
      const std::size_t body = system.add(name, [&] { return std::make_unique<Bob>(name, mass); });
      const taut::Coordinates start = {1., 2. - calls.between(.95, 1.) * length, 3.};
      const taut::LinkEnd end = system.link_end(body, {}, start), pivot{{1., 2., 3.}};
      const bool is_rope = calls.below(2) == 0, rigid = calls.below(2) == 0;
      Constraint link = is_rope ? Constraint::rope(name, pivot, end, length)
                                : Constraint::rod(name, pivot, end, length);
      if (!rigid)
        link.stiffness(k);
      const double stretch = rigid ? 0. : N / k;
      forces.push_back({add_link(link), is_rope ? N : -N, is_rope ? -stretch : stretch});
      expected.push_back({end.motion[1], 2. - length - stretch - start.y});
      expected.push_back({end.motion[0], 0.});
      spoil();
    }

    void check(Stepper &stepper, const double time)
    {
      const double close = 1e-8; // of numbers of about one; the certificate is far below
      calls.expect("the time", stepper.time(), time, 1e-12 * (1. + time));
      for (const Expected &e : expected)
        calls.expect("a displacement", stepper.displacement(e.form), e.displacement,
                     close * (std::fabs(e.displacement) + 1e-3));
      for (const ExpectedForce &e : forces)
      {
        calls.expect("a multiplier", stepper.multiplier(e.constraint), e.multiplier,
                     1e-6 * std::fabs(e.multiplier));
        calls.expect("a gap", stepper.gap(e.constraint), e.gap, close * (1. + std::fabs(e.gap)));
      }
      while (wrong())
        make_mistake_with_stepper(calls, system, stepper);
    }

    Calls &calls;
    const double mistakes; ///< probability of one between two calls, and of one more
    System system;
    std::vector<Expected> expected;
    std::vector<ExpectedForce> forces;
  };
} // namespace library

#endif
