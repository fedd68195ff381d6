// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: cables that bend are elasticas. Expected values: closed forms.
#include "verification/scene_tests.h"

#include <taut/cable/find_shape.h>

#include <boost/math/quadrature/tanh_sinh.hpp>
#include <boost/math/tools/toms748_solve.hpp>

namespace
{
  using namespace verification;
  using namespace taut;

  constexpr double EI = 1., EA = 1e6, length = 1.;

  CableElements make(const unsigned int n)
  {
    return {CableElement::ancf, length, n, {EA, EI, 0., 0.}};
  }

  /// The tip of a cantilever of length 1 along x under a dead tip force P along y, with axial
  /// strain: EI theta'' = -(1 + P sin(theta) / EA) P cos(theta), integrated once and then twice
  /// (for EA = infinity: Bisshopp & Drucker, Quarterly of Applied Mathematics 3, 1945, 272-275).
  Coordinates elastica_tip(const double P)
  {
    boost::math::quadrature::tanh_sinh<double> integrator;
    // With theta = alpha - u^2, alpha at the tip: d theta / theta' is regular.
    const auto integral = [&](const double alpha, const auto &f)
    {
      const auto integrand = [&](const double u)
      {
        const double theta = alpha - u * u,
                     // sin(alpha) - sin(theta), over u^2
            difference = u < 1e-6
                             ? std::cos(alpha)
                             : 2. * std::cos(.5 * (alpha + theta)) * std::sin(.5 * u * u) / (u * u),
                     sum = 1. + P / (2. * EA) * (std::sin(alpha) + std::sin(theta));
        return 2. / std::sqrt(2. * P / EI * difference * sum) * f(theta);
      };
      return integrator.integrate(integrand, 0., std::sqrt(alpha));
    };
    std::uintmax_t n = 200;
    const auto alpha = boost::math::tools::toms748_solve(
        [&](const double a) { return integral(a, [](double) { return 1.; }) - length; }, 1e-3,
        .5 * pi - 1e-9, boost::math::tools::eps_tolerance<double>(48), n);
    const auto stretch = [&](const double theta) { return 1. + P * std::sin(theta) / EA; };
    return {integral(alpha.first, [&](const double t) { return stretch(t) * std::cos(t); }),
            integral(alpha.first, [&](const double t) { return stretch(t) * std::sin(t); }), 0.};
  }

  TEST(Elastica, CantileverUnderATipForce)
  {
    // Tip of the inextensible one for P L^2 / EI = 1, 5, 10, from the tables of the literature.
    EXPECT_NEAR(elastica_tip(1.).y, .30172, 2e-5);
    EXPECT_NEAR(elastica_tip(10.).y, .81061, 2e-5);
    const std::tuple<double, unsigned int, double> cases[] = {
        {1., 2, 5e-4},  {1., 8, 2e-6},  {5., 4, 2e-4},  {5., 8, 2e-5},
        {10., 4, 5e-4}, {10., 8, 4e-5}, {10., 16, 2e-6}};
    for (const auto &[P, n, limit] : cases)
    {
      const CableElements cable = make(n);
      const auto straight = [](const double s) { return Coordinates{s, 0., 0.}; };
      const std::vector<double> start =
          cable.interpolate(straight, [&](double) { return straight(1.); });
      std::vector<double> load(cable.n_dofs(), 0.);
      cable.position(length, {0., 1., 0.}).add_to(P, load);
      // The clamp keeps the direction, and leaves the strain free.
      const CableShape shape = find_shape(cable, start, {0, 1, 2, 4, 5}, load);
      const double error = norm(cable.position(shape.positions, length) - elastica_tip(P));
      const std::string what =
          "elastica, P L^2/EI = " + std::to_string(int(P)) + ", " + std::to_string(n) + " elements";
      figure("tip error of an " + what, error, "L");
      figure("iterations of an " + what, shape.n_iterations);
      EXPECT_LT(error, 1.5 * limit) << what;
      EXPECT_LE(shape.n_iterations, 25u) << what;
    }
  }

  TEST(Elastica, CircleByTheRotationOfItsEnd)
  {
    std::vector<double> sizes, errors;
    for (const auto &[n, limit] :
         {std::pair<unsigned int, double>{4, 2.5e-2}, {8, 1.6e-3}, {16, 1e-4}, {32, 6e-6}})
    {
      const CableElements cable = make(n);
      // From a spiral that ends in the direction where it began, and elsewhere.
      const auto angle = [](const double s) { return 2. * pi * s * (1.3 - .3 * s); };
      const auto slope = [&](const double s) {
        return Coordinates{std::cos(angle(s)), std::sin(angle(s)), 0.};
      };
      const auto place = [&](const double s)
      {
        Coordinates r;
        constexpr int steps = 400;
        for (int k = 0; k < steps; ++k)
          r = add_scaled(r, s / steps, slope(s * (k + .5) / steps));
        return r;
      };
      const std::vector<double> start = cable.interpolate(place, slope);
      // In the plane; the directions of both ends are held.
      std::vector<unsigned int> held = {0, 1, 4, 6 * n + 4};
      for (unsigned int i = 2; i < cable.n_dofs(); i += 3)
        held.push_back(i);
      std::sort(held.begin(), held.end());
      const CableShape shape =
          find_shape(cable, start, held, std::vector<double>(cable.n_dofs(), 0.));
      // Its ends meet by symmetry; the moment there, the force on y' times x', is 2 pi EI / L. A
      // moment with an error turns the end too far by the same part, and leaves such a gap.
      EXPECT_NEAR(norm(cable.position(shape.positions, length)), 0., 1e-12);
      std::vector<double> f;
      cable.internal_force(shape.positions, {}, f);
      const double moment = f[6 * n + 4] * shape.positions[6 * n + 3],
                   error = std::fabs(moment / (2. * pi * EI / length) - 1.);
      sizes.push_back(cable.element_length());
      errors.push_back(error);
      figure("end moment error of a circle of " + std::to_string(n) + " elements", error);
      figure("iterations of a circle of " + std::to_string(n) + " elements", shape.n_iterations);
      EXPECT_LT(error, 1.5 * limit) << n;
      EXPECT_NEAR(cable.strain_energy(shape.positions), 2. * pi * pi, 60. * limit);
    }
    EXPECT_NEAR(fitted_order(sizes, errors), 4., .15);
  }
} // namespace
