// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: a body with thousands of candidates for contact comes to rest on the active set, and in
// the place, of a primal active-set method that eliminates the closed DoFs and factors the rest
// anew for each set. Source: M. Hintermueller, K. Ito, K. Kunisch, SIAM J. Optim. 13 (2003).
#include "solid/obstacle_problem.h"

#include "complementarity/solver.h"
#include "interface/schur_complement.h"

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

TEST(ObstacleProblems, plate_over_a_bowl)
{
  const auto problem = Problem::plate(2);
  for (const char *form : {"automatic", "matrix-free"})
    compare(*problem, form, 1e-10);
}

// With one factor for all sets, systems of a plate take some hundred iterations each. Once the
// preconditioner follows the sets it is exact: each constraint is a DoF of the one body.
TEST(ObstacleProblems, the_preconditioner_follows_the_sets)
{
  const auto problem = Problem::plate(3);
  taut::System system = problem->system();
  const taut::Structure &structure = system.structure();
  const taut::Constraints rows = system.constraints();
  taut::FactoredStructure solvers(structure, "sparse direct");
  solvers.factor_stiffness();
  const auto F = taut::make_schur_complement({"matrix-free", "Dirichlet", "none"}, solvers, rows);
  F->setup(std::vector<double>(rows.size(), 0.));
  taut::BodyVectors P(1);
  structure[0].external_force(0., P[0]);
  taut::MixedComplementarityProblem conditions;
  F->contact_free_predictor(P, conditions.free_gap, conditions.gap_scale);
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    conditions.cones.push_back(rows[i].cone);
    conditions.free_gap[i] += rows[i].gap;
  }
  taut::ComplementaritySolver search;
  const taut::ComplementarityResult &result = search.solve(conditions, F->matrix());
  EXPECT_GT(result.iterations, 10u);
  EXPECT_LE(F->statistics().n_iterations, 60 + 2 * static_cast<long>(F->statistics().n_systems));
  verification::figure("plate over a bowl, systems", F->statistics().n_systems);
  verification::figure("plate over a bowl, iterations", F->statistics().n_iterations);
}
