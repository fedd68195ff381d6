// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: what deal.II makes of the Hermite element outside Taut is right, or refused with an
// exception in Release as well. Expected values are those of a cubic, which the element holds.
#include "common.h"

#include "wire/fe_cubic_hermite.h"

#include <deal.II/base/config.h>
#include <deal.II/base/function.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_dgq.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_q_hierarchical.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_tools.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/tria.h>
#include <deal.II/hp/fe_collection.h>
#include <deal.II/hp/fe_values.h>
#include <deal.II/hp/mapping_collection.h>
#include <deal.II/hp/q_collection.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>
#include <deal.II/numerics/solution_transfer.h>
#include <deal.II/numerics/vector_tools.h>

#include <type_traits>

namespace
{
  using namespace dealii;
  using taut::FE_CubicHermite;

  /// Cells of length 0.3, 0.5 and 1.2 along the x axis: none of length 1, as the reference cell.
  template <int spacedim>
  void make_wire(Triangulation<1, spacedim> &triangulation)
  {
    std::vector<Point<spacedim>> points(4);
    const double x[] = {0., 0.3, 0.8, 2.};
    std::vector<CellData<1>> cells(3);
    for (unsigned int n = 0; n < 4; ++n)
      points[n][0] = x[n];
    for (unsigned int c = 0; c < 3; ++c)
      cells[c].vertices = {c, c + 1};
    triangulation.create_triangulation(points, cells, SubCellData());
  }

  /// 1 - 2 x + 0.7 x^2 + 0.3 x^3 in each component.
  template <int spacedim>
  class Cubic : public Function<spacedim>
  {
  public:
    explicit Cubic(const unsigned int n_components = 1) : Function<spacedim>(n_components) {}
    double value(const Point<spacedim> &p, const unsigned int = 0) const override
    {
      return 1. + p[0] * (-2. + p[0] * (0.7 + 0.3 * p[0]));
    }
    Tensor<1, spacedim> gradient(const Point<spacedim> &p, const unsigned int = 0) const override
    {
      Tensor<1, spacedim> result;
      result[0] = -2. + p[0] * (1.4 + 0.9 * p[0]);
      return result;
    }
  };

  /// In Debug an assertion of deal.II may come first, as an exception of its own.
  template <typename Work>
  void expect_refused(const std::string &what, const Work &work)
  {
#ifdef DEBUG
    deal_II_exceptions::disable_abort_on_exception();
    EXPECT_THROW(work(), ExceptionBase) << what;
#else
    try
    {
      work();
      ADD_FAILURE() << what << ": no exception";
    }
    catch (const ExcMessage &error)
    {
      EXPECT_TRUE(verification::has(error.what(), "FE_CubicHermite: ")) << what;
    }
#endif
  }

  /// The same of neighbours in hp mode. Since 9.6 deal.II ends a Release program, too, with a
  /// message, where its own element is asked first and does not know ours.
  template <typename Work>
  void expect_neighbours_refused(const std::string &what, const Work &work)
  {
#if defined(DEBUG) || !DEAL_II_VERSION_GTE(9, 6, 0)
    expect_refused(what, work);
#else
    const auto ends = [&]
    {
      try
      {
        work();
      }
      catch (const ExcMessage &error)
      {
        std::cerr << error.what();
        std::abort();
      }
    };
    EXPECT_DEATH(ends(), "FE_CubicHermite: |currently not") << what;
#endif
  }

  template <typename Dimension>
  struct FECubicHermiteOutside : testing::Test
  {
    static constexpr int spacedim = Dimension::value;

    FECubicHermiteOutside()
    {
      make_wire(triangulation);
      dof_handler.distribute_dofs(fe);
      w.reinit(dof_handler.n_dofs());
      FE_CubicHermite<1, spacedim>::interpolate(dof_handler, Cubic<spacedim>(), w);
    }

    Triangulation<1, spacedim> triangulation;
    const FE_CubicHermite<1, spacedim> fe;
    DoFHandler<1, spacedim> dof_handler{triangulation};
    Vector<double> w; ///< the cubic
  };
  using Dimensions = testing::Types<std::integral_constant<int, 1>, std::integral_constant<int, 3>>;
  TYPED_TEST_SUITE(FECubicHermiteOutside, Dimensions);

  TYPED_TEST(FECubicHermiteOutside, interpolation_matrices_to_and_from_other_elements_are_refused)
  {
    constexpr int spacedim = TypeParam::value;
    const FE_Q<1, spacedim> q(3);
    const FESystem<1, spacedim> two(this->fe, 2), two_q(q, 2);
    FullMatrix<double> small(4, 4), large(8, 8);
    expect_refused("to Q3", [&] { FETools::get_interpolation_matrix(this->fe, q, small); });
    expect_refused("from Q3", [&] { FETools::get_interpolation_matrix(q, this->fe, small); });
    expect_refused("pair to Q3", [&] { FETools::get_interpolation_matrix(two, two_q, large); });
    expect_refused("pair from Q3", [&] { FETools::get_interpolation_matrix(two_q, two, large); });
    DoFHandler<1, spacedim> dofs_q(this->triangulation);
    dofs_q.distribute_dofs(q);
    Vector<double> w_q(dofs_q.n_dofs());
    expect_refused("function to Q3",
                   [&] { FETools::interpolate(this->dof_handler, this->w, dofs_q, w_q); });
    expect_refused("function from Q3",
                   [&] { FETools::interpolate(dofs_q, w_q, this->dof_handler, this->w); });
  }

  TYPED_TEST(FECubicHermiteOutside, interpolation_to_itself_is_the_identity)
  {
    constexpr int spacedim = TypeParam::value;
    DoFHandler<1, spacedim> other(this->triangulation);
    other.distribute_dofs(this->fe);
    Vector<double> copy(other.n_dofs());
    FETools::interpolate(this->dof_handler, this->w, other, copy);
    copy -= this->w;
    EXPECT_EQ(copy.linfty_norm(), 0.);
  }

  TYPED_TEST(FECubicHermiteOutside, shape_functions_of_the_reference_cell_are_refused)
  {
    const FiniteElement<1, TypeParam::value> &fe = this->fe;
    const Point<1> p(.4);
    expect_refused("value", [&] { (void)fe.shape_value(1, p); });
    expect_refused("value of component", [&] { (void)fe.shape_value_component(1, p, 0); });
    expect_refused("gradient", [&] { (void)fe.shape_grad(1, p); });
    expect_refused("gradient of component", [&] { (void)fe.shape_grad_component(1, p, 0); });
    expect_refused("hessian", [&] { (void)fe.shape_grad_grad(1, p); });
    expect_refused("hessian of component", [&] { (void)fe.shape_grad_grad_component(1, p, 0); });
  }

  // Only lines on an axis: deal.II has no other instance of this function.
  using FECubicHermiteOutsideOnAxis = FECubicHermiteOutside<std::integral_constant<int, 1>>;
  TEST_F(FECubicHermiteOutsideOnAxis, point_values_are_those_of_the_cubic)
  {
    for (const double x : {.1, .5, 1.7})
      EXPECT_NEAR(VectorTools::point_value(dof_handler, w, Point<1>(x)),
                  Cubic<1>().value(Point<1>(x)), 1e-13);
  }

  TYPED_TEST(FECubicHermiteOutside, interpolation_of_values_is_refused)
  {
    constexpr int spacedim = TypeParam::value;
    expect_refused("VectorTools::interpolate", [&]
                   { VectorTools::interpolate(this->dof_handler, Cubic<spacedim>(), this->w); });
  }

  // Claim: beside FE_Q in one system each function refuses to set the DoFs of the Hermite element;
  // where the component mask names FE_Q only, the DoFs of FE_Q are set and no others.
  TYPED_TEST(FECubicHermiteOutside, interpolation_in_a_system_is_right_or_refused)
  {
    constexpr int spacedim = TypeParam::value;
    const FESystem<1, spacedim> system(FE_Q<1, spacedim>(3), 1, this->fe, 1);
    DoFHandler<1, spacedim> dofs(this->triangulation);
    dofs.distribute_dofs(system);
    const MappingQ<1, spacedim> mapping(1);
    const hp::MappingCollection<1, spacedim> mappings(mapping);
    const Cubic<spacedim> cubic(2);
    const ComponentMask of_q(std::vector<bool>{true, false});
    using VectorTools::interpolate;

    Vector<double> none(dofs.n_dofs());
    expect_refused("interpolate", [&] { interpolate(dofs, cubic, none); });
    expect_refused("mapping", [&] { interpolate(mapping, dofs, cubic, none); });
    expect_refused("mappings", [&] { interpolate(mappings, dofs, cubic, none); });
    expect_refused("mask of the Hermite element",
                   [&] {
                     interpolate(dofs, cubic, none, ComponentMask(std::vector<bool>{false, true}));
                   });
    std::vector<Vector<double>> masked(3, none);
    interpolate(dofs, cubic, masked[0], of_q);
    interpolate(mapping, dofs, cubic, masked[1], of_q);
    interpolate(mappings, dofs, cubic, masked[2], of_q);
    if constexpr (spacedim == 1) // deal.II has no instance for lines in space
    {
      const std::map<types::material_id, const Function<spacedim> *> functions = {{0, &cubic}};
      const auto by_material = [&](Vector<double> &values, const ComponentMask &mask)
      { VectorTools::interpolate_based_on_material_id(mapping, dofs, functions, values, mask); };
      expect_refused("by material", [&] { by_material(none, ComponentMask()); });
      masked.push_back(none);
      by_material(masked.back(), of_q);
    }
    EXPECT_EQ(none.linfty_norm(), 0.);

    std::vector<types::global_dof_index> indices(8);
    for (const auto &cell : dofs.active_cell_iterators())
    {
      cell->get_dof_indices(indices);
      for (const Vector<double> &values : masked)
        for (unsigned int i = 0; i < 8; ++i)
        {
          const auto [component, j] = system.system_to_component_index(i);
          if (component == 0 && j >= 2)
            continue;
          const double expected = component == 1 ? 0. : cubic.value(cell->vertex(j));
          EXPECT_NEAR(values(indices[i]), expected, component == 1 ? 0. : 1e-14);
        }
    }
  }

  // Claim: for lines on an axis the matrix-free projection of deal.II would take the shape
  // functions of the reference cell, and is refused; for lines in space it is the cubic.
  TYPED_TEST(FECubicHermiteOutside, projection_is_right_or_refused)
  {
    constexpr int spacedim = TypeParam::value;
    AffineConstraints<double> none;
    none.close();
    Vector<double> projected(this->w.size());
    const auto project = [&]
    { VectorTools::project(this->dof_handler, none, QGauss<1>(5), Cubic<spacedim>(), projected); };
    if (spacedim == 1)
      expect_refused("VectorTools::project", project);
    else
    {
      project();
      projected -= this->w;
      EXPECT_LT(projected.linfty_norm(), 1e-9);
    }
  }

  TYPED_TEST(FECubicHermiteOutside, solution_transfer_is_refused)
  {
    constexpr int spacedim = TypeParam::value;
    for (const bool coarsen : {false, true})
      expect_refused(coarsen ? "to a coarser mesh" : "to a finer mesh",
                     [&]
                     {
                       Vector<double> old(this->dof_handler.n_dofs());
                       SolutionTransfer<1, Vector<double>, spacedim> transfer(this->dof_handler);
                       for (const auto &cell : this->triangulation.active_cell_iterators())
                         if (coarsen && cell->level() > 0)
                           cell->set_coarsen_flag();
                         else if (!coarsen)
                           cell->set_refine_flag();
                       this->triangulation.prepare_coarsening_and_refinement();
                       transfer.prepare_for_coarsening_and_refinement(old);
                       this->triangulation.execute_coarsening_and_refinement();
                       this->dof_handler.distribute_dofs(this->fe);
                       Vector<double> transferred(this->dof_handler.n_dofs());
                       transfer.interpolate(old, transferred);
                     });
  }

  TYPED_TEST(FECubicHermiteOutside, boundary_values_are_refused_by_each_function)
  {
    constexpr int spacedim = TypeParam::value;
    const DoFHandler<1, spacedim> &dofs = this->dof_handler;
    const Cubic<spacedim> cubic;
    const std::map<types::boundary_id, const Function<spacedim> *> functions = {{0, &cubic}};
    const MappingQ<1, spacedim> mapping(1);
    const hp::MappingCollection<1, spacedim> mappings(mapping);
    std::map<types::global_dof_index, double> values;
    AffineConstraints<double> constraints;
    using VectorTools::interpolate_boundary_values;
    const auto refused = [&](const std::string &what, const auto &...arguments)
    {
      expect_refused(what, [&] { interpolate_boundary_values(arguments..., values); });
      expect_refused(what, [&] { interpolate_boundary_values(arguments..., constraints); });
    };
    refused("one", dofs, 0, cubic);
    refused("all", dofs, functions);
    refused("mapping, one", mapping, dofs, 0, cubic);
    refused("mapping, all", mapping, dofs, functions);
    refused("mappings, one", mappings, dofs, 0, cubic);
    refused("mappings, all", mappings, dofs, functions);
    EXPECT_TRUE(values.empty());
    EXPECT_EQ(constraints.n_constraints(), 0u);
  }

  // Claim: FE_Q has its boundary values, alone and in a system if the mask names FE_Q only.
  TYPED_TEST(FECubicHermiteOutside, boundary_values_of_other_elements_stay)
  {
    constexpr int spacedim = TypeParam::value;
    DoFHandler<1, spacedim> dofs(this->triangulation);
    std::map<types::global_dof_index, double> values;
    const double end = Cubic<spacedim>().value(this->triangulation.last_active()->vertex(1));
    const auto expect_end = [&](const Cubic<spacedim> &cubic, const ComponentMask &mask)
    {
      values.clear();
      VectorTools::interpolate_boundary_values(dofs, 1, cubic, values, mask);
      ASSERT_EQ(values.size(), 1u);
      EXPECT_NEAR(values.begin()->second, end, 1e-14);
    };
    dofs.distribute_dofs(FE_Q<1, spacedim>(2));
    expect_end(Cubic<spacedim>(), ComponentMask());
    dofs.distribute_dofs(FESystem<1, spacedim>(FE_Q<1, spacedim>(2), 1, this->fe, 1));
    expect_end(Cubic<spacedim>(2), ComponentMask(std::vector<bool>{true, false}));
    expect_refused(
        "mask with the Hermite element",
        [&] { VectorTools::interpolate_boundary_values(dofs, 1, Cubic<spacedim>(2), values); });
  }

  /// DoFs that cells share in hp mode at inner vertices, with two elements in turn; evaluates all.
  template <int spacedim>
  unsigned int n_shared(const Triangulation<1, spacedim> &triangulation,
                        const hp::FECollection<1, spacedim> &elements)
  {
    DoFHandler<1, spacedim> dofs(triangulation);
    unsigned int n_cell_dofs = 0;
    for (const auto &cell : dofs.active_cell_iterators())
    {
      cell->set_active_fe_index(cell->active_cell_index() % 2);
      n_cell_dofs += elements[cell->active_fe_index()].n_dofs_per_cell();
    }
    dofs.distribute_dofs(elements);
    hp::FEValues<1, spacedim> fe_values(elements, hp::QCollection<1>(QGauss<1>(2)), update_values);
    for (const auto &cell : dofs.active_cell_iterators())
      fe_values.reinit(cell);
    return n_cell_dofs - dofs.n_dofs();
  }

  // Claim: in hp mode two Hermite elements share value and slope; with others it shares none.
  TYPED_TEST(FECubicHermiteOutside, neighbours_in_hp_mode_share_value_and_slope)
  {
    constexpr int spacedim = TypeParam::value;
    using Elements = hp::FECollection<1, spacedim>;
    EXPECT_EQ(n_shared(this->triangulation, Elements(this->fe, this->fe)), 4u);
    const FE_DGQ<1, spacedim> discontinuous(2);
    EXPECT_EQ(n_shared(this->triangulation, Elements(this->fe, discontinuous)), 0u);
#ifndef DEBUG // deal.II asks the first element, which asserts that it knows the other
    EXPECT_EQ(n_shared(this->triangulation, Elements(discontinuous, this->fe)), 0u);
#endif
  }

  // Claim: beside elements that would share a value it is refused, in any order, in systems too.
  TYPED_TEST(FECubicHermiteOutside, continuous_neighbours_in_hp_mode_are_refused)
  {
    constexpr int spacedim = TypeParam::value;
    using Elements = hp::FECollection<1, spacedim>;
    const FE_Q<1, spacedim> q(2);
    const FESystem<1, spacedim> pair(this->fe, 2), pair_q(q, 2);
    for (const Elements &elements : {Elements(this->fe, q), Elements(q, this->fe),
                                     Elements(pair, pair_q), Elements(pair_q, pair)})
      expect_neighbours_refused("beside " + elements[0].get_name() + " or " +
                                    elements[1].get_name(),
                                [&] { n_shared(this->triangulation, elements); });
  }

  TEST(FECubicHermiteOutsideHp, a_hierarchical_neighbour_is_refused)
  {
    Triangulation<1> triangulation;
    make_wire(triangulation);
    const FE_CubicHermite<1> fe;
    const FE_Q_Hierarchical<1> other(2);
    for (const auto &elements : {hp::FECollection<1>(fe, other), hp::FECollection<1>(other, fe)})
      expect_neighbours_refused("FE_Q_Hierarchical", [&] { n_shared(triangulation, elements); });
  }
} // namespace
