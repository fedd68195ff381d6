// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: bodies that overlap at the start are brought apart up to half of the thickness of the
// thinner one; what enters a face between its nodes, and inputs that contradict themselves, are
// said. Source: bars of one strain; complementarity problems of other programs on the same meshes;
// the same scene on fine meshes.
#include "solid/limits_run.h"
#include "solid/mesh_file.h"

using namespace solid_limits;

namespace
{
  /// Force along y.
  double upwards(const Ran &ran)
  {
    double force = 0.;
    for (std::size_t i = 0; i < ran.forces.size(); ++i)
      force -= ran.forces[i] * ran.constraints[i].normal.y;
    return force;
  }

  double sum(const std::vector<double> &values)
  {
    return std::accumulate(values.begin(), values.end(), 0.);
  }

  std::string solid(const std::string &name, const std::string &mesh, const std::string &more)
  {
    return "Body " + name +
           ": Type = solid; Young's modulus = 1e8; Poisson's ratio = 0.3; Density = 1; " + more +
           "\nBody " + name + "/Mesh: " + mesh + "\n";
  }

  /// A grid of n x m cells from x = 0 to @p width between two graphs; boundaries 10 to 13 are left,
  /// right, lower, upper.
  template <typename Lower, typename Upper>
  std::unique_ptr<verification::MeshFile> strip(const std::size_t n, const std::size_t m,
                                                const double from, const double width,
                                                const Lower &lower, const Upper &upper)
  {
    auto mesh = std::make_unique<verification::MeshFile>();
    for (std::size_t j = 0; j <= m; ++j)
      for (std::size_t i = 0; i <= n; ++i)
      {
        const double x = from + width * i / n, y = lower(x);
        mesh->add_node(x, y + (upper(x) - y) * j / m);
      }
    const auto node = [n](const std::size_t i, const std::size_t j) { return 1 + i + (n + 1) * j; };
    for (std::size_t j = 0; j < m; ++j)
    {
      mesh->add(mesh->line, 10, {node(0, j), node(0, j + 1)});
      mesh->add(mesh->line, 11, {node(n, j), node(n, j + 1)});
    }
    for (std::size_t i = 0; i < n; ++i)
    {
      mesh->add(mesh->line, 12, {node(i, 0), node(i + 1, 0)});
      mesh->add(mesh->line, 13, {node(i, m), node(i + 1, m)});
    }
    for (std::size_t j = 0; j < m; ++j)
      for (std::size_t i = 0; i < n; ++i)
        mesh->add(mesh->quadrilateral, 0,
                  {node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)});
    return mesh;
  }

  /// Two blocks of 0.5 m that overlap by so much, in the plane or in space, with fixed far ends.
  Ran blocks(const unsigned int dim, const double overlap, const std::string &method,
             const bool whole)
  {
    const std::string n = dim == 2 ? "8, 16" : "8, 6, 8", a = dim == 2 ? "" : ", 0",
                      b = dim == 2 ? "" : ", 1", space = dim == 2 ? "" : "Dimension = 3; ";
    const auto block = [&](const std::string &name, const double y, const std::string &fixed)
    {
      return box(name,
                 n + " : 0, " + verification::number(y) + a + " : 1, " +
                     verification::number(y + .5) + b,
                 space + "Fixed boundaries = " + fixed);
    };
    return run(scene(
        "equilibrium", block("lower", -.5, "2") + block("upper", -overlap, "3"),
        contact(whole ? "upper" : "upper: 2", whole ? "lower" : "lower: 3", "Method = " + method) +
            at_rest));
  }

  bool warns(const Ran &ran)
  {
    return has(ran.log, "forces act at nodes of the slave");
  }
} // namespace

// Expected: 2.5068e6 N by a complementarity problem of another program on this mesh, with gaps
// along the normals of the slave; the ends of its contact are inclined by 0.2. With gaps along y it
// is 2.5003e6 N. The overlap of 40 mm is deeper than the elements of 25 mm.
TEST(SolidOverlaps, interference_deeper_than_an_element)
{
  const auto upper = strip(
      40, 10, -.5, 1., [](const double x) { return .5 * x * x - .04; }, [](double) { return .4; });
  const Ran found =
      run(scene("equilibrium",
                solid("lo", "Arguments = 40, 10 : -0.5, -0.4 : 0.5, 0", "Fixed boundaries = 2") +
                    solid("up", "File = " + upper->path(), "Fixed boundaries = 13"),
                contact("up: 12", "lo: 3") + at_rest));
  ASSERT_EQ(found.error, "");
  verification::figure("interference deeper than an element, force", upwards(found), "N");
  EXPECT_NEAR(upwards(found), 2.5068e6, 5e2);
}

// Expected: without lateral contraction, E times overlap over the length of both. Elements are of
// 31 mm along the overlap of 150 mm.
TEST(SolidOverlaps, blocks_of_half_a_metre_are_brought_apart)
{
  for (const unsigned int dim : {2u, 3u})
    for (const std::string method : {"mortar", "nodes to faces"})
      for (const bool whole : {false, true})
      {
        if (dim == 3 && method == "mortar")
          continue;
        const Ran found = blocks(dim, .15, method, whole);
        ASSERT_EQ(found.error, "") << dim << method << whole;
        EXPECT_NEAR(sum(found.forces), 1e9 * .15 / 1., 1e-3) << dim << method << whole;
        const std::string deep = blocks(dim, .3, method, whole).error;
        EXPECT_TRUE(has(deep, "they overlap by 0.3 m")) << deep;
        EXPECT_TRUE(has(deep, "half of the thickness of the thinner body there, 0.5 m")) << deep;
      }
}

// Expected: 57.9 N by another program, with the cable on the block. It starts 0.14 m inside.
TEST(SolidOverlaps, cable_laid_on_block)
{
  const Ran found = run(
      R"(Generator = network; Gravity = 0, -9.81; Start = equilibrium
Body c: Type = cable; From = -4, 1.5; To = 4, 1.5; Axial stiffness = 1e6; Mass per length = 3;
  Elements = 64; Unstressed length = 8.9; Element = bar
Body s: Type = solid; Young's modulus = 1e7; Poisson's ratio = 0.3; Density = 0;
  Fixed boundaries = 2
Body s/Mesh: Arguments = 12, 3 : -1, -0.5 : 1, 0
Contact f: Slave = s: 3; Master = c
Time: End = 0
)");
  ASSERT_EQ(found.error, "");
  EXPECT_NEAR(sum(found.forces), 57.9, .1);
}

// Expected: with elements of 1/8 m a warning with the depth of 20 mm, and an element that has none
// and carries the force of elements of 1/64 m to 3 %.
TEST(SolidOverlaps, cylinder_between_nodes)
{
  const auto pressed = [](const std::string &n)
  {
    return run(
        scene("equilibrium",
              solid("b", "Arguments = " + n + " : 0, 0 : 1, 1", "Displacement = 3: 0, -0.02"),
              "Contact c: Slave = b: 2; Obstacle = cylinder; Point = 0.45, -0.05; "
              "Direction = 0, 0, 1; Radius = 0.05\n" +
                  at_rest));
  };
  const Ran coarse = pressed("8, 8"), fine = pressed("64, 64");
  ASSERT_EQ(coarse.error, "");
  EXPECT_TRUE(warns(coarse)) << coarse.log;
  EXPECT_TRUE(has(coarse.log, "where the obstacle enters by 0.01")) << coarse.log;
  EXPECT_FALSE(warns(fine)) << fine.log;
  EXPECT_NEAR(upwards(fine), 7.2e5, .02 * 7.2e5);
}

// Expected: as above; 1.9e5 N by elements of 1/32 m.
TEST(SolidOverlaps, bump_between_nodes)
{
  const auto bump = [](const double x)
  { return .05 * std::exp(-std::pow((x - .45) / .06, 2)) - .05; };
  const auto lower = strip(
      64, 8, 0., 1., [](double) { return -.55; }, bump);
  for (const std::string n : {"8, 4", "32, 16", "64, 32"})
  {
    const Ran found = run(scene(
        "equilibrium",
        solid("lo", "File = " + lower->path(), "Fixed boundaries = 12") +
            solid("up", "Arguments = " + n + " : 0, 0 : 1, 0.6", "Displacement = 3: 0, -0.01"),
        contact("up: 2", "lo: 13") + at_rest));
    ASSERT_EQ(found.error, "");
    EXPECT_EQ(warns(found), n != "64, 32") << found.log;
    EXPECT_EQ(has(found.log, "elements of at most 0.01575 m there, or exchange"), n == "8, 4");
    if (n != "8, 4")
    {
      EXPECT_NEAR(upwards(found), 1.9e5, .1 * 1.9e5);
    }
  }
}

// A ball of 0.1 m below the middle of a face of 0.5 m in space, and a ridge along the face.
TEST(SolidOverlaps, obstacles_between_nodes_in_space)
{
  for (const std::string obstacle :
       {"sphere; Point = 0.3, 0.2, -0.1; Radius = 0.1",
        "height; Direction = 0, 0, 1; Height = -abs(x - 0.25)", "plane; Direction = 0, 0, 1"})
  {
    const Ran found =
        run(scene("equilibrium",
                  solid("b", "Arguments = 2, 2, 2 : 0, 0, 0 : 1, 1, 1",
                        "Dimension = 3; Displacement = 5: 0, 0, -0.01"),
                  "Contact c: Slave = b: 4; Obstacle = " + obstacle + "\n" + at_rest));
    ASSERT_EQ(found.error, "");
    EXPECT_EQ(warns(found), obstacle[0] != 'p') << found.log;
  }
}

// A master inside of one face of the slave, in space.
TEST(SolidOverlaps, small_master)
{
  const auto error = [](const std::string &from, const std::string &to)
  {
    return run(scene("equilibrium",
                     box("lo", "8, 4, 8 : " + from + " : " + to,
                         "Dimension = 3; Fixed boundaries = 2") +
                         box("up", "2, 2, 2 : 0, 0, 0 : 1, 0.6, 1",
                             "Dimension = 3; Displacement = 3: 0, -0.01, 0"),
                     contact("up: 2", "lo: 3", "Method = nodes to faces") + at_rest))
        .error;
  };
  EXPECT_TRUE(has(error("0.1, -0.4, 0.1", "0.4, 0, 0.4"), "Exchange Slave and Master"));
  EXPECT_TRUE(has(error("2.1, -0.4, 0.1", "2.4, 0, 0.4"), "no face of the first"));
}

// Two boundaries that move differently at their common corner, at rest or later; x and y as one
// formula, and a corner at rest, do not.
TEST(SolidOverlaps, conflicting_displacements)
{
  const auto error = [](const std::string &conditions)
  { return run(scene("equilibrium", box("b", "4, 4 : 0, 0 : 1, 1", conditions), at_rest)).error; };
  const std::string first = error("Displacement = 2: 0.01, 0; 0: 0, 0");
  EXPECT_TRUE(has(first, "Body b/Displacement")) << first;
  EXPECT_TRUE(has(first, "at (0, 0, 0) boundary 0 moves by 0 m along x, and boundary 2 by 0.01 m"))
      << first;
  EXPECT_TRUE(has(error("Fixed boundaries = 0; Displacement = 3: 0, -1e-3"), "boundary 3"));
  EXPECT_TRUE(has(error("Symmetry boundaries = 2; Displacement = 1: 0, 1e-3*t"), "boundary 2"));
  EXPECT_EQ(error("Displacement = 2: 1e-3*x, 1e-3*y; 0: 1e-3*x, 1e-3*y"), "");
  EXPECT_EQ(error("Fixed boundaries = 0, 1; Displacement = 3: 0, -1e-3*sin(pi*x)"), "");
}

// A quadrilateral again, and a hexahedron with its corners in another order.
TEST(SolidOverlaps, cell_given_twice)
{
  verification::MeshFile square, cube;
  for (const auto &[x, y] : {std::pair{0., 0.}, {1., 0.}, {2., 0.}, {0., 1.}, {1., 1.}, {2., 1.}})
    square.add_node(x, y);
  square.add(square.quadrilateral, 1, {1, 2, 5, 4});
  square.add(square.quadrilateral, 1, {2, 3, 6, 5});
  const std::string once = square.path();
  EXPECT_EQ(run(scene("given", body("b", "File = " + once), at_rest)).error, "");
  square.add(square.quadrilateral, 2, {3, 6, 5, 2});
  for (const double z : {0., 1.})
    for (const auto &[x, y] : {std::pair{0., 0.}, {1., 0.}, {1., 1.}, {0., 1.}})
      cube.add_node(x, y, z);
  cube.add(cube.hexahedron, 1, {1, 2, 3, 4, 5, 6, 7, 8});
  cube.add(cube.hexahedron, 1, {2, 3, 4, 1, 6, 7, 8, 5});
  for (const auto &[file, more] : {std::pair{square.path(), ""}, {cube.path(), "Dimension = 3"}})
  {
    const std::string error = run(scene("given", body("b", "File = " + file, more), at_rest)).error;
    EXPECT_TRUE(has(error, "Body b/Mesh/File")) << error;
    EXPECT_TRUE(has(error, "is given twice")) << error;
  }
}

// A slave that is 1e-5 of a face longer than its master carries a uniform pressure without a
// warning, in the plane and in space; at a hundredth of a face there is one.
TEST(SolidOverlaps, an_overhang_of_rounding_is_none)
{
  for (const unsigned int dim : {2u, 3u})
    for (const double part : {1e-5, 1e-2})
    {
      const std::string z = dim == 2 ? "" : ", 0", depth = dim == 2 ? "" : ", 1",
                        n = dim == 2 ? "" : ", 2", space = dim == 2 ? "" : "Dimension = 3; ",
                        method = dim == 2 ? "mortar" : "nodes to faces";
      const Ran found =
          run(scene("equilibrium",
                    box("lower", "2, 2" + n + " : 0, -1" + z + " : 1, 0" + depth,
                        space + "Fixed boundaries = 2") +
                        box("upper",
                            "2, 2" + n + " : 0, 0" + z + " : " +
                                verification::number(1. + .5 * part) + ", 1" + depth,
                            space + "Displacement = 3: 0, -1e-3" + (dim == 2 ? "" : ", 0")),
                    contact("upper: 2", "lower: 3", "Method = " + method) + at_rest));
      ASSERT_EQ(found.error, "");
      EXPECT_EQ(has(found.log, "overhangs"), part > 1e-4) << found.log;
      if (part < 1e-4)
      {
        EXPECT_NEAR(sum(found.forces), 1e9 * 1e-3 / 2., 50.);
      }
    }
}
