// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: the load of prm/swinging_load_on_guys.prm hangs, swings and is stopped by its guys as its
// head expects. Expected values: elastic catenaries that meet at the load; a pendulum; three
// springs without mass that only pull; the balance of energy; linear vibrations about its rest.
#include "cable/joined_catenaries.h"
#include "cable/places_in_steps.h"
#include "verification/scene_tests.h"

#include <boost/numeric/odeint/stepper/runge_kutta4.hpp>

namespace
{
  using namespace verification;
  using namespace taut;

  constexpr double mass = 200., g = 9.81, EA = 2e5, mass_per_length = .08, eta = 400., pull = 1800.;
  constexpr std::size_t n_guys = 3;
  const Coordinates supports[n_guys] = {{8., 0., 0.}, {-4., 1.5, 7.}, {-5., -.5, -6.}};
  constexpr double lengths[n_guys] = {12.8, 14., 12.3};
  const Coordinates start_of_load = {0., -10., 0.};

  JoinedCatenaries at_rest(const Coordinates &force)
  {
    JoinedCatenaries system;
    system.places = {{1., -9., -.1}, supports[0], supports[1], supports[2]};
    system.n_free = 1;
    system.loads = {add_scaled({0., -mass * g, 0.}, 1., force)};
    for (std::size_t k = 0; k < n_guys; ++k)
      system.cables.push_back({0, k + 1, lengths[k], EA, {0., -mass_per_length * g, 0.}});
    return system;
  }

  Coordinates place_of_load(const StepView &step)
  {
    return displaced(step, step.scene.probes[0].point, start_of_load);
  }

  Coordinates force_of(const StepView &step, const std::size_t guy)
  {
    const double *const N = step.state.multiplier.data() + 3 * guy;
    return {N[0], N[1], N[2]};
  }

  using Swing = std::array<double, 6>; ///< place and velocity

  Coordinates place_of(const Swing &y)
  {
    return {y[0], y[1], y[2]};
  }

  /// Rates of the load on springs and dampers without mass that only pull; a third of the mass of
  /// the ropes moves with it, and half of it hangs on it.
  void rates_on_springs(const Swing &y, Swing &rates, const double /*time*/)
  {
    const double ropes = mass_per_length * (lengths[0] + lengths[1] + lengths[2]);
    Coordinates force = {0., -(mass + ropes / 2.) * g, 0.};
    for (std::size_t k = 0; k < n_guys; ++k)
    {
      const Coordinates d = place_of(y) - supports[k];
      const double l = norm(d), strain = l / lengths[k] - 1.,
                   rate = dot(d, {y[3], y[4], y[5]}) / (l * lengths[k]);
      if (strain > 0.)
        force = add_scaled(force, -(EA * strain + eta * rate) / l, d);
    }
    const double m = mass + ropes / 3.;
    rates = {y[3], y[4], y[5], force.x / m, force.y / m, force.z / m};
  }

  /// When the pendulum on the northern and southern guy, unstretched, has straightened the eastern.
  double time_on_two_guys(const Coordinates &start)
  {
    const Coordinates line = supports[2] - supports[1],
                      axis = add_scaled({}, 1. / norm(line), line);
    const auto across = [&](const Coordinates &a) { return add_scaled(a, -dot(a, axis), axis); };
    // The circle of places that are as far from both supports as the guys are long.
    const double along = (lengths[1] * lengths[1] - lengths[2] * lengths[2] + dot(line, line)) /
                         (2. * norm(line)),
                 r = std::sqrt(lengths[1] * lengths[1] - along * along);
    const Coordinates center = add_scaled(supports[1], along, axis), gravity = across({0., -g, 0.}),
                      down = add_scaled({}, 1. / norm(gravity), gravity), aside = cross(axis, down);
    const auto at = [&](const double angle) {
      return add_scaled(add_scaled(center, r * std::cos(angle), down), r * std::sin(angle), aside);
    };
    const Coordinates from = start - center;
    const double first = std::atan2(dot(from, aside), dot(from, down));
    double last = first; // the angle at which the third guy is straight
    while (norm(at(last) - supports[0]) < lengths[0])
      last += first > 0. ? -1e-6 : 1e-6;
    // theta = first cos(u) takes the singularity of the first moment away.
    const double end = std::acos(last / first), w2 = norm(gravity) / r;
    const int n = 20000;
    double t = 0.;
    for (int i = 0; i < n; ++i)
    {
      const double u = end * (i + .5) / n;
      t += end / n * std::fabs(first) * std::sin(u) /
           std::sqrt(2. * w2 * (std::cos(first * std::cos(u)) - std::cos(first)));
    }
    return t;
  }

} // namespace

TEST(SwingingLoad, at_rest_by_catenaries)
{
  JoinedCatenaries exact = at_rest({pull, 0., 0.});
  ASSERT_LT(exact.solve(), 1e-8);
  run_scene(scene_file("swinging_load_on_guys"), {"Time.End=0"},
            [&](const StepView &step)
            {
              const double error = norm(place_of_load(step) - exact.places[0]);
              figure("place of the load on three guys", error, "m");
              EXPECT_LT(error, 2e-5);
              for (std::size_t k = 0; k < n_guys; ++k)
              {
                const Coordinates force = exact.pull(exact.cables[k]);
                figure("pull of a guy", norm(force), "N");
                EXPECT_LT(norm(force_of(step, k) - force), 2e-2) << k;
              }
            });
  EXPECT_LT(norm(exact.places[0] - Coordinates{3.1189, -8.0882, -.4924}), 1e-4);
}

TEST(SwingingLoad, guys_take_it_in_turn)
{
  JoinedCatenaries exact = at_rest({pull, 0., 0.});
  ASSERT_LT(exact.solve(), 1e-8);
  const Coordinates start = exact.places[0];
  Swing springs = {start.x, start.y, start.z, 0., 0., 0.};
  double time = 0., straight = 0., error_before = 0., error_after = 0.;
  std::array<double, n_guys> largest{}, at{};
  Session session(scene_file("swinging_load_on_guys"), {"Output.Interval=0"});
  session.run(
      [&](const StepView &step)
      {
        // The force of the first step is the mean of 1800 N and none: half a step later.
        const double now = std::max(0., step.state.time - .0025);
        const int n = 50; // small against the vibrations on the guys
        boost::numeric::odeint::runge_kutta4<Swing> scheme;
        for (int i = 0; i < n; ++i)
          scheme.do_step(rates_on_springs, springs, time, (now - time) / n);
        time = now;
        const Coordinates place = place_of_load(step);
        double &error = time < 1.25 ? error_before : error_after;
        error = std::max(error, norm(place - place_of(springs)));
        if (straight == 0. && norm(place - supports[0]) > lengths[0])
          straight = time;
        for (std::size_t k = 0; k < n_guys; ++k)
        {
          const double force = norm(force_of(step, k));
          if (force > largest[k])
            at[k] = time;
          largest[k] = std::max(largest[k], force);
          EXPECT_TRUE(time <= 1.6 || time >= 2.2 || force < 200.) << time; // it flies
        }
      });
  // The log says which cables go slack and what keeps them in shape, each once.
  for (const std::string name : {"east", "north", "south"})
  {
    const std::string line = "Slack: body '" + name + "' first at t = ";
    const std::size_t at_line = session.log().find(line);
    ASSERT_NE(at_line, std::string::npos) << name;
    EXPECT_FALSE(has(session.log(), line, at_line + 1)) << name;
    const std::string rest =
        session.log().substr(at_line, session.log().find('\n', at_line) - at_line);
    EXPECT_TRUE(has(rest, "its Axial damping of 400 N s keeps it in shape")) << rest;
  }
  figure("load on guys, distance from that on springs before the first stop", error_before, "m");
  figure("load on guys, distance from that on springs after it", error_after, "m");
  EXPECT_LT(error_before, .01 * norm(place_of(springs) - start));
  EXPECT_LT(error_after, .1);
  const double pendulum = time_on_two_guys(start);
  figure("eastern guy is straight", straight, "s");
  figure("the same of the pendulum", pendulum, "s");
  EXPECT_NEAR(straight, pendulum, .01);
  EXPECT_NEAR(largest[0], 10.0e3, 300.);
  EXPECT_NEAR(at[0], 1.27, .015);
  EXPECT_NEAR(largest[2], 8.0e3, 300.);
  EXPECT_NEAR(at[2], 2.54, .015);
  const auto energy = read_table(session.folder() + "/energy.csv");
  const double balance = energy.at("error [J]").back() / energy.at("loads [J]").back();
  figure("energy balance of the load on guys over the work of its weight", std::fabs(balance));
  EXPECT_LT(std::fabs(balance), 1e-10);
}

// A small force: all guys stay taut, and the load vibrates about its place at rest with the
// stiffness that differences of catenaries have.
TEST(SwingingLoad, small_swings)
{
  JoinedCatenaries rest = at_rest({});
  ASSERT_LT(rest.solve(), 1e-8);
  const Coordinates center = rest.places[0];
  double K[3][3];
  for (std::size_t c = 0; c < 3; ++c)
  {
    // The force that a small motion needs.
    const double h = 1e-4;
    Coordinates sum[2];
    for (const int side : {0, 1})
    {
      Coordinates d;
      (c == 0 ? d.x : c == 1 ? d.y : d.z) = side == 0 ? h : -h;
      rest.places[0] = add_scaled(center, 1., d);
      for (const JoinedCatenaries::Cable &cable : rest.cables)
        sum[side] = add_scaled(sum[side], -1., rest.pull(cable));
    }
    for (std::size_t k = 0; k < 3; ++k)
      K[k][c] = (sum[0][k] - sum[1][k]) / (2. * h);
  }
  const double force = 20.,
               m = mass + mass_per_length * (lengths[0] + lengths[1] + lengths[2]) / 3.;
  JoinedCatenaries aside = at_rest({force, 0., 0.});
  ASSERT_LT(aside.solve(), 1e-8);
  const Coordinates first = aside.places[0] - center;
  std::array<double, 6> y = {first.x, first.y, first.z, 0., 0., 0.};
  double time = 0., worst = 0.;
  run_scene(
      scene_file("swinging_load_on_guys"),
      {"Network.Load pull.Magnitude=if(t <= 0, 20, 0)", "Body east.Axial damping=0",
       "Body north.Axial damping=0", "Body south.Axial damping=0", "Time.Step=2e-3",
       "Time.End=1.5"},
      [&](const StepView &step)
      {
        const double now = std::max(0., step.state.time - 1e-3);
        const int n = 40;
        const double h = (now - time) / n; // of the midpoint rule in staggered form
        for (int i = 0; i < n; ++i)
        {
          for (std::size_t k = 0; k < 3; ++k)
            y[k] += .5 * h * y[k + 3];
          for (std::size_t k = 0; k < 3; ++k)
            y[k + 3] -= h / m * (K[k][0] * y[0] + K[k][1] * y[1] + K[k][2] * y[2]);
          for (std::size_t k = 0; k < 3; ++k)
            y[k] += .5 * h * y[k + 3];
        }
        time = now;
        worst = std::max(worst, norm(place_of_load(step) - center - Coordinates{y[0], y[1], y[2]}));
      });
  figure("small swings on three guys, largest error over the first deflection",
         worst / norm(first));
  EXPECT_LT(worst, .01 * norm(first));
}
