// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: links whose direction is that from end to end at each time move masses with the right
// period, keep their length, energy and momentum, and catch what falls into them. Expected values:
// elliptic integrals, parabolas of flight, impulses and springs of Newton's laws, conservation.
#include "turning_scene.h"

#include <boost/math/special_functions/ellint_1.hpp>

using namespace turning;

namespace
{
  struct Swing
  {
    double period_error = 0., energy = 0., stretch = 0.;
  };

  /// Five periods of a mass on a rope or rod of 1 m, released from an angle to the vertical.
  Swing swing(const double angle, const int steps_a_period, const std::string &type,
              const Overrides &overrides = {})
  {
    const double period = 4. * std::sqrt(1. / g) * boost::math::ellint_1(std::sin(.5 * angle)),
                 step = period / steps_a_period;
    Scene scene = thrown({{2., {std::sin(angle), -std::cos(angle), 0.}, {}}},
                         {"Type = " + type + "; From = ground @ 0, 0; To = m0; Length = 1"},
                         5. * period, step);
    Swing result;
    double first_energy = 0., before = 0., t = 0.;
    std::vector<double> crossings;
    scene.run(
        [&](const Motion &m)
        {
          const double x = m.place[0].x;
          if (m.time == 0.)
            first_energy = m.energy;
          else if (x * before < 0.)
            crossings.push_back(t + (m.time - t) * before / (before - x));
          before = x;
          t = m.time;
          result.energy = std::max(result.energy, std::fabs(m.energy - first_energy) / (2. * g));
          const double stretch = norm(m.place[0]) - 1.;
          result.stretch = std::max(result.stretch, type == "joint" ? std::fabs(stretch) : stretch);
        },
        overrides);
    const double found = 2. * (crossings.back() - crossings.front()) / (crossings.size() - 1);
    result.period_error = std::fabs(found / period - 1.);
    return result;
  }
} // namespace

TEST(TurningLinks, pendulum_on_a_rope)
{
  for (const std::string type : {"dropper", "joint"})
  {
    // At 90 degrees a rope has no tension.
    const double angle = type == "joint" ? .5 * pi : 80. * pi / 180.;
    const Swing rough = swing(angle, 50, type), fine = swing(angle, 100, type);
    EXPECT_LT(rough.period_error, 3.5e-3) << type;
    EXPECT_LT(
        verification::figure("pendulum on a " + type + ", 100 steps a period: error of the period",
                             fine.period_error),
        9e-4);
    EXPECT_NEAR(rough.period_error / fine.period_error, 4., .8) << type;
    EXPECT_LT(std::max(rough.energy, fine.energy), 1e-7) << type;
    EXPECT_LT(std::max(rough.stretch, fine.stretch), 1e-10) << type;
  }
}

TEST(TurningLinks, pendulum_on_a_rod_from_170_degrees)
{
  const Swing s = swing(170. * pi / 180., 100, "joint");
  EXPECT_LT(s.period_error, 3e-3);
  EXPECT_LT(s.energy, 1e-7);
  EXPECT_LT(s.stretch, 1e-10);
}

TEST(TurningLinks, backward_euler_keeps_lengths_and_gains_no_energy)
{
  const Swing s = swing(.5 * pi, 400, "dropper", {"Time/Scheme=backward Euler"});
  EXPECT_LT(s.stretch, 1e-8);
  EXPECT_LT(s.period_error, .1);
  EXPECT_LT(s.energy, .8);
}

TEST(TurningLinks, slack_rope_catches_a_mass_that_is_thrown)
{
  const Coordinates start = {.5, -.2, 0.}, v = {1., 2., 0.};
  const Scene scene = thrown({{3., start, v}}, {rope("ground @ 0, 0", "m0", 1.)}, .6, 5e-4);
  // When the parabola leaves the circle.
  const auto place = [&](const double t) {
    return Coordinates{start.x + v.x * t, start.y + v.y * t - .5 * g * t * t, 0.};
  };
  const double tight =
      verification::end_of(0., .6, [&](const double t) { return norm(place(t)) < 1.; });
  const Coordinates at = place(tight), rate = {v.x, v.y - g * tight, 0.};
  const double radial = dot(at, rate), lost = .5 * 3. * radial * radial;
  double caught = 0., first = 0., last = 0., highest = -1e9, gained = 0., before = 0.;
  scene.run(
      [&](const Motion &m)
      {
        if (m.time == 0.)
          first = before = m.energy;
        if (caught == 0. && m.multiplier[0] > 0.)
          caught = m.time;
        gained = std::max(gained, m.energy - before);
        before = last = m.energy;
        highest = std::max(highest, norm(m.place[0]));
      });
  EXPECT_NEAR(caught, tight, 2.1 * scene.step);
  EXPECT_NEAR(first - last, lost, 1e-2 * lost);
  EXPECT_LT(gained, 1e-9);
  EXPECT_LT(highest, 1. + 1e-10);
}

TEST(TurningLinks, tumbling_masses_keep_momentum)
{
  for (const std::string kind : {"dropper", "joint", "elastic"})
  {
    const std::string link =
        kind == "elastic" ? "Type = joint; Stiffness = 2000" : "Type = " + kind;
    const Scene scene = thrown({{1., {0., 0., 0.}, {0., 0., 1.}},
                                {3., {.8, .3, -.2}, {.2, 1.5, -.1}},
                                {2., {.2, -1.1, .4}, {-1., 0., .2}}},
                               {link + "; From = m0; To = m1", link + "; From = m1; To = m2"}, 2.,
                               1e-3, weightless);
    Coordinates momentum, moment, direction;
    double least = 1.;
    scene.run(
        [&](const Motion &m)
        {
          const Coordinates d = m.place[1] - m.place[0];
          if (m.time == 0.)
          {
            momentum = m.momentum;
            moment = m.moment_of_momentum;
            direction = {d.x / norm(d), d.y / norm(d), d.z / norm(d)};
          }
          least = std::min(least, dot(d, direction) / norm(d));
          EXPECT_LT(norm(m.momentum - momentum), 1e-9) << kind << m.time;
          EXPECT_LT(norm(m.moment_of_momentum - moment), 1e-9) << kind << m.time;
        });
    EXPECT_LT(least, 0.) << kind; // turned by more than 90 degrees
  }
}

// The step that the rope closes in takes energy, more or less with the part of it that is left.
TEST(TurningLinks, mass_bounces_on_an_elastic_rope)
{
  constexpr int n_phases = 8;
  constexpr double m = 10., k = 1e4, fall = 2.;
  const double largest = m * g + std::sqrt(m * g * m * g + k * m * 2. * g * fall);
  for (const auto &[steps, error, mean] : {std::tuple(20, .033, .014), {50, .008, .0023}})
  {
    const double step = 2. * pi * std::sqrt(m / k) / steps;
    double lack = 0.;
    for (int phase = 0; phase < n_phases; ++phase)
    {
      const double begin = step * phase / n_phases;
      Scene scene = thrown({{m, {0., -1. - .5 * g * begin * begin, 0.}, {0., -g * begin, 0.}}},
                           {rope("ground @ 0, 0", "m0", 3.) + "; Stiffness = 1e4"}, 1.6, step);
      double N = 0., at_end = 0., first = 0., top = -10.;
      scene.run(
          [&](const Motion &at)
          {
            if (at.time == 0.)
              first = at.energy;
            N = std::max(N, at.multiplier[0]);
            at_end = std::max(at_end, -k * at.gap[0]);
            EXPECT_LT(at.energy, first + 1e-9 * m * g);
            if (at.time > 1.)
              top = std::max(top, at.place[0].y);
          });
      // A mean over the step, and the spring at the end of it.
      EXPECT_NEAR(N / largest, 1., error);
      EXPECT_LT(N, at_end);
      EXPECT_NEAR(at_end / largest, 1., .75 * error);
      EXPECT_NEAR(top, -1., 2.5 * error);
      lack += (1. - at_end / largest) / n_phases;
    }
    EXPECT_LT(lack, mean);
    EXPECT_GT(lack, 0.);
    verification::figure("largest force of an elastic rope, " + std::to_string(steps) +
                             " steps a period, lacks in the mean of all phases",
                         lack);
  }
}
