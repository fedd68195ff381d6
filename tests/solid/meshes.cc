// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: meshes of gmsh and of generators are what they say, and what is none ends in one error
// with file, entry and remedy. Expected values: two materials under tension; the stress beside a
// hole by R. C. J. Howland, Phil. Trans. R. Soc. A 229 (1930), and R. B. Heywood's formula for it.
#include "solid/mesh_file.h"
#include "verification/scene_tests.h"

#include <taut/scene/contact_surface.h>

namespace
{
  using namespace verification;
  std::string scene(const std::string &body, const std::string &mesh, const std::string &more = "")
  {
    return "Generator = network; Gravity = 0, 0; Start = equilibrium\nTime: End = 0\n"
           "Body plate: Type = solid; " +
           body + "\nBody plate/Mesh: " + mesh + "\n" + more;
  }

  std::string mesh_file(const std::string &name)
  {
    return std::string(TAUT_MESH_FOLDER) + "/" + name;
  }

  struct OneCell : MeshFile
  {
    explicit OneCell(const std::vector<std::array<double, 2>> &corners)
    {
      for (const auto &[x, y] : corners)
        add_node(x, y);
      add(line, 11, {1, 2});
      add(quadrilateral, 1, {1, 2, 3, 4});
    }
  };

  void expect_error(const std::string &text, const std::vector<std::string> &parts)
  {
    const std::string error = error_of([&] { Session(text).run(); });
    EXPECT_NE(error, "") << text;
    for (const std::string &part : parts)
      EXPECT_TRUE(has(error, part)) << part << " in " << error;
  }

  /// Points of the boundary and their displacements along x in the equilibrium.
  struct Sides
  {
    std::vector<taut::Coordinates> points;
    std::vector<double> u;
  };
  Sides sides_at_rest(const std::string &text)
  {
    Sides sides;
    run_scene(text, {},
              [&](const taut::StepView &view)
              {
                const taut::CustomBody &body = view.scene.bodies[0];
                sides.points =
                    body.type->surface({body.name, body.origin, view.scene.gravity}, {}).points;
                for (unsigned int i = 0; i < sides.points.size(); ++i)
                  sides.u.push_back(displacement(
                      view, {{0, view.structure[0].node_displacement(i, {1., 0., 0.})}}));
              });
    return sides;
  }

  const std::string one_material = "Young's modulus = 1e9; Fixed boundaries = 11",
                    two_materials = "Materials = 1: 1e9, 0, 0; 2: 3e9, 0, 0";

  /// At the top of a hole of radius 1 m in a plate of 80 m x 20 m under 1 MPa [MPa].
  double stress_beside_hole(const int local_refinements)
  {
    const Sides sides = sides_at_rest(scene("Young's modulus = 1e9; Degree = 2; Plane state = "
                                            "stress; Fixed boundaries = 0; Traction = 1: 1e6, 0",
                                            "Generator = plate_with_a_hole; Arguments = 1 : 2 : 8, "
                                            "8, 38, 38 : 0, 0; Local refinements = " +
                                                std::to_string(local_refinements) +
                                                "; Refine where = 1 + 4/2^t - sqrt(x^2 + y^2)"));
    // The stress along the free rim is E times its strain, from the nodes beside its top.
    std::pair<double, double> left = {-1., 0.}, right = {1., 0.}; // x and u
    for (std::size_t i = 0; i < sides.points.size(); ++i)
    {
      const taut::Coordinates &x = sides.points[i];
      if (x.y < 0. || std::fabs(std::hypot(x.x, x.y) - 1.) > 1e-6)
        continue;
      if (x.x < -1e-9)
        left = std::max(left, {x.x, sides.u[i]});
      if (x.x > 1e-9)
        right = std::min(right, {x.x, sides.u[i]});
    }
    return 1e9 * (right.second - left.second) / (right.first - left.first) / 1e6;
  }
} // namespace

// Half of the plate has a third of the compliance: u = p (1/E1 + 1/E2) at its end.
TEST(SolidMeshes, of_gmsh_have_boundaries_and_materials)
{
  for (const std::string name : {"quadrilaterals.msh", "triangles.msh"})
    for (const std::string degree : {"1", "2"})
    {
      const Sides sides =
          sides_at_rest(scene(two_materials + "; Degree = " + degree +
                                  "; Symmetry boundaries = 11, 13; Traction = 12: 1e6, 0",
                              "File = " + mesh_file(name)));
      unsigned int n_right = 0;
      for (std::size_t i = 0; i < sides.points.size(); ++i)
      {
        const double x = sides.points[i].x;
        n_right += x == 2.;
        EXPECT_NEAR(sides.u[i], x < 1. ? 1e-3 * x : 1e-3 + 1e-3 / 3. * (x - 1.), 1e-14) << name;
      }
      EXPECT_GE(n_right, 4u) << name;
    }
}

// A mesh is found relative to the parameter file, from whichever folder it is run.
TEST(SolidMeshes, files_are_relative_to_the_parameter_file)
{
  const Folder scratch;
  const fs::path &folder = scratch.path, file = folder / "scenes" / "plate.prm";
  fs::create_directories(folder / "scenes" / "meshes");
  fs::copy_file(mesh_file("quadrilaterals.msh"), folder / "scenes" / "meshes" / "plate.msh");
  std::ofstream(file) << SceneBuilder(scene(two_materials + "; Symmetry boundaries = 11, 13; "
                                                            "Traction = 12: 1e6, 0",
                                            "File = meshes/plate.msh"))
                             .text();
  const fs::path before = fs::current_path();
  for (const fs::path &from : {folder, folder / "scenes", fs::temp_directory_path()})
  {
    fs::current_path(from);
    const std::vector<double> u = sides_at_rest(fs::relative(file).string()).u;
    EXPECT_NEAR(largest(u), 1e-3 + 1e-3 / 3., 1e-14) << from;
  }
  fs::current_path(before);
}

TEST(SolidMeshes, that_are_none_end_in_one_error)
{
  const std::string file = "File =", good = file + mesh_file("quadrilaterals.msh");
  expect_error(scene(one_material, file + "/nowhere/plate.msh"),
               {"Body plate/Mesh/File", "cannot read the file '/nowhere/plate.msh'"});
  expect_error(scene(one_material + "; Dimension = 3", good),
               {"Body plate/Mesh/File", "no mesh of dimension 3"});
  expect_error(scene("Young's modulus = 1e9; Fixed boundaries = 21", good),
               {"Body plate/Fixed boundaries", "no boundary 21; it has 11 12 13 14"});
  const auto wrong_materials = [&](const std::string &materials, const std::string &part)
  {
    expect_error(scene("Materials = " + materials + "; Fixed boundaries = 11", good),
                 {"Body plate/Materials", part});
  };
  wrong_materials("1: 1e9, 0, 0; 3: 1e9, 0, 0",
                  "the mesh has cells of material 2, of which no material is given");
  wrong_materials("1: 1e9, 0, 0", "cells of material 2, of which no material is given");
  wrong_materials("77: 1e9, 0, 0", "cells of material 1, of which no material is given");
  wrong_materials("1: 1e9, 0, 0; 2: 1e9, 0, 0; 1: 2e9, 0, 0", "material 1 is given twice");
  wrong_materials("-1: 1e9, 0, 0", "does not begin with the number of an id");
  using Corners = std::vector<std::array<double, 2>>;
  for (const Corners &corners : {Corners{{0., 0.}, {1., 0.}, {2., 0.}, {3., 0.}},
                                 Corners{{0., 0.}, {1., 0.}, {0., 1.}, {1., 1.}},
                                 Corners{{0., 0.}, {1., 0.}, {.1, .1}, {0., 1.}}})
    expect_error(scene(one_material, file + OneCell(corners).path()), {"Body plate/Mesh/File"});
  // One that runs the other way round is turned.
  const OneCell clockwise({{0., 0.}, {0., 1.}, {1., 1.}, {1., 0.}});
  EXPECT_EQ(sides_at_rest(scene(one_material, file + clockwise.path())).points.size(), 4u);
}

TEST(SolidMeshes, of_plates_with_a_hole_are_checked)
{
  const std::string generator = "Generator = plate_with_a_hole; Arguments =";
  const auto wrong = [&](const std::string &arguments, const std::string &part) {
    expect_error(scene(one_material, generator + arguments), {"Body plate/Mesh/Arguments", part});
  };
  wrong("0 : 2 : 1, 1, 1, 1 : 0, 0", "the radius of the hole must be positive");
  wrong("2 : 1 : 1, 1, 1, 1 : 0, 0", "more than the radius of the hole");
  wrong("1 : 2 : 1, -1, 1, 1 : 0, 0", "must not be negative");
  wrong("1 : 2 : 1, 1, 1 : 0, 0", "takes 4 numbers");
  wrong("1 : 2 : 1, 1, 1, 1", "it lacks the centre");
  wrong("1e-6 : 2e-6 : 1, 1, 1, 1 : 0, 0", "more than 1e7 cells");
  wrong("1 : 2 : 1, 1, 1, 1 : 0, 0 : 1", "more than it takes");
}

// Hole over width 0.1: the largest stress is 3.03 times that of the plate far away, where it is 3
// in one without end. Heywood: (2 + (1 - d/W)^3) / (1 - d/W) = 3.032.
TEST(SolidMeshes, a_hole_concentrates_stress)
{
  const double heywood = (2. + std::pow(.9, 3)) / .9, coarse = stress_beside_hole(4),
               fine = stress_beside_hole(5);
  figure("stress beside a hole of 0.1 of the width, over that far away", fine);
  figure("the same with cells twice as large", coarse);
  EXPECT_NEAR(fine, heywood, 5e-3 * heywood);
  EXPECT_NEAR(fine, coarse, 1e-3);
}
