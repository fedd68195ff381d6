// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_monolithic_contact_h
#define taut_monolithic_contact_h

#include <taut/base/sparse_cholesky.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/sparse_direct.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/vector.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

namespace monolithic_contact
{
  using Matrix = dealii::SparseMatrix<double>;
  using Vector = dealii::Vector<double>;

  /// A rectangle of Q1 elements in plane strain between a top that is moved and a floor below.
  struct Slab
  {
    unsigned int n_x, n_y;                         ///< elements
    double length, height;                         ///< [m]
    double E, nu, density;                         ///< [Pa], [1], [kg/m^3]
    std::function<double(double x, double t)> top; ///< vertical displacement [m]
    std::function<double(double x)> floor, slope;  ///< height of the floor [m], its derivative
  };

  /**
   * The whole slab as one system, in the way of deal.II's step-42: a primal-dual active set in
   * which the closed nodes of the bottom are held at the floor and each other set is a new
   * factorisation, by UMFPACK as deal.II calls it, or by CHOLMOD, whose order and pattern are kept.
   * The bottom nodes have their DoFs along the normal of the floor and across it; the left and
   * right sides do not move along x. Steps are those of backward Euler: V = dU / step, A = (V -
   * V_0) / step.
   */
  class Newton
  {
  public:
    Newton(const Slab &slab, const bool uses_umfpack)
        : slab(slab), uses_umfpack(uses_umfpack), element(dealii::FE_Q<2>(1), 2)
    {
      dealii::GridGenerator::subdivided_hyper_rectangle(
          mesh, {slab.n_x, slab.n_y}, dealii::Point<2>(),
          dealii::Point<2>(slab.length, slab.height), true);
      handler.reinit(mesh);
      handler.distribute_dofs(element);
      find_nodes();
      assemble();
      U.reinit(handler.n_dofs());
      V.reinit(handler.n_dofs());
      force.assign(bottom.size(), 0.);
      closed.assign(bottom.size(), 0);
    }

    /// Equilibrium at time t [s].
    void find_equilibrium(const double t)
    {
      A.copy_from(K);
      is_factored = false;
      solve(t, Vector(U.size()));
    }

    /// A step from the state at hand to time t [s]. The first one factors.
    void advance(const double t, const double step)
    {
      if (step != last_step)
      {
        A.copy_from(K);
        A.add(1. / (step * step), M);
        is_factored = false;
        last_step = step;
      }
      Vector rhs(U.size()), inertia(U);
      inertia.add(step, V);
      inertia *= 1. / (step * step);
      M.vmult(rhs, inertia);
      const Vector before = U;
      solve(t, rhs);
      V = U;
      V -= before;
      V *= 1. / step;
    }

    /// Displacement of a node (i, j) of the grid [m].
    dealii::Point<2> displacement(const unsigned int i, const unsigned int j) const
    {
      const Node &node = nodes[j * (slab.n_x + 1) + i];
      const double a = U[node.dofs[0]], b = U[node.dofs[1]];
      return {node.across[0] * a + node.normal[0] * b, node.across[1] * a + node.normal[1] * b};
    }

    std::vector<double> force; ///< of the floor on each bottom node, by x [N/m]
    std::vector<char> closed;  ///< whether it has one
    long n_sets = 0, n_factorisations = 0;

    std::size_t n_dofs() const { return handler.n_dofs(); }

  private:
    struct Node
    {
      unsigned int dofs[2] = {};
      double across[2] = {1., 0.}, normal[2] = {0., 1.}; ///< what its DoFs are along
      double gap = 0.;                                   ///< from the floor [m]
    };

    void find_nodes()
    {
      nodes.resize((slab.n_x + 1) * (slab.n_y + 1));
      std::vector<dealii::Point<2>> points(handler.n_dofs());
      dealii::DoFTools::map_dofs_to_support_points(dealii::MappingQ1<2>(), handler, points);
      node_of.resize(handler.n_dofs());
      component_of.resize(handler.n_dofs());
      std::vector<dealii::types::global_dof_index> dofs(element.dofs_per_cell);
      for (const auto &cell : handler.active_cell_iterators())
      {
        cell->get_dof_indices(dofs);
        for (unsigned int a = 0; a < dofs.size(); ++a)
        {
          const dealii::Point<2> &p = points[dofs[a]];
          const auto i = static_cast<unsigned int>(std::lround(p[0] / slab.length * slab.n_x));
          const auto j = static_cast<unsigned int>(std::lround(p[1] / slab.height * slab.n_y));
          node_of[dofs[a]] = j * (slab.n_x + 1) + i;
          component_of[dofs[a]] = element.system_to_component_index(a).first;
          nodes[node_of[dofs[a]]].dofs[component_of[dofs[a]]] = dofs[a];
        }
      }
      for (unsigned int i = 0; i <= slab.n_x; ++i)
      {
        Node &node = nodes[i];
        // The closest point of the floor to (x, 0), by Newton's method.
        const double x = i * slab.length / slab.n_x;
        double s = x;
        const auto distance = [&](const double at)
        { return at - x + slab.floor(at) * slab.slope(at); };
        for (int iteration = 0; iteration < 30; ++iteration)
        {
          const double d = 1e-6;
          s -= distance(s) * 2. * d / (distance(s + d) - distance(s - d));
        }
        const double length = std::hypot(1., slab.slope(s));
        node.normal[0] = -slab.slope(s) / length;
        node.normal[1] = 1. / length;
        node.across[0] = node.normal[1];
        node.across[1] = -node.normal[0];
        node.gap = (x - s) * node.normal[0] - slab.floor(s) * node.normal[1];
        bottom.push_back(node.dofs[1]);
      }
      is_held.assign(handler.n_dofs(), 0);
      for (unsigned int j = 0; j <= slab.n_y; ++j)
        for (const unsigned int i : {0u, slab.n_x})
          is_held[nodes[j * (slab.n_x + 1) + i].dofs[0]] = 1;
      for (unsigned int i = 0; i <= slab.n_x; ++i)
        for (const unsigned int dof : nodes[slab.n_y * (slab.n_x + 1) + i].dofs)
          is_held[dof] = 1;
    }

    /// K and M in the directions of the nodes.
    void assemble()
    {
      dealii::DynamicSparsityPattern entries(handler.n_dofs());
      dealii::DoFTools::make_sparsity_pattern(handler, entries);
      pattern.copy_from(entries);
      for (Matrix *matrix : {&K, &M, &A, &reduced})
        matrix->reinit(pattern);
      const double lambda = slab.E * slab.nu / ((1. + slab.nu) * (1. - 2. * slab.nu)),
                   mu = slab.E / (2. * (1. + slab.nu));
      const dealii::QGauss<2> quadrature(2);
      dealii::FEValues<2> values(element, quadrature,
                                 dealii::update_values | dealii::update_gradients |
                                     dealii::update_JxW_values);
      const unsigned int n = element.dofs_per_cell;
      dealii::FullMatrix<double> k(n, n), m(n, n);
      std::vector<dealii::types::global_dof_index> dofs(n);
      for (const auto &cell : handler.active_cell_iterators())
      {
        values.reinit(cell);
        cell->get_dof_indices(dofs);
        k = 0.;
        m = 0.;
        for (unsigned int a = 0; a < n; ++a)
          for (unsigned int b = 0; b < n; ++b)
          {
            const unsigned int i = component_of[dofs[a]], j = component_of[dofs[b]];
            for (unsigned int q = 0; q < quadrature.size(); ++q)
            {
              const auto ga = values.shape_grad(a, q), gb = values.shape_grad(b, q);
              k(a, b) +=
                  (lambda * ga[i] * gb[j] + mu * ga[j] * gb[i] + (i == j ? mu * (ga * gb) : 0.)) *
                  values.JxW(q);
              if (i == j)
                m(a, b) += slab.density * values.shape_value(a, q) * values.shape_value(b, q) *
                           values.JxW(q);
            }
          }
        add_turned(k, dofs, K);
        add_turned(m, dofs, M);
      }
    }

    /// Q^T k Q, where Q turns the DoFs of each node.
    void add_turned(const dealii::FullMatrix<double> &k,
                    const std::vector<dealii::types::global_dof_index> &dofs, Matrix &to) const
    {
      const auto direction = [&](const unsigned int a, const unsigned int component)
      {
        const Node &node = nodes[node_of[dofs[a]]];
        return component_of[dofs[a]] == 0 ? node.across[component] : node.normal[component];
      };
      const auto other = [&](const unsigned int a)
      { return element.system_to_component_index(a).first == 0 ? a + 1 : a - 1; };
      for (unsigned int a = 0; a < dofs.size(); ++a)
        for (unsigned int b = 0; b < dofs.size(); ++b)
        {
          double sum = 0.;
          for (const unsigned int c : {a, other(a)})
            for (const unsigned int d : {b, other(b)})
              sum += direction(a, component_of[dofs[c]]) * k(c, d) *
                     direction(b, component_of[dofs[d]]);
          to.add(dofs[a], dofs[b], sum);
        }
    }

    /// A U = rhs + forces of the floor, from the set at hand on.
    void solve(const double t, const Vector &rhs)
    {
      Vector given(U.size()), x, residual(U.size());
      for (unsigned int i = 0; i <= slab.n_x; ++i)
        given[nodes[slab.n_y * (slab.n_x + 1) + i].dofs[1]] =
            slab.top(i * slab.length / slab.n_x, t);
      for (int iteration = 0; iteration < 100; ++iteration)
      {
        ++n_sets;
        for (std::size_t i = 0; i < bottom.size(); ++i)
          given[bottom[i]] = closed[i] ? -nodes[i].gap : 0.;
        if (!is_factored || closed != factored)
          factor();
        A.vmult(residual, given);
        x = rhs;
        x -= residual;
        for (unsigned int dof = 0; dof < U.size(); ++dof)
          if (is_fixed[dof])
            x[dof] = given[dof];
        apply_inverse(x);
        U = x;
        A.vmult(residual, U);
        residual -= rhs;
        double largest = 0.;
        for (std::size_t i = 0; i < bottom.size(); ++i)
        {
          force[i] = closed[i] ? residual[bottom[i]] : 0.;
          largest = std::max(largest, force[i]);
        }
        bool has_changed = false;
        for (std::size_t i = 0; i < bottom.size(); ++i)
        {
          const bool flips =
              closed[i] ? force[i] < -1e-12 * largest : U[bottom[i]] + nodes[i].gap < -1e-14;
          closed[i] = closed[i] != flips;
          has_changed |= flips;
        }
        if (!has_changed)
          return;
      }
      throw std::runtime_error("the active set does not settle");
    }

    /// A with identity rows and columns for what is held or closed.
    void factor()
    {
      ++n_factorisations;
      factored = closed;
      is_factored = true;
      is_fixed = is_held;
      for (std::size_t i = 0; i < bottom.size(); ++i)
        is_fixed[bottom[i]] = is_fixed[bottom[i]] || closed[i];
      if (uses_umfpack)
      {
        reduced.copy_from(A);
        for (unsigned int row = 0; row < U.size(); ++row)
          for (auto entry = reduced.begin(row); entry != reduced.end(row); ++entry)
            if (is_fixed[row] || is_fixed[entry->column()])
              entry->value() = row == entry->column() ? 1. : 0.;
        umfpack = std::make_unique<dealii::SparseDirectUMFPACK>();
        umfpack->initialize(reduced);
        return;
      }
      taut::SymmetricEntries entries;
      for (unsigned int row = 0; row < U.size(); ++row)
        for (auto entry = A.begin(row); entry != A.end(row); ++entry)
          if (entry->column() <= row)
            entries.add(row, entry->column(),
                        !is_fixed[row] && !is_fixed[entry->column()] ? entry->value()
                        : row == entry->column()                     ? 1.
                                                                     : 0.);
      if (cholmod.factor(U.size(), entries, 0.) != U.size())
        throw std::runtime_error("the matrix is not definite");
    }

    void apply_inverse(Vector &x)
    {
      if (uses_umfpack)
      {
        umfpack->solve(x);
        return;
      }
      std::vector<double> copy(x.begin(), x.end());
      cholmod.solve(copy);
      std::copy(copy.begin(), copy.end(), x.begin());
    }

    const Slab slab;
    const bool uses_umfpack;
    dealii::FESystem<2> element;
    dealii::Triangulation<2> mesh;
    dealii::DoFHandler<2> handler;
    dealii::SparsityPattern pattern;
    Matrix K, M, A, reduced;
    std::vector<Node> nodes;          ///< row after row of the grid, from below
    std::vector<unsigned int> bottom; ///< DoF along the normal of each node of the bottom
    std::vector<unsigned int> node_of, component_of; ///< of each DoF
    std::vector<char> is_held, is_fixed, factored;
    bool is_factored = false;
    double last_step = 0.;
    Vector U, V;
    std::unique_ptr<dealii::SparseDirectUMFPACK> umfpack;
    taut::SparseCholesky cholmod{taut::CholeskyMethod::automatic};
  };
} // namespace monolithic_contact

#endif
