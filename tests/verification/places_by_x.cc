// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: a place on a cable that is named by its x is the one of the shape at rest. Source: the arc
// length of the catenary, a (sinh((x - b)/a) + sinh(b/a)) for ends at 0 and 2 b on one height.
#include "scene_tests.h"

using namespace verification;

namespace
{
  const std::string cable = R"(Generator = network
Body cable: Type = cable; From = 0, 5; To = 30, 5; Unstressed length = 31; Axial stiffness = 1e8
  ; Mass per length = 1; Elements = 60
Time: End = 0
)";

  std::vector<double> places(const std::string &x)
  {
    Session session(cable + "Probe here: Point = cable @ x = " + x + "\n");
    std::vector<double> result;
    for (const taut::Probe &probe : session.simulation().scene().probes)
    {
      result.push_back(probe.point.place.x);
      EXPECT_EQ(probe.point.place.y, 0.);
    }
    return result;
  }
} // namespace

TEST(PlacesByX, are_those_of_the_catenary)
{
  const double a =
      end_of(1., 1000., [](const double p) { return 2. * p * std::sinh(15. / p) > 31.; });
  for (const double x : {1.5, 7., 15., 22.25})
  {
    const std::vector<double> found = places(number(x));
    ASSERT_EQ(found.size(), 1u);
    EXPECT_NEAR(found[0], a * (std::sinh((x - 15.) / a) + std::sinh(15. / a)), 1e-4) << x;
  }
}

TEST(PlacesByX, take_ranges_and_the_ends)
{
  const std::vector<double> found = places("0:15:30");
  ASSERT_EQ(found.size(), 3u);
  EXPECT_NEAR(found[0], 0., 1e-9);
  EXPECT_NEAR(found[1], 15.5, 1e-8);
  EXPECT_NEAR(found[2], 31., 1e-9);
}

TEST(PlacesByX, that_a_cable_does_not_have_are_refused)
{
  EXPECT_TRUE(has(error_of([] { places("31"); }), "is nowhere at x = 31 m"));
  EXPECT_TRUE(has(error_of([] { places("31"); }), "reaches from x = 0 to 30 m"));
  EXPECT_TRUE(has(error_of([] { places("about 3"); }), "not a finite number"));
  const std::string upright = SceneBuilder(cable + "Body cable: To = 0, 30\n"
                                                   "Body cable: Unstressed length = 24.9\n"
                                                   "Probe here: Point = cable @ x = 0\n")
                                  .text();
  EXPECT_TRUE(has(error_of([&] { Session session(upright); }), "more than once at x = 0 m"));
  EXPECT_TRUE(has(error_of(
                      []
                      {
                        Session session(cable + "Body bar: Type = rigid body; Mass = 1\n"
                                                "Probe here: Point = bar @ x = 0\n");
                      }),
                  "'x = 0' is of places on a cable; body 'bar' is none"));
}
