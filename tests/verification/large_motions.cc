// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: bodies that are not linear move with the right period and keep their energy, with and
// without contacts. Expected values: the pendulum of elliptic integrals; conservation of energy.
#include <taut/base/exceptions.h>
#include <taut/time/stepper.h>

#include <boost/math/special_functions/ellint_1.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace
{
  constexpr double length = 1., bob = 2., gravity = 9.81, pi = 3.14159265358979323846;

  /// A mass on a massless elastic rod from the origin, in the plane of x and z.
  class ElasticPendulum : public taut::Substructure
  {
  public:
    ElasticPendulum(const double angle, const double EA)
        : Substructure("pendulum"), at{length * std::sin(angle), 0., -length * std::cos(angle)},
          EA(EA)
    {
      auto make = [] { return std::make_unique<taut::CoordinateMatrix>(3); };
      auto m = make();
      for (unsigned int i = 0; i < 3; ++i)
        m->add(i, i, bob);
      M = std::move(m);
      C = make();
      K = make();
      K->add(1., *tangent(std::vector<double>(3, 0.), 0., false));
      constant_force = {0., 0., -bob * gravity};
      finish();
    }
    bool is_linear() const override { return false; }
    bool is_lumped() const override { return true; }
    double strain_energy(const std::vector<double> &U) const override
    {
      const double strain = stretch(U) - 1.;
      return .5 * EA * length * strain * strain;
    }
    void internal_force(const std::vector<double> &U, const std::vector<double> &,
                        std::vector<double> &f) const override
    {
      f.resize(3);
      const double l = stretch(U);
      for (unsigned int i = 0; i < 3; ++i)
        f[i] = EA * (1. - 1. / l) * (at[i] + U[i]) / length;
    }
    void mean_internal_force(const std::vector<double> &U0, const std::vector<double> &U1, double,
                             std::vector<double> &f) const override
    {
      f.resize(3);
      const double stress = EA * (1. - 2. / (stretch(U0) + stretch(U1)));
      for (unsigned int i = 0; i < 3; ++i)
        f[i] = stress * (at[i] + .5 * (U0[i] + U1[i])) / length;
    }
    std::unique_ptr<taut::SymmetricMatrix> tangent(const std::vector<double> &U, double,
                                                   const bool definite) const override
    {
      auto result = std::make_unique<taut::CoordinateMatrix>(3);
      const double l = stretch(U);
      double geometric = EA * (1. - 1. / l) / length;
      if (definite)
        geometric = std::max(0., geometric);
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j <= i; ++j)
        {
          const double t = (at[i] + U[i]) * (at[j] + U[j]) / (l * l * length * length) *
                           (EA / length - geometric);
          result->add(i, j, t + (i == j ? geometric : 0.));
        }
      return result;
    }
    std::unique_ptr<taut::SymmetricMatrix> mean_tangent(const std::vector<double> &U0,
                                                        const std::vector<double> &U1, double,
                                                        const bool definite) const override
    {
      auto result = std::make_unique<taut::CoordinateMatrix>(3);
      const double sum = stretch(U0) + stretch(U1);
      double geometric = EA * (1. - 2. / sum) / length;
      if (definite)
        geometric = std::max(0., geometric);
      const double axial = 4. * EA / (sum * sum * stretch(U1) * length * length * length);
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j <= i; ++j)
        {
          const double mi = at[i] + .5 * (U0[i] + U1[i]), mj = at[j] + .5 * (U0[j] + U1[j]),
                       t = axial * mi * mj;
          result->add(i, j, t + (i == j ? geometric : 0.));
        }
      return result;
    }
    taut::LinearForm displacement(const taut::Coordinates &,
                                  const taut::Coordinates &direction) const override
    {
      taut::LinearForm form;
      for (unsigned int i = 0; i < 3; ++i)
        form.add(i, direction[i]);
      return form;
    }

    double energy(const std::vector<double> &U, const std::vector<double> &V) const
    {
      return strain_energy(U) + bob * gravity * (at[2] + U[2]) +
             .5 * bob * (V[0] * V[0] + V[1] * V[1] + V[2] * V[2]);
    }
    double x(const std::vector<double> &U) const { return at[0] + U[0]; }

  private:
    double stretch(const std::vector<double> &U) const
    {
      double sum = 0.;
      for (unsigned int i = 0; i < 3; ++i)
        sum += (at[i] + U[i]) * (at[i] + U[i]);
      return std::sqrt(sum) / length;
    }
    double at[3], EA;
  };

  /// Its mean force is a part of what its energy asks for.
  class CarelessPendulum : public ElasticPendulum
  {
  public:
    CarelessPendulum(const double part) : ElasticPendulum(.5 * pi, 1e3), part(part) {}
    void mean_internal_force(const std::vector<double> &U0, const std::vector<double> &U1,
                             const double step, std::vector<double> &f) const override
    {
      ElasticPendulum::mean_internal_force(U0, U1, step, f);
      for (double &force : f)
        force *= part;
    }

  private:
    double part;
  };

  double exact_period(const double amplitude)
  {
    return 4. * std::sqrt(length / gravity) * boost::math::ellint_1(std::sin(.5 * amplitude));
  }

  struct Swing
  {
    double period_error = 0., energy_change = 0.;
  };

  /// Five periods with n steps each.
  Swing swing(const double amplitude, const int n, const std::string &scheme)
  {
    const ElasticPendulum *pendulum = nullptr;
    taut::System system;
    system.add("pendulum",
               [&]
               {
                 auto body = std::make_unique<ElasticPendulum>(amplitude, 1e6);
                 pendulum = body.get();
                 return body;
               });
    const double period = exact_period(amplitude);
    taut::StepperOptions options;
    options.step = period / n;
    options.start = taut::Start::undeformed;
    options.scheme = scheme;
    taut::Stepper stepper(system, options);
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
        crossings.push_back(stepper.time() - options.step * now / (now - x));
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
  try
  {
    swing(.5 * pi, 50, "Newmark");
    FAIL() << "accepted";
  }
  catch (const std::exception &e)
  {
    EXPECT_NE(std::string(e.what()).find("gains energy in large motions"), std::string::npos)
        << e.what();
  }
}

// The wall at x = 0 is hit at full speed: an inelastic impact of the mass, which then hangs.
TEST(LargeMotions, energy_from_nowhere_is_an_error)
{
  for (const double part : {1., .3})
  {
    taut::System system;
    system.add("pendulum", [&] { return std::make_unique<CarelessPendulum>(part); });
    taut::StepperOptions options;
    options.step = .01;
    options.start = taut::Start::undeformed;
    taut::Stepper stepper(system, options);
    while (stepper.time() < 20.)
      stepper.advance();
    const std::string error = stepper.measures().error();
    if (part == 1.)
    {
      EXPECT_EQ(error, "");
      EXPECT_LE(stepper.measures().summary().relative_motion_energy, 1e-7);
      continue;
    }
    EXPECT_NE(error.find("bodies that move by large amounts gained"), std::string::npos) << error;
    EXPECT_EQ(stepper.measures().warnings().front().kind, "motion_energy");
  }
}

TEST(LargeMotions, rigid_wall_takes_the_energy_and_gives_none)
{
  const ElasticPendulum *pendulum = nullptr;
  taut::System system;
  const double amplitude = pi / 3.;
  system.add("pendulum",
             [&]
             {
               auto body = std::make_unique<ElasticPendulum>(amplitude, 1e5);
               pendulum = body.get();
               return body;
             });
  system.add(taut::Constraint::unilateral("wall", system.displacement(0, {}, {1., 0., 0.}))
                 .gap(length * std::sin(amplitude)));
  taut::StepperOptions options;
  options.step = 2e-3;
  options.start = taut::Start::undeformed;
  taut::Stepper stepper(system, options);
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
  class ImpatientPendulum : public ElasticPendulum
  {
  public:
    ImpatientPendulum(int &refused, double &shortest)
        : ElasticPendulum(pi / 3., 1e5), n_refused(refused), shortest(shortest)
    {
    }
    void mean_internal_force(const std::vector<double> &U0, const std::vector<double> &U1,
                             const double step, std::vector<double> &f) const override
    {
      shortest = std::min(shortest, step);
      ElasticPendulum::mean_internal_force(U0, U1, step, f);
    }
    std::unique_ptr<taut::SymmetricMatrix> mean_tangent(const std::vector<double> &U0,
                                                        const std::vector<double> &U1,
                                                        const double rate,
                                                        const bool definite) const override
    {
      auto K = ElasticPendulum::mean_tangent(U0, U1, rate, definite);
      if (U0[0] != 0. && rate < 2. / .015)
      {
        ++n_refused;
        K->add(0, 0, std::nan("")); // which has no factor
      }
      return K;
    }

  private:
    int &n_refused;
    double &shortest;
  };

  int n_refused = 0;
  double shortest = 1.;
  taut::System system;
  system.add("pendulum", [&] { return std::make_unique<ImpatientPendulum>(n_refused, shortest); });
  taut::StepperOptions options;
  options.step = .02;
  options.start = taut::Start::undeformed;
  taut::Stepper stepper(system, options);
  for (int n = 1; n <= 20; ++n)
  {
    stepper.advance();
    EXPECT_NEAR(stepper.time(), n * options.step, 1e-12);
    EXPECT_LT(stepper.certificate().balance, 1e-9);
  }
  EXPECT_GT(n_refused, 18);
  EXPECT_EQ(shortest, .5 * options.step);
}

// A body may refuse a step that is too long for it: the step is made in parts and ends where it
// would have ended, with the energy of the start.
TEST(LargeMotions, step_that_a_body_refuses_is_made_in_parts)
{
  constexpr double farthest = .02;
  class CarefulPendulum : public ElasticPendulum
  {
  public:
    explicit CarefulPendulum(int &refused) : ElasticPendulum(pi / 3., 1e5), n_refused(refused) {}
    void mean_internal_force(const std::vector<double> &U0, const std::vector<double> &U1,
                             const double step, std::vector<double> &f) const override
    {
      for (unsigned int i = 0; i < 3; ++i)
        if (std::fabs(U1[i] - U0[i]) > farthest)
        {
          ++n_refused;
          throw taut::UserError("too far");
        }
      ElasticPendulum::mean_internal_force(U0, U1, step, f);
    }

  private:
    int &n_refused;
  };

  int n_refused = 0;
  const CarefulPendulum *pendulum = nullptr;
  taut::System system;
  system.add("pendulum",
             [&]
             {
               auto body = std::make_unique<CarefulPendulum>(n_refused);
               pendulum = body.get();
               return body;
             });
  taut::StepperOptions options;
  options.step = .01;
  options.start = taut::Start::undeformed;
  taut::Stepper stepper(system, options);
  for (int n = 1; n <= 100; ++n)
  {
    stepper.advance();
    EXPECT_NEAR(stepper.time(), n * options.step, 1e-12);
  }
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
