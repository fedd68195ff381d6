// SPDX-License-Identifier: LGPL-2.1-or-later
#include "../verification/run.h"

#include <taut/scene/contact_surface.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace verification;

namespace
{
  struct Record
  {
    std::vector<double> force, gap, displacement;
  };

  /// Links, contacts, and the nodes on the boundary of each body in each step.
  Record record(const std::string &scene, Overrides overrides, const unsigned int n_parts,
                const taut::Communicator &processes)
  {
    Record result;
    overrides.push_back("Partition/Number of substructures=" + std::to_string(n_parts));
    overrides.push_back("Output/Field interval=0"); // each rank has a folder of its own here
    Session session(scene_file(scene), overrides, processes);
    session.run(
        [&](const taut::StepView &view)
        {
          for (std::size_t i = 0; i < view.constraints.size(); ++i)
            if (view.constraints[i].is_link() || view.constraints[i].contact != taut::no_contact)
            {
              result.force.push_back(view.state.multiplier[i]);
              result.gap.push_back(view.state.geometric_gap[i]);
            }
          std::vector<double> own;
          for (std::size_t b = 0; b < view.scene.bodies.size(); ++b)
          {
            const taut::CustomBody &body = view.scene.bodies[b];
            const std::size_t n_nodes =
                body.type->surface({body.name, body.origin, {}}, {}).points.size();
            for (unsigned int node = 0; node < n_nodes; ++node)
            {
              const std::size_t k = view.structure.index_at_node(b, node);
              for (const taut::Coordinates &axis :
                   {taut::Coordinates{1., 0., 0.}, taut::Coordinates{0., 1., 0.}})
              {
                own.push_back(0.);
                if (k == taut::Structure::elsewhere)
                  continue;
                const taut::LinearForm form = view.structure[k].node_displacement(node, axis);
                own.back() = form.dot(view.reference.displacement[k]) + form.dot(view.state.U[k]);
              }
            }
          }
          view.structure.communicator().sum(own);
          result.displacement.insert(result.displacement.end(), own.begin(), own.end());
        });
    return result;
  }

  /// Largest difference over the largest number.
  double difference(const std::vector<double> &a, const std::vector<double> &b)
  {
    EXPECT_EQ(a.size(), b.size());
    double size = 0., error = 0.;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    {
      size = std::max(size, std::fabs(a[i]));
      error = std::isnan(b[i]) ? INFINITY : std::max(error, std::fabs(a[i] - b[i]));
    }
    return size > 0. ? error / size : error;
  }

  void expect_same(const std::string &scene, const Overrides &overrides)
  {
    const taut::Communicator world(MPI_COMM_WORLD);
    const Record one = record(scene, overrides, 1, taut::Communicator());
    ASSERT_FALSE(one.force.empty());
    ASSERT_FALSE(one.displacement.empty());
    for (const unsigned int n : {1u, 2u, 7u, 64u})
    {
      const std::string where =
          scene + ", " + std::to_string(n) + " parts, " + std::to_string(world.size()) + " ranks, ";
      SCOPED_TRACE(where);
      const Record many = record(scene, overrides, n, world);
      const double u = difference(one.displacement, many.displacement),
                   f = difference(one.force, many.force), d = difference(one.gap, many.gap);
      EXPECT_LT(u, 1e-9);
      EXPECT_LT(f, 1e-7);
      figure(where + "displacement", u);
      figure(where + "force", f);
      figure(where + "gap", d);
    }
  }
} // namespace

// Claim: displacements and forces of solids do not depend on the number of parts and ranks.
// Expected: the run of one process without cuts, U to 1e-9 of the largest, forces to 1e-7: in a
// contact with hanging nodes at rest, and with a wire and its slack dropper in motion.
TEST(Ranks, solids_in_parts_are_the_same)
{
  expect_same("hertz_cylinder", {});
  expect_same("hertz_cylinder", {"Solver/Interface operator=condensed"});
  expect_same("bracket_and_cables", {"Time/End=0.1"});
  expect_same("block_impact", {"Time/End=0.1"});
}
