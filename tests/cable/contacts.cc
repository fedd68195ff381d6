// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: contacts of cables with obstacles are those of lines in space: the same wherever the scene
// is and however it is turned, on any side of the cable. Source: closed forms; the plane z = 0.
#include "cable/errors_of_runs.h"

#include "model/surface_constraints.h"

namespace
{
  using namespace verification;
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

  Touch touch(const Overrides &entries)
  {
    Touch result;
    const auto record = [&](const StepView &step)
    {
      result = Touch();
      for (const auto &row : contact_geometry(step.scene, 0).constraints)
      {
        const double N = step.state.multiplier[result.n_nodes++];
        result.force += N;
        result.area += N > 0. ? row.area : 0.;
        result.least_gap = std::min(result.least_gap, row.gap);
      }
    };
    run_scene(scene, entries, record);
    return result;
  }
} // namespace

TEST(CableContacts, a_sphere_beside_the_cable_is_not_touched)
{
  const Overrides below = {"Contact o/Obstacle=sphere", "Contact o/Radius=0.8",
                           "Contact o/Point=5, -1.5, 0", "Body cable/Geometry=linear"};
  EXPECT_GT(touch(below).force, 1.);
  const Touch none =
      touch(below + Overrides{"Body cable/From=0, 0, 100", "Body cable/To=10, 0, 100"});
  EXPECT_EQ(none.force, 0.);
  EXPECT_NEAR(none.least_gap, 100. - .8, .02);
}

TEST(CableContacts, the_scene_moves_along_z)
{
  const Overrides slope = {"Contact o/Direction=0, 0.8, 0.6"},
                  moved = {"Body cable/From=0, 0, -1", "Body cable/To=10, 0, -1",
                           "Contact o/Point=0, -0.5, -1"};
  const Touch here = touch(slope), there = touch(slope + moved);
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
    const auto error = [&](const Overrides &more)
    {
      return error_of(scene, more + Overrides{"Contact o/Obstacle=" + obstacle,
                                              obstacle == "cylinder" ? "Contact o/Direction=0, 0, 1"
                                                                     : "Contact o/Direction=0, 1",
                                              "Contact o/Point=5, -2", "Contact o/Radius=0.5",
                                              "Contact o/Height=-1.5 + 0.3*exp(-(x - 5)^2)"});
    };
    for (const std::string start : {"equilibrium", "undeformed", "given"})
      expect(error({"Start=" + start}), {refused, "Take a plane"});
    const std::string linearised = "Body cable/Geometry=linearised";
    expect(error({linearised}), {refused, "linearised with Start = undeformed"});
    EXPECT_EQ(error({linearised, "Start=undeformed"}), "") << obstacle;
    EXPECT_EQ(error({"Body cable/Geometry=linear"}), "") << obstacle;
  }
  EXPECT_EQ(error_of(scene, {"Start=undeformed", "Contact o/Point=0, -2"}), "");
}

/// The normals of mortar rows are those of the slave: of a sagging cable they differ. At rest
/// without the block the cable is 0.37 m inside it, less than half of its thickness.
TEST(CableContacts, large_motions_on_a_plane_side_of_a_solid)
{
  const std::string both =
      scene +
      "Body block: Type = solid; Young's modulus = 1e7; Density = 0; Fixed boundaries = 2\n"
      "Body block/Mesh: Generator = subdivided_hyper_rectangle; Arguments = 20, 1 : 1, -1.5 : 9, "
      "-0.5\n";
  const Overrides between = {"Bodies=cable, block", "Contact o/Obstacle=none"},
                  of_cable = {"Contact o/Slave=cable", "Contact o/Master=block: 3"},
                  of_block = {"Contact o/Slave=block: 3", "Contact o/Master=cable"};
  expect(error_of(both, between + of_cable),
         {"Contact o/Slave: a contact keeps", "whose normals differ", "plane side of a solid"});
  // As much as a rigid floor carries, but for the mean gaps of the mesh: two per cent.
  double force = 0.;
  run_scene(both, between + of_block,
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
  const std::string refusal = error_of(
      [&] {
        touch({"Contact o/Point=0, -50", "Contact o/Search distance=1"});
      });
  EXPECT_TRUE(has(refusal, "search distance of 1 m")) << refusal;
  EXPECT_FALSE(has(refusal, "boundary id")) << refusal;
}

TEST(CableContacts, the_force_acts_where_the_cable_lies)
{
  Session session(scene);
  session.run();
  const auto table = read_table(session.folder() + "/contact_o.csv");
  EXPECT_EQ(table.size(), 11u);
  EXPECT_GT(table.at("force y [N]").back(), 1.);
  EXPECT_NEAR(table.at("point x [m]").back(), 5., 1e-6);
  // On the floor; at rest without it the middle is lower.
  EXPECT_NEAR(table.at("point y [m]").back(), -.5, 1e-9);
}
