// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: linearised cables have small motions about the equilibrium of their scene, links that turn
// with them, and are refused where slack. Source: nonlinear ones, which differ by the load squared.
#include "cable/errors_of_runs.h"
#include "cable/one_cable.h"
#include "cable/places_in_steps.h"

#include "output/scene_report.h"
#include <taut/time/static_equilibrium.h>

namespace
{
  using namespace verification;
  using namespace taut;

  /// The line of prm/line_with_droppers.prm, all droppers taut, with cables of one geometry.
  Overrides line(const std::string &geometry, const Overrides &entries)
  {
    Overrides all;
    for (const std::string cable : {"Body messenger", "Body contact wire"})
      all = all + Overrides{cable + "/Geometry=" + geometry, cable + "/Elements=24"};
    return all + entries;
  }

  /// Probes and forces of links of all steps, under a load that begins at zero.
  std::vector<double> motion(const std::string &geometry, const std::string &load)
  {
    std::vector<double> result;
    Session session(scene_file("line_with_droppers"),
                    line(geometry, {"Network/Load lift/Magnitude=" + load + "*(1-cos(20*t))",
                                    "Network/Load lift/Direction=0.5, 1, 0.5", "Time/End=0.3",
                                    "Time/Step=4e-3", "Time/Scheme=backward Euler"}));
    session.run(
        [&](const StepView &step)
        {
          result.insert(result.end(), step.probes.begin(), step.probes.end());
          for (std::size_t i = 0; i < step.scene.links.size(); ++i)
            result.push_back(1e-3 *
                             step.state.multiplier[step.constraints.index_of_link(i)]); // [kN]
        });
    return result;
  }

  /// A span that is pulled along x at the start.
  std::string span(const std::string &entries, const std::string &place, const std::string &force)
  {
    return R"(Gravity = 0, -9.81
Body span: Type = cable; From = 0, 0, 0; To = 30, 0, 0; Axial stiffness = 1e6;
  Mass per length = 1; Geometry = linearised; )" +
           entries + R"(
Load pull: Direction = 1, 0; On = span @ )" +
           place + ", 0; Magnitude = " + force + R"(
Time: End = 0
)";
  }

} // namespace

TEST(CableLinearised, a_line_moves_as_a_nonlinear_one_under_small_loads)
{
  double before = INFINITY;
  for (const std::string load : {"16", "8", "4"})
  {
    const std::vector<double> nonlinear = motion("nonlinear", load);
    const double difference = largest_difference(nonlinear, motion("linearised", load)),
                 moved = largest_difference(nonlinear, motion("nonlinear", "0"));
    figure("line of linearised cables beside nonlinear ones, " + load + " N", difference / moved);
    EXPECT_GT(before / difference, 3.5) << load;
    before = difference;
  }
}

TEST(CableLinearised, a_line_is_linear_and_starts_as_the_nonlinear_one)
{
  std::vector<double> forces[2], places[2];
  for (const bool is_linearised : {false, true})
  {
    Session session(scene_file("line_with_droppers"),
                    line(is_linearised ? "linearised" : "nonlinear",
                         {"Time/End=1e-3", "Network/Load lift/Magnitude=700"}));
    session.run(
        [&](const StepView &step)
        {
          if (step.state.time > 0.)
            return;
          for (std::size_t i = 0; i < step.scene.links.size(); ++i)
            forces[is_linearised].push_back(
                step.state.multiplier[step.constraints.index_of_link(i)]);
          for (std::size_t k = 0; k < step.structure.size(); ++k)
          {
            EXPECT_EQ(step.structure[k].is_linear(), is_linearised);
            const std::vector<double> &U = step.reference.displacement[k];
            places[is_linearised].insert(places[is_linearised].end(), U.begin(), U.end());
            // The same force, to the last bit, at the same place.
            std::vector<double> f;
            step.structure[k].internal_force(U, {}, f);
            EXPECT_EQ(f, step.reference.force[k]);
          }
          EXPECT_EQ(!step.constraints.turning_rows().empty(), !is_linearised);
          // Two springs across each of the four droppers that are taut.
          EXPECT_EQ(step.constraints.size(), is_linearised ? 14u : 6u);
        });
    EXPECT_EQ(!has(session.log(), "Newton's method"), is_linearised);
    EXPECT_EQ(has(session.log(), "Linearised at the equilibrium of the scene: 'messenger', "
                                 "'contact wire'; 6 links that would turn keep their directions"),
              is_linearised);
  }
  EXPECT_EQ(forces[0], forces[1]);
  EXPECT_EQ(places[0], places[1]);
}

// A mass on a rope swings far, whatever carries it.
TEST(CableLinearised, links_to_other_bodies_turn)
{
  Session session(scene_file("line_with_droppers"),
                  line("linearised", {"Time/End=1e-3", "Body messenger/Geometry=nonlinear"}));
  session.run([](const StepView &step) { EXPECT_TRUE(!step.constraints.turning_rows().empty()); });
}

TEST(CableLinearised, only_under_tension_at_the_equilibrium_of_the_scene)
{
  // Held at both ends and pulled to one of them it is under compression behind.
  const std::string taut_alone =
      "Unstressed length = 29.9; Largest strain = 0.05; Bending stiffness = 1e6";
  EXPECT_EQ(error_of(span(taut_alone, "15", "2e3")), "");
  const std::string error = error_of(span(taut_alone, "15", "2e4"));
  EXPECT_TRUE(has(error, "Body span/Geometry")) << error;
  EXPECT_TRUE(has(error, "slack somewhere")) << error;
  // So stiff in bending that the cable alone is under compression.
  const std::string slack_alone = "Unstressed length = 30.03; Bending stiffness = 1e6";
  EXPECT_TRUE(has(error_of(span(slack_alone, "15", "0")), "slack somewhere"));
  EXPECT_EQ(error_of(span(slack_alone + "; Held ends = from; Clamped = true", "30.03", "1e4")), "");
}

TEST(CableLinearised, start_shows_places_of_the_equilibrium)
{
  Session session(scene_file("line_with_droppers"), line("linearised", {"Time/End=1e-3"}));
  std::vector<double> heights;
  session.run(
      [&](const StepView &step)
      {
        if (step.state.time > 0.)
          return;
        for (const Link &link : step.scene.links)
          heights.push_back(displaced(step, link.to).y);
      });
  const std::vector<double> y = read_table(session.folder() + "/start.csv").at("y [m]");
  ASSERT_GE(y.size(), heights.size());
  for (std::size_t i = 0; i < heights.size(); ++i)
    EXPECT_NEAR(y[i], heights[i], 1e-6) << i;
  EXPECT_GT(heights.size(), 5u);
  EXPECT_GT(*std::max_element(heights.begin(), heights.end()), .1); // it is lifted
}

// Statics of a body with a force at U = 0, and a system whose steppers do not see each other.
TEST(CableLinearised, a_system_stays_as_it_is)
{
  CableData data = cable_to({60., 0., 0.}, 60.1, {1.3e7, 0., 1.07, 0.}, 32);
  data.geometry = CableGeometry::linearised;
  const OneCable<> one(data);
  one.cable->add_force(one.cable->displacement({30.05, 0., 0.}, {0., -1., 0.}), 500.);
  const System &system = one.system;
  const Displacement down = system.displacement(0, {30.05, 0., 0.}, {0., -1., 0.});
  const Stepper first(system), second(system);
  EXPECT_FALSE(system.body(0)->is_linear());
  EXPECT_EQ(first.displacement(down), second.displacement(down));
  Structure linear = system.structure();
  const StaticState rest = static_equilibrium(linear, system.constraints(), {}, 0.);
  EXPECT_EQ(linear.linearise(rest.displacement), std::vector<char>{1});
  EXPECT_EQ(linear.linearise(rest.displacement), std::vector<char>{0});
  const StaticState again = static_equilibrium(linear, system.constraints(linear), {}, 0.);
  EXPECT_NEAR(evaluate(down, again.displacement), evaluate(down, rest.displacement), 1e-8);
  const std::vector<double> &U = rest.displacement[0], zero(U.size(), 0.);
  std::vector<double> mean, half(U), f;
  for (double &u : half)
    u *= .5;
  linear[0].mean_internal_force(zero, U, 1., mean);
  linear[0].internal_force(half, {}, f);
  EXPECT_LT(largest_difference(mean, f), 1e-6);
  const double work = std::inner_product(U.begin(), U.end(), mean.begin(), 0.);
  EXPECT_NEAR(work, linear[0].strain_energy(U) - linear[0].strain_energy(zero),
              1e-6 * std::fabs(work));
  EXPECT_NEAR(linear[0].strain_energy(U), system.body(0)->strain_energy(U), 1e-9);
}
