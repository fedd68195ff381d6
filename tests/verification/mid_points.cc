// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: the ropes of a mid-point pull messenger and contact wire together with their force
// density, and resist as elastic ropes that turn. Sources: equilibrium of strings; the stiffness of
// a rope under tension, (EA h^2 + T l^2) / length^3 with the rise h and the run l of its ends.
#include "scene_tests.h"

using namespace verification;

namespace
{

  /// Two spans of 50 m whose contact wire hangs on the ropes of the mid-point alone, 20 m apart.
  const std::string line = R"(Generator = catenary
Start = equilibrium
Catenary: Span lengths = 50, 50; Mid-points = 0, 20, 0; Pantographs =
Catenary/Contact wire: Model = string; Mass per length = 1; Tension = 10000; Element size = 1
Catenary/Messenger wire: Model = string; Mass per length = 0.8; Tension = 12000; Element size = 1
Catenary/Supports: Arm mass = 0
Catenary/Droppers: Positions =
Catenary/Mid-point ropes: Pull = 800; Axial stiffness = 5e5
Time: Step = 1e-3; End = 0; Scheme = backward Euler
)";

  /// Static state of a scene, with all its links.
  void at_rest(const std::string &scene, const Overrides &overrides,
               const std::function<void(const taut::StepView &)> &check)
  {
    int n_seen = 0;
    run_scene(scene, overrides,
              [&](const taut::StepView &view)
              {
                ++n_seen;
                check(view);
              });
    EXPECT_GE(n_seen, 1);
  }
} // namespace

TEST(MidPoint, ropes_hold_the_contact_wire_with_their_pull)
{
  at_rest(line, {},
          [](const taut::StepView &view)
          {
            constexpr double T = 10000., H = 800., rise = 1.2;
            ASSERT_EQ(view.scene.links.size(), 2u);
            // Force density 80 N/m times the height of a rope; weight and force on 40 m of string.
            const double density = H / 10.,
                         y = (density * 40. * rise - g * (50. * 40. - 800.)) / (T + 40. * density),
                         force = density * (rise - y);
            EXPECT_NEAR(displacement(view, 1, 40.), y, 1e-9);
            EXPECT_NEAR(displacement(view, 1, 60.), y, 1e-9);
            EXPECT_NEAR(displacement(view, 1, 50.), y - g * 10. * 10. / 2. / (T - H), 1e-9);
            for (const double N : view.state.multiplier)
              EXPECT_NEAR(N, force, 1e-6);
            const taut::Link &rope = view.scene.links[0];
            const double length = std::hypot(rise - y, 10.);
            EXPECT_NEAR(rope.length, length, 1e-9);
            EXPECT_NEAR(rope.unstressed_length, length * (1. - H * length / 10. / 5e5), 1e-9);
          });
}

TEST(MidPoint, clamps_on_the_messenger_wire_raise_its_tension_between_them)
{
  // The clamps are 4 m apart, so that the ropes run over 8 m.
  at_rest(line, {"Catenary/Mid-point ropes/Messenger distance=4"},
          [](const taut::StepView &view)
          {
            const double T = 12000., H = 800., w = .8 * g, y = displacement(view, 0, 48.),
                         before = y / 48. + w * 48. / (2. * T),
                         behind = -y / 2. - w * 2. / (2. * (T + H)),
                         force = view.state.multiplier[0];
            EXPECT_NEAR(force, H / 8. * (1.2 + y - displacement(view, 1, 40.)), 1e-6);
            EXPECT_NEAR(T * before - (T + H) * behind, -force, 1e-6);
          });
}

TEST(MidPoint, droppers_and_heights_stay_beside_a_mid_point)
{
  // The ropes take over a part of what the droppers carry, and the heights remain.
  const Overrides droppers = {"Catenary/Droppers/Positions=5, 15, 25, 35, 45",
                              "Catenary/Mid-point ropes/Mass per length=0.3",
                              "Catenary/Heights=0.1"};
  at_rest(line, droppers,
          [](const taut::StepView &view)
          {
            double sum = 0.;
            for (std::size_t i = 0; i < view.scene.links.size(); ++i)
            {
              const taut::Link &link = view.scene.links[i];
              if (link.name.find("dropper") == 0 && link.to.position > 50.)
              {
                EXPECT_NEAR(displacement(view, 1, link.to.position), .1, 1e-9) << link.name;
              }
              if (link.to.position > 50.)
                sum += view.state.multiplier[i];
              if (link.name == "mid-point rope 1 right")
              {
                EXPECT_NEAR(view.state.multiplier[i], 80. * (1.2 + .1 - displacement(view, 1, 60.)),
                            1e-6);
              }
            }
            // Half of the last 5 m hang on the end. A rope has half of its 10.07 m on the wire.
            EXPECT_NEAR(sum, g * 47.5 + .5 * .3 * g * view.scene.links[11].length, 1e-6);
          });
}

namespace
{
  /// Two strings with a rope from 20 m to 28 m, and a force on the lower one at 28 m.
  const std::string strings = R"(Start = equilibrium
Wire upper: From = 0, 2; To = 50, 2; Components = string; Mass per length = 0.8; Tension = 12000; Element size = 1
Wire lower: From = 0, 0; To = 50, 0; Components = string; Mass per length = 1; Tension = 10000; Element size = 1
Support upper: Wire = upper; Positions = 0, 50
Support lower: Wire = lower; Positions = 0, 50
Link rope: Type = dropper; From = upper @ 20; To = lower @ 28; Direction = 0, -1; Find length = true; Pull = 900; Axial stiffness = 3e5
Load push: On = lower @ 28; Direction = 0, 1; Magnitude = 0; Acts while built = false
Time: Step = 1e-3; End = 0; Scheme = backward Euler
)";
} // namespace

TEST(MidPoint, a_rope_resists_as_an_elastic_rope_that_turns)
{
  double upper = 0., lower = 0., force = 0., h = 0.;
  at_rest(strings, {},
          [&](const taut::StepView &view)
          {
            upper = displacement(view, 0, 20.);
            lower = displacement(view, 1, 28.);
            force = view.state.multiplier[0];
            h = 2. + upper - lower;
            EXPECT_NEAR(force, 900. / 8. * h, 1e-6);
          });
  at_rest(strings, {"Network/Load push/Magnitude=30"},
          [&](const taut::StepView &view)
          {
            const double length = std::hypot(h, 8.), T = 900. * length / 8.,
                         k = (3e5 * h * h + T * 64.) / (length * length * length),
                         of_upper = 20. * 30. / 50. / 12000., of_lower = 28. * 22. / 50. / 10000.;
            // The rope loses k times what its ends approach each other.
            const double lost = 30. * of_lower * k / (1. + k * (of_upper + of_lower));
            EXPECT_NEAR(force - view.state.multiplier[0], lost, 1e-8);
            EXPECT_NEAR(displacement(view, 1, 28.) - lower, of_lower * (30. - lost), 1e-11);
            EXPECT_NEAR(displacement(view, 0, 20.) - upper, of_upper * lost, 1e-11);
          });
}

TEST(MidPoint, in_space_a_rope_pulls_along_its_direction)
{
  // Stagger moves the ends of the ropes aside; forces are 80 N/m times the distances.
  at_rest(line, {"Catenary/Contact wire/Stagger=0.3, 0.3, 0.3"},
          [](const taut::StepView &view)
          {
            const taut::Link &rope = view.scene.links[0];
            const double aside = displacement(view, 1, 40., {0., 0., 1.}) -
                                 displacement(view, 0, 50., {0., 0., 1.}),
                         down = 1.2 - displacement(view, 1, 40.), N = view.state.multiplier[0];
            EXPECT_GT(aside, .2);
            EXPECT_NEAR(-N * rope.direction.y, 80. * down, 1e-6);
            EXPECT_NEAR(N * rope.direction.z, 80. * aside, 1e-6);
            // Equilibrium of the contact wire aside: two straight parts from the ends.
            const double z = displacement(view, 1, 40., {0., 0., 1.});
            EXPECT_NEAR(10000. * (.3 - z) / 40. - 9200. * (z - .3) / 10., 80. * aside, 1e-6);
          });
}

TEST(MidPoint, ropes_that_are_none_are_refused)
{
  const auto error = [](const std::string &scene, const std::string &entry)
  { return error_of([&] { Session(scene, {entry}); }); };
  EXPECT_TRUE(has(error(line, "Catenary/Mid-points=0, 101, 0"), "beyond a neighbouring mast"));
  EXPECT_TRUE(has(error(line, "Catenary/Mid-points=20, 20"), "2 values for 3 masts"));
  EXPECT_TRUE(has(error(line, "Catenary/Mid-point ropes/Pull=0"), "needs a pull above 0"));
  EXPECT_TRUE(has(error(line, "Catenary/Mid-point ropes/Pull=1e4"), "less than its tension"));
  EXPECT_TRUE(has(error(line, "Catenary/Mid-point ropes/Axial stiffness=0"), "give that of the"));
  EXPECT_TRUE(
      has(error(line, "Catenary/Mid-point ropes/Messenger distance=20"), "run outwards from"));
  const std::string rail = "Generator = catenary\nCatenary: Kind = conductor rail; Pantographs =\n"
                           "Catenary/Contact wire: Mass per length = 6; Tension = 0\n"
                           "Catenary/Supports: Arm stiffness = 1e6\nTime: Step = 1; End = 0\n";
  EXPECT_EQ(error(rail, "Catenary/Mid-points=0"), "");
  for (const char *const entry :
       {"Catenary/Mid-points=9", "Catenary/Stitch lengths=9", "Catenary/Contact wire/Stagger=0.3",
        "Catenary/Messenger wire/Stagger=0.3", "Catenary/Supports/Arm kind=rigid body"})
    EXPECT_TRUE(has(error(rail, entry), "moves in the plane")) << entry;
  EXPECT_TRUE(has(error(strings, "Network/Link rope/To=lower @ 20"), "above each other"));
  EXPECT_TRUE(has(error(strings, "Network/Link rope/Find length=false"), "'Find length = true'"));
  EXPECT_TRUE(
      has(error(strings, "Network/Link rope/Prescribed displacement=0.1"), "leave one of them"));
}
