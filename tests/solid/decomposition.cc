// SPDX-License-Identifier: LGPL-2.1-or-later
// Solids in parts: iterations of FETI against those of an independent program for the same boxes,
// and parts that hang together.
#include "solid/box_in_parts.h"
#include "verification/run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

namespace
{
  using box_in_parts::Box;

  template <int dim>
  double iterations(const Box &box, const double step, const char *preconditioner = "Dirichlet",
                    const char *coarse_space = "rigid body modes")
  {
    const auto solution = box_in_parts::problem<dim>(box)->solve(
        step, {"matrix-free", preconditioner, coarse_space}, 1e-9);
    EXPECT_TRUE(solution.is_solved);
    std::string name = std::to_string(dim) + "-D, " + std::to_string(box.n) +
                       " boxes a side, H/h " + std::to_string(box.elements) +
                       (box.metis_parts > 0        ? ", METIS"
                        : box.stiffness_jump != 1. ? ", jumps"
                                                   : "") +
                       (step > 0. ? ", c tau / h " + std::to_string(step) : ", statics") + ", " +
                       preconditioner + ", " + coarse_space;
    verification::figure(name, solution.statistics.n_iterations);
    return solution.statistics.n_iterations;
  }

  /// What may be more than the reference: the norm in which an iteration ends is another.
  constexpr double excess = 1.2;
} // namespace

// Claim: statics takes as many iterations as FETI with Dirichlet preconditioner and chains of
// constraints is known to take, log^2 (H/h). Expected: an independent program for the same boxes.
TEST(Feti, StaticsOfSquaresAndCubes)
{
  const double in_plane[3][3] = {{10., 15., 18.}, {12., 19., 22.}, {13., 22., 28.}};
  for (const int h : {0, 1, 2})
    for (const int n : {0, 1, 2})
      EXPECT_LE(iterations<2>({2u << n, 4u << h}, 0.), excess * in_plane[h][n]);
  EXPECT_LE(iterations<3>({4, 4}, 0.), excess * 31.);
  EXPECT_LE(iterations<2>({8, 8}, 0., "lumped"), excess * 41.);
}

// Claim: stiffnesses that jump by 1e3 and 1e6 between neighbours do not slow it down, and parts cut
// by METIS hardly. Expected: the same program, 22 and 17 for cubes with jumps, 30 for METIS.
TEST(Feti, JumpsAndUnevenParts)
{
  EXPECT_LE(iterations<3>({4, 4, 1e3}, 0.), excess * 22.);
  EXPECT_LE(iterations<3>({4, 4, 1e6}, 0.), excess * 17.);
  EXPECT_LE(iterations<2>({8, 8, 1., 64}, 0.), excess * 30.);
  EXPECT_LE(iterations<3>({4, 4, 1., 64}, 0.), excess * 48.);
}

// Claim: with the rigid body modes as coarse space, steps of any size take a bounded number of
// iterations. Expected: the same program, 7, 21, 28 at c tau / h of 1, 10, 100 with 256 squares.
TEST(Feti, StepsOfAnySize)
{
  EXPECT_LE(iterations<2>({8, 8}, 1.), excess * 7.);
  EXPECT_LE(iterations<2>({8, 8}, 10.), excess * 21.);
  EXPECT_LE(iterations<2>({8, 8}, 100.), excess * 28.);
  EXPECT_LE(iterations<2>({8, 8}, 1e4), excess * 28.);
  // Without them it grows: the bound above is theirs.
  EXPECT_GT(iterations<2>({8, 8}, 100., "Dirichlet", "none"), 100.);
}

// Claim: every cell is in one part, and the cells of a part hang together by faces, so that no part
// moves like a mechanism. Expected: the definition, on meshes with hanging nodes, too.
TEST(Partition, PartsOfSolidsHangTogether)
{
  for (const unsigned int n_parts : {2u, 7u, 64u, 200u})
  {
    taut::Parameters parameters;
    parameters.read(verification::scene_file("hertz_cylinder"),
                    {"Partition/Number of substructures=" + std::to_string(n_parts)});
    const taut::Partition partition = make_partition(parameters.scene(), parameters.partition);
    const taut::Partition::Division &division = partition.bodies[0];
    const std::size_t n = division.body->cells().size();
    ASSERT_EQ(division.part.size(), n);
    EXPECT_EQ(std::set<unsigned int>(division.part.begin(), division.part.end()).size(), n_parts);
    std::vector<unsigned int> group(n);
    for (unsigned int c = 0; c < n; ++c)
      group[c] = c;
    for (bool has_changed = true; has_changed;)
    {
      has_changed = false;
      for (const auto &[a, b] : division.body->cells().faces)
        if (division.part[a] == division.part[b] && group[a] != group[b])
        {
          group[a] = group[b] = std::min(group[a], group[b]);
          has_changed = true;
        }
    }
    EXPECT_EQ(std::set<unsigned int>(group.begin(), group.end()).size(), n_parts);
    // About equal: METIS with a tolerance, moved cells.
    std::vector<unsigned int> sizes(partition.n_parts, 0);
    for (const unsigned int part : division.part)
      ++sizes[part];
    EXPECT_LT(*std::max_element(sizes.begin(), sizes.end()), 1.3 * n / n_parts + 3.);
  }
}

// Claim: `automatic` cuts solids in space with many DoFs for statics, and nothing else. Expected:
// the table of doc/decomposition.md, where parts are cheaper for up to three solutions.
TEST(Partition, AutomaticNumbersFollowTheTable)
{
  const auto in_space = [](const unsigned int elements)
  {
    Box box;
    box.n = 1;
    box.elements = elements;
    return box_in_parts::scene<3>(std::make_shared<const box_in_parts::BoxType<3>>(box));
  };
  EXPECT_EQ(taut::automatic_number_of_parts(in_space(8), 0.).n, 1u);   // 2187 DoFs
  EXPECT_EQ(taut::automatic_number_of_parts(in_space(15), 0.).n, 24u); // 12 288 DoFs
  EXPECT_EQ(taut::automatic_number_of_parts(in_space(15), 100.).n, 1u);
  Box square;
  square.n = 1;
  square.elements = 100;
  const auto type = std::make_shared<const box_in_parts::BoxType<2>>(square);
  EXPECT_EQ(taut::automatic_number_of_parts(box_in_parts::scene<2>(type), 0.).n, 1u);
}
