// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: adaptive steps end where fixed ones do, are as exact as their tolerance asks for with
// fewer steps, keep their length where a rigid stop closes, create no force at rest, and figures of
// unequal steps are weighed by time. Sources: half-waves of an oscillator with an elastic stop
// (prm/oscillator_with_stop.prm), the wave equation (prm/bar_on_wall.prm), rest, fixed steps.
#include "run.h"

#include <taut/output/statistics.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

using namespace verification;

namespace
{
  const std::string adaptive = "Time.Step control=adaptive";

  /// Half-waves of 0.1 m at 20 1/s and on the stop at sqrt(4000) 1/s, from the top.
  double exact_oscillator(const double t)
  {
    const double a = .1, w1 = 20., w2 = std::sqrt(4000.), pi = std::acos(-1.);
    const double phase = std::fmod(t + .5 * pi / w1, pi / w1 + pi / w2);
    return phase < pi / w1 ? a * std::sin(w1 * phase)
                           : -a * w1 / w2 * std::sin(w2 * (phase - pi / w1));
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
                  error = std::max(error, std::fabs(view.state.U[0][0] - exact_oscillator(last)));
                });
      EXPECT_NEAR(last, .8, 1e-12) << scheme;
      errors[fine] = error / .1;
      figure("oscillator on a stop, " + scheme + ", adaptive, error over the amplitude",
             errors[fine]);
      figure("oscillator on a stop, " + scheme + ", adaptive, steps", n_steps[fine]);
    }
    // Of second order: local error 1e-3 is a step of a tenth and a global error of a hundredth.
    EXPECT_LT(errors[1], errors[0] / 30.) << scheme;
    EXPECT_LT(n_steps[1], 40 * n_steps[0]) << scheme;
  }
}

// The force of a node that closes is its impulse over the step: shorter steps would only make it
// larger.
TEST(StepControl, steps_stay_where_a_rigid_stop_closes)
{
  double impulse = 0., before = 0., in_flight = 0., at_touch = 0., largest = 0.;
  long n_steps = 0;
  run_scene(scene_file("bar_on_wall"),
            {adaptive, "Time.Scheme=BDF2", "Time.Step=5e-4", "Time.Adaptive step.Tolerance=3e-5"},
            [&](const taut::StepView &view)
            {
              const double t = view.state.time, N = view.state.multiplier[0], step = t - before;
              if (N > 0. && at_touch == 0.)
                at_touch = step;
              if (at_touch == 0.)
                in_flight = step;
              impulse += N * step;
              largest = std::max(largest, N);
              before = t;
              ++n_steps;
            });
  figure("bar on a wall, adaptive, steps", n_steps);
  figure("bar on a wall, adaptive, impulse", impulse, "N s");
  figure("bar on a wall, adaptive, largest force", largest, "N");
  EXPECT_EQ(std::lround(in_flight / at_touch * 1e9), 1000000000) << "the step of the flight";
  EXPECT_NEAR(impulse, 200., 2.);
  EXPECT_LT(largest, 600.) << "twice the exact force; 32 000 N in the shortest step";
  EXPECT_NEAR(before, 1.5, 1e-12);
  EXPECT_LT(n_steps, 2000) << "fixed steps of the same length: 3000";
}

// Steps from the shortest (Step / 64) to 16 Step at rest: no force changes.
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
                  lengths.insert(std::lround((view.state.time - before) / 1e-4 * 64.));
                for (std::size_t i = 0; i < N.size(); ++i)
                  change = std::max(change, std::fabs(N[i] - start[i]) / std::fabs(start[i]));
                before = view.state.time;
              });
    figure("rest, " + scheme + ", adaptive, lengths of step", lengths.size());
    figure("rest, " + scheme + ", adaptive, largest change of a force", change);
    EXPECT_GE(lengths.size(), 4u) << "the step has to change";
    EXPECT_LT(change, 1e-8) << scheme;
  }
}
