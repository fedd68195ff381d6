// SPDX-License-Identifier: LGPL-2.1-or-later
// An elastic plate in plane strain with a clamped edge and a hanging node, as any program of
// deal.II assembles it: knows nothing of Taut.
#ifndef plate_h
#define plate_h

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/numerics/vector_tools.h>

using namespace dealii;

struct Plate
{
  Triangulation<2> mesh;
  FESystem<2> element{FE_Q<2>(1), 2};
  DoFHandler<2> dofs{mesh};
  AffineConstraints<double> constraints;
  SparsityPattern pattern;
  SparseMatrix<double> M, C, K;

  Plate()
  {
    GridGenerator::subdivided_hyper_rectangle(mesh, {4, 2}, Point<2>(0, 0), Point<2>(2, 1), true);
    mesh.begin_active()->set_refine_flag();
    mesh.execute_coarsening_and_refinement();
    dofs.distribute_dofs(element);
    DoFTools::make_hanging_node_constraints(dofs, constraints);
    VectorTools::interpolate_boundary_values(dofs, 0, Functions::ZeroFunction<2>(2), constraints);
    constraints.close();
    DynamicSparsityPattern all(dofs.n_dofs());
    DoFTools::make_sparsity_pattern(dofs, all);
    pattern.copy_from(all);
    for (auto *matrix : {&M, &C, &K})
      matrix->reinit(pattern);
    const double rho = 500., mu = 4e6, lambda = 6e6;
    FEValues<2> values(element, QGauss<2>(2), update_values | update_gradients | update_JxW_values);
    std::vector<types::global_dof_index> index(element.n_dofs_per_cell());
    for (const auto &cell : dofs.active_cell_iterators())
    {
      values.reinit(cell);
      cell->get_dof_indices(index);
      for (unsigned int i = 0; i < index.size(); ++i)
        for (unsigned int j = 0; j < index.size(); ++j)
        {
          const unsigned int a = element.system_to_component_index(i).first,
                             b = element.system_to_component_index(j).first;
          double m = 0., k = 0.;
          for (const unsigned int q : values.quadrature_point_indices())
          {
            const auto gi = values.shape_grad(i, q), gj = values.shape_grad(j, q);
            m += (a == b) * rho * values.shape_value(i, q) * values.shape_value(j, q) *
                 values.JxW(q);
            k += (lambda * gi[a] * gj[b] + mu * gi[b] * gj[a] + (a == b) * mu * (gi * gj)) *
                 values.JxW(q);
          }
          M.add(index[i], index[j], m);
          K.add(index[i], index[j], k);
        }
    }
    C.copy_from(K);
    C *= 1e-3;
  }
};

#endif
