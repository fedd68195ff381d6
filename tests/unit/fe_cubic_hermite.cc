// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: the Hermite element agrees with polynomials, textbook matrices and frequencies of a beam.
#include "common.h"

#include "wire/fe_cubic_hermite.h"
#include "wire/hermite_shape.h"

#include <deal.II/base/multithread_info.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

namespace
{
  using namespace dealii;

  const std::vector<double> unequal_nodes = {0., 0.3, 0.8, 2.1, 2.4, 4.};

  /// An inclined line without zero components.
  const Point<3> start(.25, -.25, -.75);
  const Tensor<1, 3> along = Point<3>(1., .2, .4) / std::sqrt(1.2);

  double arc_length(const Point<3> &p)
  {
    return (p - start) * along;
  }

  std::vector<double> refined(const std::vector<double> &nodes)
  {
    std::vector<double> finer = {nodes.front()};
    for (unsigned int n = 1; n < nodes.size(); ++n)
    {
      finer.push_back((nodes[n - 1] + nodes[n]) / 2);
      finer.push_back(nodes[n]);
    }
    return finer;
  }

  /// The element on a straight wire with the given nodes, and a vector of its DoFs.
  struct WireSpace
  {
    using Scalar = std::function<double(double)>;

    explicit WireSpace(const std::vector<double> &nodes = unequal_nodes)
    {
      std::vector<Point<3>> points;
      for (const double s : nodes)
        points.push_back(start + s * along);
      std::vector<CellData<1>> cells(nodes.size() - 1);
      for (unsigned int c = 0; c < cells.size(); ++c)
        cells[c].vertices = {c, c + 1};
      triangulation.create_triangulation(points, cells, SubCellData());
      dof_handler.distribute_dofs(fe);
      w.reinit(dof_handler.n_dofs());
    }

    void interpolate(const Scalar &value, const Scalar &slope)
    {
      for (const auto &cell : dof_handler.active_cell_iterators())
        for (unsigned int v = 0; v < 2; ++v)
        {
          w(cell->vertex_dof_index(v, 0)) = value(arc_length(cell->vertex(v)));
          w(cell->vertex_dof_index(v, 1)) = slope(arc_length(cell->vertex(v)));
        }
    }

    Triangulation<1, 3> triangulation;
    const taut::FE_CubicHermite fe;
    DoFHandler<1, 3> dof_handler{triangulation};
    Vector<double> w;
  };

  const auto distance = [](const auto &a, const auto &b) { return (a - b).norm(); };

  struct Matrices
  {
    FullMatrix<double> mass, bending, tension; ///< for unit mass, bending stiffness, tension
  };

  /// The matrices of the whole wire through FEValues; row 2 vertex + component.
  Matrices assemble(const WireSpace &wire)
  {
    FEValues<1, 3> fe_values(wire.fe, QGauss<1>(4),
                             update_values | update_gradients | update_hessians |
                                 update_JxW_values);
    const unsigned int n = wire.dof_handler.n_dofs();
    Matrices matrices{FullMatrix<double>(n), FullMatrix<double>(n), FullMatrix<double>(n)};
    for (const auto &cell : wire.dof_handler.active_cell_iterators())
    {
      fe_values.reinit(cell);
      const auto row = [&](const unsigned int i) { return 2 * cell->vertex_index(i / 2) + i % 2; };
      for (unsigned int i = 0; i < 4; ++i)
        for (unsigned int j = 0; j < 4; ++j)
          for (const unsigned int q : fe_values.quadrature_point_indices())
          {
            const double JxW = fe_values.JxW(q);
            matrices.mass(row(i), row(j)) +=
                JxW * fe_values.shape_value(i, q) * fe_values.shape_value(j, q);
            matrices.tension(row(i), row(j)) +=
                JxW * fe_values.shape_grad(i, q) * fe_values.shape_grad(j, q);
            matrices.bending(row(i), row(j)) +=
                JxW * scalar_product(fe_values.shape_hessian(i, q), fe_values.shape_hessian(j, q));
          }
    }
    return matrices;
  }

  using Textbook = std::array<std::array<double, 4>, 4>;

  void expect_equal(const FullMatrix<double> &matrix, const double factor, const Textbook &expected)
  {
    for (unsigned int i = 0; i < 4; ++i)
      for (unsigned int j = 0; j < 4; ++j)
        EXPECT_NEAR(matrix(i, j), factor * expected[i][j],
                    1e-13 * factor * std::sqrt(expected[i][i] * expected[j][j]))
            << "entry " << i << ", " << j;
  }

  const auto order = [](const double coarse, const double fine)
  { return std::log2(coarse / fine); };

  // The DoFs are value and slope at the vertices, value first: by definition, for any length.
  TEST(FECubicHermite, each_shape_function_has_one_unit_dof)
  {
    for (const double h : {0.02, 0.7, 65.})
      for (unsigned int v = 0; v < 2; ++v)
      {
        const auto shape = taut::hermite_shape(h, v);
        for (unsigned int i = 0; i < 4; ++i)
        {
          EXPECT_EQ(shape.value[i], i == 2 * v ? 1. : 0.);
          EXPECT_EQ(shape.slope[i], i == 2 * v + 1 ? 1. : 0.);
        }
      }
  }

  // Rigid motions are in the space: a translation is 1 everywhere, a rotation is s with slope 1.
  TEST(FECubicHermite, rigid_motions_bend_nothing)
  {
    const double h = 0.7;
    for (const double xi : {0., 0.1, 0.5, 0.77, 1.})
    {
      const auto shape = taut::hermite_shape(h, xi);
      EXPECT_NEAR(shape.value[0] + shape.value[2], 1., 1e-15);
      EXPECT_NEAR(shape.slope[0] + shape.slope[2], 0., 1e-15);
      EXPECT_NEAR(shape.curvature[0] + shape.curvature[2], 0., 1e-14);
      EXPECT_NEAR(shape.value[1] + h * shape.value[2] + shape.value[3], h * xi, 1e-15);
      EXPECT_NEAR(shape.slope[1] + h * shape.slope[2] + shape.slope[3], 1., 1e-15);
      EXPECT_NEAR(shape.curvature[1] + h * shape.curvature[2] + shape.curvature[3], 0., 1e-14);
    }
  }

  // A cubic is in the space whatever the lengths of the cells, with three derivatives, which are
  // those along an inclined line times t, t x t and t x t x t.
  TEST(FECubicHermite, cubics_are_reproduced_on_unequal_cells)
  {
    const auto value = [](const double s) { return 1. - 2. * s + 0.7 * s * s + 0.3 * s * s * s; };
    const auto slope = [](const double s) { return -2. + 1.4 * s + 0.9 * s * s; };
    WireSpace wire;
    wire.interpolate(value, slope);
    FEValues<1, 3> fe_values(wire.fe, QGauss<1>(5),
                             update_values | update_gradients | update_hessians |
                                 update_3rd_derivatives | update_quadrature_points);
    std::vector<double> values(5);
    std::vector<Tensor<1, 3>> gradients(5);
    std::vector<Tensor<2, 3>> hessians(5);
    std::vector<Tensor<3, 3>> thirds(5);
    const Tensor<2, 3> twice = outer_product(along, along);
    for (const auto &cell : wire.dof_handler.active_cell_iterators())
    {
      fe_values.reinit(cell);
      fe_values.get_function_values(wire.w, values);
      fe_values.get_function_gradients(wire.w, gradients);
      fe_values.get_function_hessians(wire.w, hessians);
      fe_values.get_function_third_derivatives(wire.w, thirds);
      for (unsigned int q = 0; q < values.size(); ++q)
      {
        const double s = arc_length(fe_values.quadrature_point(q));
        EXPECT_NEAR(values[q], value(s), 1e-13);
        EXPECT_LT(distance(gradients[q], slope(s) * along), 1e-12);
        EXPECT_LT(distance(hessians[q], (1.4 + 1.8 * s) * twice), 1e-11);
        EXPECT_LT(distance(thirds[q], 1.8 * outer_product(along, twice)), 1e-9);
      }
    }
  }

  // Value and slope are the same from both sides of a node for arbitrary DoFs: C1 by definition.
  TEST(FECubicHermite, slopes_are_continuous_across_unequal_cells)
  {
    WireSpace wire;
    Vector<double> &w = wire.w;
    for (unsigned int i = 0; i < w.size(); ++i)
      w(i) = std::sin(1. + 7. * i);
    FEValues<1, 3> fe_values(wire.fe, QTrapezoid<1>(), update_values | update_gradients);
    std::map<unsigned int, std::pair<double, Tensor<1, 3>>> from_one_side;
    unsigned int n_compared = 0;
    std::vector<double> values(2);
    std::vector<Tensor<1, 3>> gradients(2);
    for (const auto &cell : wire.dof_handler.active_cell_iterators())
    {
      fe_values.reinit(cell);
      fe_values.get_function_values(w, values);
      fe_values.get_function_gradients(w, gradients);
      for (unsigned int v = 0; v < 2; ++v)
      {
        EXPECT_NEAR(gradients[v] * along, w(cell->vertex_dof_index(v, 1)), 1e-14);
        const auto [node, is_first] =
            from_one_side.insert({cell->vertex_index(v), {values[v], gradients[v]}});
        n_compared += !is_first;
        EXPECT_NEAR(node->second.first, values[v], 1e-15);
        EXPECT_LT(distance(node->second.second, gradients[v]), 1e-14);
      }
    }
    EXPECT_EQ(n_compared, unequal_nodes.size() - 2);
  }

  // The matrices of one beam cell: Przemieniecki, Theory of Matrix Structural Analysis, ch. 5, 11,
  // 15 (consistent mass, bending stiffness, geometric stiffness of a tensioned beam).
  TEST(FECubicHermite, element_matrices_are_the_textbook_ones)
  {
    for (const double h : {0.7, 2.3})
    {
      const Matrices matrices = assemble(WireSpace({0., h}));
      expect_equal(matrices.mass, h / 420,
                   {{{156, 22 * h, 54, -13 * h},
                     {22 * h, 4 * h * h, 13 * h, -3 * h * h},
                     {54, 13 * h, 156, -22 * h},
                     {-13 * h, -3 * h * h, -22 * h, 4 * h * h}}});
      expect_equal(matrices.bending, 1 / (h * h * h),
                   {{{12, 6 * h, -12, 6 * h},
                     {6 * h, 4 * h * h, -6 * h, 2 * h * h},
                     {-12, -6 * h, 12, -6 * h},
                     {6 * h, 2 * h * h, -6 * h, 4 * h * h}}});
      expect_equal(matrices.tension, 1 / (30 * h),
                   {{{36, 3 * h, -36, 3 * h},
                     {3 * h, 4 * h * h, -3 * h, -h * h},
                     {-36, -3 * h, 36, -3 * h},
                     {3 * h, -h * h, -3 * h, 4 * h * h}}});
    }
  }

  // One FEValues for all cells gives what a fresh one for each cell gives. Equal neighbours are
  // similar for deal.II (only with one thread), and the base class then keeps what it has.
  TEST(FECubicHermite, fe_values_can_be_reused_across_cells)
  {
    MultithreadInfo::set_thread_limit(1);
    const WireSpace wire({0., 1., 2., 3., 5., 7., 7.5, 8., 9.});
    const QGauss<1> quadrature(3);
    const UpdateFlags flags = update_values | update_gradients | update_hessians |
                              update_3rd_derivatives | update_JxW_values;
    FEValues<1, 3> reused(wire.fe, quadrature, flags);
    unsigned int n_similar = 0;
    for (const auto &cell : wire.triangulation.active_cell_iterators())
    {
      reused.reinit(cell);
      n_similar += reused.get_cell_similarity() != CellSimilarity::none;
      FEValues<1, 3> fresh(wire.fe, quadrature, flags);
      fresh.reinit(cell);
      for (unsigned int i = 0; i < 4; ++i)
        for (const unsigned int q : reused.quadrature_point_indices())
        {
          EXPECT_EQ(reused.shape_value(i, q), fresh.shape_value(i, q));
          EXPECT_LT(distance(reused.shape_grad(i, q), fresh.shape_grad(i, q)), 1e-14);
          EXPECT_LT(distance(reused.shape_hessian(i, q), fresh.shape_hessian(i, q)), 1e-13);
          EXPECT_LT(distance(reused.shape_3rd_derivative(i, q), fresh.shape_3rd_derivative(i, q)),
                    1e-12);
        }
    }
    EXPECT_GT(n_similar, 0u) << "the case this test is about did not occur";
  }

  // The two ways to evaluate agree to rounding; scale of the derivatives: per length of the cell.
  TEST(FECubicHermite, fast_shape_functions_agree_with_fe_values)
  {
    const WireSpace wire({0., 0.02, 0.7, 65.});
    const QIterated<1> quadrature(QTrapezoid<1>(), 10);
    FEValues<1, 3> fe_values(wire.fe, quadrature,
                             update_values | update_gradients | update_hessians);
    for (const auto &cell : wire.triangulation.active_cell_iterators())
    {
      fe_values.reinit(cell);
      const double h = cell->measure();
      for (unsigned int q = 0; q < quadrature.size(); ++q)
      {
        const auto shape = taut::hermite_shape(h, quadrature.point(q)[0]);
        for (unsigned int i = 0; i < 4; ++i)
        {
          const double unit = i % 2 == 0 ? 1. : h;
          EXPECT_NEAR(fe_values.shape_value(i, q) / unit, shape.value[i] / unit, 1e-14);
          EXPECT_NEAR(fe_values.shape_grad(i, q) * along * h / unit, shape.slope[i] * h / unit,
                      1e-14);
          EXPECT_NEAR(along * fe_values.shape_hessian(i, q) * along * h * h / unit,
                      shape.curvature[i] * h * h / unit, 3e-14);
        }
      }
    }
  }

  // Interpolation theory: h^4 in w, h^2 in w'' (Ciarlet, The Finite Element Method, thm. 3.1.4).
  TEST(FECubicHermite, interpolation_converges_with_order_4_and_its_curvature_with_2)
  {
    std::vector<double> value_errors, curvature_errors;
    std::vector<double> nodes = refined(unequal_nodes);
    for (unsigned int level = 0; level < 4; ++level, nodes = refined(nodes))
    {
      WireSpace wire(nodes);
      wire.interpolate([](const double s) { return std::sin(2 * s); },
                       [](const double s) { return 2 * std::cos(2 * s); });
      FEValues<1, 3> fe_values(wire.fe, QGauss<1>(6),
                               update_values | update_hessians | update_quadrature_points |
                                   update_JxW_values);
      std::vector<Tensor<2, 3>> hessians(6);
      std::vector<double> values(6);
      double squared = 0., squared_values = 0.;
      for (const auto &cell : wire.dof_handler.active_cell_iterators())
      {
        fe_values.reinit(cell);
        fe_values.get_function_hessians(wire.w, hessians);
        fe_values.get_function_values(wire.w, values);
        for (unsigned int q = 0; q < hessians.size(); ++q)
        {
          const double s = arc_length(fe_values.quadrature_point(q));
          const double error = along * hessians[q] * along + 4 * std::sin(2 * s);
          squared_values += std::pow(values[q] - std::sin(2 * s), 2) * fe_values.JxW(q);
          squared += error * error * fe_values.JxW(q);
        }
      }
      value_errors.push_back(std::sqrt(squared_values));
      curvature_errors.push_back(std::sqrt(squared));
    }
    for (unsigned int level = 1; level < value_errors.size(); ++level)
    {
      std::cout << "figure | interpolation, refinement " << level
                << ", order of displacement, curvature | "
                << order(value_errors[level - 1], value_errors[level]) << ", "
                << order(curvature_errors[level - 1], curvature_errors[level]) << '\n';
      EXPECT_NEAR(order(value_errors[level - 1], value_errors[level]), 4., 0.1);
      EXPECT_NEAR(order(curvature_errors[level - 1], curvature_errors[level]), 2., 0.1);
    }
  }

  /// A circular frequency of a simply supported beam with n_cells cells.
  double frequency(const unsigned int mode, const unsigned int n_cells, const double length,
                   const double tension, const double bending_stiffness, const double mass)
  {
    std::vector<double> nodes;
    for (unsigned int i = 0; i <= n_cells; ++i)
      nodes.push_back(i * length / n_cells);
    const Matrices matrices = assemble(WireSpace(nodes));
    // All rows are free but the first one and the last but one: the deflections of the ends.
    const unsigned int n = 2 * n_cells;
    LAPACKFullMatrix<double> stiffness(n), masses(n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
      {
        const unsigned int row = i + 1 < n ? i + 1 : n + 1, column = j + 1 < n ? j + 1 : n + 1;
        stiffness(i, j) = tension * matrices.tension(row, column) +
                          bending_stiffness * matrices.bending(row, column);
        masses(i, j) = mass * matrices.mass(row, column);
      }
    std::vector<Vector<double>> no_modes;
    stiffness.compute_generalized_eigenvalues_symmetric(masses, no_modes);
    return std::sqrt(stiffness.eigenvalue(mode - 1).real());
  }

  // omega_n^2 = (T q^2 + EI q^4) / m, q = n pi / L: the modes are sines. Order 2 (k + 1 - m) = 4
  // for degree k = 3 and a form of order 2m = 4 (Strang and Fix, An Analysis of the FEM, ch. 6).
  TEST(FECubicHermite, frequencies_of_a_tensioned_beam_converge_with_order_4)
  {
    const double length = 2., tension = 500., bending_stiffness = 130., mass = 1.35;
    for (unsigned int mode = 1; mode <= 3; ++mode)
    {
      const double q = mode * numbers::PI / length;
      const double exact = std::sqrt((tension * q * q + bending_stiffness * q * q * q * q) / mass);
      std::vector<double> errors;
      for (const unsigned int n_cells : {4, 8, 16, 32})
      {
        errors.push_back(
            frequency(mode, n_cells, length, tension, bending_stiffness, mass) / exact - 1);
        EXPECT_GT(errors.back(), 0.) << "a conforming element is too stiff, never too soft";
      }
      for (unsigned int level = 1; level < errors.size(); ++level)
      {
        std::cout << "figure | frequency " << mode << ", refinement " << level << ", order | "
                  << order(errors[level - 1], errors[level]) << '\n';
        EXPECT_NEAR(order(errors[level - 1], errors[level]), 4., 0.2) << "mode " << mode;
      }
    }
  }
} // namespace
