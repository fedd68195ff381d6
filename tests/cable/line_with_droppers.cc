// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: the line of prm/line_with_droppers.prm hangs, is lifted and falls back into its droppers
// as its head expects. Expected values: elastic catenaries that meet at the droppers; no gain of
// energy; the same run with half the step and half the elements.
#include "cable/joined_catenaries.h"
#include "cable/places_in_steps.h"
#include "verification/scene_tests.h"

namespace
{
  using namespace verification;
  using namespace taut;

  constexpr std::size_t n_droppers = 6;
  constexpr double unit = 59.88 / 12., lengths[n_droppers] = {.99, .69, .54, .54, .69, .99};
  /// Where a dropper is in the list of links, whose sections have two each.
  constexpr std::size_t link_of[n_droppers] = {0, 2, 4, 5, 3, 1};

  struct AtRest
  {
    std::array<double, n_droppers> tension = {}, distance = {};
    double middle = 0., messenger = 0.; ///< heights in the middle of the span
  };

  /// Droppers are ropes that weigh 0.05 N/m along z, so that they have a plane of their own.
  AtRest catenaries(const double lift, const std::vector<std::size_t> &taut_droppers)
  {
    JoinedCatenaries system;
    system.n_free = 2 * n_droppers + 2;
    const std::size_t middle = 2 * n_droppers, ends = system.n_free;
    for (const double y : {.5, 0.})
      for (std::size_t i = 0; i < n_droppers; ++i)
        system.places.push_back({(2. * i + 1.) * 5., y, 0.});
    system.places.insert(system.places.end(), {{30., 0., 0.}, {30., .5, 0.}});
    system.places.insert(system.places.end(),
                         {{0., 1.2, 0.}, {60., 1.2, 0.}, {0., 0., 0.}, {60., 0., 0.}});
    system.loads.assign(system.n_free, {});
    system.loads[middle] = {0., lift, 0.};
    for (const std::size_t wire : {0, 1})
    {
      const double EA = wire == 0 ? 6.5e6 : 1e7, w = -g * (wire == 0 ? 1.07 : 1.35);
      std::vector<std::size_t> nodes = {ends + 2 * wire};
      for (std::size_t i = 0; i < n_droppers; ++i)
      {
        if (i == n_droppers / 2)
          nodes.push_back(wire == 0 ? middle + 1 : middle);
        nodes.push_back(wire * n_droppers + i);
      }
      nodes.push_back(ends + 2 * wire + 1);
      for (std::size_t k = 0; k + 1 < nodes.size(); ++k)
      {
        const bool is_long = k == 1 || k == 2 || k + 3 == nodes.size() || k + 4 == nodes.size();
        const double length = (is_long ? 2. : 1.) * unit;
        system.cables.push_back({nodes[k], nodes[k + 1], length, EA, {0., w, 0.}});
      }
    }
    const std::size_t first = system.cables.size();
    for (const std::size_t i : taut_droppers)
      system.cables.push_back({i, n_droppers + i, lengths[i], 1e5 * lengths[i], {0., 0., .05}});
    EXPECT_LT(system.solve(), 1e-6);
    AtRest result;
    for (std::size_t i = 0; i < n_droppers; ++i)
      result.distance[i] = norm(system.places[i] - system.places[n_droppers + i]);
    for (std::size_t k = 0; k < taut_droppers.size(); ++k)
      result.tension[taut_droppers[k]] = norm(system.pull(system.cables[first + k]));
    result.middle = system.places[middle].y;
    result.messenger = system.places[middle + 1].y;
    return result;
  }

  struct Found
  {
    AtRest start;
    double caught = 0., first = 0., largest = 0.; ///< first: of the first catch
    double lowest = 1., gain = 0.;
  };

  Found run(const Overrides &overrides)
  {
    Found found;
    Session session(scene_file("line_with_droppers"), overrides);
    session.run(
        [&](const StepView &step)
        {
          const double t = step.state.time, inner = step.state.multiplier[link_of[2]],
                       middle = displaced(step, step.scene.probes[0].point).y;
          if (t == 0.)
          {
            for (std::size_t i = 0; i < n_droppers; ++i)
            {
              found.start.tension[i] = step.state.multiplier[link_of[i]];
              found.start.distance[i] = lengths[i] - step.state.distance[link_of[i]];
            }
            found.start.middle = middle;
            found.start.messenger = displaced(step, step.scene.probes[1].point).y;
          }
          if (t > 0. && found.caught == 0. && inner > 0.)
            found.caught = t;
          if (t < .12)
            found.first = std::max(found.first, inner);
          for (const std::size_t link : link_of)
            found.largest = std::max(found.largest, t > 0. ? step.state.multiplier[link] : 0.);
          found.lowest = std::min(found.lowest, middle);
          found.gain = step.measures.summary().relative_motion_energy;
        });
    return found;
  }
} // namespace

TEST(LineWithDroppers, hangs_as_catenaries_do)
{
  const Found found = run({"Time/End=0", "Network/Load lift/Magnitude=0"});
  const AtRest expected = catenaries(0., {0, 1, 2, 3, 4, 5});
  for (std::size_t i = 0; i < n_droppers; ++i)
    EXPECT_NEAR(found.start.tension[i], expected.tension[i], .2) << i;
  EXPECT_NEAR(found.start.middle, expected.middle, 1e-4);
  EXPECT_NEAR(found.start.messenger, expected.messenger, 1e-4);
  figure("line with droppers at rest: height of the contact wire",
         std::fabs(found.start.middle - expected.middle), "m");
}

TEST(LineWithDroppers, is_lifted_as_catenaries_are)
{
  const Found found = run({"Time/End=0"});
  const AtRest expected = catenaries(700., {0, 1, 4, 5});
  for (std::size_t i = 0; i < n_droppers; ++i)
  {
    EXPECT_NEAR(found.start.tension[i], expected.tension[i], .2) << i;
    EXPECT_NEAR(found.start.distance[i], expected.distance[i], 1e-4) << i;
  }
  EXPECT_LT(expected.distance[2], lengths[2]);
  EXPECT_NEAR(found.start.middle, expected.middle, 1e-4);
}

TEST(LineWithDroppers, falls_back_into_its_droppers)
{
  const Found found = run({}), fine = run({"Time/Step=5e-4", "Body messenger/Elements=96",
                                           "Body contact wire/Elements=96"});
  for (const Found &f : {found, fine})
  {
    EXPECT_NEAR(f.caught, .055, .0011);
    EXPECT_LT(f.gain, 1e-9);
  }
  EXPECT_NEAR(found.lowest, fine.lowest, .005);
  EXPECT_NEAR(found.first, fine.first, .05 * fine.first);
  EXPECT_NEAR(found.largest, fine.largest, .1 * fine.largest);
  figure("line with droppers: first catch", found.first, "N");
  figure("line with droppers: first catch, half the step and elements", fine.first, "N");
  figure("line with droppers: largest force of a dropper", found.largest, "N");
  figure("line with droppers: the same, half the step and elements", fine.largest, "N");
  figure("line with droppers: lowest place of the middle", found.lowest, "m");
  figure("line with droppers: the same, half the step and elements", fine.lowest, "m");
}
