// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: a rope runs through rings without friction. It has one force all along, is taut where the
// sum of the distances from place to place is its length, and gives the tackles, guys and machines
// of mechanics; motions keep its length and their energy.
// Sources: closed forms of statics (a weight that slides on a rope: N. Bernoulli's equal angles;
// a tackle; a guyed mast) and of Atwood's machine; the swinging Atwood's machine, a weight that
// swings at one end (N. B. Tufillaro, T. A. Abbott, D. J. Griffiths, Am. J. Phys. 52 (1984)), by
// Runge-Kutta's method; ropes of a program.
#include "one_body.h"
#include "turning_scene.h"

#include "mechanism/mechanism.h"

#include <array>

using namespace turning;

namespace
{
  const std::vector<Overrides> schemes = {
      {}, {"Time/Scheme=backward Euler"}, {"Time/Scheme=Moreau-Jean"}};

  /// Distance over the two masses on a rope over a ring at the origin.
  double length_over_ring(const Motion &now)
  {
    return norm(now.place[0]) + norm(now.place[1]);
  }

  Scene atwood(const double heavy, const double light, const double end)
  {
    return thrown({{heavy, {0., -1., 0.}, {}}, {light, {0., -2., 0.}, {}}},
                  {rope("m0", "m1", 3.) + "; Through = ground @ 0, 0, 0"}, end);
  }

  /// r, r', angle and its rate of the weight @p m that swings, with the weight @p M at the other
  /// end of the rope, by
  ///
  ///     (M + m) r'' = m r a'^2 + m g cos a - M g,    r a'' = -2 r' a' - g sin a.
  std::array<double, 4> swinging_atwood(const double M, const double m, std::array<double, 4> x,
                                        const double end)
  {
    using State = std::array<double, 4>;
    constexpr int n = 20000;
    const double h = end / n;
    const auto rate = [&](const State &s)
    {
      return State{s[1], (m * s[0] * s[3] * s[3] + m * g * std::cos(s[2]) - M * g) / (M + m), s[3],
                   -(2. * s[1] * s[3] + g * std::sin(s[2])) / s[0]};
    };
    const auto shifted = [](State s, const double by, const State &k)
    {
      for (unsigned int j = 0; j < 4; ++j)
        s[j] += by * k[j];
      return s;
    };
    for (int i = 0; i < n; ++i)
    {
      const State a = rate(x), b = rate(shifted(x, .5 * h, a)), c = rate(shifted(x, .5 * h, b)),
                  d = rate(shifted(x, h, c));
      for (unsigned int j = 0; j < 4; ++j)
        x[j] += h / 6. * (a[j] + 2. * b[j] + 2. * c[j] + d[j]);
    }
    return x;
  }
} // namespace

TEST(Pulleys, atwood_machine_falls_by_the_difference_of_its_weights)
{
  constexpr double heavy = 3., light = 2., a = g * (heavy - light) / (heavy + light),
                   N = 2. * heavy * light * g / (heavy + light);
  for (const Overrides &scheme : schemes)
  {
    double place = 0., force = 0., length = 0.;
    atwood(heavy, light, .5)
        .run(
            [&](const Motion &now)
            {
              if (now.time < .01)
                return;
              verification::raise(place, now.place[0].y + 1. + .5 * a * now.time * now.time);
              verification::raise(force, now.multiplier[0] / N - 1.);
              verification::raise(length, length_over_ring(now) - 3.);
            },
            scheme);
    SCOPED_TRACE(scheme.empty() ? "default" : scheme[0]);
    // Backward Euler falls by a h t / 2 more.
    const bool is_first_order = has(scheme.empty() ? "" : scheme[0], "Euler");
    EXPECT_LE(verification::figure("Atwood's machine, error of the place [m]", place),
              is_first_order ? .55 * a * 1e-3 * .5 : 1e-12);
    EXPECT_LE(verification::figure("Atwood's machine, error of the force", force), 1e-9);
    EXPECT_LE(verification::figure("Atwood's machine, drift of the length [m]", length), 1e-12);
  }
}

TEST(Pulleys, swinging_atwood_machine_follows_its_equations)
{
  constexpr double M = 3., m = 1., angle = 1., end = 2.;
  const std::array<double, 4> expected = swinging_atwood(M, m, {1., 0., angle, 0.}, end);
  const auto error = [&](const double step, const Overrides &scheme)
  {
    double result = 0., energy = 0., drift = 0., start = 0.;
    thrown({{M, {0., -1., 0.}, {}}, {m, {std::sin(angle), -std::cos(angle), 0.}, {}}},
           {rope("m0", "m1", 2.) + "; Through = ground @ 0, 0, 0"}, end, step)
        .run(
            [&](const Motion &now)
            {
              if (now.time == 0.)
                start = now.energy;
              verification::raise(energy, now.energy - start);
              verification::raise(drift, length_over_ring(now) - 2.);
              result = norm(now.place[1] - Coordinates{expected[0] * std::sin(expected[2]),
                                                       -expected[0] * std::cos(expected[2]), 0.});
            },
            scheme);
    // Each step is solved to 1e-12 of the length of 2 m.
    EXPECT_LE(verification::figure("swinging Atwood's machine, drift of the length [m]", drift),
              2e-12 * end / step);
    if (scheme.empty())
    {
      EXPECT_LE(verification::figure("swinging Atwood's machine, gain of energy [J]", energy),
                1e-8);
    }
    return result;
  };
  const double fine = error(1e-3, {}), rough = error(2e-3, {});
  EXPECT_LE(verification::figure("swinging Atwood's machine, error of the place [m]", fine), 1e-4);
  EXPECT_GE(rough / fine, 3.); // of second order
  EXPECT_LE(error(1e-4, {"Time/Scheme=backward Euler"}), 3e-2);
}

// Both parts of the rope are at one angle a to the horizontal: cos a is the distance over the
// length, whatever the heights of the ends, and l cos a is the distance to an end. The weight may
// start where a part is much longer than at rest.
TEST(Pulleys, weight_that_slides_on_a_rope_rests_at_equal_angles)
{
  constexpr double mass = 2.;
  struct Rope
  {
    double d, height, length;
    std::vector<Coordinates> starts;
  };
  const std::vector<Rope> ropes = {
      {3., 1., 4., {{.5, -1., 0.}, {2.5, .5, 0.}}},
      {1., 2., 2.3, {{.5, -.2, 0.}}},
      {1., 3., 5., {{1., 2., 0.}, {.9, 2.5, 0.}, {3., 2.5, 0.}, {3., 3., .5}, {1., 1., 0.}}},
      {1., 4.5, 5., {{.7, -.2, 0.}, {.5, 2., 0.}}},
      {4., 1.5, 4.4, {{3.5, 1., 0.}, {1., -.5, .2}}}};
  for (const auto &[d, height, length, starts] : ropes)
    for (const Coordinates &start : starts)
    {
      const double cosine = d / length, sine = std::sqrt(1. - cosine * cosine),
                   first = .5 * (length - height / sine);
      Scene scene;
      scene.masses = {{mass, start, {}}};
      scene.links = {rope("ground @ 0, 0, 0", "ground @ " + text({d, height, 0.}), length) +
                     "; Through = m0"};
      SCOPED_TRACE(text({d, height, length}) + " from " + text(start));
      scene.run(
          [&](const Motion &now)
          {
            EXPECT_LT(norm(now.place[0] - Coordinates{first * cosine, -first * sine, 0.}), 1e-9);
            EXPECT_NEAR(now.multiplier[0] / (mass * g / (2. * sine)), 1., 1e-8);
          });
    }
}

// From the block over a ring at the crown, through the block, over a second ring, to a weight:
// three parts hold the block.
TEST(Pulleys, tackle_multiplies_the_weight)
{
  constexpr double block = 5., weight = 2.;
  const std::string tackle =
      "Type = dropper; From = m0; Through = ground @ 0, 0, 0, m0, ground @ 0, 0, 0; To = m1; ";
  const double N = 4. * g / (9. / block + 1. / weight), fall = g - 3. * N / block;
  double force = 0., place = 0.;
  thrown({{block, {0., -2., 0.}, {}}, {weight, {0., -1., 0.}, {}}}, {tackle + "Length = 7"}, .2)
      .run(
          [&](const Motion &now)
          {
            if (now.time > .01)
              verification::raise(force, now.multiplier[0] / N - 1.);
            verification::raise(place, now.place[0].y + 2. + .5 * fall * now.time * now.time);
          });
  EXPECT_LE(verification::figure("tackle of three parts, error of the force", force), 1e-9);
  EXPECT_LE(verification::figure("tackle of three parts, error of the place [m]", place), 1e-4);

  // Elastic, and held at its end.
  constexpr double k = 1e4;
  Scene held;
  held.masses = {{block, {0., -2., 0.}, {}}};
  held.links = {"Type = dropper; From = m0; Through = ground @ 0, 0, 0, m0; To = ground @ 0, 0, 0; "
                "Length = 6; Stiffness = " +
                number(k)};
  held.run(
      [&](const Motion &now)
      {
        EXPECT_NEAR(now.multiplier[0], block * g / 3., 1e-8);
        EXPECT_NEAR(now.place[0].y, -2. - block * g / (9. * k), 1e-9);
      });
}

// A mast on a hinge with one rope from anchor to anchor over its top: a force H there is held by
// H / (sin a - sin b) in the rope, whose parts are at angles a and b to the mast.
TEST(Pulleys, mast_with_one_guy_over_its_top)
{
  constexpr double h = 10., left = 8., right = 5., H = 100.;
  const double l = std::hypot(left, h), r = std::hypot(right, h), N = H / (left / l - right / r);
  const std::string scene =
      "Gravity = 0, 0; Start = equilibrium\n"
      "Time: End = 0\n"
      "Mass top: Position = 0, 10; Mass = 1; Motions = x, y\n"
      "Link mast: Type = joint; Turns = true; From = ground @ 0, 0; To = top; Length = 10\n"
      "Link guy: Type = dropper; Turns = true; From = ground @ -8, 0; Through = top; "
      "To = ground @ 5, 0; Length = " +
      number(l + r) + "\nLoad wind: On = top; Direction = 1, 0; Magnitude = " + number(H) + "\n";
  verification::run_scene(scene, {},
                          [&](const taut::StepView &view)
                          {
                            const auto force = [&](const std::size_t link)
                            { return view.state.multiplier[view.constraints.index_of_link(link)]; };
                            EXPECT_NEAR(force(1) / N, 1., 1e-8);
                            EXPECT_NEAR(force(0) / (N * h * (1. / l + 1. / r)), 1., 1e-8);
                          });
}

// A rope in tension through a ring in the middle of a string pulls it down: with deflection w,
// 4 S w / L = 2 N w' / l, where w' = h - w is the rest of the way down and l the length of a part.
TEST(Pulleys, ring_on_a_string)
{
  constexpr double S = 1000., half = 5., b = 1., depth = 2., k = 500., unstressed = 4.;
  // The deflection, by bisection.
  const auto rest = [&](const double w)
  {
    const double l = std::hypot(b, depth - w), N = k * (2. * l - unstressed);
    return 2. * S * w / half - 2. * N * (depth - w) / l;
  };
  double low = 0., high = depth;
  while (high - low > 1e-14)
    (rest(.5 * (low + high)) < 0. ? low : high) = .5 * (low + high);
  const std::string scene =
      "Gravity = 0, 0; Start = equilibrium\n"
      "Time: End = 0\n"
      "Wire w: From = 0, 0; To = 10, 0; Mass per length = 1; Tension = 1000; Components = string; "
      "Element size = 1.25\n"
      "Support w: Wire = w; Positions = 0, 10\n"
      "Link rope: Type = dropper; Turns = true; From = ground @ 4, -2; Through = w @ 5; "
      "To = ground @ 6, -2; Length = 4; Stiffness = 500\n";
  verification::run_scene(scene, {},
                          [&](const taut::StepView &view)
                          { EXPECT_NEAR(verification::displacement(view, 0, half), -low, 1e-9); });
}

TEST(Pulleys, ropes_of_a_program)
{
  constexpr double heavy = 3., light = 2., step = 1e-3,
                   N = 2. * heavy * light * g / (heavy + light);
  taut::Scene scene;
  for (const double mass : {heavy, light})
  {
    taut::Mass ball;
    ball.mass = mass;
    ball.weight = true;
    ball.moves[0] = ball.moves[1] = true;
    scene.masses.push_back(ball);
  }
  scene.gravity = {0., -g, 0.};
  taut::System system;
  const std::size_t body =
      system.add("weights",
                 [&] {
                   return std::make_unique<taut::Mechanism>(scene, std::vector<std::size_t>{0, 1});
                 });
  const taut::LinkEnd ring{{0., 0., 0.}}, a = system.link_end(body, {0.}, {0., -1., 0.}),
                                          b = system.link_end(body, {1.}, {0., -2., 0.});
  using taut::Constraint;
  const std::size_t row = system.add(Constraint::rope("rope", {a, ring, b}, 3.));
  taut::Stepper stepper(system, verification::steps_of(step, taut::Start::given));
  for (int i = 0; i < 100; ++i)
    stepper.advance();
  EXPECT_NEAR(stepper.multiplier(row) / N, 1., 1e-9);
  EXPECT_NEAR(stepper.gap(row), 0., 1e-12);
  const std::string one = verification::error_of([&] { Constraint::rope("r", {a}, 1.); }),
                    twice = verification::error_of(
                        [&] {
                          Constraint::rope("r", {a, b, b}, 1.);
                        });
  EXPECT_TRUE(has(one, "has 1 of them; give two or more")) << one;
  EXPECT_TRUE(has(twice, "two of its places are one place, (0, -2, 0) m")) << twice;
}

TEST(Pulleys, scene_lifts_as_its_head_says)
{
  const double pi_8 = pi / 8.;
  double most = 0., rest = 0., place = 0.;
  verification::run_scene(verification::scene_file("block_and_tackle"), {},
                          [&](const taut::StepView &view)
                          {
                            rest = view.state.multiplier[0];
                            most = std::max(most, rest);
                            place = view.probes[0];
                          });
  EXPECT_NEAR(most, 100. * (g + pi_8), 2.);
  EXPECT_NEAR(rest, 100. * g, .5);
  EXPECT_NEAR(place, .875, 1e-3);
}

TEST(Pulleys, impossible_ropes_are_refused)
{
  const auto error = [](const std::string &link)
  {
    Scene scene;
    scene.masses = {{1., {0., -1., 0.}, {}}};
    scene.links = {link};
    return verification::error_of([&] { scene.run([](const Motion &) {}); });
  };
  const std::string ends = "From = ground @ -1, 0, 0; To = ground @ 1, 0, 0; ";
  const auto rope_with = [&](const std::string &more)
  { return error("Type = dropper; " + ends + more); };
  EXPECT_EQ(rope_with("Through = m0"), "");
  EXPECT_TRUE(has(error("Type = stop; " + ends + "Through = m0"), "it is of a rope"));
  EXPECT_TRUE(has(rope_with("Through = ground"), "a ring at the ground needs a place"));
  EXPECT_TRUE(has(rope_with("Through = ground @ 0, 1, 0"), "both ends are the ground"));
  EXPECT_TRUE(has(rope_with("Through = m1"), "Link l0/Through"));
  EXPECT_TRUE(has(rope_with("Through = m0, m0"), "two places next to each other"));
  EXPECT_TRUE(has(rope_with("Through = m0,, m0"), "Link l0/Through"));
  // One rope that is too short is named once.
  const std::string too_short = rope_with("Through = m0; Length = 0.5");
  EXPECT_TRUE(has(too_short, "no force satisfies link 'l0'")) << too_short;
}

// A part of a place may look like a name, and a name like a part of a place.
TEST(Pulleys, names_and_numbers_of_rings)
{
  const auto error = [](const std::string &name, const std::string &through)
  {
    const std::string scene = "Time: End = 0\nMass " + name +
                              ": Position = 0, -1; Mass = 1; Motions = x, y\n"
                              "Link l: Type = dropper; Turns = true; From = ground @ -1, 0; To = "
                              "ground @ 1, 0; Length = 4; Through = " +
                              through + "\n";
    return verification::error_of([&] { verification::run_scene(scene, {}, [](const auto &) {}); });
  };
  EXPECT_EQ(error("e1", "ground @ 0, 0.5, e1"), "");
  EXPECT_EQ(error("m", "ground @ 0, 0.5, 0, m"), "");
  EXPECT_TRUE(has(error("2", "ground @ 0, 0.5, 2"), "'2' is a mass and may be a number"));
  EXPECT_EQ(error("2", "2, ground @ 0, 0.5"), "");
}
