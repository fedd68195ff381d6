// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: the Hermite element agrees with polynomials, textbook matrices and frequencies of a beam.
#include "common.h"

#include "wire/fe_cubic_hermite.h"
#include "wire/hermite_shape.h"

#include <deal.II/base/function.h>
#include <deal.II/base/multithread_info.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/manifold_lib.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>
#include <deal.II/numerics/data_out.h>
#include <deal.II/numerics/vector_tools.h>

namespace
{
  using namespace dealii;
  using taut::FE_CubicHermite;

  const std::vector<double> unequal_nodes = {0., 0.3, 0.8, 2.1, 2.4, 4.};

  /// A direction without zero components; the x axis for spacedim = 1.
  template <int spacedim>
  Tensor<1, spacedim> wire_direction()
  {
    Tensor<1, spacedim> direction;
    for (unsigned int d = 0; d < spacedim; ++d)
      direction[d] = 1. - 1.3 * d + 0.5 * d * d;
    return direction / direction.norm();
  }

  template <int spacedim>
  Point<spacedim> wire_start()
  {
    Point<spacedim> start;
    for (unsigned int d = 0; d < spacedim; ++d)
      start[d] = 0.25 - 0.5 * d;
    return start;
  }

  /// A straight wire with the given nodes; the named cells run against it.
  template <int spacedim>
  void make_wire(const std::vector<double> &nodes, Triangulation<1, spacedim> &triangulation,
                 const std::set<unsigned int> &backward_cells = {})
  {
    std::vector<Point<spacedim>> points;
    for (const double s : nodes)
      points.push_back(wire_start<spacedim>() + s * wire_direction<spacedim>());
    std::vector<CellData<1>> cells(nodes.size() - 1);
    for (unsigned int c = 0; c < cells.size(); ++c)
    {
      const unsigned int is_backward = backward_cells.count(c);
      cells[c].vertices = {c + is_backward, c + 1 - is_backward};
    }
    triangulation.create_triangulation(points, cells, SubCellData());
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

  /// A function of the arc length of the wire, as a function in space.
  template <int spacedim>
  class AlongWire : public Function<spacedim>
  {
  public:
    using Scalar = std::function<double(double)>;

    AlongWire(const Scalar &value, const Scalar &slope) : along_value(value), along_slope(slope) {}

    double value(const Point<spacedim> &p, const unsigned int = 0) const override
    {
      return along_value(arc_length(p));
    }
    Tensor<1, spacedim> gradient(const Point<spacedim> &p, const unsigned int = 0) const override
    {
      return along_slope(arc_length(p)) * wire_direction<spacedim>();
    }
    static double arc_length(const Point<spacedim> &p)
    {
      return (p - wire_start<spacedim>()) * wire_direction<spacedim>();
    }

  private:
    Scalar along_value, along_slope;
  };

  /// The element on a wire, and a vector of its DoFs.
  template <int spacedim>
  struct WireSpace
  {
    explicit WireSpace(const std::vector<double> &nodes = unequal_nodes,
                       const std::set<unsigned int> &backward_cells = {})
    {
      make_wire(nodes, triangulation, backward_cells);
      distribute();
    }

    void distribute()
    {
      dof_handler.distribute_dofs(fe);
      w.reinit(dof_handler.n_dofs());
    }

    void interpolate(const AlongWire<spacedim> &function)
    {
      FE_CubicHermite<1, spacedim>::interpolate(dof_handler, function, w);
    }

    Triangulation<1, spacedim> triangulation;
    const FE_CubicHermite<1, spacedim> fe;
    DoFHandler<1, spacedim> dof_handler{triangulation};
    Vector<double> w;
  };

  /// Cells that run backward, where the space has room for them.
  template <int spacedim>
  std::set<unsigned int> backward(const std::set<unsigned int> &cells)
  {
    return spacedim > 1 ? cells : std::set<unsigned int>();
  }

  const auto cubic = [](const double s) { return 1. - 2. * s + 0.7 * s * s + 0.3 * s * s * s; };
  const auto cubic_slope = [](const double s) { return -2. + 1.4 * s + 0.9 * s * s; };
  const auto cubic_curvature = [](const double s) { return 1.4 + 1.8 * s; };
  const double cubic_third = 1.8;

  const auto distance = [](const auto &a, const auto &b) { return (a - b).norm(); };

  template <int spacedim>
  void expect_cubic_reproduced(WireSpace<spacedim> &wire)
  {
    wire.distribute();
    wire.interpolate({cubic, cubic_slope});
    FEValues<1, spacedim> fe_values(wire.fe, QGauss<1>(5),
                                    update_values | update_gradients | update_hessians |
                                        update_3rd_derivatives | update_quadrature_points);
    std::vector<double> values(5);
    std::vector<Tensor<1, spacedim>> gradients(5);
    std::vector<Tensor<2, spacedim>> hessians(5);
    std::vector<Tensor<3, spacedim>> thirds(5);
    const auto t = wire_direction<spacedim>();
    for (const auto &cell : wire.dof_handler.active_cell_iterators())
    {
      fe_values.reinit(cell);
      fe_values.get_function_values(wire.w, values);
      fe_values.get_function_gradients(wire.w, gradients);
      fe_values.get_function_hessians(wire.w, hessians);
      fe_values.get_function_third_derivatives(wire.w, thirds);
      for (unsigned int q = 0; q < values.size(); ++q)
      {
        const double s = AlongWire<spacedim>::arc_length(fe_values.quadrature_point(q));
        EXPECT_NEAR(values[q], cubic(s), 1e-13);
        EXPECT_LT(distance(gradients[q], cubic_slope(s) * t), 1e-12);
        EXPECT_LT(distance(hessians[q], cubic_curvature(s) * outer_product(t, t)), 1e-11);
        EXPECT_LT(distance(thirds[q], cubic_third * outer_product(t, outer_product(t, t))), 1e-9);
      }
    }
  }

  struct Matrices
  {
    FullMatrix<double> mass, bending, tension; ///< for unit mass, bending stiffness, tension
  };

  /// The matrices of the whole wire through FEValues; row 2 vertex + component.
  template <int spacedim>
  Matrices assemble(const WireSpace<spacedim> &wire)
  {
    FEValues<1, spacedim> fe_values(wire.fe, QGauss<1>(4),
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

  template <typename Dimension>
  class FECubicHermiteIn : public testing::Test
  {
  };
  using SpaceDimensions =
      testing::Types<std::integral_constant<int, 1>, std::integral_constant<int, 2>,
                     std::integral_constant<int, 3>>;
  TYPED_TEST_SUITE(FECubicHermiteIn, SpaceDimensions, );

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

  // The name and the count of DoFs are those of the element of the same name in newer deal.II.
  TEST(FECubicHermite, looks_like_a_deal_ii_element)
  {
    const FE_CubicHermite<1, 3> fe(3);
    EXPECT_EQ(fe.get_name(), "FE_CubicHermite<1,3>(3)");
    EXPECT_EQ((FE_CubicHermite<1>(3).get_name()), "FE_CubicHermite<1>(3)");
    EXPECT_EQ(fe.clone()->get_name(), fe.get_name());
    EXPECT_EQ(fe.n_dofs_per_vertex(), 2u);
    EXPECT_EQ(fe.n_dofs_per_cell(), 4u);
    EXPECT_EQ(fe.degree, 3u);
    EXPECT_FALSE(fe.has_support_points());
    EXPECT_ANY_THROW((FE_CubicHermite<1, 3>(5)));
  }

  // A cubic is in the space whatever the lengths of the cells, with three derivatives; spacedim > 1
  // is an inclined line, where they are t w', t x t w'', t x t x t w'''.
  // Refining some cells only changes nothing about it.
  TYPED_TEST(FECubicHermiteIn, cubics_are_reproduced_on_unequal_cells)
  {
    WireSpace<TypeParam::value> wire;
    expect_cubic_reproduced(wire);
    wire.triangulation.begin_active()->set_refine_flag();
    wire.triangulation.last_active()->set_refine_flag();
    wire.triangulation.execute_coarsening_and_refinement();
    ASSERT_EQ(wire.triangulation.n_active_cells(), 7u);
    expect_cubic_reproduced(wire);
  }

  // Value and slope are the same from both sides of a node for arbitrary DoFs: C1 by definition.
  TYPED_TEST(FECubicHermiteIn, slopes_are_continuous_across_unequal_cells)
  {
    constexpr int spacedim = TypeParam::value;
    WireSpace<spacedim> wire(unequal_nodes, backward<spacedim>({2, 3}));
    Vector<double> &w = wire.w;
    for (unsigned int i = 0; i < w.size(); ++i)
      w(i) = std::sin(1. + 7. * i);
    FEValues<1, spacedim> fe_values(wire.fe, QTrapezoid<1>(), update_values | update_gradients);
    std::map<unsigned int, std::pair<double, Tensor<1, spacedim>>> from_one_side;
    unsigned int n_compared = 0;
    std::vector<double> values(2);
    std::vector<Tensor<1, spacedim>> gradients(2);
    for (const auto &cell : wire.dof_handler.active_cell_iterators())
    {
      fe_values.reinit(cell);
      fe_values.get_function_values(w, values);
      fe_values.get_function_gradients(w, gradients);
      for (unsigned int v = 0; v < 2; ++v)
      {
        EXPECT_NEAR(gradients[v] * wire_direction<spacedim>(), w(cell->vertex_dof_index(v, 1)),
                    1e-14);
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
  TYPED_TEST(FECubicHermiteIn, element_matrices_are_the_textbook_ones)
  {
    for (const double h : {0.7, 2.3})
    {
      const Matrices matrices = assemble(WireSpace<TypeParam::value>({0., h}));
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

  // The order of the vertices of a cell is no physics: same matrices as on the ordered mesh.
  TEST(FECubicHermite, backward_cells_change_no_matrix)
  {
    WireSpace<3> mixed(unequal_nodes, {1, 2, 4});
    const Matrices expected = assemble(WireSpace<3>()), matrices = assemble(mixed);
    for (const auto part : {&Matrices::mass, &Matrices::bending, &Matrices::tension})
      for (unsigned int i = 0; i < expected.mass.m(); ++i)
        for (unsigned int j = 0; j < expected.mass.n(); ++j)
          EXPECT_NEAR((matrices.*part)(i, j), (expected.*part)(i, j),
                      1e-13 * std::sqrt((expected.*part)(i, i) * (expected.*part)(j, j)));
    expect_cubic_reproduced(mixed);
    mixed.triangulation.refine_global(1);
    expect_cubic_reproduced(mixed);
  }

  // A wire runs as its first cell does: if that one is backward, the signs of all slopes change.
  TEST(FECubicHermite, first_cell_gives_the_wire_its_direction)
  {
    WireSpace<3> wire(unequal_nodes, {0});
    auto cell = wire.triangulation.begin_active();
    EXPECT_NEAR((FE_CubicHermite<1, 3>::signed_length(cell)), 0.3, 1e-15);
    EXPECT_NEAR((FE_CubicHermite<1, 3>::signed_length(++cell)), -0.5, 1e-15);
    wire.interpolate({cubic, cubic_slope});
    for (const auto &cell : wire.dof_handler.active_cell_iterators())
      for (unsigned int v = 0; v < 2; ++v)
        EXPECT_NEAR(wire.w(cell->vertex_dof_index(v, 1)),
                    -cubic_slope(AlongWire<3>::arc_length(cell->vertex(v))), 1e-13);
    expect_cubic_reproduced(wire);
    // Refinement does not turn it around, even where another cell is then the first active one.
    Triangulation<1, 3> &triangulation = wire.triangulation;
    triangulation.begin_active()->set_refine_flag();
    triangulation.execute_coarsening_and_refinement();
    const auto first_active = triangulation.begin_active();
    ASSERT_EQ(first_active->level(), 0);
    EXPECT_NEAR((FE_CubicHermite<1, 3>::signed_length(first_active)), -0.5, 1e-15);
    EXPECT_NEAR((FE_CubicHermite<1, 3>::signed_length(triangulation.last_active())), 0.15, 1e-15);
    expect_cubic_reproduced(wire);
  }

  // No sign can be given to the slopes of a cell that stands across its wire.
  TEST(FECubicHermite, sharp_bends_are_refused)
  {
    Triangulation<1, 3> triangulation;
    std::vector<CellData<1>> cells(2);
    cells[0].vertices = {0, 1};
    cells[1].vertices = {1, 2};
    triangulation.create_triangulation({Point<3>(0, 0, 0), Point<3>(1, 0, 0), Point<3>(1, 0, 1)},
                                       cells, SubCellData());
    EXPECT_NO_THROW((FE_CubicHermite<1, 3>::signed_length(triangulation.begin_active())));
    EXPECT_THROW((FE_CubicHermite<1, 3>::signed_length(triangulation.last_active())),
                 taut::UserError);
  }

#ifdef DEBUG
  // On an arc, s is not proportional to xi: the slopes would not be derivatives by arc length.
  TEST(FECubicHermite, curved_cells_are_refused_in_debug_mode)
  {
    deal_II_exceptions::disable_abort_on_exception();
    Triangulation<1, 2> triangulation;
    std::vector<CellData<1>> cells(1);
    cells[0].vertices = {0, 1};
    triangulation.create_triangulation({Point<2>(1, 0), Point<2>(0, 1)}, cells, SubCellData());
    const FE_CubicHermite<1, 2> fe;
    FEValues<1, 2> straight(fe, QGauss<1>(2), update_values);
    EXPECT_NO_THROW(straight.reinit(triangulation.begin_active()));
    triangulation.set_all_manifold_ids(0);
    triangulation.set_manifold(0, SphericalManifold<1, 2>());
    const MappingQ<1, 2> mapping(2);
    FEValues<1, 2> curved(mapping, fe, QGauss<1>(2), update_values);
    EXPECT_ANY_THROW(curved.reinit(triangulation.begin_active()));
  }
#endif

  // deal.II integrates backwards over a cell against x in one dimension: JxW < 0.
  TEST(FECubicHermite, cells_against_x_are_refused_in_one_dimension)
  {
    Triangulation<1> triangulation;
    make_wire({0., 1., 2.}, triangulation, {1});
    EXPECT_THROW((FE_CubicHermite<1>::signed_length(triangulation.last_active())), taut::UserError);
  }

  // One FEValues for all cells gives what a fresh one for each cell gives. Equal neighbours are
  // similar for deal.II (only with one thread), and the base class then keeps what it has.
  TYPED_TEST(FECubicHermiteIn, fe_values_can_be_reused_across_cells)
  {
    constexpr int spacedim = TypeParam::value;
    MultithreadInfo::set_thread_limit(1);
    const WireSpace<spacedim> wire({0., 1., 2., 3., 5., 7., 7.5, 8., 9.}, backward<spacedim>({2}));
    const QGauss<1> quadrature(3);
    const UpdateFlags flags = update_values | update_gradients | update_hessians |
                              update_3rd_derivatives | update_JxW_values;
    FEValues<1, spacedim> reused(wire.fe, quadrature, flags);
    unsigned int n_similar = 0;
    for (const auto &cell : wire.triangulation.active_cell_iterators())
    {
      reused.reinit(cell);
      n_similar += reused.get_cell_similarity() != CellSimilarity::none;
      FEValues<1, spacedim> fresh(wire.fe, quadrature, flags);
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
  TYPED_TEST(FECubicHermiteIn, fast_shape_functions_agree_with_fe_values)
  {
    constexpr int spacedim = TypeParam::value;
    const WireSpace<spacedim> wire({0., 0.02, 0.7, 65.}, backward<spacedim>({1, 2}));
    const QIterated<1> quadrature(QTrapezoid<1>(), 10);
    FEValues<1, spacedim> fe_values(wire.fe, quadrature,
                                    update_values | update_gradients | update_hessians);
    const auto t = wire_direction<spacedim>();
    for (const auto &cell : wire.triangulation.active_cell_iterators())
    {
      fe_values.reinit(cell);
      const double signed_h = FE_CubicHermite<1, spacedim>::signed_length(cell);
      const double h = std::abs(signed_h);
      for (unsigned int q = 0; q < quadrature.size(); ++q)
      {
        const auto shape = taut::hermite_shape(signed_h, quadrature.point(q)[0]);
        for (unsigned int i = 0; i < 4; ++i)
        {
          const double unit = i % 2 == 0 ? 1. : h;
          EXPECT_NEAR(fe_values.shape_value(i, q) / unit, shape.value[i] / unit, 1e-14);
          EXPECT_NEAR(fe_values.shape_grad(i, q) * t * h / unit, shape.slope[i] * h / unit, 1e-14);
          EXPECT_NEAR(t * fe_values.shape_hessian(i, q) * t * h * h / unit,
                      shape.curvature[i] * h * h / unit, 3e-14);
        }
      }
    }
  }

  // On faces, too, the slope function has slope 1 and value 0 at its own vertex.
  TYPED_TEST(FECubicHermiteIn, face_values_are_nodal)
  {
    constexpr int spacedim = TypeParam::value;
    const WireSpace<spacedim> wire(unequal_nodes, backward<spacedim>({2}));
    FEFaceValues<1, spacedim> fe_values(wire.fe, QGauss<0>(1), update_values | update_gradients);
    for (const auto &cell : wire.triangulation.active_cell_iterators())
      for (const unsigned int face : cell->face_indices())
      {
        fe_values.reinit(cell, face);
        for (unsigned int i = 0; i < 4; ++i)
        {
          EXPECT_NEAR(fe_values.shape_value(i, 0), i == 2 * face ? 1. : 0., 1e-15);
          EXPECT_NEAR(fe_values.shape_grad(i, 0) * wire_direction<spacedim>(),
                      i == 2 * face + 1 ? 1. : 0., 1e-14);
        }
      }
  }

  // Two planes of motion as one system of two elements: each component reproduces its own cubic.
  TEST(FECubicHermite, works_inside_a_system)
  {
    const WireSpace<3> wire;
    const FESystem<1, 3> system(wire.fe, 2);
    FEValues<1, 3> scalar_values(wire.fe, QGauss<1>(3), update_values | update_hessians);
    FEValues<1, 3> system_values(system, QGauss<1>(3), update_values | update_hessians);
    for (const auto &cell : wire.triangulation.active_cell_iterators())
    {
      scalar_values.reinit(cell);
      system_values.reinit(cell);
      for (unsigned int i = 0; i < system.n_dofs_per_cell(); ++i)
      {
        const auto [component, j] = system.system_to_component_index(i);
        for (unsigned int q = 0; q < 3; ++q)
        {
          EXPECT_EQ(system_values.shape_value_component(i, q, component),
                    scalar_values.shape_value(j, q));
          EXPECT_EQ(system_values.shape_hessian_component(i, q, component),
                    scalar_values.shape_hessian(j, q));
        }
      }
    }
  }

  // A node couples with itself and its neighbours, 2 DoFs each: half-bandwidth 3, 12 entries each.
  TEST(FECubicHermite, matrices_are_block_tridiagonal)
  {
    const WireSpace<3> wire;
    const DoFHandler<1, 3> &dof_handler = wire.dof_handler;
    ASSERT_EQ(dof_handler.n_dofs(), 12u);
    DynamicSparsityPattern pattern(dof_handler.n_dofs());
    DoFTools::make_sparsity_pattern(dof_handler, pattern);
    EXPECT_EQ(pattern.bandwidth(), 3u);
    EXPECT_EQ(pattern.n_nonzero_elements(), 4u * (6 + 2 * 5));
  }

  class PatchesOf : public DataOut<1, 3>
  {
  public:
    using DataOut<1, 3>::get_patches;
  };

  // Output in space: with subdivisions a patch shows the cubic inside a cell, not only its ends.
  TEST(FECubicHermite, data_out_shows_the_cubic_inside_cells)
  {
    WireSpace<3> wire;
    wire.interpolate({cubic, cubic_slope});
    PatchesOf data_out;
    data_out.attach_dof_handler(wire.dof_handler);
    data_out.add_data_vector(wire.w, "w");
    data_out.build_patches(4);
    ASSERT_EQ(data_out.get_patches().size(), wire.triangulation.n_active_cells());
    for (const auto &patch : data_out.get_patches())
      for (unsigned int p = 0; p <= 4; ++p)
      {
        const double xi = p / 4.;
        const Point<3> point = patch.vertices[0] + xi * (patch.vertices[1] - patch.vertices[0]);
        EXPECT_NEAR(patch.data(0, p), cubic(AlongWire<3>::arc_length(point)), 1e-5)
            << "patches are in single precision";
      }
  }

  // Interpolation theory: h^4 in w, h^2 in w'' (Ciarlet, The Finite Element Method, thm. 3.1.4).
  TYPED_TEST(FECubicHermiteIn, interpolation_converges_with_order_4_and_its_curvature_with_2)
  {
    constexpr int spacedim = TypeParam::value;
    const AlongWire<spacedim> sine([](const double s) { return std::sin(2 * s); },
                                   [](const double s) { return 2 * std::cos(2 * s); });
    const auto t = wire_direction<spacedim>();
    std::vector<double> value_errors, curvature_errors;
    std::vector<double> nodes = refined(unequal_nodes);
    for (unsigned int level = 0; level < 4; ++level, nodes = refined(nodes))
    {
      WireSpace<spacedim> wire(nodes);
      wire.interpolate(sine);
      Vector<double> cell_errors(wire.triangulation.n_active_cells());
      VectorTools::integrate_difference(wire.dof_handler, wire.w, sine, cell_errors, QGauss<1>(6),
                                        VectorTools::L2_norm);
      value_errors.push_back(cell_errors.l2_norm());
      FEValues<1, spacedim> fe_values(
          wire.fe, QGauss<1>(6), update_hessians | update_quadrature_points | update_JxW_values);
      std::vector<Tensor<2, spacedim>> hessians(6);
      double squared = 0;
      for (const auto &cell : wire.dof_handler.active_cell_iterators())
      {
        fe_values.reinit(cell);
        fe_values.get_function_hessians(wire.w, hessians);
        for (unsigned int q = 0; q < hessians.size(); ++q)
        {
          const double s = AlongWire<spacedim>::arc_length(fe_values.quadrature_point(q));
          const double error = t * hessians[q] * t + 4 * std::sin(2 * s);
          squared += error * error * fe_values.JxW(q);
        }
      }
      curvature_errors.push_back(std::sqrt(squared));
    }
    for (unsigned int level = 1; level < value_errors.size(); ++level)
    {
      std::cout << "figure | interpolation in " << spacedim << " dimensions, refinement " << level
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
    const Matrices matrices = assemble(WireSpace<3>(nodes));
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
