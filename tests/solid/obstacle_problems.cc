// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: a body with thousands of candidates for contact comes to rest on the active set, and in
// the place, of a primal active-set method that eliminates the closed DoFs and factors the rest
// anew for each set. Source: M. Hintermueller, K. Ito, K. Kunisch, SIAM J. Optim. 13 (2003).
#include "solid/obstacle_problem.h"

#include <gtest/gtest.h>

namespace
{
  using obstacle::Problem;

  void compare(const Problem &problem, const std::string &form, const double tolerance)
  {
    const Problem::Solution exact = problem.by_elimination(), found = problem.by_taut(form);
    EXPECT_EQ(found.closed, exact.closed) << form;
    EXPECT_LE(verification::largest_difference(found.displacement, exact.displacement),
              tolerance * verification::largest(exact.displacement))
        << form;
    const auto n_closed = std::count(exact.closed.begin(), exact.closed.end(), 1);
    EXPECT_GT(n_closed, static_cast<long>(problem.n_candidates() / 4));
    EXPECT_LT(n_closed, static_cast<long>(problem.n_candidates() * 3 / 4));
  }
} // namespace

TEST(ObstacleProblems, membrane_over_stairs)
{
  const auto problem = Problem::membrane(5);
  for (const char *form : {"automatic", "matrix-free", "assembled dense"})
    compare(*problem, form, 1e-12);
}

// Systems of one factor for all sets take some hundred iterations here: the preconditioner follows.
TEST(ObstacleProblems, plate_over_a_bowl)
{
  const auto problem = Problem::plate(2);
  for (const char *form : {"automatic", "matrix-free"})
    compare(*problem, form, 1e-10);
}
