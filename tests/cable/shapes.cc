// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: the shapes of cables are those of the elastic catenary, whatever their slack. Expected
// values: closed forms.
#include "cable/elastic_catenary.h"

#include <taut/base/exceptions.h>
#include <taut/cable/find_shape.h>

#include <gtest/gtest.h>

#include <cmath>

namespace
{
  using namespace taut;

  constexpr double EA = 1.3e7, mass = 1.07, gravity = 9.81;
  const Coordinates weight = {0., -mass * gravity, 0.};

  CableElements make(const CableElement element, const double length, const unsigned int n,
                     const double EI = 0.)
  {
    return {element, length, n, {EA, EI, mass, 0.}};
  }

  /// Of the first end.
  double end_force(const CableElements &cable, const CableShape &shape, const Coordinates &load)
  {
    std::vector<double> f, p(cable.n_dofs(), 0.);
    cable.internal_force(shape.positions, {}, f);
    cable.add_load(load, p);
    return std::hypot(std::hypot(f[0] - p[0], f[1] - p[1]), f[2] - p[2]);
  }

  double largest_error(const CableElements &cable, const CableShape &shape,
                       const ElasticCatenary &exact)
  {
    double error = 0.;
    for (unsigned int i = 0; i <= cable.n_elements(); ++i)
    {
      const double s = i * cable.element_length();
      error = std::fmax(error,
                        norm(cable.position(shape.positions, s) - exact.position(s)));
    }
    return error;
  }

  TEST(CableShapes, IterationsOfManyCables)
  {
    struct Case
    {
      double length, drop;
    };
    for (const Case &c : {Case{59.93, 0.}, Case{60., 0.}, Case{63., -6.}, Case{78., 0.}, Case{120., 0.}})
      for (const unsigned int n : {8, 16, 32, 64})
        for (const int kind : {0, 1, 2})
        {
          const CableElements cable = make(kind == 2 ? CableElement::bar : CableElement::ancf,
                                           c.length, n, kind == 1 ? 1. : 0.);
          const Coordinates to = {60., c.drop, 0.};
          const ElasticCatenary exact({}, to, weight, EA, c.length);
          ASSERT_LT(exact.error, 1e-9);
          const CableShape shape = hang(cable, {}, to, weight);
          std::printf("%6.2f n %2u kind %d: %2u iterations, residual %.1e, error %.2e\n", c.length, n,
                      kind, shape.n_iterations, shape.residual,
                      largest_error(cable, shape, exact));
          EXPECT_LE(shape.n_iterations, 25u);
        }
  }

  struct Row
  {
    CableElement element;
    unsigned int n;
    double sag, force; ///< errors, the latter relative
  };

  TEST(CableShapes, SlackCatenary)
  {
    const Coordinates to = {60., 0., 0.};
    const ElasticCatenary exact({}, to, weight, EA, 78.);
    EXPECT_NEAR(-exact.position(39.).y, 22.1293, 5e-5);
    EXPECT_NEAR(exact.end_force(), 476.88, 5e-3);
    for (const Row &row : {Row{CableElement::ancf, 8, 8.5e-4, 9e-7}, Row{CableElement::ancf, 32, 3.1e-6, 3e-9},
                           Row{CableElement::bar, 8, 6e-4, 6e-7}, Row{CableElement::bar, 32, 2e-6, 2e-9}})
    {
      const CableElements cable = make(row.element, 78., row.n);
      const CableShape shape = hang(cable, {}, to, weight);
      const double e_sag = std::fabs(cable.position(shape.positions, 39.).y - exact.position(39.).y),
                   e_force = std::fabs(end_force(cable, shape, weight) / exact.end_force() - 1.);
      std::printf("%d %u: %g %g\n", int(row.element), row.n, e_sag, e_force);
      EXPECT_LT(e_sag, 1.5 * row.sag);
      EXPECT_LT(e_force, 1.5 * row.force);
    }
  }

  TEST(CableShapes, TautCatenary)
  {
    const Coordinates to = {60., 0., 0.};
    // The length of a horizontal tension of 16 kN, by symmetry V = w L / 2.
    const double H = 16e3, w = mass * gravity;
    double low = 59., high = 61.;
    for (int k = 0; k < 100; ++k)
    {
      const double L = .5 * (low + high);
      (H * L / EA + 2. * H / w * std::asinh(.5 * w * L / H) < 60. ? low : high) = L;
    }
    const ElasticCatenary exact({}, to, weight, EA, low);
    EXPECT_NEAR(exact.horizontal(), H, 1e-5);
    EXPECT_NEAR(-exact.position(.5 * low).y, .294866, 1e-6);
    for (const Row &row : {Row{CableElement::ancf, 4, 6e-9, 2e-8}, Row{CableElement::bar, 4, 4e-9, 1e-8}})
    {
      const CableElements cable = make(row.element, low, row.n);
      const CableShape shape = hang(cable, {}, to, weight);
      const double e_sag = std::fabs(cable.position(shape.positions, .5 * low).y - exact.position(.5 * low).y),
                   e_force = std::fabs(end_force(cable, shape, weight) / exact.end_force() - 1.);
      std::printf("%d %u: %g %g\n", int(row.element), row.n, e_sag, e_force);
      EXPECT_LT(e_sag, 1.5 * row.sag);
      EXPECT_LT(e_force, 1.5 * row.force);
    }
  }

  TEST(CableShapes, WindInSpace)
  {
    const Coordinates to = {60., -6., 0.}, load = {0., -10.5, 8.};
    const ElasticCatenary exact({}, to, load, EA, 63.);
    for (const auto &[n, limit] : {std::pair<unsigned int, double>{4, 1.6e-3}, {16, 6.5e-6}, {64, 1e-8}})
    for (const auto element : {CableElement::ancf, CableElement::bar})
    {
      const CableElements cable = make(element, 63., n);
      const CableShape shape = hang(cable, {}, to, load);
      std::printf("%d %u: %g, %u\n", int(element), n, largest_error(cable, shape, exact), shape.n_iterations);
      EXPECT_LT(largest_error(cable, shape, exact), 1.5 * limit);
    }
  }
} // namespace
