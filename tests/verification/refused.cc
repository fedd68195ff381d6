// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: what a program may ask of schemes and constraints outside of their ranges is a UserError
// that says the range, and its ends are allowed. Source: the ranges in integrator.h and system.h.
#include "common.h"

#include <taut/base/force_law.h>
#include <taut/interface/system.h>
#include <taut/time/integrator.h>

using verification::error_of;
using verification::has;

TEST(Refused, parameters_of_schemes_beyond_their_ranges)
{
  constexpr double step = .1, third = 1. / 3., beyond = std::numeric_limits<double>::epsilon(),
                   nan = std::numeric_limits<double>::quiet_NaN();
  for (const double beta : {0., -1., nan})
    EXPECT_TRUE(has(error_of([=] { taut::newmark(step, beta, .5); }), "beta > 0"));
  for (const double gamma : {.5 - beyond, nan})
    EXPECT_TRUE(has(error_of([=] { taut::newmark(step, .25, gamma); }), "gamma >= 1/2"));
  for (const double rho : {-beyond, 1. + beyond, nan})
    EXPECT_TRUE(has(error_of([=] { taut::generalised_alpha(step, rho); }), "[0, 1]"));
  for (const double alpha : {-beyond, third + beyond, nan})
    EXPECT_TRUE(has(error_of([=] { taut::hht(step, alpha); }), "[0, 1/3]"));
  for (const double theta : {.5 - beyond, 1. + beyond, nan})
    EXPECT_TRUE(has(error_of([=] { taut::moreau_jean(step, theta, 0.); }), "[1/2, 1]"));
  for (const double restitution : {-beyond, 1. + beyond, nan})
    EXPECT_TRUE(has(error_of([=] { taut::moreau_jean(step, .5, restitution); }), "restitution"));
  for (const double end : {0., 1.})
  {
    EXPECT_EQ(error_of([=] { taut::generalised_alpha(step, end); }), "");
    EXPECT_EQ(error_of([=] { taut::hht(step, third * end); }), "");
    EXPECT_EQ(error_of([=] { taut::moreau_jean(step, .5 + .5 * end, end); }), "");
  }
}

TEST(Refused, laws_of_constraints_that_pull_and_push)
{
  const auto law =
      std::make_shared<taut::TableLaw>(std::vector<std::pair<double, double>>{{1., 2.}, {2., 3.}});
  const std::string error =
      error_of([&] { taut::Constraint::bilateral("rod", taut::Displacement()).law(law); });
  EXPECT_TRUE(has(error, "'rod'"));
  EXPECT_TRUE(has(error, "give this one a stiffness"));
  EXPECT_EQ(error_of([&] { taut::Constraint::unilateral("stop", taut::Displacement()).law(law); }),
            "");
}
