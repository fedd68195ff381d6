// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: solids in parts move on any number of ranks as whole ones on one. Source: the run of one
// process without cuts.
#include "nodes.h"

using namespace verification;

namespace
{
  void expect_same_solid(const std::string &title, const std::string &text,
                         const Overrides &overrides, const std::vector<unsigned int> &numbers)
  {
    const NodeRecord one = record_nodes_of(
        text, overrides + Overrides{"Partition/Number of substructures=1"}, taut::Communicator());
    ASSERT_FALSE(one.force.empty());
    ASSERT_FALSE(one.displacement.empty());
    for (const unsigned int n : numbers)
    {
      const std::string where = title + ", " + std::to_string(n) + " parts, " + ranks_and_comma();
      SCOPED_TRACE(where);
      const NodeRecord many = record_nodes_of(
          text, overrides + Overrides{"Partition/Number of substructures=" + std::to_string(n)},
          taut::Communicator(MPI_COMM_WORLD));
      EXPECT_LT(
          figure(where + "displacement", relative_difference(one.displacement, many.displacement)),
          1e-9);
      EXPECT_LT(figure(where + "force", relative_difference(one.force, many.force)), 1e-7);
      figure(where + "gap", relative_difference(one.gap, many.gap));
    }
  }

  void expect_same_solid(const std::string &scene, const Overrides &overrides)
  {
    expect_same_solid(scene, scene_file(scene), overrides, {1u, 2u, 7u, 64u});
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

// Claim: so are blocks whose meshes do not match, tied by mortar constraints across ranks, and a
// solid in space on a floor. Expected: as above.
TEST(Ranks, mortar_constraints_and_solids_in_space_are_the_same)
{
  expect_same_solid("block_on_block", scene_file("block_on_block"), {}, {2u, 7u});
  const Overrides fine = {"Body lower/Mesh/Arguments=20, 12 : 0, 0 : 1, 0.5",
                          "Body upper/Mesh/Arguments=28, 12 : 0, 0.5 : 1, 1",
                          "Solver/Interface operator=matrix-free"};
  expect_same_solid("block_on_block", scene_file("block_on_block"), fine, {64u});
  for (const char *const largest_whole : {"20000000", "0"}) // MUMPS shares the coarse problem out
    expect_same_solid("cube_on_floor", cube_on_floor(10),
                      {std::string("Solver/Largest whole factor=") + largest_whole}, {27u});
}

// Claim: so is a cube in 512 parts. Expected: as above.
TEST(Ranks, every_part_of_a_large_cube_is_the_same)
{
  expect_same_solid("cube_on_floor", cube_on_floor(24), {}, {512u});
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
          // All ranks name the first cut and the last link, whoever has them.
          const std::vector<std::size_t> ends = {0, rows.n_of_all() - 1};
          EXPECT_EQ(rows.labels(ends).size(), ends.size());
          const std::string own = rows.names(ends);
          std::string of_root = own;
          taut::Communicator(MPI_COMM_WORLD).broadcast(of_root);
          EXPECT_EQ(own, of_root);
          EXPECT_FALSE(has(own, "''")) << own;
          for (std::size_t i = 0; i < rows.size(); ++i)
          {
            result.own += rows.is_own(i);
            EXPECT_EQ(rows.index(rows.number(i)), i);
          }
        });
    return result;
  }
} // namespace

// Claim: where F is matrix-free, a rank has the cuts, links and contacts of its own bodies and no
// others, at rest and in motion, and each is owned by one rank; those that slide are on all of
// them. Expected: the run of one process without cuts, U to 1e-9 of the largest, forces to 1e-7.
TEST(Ranks, rows_live_with_their_bodies)
{
  const taut::Communicator world(MPI_COMM_WORLD);
  const Overrides matrix_free = {"Solver/Interface operator=matrix-free"};
  struct Case
  {
    std::string scene;
    Overrides more;
    bool has_sliding;
  };
  for (const auto &[scene, more, has_sliding] :
       {Case{"hertz_cylinder", {}, false}, Case{"en50318_2002_250", {"Time/End=0"}, true},
        Case{"en50318_2002_250", {"Time/End=0.01", "Statistics/Window="}, true},
        Case{"block_impact", {"Time/End=0.1"}, false},
        Case{"block_impact",
             {"Time/End=0.1", "Time/Scheme=generalised-alpha", "Time/Allow unsuitable scheme=true"},
             false}})
  {
    SCOPED_TRACE(scene);
    if (!has_sliding) // a line has no nodes of bodies
      expect_same_solid(scene, scene_file(scene), matrix_free + more, {7u, 64u});
    const RowCounts rows =
        row_counts(scene, matrix_free + more + Overrides{"Partition/Number of substructures=16"});
    EXPECT_EQ(world.size() > 1, rows.held < rows.all);
    EXPECT_EQ(rows.common > 0., world.size() == 1 || has_sliding);
    double sums[] = {rows.own, rows.held - rows.common};
    world.sum(sums, 2);
    EXPECT_EQ(sums[0], rows.all);
    // A row is on two ranks at most.
    EXPECT_LE(sums[1], 2. * (rows.all - rows.common));
  }
}
