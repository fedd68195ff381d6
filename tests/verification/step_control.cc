// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: adaptive steps end where fixed ones do, are as exact as their tolerance asks for with
// fewer steps, impacts and short loads included, and create no force at rest. Sources: half-waves
// of an oscillator with an elastic stop (prm/oscillator_with_stop.prm), free fall and rebound, the
// answer of a mass on a spring, the wave equation (prm/bar_on_wall.prm), rest.
#include "scene_tests.h"

#include <taut/output/statistics.h>

using namespace verification;

namespace
{
  const std::string adaptive = "Time.Step control=adaptive";

  /// Half-waves of 0.1 m at 20 1/s and on the stop at sqrt(4000) 1/s, from the top.
  double exact_oscillator(const double t)
  {
    const double a = .1, w1 = 20., w2 = std::sqrt(4000.);
    const double phase = std::fmod(t + .5 * pi / w1, pi / w1 + pi / w2);
    return phase < pi / w1 ? a * std::sin(w1 * phase)
                           : -a * w1 / w2 * std::sin(w2 * (phase - pi / w1));
  }

  /// End and number of steps of an adaptive run.
  struct AdaptiveRun
  {
    double end = 0., time = 0., longest = 0.;
    long n_steps = 0;
  };
  AdaptiveRun adaptive_run(const std::string &scene, const std::string &tolerance,
                           const Overrides &more = {})
  {
    AdaptiveRun result;
    run_scene(scene, Overrides{adaptive, "Time.Adaptive step.Tolerance=" + tolerance} + more,
              [&](const taut::StepView &view)
              {
                ++result.n_steps;
                result.end = view.state.U[0][0];
                result.longest = std::max(result.longest, view.state.time - result.time);
                result.time = view.state.time;
              });
    return result;
  }

  /// A mass of 1 kg one metre above a stop, with what the stop has more.
  std::string ball(const std::string &stop)
  {
    return R"(Gravity = 0, -9.81; Start = given
Mass ball: Position = 0, 1; Motions = y; Mass = 1
Link stop: Type = stop; From = ground; To = ball; Direction = 0, 1; Gap = 1; )" +
           stop + R"(
Time: Step = 1e-3; End = 3
Time/Moreau-Jean: Restitution = )" +
           (stop.empty() ? "1" : "0");
  }

  /// Height of a ball that falls 1 m, after contacts of a duration [s].
  double exact_ball(const double contact)
  {
    const double g = 9.81, v = std::sqrt(2. * g), fall = std::sqrt(2. / g),
                 t = std::fmod(3. - fall, contact + 2. * v / g) - contact;
    return -1. + v * t - .5 * g * t * t;
  }
} // namespace

TEST(StepControl, the_error_falls_with_the_tolerance)
{
  for (const std::string scheme : {"Newmark", "BDF2", "generalised-alpha"})
  {
    double errors[2];
    long n_steps[2] = {0, 0};
    for (int fine = 0; fine < 2; ++fine)
    {
      double last = 0., error = 0.;
      run_scene(scene_file("oscillator_with_stop"),
                {adaptive, "Time.Step=1e-3", "Time.End=0.8", "Time.Scheme=" + scheme,
                 std::string("Time.Adaptive step.Tolerance=") + (fine ? "1e-7" : "1e-4")},
                [&](const taut::StepView &view)
                {
                  ++n_steps[fine];
                  last = view.state.time;
                  raise(error, view.state.U[0][0] - exact_oscillator(last));
                });
      EXPECT_NEAR(last, .8, 1e-12) << scheme;
      const std::string name = "oscillator on a stop, " + scheme + ", adaptive, ";
      errors[fine] = figure(name + "error over the amplitude", error / .1);
      figure(name + "steps", n_steps[fine]);
    }
    // Of second order: local error 1e-3 is a step of a tenth and a global error of a hundredth.
    EXPECT_LT(errors[1], errors[0] / 30.) << scheme;
    EXPECT_LT(n_steps[1], 40 * n_steps[0]) << scheme;
  }
}

// A step that an impact falls into is made shorter until the ball moves by the tolerance in it.
TEST(StepControl, impacts_are_met_as_exactly_as_the_tolerance_asks)
{
  double before = 1.;
  for (const std::string tolerance : {"1e-4", "1e-6", "1e-8", "1e-10"})
  {
    const AdaptiveRun run = adaptive_run(ball(""), tolerance, {"Time.Adaptive step.Halvings=34"});
    const std::string name = "ball on a rigid stop, adaptive, tolerance " + tolerance;
    const double error = figure(name + ", error", std::fabs(run.end - exact_ball(0.)), "m");
    EXPECT_NEAR(run.time, 3., 1e-12);
    EXPECT_LT(error, 20. * std::stod(tolerance));
    EXPECT_LT(error, .1 * before) << tolerance;
    EXPECT_LT(figure(name + ", steps", run.n_steps), 1000) << "fixed steps: 3000";
    before = std::max(error, 1e-10);
  }
}

TEST(StepControl, elastic_stops_shorten_steps_too)
{
  for (const double k : {1e5, 1e6, 1e7})
  {
    const double w = std::sqrt(k), g = 9.81, v = std::sqrt(2. * g),
                 contact = 2. * (std::acos(-1.) - std::atan2(v / w, g / k)) / w;
    double before = 1.;
    for (const std::string tolerance : {"1e-4", "1e-6"})
    {
      const AdaptiveRun run = adaptive_run(ball("Stiffness = " + number(k)), tolerance);
      const double error = std::fabs(run.end - exact_ball(contact));
      figure("ball on a stop of " + number(k) + " N/m, adaptive, tolerance " + tolerance +
                 ", error",
             error, "m");
      EXPECT_LT(error, tolerance == "1e-4" ? 5e-3 : 1e-4) << k;
      EXPECT_LT(error, .2 * before) << k;
      EXPECT_LT(run.n_steps, 600);
      before = error;
    }
  }
}

// A force of 100 N for 4 ms, a quarter of the longest step, on a mass at rest on a spring.
TEST(StepControl, a_short_load_on_a_calm_mass_is_not_missed)
{
  const std::string scene =
      R"(Gravity = 0, 0; Start = given
Mass mass: Position = 0, 0; Motions = y; Mass = 1
Spring spring: From = ground; To = mass; Stiffness = 1
Load pulse: On = mass; Direction = 0, 1; Magnitude = if(t >= 1 && t < 1.004, 100, 0)
Time: Step = 1e-3; End = 2
)";
  const double exact = 100. * (std::cos(1. - .004) - std::cos(1.));
  double before = 1.;
  for (const std::string tolerance : {"1e-3", "1e-5"})
  {
    const AdaptiveRun run = adaptive_run(scene, tolerance);
    figure("pulse on a calm mass, adaptive, tolerance " + tolerance + ", error over the motion",
           std::fabs(run.end - exact) / exact);
    EXPECT_NEAR(run.end, exact, .01 * exact) << tolerance;
    EXPECT_LT(std::fabs(run.end - exact), before);
    EXPECT_LT(run.n_steps, 500);
    before = .2 * std::fabs(run.end - exact);
  }
}

// No step is longer than the entry says.
TEST(StepControl, the_largest_step_is_an_entry)
{
  const AdaptiveRun run =
      adaptive_run(ball("Stiffness = 1e5"), "1e-4", {"Time.Adaptive step.Largest step=5e-3"});
  EXPECT_NEAR(run.longest, 4e-3, 1e-9);
}

// Waves that run through a bar are met step by step, so that its impact is right at any length of
// the first step.
TEST(StepControl, the_impact_of_a_bar_converges)
{
  double before = 4.;
  for (const std::string tolerance : {"1e-4", "1e-5"})
  {
    double impulse = 0., last = 0.;
    long n_steps = 0;
    run_scene(scene_file("bar_on_wall"),
              {adaptive, "Time.Scheme=BDF2", "Time.Step=5e-4",
               "Time.Adaptive step.Tolerance=" + tolerance},
              [&](const taut::StepView &view)
              {
                impulse += view.state.multiplier[0] * (view.state.time - last);
                last = view.state.time;
                ++n_steps;
              });
    const std::string name = "bar on a wall, adaptive, tolerance " + tolerance;
    EXPECT_NEAR(figure(name + ", impulse", impulse, "N s"), 200., std::min(4., before));
    figure(name + ", steps", n_steps);
    EXPECT_NEAR(last, 1.5, 1e-12);
    before = std::fabs(impulse - 200.);
  }
}

// Steps from the shortest (Step / 1024) to 16 Step at rest: no force changes.
TEST(StepControl, a_change_of_step_at_rest_creates_no_force)
{
  for (const std::string scheme : {"BDF2", "generalised-alpha", "Newmark", "HHT"})
  {
    std::vector<double> start;
    std::set<long> lengths;
    double change = 0., before = 0.;
    run_scene(scene_file("en50318_2002_250"),
              {adaptive, "Time.Scheme=" + scheme, "Time.Step=1e-4", "Time.End=0.1",
               "Catenary.Pantograph pantograph.Speed=0",
               "Statistics.Window=", "Time.Adaptive step.Tolerance=1e-3"},
              [&](const taut::StepView &view)
              {
                const std::vector<double> &N = view.state.multiplier;
                if (start.empty())
                  start = N;
                else
                  lengths.insert(std::lround((view.state.time - before) / 1e-4 * 1024.));
                for (std::size_t i = 0; i < N.size(); ++i)
                  change = std::max(change, std::fabs(N[i] - start[i]) / std::fabs(start[i]));
                before = view.state.time;
              });
    EXPECT_GE(figure("rest, " + scheme + ", adaptive, lengths of step", lengths.size()), 4)
        << "the step has to change";
    EXPECT_LT(figure("rest, " + scheme + ", adaptive, largest change of a force", change), 1e-8);
  }
}
