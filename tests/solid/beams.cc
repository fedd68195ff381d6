// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: slender solids are the beams of wires. Expected values: the same scene with a wire.
#include "verification/run.h"

#include <taut/substructure/local_solver.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace
{
  /// 50 m x 1 m x 1 m, clamped at the left end, 1 kN at the right one.
  const std::string solid = R"(set Generator = network
set Gravity = 0, 0
set Bodies = beam
subsection Body beam
  set Type = solid
  set Degree = 2
  set Young's modulus = 1e9
  set Density = 1e3
  set Plane state = stress
  set Fixed boundaries = 0
  set Traction = 1: 0, -1e3
  subsection Mesh
    set Arguments = 100, 4 : 0, -0.5 : 50, 0.5
  end
end
subsection Time
  set End = 0
end
subsection Output
  set Probes = tip
  subsection Probe tip
    set Point = beam @ 50, 0
    set Direction = 0, 1
  end
end
)",
                    wire = R"(set Generator = network
set Gravity = 0, 0
subsection Network
  set Wires = beam
  set Supports = clamp, slope
  set Loads = force
  subsection Wire beam
    set From = 0, 0
    set To = 50, 0
    set Components = beam
    set Mass per length = 1e3
    set Bending stiffness = 8.33333333333333333e7
    set Element size = 1
  end
  subsection Support clamp
    set Wire = beam
  end
  subsection Support slope
    set Wire = beam
    set Motion = slope
  end
  subsection Load force
    set On = beam @ 50
    set Direction = 0, 1
    set Magnitude = -1e3
  end
end
subsection Time
  set End = 0
end
subsection Output
  set Probes = tip
  subsection Probe tip
    set Point = beam @ 50
    set Direction = 0, 1
  end
end
)";

  /// By inverse iteration [rad/s].
  double first_frequency(const taut::Substructure &body)
  {
    std::vector<double> x(body.n_dofs(), 1.);
    const auto solver = taut::make_local_solver("sparse direct", body.stiffness());
    solver->factor({{1., &body.stiffness()}}, body.constrained_dofs());
    double omega2 = 0.;
    for (int iteration = 0; iteration < 20; ++iteration)
    {
      std::vector<double> Mx(x.size(), 0.), My(x.size(), 0.);
      body.mass().vmult_add(1., x.data(), Mx.data());
      x = Mx;
      solver->solve(x);
      body.mass().vmult_add(1., x.data(), My.data());
      const double yMy = std::inner_product(x.begin(), x.end(), My.begin(), 0.);
      omega2 = std::inner_product(x.begin(), x.end(), Mx.begin(), 0.) / yMy;
      for (double &value : x)
        value /= std::sqrt(yMy);
    }
    return std::sqrt(omega2);
  }

  struct Beam
  {
    double tip = 0., frequency = 0.;
  };
  Beam cantilever(const std::string &scene)
  {
    Beam beam;
    verification::run_scene(scene, {},
                            [&](const taut::StepView &view)
                            {
                              const taut::Probe &probe = view.scene.probes[0];
                              std::vector<taut::Term> terms;
                              view.structure.motion(probe.point, false, probe.direction, 1., terms);
                              beam.tip = verification::displacement(view, terms);
                              beam.frequency = first_frequency(view.structure[0]);
                            });
    return beam;
  }

  /// The mast of prm/guyed_mast.prm as a solid: width^2 = 12 EI / EA, on a hinge at one point.
  const std::string mast = R"(set Generator = network
set Gravity = 0, 0
set Bodies = mast
subsection Body mast
  set Type = solid
  set Degree = 2
  set Young's modulus = 12909944.4873580562
  set Density = 12.9099444873580562
  set Plane state = stress
  set Traction = 0: 50*cos(pi*t/4), 0
  set Mass damping = 2
  subsection Mesh
    set Arguments = 4, 40 : -0.387298334620741689, 0 : 0.387298334620741689, 10
  end
end
subsection Network
  set Links = hinge, foot, left guy, right guy
  subsection Link hinge
    set Type = joint
    set From = ground
    set To = mast @ 0, 0
    set Direction = 1, 0
  end
  subsection Link foot
    set Type = joint
    set From = ground
    set To = mast @ 0, 0
    set Direction = 0, 1
  end
  subsection Link left guy
    set Type      = dropper
    set From      = ground
    set To        = mast @ 0, 8
    set Direction = 6, 8
    set Stiffness = 1e5
  end
  subsection Link right guy
    set Type      = dropper
    set From      = ground
    set To        = mast @ 0, 8
    set Direction = -6, 8
    set Stiffness = 1e5
  end
end
subsection Time
  set Scheme = automatic
  set Step = 4e-3
  set End = 4
end
)";

  struct Guys
  {
    double windward = 0., slack = 0.; ///< at the start [N, m]
    double at_end = 0.;               ///< of the other guy [N]
  };
  Guys guys(const std::string &scene, const std::string &left, const std::string &right,
            const verification::Overrides &overrides = {})
  {
    Guys result;
    verification::run_scene(scene, overrides,
                            [&](const taut::StepView &view)
                            {
                              for (std::size_t i = 0; i < view.scene.links.size(); ++i)
                              {
                                const std::size_t k = view.constraints.index_of_link(i);
                                const std::string &name = view.scene.links[i].name;
                                if (view.state.time == 0. && name == left)
                                  result.windward = view.state.multiplier[k];
                                if (view.state.time == 0. && name == right)
                                  result.slack = view.state.geometric_gap[k];
                                if (name == right)
                                  result.at_end = view.state.multiplier[k];
                              }
                            });
    return result;
  }
} // namespace

TEST(SolidBeams, a_slender_one_bends_and_swings_as_a_wire)
{
  const Beam of_solid = cantilever(solid), of_wire = cantilever(wire);
  verification::figure("tip of a solid of 50 x 1 over that of a beam", of_solid.tip / of_wire.tip);
  verification::figure("its first frequency", of_solid.frequency / of_wire.frequency);
  EXPECT_NEAR(of_solid.tip / of_wire.tip, 1., 5e-3);
  EXPECT_NEAR(of_solid.frequency / of_wire.frequency, 1., 5e-3);
}

// A statically determinate force is the same to rounding. The slack also has what the foot yields
// at the point that it stands on.
TEST(SolidBeams, a_mast_on_guys_stands_as_that_of_a_wire)
{
  const Guys of_solid = guys(mast, "left guy", "right guy"),
             of_wire = guys(verification::scene_file("guyed_mast"), "left guy", "right guy",
                            {"Time/Step=4e-3"});
  verification::figure("windward guy of a mast, solid over wire",
                       of_solid.windward / of_wire.windward);
  verification::figure("slack of the leeward guy, solid over wire", of_solid.slack / of_wire.slack);
  verification::figure("guy after the wind has turned, solid over wire",
                       of_solid.at_end / of_wire.at_end);
  EXPECT_NEAR(of_wire.windward, 520.8333, 1e-3);
  EXPECT_NEAR(of_solid.windward / of_wire.windward, 1., 1e-8);
  EXPECT_NEAR(of_solid.slack / of_wire.slack, 1., 2.5e-2);
  EXPECT_NEAR(of_solid.at_end / of_wire.at_end, 1., 1e-2);
}
