// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: solids move as exact solutions do: linear displacements, beams and their first frequency.
#include "solid/first_frequency.h"
#include "verification/scene_tests.h"

#include <taut/interface/system.h>
#include <taut/solid/elastic_solid.h>
#include <taut/time/static_equilibrium.h>

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>

namespace
{
  using taut::Coordinates;
  using Kind = taut::BoundaryCondition::Kind;

  taut::BoundaryCondition constant_traction(const unsigned int boundary, const double traction)
  {
    return {Kind::traction, {boundary}, {true, true, true}, [=](const Coordinates &, double) {
              return Coordinates{0., traction, 0.};
            }};
  }

  /// A pressure of 100 Pa/m x.
  taut::BoundaryCondition growing_pressure(const unsigned int boundary)
  {
    return {Kind::pressure, {boundary}, {true, true, true}, [](const Coordinates &x, double) {
              return Coordinates{100. * x.x, 0., 0.};
            }};
  }

  template <int dim>
  std::unique_ptr<dealii::Triangulation<dim>> box(const std::vector<unsigned int> &n,
                                                  const dealii::Point<dim> &to,
                                                  const bool simplices = false)
  {
    auto cells = std::make_unique<dealii::Triangulation<dim>>();
    if (simplices)
      dealii::GridGenerator::subdivided_hyper_rectangle_with_simplices(*cells, n,
                                                                       dealii::Point<dim>(), to);
    else
      dealii::GridGenerator::subdivided_hyper_rectangle(*cells, n, dealii::Point<dim>(), to, true);
    return cells;
  }

  /// Displacements from the undeformed solid in equilibrium.
  template <int dim>
  dealii::Vector<double> equilibrium(const std::shared_ptr<const taut::SolidMesh<dim>> &mesh,
                                     const typename taut::ElasticSolid<dim>::Options &options)
  {
    taut::System system;
    const auto number = system.add(
        "solid", [&] { return std::make_unique<taut::ElasticSolid<dim>>("solid", mesh, options); });
    const taut::StaticState state =
        taut::static_equilibrium(system.structure(), system.constraints(), {}, 0.);
    return static_cast<const taut::FEBody<dim> &>(*system.body(number))
        .all_dofs(state.displacement[0]);
  }

  /// A displacement that is linear in space, given on the whole boundary, is so inside.
  template <int dim>
  void check_linear(std::unique_ptr<dealii::Triangulation<dim>> cells, const unsigned int degree)
  {
    const auto exact = [](const Coordinates &x, double)
    {
      return Coordinates{1e-3 * x.x + 2e-3 * x.y - 1e-3 * x.z, -3e-3 * x.x + 4e-3 * x.y,
                         5e-4 * x.x + 1e-3 * x.z};
    };
    const auto mesh = std::make_shared<const taut::SolidMesh<dim>>(std::move(cells), degree);
    typename taut::ElasticSolid<dim>::Options options;
    options.materials[taut::ElasticSolid<dim>::other_materials] = {2e9, .3, 1e3};
    options.conditions.emplace_back();
    options.conditions[0].boundaries = mesh->boundary_ids();
    options.conditions[0].value = exact;
    const dealii::Vector<double> U = equilibrium<dim>(mesh, options);
    double error = 0.;
    for (unsigned int i = 0; i < U.size(); ++i)
    {
      const auto &x = mesh->point(i);
      const Coordinates u = exact({x[0], x[1], dim == 3 ? x[dim - 1] : 0.}, 0.);
      error = std::fmax(error, std::fabs(U[i] - u[mesh->component(i)]));
    }
    EXPECT_LT(error, 1e-15) << "dim " << dim << ", degree " << degree;
  }

  double tip_deflection(const double length, const unsigned int n, const taut::PlaneState state)
  {
    const double E = 1e9, height = 1., force = 1e3;
    const auto mesh = std::make_shared<const taut::SolidMesh<2>>(
        box<2>({n, 4}, dealii::Point<2>(length, height)), 2);
    taut::ElasticSolid<2>::Options options;
    options.materials[taut::ElasticSolid<2>::other_materials] = {E, .3, 0.};
    options.plane_state = state;
    options.conditions = {{Kind::displacement, {0}}, constant_traction(1, -force / height)};
    const dealii::Vector<double> U = equilibrium<2>(mesh, options);
    double tip = 0.;
    unsigned int n_tip = 0;
    for (unsigned int i = 0; i < U.size(); ++i)
      if (mesh->component(i) == 1 && std::fabs(mesh->point(i)[0] - length) < 1e-9)
      {
        tip -= U[i];
        ++n_tip;
      }
    return tip / n_tip;
  }

  double product(const taut::SymmetricMatrix &A, const std::vector<double> &x)
  {
    return taut::dot(x, verification::matrix_times(A, x));
  }

  /// Mass of a body, and the force on it along y.
  template <int dim>
  std::pair<double, double> mass_and_force(const taut::ElasticSolid<dim> &solid,
                                           const taut::SolidMesh<dim> &mesh)
  {
    std::vector<double> P, along(solid.n_dofs(), 0.);
    solid.external_force(0., P);
    for (unsigned int i = 0; i < P.size(); ++i)
      along[i] = mesh.component(i) == 1;
    return {product(solid.mass(), along), taut::dot(P, along)};
  }

  /// P L^3 / (3 E I) + P L / (kappa G A).
  double timoshenko(const double length, const double E, const double nu)
  {
    const double I = 1. / 12., G = E / (2. * (1. + nu)), kappa = 10. * (1. + nu) / (12. + 11. * nu);
    return 1e3 * length * length * length / (3. * E * I) + 1e3 * length / (kappa * G);
  }
} // namespace

TEST(ElasticSolids, linear_displacements_are_exact_on_distorted_cells)
{
  for (const unsigned int degree : {1, 2})
  {
    auto quadrilaterals = box<2>({5, 4}, dealii::Point<2>(2., 1.));
    dealii::GridTools::distort_random(.2, *quadrilaterals, true, 7);
    check_linear<2>(std::move(quadrilaterals), degree);
    auto refined = box<2>({3, 3}, dealii::Point<2>(2., 1.));
    refined->begin_active()->set_refine_flag();
    refined->execute_coarsening_and_refinement();
    check_linear<2>(std::move(refined), degree);
    auto hexahedra = box<3>({3, 3, 2}, dealii::Point<3>(2., 1., 1.));
    dealii::GridTools::distort_random(.2, *hexahedra, true, 7);
    check_linear<3>(std::move(hexahedra), degree);
    check_linear<2>(box<2>({4, 3}, dealii::Point<2>(2., 1.), true), degree);
    check_linear<3>(box<3>({2, 2, 2}, dealii::Point<3>(2., 1., 1.), true), degree);
  }
}

TEST(ElasticSolids, cantilevers_bend_as_beams)
{
  const double E = 1e9, nu = .3;
  const double slender =
                   tip_deflection(50., 100, taut::PlaneState::stress) / timoshenko(50., E, nu),
               stocky = tip_deflection(4., 16, taut::PlaneState::stress) / timoshenko(4., E, nu);
  verification::figure("cantilever of 50 x 1, Q2, tip over Timoshenko", slender);
  verification::figure("cantilever of 4 x 1, Q2, tip over Timoshenko", stocky);
  EXPECT_NEAR(slender, 1., 5e-3);
  EXPECT_NEAR(stocky, 1., 5e-3);
  // Plane strain is a beam of the stiffness E / (1 - nu^2).
  const double strain =
      tip_deflection(50., 100, taut::PlaneState::strain) / timoshenko(50., E / (1. - nu * nu), nu);
  EXPECT_NEAR(strain, 1., 5e-3);
}

TEST(ElasticSolids, the_first_frequency_of_a_cantilever_is_that_of_a_beam)
{
  const double length = 50., E = 1e9, density = 1e3;
  for (const taut::SolidMass mass :
       {taut::SolidMass::consistent, taut::SolidMass::lumped, taut::SolidMass::reduced})
  {
    const auto mesh = std::make_shared<const taut::SolidMesh<2>>(
        box<2>({100, 4}, dealii::Point<2>(length, 1.)), 2);
    taut::ElasticSolid<2>::Options options;
    options.materials[taut::ElasticSolid<2>::other_materials] = {E, .3, density};
    options.plane_state = taut::PlaneState::stress;
    options.mass = mass;
    options.conditions = {{Kind::displacement, {0}}};
    const taut::ElasticSolid<2> solid("beam", mesh, options);
    const double exact =
                     std::pow(1.8751040687, 2) * std::sqrt(E / 12. / density) / (length * length),
                 ratio = verification::first_frequency(solid) / exact;
    verification::figure("first frequency of a cantilever of 50 x 1 over that of a beam", ratio);
    EXPECT_NEAR(ratio, 1., 5e-3);
  }
}

TEST(ElasticSolids, weight_and_pressure_are_carried_by_the_supports)
{
  const auto mesh = std::make_shared<const taut::SolidMesh<3>>(
      box<3>({3, 2, 2}, dealii::Point<3>(3., 1., 2.)), 1);
  for (const taut::SolidMass mass : {taut::SolidMass::consistent, taut::SolidMass::lumped})
  {
    taut::ElasticSolid<3>::Options options;
    options.materials[taut::ElasticSolid<3>::other_materials] = {1e9, .2, 500.};
    options.mass = mass;
    options.gravity = {0., -9.81, 0.};
    options.conditions = {growing_pressure(3)};
    const taut::ElasticSolid<3> solid("box", mesh, options);
    const auto [m, force] = mass_and_force(solid, *mesh);
    EXPECT_NEAR(m, 500. * 6., 1e-9);
    // The side y = 1 is 3 m x 2 m; the mean of x is 1.5 m.
    EXPECT_NEAR(force, -9.81 * 500. * 6. - 100. * 1.5 * 6., 1e-8);
    EXPECT_EQ(solid.null_space().vectors.size(), 6u);
  }
}

// A plate of 3 m x 2 m in plane strain: mass, weight, traction, pressure and the energy of a strain
// e along x, (lambda + 2 mu) e^2 / 2 of the volume, are those of its thickness.
TEST(ElasticSolids, plates_have_the_thickness_that_is_given)
{
  const auto mesh =
      std::make_shared<const taut::SolidMesh<2>>(box<2>({3, 2}, dealii::Point<2>(3., 2.)), 1);
  constexpr double thickness = .25, volume = 6. * thickness;
  taut::ElasticSolid<2>::Options options;
  options.materials[taut::ElasticSolid<2>::other_materials] = {1e9, .3, 500.};
  options.thickness = thickness;
  options.gravity = {0., -9.81, 0.};
  options.conditions = {growing_pressure(3), constant_traction(1, 70.)};
  const taut::ElasticSolid<2> solid("plate", mesh, options);
  const auto [m, force] = mass_and_force(solid, *mesh);
  std::vector<double> u(solid.n_dofs(), 0.);
  for (unsigned int i = 0; i < u.size(); ++i)
    if (mesh->component(i) == 0)
      u[i] = 1e-3 * mesh->point(i)[0];
  EXPECT_NEAR(m, 500. * volume, 1e-9);
  EXPECT_NEAR(force, -9.81 * 500. * volume + thickness * (-100. * 1.5 * 3. + 70. * 2.), 1e-9);
  EXPECT_NEAR(product(solid.stiffness(), u), 1e9 * .7 / (1.3 * .4) * 1e-6 * volume, 1e-9);
}
