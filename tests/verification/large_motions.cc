// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: bodies that are not linear move with the right period and keep their energy, with and
// without contacts. Expected values: the pendulum of elliptic integrals; conservation of energy.
#include "common.h"
#include "elastic_pendulum.h"
#include "one_body.h"

#include <boost/math/special_functions/ellint_1.hpp>

using namespace verification;

namespace
{

  /// @p n steps, of which each ends where it has to.
  void advance(taut::Stepper &stepper, const double step, const int n)
  {
    for (int i = 1; i <= n; ++i)
    {
      stepper.advance();
      EXPECT_NEAR(stepper.time(), i * step, 1e-12);
      EXPECT_LT(stepper.residuals().balance, 1e-9);
    }
  }

  struct Swing
  {
    double period_error = 0., energy_change = 0.;
  };

  /// Five periods with n steps each.
  Swing swing(const double amplitude, const int n, const std::string &scheme)
  {
    const OneBody<ElasticPendulum> one("pendulum", amplitude, 1e6);
    const ElasticPendulum *const pendulum = one.body;
    const double period = 4. * std::sqrt(length / gravity) *
                          boost::math::ellint_1(std::sin(.5 * amplitude)),
                 step = period / n;
    taut::Stepper stepper(one.system, steps_of(step, taut::Start::undeformed, scheme));
    std::vector<double> U(3, 0.), V(3, 0.);
    const double start = pendulum->energy(U, V), scale = bob * gravity * length;
    Swing result;
    std::vector<double> crossings;
    double x = pendulum->x(U);
    while (stepper.time() < 5.6 * period)
    {
      stepper.advance();
      U = stepper.displacement(0);
      const double now = pendulum->x(U);
      if (now < 0. && x >= 0.)
        crossings.push_back(stepper.time() - step * now / (now - x));
      x = now;
      result.energy_change =
          std::max(result.energy_change,
                   std::fabs(pendulum->energy(U, stepper.state().V[0]) - start) / scale);
    }
    result.period_error =
        crossings.size() < 2
            ? 1.
            : std::fabs((crossings.back() - crossings.front()) / (crossings.size() - 1) / period -
                        1.);
    return result;
  }
} // namespace

TEST(LargeMotions, pendulum_has_its_period_and_keeps_its_energy)
{
  const Swing coarse = swing(.5 * pi, 50, "automatic"), fine = swing(.5 * pi, 100, "automatic"),
              high = swing(170. / 180. * pi, 100, "automatic");
  EXPECT_LE(coarse.period_error, 3.5e-3);
  EXPECT_LE(fine.period_error, 9e-4);
  EXPECT_NEAR(coarse.period_error / fine.period_error, 4., .4); // second order
  EXPECT_LE(high.period_error, 5e-3);
  for (const Swing &s : {coarse, fine, high})
    EXPECT_LE(s.energy_change, 1e-7);
}

TEST(LargeMotions, backward_euler_loses_energy_and_never_gains)
{
  const Swing s = swing(.5 * pi, 50, "backward Euler");
  EXPECT_GT(s.energy_change, .1);
}

TEST(LargeMotions, schemes_that_gain_energy_are_refused)
{
  const std::string refusal = verification::error_of([&] { swing(.5 * pi, 50, "Newmark"); });
  EXPECT_TRUE(has(refusal, "gains energy in large motions")) << refusal;
}

// The wall at x = 0 is hit at full speed: an inelastic impact of the mass, which then hangs.
TEST(LargeMotions, rigid_wall_takes_the_energy_and_gives_none)
{
  const double amplitude = pi / 3.;
  OneBody<ElasticPendulum> one("pendulum", amplitude, 1e5);
  const ElasticPendulum *const pendulum = one.body;
  one.system.add(taut::Constraint::unilateral("wall", one.system.displacement(0, {}, {1., 0., 0.}))
                     .gap(length * std::sin(amplitude)));
  taut::Stepper stepper(one.system, steps_of(2e-3, taut::Start::undeformed));
  std::vector<double> U(3, 0.), V(3, 0.);
  double energy = pendulum->energy(U, V);
  const double start = energy, scale = bob * gravity * length;
  while (stepper.time() < 1.5)
  {
    stepper.advance();
    U = stepper.displacement(0);
    EXPECT_GE(pendulum->x(U), -1e-12);
    const double now = pendulum->energy(U, stepper.state().V[0]);
    EXPECT_LE(now, energy + 1e-9 * scale);
    energy = now;
  }
  EXPECT_NEAR(start - energy, .5 * scale, .01 * scale); // m g L (1 - cos 60)
}

// A body that takes no step of 20 ms once it has moved, as one does whose inertia is lost in the
// rounding of its stiffness: each is made in two, and none of these in more.
TEST(LargeMotions, step_that_cannot_be_prepared_leaves_the_shorter_one)
{
  int n_refused = 0;
  double shortest = 1.;
  const OneBody<ElasticPendulum> one("pendulum", pi / 3., 1e5);
  one.body->change_force = [&](const auto &, const auto &, const double step, auto &)
  { shortest = std::min(shortest, step); };
  one.body->change_tangent = [&](const auto &U0, const double rate, taut::SymmetricMatrix &K)
  {
    if (U0[0] != 0. && rate < 2. / .015)
    {
      ++n_refused;
      K.add(0, 0, std::nan("")); // which has no factor
    }
  };
  constexpr double step = .02;
  taut::Stepper stepper(one.system, steps_of(step, taut::Start::undeformed));
  advance(stepper, step, 20);
  EXPECT_GT(n_refused, 18);
  EXPECT_EQ(shortest, .5 * step);
}

// A body may refuse a step that is too long for it: the step is made in parts and ends where it
// would have ended, with the energy of the start.
TEST(LargeMotions, step_that_a_body_refuses_is_made_in_parts)
{
  int n_refused = 0;
  const OneBody<ElasticPendulum> one("pendulum", pi / 3., 1e5);
  one.body->change_force = [&](const auto &U0, const auto &U1, double, auto &)
  {
    if (largest_difference(U0, U1) > .02)
    {
      ++n_refused;
      throw taut::UserError("too far");
    }
  };
  const ElasticPendulum *const pendulum = one.body;
  constexpr double step = .01;
  taut::Stepper stepper(one.system, steps_of(step, taut::Start::undeformed));
  advance(stepper, step, 100);
  EXPECT_GT(n_refused, 0);
  const std::vector<double> start(3, 0.);
  EXPECT_NEAR(pendulum->energy(stepper.displacement(0), stepper.state().V[0]),
              pendulum->energy(start, start), 1e-7 * bob * gravity * length);
}

// The static equilibrium hangs down, whatever way the undeformed one points.
TEST(LargeMotions, equilibrium_is_the_stable_one)
{
  taut::System system;
  system.add("pendulum", [&] { return std::make_unique<ElasticPendulum>(.9 * pi, 1e3); });
  const taut::Stepper stepper(system);
  const std::vector<double> U = stepper.displacement(0);
  EXPECT_NEAR(U[0], -length * std::sin(.9 * pi), 1e-9);
  EXPECT_NEAR(-length * std::cos(.9 * pi) + U[2], -length * (1. + bob * gravity / 1e3), 1e-9);
}
