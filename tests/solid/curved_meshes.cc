// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: meshes from files follow curves that entries name, and faces of degree 2 that do not are
// warned of. Source: the radius of a circle and the height of its chords.
#include "solid/limits_run.h"
#include "solid/mesh_file.h"

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>

using namespace solid_limits;

namespace
{
  using namespace verification;
  /// Straight cells from the origin on, moved: boundaries 10 and 11 are across x, and so on.
  template <int dim>
  MeshFile moved_cells(const std::vector<unsigned int> &n,
                       const std::function<dealii::Point<dim>(const dealii::Point<dim> &)> &place)
  {
    dealii::Triangulation<dim> cells;
    dealii::Point<dim> end;
    for (unsigned int d = 0; d < dim; ++d)
      end[d] = n[d];
    dealii::GridGenerator::subdivided_hyper_rectangle(cells, n, dealii::Point<dim>(), end, true);
    dealii::GridTools::transform(place, cells);
    return MeshFile(cells, 10);
  }

  /// A quarter of a ring between the radii 1 and 2: boundary 13 is its inner side, 12 the outer.
  MeshFile quarter_ring()
  {
    return moved_cells<2>({4, 2},
                          [](const dealii::Point<2> &p)
                          {
                            const double r = 2. - .5 * p[1], angle = M_PI / 8. * p[0];
                            return dealii::Point<2>(r * std::cos(angle), r * std::sin(angle));
                          });
  }

  /// A quarter of a ring of so many cells around and across: boundary 13 is its inner side, 12 the
  /// outer, 10 and 11 are y = 0 and x = 0.
  MeshFile quarter_ring_of(const unsigned int around, const unsigned int across, const double outer,
                           const double inner)
  {
    return moved_cells<2>({around, across},
                          [=](const dealii::Point<2> &p)
                          {
                            const double r = outer - (outer - inner) * p[1] / across,
                                         angle = .5 * M_PI / around * p[0];
                            return dealii::Point<2>(r * std::cos(angle), r * std::sin(angle));
                          });
  }

  /// A hollow shaft in a hub, radii 10, 20 and 30 mm of steel in plane stress, 2.5 um too thick.
  Ran press_fit(const unsigned int shaft, const unsigned int hub, const std::string &degree,
                const std::string &more = "")
  {
    const MeshFile in = quarter_ring_of(shaft, 6, .02, .01),
                   out = quarter_ring_of(hub, 6, .03, .02);
    const std::string steel = "Young's modulus = 2.1e11; Poisson's ratio = 0.3; "
                              "Plane state = stress; Symmetry boundaries = 10, 11; Degree = " +
                              degree,
                      curves = "; Curved boundaries = 12: circle, 0, 0; 13: circle, 0, 0";
    return run(scene("equilibrium",
                     body("shaft", "File = " + in.path() + curves, steel) +
                         body("hub", "File = " + out.path() + curves, steel),
                     contact("shaft: 12", "hub: 13", "Gap = -2.5e-6; " + more) + at_rest));
  }

  double mean_pressure(const Ran &found)
  {
    double force = 0., area = 0.;
    for (std::size_t i = 0; i < found.forces.size(); ++i)
    {
      force += found.forces[i];
      area += found.constraints[i].area;
    }
    return force / area;
  }

  /// Elements of gmsh in a square or cube of 3 x 3 or 3 x 3 x 3 nodes.
  struct Elements
  {
    std::string name;
    int type, dim;
    std::vector<int> nodes; ///< of one, counted from 1
  };

  const std::vector<Elements> higher_order = {
      {"line of 3 nodes", 8, 2, {1, 3, 2}},
      {"triangle of 6 nodes", 9, 2, {1, 3, 7, 2, 5, 4}},
      {"quadrilateral of 9 nodes", 10, 2, {1, 3, 9, 7, 2, 6, 8, 4, 5}},
      {"quadrilateral of 8 nodes", 16, 2, {1, 3, 9, 7, 2, 6, 8, 4}},
      {"tetrahedron of 10 nodes", 11, 3, {1, 3, 7, 19, 2, 5, 4, 10, 13, 11}},
      {"hexahedron of 20 nodes", 17, 3, {1,  3, 9,  7, 19, 21, 27, 25, 2,  4,
                                         10, 6, 12, 8, 18, 16, 20, 22, 24, 26}},
      {"hexahedron of 27 nodes", 12, 3, {1,  3,  9,  7,  19, 21, 27, 25, 2,  4,  10, 6,  12, 8,
                                         18, 16, 20, 22, 24, 26, 5,  11, 13, 15, 17, 23, 14}}};

  /// A file of one element in a format of gmsh.
  struct OneElement
  {
    const verification::Folder folder;
    const std::filesystem::path path = folder / "one.msh";

    OneElement(const Elements &e, const std::string &format)
    {
      const int n = e.dim == 3 ? 27 : 9, dim = e.type == 8 ? 1 : e.dim;
      std::ofstream file(path);
      file << "$MeshFormat\n" << format << " 0 8\n$EndMeshFormat\n";
      std::string numbers, places, lines;
      for (int i = 0; i < n; ++i)
      {
        const std::string number = std::to_string(i + 1);
        numbers += number + "\n";
        places += (format == "2.2" ? number + " " : "") + std::to_string(.5 * (i % 3)) + " " +
                  std::to_string(.5 * (i / 3 % 3)) + " " + std::to_string(.5 * (i / 9)) + "\n";
      }
      for (const int node : e.nodes)
        lines += " " + std::to_string(node);
      if (format == "2.2")
        file << "$Nodes\n"
             << n << '\n'
             << places << "$EndNodes\n$Elements\n1\n1 " << e.type << " 2 1 1" << lines;
      else
        file << "$Entities\n0 " << (dim == 1) << ' ' << (dim == 2) << ' ' << (dim == 3)
             << "\n1 0 0 0 1 1 1 1 1 0\n$EndEntities\n$Nodes\n1 " << n << " 1 " << n << '\n'
             << dim << " 1 0 " << n << '\n'
             << numbers << places << "$EndNodes\n$Elements\n1 1 1 1\n"
             << dim << " 1 " << e.type << " 1\n1" << lines;
      file << "\n$EndElements\n";
    }
    ~OneElement() { std::filesystem::remove(path); }
  };

  /// A block below y = sqrt(1 - x^2), x up to 0.6 m, of straight quadrilaterals, those below its
  /// top so wide [m]: boundary 10 is x = 0, 12 y = 0, 13 the top.
  MeshFile round_block(const double width = .04)
  {
    std::vector<double> x = {0.}, part = {1.};
    while (x.back() < .6 - 1e-9)
      x.push_back(x.back() < .2 - 1e-9 ? x.back() + width : x.back() + .05);
    for (double height = .04; part.back() > height; height = std::fmin(.1, 1.3 * height))
      part.push_back(part.back() - height);
    part.back() = 0.;
    std::reverse(part.begin(), part.end());
    return moved_cells<2>({unsigned(x.size() - 1), unsigned(part.size() - 1)},
                          [&](const dealii::Point<2> &p)
                          {
                            const double at = x[std::lround(p[0])];
                            return dealii::Point<2>(at, part[std::lround(p[1])] *
                                                            std::sqrt(1. - at * at));
                          });
  }

  /// Largest deviation of nodal pressures from Hertz', over the largest, in 0.8 of the half-width.
  double deviation_from_hertz(const Ran &found)
  {
    const double force = 2. * std::accumulate(found.forces.begin(), found.forces.end(), 0.),
                 modulus = 1e9, a = std::sqrt(4. * force / (M_PI * modulus)),
                 p0 = std::sqrt(force * modulus / M_PI);
    double largest = 0.;
    int n = 0;
    for (std::size_t i = 0; i < found.forces.size(); ++i)
    {
      const taut::SurfaceConstraint &c = found.constraints[i];
      const double x = c.point.x;
      if (x > .8 * a)
        continue;
      ++n;
      const double p = found.forces[i] / c.area / std::sqrt(1. - x * x),
                   exact = p0 * std::sqrt(1. - x * x / (a * a));
      largest = std::fmax(largest, std::fabs(p - exact) / p0);
    }
    EXPECT_GE(n, 4);
    return largest;
  }

  /// A shell of hexahedra between the radii 1 and 2, 14 its inner side; of a sphere or a cylinder.
  MeshFile shell_of(const bool is_sphere)
  {
    return moved_cells<3>({2, 2, 1},
                          [=](const dealii::Point<3> &p)
                          {
                            const double x = .4 * (p[0] - 1.), y = .4 * (p[1] - 1.),
                                         size = std::sqrt(1. + x * x + (is_sphere ? y * y : 0.)) /
                                                (1. + p[2]);
                            // Right-handed: x, y and outwards.
                            return is_sphere ? dealii::Point<3>(x / size, y / size, 1. / size)
                                             : dealii::Point<3>(x / size, -1. / size, y);
                          });
  }
} // namespace

// Claim: a mesh from a file follows a circle that an entry names, and facets are named. Expected:
// middles of sides at the radius 1, or nearer by the height of a chord.
TEST(SolidMeshes, a_mesh_from_a_file_follows_a_circle)
{
  const MeshFile ring = quarter_ring();
  const auto pressed = [&](const std::string &curve)
  {
    return run(scene("equilibrium",
                     body("ring", "File = " + ring.path() + "; " + curve,
                          "Degree = 2; Symmetry boundaries = 10, 11; "
                          "Displacement = 12: -1e-4*x, -1e-4*y"),
                     "Contact pin: Slave = ring: 13; Obstacle = cylinder; Point = 0, 0; "
                     "Direction = 0, 0, 1; Radius = 0.99995\n" +
                         at_rest));
  };
  const double chord = std::cos(M_PI / 16.);
  for (const bool follows : {false, true})
  {
    const Ran found = pressed(follows ? "Curved boundaries = 13: circle, 0, 0" : "Shift = 0, 0");
    // Middles of straight sides are in the obstacle, where a run at rest pushes them out.
    ASSERT_EQ(found.error, "");
    ASSERT_EQ(found.constraints.size(), 9u);
    double least = 2.;
    for (const taut::SurfaceConstraint &c : found.constraints)
      least = std::fmin(least, norm(c.point));
    EXPECT_NEAR(least, follows ? 1. : chord, 1e-12);
    EXPECT_EQ(has(found.log, "straight faces of degree 2"), !follows) << found.log;
  }
  EXPECT_TRUE(has(pressed("Curved boundaries = 13: circle, 0.1, 0").error, "on no one radius"));
  EXPECT_TRUE(has(pressed("Curved boundaries = 9: circle, 0, 0").error, "no boundary 9"));
  EXPECT_TRUE(has(pressed("Curved boundaries = 13: sphere, 0, 0").error, "id: circle, x, y"));
}

// Claim: a mesh of second order is one error that says how to export it and to name its curves.
TEST(SolidMeshes, of_second_order_end_in_one_error)
{
  for (const Elements &e : higher_order)
    for (const char *const format : {"2.2", "4.1"})
    {
      const OneElement mesh(e, format);
      const std::string error = run(scene("equilibrium",
                                          body("block", "File = " + mesh.path.string(),
                                               "Degree = 2; Dimension = " + std::to_string(e.dim)),
                                          at_rest))
                                    .error;
      const std::string type = "gmsh's type " + std::to_string(e.type) + ",";
      for (const std::string &part : Overrides{"Body block/Mesh/File", mesh.path.string(), type,
                                               "Mesh.ElementOrder = 1", "Curved boundaries"})
        EXPECT_TRUE(has(error, part)) << e.name << ", format " << format << ": " << error;
      EXPECT_FALSE(has(error, "\n")) << error;
    }
}

// Claim: pressures under a cylinder of degree 2 from a file do not alternate where its curve is
// named, and facets are warned of where it is not. Expected: Hertz' pressures for the resultant.
TEST(SolidMeshes, a_cylinder_from_a_file_is_pressed_as_by_hertz)
{
  const MeshFile block = round_block();
  const auto pressed = [&](const std::string &curve, const std::string &degree)
  {
    return run(scene("equilibrium",
                     body("cylinder", "File = " + block.path() + "; " + curve,
                          "Degree = " + degree + "; Symmetry boundaries = 10, 12"),
                     "Contact plate: Slave = cylinder: 13; Obstacle = plane; Point = 0, 1; "
                     "Direction = 0, -1; Gap = -0.04\n" +
                         at_rest));
  };
  const std::string named = "Curved boundaries = 13: circle, 0, 0";
  const Ran curved = pressed(named, "2"), facets = pressed("", "2"), straight = pressed("", "1");
  for (const Ran *const found : {&curved, &facets, &straight})
    ASSERT_EQ(found->error, "");
  const double with = deviation_from_hertz(curved), without = deviation_from_hertz(facets),
               linear = deviation_from_hertz(straight);
  figure("Hertz' cylinder from a file, named curve, deviation over p0", with);
  figure("Hertz' cylinder from a file, facets, deviation over p0", without);
  figure("Hertz' cylinder from a file, degree 1, deviation over p0", linear);
  EXPECT_LT(with, .03);
  EXPECT_GT(without, .1);
  EXPECT_LT(linear, .03);
  EXPECT_FALSE(has(curved.log, "straight faces")) << curved.log;
  EXPECT_TRUE(has(facets.log, "straight faces of degree 2")) << facets.log;
  EXPECT_TRUE(has(facets.log, "Curved boundaries")) << facets.log;
  EXPECT_FALSE(has(straight.log, "straight faces")) << straight.log;
}

// Claim: a shaft in a hub of straight faces that do not match is warned of, with the height of the
// arcs, degree and size; with degree 2, and with nodes opposite each other, pressures are right.
// Expected: Lame's pressure of thick rings in plane stress, 6.152 MPa; the height R (1 - cos(a /
// 2)).
TEST(SolidMeshes, a_shaft_in_a_hub_of_straight_faces)
{
  const double p = 2.5e-6 * 2.1e11 / (.02 * (5. / 3. + 13. / 5.)),
               height = .02 * (1. - std::cos(M_PI / 4. / 13.));
  EXPECT_NEAR(p, 6.152e6, 1e3);
  for (const std::string method : {"mortar", "nodes to faces"})
  {
    const Ran linear = press_fit(17, 13, "1", "Method = " + method);
    ASSERT_EQ(linear.error, "");
    EXPECT_GT(std::fabs(mean_pressure(linear) / p - 1.), .3);
    const std::size_t at = linear.log.find("straight faces on a curve that are ");
    ASSERT_NE(at, std::string::npos) << linear.log;
    EXPECT_NEAR(std::stod(linear.log.substr(at + 35)), height, .02 * height);
    EXPECT_TRUE(has(linear.log, "Take Degree = 2")) << linear.log;
    EXPECT_FALSE(has(linear.log, "resultants are not")) << linear.log;
  }
  const Ran quadratic = press_fit(17, 13, "2"), matched = press_fit(40, 40, "1");
  for (const Ran *const found : {&quadratic, &matched})
  {
    ASSERT_EQ(found->error, "");
    EXPECT_NEAR(mean_pressure(*found), p, 5e-3 * p);
    EXPECT_FALSE(has(found->log, "Warning")) << found->log;
  }
}

// Claim: a plate under a roller of straight faces is warned of with the height of the arcs, until
// the faces have the size that the warning names; the force then is that of the circle. Expected:
// the height R (1 - cos(a / 2)), a tenth of the gap with this size, and the force with degree 2.
TEST(SolidMeshes, a_plate_under_a_roller_of_straight_faces)
{
  const auto pressed = [](const double width, const std::string &degree)
  {
    const MeshFile roller = round_block(width);
    return run(
        scene("equilibrium",
              body("roller", "File = " + roller.path() + "; Curved boundaries = 13: circle, 0, 0",
                   "Degree = " + degree + "; Symmetry boundaries = 10, 12") +
                  body("plate", "Arguments = 60, 30 : 0, 0.998 : 0.6, 1.298",
                       "Degree = " + degree + "; Symmetry boundaries = 0, 3"),
              contact("plate: 2", "roller: 13") + at_rest));
  };
  const auto force = [](const Ran &found)
  { return std::accumulate(found.forces.begin(), found.forces.end(), 0.); };
  const auto after = [](const std::string &log, const std::string &words)
  {
    const std::size_t at = log.find(words);
    EXPECT_NE(at, std::string::npos) << log;
    return at == std::string::npos ? 0. : std::stod(log.substr(at + words.size()));
  };
  const double coarse = .1;
  const Ran found = pressed(coarse, "1");
  ASSERT_EQ(found.error, "");
  const double height = after(found.log, "straight faces on a curve that are "),
               gap = after(found.log, "interference of "),
               size = after(found.log, "faces of at most ");
  ASSERT_GT(size, 0.);
  EXPECT_NEAR(height, 1. - std::cos(.5 * std::asin(coarse)), .05 * height);
  EXPECT_NEAR(size * size / 8., .1 * gap, .05 * .1 * gap);
  const Ran finer = pressed(.2 / std::ceil(.2 / size), "1"), curved = pressed(.02, "2");
  for (const Ran *const right : {&finer, &curved})
  {
    ASSERT_EQ(right->error, "");
    EXPECT_FALSE(has(right->log, "straight faces")) << right->log;
  }
  figure("plate under a roller, straight faces over circle, force", force(found) / force(curved));
  figure("the same with faces of the size that the warning names", force(finer) / force(curved));
  EXPECT_NEAR(force(finer), force(curved), .05 * force(curved));
}

// Claim: hexahedra follow spheres and cylinders that an entry names. Expected: all nodes of their
// sides at the radius 1; without the entry those between corners are nearer.
TEST(SolidMeshes, hexahedra_follow_a_sphere_and_a_cylinder)
{
  for (const bool is_sphere : {true, false})
    for (const bool follows : {true, false})
    {
      const MeshFile shell = shell_of(is_sphere);
      const std::string curve = is_sphere ? "sphere, 0, 0, 0" : "cylinder, 0, 0, 5, 0, 0, 2";
      const Ran found = run(scene(
          "given",
          body("shell",
               "File = " + shell.path() + (follows ? "; Curved boundaries = 14: " + curve : ""),
               "Degree = 2; Dimension = 3"),
          "Contact pin: Slave = shell: 14; Obstacle = " +
              std::string(is_sphere ? "sphere" : "cylinder; Direction = 0, 0, 1") +
              "; Point = 0, 0, 0; Radius = 0.5\n" + at_rest));
      ASSERT_EQ(found.error, "");
      ASSERT_EQ(found.constraints.size(), 25u);
      double least = 2., largest = 0.;
      for (const taut::SurfaceConstraint &c : found.constraints)
      {
        const double r = is_sphere ? norm(c.point) : std::hypot(c.point.x, c.point.y);
        least = std::fmin(least, r);
        largest = std::fmax(largest, r);
      }
      EXPECT_NEAR(largest, 1., 1e-12);
      EXPECT_TRUE(follows ? std::fabs(least - 1.) < 1e-12 : least < .99) << curve << least;
    }
}
