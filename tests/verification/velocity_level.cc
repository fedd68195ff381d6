// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: Moreau-Jean's impulses obey Newton's law of restitution, the rates of moving constraints
// have their convective part, bilateral constraints held at velocity level do not drift; with
// conditions on gaps nothing penetrates, contacts never give energy, and rest stays rest when the
// step changes. Sources: a ball that bounces (v_n = e^n v_0, closed form); a mass that follows a
// wavy rail, N = P - m r"; a moving force on a string, F v t/(T (1 + v/c)); theta = 1 without
// restitution is the backward Euler method (V = dU/step; position and velocity conditions of a
// closed constraint agree).
#include "scene_tests.h"

using namespace verification;

namespace
{
  std::string time_section(const double step, const double end, const std::string &more = "")
  {
    return "Time: Scheme = Moreau-Jean; Step = " + number(step) + "; End = " + number(end) + "; " +
           more + "\n";
  }

  std::string gaps(const double theta, const std::string &more = "")
  {
    return more + "\nTime/Moreau-Jean: Theta = " + number(theta) + "; Conditions = gaps\n";
  }
} // namespace

// Dropped from 0.8 m with 10 m/s^2: first touch at 0.4 s with 4 m/s; the n-th flight takes
// 2 e^n 4/10 s and rises e^(2n) 0.8 m.
TEST(MoreauJean, a_ball_bounces_with_newtons_restitution)
{
  const double e = .5;
  double errors[2];
  for (int fine = 0; fine < 2; ++fine)
  {
    const double step = fine ? 1e-4 : 4e-4;
    double error = 0., largest_gap_error = 0.;
    run_scene(R"(Gravity = 0, -10; Start = given
Mass ball: Position = 0, 0.8; Mass = 2
Link floor: Type = stop; From = ground; To = ball; Direction = 0, 1; Gap = 0.8
)" + time_section(step, 1.35, "\nTime/Moreau-Jean: Restitution = 0.5; Conditions = velocities\n"),
              {},
              [&](const taut::StepView &view)
              {
                double t = view.state.time, flight = 0.;
                double height = .8 - 5. * t * t;
                // Touches at 0.4, 0.8, 1.0, 1.1, ... s; at rest from 1.2 s on.
                for (double touch = .4, v = 4. * e; t > touch && v > 1e-12; touch += flight, v *= e)
                {
                  flight = 2. * v / 10.;
                  height = std::max(0., v * (t - touch) - 5. * (t - touch) * (t - touch));
                }
                raise(error, view.state.distance[0] - height);
                largest_gap_error = std::max(largest_gap_error, -view.state.distance[0]);
              });
    figure("bouncing ball, largest error of the height, step " + number(step), 1e3 * error, "mm");
    EXPECT_LT(largest_gap_error, 4. * step) << "a gap is open to a step of motion";
    errors[fine] = error;
  }
  EXPECT_LT(errors[1], 2e-3);
  EXPECT_NEAR(std::log(errors[0] / errors[1]) / std::log(4.), 1., .3);
}

// 5 kg pressed by 60 N slides at 4 m/s, rigidly, over waves of 1 mm and 2 m on a wire that hardly
// yields: N = 60 - 5 a w^2 cos w t, w = 4 pi 1/s. A gap rate without its convective part lets the
// mass go straight on.
TEST(MoreauJean, a_rigid_sliding_contact_follows_a_wavy_wire)
{
  const std::string scene =
      R"(Gravity = 0, 0; Start = equilibrium
Wire wire: To = 10, 0; Components = string; Mass per length = 1; Tension = 1e9; Element size = 0.5
Support ends: Wire = wire; Positions = 0, 10
Mass mass: Position = 1, 0; Mass = 5; Motions = y
Link contact: Type = sliding contact; From = mass; To = wire @ 1; Direction = 0, 1; Speed = 4;
  Height profile = 1e-3*(1-cos(pi*(s-1)))
Load force: Type = point; On = mass; Magnitude = 60
)";
  const double w = 4. * std::acos(-1.);
  for (const bool of_gaps : {false, true})
  {
    double force_error = 0., gap = 0.;
    run_scene(scene + time_section(1e-4, 2., of_gaps ? gaps(.6) : ""), {},
              [&](const taut::StepView &view)
              {
                const double t = view.state.time;
                raise(gap, view.state.distance[0]);
                if (t > .01)
                  raise(force_error,
                        view.state.multiplier[0] - 60. + 5e-3 * w * w * std::cos(w * t));
              });
    const std::string name =
        std::string("rigid contact over waves") + (of_gaps ? ", conditions on gaps" : "");
    EXPECT_LT(figure(name + ", largest error of the force", force_error, "N"), .01 * 60.);
    EXPECT_LT(figure(name + ", largest gap", 1e6 * gap, "um"), of_gaps ? 1e-6 : 10.);
  }
}

// As in SlidingContact, with a rigid contact: a string of 20 kN and 1.35 kg/m, 250 km/h, 120 N.
TEST(MoreauJean, a_rigid_contact_moves_a_string_as_a_moving_force_does)
{
  const double v = 250. / 3.6, c = std::sqrt(20000. / 1.35);
  double error = 0.;
  run_scene(R"(Gravity = 0, 0; Start = equilibrium
Wire string: To = 60, 0; Components = string; Mass per length = 1.35; Tension = 20000;
  Element size = 0.1; Degree = 2
Support ends: Wire = string; Positions = 0, 60
Mass mass: Mass = 1; Motions = y
Link contact: Type = sliding contact; From = mass; To = string @ 0; Direction = 0, 1;
  Speed = )" + number(v) +
                R"(
Load force: Type = point; On = mass; Magnitude = 120
)" +
                time_section(2.5e-4, .4,
                             "Allow unsuitable scheme = true; Allow energy gain = true\n"
                             "Time/Moreau-Jean: Theta = 0.6; Conditions = velocities\n"),
            {},
            [&](const taut::StepView &view)
            {
              const double t = view.state.time;
              if (t < .2)
                return;
              const double exact = 120. * v * t / (20000. * (1. + v / c));
              error = std::max(error, std::fabs(displacement(view, 0, v * t) - exact) / exact);
            });
  figure("rigid contact as a moving force, largest relative error under it, 0.2..0.4 s", error);
  EXPECT_LT(error, .02);
}

TEST(MoreauJean, theta_one_is_backward_euler)
{
  const auto forces = [](const Overrides &overrides)
  {
    return history_of(scene_file("string_on_stop"), overrides,
                      [](const taut::StepView &view) { return view.state.multiplier[0]; });
  };
  const std::vector<double> euler = forces({"Time.Scheme=backward Euler"});
  for (const std::string conditions : {"velocities", "gaps"})
  {
    const std::vector<double> jean = forces({"Time.Scheme=Moreau-Jean", "Time.Moreau-Jean.Theta=1",
                                             "Time.Moreau-Jean.Conditions=" + conditions});
    EXPECT_LT(figure("string on stop, Moreau-Jean (1) of " + conditions +
                         " minus backward Euler, largest force",
                     largest_difference(euler, jean), "N"),
              1e-4);
  }
}

// Cuts of wires are rigid bilateral constraints: the run is that of the wires in one piece.
TEST(MoreauJean, cuts_do_not_drift)
{
  for (const Overrides &conditions :
       {Overrides{"Time.Moreau-Jean.Conditions=velocities"},
        Overrides{"Time.Moreau-Jean.Conditions=gaps", "Time.Moreau-Jean.Theta=0.6"}})
  {
    double drift = 0., whole = 0., cut = 0.;
    for (const bool in_pieces : {false, true})
    {
      const std::string parts = in_pieces ? "7" : "1";
      run_scene(scene_file("string_on_stop"),
                conditions + Overrides{"Time.Scheme=Moreau-Jean",
                                       "Partition.Number of substructures=" + parts},
                [&](const taut::StepView &view)
                {
                  if (in_pieces)
                    drift = std::max(drift, view.residuals.drift);
                  (in_pieces ? cut : whole) +=
                      view.state.multiplier[view.constraints.index_of_link(0)];
                });
    }
    figure("string on stop in 7 pieces, Moreau-Jean, " + conditions[0].substr(28) +
               ", largest opening of a cut",
           drift, "m");
    EXPECT_LT(drift, 1e-10);
    EXPECT_GT(drift, 0.) << "positions are not solved for";
    EXPECT_NEAR(cut / whole, 1., 1e-9);
  }
}

// A bar of 10 m and 10 N/m stands on a floor: 100 N, whatever the step. The balance before a step
// has no force of the floor, or a shorter step would see half of it.
TEST(MoreauJean, a_change_of_step_at_rest_creates_no_force)
{
  const std::string scene =
      R"(Gravity = 0, -10; Start = equilibrium
Wire bar: To = 0, 10; Components = bar; Mass per length = 1; Axial stiffness = 900;
  Element size = 0.5; Degree = 1; Mass matrix = reduced
Link floor: Type = stop; From = ground; To = bar @ 0; Direction = 0, 1
)";
  double change = 0., shortest = 1., longest = 0.;
  run_scene(scene + time_section(1. / 60., 4., gaps(.5, "Step control = adaptive")), {},
            [&](const taut::StepView &view)
            {
              if (view.state.time > 0.)
              {
                shortest = std::min(shortest, view.state.last_step);
                longest = std::max(longest, view.state.last_step);
              }
              raise(change, view.state.multiplier[0] / 100. - 1.);
            });
  EXPECT_LT(
      figure("bar at rest, conditions on gaps, change of its force as the step changes", change),
      1e-9);
  EXPECT_GT(longest, 1.9 * shortest) << "the step did not change";
}

// What is known to fail is refused by name, unless an entry allows it.
TEST(Schemes, unsuitable_ones_are_refused_by_name)
{
  const auto message = [](const Overrides &overrides)
  {
    const Overrides all =
        Overrides{"Time.Allow unsuitable scheme=false", "Time.End=0.01"} + overrides;
    return error_of([&] { run_scene(scene_file("bar_on_wall"), all); });
  };
  // An error of a rigid link's force keeps 1, 0.8 and 0.75 of itself from step to step.
  for (const std::string scheme : {"Newmark", "generalised-alpha", "HHT"})
  {
    const std::string refusal = message({"Time.Scheme=" + scheme});
    for (const std::string &part : {scheme, std::string("'floor'"), std::string("rings")})
      EXPECT_TRUE(has(refusal, part)) << refusal;
    for (const std::string helps :
         {"Time.Allow unsuitable scheme=true", "Time.Mass redistribution=mass",
          "Network.Link floor.Stiffness=1000"})
      EXPECT_EQ(message({"Time.Scheme=" + scheme, helps}), "");
  }
  const std::string alpha = "Time.Scheme=generalised-alpha",
                    radius = "Time.Generalised-alpha.Spectral radius=";
  EXPECT_NE(message({alpha, radius + "0.51"}), "");
  EXPECT_EQ(message({alpha, radius + "0.49"}), "");
  for (const std::string step : {"5e-5", "1e-4", "5e-4"})
    for (const std::string scheme : {"backward Euler", "BDF2", "Moreau-Jean", "automatic"})
      EXPECT_EQ(message({"Time.Scheme=" + scheme, "Time.Step=" + step}), "") << scheme;
  const std::string jean = "Time.Scheme=Moreau-Jean", own = "Time.Moreau-Jean.",
                    of_gaps = own + "Conditions=gaps", of_rates = own + "Conditions=velocities",
                    reduced = "Network.Wire bar.Mass matrix=reduced",
                    massless = "Time.Mass redistribution=mass";
  EXPECT_EQ(message({jean, "Network.Link floor.Stiffness=1e8"}), "");
  EXPECT_EQ(message({jean, massless}), "");
  EXPECT_TRUE(has(message({jean, of_rates, massless}), "never damps"));
  EXPECT_EQ(message({jean, of_rates, massless, own + "Theta=0.6"}), "");
  // Not only unsuitable, but without meaning: nothing allows it.
  const std::string anyway = "Time.Allow unsuitable scheme=true";
  EXPECT_TRUE(has(message({jean, own + "Theta=0.6", anyway}), "Theta 1/2"));
  EXPECT_TRUE(has(message({jean, reduced, anyway}), "'bar (axial)' is 'reduced'"));
  EXPECT_EQ(message({jean, of_gaps, reduced}), "");
  EXPECT_EQ(message({jean, of_gaps, own + "Theta=0.6"}), "");
  EXPECT_EQ(message({"Time.Scheme=BDF2", reduced}), "");
  EXPECT_TRUE(has(message({jean, of_gaps, own + "Restitution=0.5", anyway}), "Restitution"));
}
