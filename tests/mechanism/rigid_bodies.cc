// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: rigid bodies turn, swing and hit as they have to, and keep energy, angular momentum and
// shape. Expected values: Euler's solution of the free symmetric top; conservation; the elliptic
// integral of the compound pendulum; the impulse of Newton's laws.
#include "mechanism/rigid_body_run.h"

#include <taut/substructure/local_solver.h>

#include <boost/math/special_functions/ellint_1.hpp>

using verification::g;
using verification::pi;

namespace
{
  using namespace mechanism;
  using namespace taut;

  Coordinates moved(const OneBody &one, const Stepper &stepper, const Coordinates &place)
  {
    const auto along = [&](const Coordinates &axis)
    { return stepper.displacement(one.system.displacement(0, place, axis)); };
    return {along({1., 0., 0.}), along({0., 1., 0.}), along({0., 0., 1.})};
  }

  Coordinates velocity(const OneBody &one, const Stepper &stepper, const Coordinates &place)
  {
    const auto along = [&](const Coordinates &axis)
    { return stepper.velocity(one.system.displacement(0, place, axis)); };
    return {along({1., 0., 0.}), along({0., 1., 0.}), along({0., 0., 1.})};
  }

  /// Where this unit vector of the body at rest points to.
  Coordinates now(const OneBody &one, const Stepper &stepper, const RigidBodyData &data,
                  const Coordinates &axis)
  {
    return add_scaled(axis, 1., moved(one, stepper, add_scaled(data.centre, 1., axis))) -
           moved(one, stepper, data.centre);
  }

  /// About the origin: of six masses on the principal axes that have the body's moments of inertia.
  Coordinates angular_momentum(const OneBody &one, const Stepper &stepper,
                               const RigidBodyData &data)
  {
    const double sum = .5 * (data.moments[0] + data.moments[1] + data.moments[2]);
    Coordinates L;
    for (unsigned int i = 0; i < 3; ++i)
      for (const double side : {-1., 1.})
      {
        const double arm = std::sqrt((sum - data.moments[i]) / (data.mass / 3.));
        const Coordinates place = add_scaled(data.centre, side * arm, data.axes[i]);
        L = add_scaled(L, data.mass / 6.,
                       cross(add_scaled(place, 1., moved(one, stepper, place)),
                             velocity(one, stepper, place)));
      }
    return L;
  }

  RigidBodyData spinning(const std::array<double, 3> &moments, const Coordinates &angular_velocity)
  {
    RigidBodyData data;
    data.name = "body";
    data.mass = 2.;
    data.centre = {.3, -.2, .5};
    data.moments = moments;
    data.velocity = {.1, .2, -.3};
    data.angular_velocity = angular_velocity;
    return data;
  }

  /// Largest distance of the ends of unit vectors along the axes from Euler's solution.
  double error_of_top(const double step)
  {
    const Coordinates omega = {1., .5, 4.};
    const double J1 = .1, J3 = .16, end = 3.;
    const RigidBodyData data = spinning({J1, J1, J3}, omega);
    OneBody one(data);
    Stepper stepper(one.system, given(step));
    while (stepper.time() < end - .5 * step)
      stepper.advance();
    const Coordinates momentum = {J1 * omega.x, J1 * omega.y, J3 * omega.z},
                      precession = add_scaled({}, end / J1, momentum),
                      spin = {0., 0., (1. - J3 / J1) * omega.z * end};
    double error = 0.;
    for (const Coordinates &axis : data.axes)
      error = std::max(
          error, norm(now(one, stepper, data, axis) - turned(precession, turned(spin, axis))));
    return error;
  }

  struct Swing
  {
    double period = 0., energy_error = 0., deformation = 0., gap = 0.;
  };

  /// A bar, hung up at 0.3 m of its length from the centre, swings from this angle.
  Swing swing(const double angle, const double step)
  {
    constexpr double arm = .3, weight = 9.81;
    RigidBodyData data;
    data.name = "bar";
    data.mass = 3.;
    data.moments = {.002, .1, .1};
    const double s = std::sin(angle), c = std::cos(angle);
    data.axes = {{{s, -c, 0.}, {c, s, 0.}, {0., 0., 1.}}};
    data.centre = add_scaled({}, arm, data.axes[0]);
    data.gravity = {0., -weight, 0.};
    OneBody one(data);
    one.hold({0., 0., 0.});
    Stepper stepper(one.system, given(step));
    Swing result;
    const double energy = one.energy(stepper), scale = data.mass * weight * arm;
    std::vector<double> passes;
    double before = data.centre.x, t = 0.;
    while (passes.size() < 3)
    {
      stepper.advance();
      const std::vector<double> U = stepper.displacement(0);
      const double x = one.body->centre(U).x;
      if ((x > 0.) != (before > 0.))
        passes.push_back(t + (stepper.time() - t) * before / (before - x));
      before = x;
      t = stepper.time();
      result.energy_error =
          std::max(result.energy_error, std::fabs(one.energy(stepper) - energy) / scale);
      result.deformation = std::max(result.deformation, one.body->deformation(U));
      for (int i = 0; i < 3; ++i)
        result.gap = std::max(result.gap, std::fabs(stepper.gap(i)));
    }
    result.period = passes[2] - passes[0];
    return result;
  }
} // namespace

// All rows of [A, G^T; G, 0] x = b, but those of DoFs that are held: rows of G then may depend.
TEST(RigidBodies, local_solver)
{
  const RigidBody body(spinning({.1, .2, .25}, {}));
  std::vector<double> U(body.n_dofs());
  for (unsigned int i = 0; i < U.size(); ++i)
    U[i] = .1 * std::sin(1. + 3. * i);
  const auto K = body.tangent(U, {}, 1., false);
  for (const std::vector<unsigned int> &held :
       {std::vector<unsigned int>{}, {0, 4}, {3, 4, 5}, {0, 1, 2, 3, 4, 5, 6, 7, 8}})
  {
    const auto solver = body.make_solver();
    solver->factor({{1e3, &body.mass()}, {1., K.get()}}, held);
    std::vector<double> x(U.size()), b(U.size());
    for (unsigned int i = 0; i < x.size(); ++i)
      x[i] = std::cos(2. * i);
    for (const unsigned int i : held)
      x[i] = 0.;
    body.mass().vmult_add(1e3, x.data(), b.data());
    K->vmult_add(1., x.data(), b.data());
    std::vector<double> found = b, product(U.size(), 0.);
    solver->solve(found);
    body.mass().vmult_add(1e3, found.data(), product.data());
    K->vmult_add(1., found.data(), product.data());
    for (const unsigned int i : held)
    {
      EXPECT_EQ(found[i], 0.);
      product[i] = b[i];
    }
    EXPECT_LT(verification::largest_difference(b, product), 1e-9) << held.size() << " held";
  }
}

TEST(RigidBodies, forces_and_tangents)
{
  const RigidBody body(spinning({.1, .2, .25}, {}));
  const unsigned int n = body.n_dofs();
  std::vector<double> U(n), f, plus, minus;
  for (unsigned int i = 0; i < n; ++i)
    U[i] = .1 * std::sin(1. + 3. * i);
  const auto K = body.tangent(U, {}, 1., false);
  constexpr double h = 1e-6;
  for (unsigned int j = 0; j < n; ++j)
  {
    std::vector<double> there = U;
    there[j] += h;
    body.internal_force(there, {}, plus);
    there[j] -= 2. * h;
    body.internal_force(there, {}, minus);
    std::vector<double> unit(n, 0.);
    unit[j] = 1.;
    const std::vector<double> column = verification::matrix_times(*K, unit);
    for (unsigned int i = 0; i < n; ++i)
      EXPECT_NEAR((plus[i] - minus[i]) / (2. * h), column[i], 1e-9) << i << ' ' << j;
  }
}

TEST(RigidBodies, free_symmetric_top)
{
  const double a = error_of_top(.01), b = error_of_top(.005), c = error_of_top(.0025);
  EXPECT_NEAR(a / b, 4., .1);
  EXPECT_NEAR(b / c, 4., .05);
  EXPECT_LT(c, 2e-4);
}

TEST(RigidBodies, spin_about_the_intermediate_axis)
{
  const RigidBodyData data = spinning({.1, .2, .3}, {1e-2, 5., 1e-2});
  OneBody one(data);
  Stepper stepper(one.system, given(.01));
  const double energy = one.energy(stepper);
  const Coordinates momentum = angular_momentum(one, stepper, data);
  double worst = 0., turned_over = 1.;
  for (int n = 0; n < 2000; ++n)
  {
    stepper.advance();
    worst = std::max(worst, one.body->deformation(stepper.displacement(0)));
    EXPECT_NEAR(one.energy(stepper), energy, 1e-10 * energy);
    EXPECT_LE(norm(angular_momentum(one, stepper, data) - momentum), 1e-10 * norm(momentum));
    turned_over = std::min(turned_over, now(one, stepper, data, data.axes[1]).y);
  }
  EXPECT_LE(worst, 1e-12);
  EXPECT_LT(turned_over, -.9);
  EXPECT_LE(static_cast<double>(stepper.n_newton_iterations()) / 2000., 8.);
}

TEST(RigidBodies, compound_pendulum)
{
  for (const double degrees : {90., 170.})
  {
    const double angle = degrees * pi / 180.,
                 exact = 4. * std::sqrt((.1 + 3. * .09) / (3. * 9.81 * .3)) *
                         boost::math::ellint_1(std::sin(.5 * angle));
    double before = 0.;
    for (const int steps : {100, 200, 400})
    {
      const Swing found = swing(angle, exact / steps);
      const double error = std::fabs(found.period / exact - 1.);
      EXPECT_LE(found.energy_error, 1e-10) << degrees << " degrees, " << steps;
      EXPECT_LE(found.deformation, 1e-12);
      EXPECT_LE(found.gap, 1e-12);
      EXPECT_TRUE(before == 0. || std::fabs(before / error - 4.) < .3) << degrees << ' ' << steps;
      before = error;
    }
    EXPECT_LE(before, 2e-4) << degrees;
  }
}

// The impulse that stops the place hit, P = v / (1/m + (r x n) . J^-1 (r x n)), with turned axes.
TEST(RigidBodies, impact_beside_the_centre)
{
  RigidBodyData data;
  data.name = "block";
  data.mass = 2.;
  data.moments = {.05, .07, .1};
  data.axes = {{turned({.3, -.5, .8}, {1., 0., 0.}), turned({.3, -.5, .8}, {0., 1., 0.}),
                turned({.3, -.5, .8}, {0., 0., 1.})}};
  data.velocity = {0., -1., 0.};
  OneBody one(data);
  const Coordinates hit = {.2, -.3, .15}, up = {0., 1., 0.};
  one.system.add(Constraint::unilateral("stop", one.system.displacement(0, hit, up)).gap(.0102));
  Stepper stepper(one.system, given(1e-3));
  while (stepper.time() < .0125)
    stepper.advance();
  const Coordinates moment = cross(hit, up);
  Coordinates spin; // J^-1 (r x n)
  for (unsigned int i = 0; i < 3; ++i)
    spin = add_scaled(spin, dot(moment, data.axes[i]) / data.moments[i], data.axes[i]);
  const double impulse = 1. / (1. / data.mass + dot(moment, spin));
  const Coordinates expected = add_scaled(data.velocity, impulse / data.mass, up);
  EXPECT_LE(norm(velocity(one, stepper, {}) - expected), 2e-3);
  for (const Coordinates &axis : data.axes)
    EXPECT_LE(norm(velocity(one, stepper, axis) - velocity(one, stepper, {}) -
                   add_scaled({}, impulse, cross(spin, axis))),
              .02);
  EXPECT_LE(one.energy(stepper), 1. * (1. + 1e-12));
}

// Backward Euler tends to the same motion, and takes energy.
TEST(RigidBodies, a_second_scheme)
{
  const RigidBodyData data = spinning({.1, .2, .3}, {2., 1., 3.});
  const auto end = [&](const double step, const std::string &scheme)
  {
    OneBody one(data);
    Stepper stepper(one.system, given(step, scheme));
    const double energy = one.energy(stepper);
    while (stepper.time() < 1. - .5 * step)
      stepper.advance();
    EXPECT_LE(one.energy(stepper), energy * (1. + 1e-9));
    return moved(one, stepper, add_scaled(data.centre, 1., data.axes[0]));
  };
  const Coordinates limit = end(1e-3, "automatic"), a = end(1e-3, "backward Euler"),
                    b = end(5e-4, "backward Euler");
  EXPECT_LE(norm(b - limit), .02);
  EXPECT_NEAR(norm(a - limit) / norm(b - limit), 2., .1);
}

// Where nothing turns the body, what its conditions miss is rounding: there is always an answer.
TEST(RigidBodies, free_fall_and_rest_have_an_answer_for_any_mass)
{
  for (int mass = 1; mass <= 20; ++mass)
    for (const std::array<double, 3> &moments :
         {std::array<double, 3>{1., 2., 2.5}, {.3, .3, .5}, {7., 11., 13.}})
    {
      RigidBodyData data;
      data.name = "body";
      data.mass = .5 * mass;
      data.centre = {0., -1., 0.};
      data.moments = moments;
      data.gravity = {0., -g, 0.};
      OneBody falling(data), hanging(data);
      hanging.hold({});
      StepperOptions at_rest = given(1e-2);
      at_rest.start = Start::equilibrium;
      Stepper fall(falling.system, given(1e-2)), rest(hanging.system, at_rest);
      for (int n = 0; n < 20; ++n)
      {
        fall.advance();
        rest.advance();
      }
      EXPECT_NEAR(moved(falling, fall, {}).y, -.5 * g * fall.time() * fall.time(), 1e-12);
      EXPECT_LE(norm(moved(hanging, rest, {.4, -1., .3})), 1e-10);
      EXPECT_EQ(fall.measures().error() + rest.measures().error(), "");
    }
}
