// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: a run that leaves what the model holds for says so once, with the number. Source: the
// displacements, speeds and steps of the scenes, each compared by hand.
#include "scene_tests.h"

using namespace verification;

namespace
{
  Said run(const std::string &file, const Overrides &overrides, const Callback &callback = {})
  {
    return say(file, overrides + Overrides{"Output.Field interval=0"}, callback);
  }

  const std::string line = scene_file("en50318_2002_250"),
                    pantograph = "Catenary.Pantograph pantograph.";

  /// The warning of a kind, which is the only one of it; null if there is none.
  nlohmann::json find(const Said &said, const std::string &kind)
  {
    nlohmann::json found;
    for (const auto &warning : said.json.at("warnings"))
      if (warning.at("kind") == kind)
      {
        EXPECT_TRUE(found.is_null()) << "twice " << kind;
        found = warning;
      }
    if (!found.is_null())
    {
      const std::string text = "Warning: " + found.at("message").get<std::string>() + "\n";
      const std::size_t at = said.log.find(text);
      EXPECT_NE(at, std::string::npos) << said.log;
      EXPECT_FALSE(has(said.log, text, at + 1)) << "twice in the log";
    }
    return found;
  }
} // namespace

TEST(ModelLimits, nothing_is_said_of_the_reference_line)
{
  const Said said = run(line, {"Time.End=0.5", "Statistics.Window="});
  EXPECT_TRUE(said.json.at("warnings").empty()) << said.json.at("warnings");
  EXPECT_FALSE(has(said.log, "Warning"));
}

// Claim: a contact wire pushed through the messenger wire is seen. Expected: the largest approach
// of both at the pantograph, and the encumbrance of 1.2 m.
TEST(ModelLimits, a_wire_pushed_through_another)
{
  double approach = 0.;
  const Said said = run(line,
                        {"Time.End=0.02", "Statistics.Window=", pantograph + "Speed=0",
                         pantograph + "Start=270", pantograph + "Static force=12000"},
                        [&](const taut::StepView &view) {
                          approach = std::max(approach, displacement(view, 1, 270.) -
                                                            displacement(view, 0, 270.));
                        });
  const nlohmann::json distance = find(said, "distance"), slope = find(said, "slope");
  ASSERT_FALSE(distance.is_null());
  EXPECT_EQ(distance["limit"], 1.2);
  EXPECT_NEAR(distance["value"].get<double>(), approach, 1e-3 * approach);
  EXPECT_GT(approach, 10.);
  ASSERT_FALSE(slope.is_null());
  EXPECT_GT(slope["value"].get<double>(), .1);
  EXPECT_EQ(slope["unit"], "rad");
  figure("approach of the wires under 12 kN, limit 1.2 m", distance["value"].get<double>(), "m");
  figure("slope of the contact wire under 12 kN, limit 0.1 rad", slope["value"].get<double>(),
         "rad");
}

// Claim: so in a static scene. Expected: the sentence in the log.
TEST(ModelLimits, a_static_scene_is_watched_too)
{
  const std::string log = log_of(line, {"Time.End=0", pantograph + "Static force=12000"});
  EXPECT_TRUE(has(log, "Warning: wire 'contact' comes ")) << log;
}

// Claim: a contact faster than the waves is named. Expected: 500 km/h against sqrt(20000 N /
// 1.35 kg/m) = 121.716 m/s.
TEST(ModelLimits, a_contact_faster_than_the_waves)
{
  const auto speed_warning = [](const std::string &speed)
  {
    return find(run(line, {"Time.End=0.1", "Statistics.Window=", pantograph + "Speed=" + speed,
                           pantograph + "Faster than waves=true"}),
                "speed");
  };
  const nlohmann::json speed = speed_warning("500");
  ASSERT_FALSE(speed.is_null());
  EXPECT_NEAR(speed["value"].get<double>(), 500. / 3.6, 1e-9);
  EXPECT_NEAR(speed["limit"].get<double>(), std::sqrt(20000. / 1.35), 1e-9);
  for (const std::string slower : {"430", "438"})
    EXPECT_TRUE(speed_warning(slower).is_null());
}

// Claim: fewer than ten steps in a period of the filter are named. Expected: 1 / (60 Hz 2 ms) =
// 8.33 steps; ten at 50 Hz are enough.
TEST(ModelLimits, a_step_that_does_not_resolve_the_filter)
{
  const std::string frequency = "Statistics.Filter frequency=";
  const auto filter = [&](const std::string &hertz)
  {
    return find(
        run(line, {"Time.End=0.1", "Time.Step=2e-3", "Statistics.Window=", frequency + hertz}),
        "filter");
  };
  const nlohmann::json coarse = filter("60");
  ASSERT_FALSE(coarse.is_null());
  EXPECT_NEAR(coarse["value"].get<double>(), 1. / .12, 1e-9);
  EXPECT_EQ(coarse["limit"], 10.);
  EXPECT_TRUE(filter("50").is_null());
}

// Claim: motions along z count as those along y, and both together. Expected: slopes of a string
// under a force in its middle, F / 2 T along each.
TEST(ModelLimits, a_wire_in_space)
{
  const auto slope = [](const std::string &direction, const std::string &force)
  {
    const std::string scene = R"(Gravity = 0, 0
Wire line: To = 10, 0; Components = string, lateral; Mass per length = 1; Tension = 1000
Support ends: Wire = line; Positions = 0, 10
Support aside: Wire = line; Motion = lateral; Positions = 0, 10
Load push: On = line @ 5; Direction = )" +
                              direction + "; Magnitude = " + force + R"(
Time: Step = 0.01; End = 0.01
)";
    return find(run(scene, {}), "slope");
  };
  EXPECT_TRUE(slope("0, 0, 1", "190").is_null());
  EXPECT_NEAR(slope("0, 0, 1", "300")["value"].get<double>(), .15, 1e-9);
  EXPECT_NEAR(slope("0, 3, -4", "300")["value"].get<double>(), .15, 1e-9);
}

// Claim: a linearised cable is watched, from the start that it is linearised about; a nonlinear one
// is not. Expected: the same, F / 2 T under the tension at rest, in steps so long that nothing
// swings; none under a force that acts at the start already.
TEST(ModelLimits, a_linearised_cable)
{
  const auto slope = [](const std::string &geometry, const std::string &force)
  {
    const std::string scene =
        R"(Body span: Type = cable; From = 0, 0, 0; To = 60, 20, 0; Horizontal tension = 16e3;
  Axial stiffness = 13e6; Mass per length = 1.07; Element = bar; Elements = 64;
  Geometry = )" +
        geometry + R"(
Load push: On = span @ 31.6, 0; Direction = 0, 0, 1; Magnitude = )" +
        force + R"(
Time: Scheme = backward Euler; Step = 1000; End = 2000
)";
    return find(run(scene, {}), "slope");
  };
  const double tension = 16e3 * std::hypot(60., 20.) / 60.;
  EXPECT_TRUE(slope("linearised", "3000*(t>0)").is_null());
  EXPECT_TRUE(slope("linearised", "4000").is_null());
  EXPECT_TRUE(slope("nonlinear", "4000*(t>0)").is_null());
  const nlohmann::json said = slope("linearised", "4000*(t>0)");
  ASSERT_FALSE(said.is_null());
  EXPECT_NEAR(said["value"].get<double>(), 4000. / (2. * tension), .01);
  for (const char *const part : {"linearised cable 'span' turns by", "Geometry = nonlinear"})
    EXPECT_TRUE(has(said["message"].get<std::string>(), part)) << said;
  EXPECT_TRUE(has(said["message"].get<std::string>(), "Geometry = nonlinear"));
}

// Claim: a rigid body whose equilibrium is tilted far from its place is named: three stops beside
// its centre. One that stands on stops around its centre is not, and neither is one that only turns
// about the vertical. Expected: the rotation in rigid_bodies.csv.
TEST(ModelLimits, a_body_that_falls_off_its_stops)
{
  const auto box = [](const std::string &places)
  {
    return R"(Generator = network; Gravity = 0, -9.81
Body box: Type = rigid body; Mass = 10; Moments of inertia = 0.5, 0.6, 0.4
Link legs: Type = stop; From = ground; To = box @ )" +
           places + R"(; Direction = 0, 1; Stiffness = 1e6
Time: Step = 1e-3; End = 1e-3
Output: Observers = rigid bodies
)";
  };
  const Said beside = run(box("0.1, -0.2, 0; 0.3, -0.2, -0.2; 0.3, -0.2, 0.2"), {}),
             around = run(box("-0.3, -0.2, 0; 0.3, -0.2, -0.2; 0.3, -0.2, 0.2"), {});
  const nlohmann::json said = find(beside, "equilibrium");
  ASSERT_FALSE(said.is_null()) << beside.log;
  EXPECT_GT(said["value"].get<double>(), 1.);
  EXPECT_TRUE(find(around, "equilibrium").is_null());
}
