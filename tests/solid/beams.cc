// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: slender solids are the beams of wires. Expected values: the same scene with a wire.
#include "solid/first_frequency.h"
#include "verification/scene_tests.h"

namespace
{
  using namespace verification;
  /// 50 m x 1 m x 1 m, clamped at the left end, 1 kN at the right one.
  const std::string solid = R"(Generator = network; Gravity = 0, 0
Body beam: Type = solid; Degree = 2; Young's modulus = 1e9; Density = 1e3; Plane state = stress;
  Fixed boundaries = 0; Traction = 1: 0, -1e3
Body beam/Mesh: Arguments = 100, 4 : 0, -0.5 : 50, 0.5
Time: End = 0
Probe tip: Point = beam @ 50, 0; Direction = 0, 1
)",
                    wire = R"(Gravity = 0, 0
Wire beam: From = 0, 0; To = 50, 0; Components = beam; Mass per length = 1e3;
  Bending stiffness = 8.33333333333333333e7; Element size = 1
Support clamp: Wire = beam
Support slope: Wire = beam; Motion = slope
Load force: On = beam @ 50; Direction = 0, 1; Magnitude = -1e3
Time: End = 0
Probe tip: Point = beam @ 50; Direction = 0, 1
)";

  struct Beam
  {
    double tip = 0., frequency = 0.;
  };
  Beam cantilever(const std::string &scene)
  {
    Beam beam;
    run_scene(scene, {},
              [&](const taut::StepView &view)
              {
                beam.tip = view.probes[0];
                beam.frequency = first_frequency(view.structure[0]);
              });
    return beam;
  }

  /// The mast of prm/guyed_mast.prm as a solid: width^2 = 12 EI / EA, on a hinge at one point.
  const std::string mast = R"(Gravity = 0, 0
Body mast: Type = solid; Degree = 2; Young's modulus = 12909944.4873580562;
  Density = 12.9099444873580562; Plane state = stress; Traction = 0: 50*cos(pi*t/4), 0;
  Mass damping = 2
Body mast/Mesh: Arguments = 4, 40 : -0.387298334620741689, 0 : 0.387298334620741689, 10
Link hinge: Type = joint; From = ground; To = mast @ 0, 0; Direction = 1, 0
Link foot: Type = joint; From = ground; To = mast @ 0, 0; Direction = 0, 1
Link left guy: Type = dropper; From = ground; To = mast @ 0, 8; Direction = 6, 8; Stiffness = 1e5
Link right guy: Type = dropper; From = ground; To = mast @ 0, 8; Direction = -6, 8;
  Stiffness = 1e5
Time: Scheme = automatic; Step = 4e-3; End = 4
)";

  struct Guys
  {
    double windward = 0., slack = 0.; ///< at the start [N, m]
    double at_end = 0.;               ///< of the other guy [N]
  };
  Guys guys(const std::string &scene, const Overrides &overrides = {})
  {
    Guys result;
    const auto record = [&](const taut::StepView &view)
    {
      for (std::size_t i = 0; i < view.scene.links.size(); ++i)
      {
        const std::size_t k = view.constraints.index_of_link(i);
        const std::string &name = view.scene.links[i].name;
        if (view.state.time == 0. && name == "left guy")
          result.windward = view.state.multiplier[k];
        if (view.state.time == 0. && name == "right guy")
          result.slack = view.state.distance[k];
        if (name == "right guy")
          result.at_end = view.state.multiplier[k];
      }
    };
    run_scene(scene, overrides, record);
    return result;
  }
} // namespace

TEST(SolidBeams, a_slender_one_bends_and_swings_as_a_wire)
{
  const Beam of_solid = cantilever(solid), of_wire = cantilever(wire);
  figure("tip of a solid of 50 x 1 over that of a beam", of_solid.tip / of_wire.tip);
  figure("its first frequency", of_solid.frequency / of_wire.frequency);
  EXPECT_NEAR(of_solid.tip / of_wire.tip, 1., 5e-3);
  EXPECT_NEAR(of_solid.frequency / of_wire.frequency, 1., 5e-3);
}

// A statically determinate force is the same to rounding. The slack has what the foot yields, too.
TEST(SolidBeams, a_mast_on_guys_stands_as_that_of_a_wire)
{
  const Guys of_solid = guys(mast), of_wire = guys(scene_file("guyed_mast"), {"Time/Step=4e-3"});
  figure("windward guy of a mast, solid over wire", of_solid.windward / of_wire.windward);
  figure("slack of the leeward guy, solid over wire", of_solid.slack / of_wire.slack);
  figure("guy after the wind has turned, solid over wire", of_solid.at_end / of_wire.at_end);
  EXPECT_NEAR(of_wire.windward, 520.8333, 1e-3);
  EXPECT_NEAR(of_solid.windward / of_wire.windward, 1., 1e-8);
  EXPECT_NEAR(of_solid.slack / of_wire.slack, 1., 2.5e-2);
  EXPECT_NEAR(of_solid.at_end / of_wire.at_end, 1., 1e-2);
}
