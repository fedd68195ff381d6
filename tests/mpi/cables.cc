// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: nonlinear cables move on any number of ranks as on one. Source: the run of one process.
#include "nodes.h"

using namespace verification;

namespace
{
  std::string lines_with(const std::string &word, const std::string &log)
  {
    std::istringstream lines(log);
    std::string line, result;
    while (std::getline(lines, line))
      if (line.find(word) != std::string::npos)
        result += line + '\n';
    return result;
  }

  void expect_same(const std::string &scene, const Overrides &overrides = {},
                   const bool goes_slack = false)
  {
    SCOPED_TRACE(scene);
    const NodeRecord one = record_nodes(scene, overrides, taut::Communicator()),
                     many = record_nodes(scene, overrides, taut::Communicator(MPI_COMM_WORLD));
    ASSERT_FALSE(one.displacement.empty());
    const std::string where = scene + ", " + ranks_and_comma();
    EXPECT_LT(
        figure(where + "displacement", relative_difference(one.displacement, many.displacement)),
        1e-9);
    EXPECT_LT(figure(where + "force", relative_difference(one.force, many.force)), 1e-9);
    // Probes count from an equilibrium, and may be a small part of the displacements.
    EXPECT_LT(largest_difference(one.probes, many.probes), 1e-9 * largest(one.displacement));
    const std::string matrix_free = "Solver/Interface operator=matrix-free";
    EXPECT_EQ(many.is_distributed,
              taut::Communicator(MPI_COMM_WORLD).size() > 1 &&
                  std::find(overrides.begin(), overrides.end(), matrix_free) != overrides.end());
    const std::string slack = lines_with("Slack:", one.log);
    EXPECT_EQ(slack, lines_with("Slack:", many.log));
    EXPECT_EQ(!slack.empty(), goes_slack);
  }
} // namespace

// Claim: nonlinear cables hang and move on any number of ranks as on one: all displacements, forces
// and probes to 1e-9 of the largest. Expected: the run of one process. Guys that go slack, a net, a
// cable that meets a mass, one that lies on a floor, two that ropes join which turn; with joints on
// the ranks of their bodies, too, beside droppers that turn, or keep their directions where all
// cables are linearised.
TEST(Ranks, cables_are_the_same)
{
  expect_same("swinging_load_on_guys", {"Time/End=1.4"}, true);
  expect_same("net_of_cables");
  expect_same("pendulum_cable", {"Time/End=0.5"});
  expect_same("cable_on_floor", {"Time/End=0.3"});
  for (const char *const scene : {"net_of_cables", "pendulum_cable"})
    expect_same(scene, {"Time/End=0.3", "Solver/Interface operator=matrix-free"});
  const Overrides line = {"Time/End=0.05",
                          "Statistics/Window=", "Solver/Interface operator=matrix-free"};
  expect_same("line_of_cables_with_weights", line);
  expect_same("line_of_cables_with_weights",
              line + Overrides{"Body messenger 1/Geometry=linearised",
                               "Body messenger 2/Geometry=linearised",
                               "Body messenger 3/Geometry=linearised",
                               "Body contact wire/Geometry=linearised"});
  expect_same("cable_in_wind");
  expect_same("line_with_droppers", {"Time/End=0.25"}); // later catches amplify rounding
  expect_same("line_with_droppers",
              {"Time/End=0.25", "Body messenger/Geometry=linearised",
               "Body contact wire/Geometry=linearised", "Network/Load lift/Magnitude=200*(t<=0)"});
}
