// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: contacts of cables with obstacles are those of lines in space: the same wherever the scene
// is and however it is turned, on any side of the cable. Expected values: closed forms, and the
// same scene in the plane z = 0.
#include "cable/errors_of_runs.h"
#include "verification/scene_tests.h"

#include <taut/model/surface_constraints.h>

#include <tuple>

using verification::has;

namespace
{
  using namespace taut;

  const std::string scene = R"(Generator = network; Gravity = 0, -9.81; Start = equilibrium
Body cable: Type = cable; From = 0, 0, 0; To = 10, 0, 0; Unstressed length = 10.2;
  Axial stiffness = 1e5; Mass per length = 1
Contact o: Slave = cable; Obstacle = plane; Point = 0, -0.5
Time: End = 0
)";

  struct Touch
  {
    double force = 0., area = 0., least_gap = 1e300;
    std::size_t n_nodes = 0;
  };

  Touch touch(const verification::Overrides &entries)
  {
    Touch result;
    verification::run_scene(scene, entries,
                            [&](const StepView &step)
                            {
                              const auto rows = contact_geometry(step.scene, 0).constraints;
                              result = Touch();
                              result.n_nodes = rows.size();
                              for (std::size_t i = 0; i < rows.size(); ++i)
                              {
                                const double N = step.state.multiplier[i];
                                result.force += N;
                                result.area += N > 0. ? rows[i].area : 0.;
                                result.least_gap = std::min(result.least_gap, rows[i].gap);
                              }
                            });
    return result;
  }
} // namespace

TEST(CableContacts, a_sphere_beside_the_cable_is_not_touched)
{
  const verification::Overrides below = {"Contact o/Obstacle=sphere", "Contact o/Radius=0.8",
                                         "Contact o/Point=5, -1.5, 0",
                                         "Body cable/Geometry=linear"};
  EXPECT_GT(touch(below).force, 1.);
  verification::Overrides far = below;
  far.insert(far.end(), {"Body cable/From=0, 0, 100", "Body cable/To=10, 0, 100"});
  const Touch none = touch(far);
  EXPECT_EQ(none.force, 0.);
  EXPECT_NEAR(none.least_gap, 100. - .8, .02);
}

TEST(CableContacts, the_scene_moves_along_z)
{
  const verification::Overrides slope = {"Contact o/Direction=0, 0.8, 0.6"};
  verification::Overrides moved = slope;
  moved.insert(moved.end(), {"Body cable/From=0, 0, -1", "Body cable/To=10, 0, -1",
                             "Contact o/Point=0, -0.5, -1"});
  const Touch here = touch(slope), there = touch(moved);
  EXPECT_GT(here.force, 1.);
  EXPECT_NEAR(there.force, here.force, 1e-6 * here.force);
  EXPECT_NEAR(there.area, here.area, 1e-9);
}

TEST(CableContacts, the_cable_turns_about_y)
{
  const Touch along_x = touch({});
  EXPECT_GT(along_x.force, 1.);
  for (const char *const to : {"0, 0, 10", "6, 0, 8"})
  {
    const Touch turned = touch({std::string("Body cable/To=") + to});
    EXPECT_NEAR(turned.force, along_x.force, 1e-6 * along_x.force) << to;
    EXPECT_NEAR(turned.area, along_x.area, 1e-9) << to;
  }
}

/// A ceiling and a wall beside the cable, and a floor without weight: whole lines, on any side.
TEST(CableContacts, any_side_of_the_cable)
{
  for (const auto &[point, direction, gap] :
       {std::tuple<const char *, const char *, double>{"0, 1", "0, -1", 1.},
        {"0, 0, 1", "0, 0, -1", 1.},
        {"0, 0, -2", "0, 0, 1", 2.}})
  {
    const Touch side = touch(
        {std::string("Contact o/Point=") + point, std::string("Contact o/Direction=") + direction});
    EXPECT_EQ(side.n_nodes, 17u) << direction;
    EXPECT_EQ(side.force, 0.) << direction;
    EXPECT_NEAR(side.least_gap, gap, 1e-9) << direction;
  }
  const Touch taut = touch({"Gravity=0, 0", "Body cable/Unstressed length=9.99"});
  EXPECT_EQ(taut.n_nodes, 17u);
  EXPECT_NEAR(taut.least_gap, .5, 1e-9);
}

/// Rows of a contact are tangent planes at the shape at rest, which large motions leave.
TEST(CableContacts, large_motions_are_on_planes_only)
{
  const std::string refused = "Contact o/Obstacle: a contact keeps the normals and distances";
  for (const std::string obstacle : {"sphere", "cylinder", "height"})
  {
    const verification::Overrides curved = {"Contact o/Obstacle=" + obstacle,
                                            obstacle == "cylinder" ? "Contact o/Direction=0, 0, 1"
                                                                   : "Contact o/Direction=0, 1",
                                            "Contact o/Point=5, -2", "Contact o/Radius=0.5",
                                            "Contact o/Height=-1.5 + 0.3*exp(-(x - 5)^2)"};
    const auto with = [&](verification::Overrides more)
    {
      more.insert(more.end(), curved.begin(), curved.end());
      return more;
    };
    for (const char *const start : {"equilibrium", "undeformed", "given"})
      expect(error_of(scene, with({std::string("Start=") + start})), {refused, "Take a plane"});
    const std::string linearised = "Body cable/Geometry=linearised";
    expect(error_of(scene, with({linearised})), {refused, "linearised with Start = undeformed"});
    EXPECT_EQ(error_of(scene, with({linearised, "Start=undeformed"})), "") << obstacle;
    EXPECT_EQ(error_of(scene, with({"Body cable/Geometry=linear"})), "") << obstacle;
  }
  EXPECT_EQ(error_of(scene, {"Start=undeformed", "Contact o/Point=0, -2"}), "");
}

/// The normals of mortar rows are those of the slave: of a sagging cable they differ.
TEST(CableContacts, large_motions_on_a_plane_side_of_a_solid)
{
  const std::string block =
      "Body block: Type = solid; Young's modulus = 1e7; Density = 0; Fixed boundaries = 2\n"
      "Body block/Mesh: Generator = subdivided_hyper_rectangle; Arguments = 20, 1 : 1, -1 : 9, "
      "-0.5\n";
  const verification::Overrides between = {"Bodies=cable, block", "Contact o/Obstacle=none"};
  const auto with = [&](verification::Overrides more)
  {
    more.insert(more.begin(), between.begin(), between.end());
    return more;
  };
  const verification::Overrides of_cable = {"Contact o/Slave=cable", "Contact o/Master=block: 3"},
                                of_block = {"Contact o/Slave=block: 3", "Contact o/Master=cable"};
  expect(error_of(scene + block, with(of_cable)),
         {"Contact o/Slave: a contact keeps", "whose normals differ", "plane side of a solid"});
  EXPECT_EQ(error_of(scene + block, with(of_block)), "");
  // As much as a rigid floor carries, but for the mean gaps of the mesh: two per cent.
  double force = 0.;
  verification::run_scene(scene + block, with(of_block),
                          [&](const StepView &step)
                          {
                            for (const double N : step.state.multiplier)
                              force += N;
                          });
  const double of_floor = touch({}).force;
  EXPECT_NEAR(force, of_floor, .02 * of_floor);
}

/// One held end or both are below the floor.
TEST(CableContacts, held_ends_inside_an_obstacle)
{
  expect(error_of(scene, {"Contact o/Point=0, -0.2", "Body cable/From=0, -0.4"}),
         {"Contact o: ", "no force satisfies link 'o node 0'", "ends are held"});
  expect(error_of(scene, {"Contact o/Point=0, 0.1"}),
         {"Contact o: ", "'o node 0', 'o node 16'", "what holds their ends"});
}

TEST(CableContacts, what_is_out_of_reach_is_named)
{
  const std::string refusal = verification::error_of(
      [&] {
        touch({"Contact o/Point=0, -50", "Contact o/Search distance=1"});
      });
  EXPECT_TRUE(has(refusal, "search distance of 1 m")) << refusal;
  EXPECT_FALSE(has(refusal, "boundary id")) << refusal;
}

TEST(CableContacts, the_force_acts_where_the_cable_lies)
{
  verification::Session session(scene);
  session.run();
  std::ifstream file(session.folder() + "/contact_o.csv");
  std::string line, last;
  while (std::getline(file, line))
    last = line;
  std::istringstream in(last);
  std::vector<double> numbers;
  for (std::string number; std::getline(in, number, ',');)
    numbers.push_back(std::stod(number));
  ASSERT_EQ(numbers.size(), 11u) << last;
  EXPECT_GT(numbers[2], 1.);
  EXPECT_NEAR(numbers[4], 5., 1e-6);
  EXPECT_NEAR(numbers[5], -.5, 1e-9); // on the floor; at rest without it the middle is lower
}
