// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: the forces of cable elements are gradients of their energy, their tangents are derivatives
// of the forces, and mean forces do the work of the energy. Source: differences, and identities.
#include "common.h"

#include "base/dot.h"
#include <taut/cable/cable_elements.h>

namespace
{
  using namespace verification;
  using namespace taut;

  const CableSection section = {2e4, 30., 1.2, 50.};

  /// A curve in space, stretched and compressed, with nodes moved at random.
  std::vector<double> shape(const CableElements &cable, const unsigned int seed)
  {
    const double pi = std::acos(-1.);
    const auto place = [&](const double s) -> Coordinates {
      return {s, std::sin(pi * s / 5.), .3 * std::cos(s)};
    };
    const auto slope = [&](const double s) -> Coordinates {
      return {1., pi / 5. * std::cos(pi * s / 5.), -.3 * std::sin(s)};
    };
    std::vector<double> q = cable.interpolate(place, slope);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> noise(-.1, .1);
    for (double &x : q)
      x += noise(random);
    return q;
  }

  /// from + s along.
  std::vector<double> line(const CableElements &cable, const Coordinates &from,
                           const Coordinates &along)
  {
    return cable.interpolate([&](const double s) { return add_scaled(from, s, along); },
                             [&](double) { return along; });
  }

  class Elements : public testing::TestWithParam<CableElement>
  {
  protected:
    CableElements cable = CableElements(GetParam(), 5., 4, section);

    std::vector<unsigned int> dofs() const
    {
      const std::vector<unsigned int> unused = cable.unused_dofs();
      std::vector<unsigned int> result;
      for (unsigned int i = 0; i < cable.n_dofs(); ++i)
        if (!std::binary_search(unused.begin(), unused.end(), i))
          result.push_back(i);
      return result;
    }
  };

  TEST_P(Elements, ForceIsGradient)
  {
    std::vector<double> q = shape(cable, 1), f;
    cable.internal_force(q, {}, f);
    // Of fourth order.
    const double step = 1e-3;
    for (const unsigned int i : dofs())
    {
      const auto at = [&](const double d)
      {
        std::vector<double> moved = q;
        moved[i] += d;
        return cable.strain_energy(moved);
      };
      const double slope =
          (8. * (at(step) - at(-step)) - (at(2. * step) - at(-2. * step))) / (12. * step);
      EXPECT_NEAR(f[i], slope, 1e-7 * largest(f)) << "DoF " << i;
    }
  }

  TEST_P(Elements, TangentIsDerivative)
  {
    const std::vector<double> q = shape(cable, 2), zero(q.size(), 0.);
    const auto K = make_block_tridiagonal(6, cable.n_dofs()), D = K->clone();
    cable.add_tangent(q, false, *K);
    cable.add_damping(q, .7, *D);
    const double step = 1e-3;
    for (const unsigned int j : dofs())
    {
      const auto force = [&](const double d)
      {
        std::vector<double> moved = q, f;
        moved[j] += d;
        cable.internal_force(moved, {}, f);
        return f;
      };
      const std::vector<double> a = force(step), b = force(-step), c = force(2. * step),
                                d = force(-2. * step);
      std::vector<double> unit = zero, velocity = zero, f, f0;
      unit[j] = 1.;
      velocity[j] = .7;
      const std::vector<double> column = matrix_times(*K, unit), damping = matrix_times(*D, unit);
      cable.internal_force(q, {}, f0);
      cable.internal_force(q, velocity, f);
      for (const unsigned int i : dofs())
      {
        EXPECT_NEAR(column[i], (8. * (a[i] - b[i]) - (c[i] - d[i])) / (12. * step),
                    1e-8 * largest(column))
            << i << ", " << j;
        EXPECT_NEAR(damping[i], f[i] - f0[i], 1e-9 * largest(f0)) << i << ", " << j;
      }
    }
  }

  TEST_P(Elements, DefiniteTangentIsSemidefiniteAndExactWhereTensionRules)
  {
    const std::vector<double> q = shape(cable, 3);
    const auto K = make_block_tridiagonal(6, cable.n_dofs());
    cable.add_tangent(q, true, *K);
    std::mt19937 random(4);
    std::normal_distribution<double> normal;
    for (int k = 0; k < 1000; ++k)
    {
      std::vector<double> x(q.size(), 0.);
      for (const unsigned int i : dofs())
        x[i] = normal(random);
      EXPECT_GE(dot(x, matrix_times(*K, x)), 0.);
    }
    // A straight line under tension has nothing to leave out.
    const std::vector<double> straight = line(cable, {}, {1.01, 0., 0.});
    const auto exact = make_block_tridiagonal(6, cable.n_dofs()), definite = exact->clone();
    cable.add_tangent(straight, false, *exact);
    cable.add_tangent(straight, true, *definite);
    exact->add(-1., *definite);
    exact->visit([](unsigned int, unsigned int, const double value)
                 { EXPECT_NEAR(value, 0., 1e-8); });
  }

  TEST_P(Elements, MeanForceDoesTheWorkOfTheEnergy)
  {
    CableSection elastic = section;
    elastic.axial_damping = 0.;
    const CableElements undamped(GetParam(), 5., 4, elastic);
    // Neighbours, and states that are far apart: the identity has no order.
    for (const double distance : {1e-6, 1e-3, 1.})
    {
      const std::vector<double> q0 = shape(cable, 5), end = shape(cable, 6);
      std::vector<double> q1 = q0, increment(q0.size()), f, g;
      for (std::size_t i = 0; i < q0.size(); ++i)
      {
        q1[i] += distance * (end[i] - q0[i]);
        increment[i] = q1[i] - q0[i];
      }
      undamped.mean_force(q0, q1, .01, f);
      const double energy = undamped.strain_energy(q0);
      EXPECT_NEAR(dot(f, increment), undamped.strain_energy(q1) - energy, 2e-14 * energy);
      // Damping takes energy, as much as eta (delta eps)^2 / step.
      cable.mean_force(q0, q1, .01, g);
      const double taken = dot(g, increment) - dot(f, increment);
      EXPECT_GT(taken, 0.);
      CableSection twice = section;
      twice.axial_damping *= 2.;
      CableElements(GetParam(), 5., 4, twice).mean_force(q0, q1, .02, g);
      EXPECT_NEAR(dot(g, increment) - dot(f, increment), taken, 2e-14 * energy);
    }
  }

  TEST_P(Elements, DampingTakesItsWorkFromAUniformStretch)
  {
    const std::vector<double> q0 = line(cable, {}, {0., 0., 1.}),
                              q1 = line(cable, {}, {0., 0., 1.03});
    std::vector<double> f, increment(q0.size());
    cable.mean_force(q0, q1, .2, f);
    for (std::size_t i = 0; i < q0.size(); ++i)
      increment[i] = q1[i] - q0[i];
    const double elastic = .5 * 2e4 * .03 * .03 * 5., damping = 50. * .03 * .03 / .2 * 5.;
    EXPECT_NEAR(dot(f, increment), elastic + damping, 1e-12 * elastic);
  }

  TEST_P(Elements, MeanForceHasTheMomentOfAMeanState)
  {
    const std::vector<double> q0 = shape(cable, 7), q1 = shape(cable, 8);
    std::vector<double> f;
    cable.mean_force(q0, q1, .01, f);
    // Neither a resultant nor a moment about the origin on the mean configuration.
    double resultant[3] = {}, moment[3] = {};
    for (unsigned int k = 0; k < cable.n_dofs() / 3; ++k)
      for (int c = 0; c < 3; ++c)
      {
        const int d = (c + 1) % 3, e = (c + 2) % 3;
        if (GetParam() == CableElement::bar || k % 2 == 0)
          resultant[c] += f[3 * k + c];
        moment[c] += .5 * (q0[3 * k + d] + q1[3 * k + d]) * f[3 * k + e] -
                     .5 * (q0[3 * k + e] + q1[3 * k + e]) * f[3 * k + d];
      }
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_NEAR(resultant[c], 0., 1e-12 * largest(f));
      EXPECT_NEAR(moment[c], 0., 1e-11 * largest(f));
    }
  }

  TEST_P(Elements, MassAndLoadOfRigidMotions)
  {
    const auto M = make_block_tridiagonal(6, cable.n_dofs());
    cable.add_mass(1., *M);
    std::vector<double> load(cable.n_dofs(), 0.);
    cable.add_load({0., -3., 2.}, load);
    // Unit translation along y; rotation about the first end.
    const auto shift = line(cable, {0., 1., 0.}, {}), turn = line(cable, {}, {0., 1., 0.});
    const auto energy = [&](const std::vector<double> &v) { return dot(v, matrix_times(*M, v)); };
    EXPECT_NEAR(energy(shift), 1.2 * 5., 1e-12);
    EXPECT_NEAR(energy(turn), 1.2 * 125. / 3., 1e-11);
    EXPECT_NEAR(dot(load, shift), -15., 1e-12);
    EXPECT_NEAR(dot(load, turn), -3. * 12.5, 1e-12);
  }

  TEST_P(Elements, PlacesInterpolate)
  {
    // Both elements have polynomials of degree 2.
    const auto place = [](const double s) { return Coordinates{s * s, 1. - s, 2. + s * s}; };
    const auto slope = [](const double s) { return Coordinates{2. * s, -1., 2. * s}; };
    const std::vector<double> q = cable.interpolate(place, slope);
    for (const double s : {0., .7, 2.5, 3.99, 5.})
    {
      EXPECT_NEAR(cable.position(s, {0., 0., 1.}).dot(q), 2. + s * s, 1e-12);
      EXPECT_NEAR(cable.tangent(s, {1., 1., 0.}).dot(q), 2. * s - 1., 1e-12);
      EXPECT_NEAR(cable.position(q, s).y, 1. - s, 1e-12);
    }
  }

  TEST(CableElements, CurvatureOfACircle)
  {
    const double radius = 10.;
    const CableElements cable(CableElement::ancf, 5., 16, section);
    const auto at = [](const double a) { return Coordinates{0., std::sin(a), std::cos(a)}; };
    const std::vector<double> q =
        cable.interpolate([&](const double s) { return add_scaled({}, radius, at(s / radius)); },
                          [&](const double s) { return at(s / radius + std::acos(0.)); });
    EXPECT_NEAR(cable.curvature(q, 2.2), 1. / radius, 1e-4 / radius);
    EXPECT_NEAR(cable.strain_energy(q), .5 * 30. * 5. / (radius * radius), 1e-4);
  }

  TEST_P(Elements, TensionOfAUniformStretch)
  {
    const std::vector<double> q = line(cable, {}, {0., 1.02, 0.});
    for (const double s : {0., 1., 5.})
      EXPECT_NEAR(cable.tension(q, s), 2e4 * .02, 1e-9);
    EXPECT_NEAR(cable.largest_strain(q), .02, 1e-13);
    EXPECT_NEAR(cable.smallest_strain(q), .02, 1e-13);
  }

  INSTANTIATE_TEST_SUITE_P(Both, Elements, testing::Values(CableElement::ancf, CableElement::bar),
                           [](const auto &info)
                           { return info.param == CableElement::ancf ? "ANCF" : "bar"; });
} // namespace
