// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: a model of deal.II that does not fit its DoFHandler is one UserError that names the body;
// one that fits hangs as it should. Source: the table below; a bar under its weight.
#include "common.h"

#include <taut/substructure/check_body.h>
#include <taut/substructure/fe_body.h>
#include <taut/time/stepper.h>

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <limits>

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

TEST(DoorFEBody, a_bar_hangs)
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

TEST(DoorFEBody, what_does_not_fit_is_named)
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

TEST(DoorFEBody, calls_that_do_not_fit_are_named)
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
