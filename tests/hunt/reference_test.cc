// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: the event-driven motions that runs are judged by are exact. Source: closed forms of a ball
// that bounces, of springs that stop a mass, damped, with two slopes; of two masses that collide.
#include "common.h"
#include "event_driven.h"
#include "reference.h"
#include "verification/run.h"

namespace
{
  constexpr double mass = 2., speed = 3., height = .6, pi = 3.14159265358979323846;

  /// The model of a mass above a stop, thrown down; other items after these.
  hunt::LinearModel model_of(const std::string &stop, const std::string &gravity = "0",
                             const std::string &more = "")
  {
    verification::Session session("Gravity = 0, -" + gravity + R"(; Start = given
Mass m: Position = 0, 0; Mass = 2; Motions = y; Initial velocity = 0, -3, 0
Link stop: Type = stop; From = ground; To = m; Direction = 0, 1; Gap = 0.6; )" +
                                  stop + "\n" + more + R"(
Time: Step = 1e-6; End = 1e-6
Output: Field interval = 0
)");
    hunt::Recorder recorder(0.);
    session.run(std::ref(recorder));
    return std::move(*recorder.model);
  }

  hunt::Sample sample(const hunt::LinearModel &model, const double restitution, const double t)
  {
    return hunt::event_driven_history(model, restitution, 10., {0., .3 * t, t}).back();
  }
} // namespace

TEST(EventDriven, ball_bounces_after_newton)
{
  constexpr double g = 10., e = .7;
  const hunt::LinearModel model = model_of("", "10");
  const double v = std::sqrt(speed * speed + 2. * g * height), touch = (v - speed) / g;
  // The second touch is 2 e v / g later, then it rises with e^2 v.
  const double t = .1, end = touch + 2. * e * v / g + t;
  const hunt::Sample at = sample(model, e, end);
  EXPECT_NEAR(at.place[0], -height + e * e * v * t - .5 * g * t * t, 1e-9);
  EXPECT_NEAR(at.impulse[0], mass * v * ((1. + e) + e * (1. + e)), 1e-8);
  EXPECT_NEAR(at.kinetic, .5 * mass * std::pow(e * e * v - g * t, 2), 1e-8);
  // All rebounds end after v (1 + e) / ((1 - e) g) from the touch; then the weight rests.
  const double rest = touch + v / g * (1. + e) / (1. - e);
  const hunt::Sample resting = sample(model, e, rest + 1.);
  EXPECT_NEAR(resting.place[0], -height, 1e-6);
  EXPECT_NEAR(resting.impulse[0], mass * (g * (rest + 1.) + speed), 1e-4);
}

TEST(EventDriven, springs_stop_a_mass)
{
  for (const double k : {2e2, 2e6, 2e9})
  {
    const hunt::LinearModel model = model_of("Stiffness = " + verification::number(k));
    const double contact = pi / std::sqrt(k / mass), touch = height / speed;
    const hunt::Sample at = sample(model, 0., touch + contact + .4);
    EXPECT_NEAR(at.place[0], -height + speed * .4, 1e-7) << k;
    EXPECT_NEAR(at.impulse[0], 2. * mass * speed, 1e-6) << k;
    const hunt::Sample inside = sample(model, 0., touch + .5 * contact);
    EXPECT_NEAR(inside.kinetic / inside.potential, 0., 1e-9) << k;
    EXPECT_NEAR(inside.energy(), .5 * mass * speed * speed, 1e-7) << k;
  }
}

TEST(EventDriven, damper_never_pulls)
{
  constexpr double k = 2e4, c = 100.;
  const hunt::LinearModel model = model_of("Stiffness = 2e4; Damping = 100");
  const double w = std::sqrt(k / mass), z = c / (2. * mass * w), wd = w * std::sqrt(1. - z * z),
               // The force k d + c d' of d = v/wd exp(-z w t) sin(wd t) vanishes at
      contact = 2. / wd * std::atan(std::sqrt(1. - z * z) / z) > 0.
                    ? (pi - std::atan2(2. * z * std::sqrt(1. - z * z), 1. - 2. * z * z)) / wd
                    : 0.,
               touch = height / speed,
               d = speed / wd * std::exp(-z * w * contact) * std::sin(wd * contact),
               rate = speed / wd * std::exp(-z * w * contact) *
                      (wd * std::cos(wd * contact) - z * w * std::sin(wd * contact));
  EXPECT_NEAR(k * d + c * rate, 0., 1e-8 * k * d + 1e-8);
  const hunt::Sample at = sample(model, 0., touch + contact + .2);
  EXPECT_NEAR(at.place[0], -height - d - rate * .2, 1e-8);
  EXPECT_NEAR(at.impulse[0], mass * (speed - rate), 1e-7);
}

TEST(EventDriven, law_of_two_slopes)
{
  // As contact_of_two_slopes() of the tests of laws.
  constexpr double k1 = 2e4, k2 = 1e5, u1 = .01;
  const hunt::LinearModel model = model_of("Law = table; Law points = 0.01: 200, 0.02: 1200");
  const double w1 = std::sqrt(k1 / mass), w2 = std::sqrt(k2 / mass),
               v1 = std::sqrt(speed * speed - k1 * u1 * u1 / mass),
               t1 = std::asin(w1 * u1 / speed) / w1, below = k1 * u1 / k2,
               t2 = (.5 * pi - std::atan(w2 * below / v1)) / w2, contact = 2. * (t1 + t2);
  const hunt::Sample at = sample(model, 0., height / speed + contact + .2);
  EXPECT_NEAR(at.place[0], -height + .2 * speed, 1e-4);
  EXPECT_NEAR(at.impulse[0], 2. * mass * speed, 1e-3);
}

TEST(EventDriven, law_of_a_cubic_spring)
{
  // m v^2 / 2 = k u^4 / 4, and the integral of 1 / sqrt(1 - x^4) from 0 to 1.
  const hunt::LinearModel model = model_of("Law = formula; Law formula = 1e6*d^3; Law range = 0.2");
  const double largest = std::pow(2. * mass * speed * speed / 1e6, .25),
               contact = 2. * largest / speed * 1.3110287771460599;
  const hunt::Sample at = sample(model, 0., height / speed + contact + .2);
  EXPECT_NEAR(at.place[0], -height + .2 * speed, 2e-4);
  EXPECT_NEAR(at.impulse[0], 2. * mass * speed, 1e-3);
}

TEST(EventDriven, collision_of_two_masses)
{
  // The upper mass of 4 kg follows with 5 m/s and 0.2 m behind; then both meet the floor.
  const hunt::LinearModel model = model_of("", "0", R"(
Mass n: Position = 0, 1; Mass = 4; Motions = y; Initial velocity = 0, -5, 0
Link between: Type = stop; From = m; To = n; Direction = 0, 1; Gap = 0.2
)");
  const double e = .5, meet = .1, v = (2. * 3. + 4. * 5.) / 6., // of the centre
      lower = v + e * 2. * 4. / 6., upper = v - e * 2. * 2. / 6.;
  const double t = .02;
  const hunt::Sample at = sample(model, e, meet + t);
  EXPECT_NEAR(at.place[0], -speed * meet - lower * t, 1e-9);
  EXPECT_NEAR(at.place[1], -5. * meet - upper * t, 1e-9);
}
