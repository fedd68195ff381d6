// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: contacts of surfaces act as exact solutions do: the patch test, Hertz's cylinder and ball.
#include "solid/mesh_file.h"
#include "solid/wavy_floor.h"
#include "verification/scene_tests.h"

#include "model/surface_constraints.h"

#include <deal.II/grid/grid_generator.h>

namespace
{
  using namespace verification;

  struct Found
  {
    std::vector<double> force, gap;
    std::vector<taut::SurfaceConstraint> constraints;
    double resultant = 0., largest_pressure = 0.;
    int iterations = 0;
  };

  /// The first contact of a scene in its equilibrium.
  Found found_at_rest(const std::string &scene, const Overrides &overrides = {})
  {
    Found found;
    const auto record = [&](const taut::StepView &view)
    {
      found = {};
      found.constraints = taut::contact_geometry(view.scene, 0).constraints;
      std::size_t i = 0;
      while (view.constraints[i].contact != 0)
        ++i;
      for (const taut::SurfaceConstraint &constraint : found.constraints)
      {
        const double N = view.state.multiplier[i];
        found.force.push_back(N);
        found.gap.push_back(view.state.distance[i++]);
        found.resultant += N;
        found.largest_pressure = std::fmax(found.largest_pressure, N / constraint.area);
      }
      found.iterations = view.residuals.iterations;
    };
    run_scene(scene, overrides, record);
    return found;
  }

  /// Where the line that fits y over x best is zero.
  double zero_of_fit(const std::vector<double> &x, const std::vector<double> &y)
  {
    const double n = x.size(), sx = std::accumulate(x.begin(), x.end(), 0.),
                 sy = std::accumulate(y.begin(), y.end(), 0.),
                 sxx = std::inner_product(x.begin(), x.end(), x.begin(), 0.),
                 sxy = std::inner_product(x.begin(), x.end(), y.begin(), 0.),
                 slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
    return (slope * sx - sy) / (n * slope);
  }

  /// Largest deviation of the pressures from 1 MPa, over it.
  double deviation_from_1e6(const Found &found)
  {
    double error = 0.;
    for (std::size_t i = 0; i < found.force.size(); ++i)
      error = std::fmax(error, std::fabs(found.force[i] / found.constraints[i].area / 1e6 - 1.));
    return error;
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
        found_at_rest(scene_file("hertz_cylinder"), {"Body cylinder/Mesh/Local refinements=" +
                                                     std::to_string(local_refinements)});
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
    return {found.largest_pressure / p0, std::sqrt(zero_of_fit(x2, p2)) / a, a / element,
            found.iterations};
  }

} // namespace

TEST(SurfaceContacts, uniform_pressure_passes_between_meshes_that_do_not_match)
{
  const std::string scene = scene_file("block_on_block");
  const Overrides swapped = {"Contact joint/Slave=lower: 3", "Contact joint/Master=upper: 2"};
  double error = 0.;
  for (const std::string degree : {"1", "2"})
    for (const Overrides &sides : {Overrides(), swapped})
    {
      const Found found = found_at_rest(
          scene, sides + Overrides{"Body upper/Degree=" + degree, "Body lower/Degree=" + degree});
      ASSERT_GT(found.force.size(), 5u);
      error = std::fmax(error, deviation_from_1e6(found));
      EXPECT_NEAR(found.resultant, 1e6, 1e-3);
    }
  figure("patch test, mortar: largest error of the pressure", error);
  EXPECT_LT(error, 1e-10);
  // Nodes on segments cannot.
  const double other =
      deviation_from_1e6(found_at_rest(scene, {"Contact joint/Method=nodes to faces"}));
  figure("patch test, nodes to faces: largest error of the pressure", other);
  EXPECT_GT(other, 1e-3);
}

// Claim: a pressure of 1 MPa on a cube with smaller cells in one half is that of each node of its
// foot, whose areas add up to 1 m^2 without hanging nodes, and a floor of 1e-9 m/Pa yields 1 mm.
TEST(SurfaceContacts, hanging_nodes_and_compliance_leave_a_uniform_pressure_as_it_is)
{
  const Found found = found_at_rest(R"(Generator = network; Gravity = 0, 0; Start = equilibrium
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
  // From -1 to 1 with the slit in x = 0, y < 0, whose sides are the boundaries 11 and 12.
  dealii::Triangulation<2> cells;
  dealii::GridGenerator::hyper_cube_slit(cells, -1., 1., true);
  cells.refine_global(3);
  const MeshFile mesh(cells, 10);
  const double strain = 1e-3, stress = 1e9 * .7 / (1.3 * .4) * strain;
  for (const std::string operator_name : {"assembled dense", "assembled sparse", "matrix-free"})
  {
    const Found found = found_at_rest(R"(Generator = network; Gravity = 0, 0; Start = equilibrium
Body square: Type = solid; Young's modulus = 1e9; Poisson's ratio = 0.3; Density = 2000;
  Displacement = 10: -1e-3*x, 0
Body square/Mesh: File = )" + mesh.path() +
                                      R"(
Contact slit: Slave = square: 11; Master = square: 12
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
  int iterations = 15;
  for (const int refinements : {1, 2, 3, 4, 5})
  {
    const Hertz h = cylinder(refinements);
    pressures.push_back(h.pressure);
    EXPECT_LE(h.iterations, iterations + 2); // not faster than log h
    iterations = h.iterations;
    figure("Hertz' cylinder, elements in the half-width", h.elements);
    figure("Hertz' cylinder, error of the largest pressure", h.pressure - 1.);
    figure("Hertz' cylinder, error of the half-width", h.half_width - 1.);
    figure("Hertz' cylinder, active sets", h.iterations);
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
  figure("Hertz' cylinder, order of the largest pressure", order);
  EXPECT_GT(order, 1.2);
}

TEST(SurfaceContacts, a_ball_is_pressed_as_by_hertz)
{
  const Found found = found_at_rest(scene_file("hertz_sphere"));
  const double modulus = 1e9 / (1. - .09), force = 4. * found.resultant,
               a = std::cbrt(3. * force / (4. * modulus)), p0 = 3. * force / (2. * M_PI * a * a);
  figure("Hertz' ball, half-width", a, "m");
  figure("Hertz' ball, error of the largest pressure", found.largest_pressure / p0 - 1.);
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
    const Found found = found_at_rest(wavy_floor::scene(n));
    ASSERT_EQ(found.force.size(), n + 1);
    double n_closed = 0.;
    for (const double force : found.force)
      n_closed += force > 0.;
    part.push_back(n_closed / found.force.size());
    sets.push_back(found.iterations);
    figure("wavy floor, constraints", n + 1);
    figure("wavy floor, part of them closed", part.back());
    figure("wavy floor, active sets", found.iterations);
    EXPECT_LE(found.iterations, 15);
  }
  EXPECT_LE(sets[2] - sets[1], std::max(0, sets[1] - sets[0]) + 2);
  // What the meshes see is the same contact, of a part of the nodes.
  EXPECT_NEAR(part[0], part[2], .02);
  EXPECT_GT(part[2], .1);
  EXPECT_LT(part[2], .9);
}

// Those that a projected Gauss-Seidel method closes, tests/install/library/membrane.cc (step-41).
TEST(SurfaceContacts, a_membrane_lies_on_395_nodes_of_a_staircase)
{
  const Found found = found_at_rest(scene_file("membrane_over_obstacle"));
  ASSERT_EQ(found.force.size(), 1089u);
  const auto n_closed = std::count_if(found.force.begin(), found.force.end(),
                                      [](const double force) { return force > 0.; });
  figure("membrane over a staircase, nodes in contact", n_closed);
  figure("membrane over a staircase, active sets", found.iterations);
  EXPECT_EQ(n_closed, 395);
  EXPECT_GT(*std::min_element(found.gap.begin(), found.gap.end()), -1e-13);
  EXPECT_LE(found.iterations, 15);
}
