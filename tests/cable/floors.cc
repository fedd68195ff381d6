// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: cables between level supports are found at rest on a floor close below, also where they
// lie slack, and stay there. Source: balance of forces; catenaries that end level (Irvine 1981).
#include "cable/one_cable.h"
#include "cable/slack_cable.h"
#include "verification/scene_tests.h"

namespace
{
  using namespace verification;
  using namespace taut;

  constexpr double span = 30., weight = 1.07 * 9.81;

  struct AtRest
  {
    double horizontal = 0., least_tension = 0., floor = 0., ends = 0.; ///< [N]
    double balance = 0.;                                               ///< of the certificate
    double way = 0.; ///< of the fastest node in what follows [m]
  };

  /// Every node may touch the floor; then some steps.
  AtRest on_floor(const double length, const double depth, const unsigned int n, const double EA,
                  const CableElement element)
  {
    CableData data = cable_to({span, 0., 0.}, length, {EA, 0., 1.07, 0.}, n);
    data.element = element;
    OneCable<> one(data);
    one.add_floor(depth, length, n);
    const Cable *const cable = one.cable;
    Stepper stepper(one.system, steps_of(2e-3, Start::equilibrium));
    AtRest result;
    result.balance = stepper.residuals().balance;
    const std::vector<double> U = stepper.displacement(0), r = unbalanced(*cable, U);
    const auto first = cable->elements().end_dofs(false), last = cable->elements().end_dofs(true);
    result.horizontal = r[first[0]];
    result.ends = -r[first[1]] - r[last[1]];
    for (unsigned int k = 0; k + 1 < n; ++k)
      result.floor += stepper.multiplier(k);
    result.least_tension = EA * cable->elements().smallest_strain(cable->positions(U));
    for (int k = 0; k < 5; ++k)
      stepper.advance();
    result.way = largest_difference(U, stepper.displacement(0));
    return result;
  }

  /// H of a free part that ends level on the floor; 0 if all that is too long lies there slack.
  double horizontal_on_floor(const double length, const double depth)
  {
    const double found = end_of(1e-9, 1e3,
                                [&](const double h)
                                {
                                  const double a = std::sqrt(depth * depth + 2. * h * depth);
                                  return 2. * h * std::asinh(a / h) + length - 2. * a < span;
                                });
    return found > 1e-8 ? found * weight : 0.;
  }
} // namespace

TEST(CableFloors, close_below_the_supports)
{
  for (const CableElement element : {CableElement::ancf, CableElement::bar})
    for (const unsigned int n : {8u, 16u})
      for (const double length : {30.2, 31., 32., 34.})
        for (const double depth : {.3, 1., 3.})
          for (const double EA : {1e6, 1.3e7})
          {
            std::ostringstream title;
            title << length << " m, " << depth << " m below, " << n << " elements, EA " << EA;
            SCOPED_TRACE(title.str());
            const auto check = [&]
            {
              const AtRest found = on_floor(length, depth, n, EA, element);
              const double all = weight * length;
              EXPECT_LE(found.balance, 1e-8);
              EXPECT_NEAR(found.floor + found.ends, all, 1e-6 * all);
              EXPECT_GT(found.least_tension, -1e-4 * all);
              EXPECT_LT(found.way, 1e-6);
            };
            EXPECT_EQ(error_of(check), "");
          }
}

// Just as long as its free parts and the way between, or a little less: the energy is nearly level.
TEST(CableFloors, where_tension_is_about_to_vanish)
{
  for (const double depth : {.75, 1.})
  {
    const AtRest found =
        on_floor(span + 2. * depth - (depth < 1. ? 0. : .5), depth, 32, 1.3e7, CableElement::ancf);
    EXPECT_LE(found.balance, 1e-8) << depth;
    EXPECT_LT(found.way, 1e-6) << depth;
  }
}

TEST(CableFloors, tension_is_that_of_the_free_parts)
{
  for (const double length : {31., 32., 33.})
  {
    const AtRest found = on_floor(length, 1.5, 64, 1e6, CableElement::ancf);
    const double exact = horizontal_on_floor(length, 1.5);
    figure("horizontal force of a cable on a floor 1.5 m below, less that of its free parts",
           found.horizontal - exact, "N");
    EXPECT_NEAR(found.horizontal, exact, .1 * weight * length / 64.);
  }
}

// A chain that is nearly as long as its vertical parts and the floor between them. It touches at
// nodes, so that the load on the floor is of first order: it lacks 1.1 elements of 16, 2.4 of 256,
// which are still longer than H / weight, over which the chain turns level. Bound: three elements.
TEST(CableFloors, nearly_slack_chains)
{
  for (const auto &[length, depth] : {std::pair(35.9, 3.), {31.5, 1.}})
  {
    const double h = horizontal_on_floor(length, depth) / weight,
                 free = std::sqrt(depth * depth + 2. * h * depth),
                 exact = weight * (length - 2. * free);
    double last = 0.;
    for (const unsigned int n : {16u, 64u, 256u})
    {
      const double lacks = exact - on_floor(length, depth, n, 1e7, CableElement::bar).floor;
      EXPECT_LT(std::fabs(lacks), 3. * weight * length / n) << length << " " << n;
      last = std::fabs(lacks);
    }
    figure("load on a floor of a chain of " + std::to_string(length) + " m in 256 bars lacks",
           last / (weight * length / 256.), "elements");
  }
}
