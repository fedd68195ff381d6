// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: where the ends of a link that turns and has a force come to one place, at the start or in
// motion, the run ends with an error that says when, which link, where and what to do; a slack rope
// lets them pass. Expected values: harmonic motion, straight flight.
#include "turning_scene.h"

using namespace turning;

namespace
{
  /// A mass of 1 kg in weightlessness, thrown from a place 1 m beside the origin.
  Scene thrown_at(const std::string &link, const Coordinates &place, const Coordinates &velocity)
  {
    return thrown({{1., place, velocity}}, {link + "; From = ground @ 0, 0; To = m0; Length = 1"},
                  .3, 1e-3, weightless);
  }

  struct End
  {
    std::string error;
    double time = 0.; ///< of the last step
  };

  End end_of(const Scene &scene, const Overrides &overrides = {})
  {
    End result;
    result.error = verification::error_of(
        [&] { scene.run([&](const Motion &m) { result.time = m.time; }, overrides); });
    return result;
  }

  void expect_meeting(const End &end, std::vector<std::string> parts)
  {
    parts.push_back("it has no direction there. Give it a stiffness");
    for (const std::string &part : parts)
      EXPECT_TRUE(has(end.error, part)) << part << " in " << end.error;
  }

  const std::string prop = "Type = stop; Stiffness = 100", rod = "Type = joint; Stiffness = 100";
} // namespace

TEST(TurningMeetings, mass_thrown_at_its_anchor)
{
  // x = 1 - 2 sin(10 t).
  const double meeting = std::asin(.5) / 10.;
  const Coordinates direction = {2. / 7., 3. / 7., 6. / 7.};
  for (const std::string &link : {prop, rod})
    for (const Coordinates &d : {Coordinates{1., 0., 0.}, direction})
      for (const double step : {1e-3, 7e-3})
        for (const char *const scheme : {"automatic", "backward Euler"})
        {
          Scene scene = thrown_at(link, d, add_scaled({}, -20., d));
          scene.step = step;
          const End end = end_of(scene, {"Time/Scheme=" + std::string(scheme)});
          expect_meeting(end, {"t = 0.05", "link 'l0' meet", "from (0, 0, 0) m and ("});
          EXPECT_NEAR(end.time, meeting, scheme == std::string("automatic") ? 1.1 * step : .02);
        }
}

TEST(TurningMeetings, masses_that_meet)
{
  Scene scene = thrown({{1., {0., 1., 0.}, {0., 10., 0.}}, {1., {0., 2., 0.}, {0., -10., 0.}}},
                       {"Type = stop; Stiffness = 50; From = m0; To = m1"}, .2, 1e-3, weightless);
  expect_meeting(end_of(scene), {"t = 0.05", "link 'l0' meet, from (0, 1."});
}

TEST(TurningMeetings, at_the_start)
{
  for (const std::string &link : {prop, rod})
  {
    const Scene scene = thrown_at(link, {1., .5, 0.}, {});
    const End end = end_of(scene, {"Network/Mass m0/Initial displacement=-1, -.5, 0"});
    expect_meeting(
        end, {"Network/Link l0", "t = 0 s", "link 'l0' meet", "from (0, 0, 0) m and (0, 0, 0) m"});
  }
  const End same = end_of(thrown_at(prop, {0., 0., 0.}, {}));
  EXPECT_TRUE(has(same.error, "start at one place, (0, 0, 0) m")) << same.error;
}

TEST(TurningMeetings, mass_that_flies_past)
{
  const Scene scene = thrown_at(prop, {1., .05, 0.}, {-20., 0., 0.});
  EXPECT_EQ(end_of(scene).error, "");
  double least = 1., first = 0.;
  scene.run(
      [&](const Motion &m)
      {
        least = std::min(least, norm(m.place[0]));
        first = first > 0. ? first : m.energy;
        // The step in which the prop opens takes some.
        EXPECT_NEAR(m.energy, first, 2e-5 * first);
        EXPECT_LT(m.energy, (1. + 1e-9) * first);
      });
  EXPECT_LT(least, .3);
}

TEST(TurningMeetings, slack_rope_lets_its_ends_pass)
{
  // Through the anchor after 0.05 s, once at the end of a step; caught on the other side.
  for (const double step : {1e-3, 7e-4})
  {
    Scene scene = thrown_at("Type = dropper", {.5, 0., 0.}, {-10., 0., 0.});
    scene.step = step;
    double caught = 0.;
    scene.run(
        [&](const Motion &m)
        {
          if (caught == 0. && m.multiplier[0] > 0.)
          {
            caught = m.time;
            EXPECT_NEAR(m.place[0].x, -1., 1e-10);
          }
        });
    EXPECT_NEAR(caught, .15, 1.1 * step);
  }
}
