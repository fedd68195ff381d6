// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: impacts on unilateral stops last as long, press as hard and rebound as fast as the exact
// solutions say: d'Alembert's waves (bar on a wall: D. Doyen, A. Ern, S. Piperno, SIAM J. Sci.
// Comput. 33 (2011), without gravity; string on a stop: point impedance 2 sqrt(T m)), half-waves of
// an oscillator.
#include "scene_tests.h"

using namespace verification;

namespace
{
  /// What the first link of a run did.
  struct ContactRecord
  {
    std::vector<double> time, force;
    double first = 0., last = 0.; ///< first and last time with a force [s]
    double impulse = 0.;          ///< [N s]
    double momentum_after = 0.;   ///< of the first body at the end [kg m/s]
    double momentum_before = 0.;  ///< at the start
    double energy_kept = 0.;      ///< kinetic and elastic, end over start
    double least_gap = 0.;        ///< [m]
    double least_force = 0.;      ///< [N]
    /// The forces in a time.
    std::vector<double> forces(double from, double to) const
    {
      std::vector<double> result;
      for (std::size_t i = 0; i < time.size(); ++i)
        if (time[i] > from && time[i] < to)
          result.push_back(force[i]);
      return result;
    }
    double plateau(double from, double to) const
    {
      const std::vector<double> N = forces(from, to);
      return std::accumulate(N.begin(), N.end(), 0.) / N.size();
    }
    double deviation(double from, double to) const
    {
      const double mean = plateau(from, to);
      double sum = 0.;
      const std::vector<double> N = forces(from, to);
      for (const double value : N)
        sum += (value - mean) * (value - mean);
      return std::sqrt(sum / N.size());
    }
  };

  double momentum(const taut::StepView &view)
  {
    const std::vector<double> MV = matrix_times(view.structure[0].mass(), view.state.V[0]);
    return std::accumulate(MV.begin(), MV.end(), 0.);
  }

  ContactRecord record(const std::string &scene, const Overrides &overrides)
  {
    ContactRecord r;
    double energy_before = 0.;
    run_scene(scene_file(scene), overrides,
              [&](const taut::StepView &view)
              {
                const double N = view.state.multiplier[0], t = view.state.time,
                             energy = energy_of_bodies(view.structure, view.state);
                r.momentum_after = momentum(view);
                if (r.time.empty())
                {
                  r.momentum_before = r.momentum_after;
                  energy_before = energy;
                }
                r.impulse += r.time.empty() ? 0. : N * (t - r.time.back());
                r.time.push_back(t);
                r.force.push_back(N);
                r.least_force = std::min(r.least_force, N);
                r.least_gap = std::min(r.least_gap, view.state.complementarity_gap[0]);
                r.energy_kept = energy / energy_before;
                if (N > 0.)
                  r.last = t;
                if (r.first == 0.)
                  r.first = r.last;
              });
    return r;
  }

  /// Exact motion of prm/oscillator_with_stop.prm.
  struct Oscillator
  {
    const double a = .1, w1 = 20., w2 = std::sqrt(4000.), period = pi / w1 + pi / w2;
    double u(double t) const
    {
      // Quarter wave down, half wave on the stop, half wave up, ...: the phase counts from the
      // first touch.
      const double phase = std::fmod(t + .5 * pi / w1, period);
      return phase < pi / w1 ? a * std::sin(w1 * phase)
                             : -a * w1 / w2 * std::sin(w2 * (phase - pi / w1));
    }
  };
} // namespace

// 400 linear elements, BDF2. Exact: contact on 0.5 .. 7/6 s, 300 N, impulse 200 N s, then the
// undeformed bar at +10 m/s.
TEST(BarOnWall, contact_time_force_impulse_and_rebound_are_exact_to_one_per_cent)
{
  const ContactRecord r = record("bar_on_wall", {"Time.Scheme=BDF2"});
  const double duration = r.last - r.first;
  figure("bar on wall, force, mean over 0.55..1.1 s", r.plateau(.55, 1.1), "N");
  figure("bar on wall, force, standard deviation over 0.55..1.1 s", r.deviation(.55, 1.1), "N");
  figure("bar on wall, rebound velocity of the centre of mass", r.momentum_after / 10., "m/s");
  EXPECT_NEAR(figure("bar on wall, contact begins", r.first, "s"), .5, .01 * .5);
  EXPECT_NEAR(figure("bar on wall, contact ends", r.last, "s"), 7. / 6., .01 * 7. / 6.);
  EXPECT_NEAR(duration, 2. / 3., .01 * 2. / 3.);
  EXPECT_NEAR(r.plateau(.55, 1.1), 300., 3.);
  EXPECT_LT(r.deviation(.55, 1.1), 3.);
  EXPECT_NEAR(figure("bar on wall, impulse", r.impulse, "N s"), 200., 2.);
  EXPECT_NEAR(r.momentum_before, -100., 1e-9);
  EXPECT_NEAR(r.momentum_after, 100., 1.);
  EXPECT_GT(figure("bar on wall, energy kept", r.energy_kept), .99);
  EXPECT_LT(r.energy_kept, 1. + 1e-9) << "an impact must not create energy";
  EXPECT_GE(r.least_force, 0.);
  EXPECT_GE(r.least_gap, -1e-12);
}

// The impulse is the change of momentum: with unilateral forces of any size, for every scheme.
TEST(BarOnWall, impulse_is_the_change_of_momentum)
{
  for (const std::string scheme : {"BDF2", "backward Euler", "Moreau-Jean"})
  {
    const ContactRecord r = record("bar_on_wall", {"Time.Scheme=" + scheme});
    const double defect = (r.momentum_after - r.momentum_before) / r.impulse - 1.;
    figure("bar on wall, " + scheme + ", change of momentum over impulse - 1", defect);
    EXPECT_NEAR(defect, 0., 1e-9) << scheme;
  }
}

// Linear elements of 25 mm. Exact: contact on 0.05 .. 1.05 s, 80 N, impulse 80 N s.
TEST(StringOnStop, contact_time_force_and_impulse_are_exact_to_one_per_cent)
{
  const ContactRecord r = record("string_on_stop", {});
  figure("string on stop, force, mean over 0.15..0.95 s", r.plateau(.15, .95), "N");
  figure("string on stop, force, standard deviation over 0.15..0.95 s", r.deviation(.15, .95), "N");
  figure("string on stop, rebound velocity of the centre of mass", r.momentum_after / 20., "m/s");
  EXPECT_NEAR(r.last - r.first, 1., .01);
  EXPECT_NEAR(figure("string on stop, contact begins", r.first, "s"), .05, .01 * 1.05);
  EXPECT_NEAR(figure("string on stop, contact ends", r.last, "s"), 1.05, .01 * 1.05);
  EXPECT_NEAR(r.plateau(.15, .95), 80., .8);
  EXPECT_LT(r.deviation(.15, .95), .8);
  EXPECT_NEAR(figure("string on stop, impulse", r.impulse, "N s"), 80., .8);
  EXPECT_NEAR(r.momentum_after, 40., .4);
  EXPECT_GE(r.least_force, 0.);
  EXPECT_GE(r.least_gap, -1e-12);
}

// Exact: period pi/20 + pi/63.2456 = 0.2067526 s, compression 31.6228 mm, force 227.684 N.
TEST(OscillatorWithStop, period_compression_and_force_are_exact)
{
  std::vector<double> touches; // downward crossings of the rest position, interpolated
  double before = 0., lowest = 0., largest_force = 0., t_before = 0.;
  run_scene(scene_file("oscillator_with_stop"), {},
            [&](const taut::StepView &view)
            {
              const double u = view.state.U[0][0], t = view.state.time;
              if (before > 0. && u <= 0.)
                touches.push_back(t_before + (t - t_before) * before / (before - u));
              lowest = std::min(lowest, u);
              largest_force = std::max(largest_force, view.state.multiplier[0]);
              before = u;
              t_before = t;
            });
  ASSERT_GE(touches.size(), 4u);
  const double period = (touches.back() - touches.front()) / (touches.size() - 1);
  const Oscillator exact;
  figure("oscillator, largest compression", -1e3 * lowest, "mm");
  figure("oscillator, largest force on the stop", largest_force, "N");
  EXPECT_NEAR(exact.period, .2067526, 5e-8);
  EXPECT_NEAR(figure("oscillator, period", period, "s"), exact.period, 1e-5 * exact.period);
  EXPECT_NEAR(-lowest, .0316228, 2e-5 * .0316228);
  EXPECT_NEAR(largest_force, 227.684, 2e-5 * 227.684);
}

TEST(OscillatorWithStop, schemes_keep_their_order_through_an_elastic_stop)
{
  const Oscillator exact;
  for (const std::string scheme : {"Newmark", "BDF2", "generalised-alpha", "HHT", "backward Euler"})
  {
    const double order = scheme == "backward Euler" ? 1. : 2.;
    std::vector<double> steps, errors;
    const double coarsest = order == 1. ? 5e-5 : 8e-4;
    for (int i = 0; i < 5; ++i)
    {
      steps.push_back(coarsest / (1 << i));
      double error = 0.;
      run_scene(scene_file("oscillator_with_stop"),
                {"Time.Scheme=" + scheme, "Time.Step=" + number(steps.back()), "Time.End=0.5"},
                [&](const taut::StepView &view)
                { raise(error, view.state.U[0][0] - exact.u(view.state.time)); });
      errors.push_back(error);
    }
    const double fitted = fitted_order(steps, errors);
    figure("oscillator, error of " + scheme + " at the smallest step over the amplitude",
           errors.back() / .1);
    EXPECT_NEAR(figure("oscillator, order of " + scheme, fitted), order, .1) << scheme;
    EXPECT_LT(errors.back() / .1, 2e-2) << scheme;
  }
}
