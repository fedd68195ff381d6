// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: a place that is prescribed has the place and velocity of its formula or table, in every
// scheme, at the start, at kinks and after a changed step. What it hits, pulls and shakes does what
// textbooks say. Sources: Newton's restitution; a mass on a rigid rope that is wound up with a
// constant speed; d'Alembert's wave of a string that is shaken at one end, T u'(t)/c; oscillators
// on a base, by Duhamel's integral.
#include "scene_tests.h"

using namespace verification;

namespace
{
  const std::vector<std::string> schemes = {
      "Scheme = backward Euler",
      "Scheme = BDF2",
      "Scheme = Newmark",
      "Scheme = generalised-alpha",
      "Scheme = HHT",
      "Scheme = Moreau-Jean",
      "Scheme = Moreau-Jean\nTime/Moreau-Jean: Conditions = velocities",
      "Scheme = Moreau-Jean\nTime/Moreau-Jean: Conditions = gaps"};

  /// Velocity of a DoF of a body.
  double velocity(const taut::StepView &view, const std::size_t body, const std::size_t dof = 0)
  {
    return view.state.V[body][dof];
  }

  std::string wall_and_mass(const double e, const std::string &time)
  {
    return "Gravity = 0, 0; Start = given\n"
           "Mass wall: Position = 0, -0.01; Motions =; Mass = 1; Prescribed y = t\n"
           "Mass m: Mass = 1\n"
           "Link s: Type = stop; From = wall; To = m; Direction = 0, 1; Gap = 0.01\n"
           "Time: Step = 1e-4; End = 0.11; Allow unsuitable scheme = true\n" +
           time + "\nTime/Moreau-Jean: Restitution = " + number(e) + '\n';
  }
} // namespace

TEST(PrescribedMotion, a_wall_that_hits_a_mass_throws_it_by_restitution)
{
  for (const double e : {0., .2, .5, 1.})
    for (const std::string time :
         {"", "Time/Moreau-Jean: Conditions = velocities", "Time: Step control = adaptive"})
    {
      double last = 0.;
      run_scene(wall_and_mass(e, time), {},
                [&](const taut::StepView &view) { last = velocity(view, 1); });
      EXPECT_NEAR(last, 1. + e, 1e-9) << e << ' ' << time;
    }
}

// The same of rotations, between a shaft and a flywheel of another inertia, from a table.
TEST(PrescribedMotion, a_shaft_that_hits_a_flywheel_throws_it_by_restitution)
{
  const std::string table = testing::TempDir() + "shaft.csv";
  std::ofstream(table) << "t,angle\n0,0\n0.02,0\n1,1.96\n";
  double last = 0.;
  run_scene("Gravity = 0, 0; Start = given\n"
            "Mass shaft: Motions = rotation; Mass = 1; Inertia = 3; Prescribed rotation = table(" +
                table +
                ", angle, t)\n"
                "Mass wheel: Motions = rotation; Mass = 1; Inertia = 0.5\n"
                "Link stop: Type = stop; From = shaft; To = wheel; Rotational = true; Gap = 0.1\n"
                "Time: Step = 1e-3; End = 0.3\nTime/Moreau-Jean: Restitution = 0.7\n",
            {}, [&](const taut::StepView &view) { last = velocity(view, 1); });
  EXPECT_NEAR(last, 2. * 1.7, 1e-9);
}

TEST(PrescribedMotion, a_winch_lifts_its_load_by_its_weight)
{
  const std::string scene =
      "Gravity = 0, -9.81; Start = given\n"
      "Mass hook: Position = 0, 1; Motions =; Mass = 1; Weight = false; Prescribed y = 0.5*t\n"
      "Mass m: Mass = 2; Initial velocity = 0, 0.5, 0\n"
      "Link rope: Type = dropper; From = hook; To = m; Direction = 0, -1; Stiffness = rigid\n"
      "Time: Step = 1e-4; End = 0.5; Allow unsuitable scheme = true\n";
  for (const std::string time : {"", "Time: Scheme = backward Euler", "Time: Scheme = BDF2",
                                 "Time: Scheme = Moreau-Jean\n"
                                 "Time/Moreau-Jean: Conditions = velocities",
                                 "Time: Scheme = Moreau-Jean\nTime/Moreau-Jean: Conditions = gaps; "
                                 "Theta = 1"})
  {
    double force = 0., place = 0.;
    run_scene(scene + time + '\n', {},
              [&](const taut::StepView &view)
              {
                const double t = view.state.time;
                if (t > 3e-4) // a scheme may start with backward Euler
                  raise(force, view.state.multiplier[0] - 19.62);
                raise(place, view.state.U[1][0] - .5 * t);
              });
    EXPECT_LT(force, 1e-6) << time;
    EXPECT_LT(place, 1e-9) << time;
  }
}

// A winch that speeds up: 2 (g + a) with a = 3 sin(4 t) m/s^2.
TEST(PrescribedMotion, a_winch_that_speeds_up_pulls_with_inertia)
{
  double force = 0.;
  run_scene("Gravity = 0, -9.81; Start = given\n"
            "Mass hook: Position = 0, 1; Motions =; Mass = 1; Prescribed y = 3/4*(t-sin(4*t)/4)\n"
            "Mass m: Mass = 2\n"
            "Link rope: Type = dropper; From = hook; To = m; Direction = 0, -1\n"
            "Time: Step = 1e-3; End = 2\n",
            {},
            [&](const taut::StepView &view)
            {
              const double t = view.state.time - 5e-4; // a mean over the step
              if (view.state.time > 0.)
                raise(force, view.state.multiplier[0] - 2. * (9.81 + 3. * std::sin(4. * t)));
            });
  EXPECT_LT(force, 1e-4);
}

TEST(PrescribedMotion, a_support_that_moves_at_once_sends_its_wave)
{
  const std::string scene =
      "Gravity = 0, 0; Start = given\n"
      "Wire w: To = 20, 0; Components = beam; Bending stiffness = 0.01; Mass per length = 1; "
      "Tension = 1000; Weight = false; Element size = 0.25; Stiffness damping = 0.0001\n"
      "Support r: Wire = w; Positions = 20\n"
      "Support l: Wire = w; Positions = 0; Displacement = 0.02*sin(20*t)\n"
      "Mass m: Position = 0, 5; Mass = 1; Initial velocity = 0, -.1, 0\n"
      "Link o: Type = stop; From = ground; To = m; Direction = 0, 1; Gap = 0.01\n"
      "Time: End = 0.3; Step = ";
  const double c = std::sqrt(1000.);
  for (const double step : {1e-3, 2e-4, 5e-5})
  {
    double error = 0., rate = 0.;
    run_scene(scene + number(step) + '\n', {},
              [&](const taut::StepView &view)
              {
                const double t = view.state.time, u1 = .4 * std::cos(20. * t);
                raise(rate, view.state.V[0][0] - u1);
                if (t > .03) // the front leaves elements behind that ring
                  raise(error, std::fabs(view.supports[1]) - std::fabs(1000. * u1 / c));
              });
    EXPECT_LT(rate, 1e-7) << step;
    EXPECT_LT(figure("support that moves at once, largest error of its force, step " + number(step),
                     error, "N"),
              .02 * 12.65)
        << step;
  }
}

TEST(PrescribedMotion, has_the_velocity_of_its_motion_in_all_schemes)
{
  // A kink at 0.0503 s inside of a step and one at 0.08 s at its end; a table and a formula.
  const std::string table = testing::TempDir() + "kinks.csv";
  std::ofstream(table) << "t,y\n0,0\n0.0503,0.1\n0.08,0.1\n1,-0.5\n";
  for (const std::string &scheme : schemes)
    for (const std::string control : {"fixed", "adaptive"})
    {
      double error = 0., place = 0.;
      const auto slope = [](const double t) {
        return t < .0503 ? .1 / .0503 : t < .08 - 1e-12 ? 0. : -.6 / .92;
      };
      run_scene(
          "Gravity = 0, 0; Start = given\n"
          "Mass a: Motions =; Mass = 1; Prescribed y = table(" +
              table +
              ", y, t)\n"
              "Mass b: Position = 1, 0; Motions = y; Mass = 2; Prescribed x = 0.1*sin(30*t)\n"
              "Spring s: From = a; To = b; Stiffness = 1000; Damping = 5\n"
              "Time: Step = 2e-3; End = 0.2; Allow unsuitable scheme = true; Step control = " +
              control + "\nTime: " + scheme + '\n',
          {},
          [&](const taut::StepView &view)
          {
            const double t = view.state.time;
            raise(error, view.state.V[0][0] - slope(t));
            raise(error, view.state.V[0][1] - 3. * std::cos(30. * t));
            raise(place, view.state.U[0][1] - .1 * std::sin(30. * t));
          });
      EXPECT_LT(error, 1e-6) << scheme << ' ' << control;
      EXPECT_LT(place, 1e-14) << scheme << ' ' << control;
    }
}

namespace
{
  /// Motion of a mass of 1 kg on a spring of 400 N/m and a damper of 40 N s/m, critically damped,
  /// after a rate of 1 m/s of its base begins at t = 0: u'' = 400 (b - u) + 40 (b' - u').
  double after_kink(const double t)
  {
    return t <= 0. ? 0. : t - t * std::exp(-20. * t);
  }
} // namespace

TEST(PrescribedMotion, a_ramp_of_a_base_is_followed_with_its_energy)
{
  const std::string table = testing::TempDir() + "ramp.csv";
  std::ofstream(table) << "t,y\n0,0\n0.3003,0\n0.3504,0.01\n5,0.01\n";
  const double rate = .01 / .0501;
  for (const std::string scheme : {"automatic", "BDF2", "Newmark", "HHT", "Moreau-Jean"})
  {
    double error = 0.;
    Session session("Gravity = 0, 0; Start = given\n"
                    "Mass b: Position = 0, -1; Motions =; Mass = 1; Prescribed y = table(" +
                        table +
                        ", y, t)\nMass m: Mass = 1\n"
                        "Spring k: From = b; To = m; Stiffness = 400; Damping = 40\n"
                        "Time: Step = 0.002; End = 1; Scheme = " +
                        scheme + '\n',
                    {"Output/Observers=energy"});
    std::vector<double> energy;
    session.run(
        [&](const taut::StepView &view)
        {
          const double t = view.state.time,
                       exact = rate * (after_kink(t - .3003) - after_kink(t - .3504));
          raise(error, view.state.U[0][1] - exact);
        });
    figure("ramp of a base by " + scheme + ", largest error over the ramp", error / .01);
    EXPECT_LT(error, (scheme == "BDF2" ? 1.5e-3 : 5e-4) * .01) << scheme;
    EXPECT_FALSE(has(session.log(), "Warning")) << session.log();
  }
}

TEST(PrescribedMotion, a_jump_acts_through_springs_and_dampers_and_is_in_the_log)
{
  // A base jumps by J: the spring swings by J (1 - cos), the damper gives the velocity c J / m.
  const double J = .01, omega = 20., t0 = .1003;
  const auto run = [&](const std::string &damping, const double step, std::string *const log,
                       const std::function<double(double)> &exact)
  {
    Session session(
        "Gravity = 0, 0; Start = given\n"
        "Mass b: Position = 0, -1; Motions =; Mass = 1; Prescribed y = t < 0.1003 ? 0 : "
        "0.01\nMass m: Mass = 1\n"
        "Spring k: From = b; To = m; Stiffness = 400; Damping = " +
        damping + "\nTime: End = 0.5; Step = " + number(step) + '\n');
    double error = 0.;
    session.run(
        [&](const taut::StepView &view)
        {
          if (view.state.time > t0 + 4. * step)
            raise(error, view.state.U[0][1] - exact(view.state.time - t0));
          EXPECT_EQ(view.state.V[0][0], 0.);
        });
    if (log)
      *log = session.log();
    return error;
  };
  std::string log;
  const auto undamped = [&](const double t) { return J * (1. - std::cos(omega * t)); };
  const double coarse = run("0", 1e-3, &log, undamped), fine = run("0", 2.5e-4, nullptr, undamped);
  EXPECT_LT(coarse, .02 * J);
  EXPECT_LT(fine, .006 * J);
  EXPECT_TRUE(has(log, "Prescribed motions jump in 1 step: at t = 0.1003 s 'b")) << log;
  EXPECT_TRUE(has(log, "jumps by 0.01 m")) << log;
  EXPECT_FALSE(has(log, "Warning")) << log;
  // u'' = 400 (b - u) + 4 (b' - u'), decay 2 1/s.
  const double w = std::sqrt(396.);
  const auto damped = [&](const double t)
  { return J * (1. - std::exp(-2. * t) * (std::cos(w * t) - 2. / w * std::sin(w * t))); };
  EXPECT_LT(run("4", 1e-3, nullptr, damped), .03 * J);
  EXPECT_LT(run("4", 2.5e-4, nullptr, damped), .008 * J);
}

// With gaps, then velocities, the wall puts the mass beside itself without a velocity. With forces
// alone it would throw the mass by its way over the step: such energy is an error.
TEST(PrescribedMotion, a_jump_against_a_rigid_stop_gives_no_impulse_or_is_an_error)
{
  const std::string scene =
      "Gravity = 0, 0; Start = given\n"
      "Mass wall: Position = 0, -0.01; Motions =; Mass = 1; Prescribed y = t < 0.05 ? 0 : "
      "0.02\nMass m: Mass = 1\n"
      "Link s: Type = stop; From = wall; To = m; Direction = 0, 1; Gap = 0.01\n"
      "Time: Step = 1e-3; End = 0.1; Allow unsuitable scheme = true\n";
  double last = 1., place = 0.;
  const std::string log = log_of(scene, {},
                                 [&](const taut::StepView &view)
                                 {
                                   last = velocity(view, 1);
                                   place = view.state.U[1][0];
                                 });
  EXPECT_NEAR(last, 0., 1e-12);
  EXPECT_NEAR(place, .01, 1e-12);
  EXPECT_TRUE(has(log, "'wall' jumps by 0.02 m")) << log;
  const std::string text = error_of([&] { log_of(scene + "Time: Scheme = backward Euler\n"); });
  EXPECT_TRUE(has(text, "unilateral links gave 50 J")) << text;
}

TEST(PrescribedMotion, contradicting_starts_are_errors)
{
  const auto error = [](const std::string &start, const std::string &motion)
  {
    return error_of(
        [&]
        {
          Session("Gravity = 0, 0; Start = given\nMass a: Motions =; Mass = 1; Prescribed y = " +
                  motion + "; " + start + "\nTime: Step = 1e-3; End = 0.01\n")
              .run();
        });
  };
  EXPECT_EQ(error("Initial velocity = 0, 0.5, 0", "0.5*t"), "");
  EXPECT_EQ(error("Initial velocity = 0, 0, 0", "0.5*t"), "");
  const std::string text = error("Initial velocity = 0, 0.4, 0", "0.5*t");
  EXPECT_TRUE(has(text, "Initial velocity")) << text;
  EXPECT_TRUE(has(text, "0.4 m/s, and its Prescribed y has 0.5 m/s")) << text;
  EXPECT_TRUE(has(error("Initial velocity = 0, 1, 0", "3"), "has 0 m/s"));
  EXPECT_TRUE(has(error("Initial displacement = 0, 1, 0", "2+t"), "has 2 m at t = 0"));
  EXPECT_TRUE(has(error_of([] { Session("Mass a: Motions =; Mass = 1\n"); }), "Motions"));
}
