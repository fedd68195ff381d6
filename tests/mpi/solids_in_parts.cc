// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: solids in parts move on any number of ranks as whole ones on one. Source: the run of one
// process without cuts.
#include "nodes.h"

using namespace verification;

namespace
{
  void expect_same_solid(const std::string &scene, const Overrides &overrides)
  {
    const NodeRecord one = record_nodes(scene, overrides, taut::Communicator());
    ASSERT_FALSE(one.force.empty());
    ASSERT_FALSE(one.displacement.empty());
    for (const unsigned int n : {1u, 2u, 7u, 64u})
    {
      const std::string where = scene + ", " + std::to_string(n) + " parts, " + ranks_and_comma();
      SCOPED_TRACE(where);
      const NodeRecord many = record_nodes(
          scene, overrides + Overrides{"Partition/Number of substructures=" + std::to_string(n)},
          taut::Communicator(MPI_COMM_WORLD));
      EXPECT_LT(
          figure(where + "displacement", relative_difference(one.displacement, many.displacement)),
          1e-9);
      EXPECT_LT(figure(where + "force", relative_difference(one.force, many.force)), 1e-7);
      figure(where + "gap", relative_difference(one.gap, many.gap));
    }
  }
} // namespace

// Claim: displacements and forces of solids do not depend on the number of parts and ranks.
// Expected: the run of one process without cuts, U to 1e-9 of the largest, forces to 1e-7: in a
// contact with hanging nodes at rest, and with a wire and its slack dropper in motion.
TEST(Ranks, solids_in_parts_are_the_same)
{
  expect_same_solid("hertz_cylinder", {});
  expect_same_solid("hertz_cylinder", {"Solver/Interface operator=assembled dense"});
  expect_same_solid("bracket_and_cables", {"Time/End=0.1"});
  expect_same_solid("block_impact", {"Time/End=0.1"});
}

namespace
{
  /// The rows of a rank, those of all ranks, and the common ones.
  struct RowCounts
  {
    double own = 0., held = 0., all = 0., common = 0.;
  };

  RowCounts row_counts(const std::string &scene, const Overrides &overrides)
  {
    RowCounts result;
    Session session(scene_file(scene), overrides + Overrides{"Output/Field interval=0"},
                    taut::Communicator(MPI_COMM_WORLD));
    session.run(
        [&](const taut::StepView &view)
        {
          const taut::Constraints &rows = view.constraints;
          result = {0., static_cast<double>(rows.size()), static_cast<double>(rows.n_of_all()),
                    static_cast<double>(rows.common_rows().size())};
          for (std::size_t i = 0; i < rows.size(); ++i)
          {
            result.own += rows.is_own(i);
            EXPECT_EQ(rows.index(rows.number(i)), i);
          }
        });
    return result;
  }
} // namespace

// Claim: where F is matrix-free, a rank has the cuts of its own bodies and no others, each is owned
// by one rank, and contacts are on all of them; at rest and in steps. Expected: the run of one
// process without cuts, U to 1e-9 of the largest, forces to 1e-7.
TEST(Ranks, cuts_live_with_their_bodies)
{
  const taut::Communicator world(MPI_COMM_WORLD);
  const Overrides matrix_free = {"Solver/Interface operator=matrix-free"};
  for (const auto &[scene, more] :
       {std::pair<std::string, Overrides>("hertz_cylinder", {}),
        std::pair<std::string, Overrides>("block_impact", {"Time/End=0.1"}),
        std::pair<std::string, Overrides>("block_impact",
                                          {"Time/End=0.1", "Time/Scheme=generalised-alpha",
                                           "Time/Allow unsuitable scheme=true"})})
  {
    SCOPED_TRACE(scene);
    expect_same_solid(scene, matrix_free + more);
    const RowCounts rows =
        row_counts(scene, matrix_free + more + Overrides{"Partition/Number of substructures=16"});
    EXPECT_EQ(world.size() > 1, rows.held < rows.all);
    EXPECT_GT(rows.common, 0.);
    double sums[] = {rows.own, rows.held - rows.common};
    world.sum(sums, 2);
    EXPECT_EQ(sums[0], rows.all);
    // A cut is on two ranks at most.
    EXPECT_LE(sums[1], 2. * (rows.all - rows.common));
  }
}
