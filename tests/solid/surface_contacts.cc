// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: contacts of surfaces pass on forces as exact solutions do. Sources: the patch test,
// Hertz's cylinder and ball.
#include "solid/mesh_file.h"
#include "solid/wavy_floor.h"
#include "verification/scene_tests.h"

#include <taut/model/surface_constraints.h>

namespace
{
  using verification::Overrides;

  struct Found
  {
    std::vector<double> force, gap;
    std::vector<taut::SurfaceConstraint> constraints;
    double resultant = 0., largest_pressure = 0.;
    int iterations = 0;
  };

  /// The first contact of a scene in its equilibrium.
  Found equilibrium(const std::string &scene, const Overrides &overrides = {})
  {
    Found found;
    verification::run_scene(scene, overrides,
                            [&](const taut::StepView &view)
                            {
                              found = {};
                              found.constraints = taut::contact_geometry(view.scene, 0).constraints;
                              std::size_t i = 0;
                              while (view.constraints[i].contact != 0)
                                ++i;
                              for (const taut::SurfaceConstraint &constraint : found.constraints)
                              {
                                found.force.push_back(view.state.multiplier[i]);
                                found.gap.push_back(view.state.geometric_gap[i]);
                                found.resultant += found.force.back();
                                found.largest_pressure = std::fmax(
                                    found.largest_pressure, found.force.back() / constraint.area);
                                ++i;
                              }
                              found.iterations = view.certificate.iterations;
                            });
    return found;
  }

  struct Line
  {
    double value_at_zero = 0., zero = 0.;
  };

  /// The line that fits y over x best.
  Line fit(const std::vector<double> &x, const std::vector<double> &y)
  {
    double n = 0., sx = 0., sy = 0., sxx = 0., sxy = 0.;
    for (std::size_t i = 0; i < x.size(); ++i)
    {
      n += 1.;
      sx += x[i];
      sy += y[i];
      sxx += x[i] * x[i];
      sxy += x[i] * y[i];
    }
    const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx), at_zero = (sy - slope * sx) / n;
    return {at_zero, -at_zero / slope};
  }

  struct Hertz
  {
    double pressure, half_width; ///< found over those of Hertz
    double elements;             ///< in the half-width
    int iterations;
  };

  Hertz cylinder(const int local_refinements)
  {
    const Found found =
        equilibrium(verification::scene_file("hertz_cylinder"),
                    {"Body cylinder/Mesh/Local refinements=" + std::to_string(local_refinements)});
    const double modulus = 1e9 / (1. - .09), force = 2. * found.resultant,
                 a = std::sqrt(4. * force / (M_PI * modulus)),
                 p0 = std::sqrt(force * modulus / M_PI);
    // p^2 = p0^2 (1 - x^2 / a^2).
    std::vector<double> x2, p2;
    double element = 1.;
    for (std::size_t i = 0; i < found.force.size(); ++i)
    {
      // Hertz' pressure is that on the flat plane.
      const double x = found.constraints[i].point.x,
                   p = found.force[i] / found.constraints[i].area / std::sqrt(1. - x * x);
      if (x > 0.)
        element = std::fmin(element, x);
      if (p > 0.)
      {
        x2.push_back(x * x);
        p2.push_back(p * p);
      }
    }
    return {found.largest_pressure / p0, std::sqrt(fit(x2, p2).zero) / a, a / element,
            found.iterations};
  }

  /// A mesh in gmsh's format of a square from -1 to 1 in 16 x 16 cells with a slit in x = 0, y < 0.
  /// Boundaries: 1 and 2 are its left and right side, 3 is the rest.
  struct SlitSquare : verification::MeshFile
  {
    SlitSquare()
    {
      constexpr std::size_t n = 16, middle = n / 2;
      // Nodes of the right side come after all others.
      const auto node = [](const std::size_t i, const std::size_t j, const bool is_right) {
        return 1 +
               (i == middle && j < middle && is_right ? (n + 1) * (n + 1) + j : i + (n + 1) * j);
      };
      for (std::size_t j = 0; j <= n; ++j)
        for (std::size_t i = 0; i <= n; ++i)
          add_node(2. * i / n - 1., 2. * j / n - 1.);
      for (std::size_t j = 0; j < middle; ++j)
      {
        add_node(2. * middle / n - 1., 2. * j / n - 1.);
        add(line, 1, {node(middle, j, false), node(middle, j + 1, false)});
        add(line, 2, {node(middle, j, true), node(middle, j + 1, true)});
      }
      for (std::size_t i = 0; i < n; ++i)
      {
        const bool is_right = i >= middle;
        add(line, 3, {node(i, 0, is_right), node(i + 1, 0, is_right)});
        add(line, 3, {node(i, n, false), node(i + 1, n, false)});
        add(line, 3, {node(0, i, false), node(0, i + 1, false)});
        add(line, 3, {node(n, i, false), node(n, i + 1, false)});
        for (std::size_t j = 0; j < n; ++j)
          add(quadrilateral, 0,
              {node(i, j, is_right), node(i + 1, j, is_right), node(i + 1, j + 1, is_right),
               node(i, j + 1, is_right)});
      }
    }
  };
} // namespace

TEST(SurfaceContacts, uniform_pressure_passes_between_meshes_that_do_not_match)
{
  const std::string scene = verification::scene_file("block_on_block");
  const Overrides swapped = {"Contact joint/Slave=lower: 3", "Contact joint/Master=upper: 2"};
  double error = 0.;
  for (const std::string degree : {"1", "2"})
    for (const Overrides &sides : {Overrides(), swapped})
    {
      Overrides all = sides;
      all.push_back("Body upper/Degree=" + degree);
      all.push_back("Body lower/Degree=" + degree);
      const Found found = equilibrium(scene, all);
      ASSERT_GT(found.force.size(), 5u);
      for (std::size_t i = 0; i < found.force.size(); ++i)
        error = std::fmax(error, std::fabs(found.force[i] / found.constraints[i].area - 1e6) / 1e6);
      EXPECT_NEAR(found.resultant, 1e6, 1e-3);
    }
  verification::figure("patch test, mortar: largest error of the pressure", error);
  EXPECT_LT(error, 1e-10);
  // Nodes on segments cannot.
  const Found nodes = equilibrium(scene, {"Contact joint/Method=nodes to faces"});
  double other = 0.;
  for (std::size_t i = 0; i < nodes.force.size(); ++i)
    other = std::fmax(other, std::fabs(nodes.force[i] / nodes.constraints[i].area - 1e6) / 1e6);
  verification::figure("patch test, nodes to faces: largest error of the pressure", other);
  EXPECT_GT(other, 1e-3);
}

// Claim: a pressure of 1 MPa on a cube with smaller cells in one half is that of each node of its
// foot, whose areas add up to 1 m^2 without those of hanging nodes, and a floor of 1e-9 m/Pa gives
// in by 1 mm.
TEST(SurfaceContacts, hanging_nodes_and_compliance_leave_a_uniform_pressure_as_it_is)
{
  const Found found = equilibrium(R"(Generator = network; Gravity = 0, 0; Start = equilibrium
Body cube: Type = solid; Dimension = 3; Young's modulus = 1e9; Poisson's ratio = 0.3;
  Density = 2000; Symmetry boundaries = 0, 2; Traction = 5: 0, 0, -1e6
Body cube/Mesh: Generator = subdivided_hyper_rectangle; Arguments = 2, 2, 2 : 0, 0, 0 : 1, 1, 1;
  Local refinements = 1; Refine where = 0.5 - x
Contact floor: Slave = cube: 4; Obstacle = plane; Point = 0, 0, 0; Direction = 0, 0, 1;
  Compliance = 1e-9
Time: End = 0
)");
  ASSERT_EQ(found.force.size(), 16u); // 18 nodes, of which 2 hang
  double area = 0.;
  for (std::size_t i = 0; i < found.force.size(); ++i)
  {
    area += found.constraints[i].area;
    EXPECT_NEAR(found.force[i] / found.constraints[i].area, 1e6, 1e-4);
    EXPECT_NEAR(found.gap[i], -1e-3, 1e-12);
  }
  EXPECT_NEAR(area, 1., 1e-13);
}

// Claim: the sides of a slit of one body touch each other as two bodies do, in each representation
// of F. Expected: a square that is given the strain e along x carries (lambda + 2 mu) e there as if
// it had no slit; the ends of the slit do not move against each other.
TEST(SurfaceContacts, a_slit_is_pressed_shut)
{
  const SlitSquare mesh;
  const double strain = 1e-3, stress = 1e9 * .7 / (1.3 * .4) * strain;
  for (const std::string operator_name :
       {"condensed", "assembled dense", "assembled sparse", "matrix-free"})
  {
    const Found found = equilibrium(R"(Generator = network; Gravity = 0, 0; Start = equilibrium
Body square: Type = solid; Young's modulus = 1e9; Poisson's ratio = 0.3; Density = 2000;
  Displacement = 3: -1e-3*x, 0
Body square/Mesh: File = )" + mesh.path() +
                                    R"(
Contact slit: Slave = square: 1; Master = square: 2
Time: End = 0
Solver: Interface operator = )" + operator_name);
    unsigned int n_inside = 0;
    for (std::size_t i = 0; i < found.force.size(); ++i)
      if (const double y = found.constraints[i].point.y; y > -.95 && y < -.05)
      {
        ++n_inside;
        EXPECT_NEAR(found.force[i] / found.constraints[i].area / stress, 1., 1e-9) << operator_name;
      }
    EXPECT_EQ(n_inside, 7u) << operator_name;
  }
}

// 2 to 32 elements in the half-width. The limit differs from Hertz by a few thousandths, as a / R
// is 0.1: the order is that of the differences.
TEST(SurfaceContacts, a_cylinder_is_pressed_as_by_hertz)
{
  std::vector<double> pressures;
  int iterations = 0;
  for (const int refinements : {1, 2, 3, 4, 5})
  {
    const Hertz h = cylinder(refinements);
    pressures.push_back(h.pressure);
    // Not faster than log h.
    if (iterations > 0)
    {
      EXPECT_LE(h.iterations, iterations + 2);
    }
    iterations = h.iterations;
    verification::figure("Hertz' cylinder, elements in the half-width", h.elements);
    verification::figure("Hertz' cylinder, error of the largest pressure", h.pressure - 1.);
    verification::figure("Hertz' cylinder, error of the half-width", h.half_width - 1.);
    verification::figure("Hertz' cylinder, active sets", h.iterations);
    EXPECT_LE(h.iterations, 15);
    if (refinements >= 3)
    {
      EXPECT_GT(h.elements, 7.);
      EXPECT_NEAR(h.pressure, 1., 5e-3);
      EXPECT_NEAR(h.half_width, 1., 7e-3);
    }
  }
  const auto change = [&](const std::size_t i)
  { return std::fabs(pressures[i + 1] - pressures[i]); };
  const double order = std::log2(change(1) / change(3)) / 2.;
  verification::figure("Hertz' cylinder, order of the largest pressure", order);
  EXPECT_GT(order, 1.2);
}

TEST(SurfaceContacts, a_ball_is_pressed_as_by_hertz)
{
  const Found found = equilibrium(verification::scene_file("hertz_sphere"));
  const double modulus = 1e9 / (1. - .09), force = 4. * found.resultant,
               a = std::cbrt(3. * force / (4. * modulus)), p0 = 3. * force / (2. * M_PI * a * a);
  verification::figure("Hertz' ball, half-width", a, "m");
  verification::figure("Hertz' ball, error of the largest pressure",
                       found.largest_pressure / p0 - 1.);
  EXPECT_NEAR(found.largest_pressure / p0, 1., 1.5e-2);
  EXPECT_LE(found.iterations, 15);
}

// Claim: the search for the active set does not depend on the number of constraints but for a few
// more sets when elements are halved. Expected: at most 15 from a cold start with 1001 of them, and
// no more sets for the second halving than for the first one, as log h, but for two.
TEST(SurfaceContacts, a_thousand_nodes_find_their_contacts_in_few_sets)
{
  std::vector<int> sets;
  std::vector<double> part;
  for (const unsigned int n : {260u, 500u, 1000u})
  {
    const Found found = equilibrium(wavy_floor::scene(n));
    ASSERT_EQ(found.force.size(), n + 1);
    double n_closed = 0.;
    for (const double force : found.force)
      n_closed += force > 0.;
    part.push_back(n_closed / found.force.size());
    sets.push_back(found.iterations);
    verification::figure("wavy floor, constraints", n + 1);
    verification::figure("wavy floor, part of them closed", part.back());
    verification::figure("wavy floor, active sets", found.iterations);
    EXPECT_LE(found.iterations, 15);
  }
  EXPECT_LE(sets[2] - sets[1], std::max(0, sets[1] - sets[0]) + 2);
  // What the meshes see is the same contact, of a part of the nodes.
  EXPECT_NEAR(part[0], part[2], .02);
  EXPECT_GT(part[2], .1);
  EXPECT_LT(part[2], .9);
}

// deal.II's step-41: the nodes that a projected Gauss-Seidel method closes on the same matrix
// (tests/install/library/membrane.cc).
TEST(SurfaceContacts, a_membrane_lies_on_395_nodes_of_a_staircase)
{
  const Found found = equilibrium(verification::scene_file("membrane_over_obstacle"));
  ASSERT_EQ(found.force.size(), 1089u);
  unsigned int n_closed = 0;
  double deepest = 0.;
  for (std::size_t i = 0; i < found.force.size(); ++i)
  {
    n_closed += found.force[i] > 0.;
    deepest = std::fmin(deepest, found.gap[i]);
  }
  verification::figure("membrane over a staircase, nodes in contact", n_closed);
  verification::figure("membrane over a staircase, active sets", found.iterations);
  EXPECT_EQ(n_closed, 395u);
  EXPECT_GT(deepest, -1e-13);
  EXPECT_LE(found.iterations, 15);
}
