// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: a straight cable that is compressed by more than it bears gives way, and does not push.
// The log says so, with the size of the disturbance. Expected values: free flight; the spring EA /
// L of a rod that bears the force; the growth of an Euler column.
#include "verification/scene_tests.h"

namespace
{
  using namespace verification;
  using namespace taut;

  /// A rope hangs from the origin with a mass that is thrown up.
  const std::string thrown_up = R"(Generator = network; Gravity = 0, -9.81; Start = given
Body rope: Type = cable; From = 0, 0; To = 0, -1; Unstressed length = 1; Axial stiffness = 1e5
Body rope: Mass per length = 0.01; Element = bar; Elements = 8; Held ends = from
Body rope: Axial damping = 100
Mass load: Position = 0, -1; Motions = x, y; Mass = 1; Initial velocity = 0, 3, 0
Link eye: Type = ball joint; From = rope @ 1, 0; To = load
Probe load: Point = load
Time: Step = 2e-4; End = 0.4
)";

  double largest(const std::string &scene, const Overrides &overrides, std::string &log)
  {
    double result = 0.;
    log = log_of(scene, overrides,
                 [&](const StepView &step) { result = std::max(result, step.probes[0]); });
    return result;
  }
} // namespace

// The mass flies to v^2 / 2 g, but for what the rope takes until it has given way: less with
// shorter steps.
TEST(CableDisturbances, rope_thrown_up)
{
  const double height = 9. / (2. * 9.81);
  std::string log;
  const double found = largest(thrown_up, {}, log);
  figure("height of a mass thrown up on a rope, over that of free flight", found / height);
  EXPECT_GT(found, .88 * height);
  EXPECT_LT(found, height);
  EXPECT_TRUE(has(log, "It is straight there: moved by 0.001 m across its line (Disturbance), it "
                       "gives way"))
      << log;
  EXPECT_GT(largest(thrown_up, {"Time/Step=5e-5"}, log), found);
  for (const char *const scheme : {"backward Euler", "BDF2"})
    EXPECT_GT(largest(thrown_up, {std::string("Time/Scheme=") + scheme}, log), .88 * height)
        << scheme;
  // Without it, a rod.
  EXPECT_LT(largest(thrown_up, {"Body rope/Disturbance=0"}, log), .01);
  EXPECT_TRUE(has(log, "It is straight there, and pushes, as its Disturbance is 0")) << log;
}

// A heavier rope of ANCF along z, without gravity and damping, that bends a little: a mass pushes
// it along. Its Euler load is pi^2 EI / (4 L^2) = 6e-5 N, and a stiffer one bears all.
TEST(CableDisturbances, a_rope_and_a_strut_along_z)
{
  const std::string scene = R"(Generator = network; Gravity = 0, 0; Start = given
Body rope: Type = cable; From = 0, 0, 0; To = 0, 0, 2; Unstressed length = 2
Body rope: Axial stiffness = 2e4; Bending stiffness = 1e-4; Mass per length = 0.05; Elements = 10
Body rope: Held ends = from
Mass load: Position = 0, 0, 2; Motions = z; Mass = 5; Initial velocity = 0, 0, 0, -0.5
Link eye: Type = joint; From = rope @ 2, 0; To = load; Direction = 0, 0, 1
Link guide x: Type = joint; From = rope @ 2, 0; To = ground; Direction = 1, 0, 0
Link guide y: Type = joint; From = rope @ 2, 0; To = ground; Direction = 0, 1, 0
Probe load: Point = load; Direction = 0, 0, -1
Time: Step = 5e-4; End = 0.2
)";
  std::string log;
  // It goes on at 0.5 m/s, but for what rope and bending take.
  const double way = largest(scene, {}, log);
  figure("way of a mass that pushes a rope, over that of free flight", way / (.5 * .2));
  EXPECT_GT(way, .8 * .5 * .2);
  EXPECT_TRUE(has(log, "moved by 0.002 m across its line")) << log;
  // v sqrt(m / k) with k = EA / L; a little mass of the rope is with it.
  EXPECT_NEAR(
      largest(scene, {"Body rope/Bending stiffness=2e4", "Body rope/Mass per length=0.001"}, log),
      .5 * std::sqrt(5. / 1e4), 1e-4);
  EXPECT_FALSE(has(log, "It is straight there")) << log;
}

// A pinned column of ANCF under twice its Euler load, P_E = pi^2 EI / L^2. Expected: its first mode
// alone grows, as exp(s t) with s^2 = (pi / L)^2 (P - P_E) / m, in every scheme.
TEST(CableDisturbances, a_column_buckles_in_every_scheme)
{
  const std::string column = R"(Generator = network; Gravity = 0, 0; Start = given
Body column: Type = cable; From = 0, 0; To = 1, 0; Unstressed length = 1; Elements = 8
Body column: Axial stiffness = 1e4; Bending stiffness = 1; Mass per length = 1; Axial damping = 100
Body column: Held ends = from
Link guide y: Type = joint; From = column @ 1, 0; To = ground; Direction = 0, 1, 0
Link guide z: Type = joint; From = column @ 1, 0; To = ground; Direction = 0, 0, 1
Load push: On = column @ 1, 0; Direction = -1, 0; Magnitude = 2*pi^2*min(t/0.1, 1)
Probe middle: Point = column @ 0.5, 0; Direction = 0, 1
Time: Step = 2e-3; End = 1.3; Allow unsuitable scheme = true
)";
  // Above what else the disturbance leaves, and before the column is shorter than straight.
  constexpr double least = 1e-3, most = .03;
  for (const std::string scheme :
       {"generalised-alpha", "HHT", "Newmark", "BDF2", "backward Euler", "Moreau-Jean"})
  {
    double from = 0., to = 0., w_from = 0., w_to = 0.;
    run_scene(column, {"Time/Scheme=" + scheme},
              [&](const StepView &view)
              {
                const double w = std::fabs(view.probes[0]);
                if (w > least && from == 0.)
                {
                  from = view.state.time;
                  w_from = w;
                }
                if (w < most && w_to <= w)
                {
                  to = view.state.time;
                  w_to = w;
                }
              });
    const double rate = std::log(w_to / w_from) / (to - from) / (pi * pi);
    figure("growth of a column that buckles, " + scheme + ", over s", rate);
    EXPECT_NEAR(rate, 1., .03) << scheme;
  }
}
