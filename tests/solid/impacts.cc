// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: a block that hits a wall does so as a bar where it is one (nu = 0), with the waves of a
// solid where it is not. Expected values: the wave equation; the bar of wires with the same
// elements, step and scheme; total mass, centre and inertia by integration.
#include "verification/scene_tests.h"

#include <taut/solid/elastic_solid.h>

#include <deal.II/grid/grid_generator.h>

namespace
{
  using namespace verification;

  struct Impact
  {
    double first = 0.;          ///< largest force while the front passes the first cells [N]
    double largest = 0.;        ///< [N]
    double deviation = 0.;      ///< largest from the mean, from 0.1 to 0.5 s [N]
    double plateau = 0.;        ///< mean from 0.1 to 0.5 s [N]
    double released = 0.;       ///< last time of contact [s]
    double rebound = 0.;        ///< mean velocity at the end [m/s]
    double energy = 0.;         ///< kinetic and elastic at the end, over that of the start
    double contact_energy = 0.; ///< that contacts gave, over the largest
    double certificate = 0.;
  };

  /// A scene in which the only body flies against a wall with 10 m/s; @p start is when it touches.
  Impact impact(const std::string &scene, const Overrides &overrides, const double start = 0.)
  {
    Impact result;
    std::vector<double> plateau;
    double start_energy = 0.;
    run_scene(scene, overrides,
              [&](const taut::StepView &view)
              {
                const double force = std::accumulate(view.state.multiplier.begin(),
                                                     view.state.multiplier.end(), 0.),
                             t = view.state.time - start;
                result.largest = std::fmax(result.largest, force);
                if (t < .02)
                  result.first = std::fmax(result.first, force);
                if (t > .1 && t < .5)
                  plateau.push_back(force);
                if (force > 0.)
                  result.released = t;
                const std::vector<double> MV =
                    matrix_times(view.structure[0].mass(), view.state.V[0]);
                const double energy = energy_of_bodies(view.structure, view.state);
                if (start_energy == 0.)
                  start_energy = energy;
                result.energy = energy / start_energy;
                result.rebound = std::accumulate(MV.begin(), MV.end(), 0.) / 10.;
                result.contact_energy = view.measures.summary().contact_energy;
                result.certificate = std::fmax(result.certificate, view.residuals.max());
              });
    result.plateau =
        std::accumulate(plateau.begin(), plateau.end(), 0.) / static_cast<double>(plateau.size());
    for (const double force : plateau)
      result.deviation = std::fmax(result.deviation, std::fabs(force - result.plateau));
    return result;
  }

  void print(const std::string &what, const Impact &i)
  {
    figure(what + ", first force", i.first, "N");
    figure(what + ", largest force", i.largest, "N");
    figure(what + ", mean force from 0.1 to 0.5 s", i.plateau, "N");
    figure(what + ", deviation from it", i.deviation, "N");
    figure(what + ", last contact", i.released, "s");
    figure(what + ", rebound", i.rebound, "m/s");
    figure(what + ", energy over that of the start", i.energy);
  }

  const Overrides no_contraction = {"Body block/Poisson's ratio=0"};

  /// One element a step of the bar, 30 m/s and 0.1 m.
  const Overrides one_cell_a_step = {"Time/Step=0.00333333333333333333"};
  const Overrides mean_forces = {"Time/Scheme=Moreau-Jean", "Time/Moreau-Jean/Theta=0.5",
                                 "Time/Moreau-Jean/Conditions=gaps"};
} // namespace

TEST(Impacts, a_block_that_does_not_contract_is_exact_with_mean_forces_and_reduced_mass)
{
  const Impact i =
      impact(scene_file("block_impact"), no_contraction + one_cell_a_step + mean_forces +
                                             Overrides{"Body block/Mass matrix=reduced"});
  print("block, nu = 0, reduced mass, mean forces", i);
  EXPECT_NEAR(i.largest, 300., 1e-8);
  EXPECT_LT(i.deviation, 1e-8);
  EXPECT_NEAR(i.released, 2. / 3., 1e-9);
  EXPECT_NEAR(i.rebound, 10., 1e-10);
  EXPECT_NEAR(i.energy, 1., 1e-12);
}

TEST(Impacts, with_the_default_scheme_a_block_errs_as_the_bar_does)
{
  const Impact block = impact(scene_file("block_impact"), no_contraction + one_cell_a_step);
  const Impact bar = impact(
      scene_file("bar_on_wall"),
      one_cell_a_step + Overrides{"Network/Wire bar/Element size=0.1", "Network/Link floor/Gap=0",
                                  "Time/Scheme=automatic", "Time/Mass redistribution=no",
                                  "Time/End=1", "Network/Wire bar/Initial axial velocity=-10"});
  print("block, nu = 0, default scheme", block);
  print("bar, default scheme", bar);
  const auto compare =
      [](const char *what, const double ours, const double of_bar, const double exact)
  {
    figure(std::string("error of the block over that of the bar: ") + what,
           std::fabs(ours - exact) / std::fabs(of_bar - exact));
    EXPECT_LE(std::fabs(ours - exact), 1.5 * std::fabs(of_bar - exact) + 1e-9 * exact) << what;
  };
  compare("largest force", block.largest, bar.largest, 300.);
  compare("deviation", 300. + block.deviation, 300. + bar.deviation, 300.);
  compare("release", block.released, bar.released, 2. / 3.);
  compare("rebound", block.rebound, bar.rebound, 10.);
  compare("energy", block.energy, bar.energy, 1.);
}

// The front of the first wave, density c_p v = 348 N, overshoots by as much as that of the bar
// does: the consistent mass carries a front at speeds that depend on the wave length. The reduced
// mass carries it whole; its first forces are the mean over the step until the sides are felt.
TEST(Impacts, a_block_hits_a_wall_with_the_force_of_its_waves)
{
  const std::string scene = scene_file("block_impact");
  const double density_c_v = std::sqrt(900. * .7 / (1.3 * .4)) * 10.; // of pressure waves
  const Impact i = impact(scene, {});
  print("block, nu = 0.3, default scheme", i);
  const Impact like_bar = impact(scene, no_contraction);
  figure("overshoot of the first force, nu = 0.3 and 0", i.first / density_c_v - 1.);
  figure("overshoot of the first force, nu = 0", like_bar.first / 300. - 1.);
  EXPECT_LT(std::fabs(i.first / density_c_v - 1.), 1.5 * std::fabs(like_bar.first / 300. - 1.));
  EXPECT_NEAR(i.plateau, 314., 3.);
  EXPECT_NEAR(i.released, .645, .01);
  EXPECT_NEAR(i.rebound, 9.6, .2);
  EXPECT_LE(i.energy, 1. + 1e-9);
  EXPECT_LT(i.contact_energy, 1e-9);
  EXPECT_LT(i.certificate, 1e-10);
  // One cell a step of pressure waves; the sides are felt from the second step on, as the mass is.
  const Impact reduced =
      impact(scene, mean_forces + Overrides{"Body block/Mass matrix=reduced",
                                            "Time/Step=0.00287280", "Time/End=0.5"});
  print("block, nu = 0.3, reduced mass, mean forces", reduced);
  EXPECT_NEAR(reduced.first / density_c_v, 1., 1e-2);
}

// With mass at the nodes that hit, the first force of BDF2 is their momentum over a step.
TEST(Impacts, without_mass_at_the_wall_forces_do_not_depend_on_the_step)
{
  const std::string scene = scene_file("block_impact");
  for (const std::string step : {"0.0025", "0.0003"})
  {
    const Overrides common =
        no_contraction + Overrides{"Time/Step=" + step, "Time/End=0.1",
                                   "Time/Allow unsuitable scheme=true",
                                   "Time/Allow energy gain=true", "Time/Scheme=BDF2"};
    const Impact without =
        impact(scene, common + Overrides{"Body block/Boundaries without mass=0"});
    figure("block without mass at the wall, BDF2, largest force at " + step + " s", without.largest,
           "N");
    EXPECT_GT(without.largest, 370.);
    EXPECT_LT(without.largest, 420.);
    EXPECT_TRUE(step == "0.0025" || impact(scene, common).largest > 800.);
  }
}

TEST(Impacts, mass_that_leaves_a_boundary_keeps_total_centre_and_inertia)
{
  for (const unsigned int degree : {1u, 2u})
    for (const taut::SolidMass kind :
         {taut::SolidMass::consistent, taut::SolidMass::lumped, taut::SolidMass::reduced})
      for (const bool keeps_inertia : {false, true})
      {
        auto cells = std::make_unique<dealii::Triangulation<2>>();
        dealii::GridGenerator::subdivided_hyper_rectangle(*cells, {8, 10}, dealii::Point<2>(1., 2.),
                                                          dealii::Point<2>(2., 4.), true);
        cells->begin_active()->set_refine_flag(); // hanging nodes at the boundary
        cells->execute_coarsening_and_refinement();
        const auto mesh = std::make_shared<const taut::SolidMesh<2>>(std::move(cells), degree);
        taut::ElasticSolid<2>::Options options;
        options.materials[taut::ElasticSolid<2>::other_materials] = {1e9, .3, 1e3};
        options.mass = kind;
        const taut::ElasticSolid<2> whole("whole", mesh, options);
        options.without_mass = {2};
        options.keeps_inertia = keeps_inertia;
        const taut::ElasticSolid<2> without("without", mesh, options);
        const auto integral = [&](const taut::ElasticSolid<2> &solid, const int p, const int q)
        {
          std::vector<double> a(solid.n_dofs(), 0.), b(a);
          // Only DoFs that are kept: hanging nodes follow them.
          std::vector<char> kept(a.size(), 1);
          for (const unsigned int i : solid.constrained_dofs())
            kept[i] = 0;
          for (unsigned int i = 0; i < a.size(); ++i)
            if (mesh->component(i) == 0 && kept[i])
            {
              const double x[3] = {1., mesh->point(i)[0], mesh->point(i)[1]};
              a[i] = x[p];
              b[i] = x[q];
            }
          const std::vector<double> Mb = matrix_times(solid.mass(), b);
          return std::inner_product(a.begin(), a.end(), Mb.begin(), 0.);
        };
        for (int p = 0; p < 3; ++p)
          for (int q = p; q < (keeps_inertia ? 3 : 1); ++q)
            EXPECT_NEAR(integral(without, p, q) / integral(whole, p, q), 1., 1e-12)
                << degree << ' ' << static_cast<int>(kind) << ' ' << p << q;
        const std::vector<unsigned int> massless = without.dofs_without_mass();
        unsigned int n_on_boundary = 0;
        for (unsigned int i = 0; i < without.n_dofs(); ++i)
          if (mesh->point(i)[1] == 2.)
          {
            ++n_on_boundary;
            EXPECT_TRUE(std::binary_search(massless.begin(), massless.end(), i));
          }
        EXPECT_GE(n_on_boundary, 2u * (8u * degree + 1u));
      }
}
