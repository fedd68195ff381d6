// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: contacts start as they touch, and solids and contacts that leave what the equations hold
// for are warned of and end. Source: given displacements, places and circles of the scenes, by
// hand; the same scene without rounding, or by other entries.
#include "solid/limits_run.h"
#include "solid/mesh_file.h"

using namespace solid_limits;

// Claim: a gap that starts at -5.6e-17 m, 0.3 less 0.1 + 0.2, is one of 0 m, without a force of its
// own in steps of 10 us. Expected: the forces from a gap of 0 m.
TEST(SolidLimits, a_gap_that_rounds_starts_closed)
{
  const Ran rounded = run(stack("0.30000000000000004", "0.3")), exact = run(stack("0.3", "0.3"));
  ASSERT_EQ(rounded.error, "");
  ASSERT_EQ(exact.error, "");
  ASSERT_EQ(rounded.peaks.size(), exact.peaks.size());
  const double largest = verification::largest(exact.peaks);
  EXPECT_GT(largest, 1e3);
  EXPECT_LT(verification::largest_difference(exact.peaks, rounded.peaks), 1e-9 * largest);
  const std::string deep = run(stack("0.3000001", "0.3")).error;
  EXPECT_TRUE(has(deep, "starts with a gap of -1e-07 m")) << deep;
}

// Claim: a block whose weight its traction carries rests on what it touches. Expected: no force, as
// the sum of the loads is 0.
TEST(SolidLimits, balanced_block)
{
  const std::string elastic = "Type = solid; Young's modulus = 1e8; Poisson's ratio = 0.3; "
                              "Density = 1000; ",
                    cells = "/Mesh: Generator = subdivided_hyper_rectangle; Arguments = ",
                    plane = "Contact c: Slave = b: 2; Obstacle = plane\n";
  const Ran block = run("Generator = network; Gravity = 0, -9.81\nBody b: " + elastic +
                        "Symmetry boundaries = 0; Traction = 3: 0, 9810\nBody b" + cells +
                        "6, 4 : 0, 0 : 1, 1\n" + plane + at_rest);
  EXPECT_EQ(block.error, "");
  for (const double force : block.forces)
    EXPECT_LT(std::fabs(force), 1e-8 * 9810.);

  // Two blocks, the upper one held up by its traction; the lower one stands on the floor, stretched
  // by the load at its top that carries a third of it.
  const Ran stacked =
      run("Generator = network; Gravity = 0, -9.81\nBody b: " + elastic +
          "Symmetry boundaries = 0; Traction = 3: 0, 3270\nBody b" + cells +
          "5, 3 : 0, 0 : 1, 1\nBody u: " + elastic +
          "Symmetry boundaries = 0; Traction = 3: 0, 4905\nBody u" + cells +
          "7, 2 : 0, 1 : 1, 1.5\n" + plane + "Contact d: Slave = u: 2; Master = b: 3\n" + at_rest);
  EXPECT_EQ(stacked.error, "");
  double sums[2] = {0., 0.};
  for (std::size_t i = 0; i < stacked.forces.size(); ++i)
    sums[i < 6 ? 0 : 1] += stacked.forces[i];
  EXPECT_NEAR(sums[0], 9810. - 3270., 1e-6 * 9810.);
  EXPECT_NEAR(sums[1], 0., 1e-6 * 9810.);
}

// Claim: two whole discs, and balls, meet by nodes on faces. Expected: of each node the distance to
// the other circle, but for its facets, and the normal of the circle but for half of their angle.
TEST(SolidLimits, whole_discs_and_balls_take_nodes_to_faces)
{
  for (const bool is_ball : {false, true})
  {
    const std::string cells = "Generator = hyper_ball; Refinements = 2; Arguments =",
                      dim = is_ball ? "Dimension = 3" : "", z = is_ball ? ", 0" : "";
    const Ran found =
        run(scene("given",
                  body("lower", cells + "0, 0" + z + " : 1", dim + "; Displacement = 0: 0, 0" + z) +
                      body("upper", cells + "0, 2" + z + " : 1", dim),
                  contact("upper", "lower", "Method = nodes to faces") + at_rest));
    ASSERT_EQ(found.error, "");
    ASSERT_GE(found.constraints.size(), 5u);
    const double facet = 2. * M_PI / 16., sagitta = 1. - std::cos(.5 * facet);
    for (const taut::SurfaceConstraint &c : found.constraints)
    {
      const double r = norm(c.point);
      EXPECT_GT(c.area, 0.);
      EXPECT_GE(c.gap, r - 1. - 1e-12);
      EXPECT_LE(c.gap, r - 1. + 2. * sagitta);
      EXPECT_GT(-dot(c.normal, c.point) / r, std::cos(facet));
    }
  }
}

// Claim: a ball joint at a solid in the plane is joints along x and y, and holds the cable in that
// plane. Expected: the forces of the two joints, and none across.
TEST(SolidLimits, a_ball_joint_holds_a_cable_to_a_solid_in_the_plane)
{
  const auto text = [](const std::string &links)
  {
    return scene("equilibrium",
                 box("block", "2, 2 : 0, 0 : 1, 1", "Fixed boundaries = 0") +
                     "\nBody rope: Type = cable; From = 1, 1; To = 4, 1; Unstressed length = 3.2; "
                     "Axial stiffness = 1e5; Mass per length = 1; Elements = 8; Held ends = to\n",
                 links + "\n" + at_rest);
  };
  const std::string ends = "From = block @ 1, 1; To = rope @ 0, 0";
  const Overrides gravity = {"Gravity=0, -9.81"};
  const Ran ball = run(text("Link pin: Type = ball joint; " + ends), gravity);
  const Ran joints = run(
      text("Link a: Direction = 1, 0; " + ends + "\nLink b: Direction = 0, 1; " + ends), gravity);
  ASSERT_EQ(ball.error, "");
  ASSERT_EQ(joints.error, "");
  ASSERT_EQ(ball.forces.size(), 3u);
  ASSERT_EQ(joints.forces.size(), 2u);
  EXPECT_GT(std::fabs(joints.forces[0]), 10.);
  for (unsigned int d = 0; d < 2; ++d)
    EXPECT_NEAR(ball.forces[d], joints.forces[d], 1e-9 * std::fabs(joints.forces[0]));
  EXPECT_NEAR(ball.forces[2], 0., 1e-9);
}

// Claim: a block that its boundary turns by a rad is warned of from 0.1 rad on, and ends from 0.5
// on unless that is allowed. Expected: the angle of the given displacement.
TEST(SolidLimits, a_block_that_turns_far_is_refused)
{
  const auto turned = [](const std::string &a, const Overrides &more = {})
  {
    return run(scene("equilibrium",
                     box("block", "3, 3 : 0, 0 : 1, 1",
                         "Displacement = 0: -y*" + a + ", x*" + a + "; 1: -y*" + a + ", x*" + a),
                     at_rest),
               more);
  };
  EXPECT_FALSE(has(turned("0.099").log, "Warning"));
  EXPECT_TRUE(
      has(turned("0.101").log, "Warning: a line on the boundary of 'block' turns by 0.101 rad"));
  EXPECT_EQ(turned("0.499").error, "");
  const Ran far = turned("0.501");
  EXPECT_TRUE(has(far.error, "Body block/Largest turn")) << far.error;
  EXPECT_TRUE(has(far.error, "turns by 0.501 rad")) << far.error;
  EXPECT_EQ(turned("0.501", {"Body block/Largest turn=1"}).error, "");
}

// Claim: a block that slides on another is warned of from half of an element on, and ends from two
// on. Expected: elements of 0.25 m, the sides held at a given motion.
TEST(SolidLimits, a_block_that_slides_far_is_refused)
{
  const auto moved = [](const std::string &by, const Overrides &more = {})
  {
    return run(
        scene("equilibrium",
              box("lower", "8, 2 : 0, 0 : 2, 0.5", "Fixed boundaries = 2") +
                  box("upper", "2, 2 : 0.5, 0.5 : 1, 1", "Displacement = 3: " + by + ", -1e-4"),
              contact("upper: 2", "lower: 3") + at_rest),
        more);
  };
  EXPECT_FALSE(has(moved("0.12").log, "Warning"));
  EXPECT_TRUE(has(moved("0.13").log, "Warning: contact 'pair' slides by 0.52 of its elements, "
                                     "0.13 m"))
      << moved("0.13").log;
  EXPECT_EQ(moved("0.49").error, "");
  const Ran far = moved("0.51");
  EXPECT_TRUE(has(far.error, "Contact pair/Largest sliding")) << far.error;
  EXPECT_EQ(moved("0.51", {"Contact pair/Largest sliding=3"}).error, "");
}

// Claim: a slave that overhangs, here of 1/3 m, is named, and the sides change places if asked.
TEST(SolidLimits, a_slave_that_overhangs_is_named)
{
  const auto pressed = [](const std::string &more)
  {
    return run(scene("equilibrium",
                     box("wide", "3, 3 : 0, 0 : 1, 0.3", "Fixed boundaries = 2") +
                         box("narrow", "2, 2 : 0, 0.3 : 0.5, 0.6", "Displacement = 3: 0, -1e-4"),
                     contact("wide: 3", "narrow: 2", more) + at_rest));
  };
  const Ran named = pressed("");
  EXPECT_TRUE(has(named.log, "Warning: contact 'pair' acts at")) << named.log;
  EXPECT_TRUE(has(named.log, "overhangs the master by 50 % of a face")) << named.log;
  EXPECT_TRUE(has(named.log, "Choose slave = true"));
  const Ran chosen = pressed("Choose slave = true");
  ASSERT_EQ(chosen.error, "");
  EXPECT_FALSE(has(chosen.log, "Warning")) << chosen.log;
  EXPECT_EQ(chosen.forces.size(), 3u); // the nodes of the narrow one
  EXPECT_TRUE(has(pressed("Choose slave = true; Method = nodes to faces").error,
                  "Contact pair/Choose slave"));
}

// Claim: the pressure of a punch under 1 MPa is that of either side as the slave but for the nodes
// of one that overhangs. Expected: the largest pressure, that of the corner, within 30 % of the one
// of another mesh without overhang; with it three times as much.
TEST(SolidLimits, the_slave_that_ends_first_has_smooth_pressures)
{
  const auto largest_pressure = [](const std::string &cells, const std::string &chooses)
  {
    const Ran found =
        run(scene("equilibrium",
                  box("wide", cells + " : 0, 0 : 1, 0.3", "Fixed boundaries = 2") +
                      box("narrow", "8, 4 : 0.1, 0.3 : 0.55, 0.6",
                          "Traction = 3: 0, -1e6; Displacement = 0: 0,"),
                  contact("wide: 3", "narrow: 2", "Choose slave = " + chooses) + at_rest));
    EXPECT_EQ(found.error, "");
    double largest = 0.;
    for (std::size_t i = 0; i < found.constraints.size(); ++i)
      largest = std::fmax(largest, found.forces[i] / found.constraints[i].area);
    return largest;
  };
  const double reference = largest_pressure("10, 3", "true");
  EXPECT_NEAR(largest_pressure("41, 12", "true"), reference, .3 * reference);
  EXPECT_GT(largest_pressure("41, 12", "false"), 3. * reference);
}

// Claim: nodes on faces are named if meshes do not match, in the log and in statistics.json.
TEST(SolidLimits, nodes_between_nodes_of_the_master_are_named)
{
  for (const char *const n : {"2", "3"})
  {
    const Ran found = run(
        scene("equilibrium",
              box("lower", "2, 2, 2 : 0, 0, 0 : 1, 1, 1", "Dimension = 3; Fixed boundaries = 4") +
                  box("upper", std::string(n) + ", 2, 2 : 0, 0, 1 : 1, 1, 2",
                      "Dimension = 3; Displacement = 5: 0, 0, -1e-4"),
              contact("upper: 4", "lower: 5", "Method = nodes to faces") +
                  "Time: Step = 0.1; End = 0.1\n"));
    ASSERT_EQ(found.error, "");
    const bool is_named = has(found.log, "between nodes of the master");
    EXPECT_EQ(is_named, n[0] == '3') << found.log;
    EXPECT_EQ(is_named,
              std::count(found.warnings.begin(), found.warnings.end(), "nodes_on_faces") == 1)
        << found.log;
  }
}

// Claim: nodes that an automatic search distance leaves out are counted, and named if they pass
// through the master. Expected: a node 3 m above a master of 1 m that moves by 2.9 or 3.2 m.
TEST(SolidLimits, nodes_beyond_the_search_distance_are_counted)
{
  verification::MeshFile mesh;
  for (const auto &[x, y] : {std::pair{0., .1}, {1., 3.}, {.5, 4.}, {-.5, 1.}})
    mesh.add_node(x, y);
  mesh.add(mesh.line, 5, {1, 2});
  mesh.add(mesh.quadrilateral, 1, {1, 2, 3, 4});
  for (const std::string by : {"2.9", "3.2"})
  {
    const Ran found = run(
        scene("equilibrium",
              box("lower", "2, 2 : 0, -1 : 1, 0", "Fixed boundaries = 2") +
                  body("slant", "File = " + mesh.path(),
                       "Largest turn = 100; Displacement = 5: 0, -x*" + by + "; 0: 0, -x*" + by),
              contact("slant: 5", "lower: 3", "Method = nodes to faces") + at_rest));
    EXPECT_EQ(found.error, "");
    EXPECT_TRUE(has(found.log, "search distance and take no part: 1;")) << found.log;
    EXPECT_EQ(has(found.log, "comes 3.2 m nearer to the master, 3 m away"), by == "3.2")
        << found.log;
  }
}

// Claim: a block that is strained by more than 5 % is warned of, in one piece and in parts, under
// compression and shear. Expected: the given strain, and half of the given angle of shear.
TEST(SolidLimits, strains_that_are_not_small_are_named)
{
  const auto warns = [](const Ran &found, const std::string &strain)
  {
    EXPECT_EQ(found.error, "");
    EXPECT_TRUE(has(found.log, "is strained by " + strain)) << found.log;
    EXPECT_EQ(std::count(found.warnings.begin(), found.warnings.end(), "strain"), 1);
  };
  const auto pressed = [](const std::string &by, const Overrides &more = {})
  {
    return run(scene("equilibrium",
                     box("block", "4, 4 : 0, 0 : 1, 1",
                         "Symmetry boundaries = 0, 2; Displacement = 3: , -" + by),
                     "Time: Step = 0.1; End = 0.1\n"),
               more);
  };
  EXPECT_FALSE(has(pressed("0.049").log, "Warning")) << pressed("0.049").log;
  for (const char *const parts : {"1", "4"})
    warns(pressed("0.051", {std::string("Partition/Number of substructures=") + parts}), "0.051");
  const auto sheared = [](const std::string &by)
  {
    std::string sides;
    for (int i = 0; i < 6; ++i)
      sides += std::to_string(i) + ": " + by + "*y, 0, 0; ";
    return run(
        scene("equilibrium",
              box("cube", "2, 3, 2 : 0, 0, 0 : 1, 2, 3",
                  "Dimension = 3; Degree = 2; Displacement = " + sides.substr(0, sides.size() - 2)),
              "Time: Step = 0.1; End = 0.1\n"));
  };
  EXPECT_FALSE(has(sheared("0.099").log, "strained"));
  warns(sheared("0.102"), "0.051");
}

// Claim: strains at corners of a rigid punch, where they have no bound, are no large strains of the
// block. Expected: more than 5 % at a corner, in the field, and silence.
TEST(SolidLimits, strains_at_corners_are_not_named)
{
  const Ran found = run(scene("equilibrium",
                              box("block", "40, 20 : 0, 0 : 2, 1",
                                  "Fixed boundaries = 2; Displacement = 1: , ; 3: , "
                                  "-0.01*(x<0.5001)"),
                              at_rest));
  EXPECT_EQ(found.error, "");
  EXPECT_FALSE(has(found.log, "strained")) << found.log;
}

namespace
{
  struct Bent
  {
    double tip = 0., locked = 0.; ///< deflection [m]; share that a warning names, 0: none
    std::string log;
  };

  /// A cantilever of 10 m x 1 m, or x 1 m x 1 m, under a load at its end. Its mesh has the ids of
  /// its ends from @p first_id on.
  Bent bend(const std::string &mesh, const bool in_space, const int first_id, const std::string &nu,
            const std::string &degree)
  {
    Bent result;
    verification::Session session(scene(
        "equilibrium",
        body("beam", mesh,
             "Fixed boundaries = " + std::to_string(first_id) + "; Poisson's ratio = " + nu +
                 "; Degree = " + degree + (in_space ? "; Dimension = 3" : "") + "; Traction = " +
                 std::to_string(first_id + 1) + (in_space ? ": 0, -1000, 0" : ": 0, -1000")),
        "Time: Step = 1e9; End = 1e9\nTime: Scheme = backward Euler\n"));
    session.run(
        [&](const taut::StepView &view)
        {
          taut::Attachment point{taut::Attachment::Kind::body, 0};
          point.place = {10., .5, in_space ? .5 : 0.};
          std::vector<taut::Term> terms;
          view.structure.motion(point, false, {0., -1.}, 1., terms);
          result.tip = verification::displacement(view, terms);
        });
    result.log = session.log();
    const nlohmann::json said = session.statistics();
    for (const auto &warning : said.at("warnings"))
      if (warning.at("kind") == "locking")
        result.locked = warning.at("value");
    return result;
  }

  Bent bend(const std::string &cells, const std::string &nu, const std::string &degree)
  {
    const bool in_space = std::count(cells.begin(), cells.end(), ',') == 2;
    return bend("Arguments = " + cells + (in_space ? " : 0, 0, 0 : 10, 1, 1" : " : 0, 0 : 10, 1"),
                in_space, 0, nu, degree);
  }

  /// Cells of the cantilever, each cut into two triangles or, if nz > 0, five tetrahedra.
  std::unique_ptr<verification::MeshFile> cut_cells(const std::size_t nx, const std::size_t ny,
                                                    const std::size_t nz)
  {
    auto mesh = std::make_unique<verification::MeshFile>();
    for (std::size_t k = 0; k <= nz; ++k)
      for (std::size_t j = 0; j <= ny; ++j)
        for (std::size_t i = 0; i <= nx; ++i)
          mesh->add_node(10. * i / nx, 1. * j / ny, nz > 0 ? 1. * k / nz : 0.);
    const auto node = [=](const std::size_t i, const std::size_t j, const std::size_t k)
    { return 1 + i + (nx + 1) * (j + (ny + 1) * k); };
    for (std::size_t k = 0; k < std::max<std::size_t>(nz, 1); ++k)
      for (std::size_t j = 0; j < ny; ++j)
        for (std::size_t i = 0; i < nx; ++i)
        {
          const auto corner = [&](const std::size_t c)
          { return node(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2)); };
          using Corners = std::vector<std::size_t>;
          const auto add = [&](const int type, const int id, const std::vector<Corners> &cells)
          {
            for (Corners cell : cells)
            {
              for (std::size_t &c : cell)
                c = corner(c);
              mesh->add(type, id, cell);
            }
          };
          // The cuts of neighbours meet.
          const bool odd = (i + j + k) % 2 == 1;
          if (nz == 0)
          {
            if (i == 0)
              add(mesh->line, 10, {{0, 2}});
            if (i + 1 == nx)
              add(mesh->line, 11, {{1, 3}});
            add(mesh->triangle, 0, {{0, 1, 2}, {1, 3, 2}});
            continue;
          }
          if (i == 0)
            add(mesh->triangle, 10,
                odd ? std::vector<Corners>{{0, 2, 6}, {0, 6, 4}}
                    : std::vector<Corners>{{0, 2, 4}, {2, 6, 4}});
          if (i + 1 == nx)
            add(mesh->triangle, 11,
                odd ? std::vector<Corners>{{1, 3, 5}, {3, 7, 5}}
                    : std::vector<Corners>{{1, 3, 7}, {1, 7, 5}});
          add(mesh->tetrahedron, 0,
              odd ? std::vector<Corners>{{1, 0, 3, 5},
                                         {0, 3, 2, 6},
                                         {0, 5, 4, 6},
                                         {3, 5, 6, 7},
                                         {0, 3, 5, 6}}
                  : std::vector<Corners>{
                        {0, 1, 2, 4}, {1, 2, 3, 7}, {1, 4, 5, 7}, {2, 4, 6, 7}, {1, 2, 4, 7}});
        }
    return mesh;
  }
} // namespace

// Claim: bilinear and trilinear elements that lock are named with how much too stiff they are, and
// those that do not are not. Expected: the deflection with elements of degree 2, over that with
// degree 1; four square elements through the thickness and nu = 0.3 are enough.
TEST(SolidLimits, elements_that_lock_are_named)
{
  struct Case
  {
    const char *cells, *nu;
    bool locks;
  };
  for (const Case &c : {Case{"20, 2", "0.499", true},
                        {"20, 2", "0.3", true},
                        {"30, 3", "0.3", true},
                        {"40, 4", "0.3", false},
                        {"40, 4", "0.46", true},
                        {"10, 4", "0.3", true},
                        {"20, 2, 2", "0.3", true},
                        {"10, 1, 1", "0", true},
                        {"80, 8", "0.3", false}})
  {
    const Bent linear = bend(c.cells, c.nu, "1"), quadratic = bend(c.cells, c.nu, "2");
    const std::string name = std::string(c.cells) + ", nu = " + c.nu;
    EXPECT_EQ(linear.locked > 0., c.locks) << name << linear.log;
    EXPECT_EQ(quadratic.locked, 0.) << name;
    if (!c.locks)
      continue;
    // Where it is several times too stiff, the estimate is a lower bound.
    const double too_stiff = quadratic.tip / linear.tip - 1.;
    EXPECT_LT(linear.locked, 1.2 * too_stiff) << name;
    EXPECT_GT(linear.locked, .8 * std::fmin(too_stiff, 1.)) << name;
    EXPECT_TRUE(has(linear.log, "Take Degree = 2")) << linear.log;
    verification::figure("too stiff, " + name + ", warned of, over that against degree 2",
                         linear.locked / too_stiff);
  }
}

// Claim: triangles and tetrahedra of degree 1 that lock are named with a lower bound of how much
// too stiff they are. Expected: the deflection with degree 2 on the same cells, over that with
// degree 1. The bound is sharp from six layers on.
TEST(SolidLimits, triangles_and_tetrahedra_that_lock_are_named)
{
  struct Case
  {
    std::size_t nx, ny, nz;
    const char *nu;
    bool locks;
  };
  for (const Case &c : {Case{20, 1, 0, "0.3", true},
                        {20, 2, 0, "0.3", true},
                        {20, 2, 0, "0.499", true},
                        {60, 6, 0, "0.3", true},
                        {60, 6, 0, "0.46", true},
                        {120, 12, 0, "0.3", false},
                        {10, 1, 1, "0", true},
                        {20, 2, 2, "0.3", true}})
  {
    const auto mesh = cut_cells(c.nx, c.ny, c.nz);
    const std::string file = "File = " + mesh->path();
    const Bent linear = bend(file, c.nz > 0, 10, c.nu, "1"),
               quadratic = bend(file, c.nz > 0, 10, c.nu, "2");
    const std::string name = std::to_string(c.ny) + " layers of " +
                             (c.nz > 0 ? "tetrahedra" : "triangles") + ", nu = " + c.nu;
    EXPECT_EQ(linear.locked > 0., c.locks) << name << linear.log;
    EXPECT_EQ(quadratic.locked, 0.) << name;
    if (!c.locks)
      continue;
    const double too_stiff = quadratic.tip / linear.tip - 1.;
    verification::figure("too stiff, " + name + ", warned of, over that against degree 2",
                         linear.locked / too_stiff);
    EXPECT_LT(linear.locked, too_stiff) << name;
    EXPECT_GT(linear.locked, (c.ny >= 6 ? .7 : .4) * std::fmin(too_stiff, 1.)) << name;
    EXPECT_TRUE(has(linear.log, "Take Degree = 2")) << linear.log;
  }
}

// Claim: what is pressed evenly does not lock, at any ratio. Expected: silence.
TEST(SolidLimits, a_block_that_is_pressed_evenly_does_not_lock)
{
  const Ran found = run(scene("equilibrium",
                              box("block", "3, 2 : 0, 0 : 1, 1",
                                  "Symmetry boundaries = 0, 2; Pressure = 3: 1e6; "
                                  "Poisson's ratio = 0.4999"),
                              at_rest));
  EXPECT_EQ(found.error, "");
  EXPECT_FALSE(has(found.log, "Warning")) << found.log;
}
