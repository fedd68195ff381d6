// SPDX-License-Identifier: LGPL-2.1-or-later
// A cube on a rigid floor as deal.II's programs solve contact (its tutorial step-42): a primal-dual
// active set, and for each set conjugate gradients with algebraic multigrid of Trilinos. The scene
// is that of compare.py, which runs this beside Taut. Arguments: elements along an edge, relative
// residual.
#include <deal.II/base/mpi.h>
#include <deal.II/base/multithread_info.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/vector.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>

namespace
{
  constexpr unsigned int dim = 3;
  constexpr double E = 1e9, nu = .3, pressure = 1e6, width = .02;

  class CubeOnFloor
  {
  public:
    explicit CubeOnFloor(const unsigned int n) : fe(dealii::FE_Q<dim>(1), dim), dofs(mesh)
    {
      dealii::GridGenerator::subdivided_hyper_cube(mesh, n, 0., 1., true);
      dofs.distribute_dofs(fe);
      u.reinit(dofs.n_dofs());
      f.reinit(dofs.n_dofs());
      reaction.reinit(dofs.n_dofs());
      dealii::DynamicSparsityPattern pattern(dofs.n_dofs());
      dealii::DoFTools::make_sparsity_pattern(dofs, pattern);
      K.reinit(pattern);
      A.reinit(pattern);
      for (unsigned int axis = 0; axis < 2; ++axis)
        for (const auto dof : on_boundary(2 * axis, axis))
          is_held[dof] = true;
      floor = on_boundary(4, 2);
      assemble();
    }

    std::size_t n_dofs() const { return dofs.n_dofs(); }
    std::size_t n_candidates() const { return floor.n_elements(); }

    /// Sets and iterations.
    std::pair<unsigned int, unsigned int> solve(const double tolerance)
    {
      std::map<dealii::types::global_dof_index, bool> closed;
      for (const auto dof : floor)
        closed[dof] = true;
      unsigned int n_sets = 0, n_iterations = 0;
      for (bool changes = true; changes; ++n_sets)
      {
        n_iterations += solve_on(closed, tolerance);
        K.vmult(reaction, u);
        reaction -= f;
        changes = false;
        for (auto &[dof, is_closed] : closed)
        {
          const bool stays = is_closed ? reaction[dof] > 0. : u[dof] < 0.;
          changes |= stays != is_closed;
          is_closed = stays;
        }
      }
      return {n_sets, n_iterations};
    }

    double force() const
    {
      double sum = 0.;
      for (const auto dof : floor)
        sum += reaction[dof];
      return sum;
    }

    std::size_t n_closed() const
    {
      std::size_t n = 0;
      for (const auto dof : floor)
        n += reaction[dof] > 0. && u[dof] == 0.;
      return n;
    }

  private:
    dealii::IndexSet on_boundary(const unsigned int id, const unsigned int component) const
    {
      std::vector<bool> components(dim, false);
      components[component] = true;
      return dealii::DoFTools::extract_boundary_dofs(dofs, dealii::ComponentMask(components), {id});
    }

    void assemble()
    {
      const dealii::QGauss<dim> rule(2);
      const dealii::QGauss<dim - 1> of_faces(2);
      dealii::FEValues<dim> values(fe, rule, dealii::update_gradients | dealii::update_JxW_values);
      dealii::FEFaceValues<dim> on_face(fe, of_faces,
                                        dealii::update_values | dealii::update_JxW_values |
                                            dealii::update_quadrature_points);
      const dealii::FEValuesExtractors::Vector displacement(0);
      const double lambda = E * nu / ((1. + nu) * (1. - 2. * nu)), mu = E / (2. * (1. + nu));
      const unsigned int n = fe.n_dofs_per_cell();
      dealii::FullMatrix<double> own(n, n);
      dealii::Vector<double> load(n);
      std::vector<dealii::types::global_dof_index> index(n);
      const dealii::AffineConstraints<double> none;
      for (const auto &cell : dofs.active_cell_iterators())
      {
        values.reinit(cell);
        own = 0.;
        load = 0.;
        for (unsigned int q = 0; q < rule.size(); ++q)
          for (unsigned int i = 0; i < n; ++i)
          {
            const auto strain = values[displacement].symmetric_gradient(i, q);
            const double divergence = values[displacement].divergence(i, q);
            for (unsigned int j = 0; j <= i; ++j)
              own(i, j) += (2. * mu * (strain * values[displacement].symmetric_gradient(j, q)) +
                            lambda * divergence * values[displacement].divergence(j, q)) *
                           values.JxW(q);
          }
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < i; ++j)
            own(j, i) = own(i, j);
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary() && face->boundary_id() == 5)
          {
            on_face.reinit(cell, face);
            for (unsigned int q = 0; q < of_faces.size(); ++q)
            {
              const auto x = on_face.quadrature_point(q);
              const double p = pressure * std::exp(-(x[0] * x[0] + x[1] * x[1]) / width);
              for (unsigned int i = 0; i < n; ++i)
                load(i) -= p * on_face[displacement].value(i, q)[2] * on_face.JxW(q);
            }
          }
        cell->get_dof_indices(index);
        none.distribute_local_to_global(own, load, index, K, f);
      }
      K.compress(dealii::VectorOperation::add);
    }

    unsigned int solve_on(const std::map<dealii::types::global_dof_index, bool> &closed,
                          const double tolerance)
    {
      std::map<dealii::types::global_dof_index, bool> held = is_held;
      for (const auto &[dof, is_closed] : closed)
        if (is_closed)
          held[dof] = true;
      std::vector<dealii::types::global_dof_index> rows;
      for (const auto &[dof, is_it] : held)
        rows.push_back(dof);
      // Rows and columns without the DoFs that are held.
      std::vector<char> is_out(dofs.n_dofs(), 0);
      for (const auto row : rows)
        is_out[row] = 1;
      A.copy_from(K);
      for (int row = 0; row < A.trilinos_matrix().NumMyRows(); ++row)
      {
        int n = 0, *column = nullptr;
        double *value = nullptr;
        A.trilinos_matrix().ExtractMyRowView(row, n, value, column);
        for (int e = 0; e < n; ++e)
          if (column[e] != row && (is_out[row] || is_out[column[e]]))
            value[e] = 0.;
      }
      dealii::Vector<double> b = f;
      for (const auto row : rows)
        b[row] = u[row] = 0.;

      dealii::TrilinosWrappers::PreconditionAMG multigrid;
      dealii::TrilinosWrappers::PreconditionAMG::AdditionalData options;
      options.elliptic = true;
      options.smoother_sweeps = 2;
      options.aggregation_threshold = 1e-2;
      const std::vector<bool> all(dim, true);
      dealii::DoFTools::extract_constant_modes(dofs, dealii::ComponentMask(all),
                                               options.constant_modes);
      multigrid.initialize(A, options);
      dealii::SolverControl control(10000, tolerance * b.l2_norm());
      dealii::SolverCG<dealii::Vector<double>> cg(control);
      cg.solve(A, u, b, multigrid);
      return control.last_step();
    }

    dealii::Triangulation<dim> mesh;
    const dealii::FESystem<dim> fe;
    dealii::DoFHandler<dim> dofs;
    std::map<dealii::types::global_dof_index, bool> is_held;
    dealii::IndexSet floor;
    dealii::TrilinosWrappers::SparseMatrix K, A;
    dealii::Vector<double> f, u, reaction;
  };
} // namespace

int main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  if (argc < 3)
    return 1;
  CubeOnFloor cube(std::strtoul(argv[1], nullptr, 10));
  const auto [n_sets, n_iterations] = cube.solve(std::strtod(argv[2], nullptr));
  std::printf("DoFs %zu candidates %zu closed %zu force %.10g sets %u iterations %u\n",
              cube.n_dofs(), cube.n_candidates(), cube.n_closed(), cube.force(), n_sets,
              n_iterations);
}
