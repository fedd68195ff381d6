// SPDX-License-Identifier: LGPL-2.1-or-later
#include "../verification/run.h"

#include <taut/scene/contact_surface.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

using namespace verification;

namespace
{
  struct Record
  {
    std::vector<double> force, displacement, probes;
    std::string slack; ///< what the log says of it
  };

  std::string lines_with(const std::string &word, const std::string &log)
  {
    std::istringstream lines(log);
    std::string line, result;
    while (std::getline(lines, line))
      if (line.find(word) != std::string::npos)
        result += line + '\n';
    return result;
  }

  /// Links, and all nodes of the cables, in each step.
  Record record(const std::string &scene, Overrides overrides, const taut::Communicator &processes)
  {
    Record result;
    overrides.push_back("Output/Field interval=0"); // each rank has a folder of its own here
    Session session(scene_file(scene), overrides, processes);
    std::vector<std::size_t> n_nodes;
    session.run(
        [&](const taut::StepView &view)
        {
          result.force.insert(result.force.end(), view.state.multiplier.begin(),
                              view.state.multiplier.end());
          result.probes.insert(result.probes.end(), view.probes.begin(), view.probes.end());
          if (n_nodes.empty())
            for (const taut::CustomBody &body : view.scene.bodies)
              n_nodes.push_back(body.type->surface({body.name, body.origin, view.scene.gravity}, {})
                                    .points.size());
          std::vector<double> own;
          for (std::size_t b = 0; b < n_nodes.size(); ++b)
            for (unsigned int node = 0; node < n_nodes[b]; ++node)
            {
              const std::size_t k = view.structure.index_at_node(b, node);
              for (const taut::Coordinates &axis :
                   {taut::Coordinates{1., 0., 0.}, taut::Coordinates{0., 1., 0.},
                    taut::Coordinates{0., 0., 1.}})
              {
                own.push_back(0.);
                if (k == taut::Structure::elsewhere)
                  continue;
                const taut::LinearForm form = view.structure[k].node_displacement(node, axis);
                own.back() = form.dot(view.reference.displacement[k]) + form.dot(view.state.U[k]);
              }
            }
          view.structure.communicator().sum(own);
          result.displacement.insert(result.displacement.end(), own.begin(), own.end());
        });
    result.slack = lines_with("Slack:", session.log());
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

  void expect_same(const std::string &scene, const Overrides &overrides = {},
                   const bool goes_slack = false)
  {
    SCOPED_TRACE(scene);
    const taut::Communicator world(MPI_COMM_WORLD);
    const Record one = record(scene, overrides, taut::Communicator()),
                 many = record(scene, overrides, world);
    ASSERT_FALSE(one.displacement.empty());
    const double u = difference(one.displacement, many.displacement),
                 f = difference(one.force, many.force), p = difference(one.probes, many.probes);
    EXPECT_LT(u, 1e-9);
    EXPECT_LT(f, 1e-9);
    EXPECT_LT(p, 1e-9);
    EXPECT_EQ(one.slack, many.slack);
    EXPECT_EQ(!one.slack.empty(), goes_slack);
    const std::string where = scene + ", " + std::to_string(world.size()) + " ranks, ";
    figure(where + "displacement", u);
    figure(where + "force", f);
  }
} // namespace

// Claim: nonlinear cables hang and move on any number of ranks as on one: all displacements, forces
// and probes to 1e-9 of the largest. Expected: the run of one process. Guys that go slack, a net, a
// cable that meets a mass, one that lies on a floor, two that ropes join which turn.
TEST(Ranks, cables_are_the_same)
{
  expect_same("swinging_load_on_guys", {"Time/End=1.4"}, true);
  expect_same("net_of_cables");
  expect_same("pendulum_cable", {"Time/End=0.5"});
  expect_same("cable_on_floor", {"Time/End=0.3"});
  expect_same("cable_in_wind");
  expect_same("line_with_droppers", {"Time/End=0.5"});
}
