// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: a force that moves along a taut string raises the exact kink. Source: d'Alembert's
// solution of T w" - m w" = -F delta(x - v t) before the front reaches the far end, with
// beta = v/c: F x/(T (1 + beta)) behind the load, F beta (c t - x)/(T (1 - beta^2)) ahead of it.
#include "scene_tests.h"

using namespace verification;

namespace
{
  const double T = 20000., m = 1.35, L = 60., F = 120., v = 250. / 3.6;

  double exact(const double x, const double t)
  {
    const double c = std::sqrt(T / m), beta = v / c;
    if (x <= v * t)
      return F * x / (T * (1. + beta));
    return std::max(0., F * beta * (c * t - x) / (T * (1. - beta * beta)));
  }

  std::string scene(const double h, const double tau, const int degree)
  {
    return R"(Gravity = 0, 0; Start = undeformed
Wire string: To = 60, 0; Components = string; Mass per length = 1.35; Tension = 20000
Support ends: Wire = string; Positions = 0, 60
Load force: Type = moving; On = string @ 0; Magnitude = 120; Speed = )" +
           number(v) + "\nWire string: Degree = " + std::to_string(degree) +
           "; Element size = " + number(h) +
           "\nTime: Scheme = generalised-alpha; End = 0.4; Step = " + number(tau) + "\n";
  }

  /// Sizes of elements and steps in a figure.
  std::string grid(const double h, const double tau)
  {
    std::ostringstream out;
    out << "h = " << 1e3 * h << " mm, tau = " << 1e6 * tau << " us";
    return out.str();
  }

  struct Errors
  {
    double at_load = 0., behind = 0., ahead = 0., w = 0.; ///< relative; w [m] at t = 0.3 s
  };

  Errors run(const double h, const double tau, const int degree)
  {
    Errors e;
    run_scene(scene(h, tau, degree), {},
              [&](const taut::StepView &view)
              {
                const double t = view.state.time;
                if (t < .1 - 1e-9)
                  return;
                const double w_load = exact(v * t, t), w = displacement(view, 0, v * t);
                e.at_load = std::max(e.at_load, std::fabs(w - w_load) / w_load);
                if (std::fabs(t - .3) < 1e-9)
                  e.w = w;
                if (std::lround(t / tau) % 10 != 0)
                  return;
                for (double x = .25; x < L; x += .25)
                  raise(x <= v * t ? e.behind : e.ahead,
                        (displacement(view, 0, x) - exact(x, t)) / w_load);
              });
    return e;
  }
} // namespace

TEST(MovingForceOnString, displacement_at_the_load_is_exact_to_a_thousandth)
{
  EXPECT_NEAR(exact(.3 * v, .3), .079590, 5e-7);
  std::vector<double> sizes, errors;
  Errors e;
  for (const double h : {.2, .1, .05, .025})
  {
    const double tau = h / 100.;
    e = run(h, tau, 2);
    sizes.push_back(h);
    errors.push_back(figure(
        "moving force, quadratic elements, largest relative error at the load in 0.1..0.4 s, " +
            grid(h, tau),
        e.at_load));
  }
  const double order = fitted_order(sizes, errors);
  figure("moving force, quadratic elements, displacement at the load at 0.3 s, h = 25 mm",
         1e3 * e.w, "mm");
  figure("moving force, quadratic elements, order at the load in h, tau = h / (100 m/s)", order);
  EXPECT_LT(errors.back(), 1e-3);
  EXPECT_NEAR(e.w, .079590, 1e-3 * .079590);
  EXPECT_GT(order, .85) << "a kink inside an element costs O(h)";
}

TEST(MovingForceOnString, whole_profile_is_exact_to_a_thousandth)
{
  struct Part
  {
    std::string error, name;
    double Errors::*of;
    double order;
    std::vector<double> errors = {};
  };
  Part parts[] = {
      {"relative error at the load", "at the load", &Errors::at_load, .95},
      {"error behind the load, relative to it", "behind the load", &Errors::behind, .9},
      // The front of the wave is a kink, O(h^(2/3)).
      {"error ahead of the load, relative to it", "ahead of the load", &Errors::ahead, .6}};
  const std::vector<double> sizes = {.05, .025, .0125, .00625};
  const std::string name = "moving force, linear elements, ";
  for (const double h : sizes)
  {
    const Errors e = run(h, h / 200., 1);
    for (Part &part : parts)
      part.errors.push_back(figure(name + part.error + ", " + grid(h, h / 200.), e.*part.of));
  }
  for (const Part &part : parts)
  {
    EXPECT_GT(figure(name + "order " + part.name, fitted_order(sizes, part.errors)), part.order);
    EXPECT_LT(part.errors.back(), 1e-3) << part.name;
  }
}

// A damper of sqrt(T m) at its end ends a string as if it went on: a wave that arrives there is
// swallowed.
TEST(Damper, of_the_wave_impedance_swallows_a_wave)
{
  const std::vector<double> energy = history_of(
      R"(Gravity = 0, 0; Start = given
Wire string: To = 20, 0; Components = string; Mass per length = 1; Tension = 400;
  Element size = 0.05; Initial transverse displacement = 0.01*exp(-(s-10)^2);
  Initial transverse velocity = 0.4*(s-10)*exp(-(s-10)^2)
Support left: Wire = string; Positions = 0
Support right: Wire = string; Positions = 20; Type = elastic; Damping = 20
Time: Scheme = Newmark; Step = 5e-4; End = 0.9
)",
      {}, [](const taut::StepView &view) { return energy_of_bodies(view.structure, view.state); });
  EXPECT_LT(figure("string on a damper of its impedance, energy left over",
                   energy.back() / energy.front()),
            1e-5);
}

// A string that is struck all along moves by v t until the waves from its ends arrive. A velocity
// of what is held would stay, with changing sign, and shake what is beside it.
TEST(StruckString, is_at_rest_where_it_is_held)
{
  double at_ends = 0., start = 0., middle = 0.;
  run_scene(R"(Gravity = 0, 0; Start = given
Wire string: To = 10, 0; Components = string; Mass per length = 1; Tension = 400;
  Element size = 0.1; Initial transverse velocity = 1
Support ends: Wire = string; Positions = 0, 10
Time: Scheme = Moreau-Jean; Step = 1e-3; End = 0.2
)",
            {},
            [&](const taut::StepView &view)
            {
              const std::vector<double> &V = view.state.V[0];
              at_ends = std::max({at_ends, std::fabs(V.front()), std::fabs(V.back())});
              if (view.state.time == 0.)
                start = V[V.size() / 2];
              middle = displacement(view, 0, 5.) - view.state.time;
            });
  EXPECT_EQ(start, 1.);
  EXPECT_EQ(at_ends, 0.);
  EXPECT_LT(std::fabs(middle), 1e-3) << "waves arrive after 0.25 s";
}
