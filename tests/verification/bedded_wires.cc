// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: wires on a bedding and wires with parts of another tension deflect, and move under a load
// that travels, as their differential equations say; a conductor rail is such a beam on springs.
// Source: closed forms. S. Timoshenko, Method of analysis of statical and dynamical stresses in
// rail, 1926; L. Fryba, Vibration of Solids and Structures under Moving Loads, chapter 13.
#include "scene_tests.h"
#include "solid/first_frequency.h"

#include <taut/output/spans.h>

#include <complex>

using namespace verification;

namespace
{
  using Complex = std::complex<double>;

  /// A beam of EI = 1 N m^2 and m = 1 kg/m on a bedding of 4 N/m^2: its waves do not run slower
  /// than 2 m/s, and under a load that stands its deflection decays like exp(-x).
  constexpr double stiffness = 4., critical_speed = 2.;

  /**
   * The deflection x ahead of a force of 1 N that runs with speed v on an endless beam, in its
   * steady state. With x = s - v t the equation w'''' + v^2 w'' - c v w' + k w = delta has
   * solutions exp(r x); of the four r those that decay ahead of the force, and those that decay
   * behind it, make the answer, each over the derivative of its polynomial there.
   */
  double steady_deflection(const double x, const double v, const double damping)
  {
    const auto value = [&](const Complex r)
    { return ((r * r + v * v) * r - damping * v) * r + stiffness; };
    const auto derivative = [&](const Complex r)
    { return (4. * r * r + 2. * v * v) * r - damping * v; };
    // All roots at once, by Durand and Kerner.
    std::array<Complex, 4> roots;
    for (int i = 0; i < 4; ++i)
      roots[i] = std::pow(Complex(.4, 1.1), i);
    for (int iteration = 0; iteration < 500; ++iteration)
      for (int i = 0; i < 4; ++i)
      {
        Complex others = 1.;
        for (int j = 0; j < 4; ++j)
          if (j != i)
            others *= roots[i] - roots[j];
        roots[i] -= value(roots[i]) / others;
      }
    Complex sum = 0.;
    for (const Complex r : roots)
      if ((r.real() < 0.) == (x >= 0.))
        sum += (x >= 0. ? 1. : -1.) * std::exp(r * x) / derivative(r);
    return sum.real();
  }

  const std::string bedded_beam = R"(Gravity = 0, 0
Wire beam: From = 0, 0; To = 120, 0; Components = beam; Mass per length = 1; Bending stiffness = 1
  ; Foundation stiffness = 4; Element size = 0.125
Support ends: Wire = beam; Positions = 0, 120
)";

  double deflection_at_rest(const std::string &scene, const std::size_t wire, const double s)
  {
    double result = NAN;
    run_scene(scene + "Time: End = 0\n", {},
              [&](const taut::StepView &view) { result = displacement(view, wire, s); });
    return result;
  }
} // namespace

TEST(BeddedBeam, steady_state_without_damping_is_that_of_timoshenko_and_fryba)
{
  for (const double part : {.3, .6, .9})
  {
    const double v = part * critical_speed, a = std::sqrt(1. - part * part),
                 b = std::sqrt(1. + part * part);
    for (const double x : {0., .5, 2., 5.})
      EXPECT_NEAR(steady_deflection(x, v, 1e-9),
                  std::exp(-a * x) * (std::cos(b * x) + a / b * std::sin(b * x)) / (8. * a), 1e-7);
  }
}

TEST(BeddedBeam, under_a_moving_force_reaches_the_steady_state)
{
  // Damped to 15 %, so that what the start excites is gone at the end; the closed form has it, too.
  const double damping = .15 * 2. * std::sqrt(stiffness);
  double worst = 0.;
  for (const double part : {.25, .5, .75, .9})
  {
    const double v = part * critical_speed, start = 25., way = 70.;
    std::vector<double> found;
    Session session(bedded_beam + "Wire beam: Foundation damping = " + number(damping) +
                    "\nLoad force: Type = moving; On = beam @ 25; Magnitude = 1; Speed = " +
                    number(v) + "\nTime: Scheme = Newmark; Step = " + number(.02 / v) +
                    "; End = " + number(way / v) + "\n");
    const std::vector<double> places = {-6., -3., -1.5, -.5, 0., .5, 1.5, 3.};
    session.run(
        [&](const taut::StepView &view)
        {
          found.clear();
          for (const double x : places)
            found.push_back(displacement(view, 0, start + way + x));
        });
    double error = 0.;
    for (std::size_t i = 0; i < places.size(); ++i)
      raise(error, (found[i] - steady_deflection(places[i], v, damping)) /
                       steady_deflection(0., v, damping));
    figure("beam on a bedding, force at " + std::to_string(int(100. * part)) +
               " % of the critical speed, error",
           error);
    raise(worst, error);
  }
  EXPECT_LT(worst, 1e-3);
}

TEST(BeddedBeam, at_rest_is_the_one_of_winkler)
{
  const std::string scene = bedded_beam + "Load force: On = beam @ 60; Magnitude = 1\n";
  for (const double x : {0., .5, 1., 3.})
    EXPECT_NEAR(deflection_at_rest(scene, 0, 60. + x),
                std::exp(-x) * (std::cos(x) + std::sin(x)) / 8., 1e-6);
}

TEST(BeddedString, at_rest_decays_exponentially)
{
  const std::string scene = R"(Gravity = 0, 0
Wire string: From = 0, 0; To = 80, 0; Components = string; Mass per length = 1; Tension = 100
  ; Foundation stiffness = 25; Element size = 0.1
Support ends: Wire = string; Positions = 0, 80
Load force: On = string @ 40; Magnitude = 3
)";
  for (const double x : {0., 1., 2.5, 7.})
    EXPECT_NEAR(deflection_at_rest(scene, 0, 40. - x), 3. * std::exp(-.5 * x) / 100., 1e-8);
}

namespace
{
  /// 12 m, and from 4.3 m to 7.7 m a tension of 2000 instead of 5000 N; elements end elsewhere.
  const std::string string_of_parts = R"(Gravity = 0, 0
Wire string: From = 0, 0; To = 12, 0; Components = string; Mass per length = 1.5; Tension = 5000
  ; Tension changes = 4.3, 7.7, -3000; Element size = 0.5
Support ends: Wire = string; Positions = 0, 12
)";

  /// The integral of 1 / tension from 0 to s.
  double flexibility(const double s)
  {
    return (s + 1.5 * std::max(0., std::min(s, 7.7) - 4.3)) / 5000.;
  }
} // namespace

TEST(TensionChange, under_a_point_force_is_linear_in_parts)
{
  for (const double force : {2., 5.9, 9.})
  {
    const std::string scene =
        string_of_parts + "Load force: Magnitude = 700; On = string @ " + number(force) + "\n";
    for (const double s : {1., 4.3, 5., 6.6, 7.7, 11.})
      EXPECT_NEAR(deflection_at_rest(scene, 0, s),
                  700. * flexibility(std::min(s, force)) *
                      (flexibility(12.) - flexibility(std::max(s, force))) / flexibility(12.),
                  1e-11)
          << force << " " << s;
  }
}

TEST(TensionChange, first_frequency_is_that_of_the_three_parts)
{
  // Symmetric about the middle: sin(p s) outside, a cosine inside, alike in place and T w'.
  const double omega =
      end_of(1., 20.,
             [](const double w)
             {
               const double p = w * std::sqrt(1.5 / 5000.), q = w * std::sqrt(1.5 / 2000.);
               return 5000. * p / std::tan(p * 4.3) > 2000. * q * std::tan(q * 1.7);
             });
  Session session(string_of_parts + "Time: End = 0\n");
  EXPECT_NEAR(first_frequency(session.simulation().structure()[0]), omega, 1e-6 * omega);
}

namespace
{
  /// A rail of 5 spans of 8 m, 10 kg/m and EI = 2.1e5 N m^2 on arms of 4e5 N/m; a mass under it
  /// travels where it is asked for.
  std::string rail(const bool by_catenary, const bool has_contact)
  {
    const std::string time =
        "Time: Scheme = Newmark; Step = 1e-3; End = " + std::string(has_contact ? "0.4" : "0") +
        "\n";
    if (by_catenary)
      return R"(Generator = catenary
Catenary: Kind = conductor rail; Number of spans = 5; Span length = 8; Uplift positions = 16, 20
Catenary/Contact wire: Model = beam; Mass per length = 10; Tension = 0; Bending stiffness = 2.1e5
  ; Element size = 1; Mass damping = 0.1; Stiffness damping = 1e-4
Catenary/Supports: Arm mass = 2; Arm stiffness = 4e5; Arm damping = 300
)" +
             std::string(
                 has_contact
                     ? "Pantograph one: Masses = 8, 10; Stiffnesses = 5000, 60; Dampings = 20, 80; "
                       "Static force = 110; Start = 10; Speed = 108; Contact stiffness = 5e4\n"
                     : "Catenary: Pantographs =\n") +
             time;
    return R"(Wire contact: From = 0, 0; To = 40, 0; Components = beam; Mass per length = 10
  ; Bending stiffness = 2.1e5; Element size = 1; Mass damping = 0.1; Stiffness damping = 1e-4
Support ends: Wire = contact; Positions = 0, 40
Support arm: Wire = contact; Type = elastic; Positions = 8, 16, 24, 32; Stiffness = 4e5; Damping = 300
Point mass arm: Wire = contact; Positions = 8, 16, 24, 32; Mass = 2; Weight = false
)" +
           std::string(has_contact ? R"(Mass head: Position = 10, 0; Mass = 8; Weight = false
Mass frame: Position = 10, 0; Mass = 10; Weight = false
Spring head: From = frame; To = head; Stiffness = 5000; Damping = 20
Spring frame: To = frame; Stiffness = 60; Damping = 80
Load push: On = frame; Magnitude = 110
Link one: Type = sliding contact; From = head; To = contact @ 10; Direction = 0, 1; Stiffness = 5e4
  ; Speed = 30
)"
                                   : "") +
           time;
  }
} // namespace

TEST(ConductorRail, at_rest_is_a_beam_on_springs)
{
  for (const double s : {4., 8., 12., 19.})
  {
    const double found = deflection_at_rest(rail(true, false), 0, s);
    EXPECT_LT(found, 0.);
    EXPECT_NEAR(found, deflection_at_rest(rail(false, false), 0, s), 1e-14) << s;
  }
}

TEST(ConductorRail, under_a_pantograph_moves_like_a_beam_on_springs)
{
  const auto history = [](const bool by_catenary)
  {
    return history_of(rail(by_catenary, true), {},
                      [](const taut::StepView &view) { return displacement(view, 0, 20.); });
  };
  const std::vector<double> found = history(true), expected = history(false);
  EXPECT_EQ(found.size(), 401u);
  EXPECT_LT(largest_difference(found, expected), 1e-12);
  EXPECT_GT(largest(found), 1e-3);
}

// Bending carries the waves of a rail: T + EI q^2 at the wave number q of 20 Hz, m c^4 - T c^2 = EI
// omega^2. sqrt(T / m) would be 12 m/s, and the pantograph runs at 30 m/s.
TEST(ConductorRail, with_tension_runs_slower_than_its_waves)
{
  const auto with_tension = [](std::string scene)
  {
    const std::string at = "Bending stiffness = 2.1e5";
    scene.insert(scene.find(at) + at.size(), "; Tension = 1500");
    const std::string none = "Tension = 0; ";
    if (const std::size_t begin = scene.find(none); begin != std::string::npos)
      scene.erase(begin, none.size());
    return scene;
  };
  const auto history = [&](const bool by_catenary)
  {
    return history_of(with_tension(rail(by_catenary, true)), {},
                      [](const taut::StepView &view) { return displacement(view, 0, 20.); });
  };
  const std::vector<double> found = history(true);
  EXPECT_LT(largest_difference(found, history(false)), 1e-12);
  EXPECT_GT(largest(found), 1e-3);
  EXPECT_GT(largest_difference(found, history_of(rail(true, true), {},
                                                 [](const taut::StepView &view)
                                                 { return displacement(view, 0, 20.); })),
            1e-6);

  Session session(with_tension(rail(true, true)));
  const std::vector<taut::LineConstants> lines = taut::line_constants(session.simulation().scene());
  ASSERT_EQ(lines.size(), 1u);
  const double c = lines[0].wave_speed, omega = 40. * std::acos(-1.);
  EXPECT_NEAR(10. * std::pow(c, 4) - 1500. * c * c, 2.1e5 * omega * omega,
              1e-9 * 2.1e5 * omega * omega);
  EXPECT_NEAR(lines[0].doppler, (c - 30.) / (c + 30.), 1e-12);
}

// Timoshenko's critical speed bounds what may run on a bedding, and makes the constants of the line
// at the largest of speeds that change. Without bending it is that of the string.
TEST(BeddedWire, has_one_speed_of_waves_for_refusals_and_constants)
{
  const auto scene = [](const double bending, const std::string &speed)
  {
    return "Gravity = 0, 0\nWire line: From = 0, 0; To = 100, 0; Components = " +
           std::string(bending > 0. ? "beam" : "string") +
           "; Mass per length = 2; Tension = 50; Foundation stiffness = 300; Element size = 0.5" +
           (bending > 0. ? "; Bending stiffness = " + number(bending) : "") +
           "\nSupport ends: Wire = line; Positions = 0, 100\n"
           "Mass head: Position = 5, 0; Mass = 1; Weight = false\n"
           "Link contact: Type = sliding contact; From = head; To = line @ 5; Direction = 0, 1; "
           "Speed = " +
           speed + "\nTime: Step = 1e-3; End = 0.5\n";
  };
  for (const double bending : {0., 12., 700.})
  {
    const double c = std::sqrt((50. + 2. * std::sqrt(300. * bending)) / 2.);
    for (const bool changes : {false, true})
    {
      const auto speed = [&](const double part)
      { return changes ? number(2. * part * c) + " * t" : number(part * c); };
      Session slow(scene(bending, speed(.99)));
      const auto lines = taut::line_constants(slow.simulation().scene());
      ASSERT_EQ(lines.size(), 1u);
      EXPECT_NEAR(lines[0].wave_speed, c, 1e-12 * c);
      EXPECT_NEAR(lines[0].speed, .99 * c, 1e-9 * c);
      EXPECT_NEAR(lines[0].doppler, .01 / 1.99, 1e-9);
      const std::string error = error_of([&] { Session(scene(bending, speed(1.01))); });
      EXPECT_TRUE(has(error, "speed of the waves of wire 'line'")) << error;
      Session fast(scene(bending, speed(1.01) + "; Faster than waves = true"));
      EXPECT_EQ(taut::line_constants(fast.simulation().scene())[0].doppler, 0.);
    }
  }
}
