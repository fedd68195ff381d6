// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: the forces of supports are those that hold the bodies. Sources: sums of forces and moments
// (statics); the momentum of a whole string, whose rate is the sum of all forces on it (motion);
// m L a of a bar whose end is moved with constant acceleration.
#include "run.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numeric>
#include <string>

using namespace verification;

namespace
{
  std::string file_text(const std::string &path)
  {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  /// Rate of the momentum of the first body minus the forces on it that are not of supports.
  double momentum_balance(const taut::StepView &step)
  {
    const taut::Substructure &body = step.structure[0];
    std::vector<double> inertia(body.n_dofs(), 0.), P;
    body.mass().vmult_add(1., step.state.A[0].data(), inertia.data());
    body.external_force(step.state.time, P);
    double sum = 0.;
    // Only displacements: a rigid translation is 1 for each of them.
    for (unsigned int i = 0; i < body.n_dofs(); ++i)
      if (body.kind(i) == 0)
        sum += inertia[i] - P[i];
    return sum;
  }

  const char *const string_with_three_supports = R"(set Generator = network
subsection Network
  set Wires    = string
  set Supports = ends, spring
  set Loads    = push
  subsection Wire string
    set To              = 12, 0
    set Components      = string
    set Mass per length = 2
    set Tension         = 400
    set Element size    = 0.5
  end
  subsection Support ends
    set Wire      = string
    set Positions = 0, 12
    set Displacement = 0.01*sin(9*t)
  end
  subsection Support spring
    set Wire      = string
    set Positions = 5
    set Type      = elastic
    set Stiffness = 300
    set Damping   = 8
  end
  subsection Load push
    set Type      = distributed
    set On        = string @ 0
    set Magnitude = 3*sin(7*t)*(1+s)
  end
end
subsection Time
  set Scheme = BDF2
  set Step   = 2e-3
  set End    = 1
end
)";
} // namespace

// Half of the string and of its tension, and the mass that a rigid dropper hangs at the support.
TEST(Reactions, of_a_rigid_link_at_a_support_are_its_force)
{
  const std::string hung = R"(set Generator = network
set Gravity = 0, -9.81
set Start   = equilibrium
subsection Network
  set Wires    = string
  set Masses   = mass
  set Supports = ends
  set Links    = dropper
  subsection Wire string
    set To              = 10, 0
    set Components      = string
    set Tension         = 1000
    set Mass per length = 1
    set Element size    = 0.5
    set Weight          = true
  end
  subsection Support ends
    set Wire      = string
    set Positions = 0, 10
  end
  subsection Mass mass
    set Position = 10, -1
    set Mass     = 10
  end
  subsection Link dropper
    set Type      = dropper
    set From      = string @ 10
    set To        = mass
    set Direction = 0, -1
    set Stiffness = rigid
  end
end
subsection Time
  set Step = 1e-2
  set End  = 0.1
end
)";
  for (const char *const scheme : {"automatic", "BDF2"})
    run_scene(hung, {std::string("Time.Scheme=") + scheme},
              [&](const taut::StepView &step)
              {
                ASSERT_EQ(step.supports.size(), 2u);
                EXPECT_NEAR(step.supports[0], 49.05, 1e-9) << scheme << " " << step.state.time;
                EXPECT_NEAR(step.supports[1], 147.15, 1e-9) << scheme << " " << step.state.time;
              });
}

TEST(Reactions, of_the_guyed_mast_are_sums_of_forces)
{
  // The left guy pulls with N = 520.833 N from 3/5 left and 4/5 below; the wind pushes with 500 N
  // to the right. The normal of the mast points to the left.
  const double N = 50. * 10. * 10. / (2. * .6 * 8.);
  run_scene(scene_file("guyed_mast"), {"Time.End=1e-3"},
            [&](const taut::StepView &step)
            {
              if (step.state.time > 0.)
                return;
              ASSERT_EQ(step.supports.size(), 2u);
              EXPECT_NEAR(step.supports[0], 500. - .6 * N, 1e-9 * N);
              EXPECT_NEAR(step.supports[1], .8 * N, 1e-9 * N);
            });
}

TEST(Reactions, of_a_clamp_are_force_and_moment_of_beam_theory)
{
  // A cantilever of 3 m with 7 N/m and 40 N at its tip: 61 N and 7 L^2/2 + 40 L = 151.5 N m.
  Session session(R"(set Generator = network
set Gravity = 0, 0
subsection Network
  set Wires    = beam
  set Supports = clamp, clamp slope
  set Loads    = tip, line
  subsection Wire beam
    set To                = 3, 0
    set Components        = beam
    set Mass per length   = 1
    set Bending stiffness = 2000
    set Element size      = 0.3
  end
  subsection Support clamp
    set Wire = beam
  end
  subsection Support clamp slope
    set Wire   = beam
    set Motion = slope
  end
  subsection Load tip
    set On        = beam @ 3
    set Direction = 0, -1
    set Magnitude = 40
  end
  subsection Load line
    set Type      = distributed
    set On        = beam @ 0
    set Direction = 0, -1
    set Magnitude = 7
  end
end
)",
                  {"Time.End=0"});
  session.run([](const taut::StepView &) {});
  const std::string table = file_text(session.folder() + "/supports.csv");
  ASSERT_EQ(table.substr(0, table.find('\n')), "time [s],clamp force [N],clamp slope moment [N m]");
  double time, force, moment;
  ASSERT_EQ(std::sscanf(table.c_str() + table.find('\n'), "%lf,%lf,%lf", &time, &force, &moment),
            3);
  EXPECT_NEAR(force, 61., 1e-8);
  EXPECT_NEAR(moment, 151.5, 1e-7);
}

TEST(Reactions, and_loads_are_the_rate_of_momentum)
{
  double worst = 0., largest = 0.;
  std::vector<double> last;
  run_scene(string_with_three_supports, {},
            [&](const taut::StepView &step)
            {
              last = step.supports;
              const double sum = std::accumulate(last.begin(), last.end(), 0.);
              worst = std::max(worst, std::fabs(momentum_balance(step) - sum));
              largest = std::max(largest, std::fabs(sum));
            });
  EXPECT_GT(largest, 10.);
  EXPECT_LT(worst, 1e-8 * largest);
  figure("momentum of a string against its forces, relative", worst / largest);

  // A wire in pieces is held by the same forces.
  std::vector<double> in_pieces;
  run_scene(string_with_three_supports, {"Partition.Number of substructures=3"},
            [&](const taut::StepView &step)
            {
              EXPECT_EQ(step.structure.size(), 3u);
              in_pieces = step.supports;
            });
  for (std::size_t i = 0; i < last.size(); ++i)
    EXPECT_NEAR(in_pieces[i], last[i], 1e-7 * largest) << i;
}

TEST(Reactions, of_a_bar_that_is_pulled_with_constant_acceleration)
{
  // After the waves have been damped away the end pulls with m L a = 3 * 2 * 5 = 30 N.
  double force = 0.;
  run_scene(R"(set Generator = network
set Gravity = 0, 0
subsection Network
  set Wires    = bar
  set Supports = hand
  subsection Wire bar
    set To                = 2, 0
    set Components        = bar
    set Mass per length   = 3
    set Axial stiffness   = 1000
    set Element size      = 0.25
    set Stiffness damping = 0.02
  end
  subsection Support hand
    set Wire         = bar
    set Positions    = 2
    set Motion       = axial
    set Displacement = 2.5*t^2
  end
end
subsection Time
  set Scheme = BDF2
  set Step   = 5e-3
  set End    = 10
end
)",
            {}, [&](const taut::StepView &step) { force = step.supports.at(0); });
  EXPECT_NEAR(force, 30., 1e-6);
}
