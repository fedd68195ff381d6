// SPDX-License-Identifier: LGPL-2.1-or-later
// The obstacle problem of deal.II's tutorial step-41: a membrane over a staircase, each node one
// unilateral constraint. Compared with the projected Gauss-Seidel method on the same matrix: the
// same contact set, the same displacements.
#include <taut/interface/system.h>
#include <taut/substructure/fe_body.h>
#include <taut/time/static_equilibrium.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/numerics/matrix_tools.h>
#include <deal.II/numerics/vector_tools.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

using namespace dealii;

int main(int argc, char **argv)
{
  const int refinements = argc > 1 ? std::atoi(argv[1]) : 5;
  Triangulation<2> mesh;
  GridGenerator::hyper_cube(mesh, -1, 1);
  mesh.refine_global(refinements);
  FE_Q<2> element(1);
  DoFHandler<2> dofs(mesh);
  dofs.distribute_dofs(element);
  AffineConstraints<double> constraints;
  VectorTools::interpolate_boundary_values(dofs, 0, Functions::ZeroFunction<2>(), constraints);
  constraints.close();
  DynamicSparsityPattern all(dofs.n_dofs());
  DoFTools::make_sparsity_pattern(dofs, all);
  SparsityPattern pattern;
  pattern.copy_from(all);
  SparseMatrix<double> M(pattern), K(pattern), none;
  MatrixCreator::create_mass_matrix(dofs, QGauss<2>(2), M);
  MatrixCreator::create_laplace_matrix(dofs, QGauss<2>(2), K);
  Vector<double> load(dofs.n_dofs());
  VectorTools::create_right_hand_side(dofs, QGauss<2>(2), Functions::ConstantFunction<2>(-10.),
                                      load);
  std::vector<Point<2>> points(dofs.n_dofs());
  DoFTools::map_dofs_to_support_points(StaticMappingQ1<2>::mapping, dofs, points);
  const auto obstacle = [](const Point<2> &p) {
    return p[0] < -.5 ? -.2 : p[0] < 0. ? -.4 : p[0] < .5 ? -.6 : -.8;
  };

  taut::System system;
  const auto membrane = system.add("membrane",
                                   [&] {
                                     return std::make_unique<taut::FEBody<2>>(
                                         "membrane", dofs, M, none, K, constraints, load);
                                   });
  const auto &body = static_cast<const taut::FEBody<2> &>(*system.body(membrane));
  std::vector<std::size_t> constraint(dofs.n_dofs(), 0);
  for (unsigned int i = 0; i < dofs.n_dofs(); ++i)
    if (!constraints.is_constrained(i))
      constraint[i] = system.add(
          taut::Constraint::unilateral("node " + std::to_string(i),
                                       {{system.index_here(membrane), body.displacement_of_dof(i)}})
              .gap(-obstacle(points[i])));
  const taut::Constraints contacts = system.constraints();
  const taut::StaticState state = taut::static_equilibrium(system.structure(), contacts, {}, 0.);

  Vector<double> u(dofs.n_dofs()); // projected Gauss-Seidel
  for (double change = 1.; change > 1e-13;)
  {
    change = 0.;
    for (unsigned int i = 0; i < dofs.n_dofs(); ++i)
    {
      if (constraints.is_constrained(i))
        continue;
      double r = load[i];
      for (auto e = K.begin(i); e != K.end(i); ++e)
        r -= e->value() * u[e->column()];
      const double relaxed = std::fmax(obstacle(points[i]), u[i] + 1.8 * r / K.diag_element(i));
      change = std::fmax(change, std::fabs(relaxed - u[i]));
      u[i] = relaxed;
    }
  }
  unsigned int n_closed = 0, n_different = 0;
  double error = 0.;
  for (unsigned int i = 0; i < dofs.n_dofs(); ++i)
  {
    error = std::fmax(error, std::fabs(u[i] - state.displacement[0][i]));
    if (constraints.is_constrained(i))
      continue;
    const bool closed = state.multiplier[contacts.index_of_link(constraint[i])] > 0.;
    n_closed += closed;
    double r = -load[i];
    for (auto e = K.begin(i); e != K.end(i); ++e)
      r += e->value() * u[e->column()];
    n_different += closed != (r > 1e-9);
  }
  std::printf("%u DoFs, %u in contact, %u different; displacements differ by %.1e; certificate "
              "%.1e, %u active-set iterations\n",
              dofs.n_dofs(), n_closed, n_different, error, state.residuals.max(),
              state.residuals.iterations);
  return n_different == 0 && error < 1e-9 && n_closed > 0 ? 0 : 1;
}
