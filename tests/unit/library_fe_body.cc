// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: a model of deal.II that does not fit its DoFHandler is one UserError that names the body;
// one that fits hangs as it should. Source: the table below; a bar under its weight.
#include "common.h"

#include <taut/substructure/check_body.h>
#include <taut/substructure/fe_body.h>
#include <taut/time/stepper.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/numerics/matrix_tools.h>

namespace
{
  using namespace verification;
  using namespace dealii;

  const auto names = [](const std::string &message, const std::string &part)
  { return has(message, part); };

  constexpr double EA = 1e3, weight = 20.; ///< [N; N/m]
  constexpr unsigned int n_cells = 8;      ///< of 1 m together

  /// A bar from x = 0, where it is held, that its weight pulls along x.
  struct Bar
  {
    Triangulation<1> mesh;
    FE_Q<1> element{1};
    DoFHandler<1> dofs{mesh};
    AffineConstraints<double> constraints;
    SparsityPattern pattern, large_pattern;
    SparseMatrix<double> M, C, K;
    Vector<double> load;

    Bar()
    {
      GridGenerator::subdivided_hyper_cube(mesh, n_cells);
      dofs.distribute_dofs(element);
      constraints.add_line(0);
      constraints.close();
      DynamicSparsityPattern entries(dofs.n_dofs());
      DoFTools::make_sparsity_pattern(dofs, entries);
      pattern.copy_from(entries);
      large_pattern.copy_from(DynamicSparsityPattern(dofs.n_dofs() + 3));
      for (auto *matrix : {&M, &K})
        matrix->reinit(pattern);
      load.reinit(dofs.n_dofs());
      std::vector<types::global_dof_index> on_cell(2);
      const double h = 1. / n_cells;
      for (const auto &cell : dofs.active_cell_iterators())
      {
        cell->get_dof_indices(on_cell);
        for (const unsigned int i : {0, 1})
        {
          M.add(on_cell[i], on_cell[i], .5 * h);
          load[on_cell[i]] += .5 * weight * h;
          for (const unsigned int j : {0, 1})
            K.add(on_cell[i], on_cell[j], (i == j ? 1. : -1.) * EA / h);
        }
      }
    }

    std::unique_ptr<taut::FEBody<1>> make() const
    {
      taut::FEBody<1>::Options options;
      options.direction = {1., 0., 0.};
      return std::make_unique<taut::FEBody<1>>("bar", dofs, M, C, K, constraints, load, options);
    }
  };
} // namespace

TEST(LibraryFEBody, a_bar_hangs)
{
  const Bar bar;
  taut::System system;
  const std::size_t body = system.add("bar", [&] { return bar.make(); });
  const taut::Stepper stepper(system);
  for (const double x : {.125, .5, 1.})
    EXPECT_NEAR(stepper.displacement(system.displacement(body, {x}, {1., 0., 0.})),
                weight * (x - .5 * x * x) / EA, 1e-14);
  EXPECT_EQ(taut::check_body(*system.body(body), std::vector<double>(n_cells + 1, .01)),
            std::vector<std::string>());
}

TEST(LibraryFEBody, what_does_not_fit_is_named)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::function<void(Bar &)> spoils[] = {
      [](Bar &bar) { bar.M.clear(); },
      [](Bar &bar) { bar.M.reinit(bar.large_pattern); },
      [](Bar &bar) { bar.K.reinit(bar.large_pattern); },
      [](Bar &bar) { bar.C.reinit(bar.large_pattern); },
      [](Bar &bar) { bar.K.add(3, 4, 1.); },
      [](Bar &bar) { bar.M.add(2, 2, -1.); },
      [](Bar &bar) { bar.load.reinit(3); },
      [=](Bar &bar) { bar.load[1] = nan; },
      [=](Bar &bar) { bar.K.add(1, 1, nan); },
  };
  for (const auto &spoil : spoils)
  {
    Bar bar;
    EXPECT_EQ(error_of([&] { bar.make(); }), "");
    spoil(bar);
    EXPECT_PRED2(names, error_of([&] { bar.make(); }), "body 'bar'");
  }
}

TEST(LibraryFEBody, calls_that_do_not_fit_are_named)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  using Motion = std::function<double(double)>;
  const std::map<types::global_dof_index, Motion> far = {{100000, {}}}, without_motion = {{4, {}}};
  const taut::Coordinates outside = {2., 0., 0.};
  const std::function<void(taut::FEBody<1> &)> calls[] = {
      [](taut::FEBody<1> &body) { body.displacement_of_dof(100000); },
      [&](taut::FEBody<1> &body) { body.prescribe(far); },
      [&](taut::FEBody<1> &body) { body.prescribe(without_motion); },
      [](taut::FEBody<1> &body) { body.add_load(nullptr); },
      [](taut::FEBody<1> &body) { body.add_constant_load(Vector<double>(2)); },
      [=](taut::FEBody<1> &body)
      {
        Vector<double> load(n_cells + 1);
        load[2] = nan;
        body.add_constant_load(load);
      },
      [](taut::FEBody<1> &body) { body.set_initial_state(Vector<double>(2), Vector<double>(2)); },
      [&](taut::FEBody<1> &body) { body.displacement(outside, outside); }};
  const Bar bar;
  for (const auto &call : calls)
    EXPECT_PRED2(names, error_of([&] { call(*bar.make()); }), "body 'bar'");
}

// A displacement that the constraints prescribe is no motion in time: it is where the support is,
// and stays what watches the energy. u = u0 + weight (x - x^2 / 2) / EA.
TEST(LibraryFEBody, an_inhomogeneity_is_a_constant_displacement)
{
  for (const double given : {.02, -3.5})
  {
    Bar bar;
    AffineConstraints<double> displaced;
    displaced.add_line(0);
    displaced.set_inhomogeneity(0, given);
    displaced.close();
    bar.constraints.copy_from(displaced);
    taut::System system;
    const std::size_t body = system.add("bar", [&] { return bar.make(); });
    EXPECT_FALSE(system.body(body)->has_moving_constraints());
    EXPECT_TRUE(system.body(body)->has_displaced_constraints());
    const taut::Stepper stepper(system);
    EXPECT_NEAR(stepper.displacement(system.displacement(body, {.5}, {1., 0., 0.})),
                given + weight * .375 / EA, 1e-13);
    // prescribe_displacements() replaces it.
    const auto moved = bar.make();
    moved->prescribe_displacements({{0, 2. * given}});
    EXPECT_EQ(moved->constraints().front().at(7.), 2. * given);
  }
}

namespace
{
  /// A membrane of 2 m x 1 m with unit tension; its left half is refined, so that the line x = 1
  /// has hanging nodes. Its lower and its upper edge are prescribed.
  struct Membrane
  {
    Triangulation<2> mesh;
    FE_Q<2> element;
    DoFHandler<2> dofs{mesh};
    AffineConstraints<double> constraints;
    SparsityPattern pattern;
    SparseMatrix<double> M, C, K;
    std::vector<Point<2>> points;
    std::vector<types::global_dof_index> edges;

    explicit Membrane(const unsigned int degree) : element(degree)
    {
      GridGenerator::subdivided_hyper_rectangle(mesh, {2, 1}, Point<2>(0., 0.), Point<2>(2., 1.));
      mesh.begin_active()->set_refine_flag();
      mesh.execute_coarsening_and_refinement();
      dofs.distribute_dofs(element);
      points.resize(dofs.n_dofs());
      DoFTools::map_dofs_to_support_points(MappingQ1<2>(), dofs, points);
      DoFTools::make_hanging_node_constraints(dofs, constraints);
      for (types::global_dof_index i = 0; i < dofs.n_dofs(); ++i)
        if (std::fabs(points[i][1] * (1. - points[i][1])) < 1e-12)
        {
          constraints.add_line(i);
          edges.push_back(i);
        }
      DynamicSparsityPattern entries(dofs.n_dofs());
      DoFTools::make_sparsity_pattern(dofs, entries);
      pattern.copy_from(entries);
      for (auto *matrix : {&M, &K})
        matrix->reinit(pattern);
      MatrixCreator::create_mass_matrix(dofs, QGauss<2>(degree + 1), M);
      MatrixCreator::create_laplace_matrix(dofs, QGauss<2>(degree + 1), K);
    }

    std::unique_ptr<taut::FEBody<2>> make() const
    {
      return std::make_unique<taut::FEBody<2>>("skin", dofs, M, C, K, constraints);
    }
  };
} // namespace

// Prescribed edges take hanging nodes with them: the displacement a + b y + c x is exact. Closed
// constraints have forgotten the edges, and are refused.
TEST(LibraryFEBody, hanging_nodes_follow_prescribed_edges)
{
  const auto exact = [](const Point<2> &p) { return .3 + .7 * p[1] - .2 * p[0]; };
  for (const unsigned int degree : {1, 2})
    for (const bool is_motion : {true, false})
    {
      Membrane skin(degree);
      for (types::global_dof_index i = 0; i < skin.dofs.n_dofs(); ++i) // sides, too
        if (std::fabs(skin.points[i][0] * (2. - skin.points[i][0])) < 1e-12 &&
            !skin.constraints.is_constrained(i))
        {
          skin.constraints.add_line(i);
          skin.edges.push_back(i);
        }
      std::map<types::global_dof_index, std::function<double(double)>> motions;
      std::map<types::global_dof_index, double> displacements;
      for (const auto i : skin.edges)
      {
        motions[i] = [value = exact(skin.points[i])](const double t) { return (1. + t) * value; };
        displacements[i] = exact(skin.points[i]);
      }
      const auto prescribe = [&](taut::FEBody<2> &body)
      {
        if (is_motion)
          body.prescribe(motions);
        else
          body.prescribe_displacements(displacements);
      };
      taut::System system;
      const std::size_t number = system.add("skin",
                                            [&]
                                            {
                                              auto body = skin.make();
                                              prescribe(*body);
                                              return body;
                                            });
      const taut::Stepper stepper(system);
      for (const Point<2> &p : {Point<2>(1., .5), Point<2>(1., .25), Point<2>(.6, .8)})
        EXPECT_NEAR(stepper.displacement(system.displacement(number, {p[0], p[1]}, {0., 0., 1.})),
                    exact(p), 1e-12)
            << degree;
      skin.constraints.close();
      const std::string message = error_of([&] { prescribe(*skin.make()); });
      EXPECT_TRUE(has(message, "body 'skin'") && has(message, "hanging DoF") &&
                  has(message, "not closed"))
          << message;
    }
}
