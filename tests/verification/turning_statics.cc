// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: weights on links that turn come to rest where they hang, with the forces of closed forms,
// and what such links cannot be is an error that says what to do.
#include "turning_scene.h"

using verification::pi;

using namespace turning;

namespace
{
  Motion at_rest(const Scene &scene, const Overrides &overrides = {})
  {
    Motion result;
    scene.run([&](const Motion &m) { result = m; }, overrides);
    return result;
  }

  /// Where two circles about level points meet, below.
  Coordinates meeting_below(const double distance, const double a, const double b)
  {
    const double x = (a * a - b * b + distance * distance) / (2. * distance);
    return {x, -std::sqrt(a * a - x * x), 0.};
  }

  std::string error_at_rest(const std::string &entries, const Overrides &overrides = {})
  {
    const Scene scene = thrown({{1., {1., 0., 0.}, {}}, {1., {2., 0., 0.}, {}}}, {entries}, .01);
    return verification::error_of([&] { at_rest(scene, overrides); });
  }
} // namespace

TEST(TurningStatics, weight_on_two_ropes)
{
  for (const double size : {1., 10.})
    for (const double weight : {100., 1e4})
      for (const Coordinates &guess :
           {Coordinates{.3, -.5, 0.}, {1.2, -1.4, .7}, {.9, -.05, 0.}, {.5, .2, .1}})
      {
        const double a = 1. * size, b = .9 * size, distance = 1.5 * size;
        Scene scene = {{{weight / g, add_scaled({}, size, guess), {}}},
                       {rope("ground @ 0, 0", "m0", a),
                        rope("m0", "ground @ " + number(distance) + ", 0", b)}};
        const Motion m = at_rest(scene);
        const Coordinates expected = meeting_below(distance, a, b);
        EXPECT_LT(norm(m.place[0] - expected), 1e-9 * size);
        // N_a sin + N_b sin = 0, with the unit vectors from the weight to its ropes.
        const double ax = -expected.x / a, ay = -expected.y / a, bx = (distance - expected.x) / b,
                     by = -expected.y / b, det = ax * by - ay * bx;
        EXPECT_NEAR(m.multiplier[0], -bx * weight / det, 1e-8 * weight);
        EXPECT_NEAR(m.multiplier[1], ax * weight / det, 1e-8 * weight);
      }
}

// Rigid ropes to a mass that is where they hold it. Expected: the forces that balance its load, by
// Cramer's rule, and no motion. Lengths are given to the last digit.
TEST(TurningStatics, rigid_ropes_at_their_answer)
{
  // In the plane: two ropes under 700 N.
  const auto tied =
      [](const std::vector<Coordinates> &anchors, const Coordinates &at, const double weight)
  {
    Scene scene = {{{weight / g, at, {}}}, {}};
    for (const Coordinates &anchor : anchors)
      scene.links.push_back(rope("ground @ " + text(anchor), "m0", norm(anchor - at)));
    return at_rest(scene);
  };
  const Motion plane = tied({{-2., 3., 0.}, {3., 4., 0.}}, {}, 700.);
  EXPECT_NEAR(plane.multiplier[0], 445.4, .05);
  EXPECT_NEAR(plane.multiplier[1], 411.8, .05);
  EXPECT_LT(norm(plane.place[0]), 1e-9);

  // In space, at three sizes.
  for (const double size : {1e-3, 1., 1e3})
  {
    const std::vector<Coordinates> anchors = {{-2. * size, 3. * size, .4 * size},
                                              {2.5 * size, 4. * size, 1.7 * size},
                                              {.3 * size, 2. * size, -3. * size}};
    const Coordinates at = {.21 * size, -.13 * size, .07 * size};
    const double weight = 30.;
    const Motion space = tied(anchors, at, weight);
    Coordinates d[3];
    for (int i = 0; i < 3; ++i)
      d[i] = add_scaled({}, 1. / norm(anchors[i] - at), anchors[i] - at);
    const double det = dot(d[0], cross(d[1], d[2]));
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(space.multiplier[i], weight * cross(d[(i + 1) % 3], d[(i + 2) % 3]).y / det,
                  1e-9 * weight)
          << size;
    EXPECT_LT(norm(space.place[0] - at), 1e-9 * size);
  }
}

TEST(TurningStatics, weight_on_one_rope_hangs_down)
{
  for (const double degrees : {10., 90., 130.})
  {
    const double angle = degrees * pi / 180.;
    Scene scene = {{{20., {2. * std::sin(angle), -2. * std::cos(angle), .3}, {}}},
                   {rope("ground @ 0, 0", "m0", 2.)}};
    const Motion m = at_rest(scene);
    EXPECT_LT(norm(m.place[0] - Coordinates{0., -2., 0.}), 1e-8) << degrees;
    EXPECT_NEAR(m.multiplier[0], 20. * g, 1e-8 * 20. * g);
  }
}

TEST(TurningStatics, chain_of_elastic_ropes)
{
  // Three weights on four ropes, from guesses on the straight line: balance at each weight.
  Scene scene;
  const double k = 5e3, length = 1.1;
  for (int i = 0; i < 3; ++i)
  {
    scene.masses.push_back({10. * (i + 1), {1. + i, 0., 0.}, {}});
    scene.links.push_back(rope(i == 0 ? "ground @ 0, 0" : "m" + std::to_string(i - 1),
                               "m" + std::to_string(i), length) +
                          "; Stiffness = 5000");
  }
  scene.links.push_back(rope("m2", "ground @ 4, 0.5", length) + "; Stiffness = 5000");
  const Motion m = at_rest(scene);
  const Coordinates ends[] = {{0., 0., 0.}, m.place[0], m.place[1], m.place[2], {4., .5, 0.}};
  for (int i = 0; i < 3; ++i)
  {
    Coordinates force = {0., -g * 10. * (i + 1), 0.};
    for (const int other : {i, i + 2})
    {
      const Coordinates d = ends[other] - ends[i + 1];
      const double N = k * (norm(d) - length);
      EXPECT_NEAR(m.multiplier[other == i ? i : i + 1], N, 1e-7 * k);
      force = add_scaled(force, N / norm(d), d);
    }
    EXPECT_LT(norm(force), 1e-6);
  }
}

TEST(TurningStatics, a_scene_that_is_turned_in_space_has_the_same_answers)
{
  const auto turned = [](const Coordinates &a)
  {
    const double c = std::cos(1.1), s = std::sin(1.1), d = std::cos(.7), e = std::sin(.7);
    const Coordinates first = {c * a.x - s * a.y, s * a.x + c * a.y, a.z};
    return Coordinates{first.x, d * first.y - e * first.z, e * first.y + d * first.z};
  };
  std::vector<Motion> found[2];
  for (const bool is_turned : {false, true})
  {
    const auto of = [&](const Coordinates &a) { return is_turned ? turned(a) : a; };
    const Scene scene = thrown(
        {{2., of({1., -.4, .1}), of({.5, 1., -.3})}, {1., of({1.8, -.9, 0.}), of({0., 2., .4})}},
        {rope("ground @ " + text(of({.1, 0., 0.})), "m0", 1.2),
         rope("m0", "m1", 1.1) + "; Stiffness = 3000; Damping = 5"},
        .8, 1e-3, of({0., -g, 0.}));
    scene.run([&](const Motion &m) { found[is_turned].push_back(m); });
  }
  double largest = 0.;
  for (std::size_t n = 0; n < found[0].size(); ++n)
    for (std::size_t i = 0; i < 2; ++i)
    {
      EXPECT_LT(norm(turned(found[0][n].place[i]) - found[1][n].place[i]), 1e-10);
      largest = std::max(largest, found[0][n].multiplier[i]);
      EXPECT_NEAR(found[0][n].multiplier[i], found[1][n].multiplier[i], 1e-6);
    }
  EXPECT_GT(largest, 20.);
}

TEST(TurningStatics, what_cannot_turn_is_refused)
{
  const auto expect = [](const std::string &error, const std::string &part)
  { EXPECT_TRUE(has(error, part)) << error; };
  const std::string ends = "From = ground @ 0, 0; To = m0";
  expect(error_at_rest(ends + "; Type = dropper; Direction = 1, 0"), "leave it empty");
  expect(error_at_rest(ends + "; Type = ball joint"), "no direction from end to end");
  expect(error_at_rest(ends + "; Type = stop; Rotational = true"), "between displacements");
  expect(error_at_rest(ends + "; Type = dropper; Length = 1; Gap = 1"), "leave one of them");
  expect(error_at_rest(ends + "; Type = stop; Gap = 2"), "Give it a Length");
  expect(error_at_rest("From = ground; To = m0; Type = dropper"), "ground @ x, y, z");
  expect(error_at_rest("From = ground @ 1, 0; To = m0; Type = dropper; Length = 1"),
         "start at one place");
  expect(error_at_rest(ends + "; Type = dropper; Length = .9"), "starts with a gap");
  expect(error_at_rest(ends + "; Type = stop; Turns = false; Length = .9"), "set 'Turns = true'");
  const std::string good = ends + "; Type = dropper; Length = 1";
  EXPECT_EQ(error_at_rest(good), "");
  expect(error_at_rest(good, {"Time/Scheme=Newmark"}), "gains energy where link 'l0' turns");
  for (const char *const conditions : {"velocities", "gaps"})
    expect(error_at_rest(good, {"Time/Scheme=Moreau-Jean",
                                "Time/Moreau-Jean/Conditions=" + std::string(conditions),
                                "Time/Moreau-Jean/Theta=1"}),
           "its length would drift");
  expect(
      error_at_rest(good, {"Network/Mass m0/Mass=0", "Network/Springs=x, y, z",
                           "Network/Spring x/To=m0", "Network/Spring x/Direction=1, 0",
                           "Network/Spring x/Stiffness=1", "Network/Spring y/To=m0",
                           "Network/Spring y/Stiffness=1", "Network/Spring z/To=m0",
                           "Network/Spring z/Direction=0, 0, 1", "Network/Spring z/Stiffness=1"}),
      "no mass");
}
