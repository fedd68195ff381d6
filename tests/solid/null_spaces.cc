// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: motions that nothing but constraints holds are found, and searches get past constraints
// that do not hold a body. Source: the rigid body motions of a model of deal.II.
#include "common.h"

#include <taut/interface/system.h>
#include <taut/solid/elastic_solid.h>
#include <taut/time/static_equilibrium.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/lac/sparse_matrix.h>

namespace
{
  constexpr double spring = 100., to_the_ground = 10.;

  /// Four nodes with springs between all or in two pairs; the first node hangs on the ground.
  class Chain
  {
  public:
    explicit Chain(const bool is_whole) : element(1), handler(cells), pattern(4, 4, 4), load(4)
    {
      dealii::GridGenerator::subdivided_hyper_cube(cells, 3);
      handler.distribute_dofs(element);
      for (unsigned int i = 0; i < 4; ++i)
        for (unsigned int j = 0; j < 4; ++j)
          pattern.add(i, j);
      pattern.compress();
      stiffness.reinit(pattern);
      mass.reinit(pattern);
      stiffness.add(0, 0, to_the_ground);
      for (unsigned int i = 0; i < 4; ++i)
        mass.add(i, i, 1.);
      for (unsigned int i = 0; i < 3; ++i)
        if (is_whole || i != 1)
          for (const unsigned int j : {i, i + 1})
          {
            stiffness.add(j, j, spring);
            stiffness.add(j, 2 * i + 1 - j, -spring);
          }
    }

    std::unique_ptr<taut::FEBody<1>> body() const
    {
      return std::make_unique<taut::FEBody<1>>("chain", handler, mass,
                                               dealii::SparseMatrix<double>(), stiffness,
                                               dealii::AffineConstraints<double>(), load, options);
    }

    static dealii::Vector<double> vector(const std::vector<double> &entries)
    {
      return dealii::Vector<double>(entries.begin(), entries.end());
    }

    dealii::Triangulation<1> cells;
    const dealii::FE_Q<1> element;
    dealii::DoFHandler<1> handler;
    dealii::SparsityPattern pattern;
    dealii::SparseMatrix<double> mass, stiffness;
    dealii::Vector<double> load;
    taut::FEBody<1>::Options options;
  };

  taut::StaticState state_at_rest(const taut::System &system,
                                  const taut::InterfaceParameters &interface = {})
  {
    taut::SolverParameters parameters;
    parameters.interface = interface;
    return taut::static_equilibrium(system.structure(), system.constraints(), parameters, 0.);
  }
} // namespace

// A motion that the stiffness resists is no null space, found or given: all springs stretch.
TEST(NullSpaces, motions_that_the_stiffness_resists_are_left_out)
{
  for (const bool is_given : {false, true})
  {
    Chain chain(true);
    chain.load[3] = 3.;
    chain.options.null_space.resize(is_given);
    if (is_given)
      chain.options.null_space[0] = chain.vector({1., 1., 1., 1.});
    EXPECT_TRUE(chain.body()->null_space().vectors.empty());
    taut::System system;
    system.add("chain", [&] { return chain.body(); });
    const std::vector<double> U = state_at_rest(system).displacement[0];
    for (unsigned int i = 0; i < 4; ++i)
      EXPECT_NEAR(U[i], 3. / to_the_ground + i * 3. / spring, 1e-13);
  }
}

// Of resisted motions the combination that is not: two nodes move together, and a constraint holds.
TEST(NullSpaces, combinations_of_motions_that_the_stiffness_resists_are_found)
{
  Chain chain(false);
  chain.load = chain.vector({0., 2., 5., 0.});
  chain.options.null_space = {chain.vector({1., 1., 1., 1.}), chain.vector({1., 1., -1., -1.})};
  const taut::Substructure::NullSpace found = chain.body()->null_space();
  ASSERT_EQ(found.vectors.size(), 1u);
  const std::vector<double> &mode = found.vectors[0];
  EXPECT_NEAR(mode[0], 0., 1e-15);
  EXPECT_NEAR(mode[1], 0., 1e-15);
  EXPECT_NE(mode[2], 0.);
  EXPECT_NEAR(mode[3], mode[2], 1e-15);
  taut::System system;
  const std::size_t body = system.add("chain", [&] { return chain.body(); });
  const taut::LinearForm last =
      static_cast<const taut::FEBody<1> &>(*system.body(body)).displacement_of_dof(3);
  system.add(taut::Constraint::bilateral("hold", {{0, last}}));
  const taut::StaticState state = state_at_rest(system);
  const std::vector<double> expected = {2. / to_the_ground, 2. / to_the_ground + 2. / spring,
                                        5. / spring, 0.};
  EXPECT_LT(verification::largest_difference(expected, state.displacement[0]), 1e-13);
  EXPECT_NEAR(state.multiplier[0], -5., 1e-12);
}

// A block on three points of the ground, pulled up at both ends and pressed down right of the
// middle. Held by all points both ends are pulled off, and the middle one that is left does not
// hold it: the search goes another way, to the forces of a lever, whatever solves its systems.
TEST(NullSpaces, searches_get_past_constraints_that_do_not_hold_a_body)
{
  auto cells = std::make_unique<dealii::Triangulation<2>>();
  dealii::GridGenerator::subdivided_hyper_rectangle(*cells, {8, 4}, dealii::Point<2>(),
                                                    dealii::Point<2>(2., 1.));
  const auto mesh = std::make_shared<const taut::SolidMesh<2>>(std::move(cells), 1);
  constexpr taut::Coordinates up = {0., 1., 0.};
  for (const char *const form : {"assembled dense", "matrix-free"})
  {
    taut::System system;
    const std::size_t block =
        system.add("block",
                   [&]
                   {
                     taut::ElasticSolid<2>::Options options;
                     options.materials[0] = {1e3, .3, 1.};
                     auto body = std::make_unique<taut::ElasticSolid<2>>("block", mesh, options);
                     for (const auto &[x, y, force] :
                          {std::array{0., 0., 5.}, {2., 0., 5.}, {1.0625, 1., -16.}})
                       body->add_force(body->displacement({x, y, 0.}, up), force);
                     return body;
                   });
    for (const double x : {0., 1., 2.})
      system.add(
          taut::Constraint::unilateral("point", system.displacement(block, {x, 0., 0.}, up)));
    system.add(taut::Constraint::bilateral("side",
                                           system.displacement(block, {1., 0., 0.}, {1., 0., 0.})));
    const taut::StaticState state = state_at_rest(system, {form, "Dirichlet", "rigid body modes"});
    EXPECT_TRUE(state.residuals.fallback) << form;
    EXPECT_LT(verification::largest_difference({0., 5., 1., 0.}, state.multiplier), 1e-10) << form;
  }
}
