// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_obstacle_problem_h
#define taut_obstacle_problem_h

#include "common.h"

#include <taut/interface/system.h>
#include <taut/substructure/fe_body.h>
#include <taut/time/static_equilibrium.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparse_direct.h>
#include <deal.II/numerics/vector_tools.h>

namespace obstacle
{
  /// One body of deal.II whose nodes stay above an obstacle.
  class Problem
  {
  public:
    /// A membrane of tension 1 on (-1, 1)^2 under a load of -10 over stairs.
    static std::unique_ptr<Problem> membrane(const unsigned int refinements)
    {
      auto result = std::make_unique<Problem>(1, 1);
      dealii::GridGenerator::hyper_cube(result->mesh, -1., 1.);
      result->mesh.refine_global(refinements);
      result->set_up([](const Values &v, const unsigned int i, const unsigned int j,
                        const unsigned int q) { return v.shape_grad(i, q) * v.shape_grad(j, q); },
                     nullptr, -10.,
                     [](const dealii::Point<2> &x) {
                       return x[0] < -.5 ? -.2 : x[0] < 0. ? -.4 : x[0] < .5 ? -.6 : -.8;
                     });
      return result;
    }

    /// A plate of 4 m by 2 m by Mindlin and Reissner, E = 7 GPa, 50 mm thick, with shear by two
    /// points in each direction. It is clamped on one side and heavy, over a bowl.
    static std::unique_ptr<Problem> plate(const unsigned int n)
    {
      constexpr double nu = .3, E = 7e9, h = .05, D = E * h * h * h / (12. * (1. - nu * nu)),
                       G = 5. / 6. * h * E / (2. * (1. + nu));
      auto result = std::make_unique<Problem>(2, 3);
      dealii::GridGenerator::subdivided_hyper_rectangle(
          result->mesh, {8 * n, 4 * n}, dealii::Point<2>(), dealii::Point<2>(4., 2.), true);
      result->set_up(
          [](const Values &v, const unsigned int i, const unsigned int j, const unsigned int q)
          {
            const unsigned int a = v.get_fe().system_to_component_index(i).first,
                               b = v.get_fe().system_to_component_index(j).first;
            if (a == 0 || b == 0)
              return 0.;
            const auto gi = v.shape_grad(i, q), gj = v.shape_grad(j, q);
            return D * (nu * gi[a - 1] * gj[b - 1] +
                        .5 * (1. - nu) * (gi[b - 1] * gj[a - 1] + (a == b ? gi * gj : 0.)));
          },
          [](const Values &v, const unsigned int i, const unsigned int j, const unsigned int q)
          {
            const unsigned int a = v.get_fe().system_to_component_index(i).first,
                               b = v.get_fe().system_to_component_index(j).first;
            double sum = 0.;
            for (unsigned int d = 0; d < 2; ++d)
              sum += (a == 0       ? v.shape_grad(i, q)[d]
                      : a == d + 1 ? -v.shape_value(i, q)
                                   : 0.) *
                     (b == 0       ? v.shape_grad(j, q)[d]
                      : b == d + 1 ? -v.shape_value(j, q)
                                   : 0.);
            return G * sum;
          },
          -40. * 9.81 * 2500. * h,
          [](const dealii::Point<2> &x)
          { return -.02 + .004 * (x - dealii::Point<2>(2.5, 1.)).norm_square(); });
      return result;
    }

    Problem(const unsigned int degree, const unsigned int n_components)
        : fe(dealii::FE_Q<2>(degree), n_components), dofs(mesh)
    {
    }

    struct Solution
    {
      std::vector<double> displacement;
      std::vector<char> closed; ///< of the candidates
      unsigned int n_sets = 0;
    };

    /// A system with a constraint for each candidate.
    taut::System system() const
    {
      taut::System result;
      const dealii::SparseMatrix<double> none;
      const auto number = result.add(
          "body",
          [&] { return std::make_unique<taut::FEBody<2>>("body", dofs, M, none, K, held, load); });
      const auto &body = dynamic_cast<const taut::FEBody<2> &>(*result.body(number));
      for (const auto &[dof, height] : candidates)
        result.add(taut::Constraint::unilateral(
                       "node " + std::to_string(dof),
                       {{result.index_here(number), body.displacement_of_dof(dof)}})
                       .gap(-height));
      return result;
    }

    /// By Taut, with a form of the interface operator.
    Solution by_taut(const std::string &form) const
    {
      taut::System with_rows = system();
      const taut::Constraints rows = with_rows.constraints();
      taut::SolverParameters solver;
      solver.interface.form = form;
      const taut::StaticState state =
          taut::static_equilibrium(with_rows.structure(), rows, solver, 0.);
      const dealii::Vector<double> u =
          dynamic_cast<const taut::FEBody<2> &>(*with_rows.body(0)).all_dofs(state.displacement[0]);
      Solution result{{u.begin(), u.end()}, {}, state.residuals.iterations};
      for (std::size_t k = 0; k < candidates.size(); ++k)
        result.closed.push_back(state.multiplier[rows.index_of_link(k)] > 0.);
      return result;
    }

    /// By a primal-dual active-set method: each set is eliminated from the matrix, which UMFPACK
    /// factors anew; forces below zero open, and nodes below the obstacle close.
    Solution by_elimination() const
    {
      constexpr unsigned int most_sets = 500;
      const unsigned int n = dofs.n_dofs();
      Solution result{std::vector<double>(n, 0.), std::vector<char>(candidates.size(), 0)};
      std::vector<double> height(n, 0.);
      std::vector<char> fixed(n, 0);
      dealii::Vector<double> u(n), force(n);
      for (; result.n_sets < most_sets; ++result.n_sets)
      {
        bool changes = result.n_sets == 0;
        for (unsigned int i = 0; i < n; ++i)
          fixed[i] = held.is_constrained(i);
        for (std::size_t k = 0; k < candidates.size(); ++k)
        {
          const auto &[dof, at] = candidates[k];
          const bool closes = force[dof] + 1e-2 * K.diag_element(dof) * (at - u[dof]) > 0.;
          changes |= closes != static_cast<bool>(result.closed[k]);
          result.closed[k] = fixed[dof] = closes;
          height[dof] = at;
        }
        if (!changes)
        {
          std::copy(u.begin(), u.end(), result.displacement.begin());
          return result;
        }
        dealii::SparseMatrix<double> A(pattern);
        dealii::Vector<double> rhs(load);
        for (unsigned int i = 0; i < n; ++i)
        {
          if (fixed[i])
          {
            A.set(i, i, K.diag_element(i));
            rhs[i] = K.diag_element(i) * height[i];
            continue;
          }
          for (auto entry = K.begin(i); entry != K.end(i); ++entry)
            if (fixed[entry->column()])
              rhs[i] -= entry->value() * height[entry->column()];
            else
              A.set(i, entry->column(), entry->value());
        }
        dealii::SparseDirectUMFPACK factors;
        factors.initialize(A);
        factors.vmult(u, rhs);
        K.vmult(force, u);
        force -= load;
        for (std::size_t k = 0; k < candidates.size(); ++k)
          if (!result.closed[k])
            force[candidates[k].first] = 0.;
      }
      throw std::runtime_error("the active sets come to no end");
    }

    std::size_t n_dofs() const { return dofs.n_dofs(); }
    std::size_t n_candidates() const { return candidates.size(); }

  private:
    using Values = dealii::FEValues<2>;
    using Form = std::function<double(const Values &, unsigned int, unsigned int, unsigned int)>;

    /// Adds a bilinear form to a matrix, by Gauss points.
    void add(const Form &form, const unsigned int n_points, dealii::SparseMatrix<double> &to) const
    {
      Values values(fe, dealii::QGauss<2>(n_points),
                    dealii::update_values | dealii::update_gradients | dealii::update_JxW_values);
      std::vector<dealii::types::global_dof_index> numbers(fe.n_dofs_per_cell());
      for (const auto &cell : dofs.active_cell_iterators())
      {
        values.reinit(cell);
        cell->get_dof_indices(numbers);
        for (unsigned int i = 0; i < numbers.size(); ++i)
          for (unsigned int j = 0; j < numbers.size(); ++j)
            for (const unsigned int q : values.quadrature_point_indices())
              to.add(numbers[i], numbers[j], form(values, i, j, q) * values.JxW(q));
      }
    }

    /// Boundary 0 is held; the load and the obstacle are those of the first component.
    void set_up(const Form &stiffness, const Form &reduced, const double force,
                const std::function<double(const dealii::Point<2> &)> &height)
    {
      dofs.distribute_dofs(fe);
      dealii::VectorTools::interpolate_boundary_values(
          dofs, 0, dealii::Functions::ZeroFunction<2>(fe.n_components()), held);
      held.close();
      dealii::DynamicSparsityPattern positions(dofs.n_dofs());
      dealii::DoFTools::make_sparsity_pattern(dofs, positions);
      pattern.copy_from(positions);
      K.reinit(pattern);
      M.reinit(pattern);
      add(stiffness, fe.degree + 1, K);
      if (reduced)
        add(reduced, fe.degree, K);
      add([](const Values &v, const unsigned int i, const unsigned int j, const unsigned int q)
          { return v.shape_value(i, q) * v.shape_value(j, q); },
          fe.degree + 1, M);
      const dealii::ComponentMask first = fe.component_mask(dealii::FEValuesExtractors::Scalar(0));
      const dealii::IndexSet of_first = dealii::DoFTools::extract_dofs(dofs, first);
      dealii::Vector<double> unit(dofs.n_dofs());
      for (const auto i : of_first)
        unit[i] = force;
      load.reinit(unit);
      // Columns of other components have entries, too, as the mass is that of all shapes.
      for (unsigned int i = 0; i < dofs.n_dofs(); ++i)
        for (auto entry = M.begin(i); of_first.is_element(i) && entry != M.end(i); ++entry)
          load[i] += entry->value() * unit[entry->column()];
      std::vector<dealii::Point<2>> places(dofs.n_dofs());
      dealii::DoFTools::map_dofs_to_support_points(dealii::StaticMappingQ1<2>::mapping, dofs,
                                                   places);
      for (const auto i : of_first)
        if (!held.is_constrained(i))
          candidates.emplace_back(i, height(places[i]));
    }

    dealii::Triangulation<2> mesh;
    dealii::FESystem<2> fe;
    dealii::DoFHandler<2> dofs;
    dealii::AffineConstraints<double> held;
    dealii::SparsityPattern pattern;
    dealii::SparseMatrix<double> K, M;
    dealii::Vector<double> load;
    std::vector<std::pair<unsigned int, double>> candidates; ///< DoF, height of the obstacle [m]
  };
} // namespace obstacle

#endif
