// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: springs, dampers and joints between masses, and joints on a support that moves, are those
// of textbooks. Sources: two masses with a spring and a damper between them and no force from
// outside keep their momentum, and their distance is a damped oscillator of the reduced mass; a
// mass on a spring whose other end moves by a (1 - cos omega t) moves by a [1 - (Omega^2 cos omega
// t - omega^2 cos Omega t)/(Omega^2 - omega^2)]; so does one with a damper beside the spring, as
// the complex amplitude of a base-excited oscillator and its free motion say.
#include "scene_tests.h"

#include "scene/network_entries.h"

#include <complex>

using namespace verification;

TEST(Oscillator, two_masses_on_one_spring_and_damper)
{
  const double m1 = 2., m2 = 3., k = 120., c = 3., V = .4, v = -.1;
  const char *const scene =
      R"(Gravity = 0, 0; Start = given
Mass one: Position = 0, 0; Mass = 2; Motions = y; Initial velocity = 0, 0.4, 0
Mass two: Position = 0, 1; Mass = 3; Motions = y; Initial velocity = 0, -0.1, 0
Spring spring: From = one; To = two; Direction = 0, 1; Stiffness = 120; Damping = 3
Time: Scheme = Newmark; Step = 2e-4; End = 2
)";
  const double mu = m1 * m2 / (m1 + m2), decay = .5 * c / mu,
               omega = std::sqrt(k / mu - decay * decay);
  double error = 0., size = 0.;
  run_scene(scene, {},
            [&](const taut::StepView &view)
            {
              const double t = view.state.time;
              const double distance = (v - V) / omega * std::exp(-decay * t) * std::sin(omega * t),
                           middle = (m1 * V + m2 * v) / (m1 + m2) * t;
              const std::vector<double> &u = view.state.U[0];
              error = std::max({error, std::fabs(u[0] - (middle - m2 / (m1 + m2) * distance)),
                                std::fabs(u[1] - (middle + m1 / (m1 + m2) * distance))});
              raise(size, distance);
            });
  figure("two masses on a spring and damper, largest error over the largest elongation",
         error / size);
  EXPECT_LT(error, 1e-4 * size);
}

TEST(Oscillator, mass_on_a_support_that_moves)
{
  const double m = 2., k = 800., a = .01, omega = 8., Omega = std::sqrt(k / m);
  const char *const scene =
      R"(Gravity = 0, 0; Start = equilibrium
Wire wire: To = 4, 0; Components = string; Mass per length = 1; Tension = 1000; Element size = 0.5
Support moving: Wire = wire; Positions = 0; Displacement = 0.01*(1-cos(8*t))
Support end: Wire = wire; Positions = 4
Mass mass: Position = 0, -1; Mass = 2; Motions = y
Link joint: Type = joint; From = mass; To = wire @ 0; Direction = 0, 1; Stiffness = 800
Time: Scheme = Newmark; Step = 2e-4; End = 2
)";
  double error = 0., force_error = 0., gap_error = 0.;
  run_scene(scene, {},
            [&](const taut::StepView &view)
            {
              const double t = view.state.time;
              const double support = a * (1. - std::cos(omega * t)),
                           u = a * (1. - (Omega * Omega * std::cos(omega * t) -
                                          omega * omega * std::cos(Omega * t)) /
                                             (Omega * Omega - omega * omega));
              raise(error, view.state.U[1][0] - u);
              raise(force_error, view.state.multiplier[0] - k * (u - support));
              raise(gap_error, view.state.distance[0] - (support - view.state.U[1][0]));
            });
  figure("mass on a support that moves, largest error over the way of the support", error / a);
  figure("mass on a support that moves, largest error of the force", force_error, "N");
  EXPECT_LT(error, 1e-4 * a);
  EXPECT_LT(force_error, 1e-4 * k * a);
  EXPECT_LT(gap_error, 1e-14);
}

// The spring carries m g below a support that has sunk by 2 cm; its end is a held unknown.
TEST(Oscillator, mass_hangs_at_rest_below_a_sunken_support)
{
  const char *const scene =
      R"(Gravity = 0, -9.81; Start = equilibrium
Wire wire: To = 4, 0; Components = string; Mass per length = 1; Tension = 1000; Element size = 0.5
Support sunken: Wire = wire; Positions = 0; Displacement = -0.02
Support end: Wire = wire; Positions = 4
Mass mass: Position = 0, -1; Mass = 2; Motions = y
Link joint: Type = joint; From = mass; To = wire @ 0; Direction = 0, 1; Stiffness = 800
Time: Step = 1e-3; End = 1e-3
)";
  const double weight = 2. * 9.81;
  run_scene(scene, {},
            [&](const taut::StepView &view)
            {
              EXPECT_NEAR(view.reference.displacement[1][0] + view.state.U[1][0],
                          -.02 - weight / 800., 1e-14);
              EXPECT_NEAR(view.state.multiplier[0], -weight, 1e-10);
            });
}

// Claim: a step that brings a body back from afar does not end with the rounding of its way.
// Expected: one step of backward Euler of two joined masses, each on
// a spring, ((m1 + m2)/step^2 + k1 + k2) u = P + (m1 + m2) u0/step^2.
TEST(Oscillator, a_step_from_afar_ends_as_accurately_as_any)
{
  const double m1 = 1., m2 = 3., k1 = 1000., k2 = 3000., P = 1e-9, u0 = 10., step = 1e6;
  const char *const scene =
      R"(Gravity = 0, 0; Start = given
Mass one: Position = 0, 0; Mass = 1; Motions = y; Initial displacement = 0, 10, 0
Mass two: Position = 0, 1; Mass = 3; Motions = y; Initial displacement = 0, 10, 0
Spring first: From = ground; To = one; Direction = 0, 1; Stiffness = 1000
Spring second: From = ground; To = two; Direction = 0, 1; Stiffness = 3000
Load push: On = one; Direction = 0, 1; Magnitude = 1e-9
Link joint: Type = joint; From = one; To = two; Direction = 0, 1; Stiffness = rigid
Time: Scheme = backward Euler; Step = 1e6; End = 1e6
)";
  const double m = (m1 + m2) / (step * step), u = (P + m * u0) / (m + k1 + k2);
  run_scene(scene, {},
            [&](const taut::StepView &view)
            {
              if (view.state.time == 0.)
                return;
              EXPECT_NEAR(view.state.U[0][0], u, 1e-9 * u);
              EXPECT_NEAR(view.state.U[1][0], u, 1e-9 * u);
              const double N = k2 * u + m2 / (step * step) * (u - u0);
              EXPECT_NEAR(std::fabs(view.state.multiplier[0]), N, 1e-9 * N);
              EXPECT_NEAR(view.state.distance[0], 0., 1e-9 * u);
            });
}

namespace
{
  /// A mass on a spring and a damper, whose other end is a mass with this prescribed motion.
  std::string mass_on_a_base(const std::string &motion)
  {
    return "Gravity = 0, 0; Start = equilibrium\nMass base: Position = 3, 0; " + motion +
           "\nMass mass: Position = 3, 1; Mass = 2; Motions = y\n"
           "Spring spring: From = base; To = mass; Direction = 0, 1; Stiffness = 800; Damping = 6\n"
           "Time: Scheme = Newmark; Step = 2e-4; End = 2\n";
  }

  std::vector<double> motion_of_the_mass(const std::string &motion)
  {
    std::vector<double> result;
    run_scene(mass_on_a_base(motion), {},
              [&](const taut::StepView &view)
              { result.push_back(displacement(view, point_of_mass(view, 1))); });
    return result;
  }
} // namespace

TEST(Oscillator, mass_on_a_base_that_moves)
{
  using Complex = std::complex<double>;
  const double m = 2., k = 800., c = 6., a = .01, omega = 8.;
  const Complex i(0., 1.);
  // m u" + c u' + k u = k b + c b' under b = a (1 - cos omega t), from rest.
  const Complex H = (k + i * omega * c) / (k - m * omega * omega + i * omega * c);
  const double decay = .5 * c / m, natural = std::sqrt(k / m - decay * decay);
  const double u0 = -(a - a * H.real()), v0 = -a * omega * H.imag();
  const auto expected = [&](const double t)
  {
    const double forced = a - a * (H * std::exp(i * omega * t)).real(),
                 free =
                     std::exp(-decay * t) * (u0 * std::cos(natural * t) +
                                             (v0 + decay * u0) / natural * std::sin(natural * t));
    return forced + free;
  };
  const std::vector<double> of_time = motion_of_the_mass("Prescribed y = 0.01*(1 - cos(8*t))");
  double error = 0.;
  for (std::size_t n = 0; n < of_time.size(); ++n)
    raise(error, of_time[n] - expected(2e-4 * n));
  figure("mass on a base that moves, largest error over the way of the base", error / a);
  EXPECT_LT(error, 1e-4 * a);

  // The same base on a track: b(s) with s = 3 + 20 t, and with a speed in time whose way is known.
  const std::vector<double> of_place =
      motion_of_the_mass("Prescribed y = 0.01*(1 - cos(0.4*(s - 3))); Speed = 20");
  ASSERT_EQ(of_place.size(), of_time.size());
  const std::vector<double> of_speed =
      motion_of_the_mass("Prescribed y = 0.01*(1 - cos(8*sqrt((s - 3)/5))); Speed = 10*t");
  for (std::size_t n = 0; n < of_time.size(); ++n)
  {
    EXPECT_NEAR(of_place[n], of_time[n], 1e-13);
    EXPECT_NEAR(of_speed[n], of_time[n], 1e-11);
  }
}

// Claim: probes of velocity and acceleration have those of the motion. Source: u = a cos omega t.
TEST(Oscillator, probes_have_its_velocity_and_acceleration)
{
  const double a = .01, omega = 20.;
  const std::string scene =
      "Gravity = 0, 0; Start = given\n"
      "Mass mass: Position = 0, 0; Mass = 2; Motions = y; Initial displacement = 0, 0.01, 0\n"
      "Spring spring: From = ground; To = mass; Stiffness = 800\n"
      "Output: Probes = place, speed, acceleration\n"
      "Output/Probe place: Point = mass\n"
      "Output/Probe speed: Point = mass; Quantity = velocity\n"
      "Output/Probe acceleration: Point = mass; Quantity = acceleration\n"
      "Time: Scheme = generalised-alpha; Step = 2e-4; End = 0.5\n";
  double errors[3] = {};
  Session session(scene, {"Output/Interval=0"});
  session.run(
      [&](const taut::StepView &view)
      {
        const double t = view.state.time;
        const double expected[] = {a * std::cos(omega * t), -a * omega * std::sin(omega * t),
                                   -a * omega * omega * std::cos(omega * t)};
        for (int k = 0; k < 3; ++k)
          if (t > 0.)
            raise(errors[k], view.probes[k] - expected[k]);
      });
  const double sizes[] = {a, a * omega, a * omega * omega};
  for (int k = 0; k < 3; ++k)
    EXPECT_LT(errors[k], 2e-3 * sizes[k]) << k;
  const auto table = read_table(session.folder() + "/probes.csv");
  EXPECT_EQ(table.count("speed [m/s]"), 1u);
  EXPECT_EQ(table.count("acceleration [m/s^2]"), 1u);
  EXPECT_TRUE(has(session.log(), "Probes along their directions: largest, smallest"))
      << session.log();
  EXPECT_TRUE(has(session.log(), "m/s^2")) << session.log();
  const auto entries = taut::network_entries(session.simulation().scene());
  EXPECT_EQ(std::count_if(entries.begin(), entries.end(),
                          [](const taut::WrittenEntry &entry)
                          { return entry.path.back() == "Quantity"; }),
            2);
}
