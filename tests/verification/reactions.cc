// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: the forces of supports are those that hold the bodies. Sources: sums of forces and moments
// (statics); the momentum of a whole string, whose rate is the sum of all forces on it (motion);
// m L a of a bar whose end is moved with constant acceleration.
#include "scene_tests.h"

using namespace verification;

namespace
{
  /// Rate of the momentum of the first body minus the forces on it that are not of supports.
  double momentum_balance(const taut::StepView &step)
  {
    const taut::Substructure &body = step.structure[0];
    const std::vector<double> inertia = matrix_times(body.mass(), step.state.A[0]);
    std::vector<double> P;
    body.external_force(step.state.time, P);
    double sum = 0.;
    // Only displacements: a rigid translation is 1 for each of them.
    for (unsigned int i = 0; i < body.n_dofs(); ++i)
      if (body.kind(i) == 0)
        sum += inertia[i] - P[i];
    return sum;
  }

  const char *const string_with_three_supports =
      R"(Wire string: To = 12, 0; Components = string; Mass per length = 2; Tension = 400;
  Element size = 0.5
Support ends: Wire = string; Positions = 0, 12; Displacement = 0.01*sin(9*t)
Support spring: Wire = string; Positions = 5; Type = elastic; Stiffness = 300; Damping = 8
Load push: Type = distributed; On = string @ 0; Magnitude = 3*sin(7*t)*(1+s)
Time: Scheme = BDF2; Step = 2e-3; End = 1
)";
} // namespace

// Half of the string and of its tension, and the mass that a rigid dropper hangs at the support.
TEST(Reactions, of_a_rigid_link_at_a_support_are_its_force)
{
  const std::string hung = R"(Gravity = 0, -9.81; Start = equilibrium
Wire string: To = 10, 0; Components = string; Tension = 1000; Mass per length = 1;
  Element size = 0.5; Weight = true
Support ends: Wire = string; Positions = 0, 10
Mass mass: Position = 10, -1; Mass = 10
Link dropper: Type = dropper; From = string @ 10; To = mass; Direction = 0, -1; Stiffness = rigid
Time: Step = 1e-2; End = 0.1
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
  Session session(R"(Gravity = 0, 0
Wire beam: To = 3, 0; Components = beam; Mass per length = 1; Bending stiffness = 2000;
  Element size = 0.3
Support clamp: Wire = beam
Support clamp slope: Wire = beam; Motion = slope
Load tip: On = beam @ 3; Direction = 0, -1; Magnitude = 40
Load line: Type = distributed; On = beam @ 0; Direction = 0, -1; Magnitude = 7
)",
                  {"Time.End=0"});
  session.run();
  const auto table = read_table(session.folder() + "/supports.csv");
  ASSERT_EQ(table.size(), 3u);
  EXPECT_NEAR(table.at("clamp force [N]").at(0), 61., 1e-8);
  EXPECT_NEAR(table.at("clamp slope moment [N m]").at(0), 151.5, 1e-7);
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
              raise(worst, momentum_balance(step) - sum);
              raise(largest, sum);
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
  run_scene(R"(Gravity = 0, 0
Wire bar: To = 2, 0; Components = bar; Mass per length = 3; Axial stiffness = 1000;
  Element size = 0.25; Stiffness damping = 0.02
Support hand: Wire = bar; Positions = 2; Motion = axial; Displacement = 2.5*t^2
Time: Scheme = BDF2; Step = 5e-3; End = 10
)",
            {}, [&](const taut::StepView &step) { force = step.supports.at(0); });
  EXPECT_NEAR(force, 30., 1e-6);
}
