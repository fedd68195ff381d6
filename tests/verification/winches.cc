// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: the length of a rope, prop or rod may change with time. Masses are where the length says,
// and the force is that of Newton's law with its second derivative; a pendulum whose rope is reeled
// in swings as its equation of motion says; what is reeled out faster than it falls is slack. A
// rope hauls a cable by its end.
// Sources: closed forms; the equation of motion of a pendulum of length L(t),
// L a'' + 2 L' a' + g sin a = 0, by Runge-Kutta's method; the elastic catenary (Irvine, Cable
// Structures, 1981).
#include "cable/places_in_steps.h"
#include "turning_scene.h"

#include <array>

using namespace turning;

namespace
{
  constexpr double m = 2., lift = .3; // L = 2 - 0.3 t^2

  Scene lifted(const std::string &entries, const double end)
  {
    Scene scene;
    scene.masses = {{m, {0., -2., 0.}, {}}};
    scene.links = {"Type = dropper; From = ground @ 0, 0; To = m0; " + entries};
    scene.end = end;
    return scene;
  }

  double length(const double t)
  {
    return 2. - lift * t * t;
  }

  const std::vector<Overrides> schemes = {
      {}, {"Time/Scheme=backward Euler"}, {"Time/Scheme=Moreau-Jean"}};

  /// Angle, and its rate, of a pendulum of length 1 - speed t.
  std::array<double, 2> swing(const double angle, const double speed, const double end)
  {
    using State = std::array<double, 2>;
    constexpr int n = 20000;
    const double h = end / n;
    const auto rate = [&](const double t, const State &x)
    {
      const double L = 1. - speed * t;
      return State{x[1], (2. * speed * x[1] - g * std::sin(x[0])) / L};
    };
    State x = {angle, 0.};
    for (int i = 0; i < n; ++i)
    {
      const auto shifted = [&](const double s, const State &k) {
        return State{x[0] + s * k[0], x[1] + s * k[1]};
      };
      const double t = i * h;
      const State a = rate(t, x), b = rate(t + .5 * h, shifted(.5 * h, a)),
                  c = rate(t + .5 * h, shifted(.5 * h, b)), d = rate(t + h, shifted(h, c));
      for (unsigned int j = 0; j < 2; ++j)
        x[j] += h / 6. * (a[j] + 2. * b[j] + 2. * c[j] + d[j]);
    }
    return x;
  }
} // namespace

TEST(Winches, mass_that_is_lifted_is_where_the_length_says)
{
  for (const Overrides &scheme : schemes)
    for (const std::string type : {"dropper", "joint"})
    {
      double place = 0., force = 0.;
      Scene scene = lifted("Length = 2-0.3*t^2", 1.);
      if (type == "joint")
        scene.links[0].replace(scene.links[0].find("dropper"), 7, type);
      scene.run(
          [&](const Motion &now)
          {
            verification::raise(place, now.place[0].y + length(now.time));
            if (now.time > .1) // the start has no acceleration
              verification::raise(force, std::fabs(now.multiplier[0]) / (m * (g + 2. * lift)) - 1.);
          },
          scheme);
      SCOPED_TRACE(type + (scheme.empty() ? std::string() : ", " + scheme[0]));
      EXPECT_LE(verification::figure("mass that is lifted, error of its place [m]", place), 1e-9);
      EXPECT_LE(verification::figure("mass that is lifted, error of the force", force), 1e-3);
    }
}

TEST(Winches, mass_on_a_spring_swings_about_where_the_length_says)
{
  constexpr double k = 2e4;
  const double omega = std::sqrt(k / m);
  double error = 0.;
  lifted("Length = 2-0.3*t^2; Stiffness = " + number(k), 1.)
      .run(
          [&](const Motion &now)
          {
            const double stretch = m / k * (g + 2. * lift * (1. - std::cos(omega * now.time)));
            verification::raise(error, now.place[0].y + length(now.time) + stretch);
          },
          {"Time/Step=2e-4"});
  EXPECT_LE(verification::figure("mass on a spring that is lifted, error over its swing",
                                 error * k / (2. * lift * m)),
            .02);
}

TEST(Winches, pendulum_that_is_reeled_in_follows_its_equation)
{
  constexpr double angle = .5, speed = .2, end = 2.;
  const std::array<double, 2> expected = swing(angle, speed, end);
  const auto error = [&](const double step, const Overrides &scheme)
  {
    double result = 0.;
    Scene scene = thrown({{m,
                           {std::sin(angle), -std::cos(angle), 0.},
                           {-speed * std::sin(angle), speed * std::cos(angle), 0.}}},
                         {rope("ground @ 0, 0", "m0", 1.)}, end, step);
    scene.links[0] += "-" + number(speed) + "*t";
    scene.run([&](const Motion &now)
              { result = std::atan2(now.place[0].x, -now.place[0].y) - expected[0]; },
              scheme);
    return std::fabs(result);
  };
  const double fine = error(1e-3, {}), rough = error(2e-3, {});
  EXPECT_LE(verification::figure("pendulum that is reeled in, error of its angle", fine), 1e-4);
  EXPECT_GE(rough / fine, 3.); // of second order
  EXPECT_LE(error(1e-3, {"Time/Scheme=backward Euler"}), 2e-2);
}

TEST(Winches, what_is_reeled_out_faster_than_it_falls_is_slack)
{
  for (const Overrides &scheme : schemes)
  {
    double place = 0., force = 0.;
    lifted("Length = 2+6*t^2", .5)
        .run(
            [&](const Motion &now)
            {
              verification::raise(place, now.place[0].y + 2. + .5 * g * now.time * now.time);
              if (now.time > .05) // the first steps of a scheme with numerical damping fall farther
                verification::raise(force, now.multiplier[0]);
            },
            scheme);
    EXPECT_LE(place, 1e-2);
    EXPECT_EQ(force, 0.);
  }
}

// A prop that grows pushes a mass up.
TEST(Winches, prop_that_grows_lifts)
{
  Scene scene;
  scene.masses = {{m, {0., 1., 0.}, {}}};
  scene.links = {"Type = stop; From = ground @ 0, 0; To = m0; Length = 1+0.3*t^2"};
  scene.start = "undeformed"; // a prop is no stable equilibrium
  scene.end = 1.;
  double place = 0.;
  scene.run([&](const Motion &now)
            { verification::raise(place, now.place[0].y - 1. - lift * now.time * now.time); });
  EXPECT_LE(place, 1e-9);
}

// A cable from a support hangs by a rope, which is straight along the tangent at its end. The
// elastic catenary from the support has H along x and V + w s along y.
TEST(Winches, rope_hauls_a_cable_by_its_end)
{
  constexpr double L = 10.5, EA = 1e5, w = g, at = 12., rope = 1.6;
  const auto end_of_rope = [&](const double H, const double V, Coordinates &end_of_cable)
  {
    const double up = V + w * L, T = std::hypot(H, up);
    end_of_cable = {H * L / EA + H / w * (std::asinh(up / H) - std::asinh(V / H)),
                    (V * L + .5 * w * L * L) / EA + (T - std::hypot(H, V)) / w};
    return add_scaled(end_of_cable, rope / T, {H, up});
  };
  double H = 60., V = -.5 * w * L;
  Coordinates expected;
  for (int iteration = 0; iteration < 50; ++iteration)
  {
    constexpr double small = 1e-5;
    Coordinates other;
    const Coordinates e = end_of_rope(H, V, expected) - Coordinates{at, 0.},
                      a = end_of_rope(H + small, V, other) - Coordinates{at, 0.},
                      b = end_of_rope(H, V + small, other) - Coordinates{at, 0.};
    const double xH = (a.x - e.x) / small, yH = (a.y - e.y) / small, xV = (b.x - e.x) / small,
                 yV = (b.y - e.y) / small, D = xH * yV - xV * yH;
    H -= (e.x * yV - xV * e.y) / D;
    V -= (xH * e.y - yH * e.x) / D;
  }
  const double force = std::hypot(H, V + w * L);
  const auto scene = [&](const std::string &length, const std::string &time)
  {
    return "Gravity = 0, " + number(-g) +
           "; Start = equilibrium\n"
           "Body cable: Type = cable; From = 0, 0; To = 10, 0; Unstressed length = 10.5; "
           "Axial stiffness = 1e5; Mass per length = 1; Element = bar; Elements = 40; Held ends = "
           "from; Mass damping = 4\n"
           "Link rope: Type = dropper; Turns = true; From = cable @ 10.5, 0; To = ground @ 12, 0; "
           "Length = " +
           length + "\nTime: " + time + "\n";
  };
  // At rest, and hauled there from a longer rope.
  for (const std::string &text :
       {scene(number(rope), "End = 0"),
        scene("1.8-0.02*min(t,10)", "End = 16; Step = 2e-3; Check steps = no")})
  {
    double x = 0., y = 0., N = 0.;
    verification::run_scene(text, {},
                            [&](const taut::StepView &view)
                            {
                              x = displaced(view, view.scene.links[0].from).x;
                              y = displaced(view, view.scene.links[0].from).y;
                              N = view.state.multiplier[view.constraints.index_of_link(0)];
                            });
    EXPECT_NEAR(x, expected.x, 2e-4);
    EXPECT_NEAR(y, expected.y, 2e-4);
    EXPECT_NEAR(N / force, 1., 1e-3);
  }
}

// The scene of prm/: m (g + pi / 4) at most, m g later, and 3.25 m below the winch at the end.
TEST(Winches, scene_lifts_as_its_head_says)
{
  double most = 0., force = 0., place = 0.;
  verification::run_scene(verification::scene_file("winch"), {},
                          [&](const taut::StepView &view)
                          {
                            force = view.state.multiplier[0];
                            most = std::max(most, force);
                            place = view.probes[0];
                          });
  EXPECT_NEAR(most, 100. * (g + .25 * pi), .1);
  EXPECT_NEAR(force, 100. * g, 1e-3);
  EXPECT_NEAR(place, 1.75, 1e-6);
}

TEST(Winches, impossible_lengths_are_refused)
{
  const auto error = [](const Scene &scene)
  { return verification::error_of([&] { scene.run([](const Motion &) {}); }); };
  EXPECT_TRUE(has(error(lifted("Length = 2-t", 3.)), "Link l0/Length: link 'l0' has a length of "));
  EXPECT_TRUE(has(error(lifted("Length = t", 1.)), "it is 0 at the start"));
  EXPECT_TRUE(has(error(lifted("Length = -1", 1.)), "it is -1 m at the start"));
  EXPECT_TRUE(has(error(lifted("Length = 2-s", 1.)), "Length"));
  Scene straight = lifted("Length = 2-0.1*t; Direction = 0, -1", 1.);
  std::string text = straight.parameters();
  text.replace(text.find("Turns = true; "), 14, "");
  EXPECT_TRUE(
      has(verification::error_of([&] { verification::run_scene(text, {}, [](const auto &) {}); }),
          "set 'Turns = true', or give a number"));
}
