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

  std::string scene(const double h, const double tau, const std::string &scheme, const int degree)
  {
    std::ostringstream text;
    text.precision(17);
    text << "Gravity = 0, 0; Start = undeformed\n"
            "Wire string: To = 60, 0; Components = string; Mass per length = 1.35; Tension = "
            "20000; Degree = "
         << degree << "; Element size = " << h
         << "\nSupport ends: Wire = string; Positions = 0, 60\n"
            "Load force: Type = moving; On = string @ 0; Magnitude = 120; Speed = "
         << v << "\nTime: Scheme = " << scheme << "; Step = " << tau << "; End = 0.4\n";
    return text.str();
  }

  std::string text(const double x)
  {
    std::ostringstream out;
    out << x;
    return out.str();
  }

  struct Errors
  {
    double at_load = 0., behind = 0., ahead = 0., w = 0.; ///< relative; w [m] at t = 0.3 s
  };

  Errors run(const double h, const double tau, const std::string &scheme, const int degree)
  {
    Errors e;
    run_scene(scene(h, tau, scheme, degree), {},
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
                {
                  double &error = x <= v * t ? e.behind : e.ahead;
                  error =
                      std::max(error, std::fabs(displacement(view, 0, x) - exact(x, t)) / w_load);
                }
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
    e = run(h, tau, "generalised-alpha", 2);
    figure("moving force, quadratic elements, largest relative error at the load in 0.1..0.4 s, "
           "h = " +
               text(1e3 * h) + " mm, tau = " + text(1e6 * tau) + " us",
           e.at_load);
    sizes.push_back(h);
    errors.push_back(e.at_load);
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
  std::vector<double> sizes, at_load, behind, ahead;
  for (const double h : {.05, .025, .0125, .00625})
  {
    const double tau = h / 200.;
    const Errors e = run(h, tau, "generalised-alpha", 1);
    const std::string grid = ", h = " + text(1e3 * h) + " mm, tau = " + text(1e6 * tau) + " us";
    figure("moving force, linear elements, relative error at the load" + grid, e.at_load);
    figure("moving force, linear elements, error behind the load, relative to it" + grid, e.behind);
    figure("moving force, linear elements, error ahead of the load, relative to it" + grid,
           e.ahead);
    sizes.push_back(h);
    at_load.push_back(e.at_load);
    behind.push_back(e.behind);
    ahead.push_back(e.ahead);
  }
  figure("moving force, linear elements, order at the load", fitted_order(sizes, at_load));
  figure("moving force, linear elements, order behind the load", fitted_order(sizes, behind));
  figure("moving force, linear elements, order ahead of the load", fitted_order(sizes, ahead));
  EXPECT_LT(at_load.back(), 1e-3);
  EXPECT_LT(behind.back(), 1e-3);
  EXPECT_LT(ahead.back(), 1e-3);
  EXPECT_GT(fitted_order(sizes, at_load), .95);
  EXPECT_GT(fitted_order(sizes, behind), .9);
  EXPECT_GT(fitted_order(sizes, ahead), .6) << "the front of the wave is a kink, O(h^(2/3))";
}

// A damper of sqrt(T m) at its end ends a string as if it went on: a wave that arrives there is
// swallowed.
TEST(Damper, of_the_wave_impedance_swallows_a_wave)
{
  double energy_before = 0., energy_after = 0.;
  run_scene(R"(Gravity = 0, 0; Start = given
Wire string: To = 20, 0; Components = string; Mass per length = 1; Tension = 400;
  Element size = 0.05; Initial transverse displacement = 0.01*exp(-(s-10)^2);
  Initial transverse velocity = 0.4*(s-10)*exp(-(s-10)^2)
Support left: Wire = string; Positions = 0
Support right: Wire = string; Positions = 20; Type = elastic; Damping = 20
Time: Scheme = Newmark; Step = 5e-4; End = 0.9
)",
            {},
            [&](const taut::StepView &view)
            {
              energy_after = energy_of_bodies(view.structure, view.state);
              if (energy_before == 0.)
                energy_before = energy_after;
            });
  figure("string on a damper of its impedance, energy left over", energy_after / energy_before);
  EXPECT_LT(energy_after, 1e-5 * energy_before);
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
