// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: in long steps, where the inertia of a floating body is lost in the rounding of its
// stiffness, its rigid body modes are unknowns of the constraints, and the answer is that of the
// equations of motion; ordinary scenes never need it. Source: the bar in one step of backward
// Euler, EA u" = rho/step^2 u, by hyperbolic functions; rigid bodies by Newton's law.
#include "scene_tests.h"

#include <taut/substructure/factored_structure.h>
#include <taut/time/integrator.h>

using namespace verification;

namespace
{
  /// Steps of backward Euler in parts, and what gives the multipliers.
  struct Steps
  {
    double load, gap, step;
    unsigned int n_steps = 3, n_parts = 1;
    std::string form = "assembled dense", method = "semismooth Newton";
  };

  /// A free wire from x = 0 to @p end, where a rigid stop waits; a load pushes at x = 0.
  std::string text(const std::string &wire, const std::string &end, const Steps &steps)
  {
    std::ostringstream out;
    out.precision(17);
    out << "Gravity = 0, 0; Start = undeformed\nWire wire: To = " << end << ", 0; " << wire
        << "\nLoad push: On = wire @ 0; Magnitude = " << steps.load
        << "\nLink stop: Type = stop; Gap = " << steps.gap
        << "\nTime: Scheme = backward Euler; Step = " << steps.step
        << "; End = " << steps.n_steps * steps.step
        << "\nPartition: Number of substructures = " << steps.n_parts
        << "\nSolver: Interface operator = " << steps.form
        << "; Complementarity = " << steps.method;
    return out.str();
  }

  /// Mass, length and axial stiffness of the bar are 1 or as given, in kg, m, N.
  std::string bar(const Steps &steps, const std::string &element_size = "1e-3",
                  const std::string &axial_stiffness = "1")
  {
    return text("Components = bar; Mass per length = 1; Degree = 1; Axial stiffness = " +
                    axial_stiffness + "; Element size = " + element_size,
                "1", steps) +
           "\nLoad push: Direction = 1, 0\nLink stop: From = wire @ 1; To = ground; Direction = 1, "
           "0\n";
  }

  /// A free beam of 2 m and 3 kg.
  std::string beam(const Steps &steps)
  {
    return text("Components = beam; Mass per length = 1.5; Bending stiffness = 1e3; Element size = "
                "0.25",
                "2", steps) +
           "\nLoad push: Direction = 0, 1\nLink stop: To = wire @ 2; Direction = 0, 1\n";
  }

  bool has_rigid_body_modes(const taut::Structure &structure, const taut::StepCoefficients &c)
  {
    taut::FactoredStructure solvers(structure, "block tridiagonal");
    solvers.factor(c.mass_factor(), c.velocity);
    return solvers.has_rigid_body_modes();
  }

  void expect_near(const double value, const double expected, const double relative)
  {
    EXPECT_NEAR(value, expected, relative * std::fabs(expected));
  }
} // namespace

TEST(RigidBodyModes, a_step_of_a_free_bar_is_that_of_its_differential_equation)
{
  double worst = 0.;
  for (const double step : {20., 1e3, 1e6})
    for (const double part_of_way : {0., .25, 2.})
      for (const std::string way :
           {"assembled dense", "assembled sparse", "energy-ordered", "MPRGP"})
      {
        const double lambda = 1. / step, far = 1. / (lambda * std::sinh(lambda)),
                     near = std::cosh(lambda) * far;
        Steps steps = {1., part_of_way * far, step, 1};
        (has(way, "assembled") ? steps.form : steps.method) = way;
        SCOPED_TRACE(bar(steps));
        Session session(bar(steps));
        EXPECT_TRUE(
            has_rigid_body_modes(session.simulation().structure(), taut::backward_euler(step)));
        session.run(
            [&](const taut::StepView &view)
            {
              if (view.state.time == 0.)
                return;
              const double N = std::max(0., (far - steps.gap) / near),
                           // far N and near nearly cancel: (near^2 - far^2)/near = tanh/lambda
                  u = N > 0. ? std::tanh(lambda) / lambda + steps.gap * far / near : near;
              const double found = displacement(view, 0, 0., {1., 0.});
              expect_near(view.state.multiplier[view.constraints.index_of_link(0)], N, 1e-7);
              expect_near(found, u, 1e-7);
              worst = std::max(
                  {worst, std::fabs(view.state.multiplier[view.constraints.index_of_link(0)] - N),
                   std::fabs(found / u - 1.)});
            });
      }
  figure("free bar in one step, largest relative error of motion and contact force", worst);
}

TEST(RigidBodyModes, a_bar_flies_stops_and_is_pressed_as_momentum_says)
{
  // 3e-6 N move 1 kg by 3 m in the first step of 1000 s and by 6 m in the second, of which 2 are
  // left: the stop takes the velocity of one step after the other.
  const std::vector<double> U = {0., 3., 5., 5., 5., 5.}, N = {0., 0., 4e-6, 5e-6, 3e-6, 3e-6};
  for (const unsigned int n_parts : {1u, 2u, 3u})
  {
    const std::string scene = bar({3e-6, 5., 1e3, 5, n_parts}, "0.05", "1e7");
    SCOPED_TRACE(scene);
    Overrides overrides;
    if (n_parts == 2)
      overrides = {"Partition/Method=given", "Partition/Cuts=wire @ 0.5"};
    Session session(scene, overrides);
    EXPECT_TRUE(has_rigid_body_modes(session.simulation().structure(), taut::backward_euler(1e3)));
    std::size_t i = 0;
    session.run(
        [&](const taut::StepView &view)
        {
          EXPECT_NEAR(displacement(view, 0, .5, {1., 0.}), U[i], 1e-9);
          EXPECT_NEAR(view.state.multiplier[view.constraints.index_of_link(0)], N[i], 1e-12);
          // Half the bar has half the mass: what its other half pushes it with.
          if (n_parts == 2 && i > 0)
          {
            const double a = i == 1 ? 3e-6 : i == 2 ? -1e-6 : i == 3 ? -2e-6 : 0.;
            EXPECT_NEAR(std::fabs(view.state.multiplier[0]), std::fabs(N[i] + .5 * a), 1e-12);
          }
          ++i;
        });
    EXPECT_EQ(i, U.size());
  }
}

TEST(RigidBodyModes, a_beam_turns_about_the_stop_at_its_end)
{
  // m = 3, L = 2: a force at x moves y by step^2 (1/m + (x - 1)(y - 1)/J), J = 1.
  const double step = 1e3, unit = step * step, load = 3e-6;
  const auto motion = [&](const double x, const double y)
  { return unit * (1. / 3. + (x - 1.) * (y - 1.)); };
  for (const double gap : {0., .5, 1e3})
    for (const unsigned int n_parts : {1u, 2u, 4u})
    {
      const std::string scene = beam({load, gap, step, 3, n_parts});
      SCOPED_TRACE(scene);
      Session session(scene);
      EXPECT_TRUE(
          has_rigid_body_modes(session.simulation().structure(), taut::backward_euler(step)));
      double left = 0., right = 0., left_before = 0., right_before = 0.;
      session.run(
          [&](const taut::StepView &view)
          {
            if (view.state.time > 0.)
            {
              // Without forces a step repeats the one before.
              double dl = left - left_before + load * motion(0., 0.),
                     dr = right - right_before + load * motion(0., 2.);
              const double N = std::max(0., -(gap + right + dr) / motion(2., 2.));
              dl += N * motion(2., 0.);
              dr += N * motion(2., 2.);
              left_before = left;
              right_before = right;
              left += dl;
              right += dr;
              EXPECT_NEAR(view.state.multiplier[view.constraints.index_of_link(0)], N, 1e-6 * load);
            }
            EXPECT_NEAR(displacement(view, 0, 0.), left, 1e-7 * (1. + std::fabs(left)));
            EXPECT_NEAR(displacement(view, 0, 2.), right, 1e-7 * (1. + std::fabs(right)));
          });
    }
}

TEST(RigidBodyModes, the_matrix_free_form_names_those_that_have_them)
{
  const std::string scene = bar({1., 0., 1e6, 1, 1, "matrix-free"}),
                    refusal = error_of([&] { run_scene(scene, {}); });
  EXPECT_TRUE(has(refusal, "Solver/Interface operator = assembled")) << refusal;
}

TEST(RigidBodyModes, scenes_of_the_folder_prm_need_them_in_no_step)
{
  unsigned int n_scenes = 0;
  for (const auto &file : std::filesystem::directory_iterator(TAUT_PRM_FOLDER))
    if (file.path().extension() == ".prm")
    {
      ++n_scenes;
      Session session(file.path().string());
      // Four times the step of the file.
      EXPECT_FALSE(has_rigid_body_modes(session.simulation().structure(),
                                        taut::backward_euler(4. * session.parameters().step)))
          << file.path();
    }
  EXPECT_GE(n_scenes, 13u);
}
