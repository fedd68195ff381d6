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
