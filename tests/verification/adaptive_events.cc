// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: adaptive steps follow the rebounds of a ball with a restitution of 1/2 until these are
// slower than the tolerance tells apart, and then hold it; and they meet a given motion that jumps
// or is shorter than a step. Sources: heights e^2n and times of a bouncing ball; the answer of a
// mass on a spring whose other end jumps.
#include "scene_tests.h"

using namespace verification;

namespace
{

  Overrides adaptive(const std::string &tolerance)
  {
    return {"Time.Step control=adaptive", "Time.Adaptive step.Tolerance=" + tolerance};
  }

  const char *const ball =
      R"(Gravity = 0, -9.81; Start = given
Mass ball: Position = 0, 1; Motions = y; Mass = 1
Link stop: Type = stop; From = ground; To = ball; Direction = 0, 1; Gap = 1
Time: Step = 1e-3; End = 3
Time/Moreau-Jean: Restitution = 0.5
Time/Adaptive step: Halvings = 34
)";

  struct Bounces
  {
    std::vector<double> times, heights; ///< of impacts, of the flights after them [s], [m]
    double lost = 0., step = 0.;        ///< velocity of the rebound that is not followed, its step
    double held_since = 0., force = 0., gap = 0., end = 0.;
    long n_steps = 0;
    std::string log;
  };
  Bounces bounce(const std::string &tolerance)
  {
    Bounces found;
    double velocity = 0., last = 0.;
    bool was_closed = false;
    Session session(ball, adaptive(tolerance));
    session.run(
        [&](const taut::StepView &view)
        {
          const taut::State &state = view.state;
          const bool is_closed = state.multiplier[0] > 0.;
          const double v = state.V[0][0], gap = 1. + state.U[0][0];
          if (is_closed && !was_closed)
            found.times.push_back(state.time);
          if (is_closed && was_closed && velocity > 1e-9 && found.lost == 0.)
          {
            found.lost = velocity;
            found.step = state.time - last;
          }
          if (!is_closed && was_closed)
            found.heights.push_back(gap + .5 * v * v / g);
          if (!is_closed)
            found.held_since = state.time;
          ++found.n_steps;
          was_closed = is_closed;
          velocity = v;
          last = state.time;
          found.force = state.multiplier[0];
          found.gap = std::fabs(gap);
        });
    found.end = last;
    found.log = session.log();
    return found;
  }

  struct Shaken
  {
    double error = 0., longest_before = 0.; ///< [m], [s]
    long n_steps = 0;
  };
  /// A mass of 1 kg on a rod of 100 N/m without mass to speak of, whose other end moves. @p exact
  /// is the motion from t = 1 s on.
  Shaken shake(const std::string &motion, const double first, const Overrides &overrides,
               const std::function<double(double)> &exact)
  {
    Shaken found;
    double last = 0.;
    run_scene(R"(Gravity = 0, 0; Start = given
Wire rod: From = 0, 0; To = 0, 1; Components = bar; Mass per length = 1e-9;
  Axial stiffness = 100; Element size = 1; Degree = 1
Mass block: Position = 0, 1; Motions = y; Mass = 1
Link joint: Type = joint; From = rod @ 1; To = block; Direction = 0, 1
Time: Step = 1e-3; End = 2
Support shaker: Wire = rod; Positions = 0; Motion = axial; Displacement = )" +
                  motion + "\n",
              overrides,
              [&](const taut::StepView &view)
              {
                const double t = view.state.time, y = displacement(view, 0, 1., {0., 1.});
                if (t < 1.)
                  found.longest_before = std::max(found.longest_before, t - last);
                if (t > first)
                  raise(found.error, y - exact(t - 1.));
                ++found.n_steps;
                last = t;
              });
    return found;
  }
} // namespace

// The closed form has all impacts before 3 sqrt(2 h / g) = 1.3546 s.
TEST(AdaptiveEvents, a_ball_that_bounces_ever_lower_comes_to_rest)
{
  std::size_t before = 0;
  for (const std::string tolerance : {"1e-4", "1e-6", "1e-8"})
  {
    const Bounces found = bounce(tolerance);
    const double epsilon = std::stod(tolerance), fall = std::sqrt(2. / g),
                 slowest = std::sqrt(.5 * g * epsilon), flight = 2. * slowest / g;
    double height_error = 0., time_error = 0., time = fall, height = 1.;
    for (std::size_t n = 0; n < found.times.size(); ++n)
    {
      raise(time_error, found.times[n] - time);
      height *= .25;
      time += 2. * fall * std::sqrt(height);
      if (n < found.heights.size())
        raise(height_error, found.heights[n] - height);
    }
    const std::string name = "ball with e = 0.5, adaptive, tolerance " + tolerance;
    figure(name + ", impacts", found.times.size());
    figure(name + ", largest error of the time of an impact", time_error, "s");
    EXPECT_LT(figure(name + ", largest error of a height", height_error, "m"), 2. * epsilon);
    EXPECT_LT(time_error, 1.5 * flight);
    EXPECT_GT(figure(name + ", rebound that is not followed", found.lost, "m/s"), 0.);
    EXPECT_LE(found.lost, .5 * g * found.step);
    EXPECT_LE(found.lost, slowest);
    EXPECT_LT(found.held_since, 3. * fall + 2. * flight);
    EXPECT_GT(found.heights.size(), before) << "a smaller tolerance follows more of them";
    EXPECT_NEAR(found.force, g, 1e-9 * g);
    EXPECT_LT(found.gap, 1e-12);
    EXPECT_NEAR(found.end, 3., 1e-12);
    EXPECT_LT(figure(name + ", steps", found.n_steps), 1500) << "fixed steps: 3000";
    EXPECT_FALSE(has(found.log, "Warning")) << found.log;
    before = found.heights.size();
  }
}

TEST(AdaptiveEvents, a_given_motion_that_jumps_is_met)
{
  double before = 1.;
  for (const std::string tolerance : {"1e-3", "1e-5"})
  {
    const Shaken found = shake("if(t >= 1.006, 0.01, 0)", 0., adaptive(tolerance),
                               [](const double t)
                               { return t > .006 ? .01 * (1. - std::cos(10. * (t - .006))) : 0.; });
    const std::string name = "jump of a support, adaptive, tolerance " + tolerance;
    EXPECT_NEAR(found.longest_before, 16e-3, 1e-9) << "it comes within a long step";
    EXPECT_LT(figure(name + ", error over the motion", found.error / .02), .02);
    EXPECT_LT(found.error, .2 * before) << tolerance;
    EXPECT_LT(figure(name + ", steps", found.n_steps), 600) << "fixed steps: 2000";
    before = found.error;
  }
}

// 4 ms, a quarter of the longest step; the mass takes 0.4 mm of it.
TEST(AdaptiveEvents, a_short_given_motion_is_not_missed)
{
  const auto exact = [](const double t)
  { return .01 * (std::cos(10. * (t - .004)) - std::cos(10. * t)); };
  for (const std::string tolerance : {"1e-3", "1e-5", "1e-7"})
  {
    const Shaken found =
        shake("if(t >= 1 && t < 1.004, 0.01, 0)", 1.005, adaptive(tolerance), exact);
    EXPECT_NEAR(found.longest_before, 16e-3, 1e-9);
    EXPECT_LT(
        figure("4 ms of a support, adaptive, tolerance " + tolerance + ", error over the motion",
               found.error / 4e-4),
        tolerance == "1e-7" ? 3e-3 : .03);
    EXPECT_LT(found.n_steps, 1200);
  }
}
