// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: what 'automatic' takes at rigid links neither gives energy nor lets bodies rebound that
// should not, is the same in pieces, bounces by Newton's law, and what gives energy ends in an
// error that says so. Sources: energy of the fall; the uncut beam; v_n = e^n v_0; the EN 50318 line
// with a rigid contact, converged: standard deviation 28.27 N, contact loss 0.4 %.
#include "scene_tests.h"

#include "output/signals.h"

using namespace verification;

namespace
{
  /// A beam of 10 m falls 0.1 m flat on stops under all its nodes: 196.2 J.
  const std::string flat_drop =
      R"(Gravity = 0, -9.81; Start = undeformed
Wire w: To = 10, 0; Components = beam; Mass per length = 20; Bending stiffness = 2e5;
  Element size = 0.25
Link stop: Type = stop; From = ground; To = w @ 0:0.25:10; Direction = 0, 1; Gap = 0.1
Time: Step = 1e-3; End = 0.5
)";
  constexpr double energy_of_fall = 196.2;

  /// A string hits a wall that it touches everywhere: 0.25 J.
  const std::string flat_wall =
      R"(Gravity = 0, 0; Start = given
Wire w: To = 1, 0; Components = string; Degree = 1; Mass per length = 1; Tension = 1;
  Element size = 0.02; Initial transverse velocity = -sin(pi*s)
Support ends: Wire = w; Positions = 0, 1
Link wall: Type = stop; From = ground; To = w @ 0.02:0.02:0.98; Direction = 0, 1
Time: Step = 5e-3; End = 0.5
)";

  struct Fall
  {
    double rebound = 0.,
           energy = 0.; ///< largest gap after the hit [m], largest energy over the fall's
    std::string error;
  };
  Fall fall(const Overrides &overrides)
  {
    Fall result;
    const Callback record = [&](const taut::StepView &view)
    {
      raise(result.energy, energy_of_bodies(view.structure, view.state) / energy_of_fall);
      for (const double gap : view.state.distance)
        if (view.state.time > .16)
          result.rebound = std::max(result.rebound, gap);
    };
    result.error = error_of([&] { run_scene(flat_drop, overrides, record); });
    return result;
  }

  struct Line
  {
    double deviation = 0., loss = 0., largest = 0.; ///< [N, 1, N]
    long n_steps = 0;
    std::string error, log;
  };

  /// The EN line with a rigid contact; force filtered at 20 Hz from x = 240 to 360 m.
  Line rigid_line(const Overrides &overrides, const double step)
  {
    Line result;
    std::vector<double> force(1, 0.);
    double open = 0., time = 0., last = 0.;
    const auto place = [](const double t) { return 60. + t * 250. / 3.6; };
    const Callback record = [&](const taut::StepView &view)
    {
      const double N = view.state.multiplier.back(), t = view.state.time;
      if (t == 0.)
        force[0] = N;
      else
        ++result.n_steps;
      // Mean forces of unequal steps, at equal times.
      while (t > 0. && force.size() * step < t + 1e-9)
        force.push_back(N);
      if (place(t) > 240. && place(t) <= 360.)
      {
        open += N > 0. ? 0. : t - last;
        time += t - last;
        result.largest = std::max(result.largest, N);
      }
      last = t;
    };
    result.error = error_of(
        [&]
        {
          result.log = log_of(
              scene_file("en50318_2002_250"),
              overrides + Overrides{"Catenary.Pantograph pantograph.Contact stiffness=rigid",
                                    "Time.End=4.4",
                                    "Statistics.Window=", "Statistics.Expected ranges.Mean="},
              record);
        });
    const std::vector<double> smooth = taut::low_pass(force, step, 20.);
    double sum = 0., squares = 0., n = 0.;
    for (std::size_t i = 0; i < smooth.size(); ++i)
      if (const double x = place(i * step); x >= 240. && x <= 360.)
      {
        sum += smooth[i];
        squares += smooth[i] * smooth[i];
        n += 1.;
      }
    result.deviation = std::sqrt(squares / n - sum / n * sum / n);
    result.loss = open / time;
    return result;
  }
} // namespace

TEST(FlatDrop, neither_rebounds_nor_gains)
{
  for (const std::string step : {"5e-3", "2.5e-3", "1e-3", "5e-4", "2e-4"})
  {
    const Fall ours = fall({"Time.Step=" + step}),
               old = fall({"Time.Step=" + step, "Time.Scheme=BDF2"});
    const std::string name = "flat drop, step " + step + " s, ";
    EXPECT_EQ(ours.error, "") << step;
    EXPECT_LT(figure(name + "rebound", 1e3 * ours.rebound, "mm"), 5.);
    EXPECT_LT(figure(name + "largest energy over that of the fall", ours.energy), 1.001);
    EXPECT_GT(ours.energy, .9) << step;
    figure(name + "BDF2, rebound", 1e3 * old.rebound, "mm");
    EXPECT_TRUE(has(old.error, "where they can only take it")) << step << ": " << old.error;
  }
}

TEST(FlatDrop, steps_that_change_in_contact_give_nothing)
{
  const Fall adaptive =
      fall({"Time.Step=2e-3", "Time.Step control=adaptive", "Time.Adaptive step.Tolerance=1e-5"});
  EXPECT_EQ(adaptive.error, "");
  EXPECT_LT(figure("flat drop, adaptive, rebound", 1e3 * adaptive.rebound, "mm"), 5.);
  EXPECT_LT(figure("flat drop, adaptive, largest energy over that of the fall", adaptive.energy),
            1.001);
}

TEST(FlatWall, takes_all_energy_of_a_string)
{
  const std::vector<double> energy = history_of(
      flat_wall, {"Time.Mass redistribution=no"},
      [](const taut::StepView &view) { return energy_of_bodies(view.structure, view.state); });
  EXPECT_NEAR(energy.front(), .25, 1e-3);
  EXPECT_LT(figure("string on a flat wall, energy after the hit over that before",
                   energy.back() / energy.front()),
            1e-3);
}

// Through the first 20 ms after the hit: then the falling beam chatters, and what rounding changes
// grows a hundredfold in 20 ms, as a gap does that is off by 1e-14 m.
TEST(Pieces, move_as_the_uncut_beam_in_contact)
{
  for (const std::string &scene : {flat_drop, scene_file("beam_over_supports")})
  {
    std::vector<double> whole;
    for (const std::string n : {"1", "2", "4", "8"})
    {
      std::vector<double> places;
      run_scene(scene,
                {"Partition.Number of substructures=" + n, "Time.Step=1e-3",
                 scene == flat_drop ? "Time.End=0.165" : "Time.End=0.5"},
                [&](const taut::StepView &view)
                {
                  for (int i = 0; i <= 20; ++i)
                    places.push_back(displacement(view, 0, view.scene.wires[0].length() * i / 20.));
                });
      if (n == "1")
        whole = places;
      else
        EXPECT_LT(figure((scene == flat_drop ? "flat drop in " : "beam over supports in ") + n +
                             " pieces, largest difference of the motion",
                         largest_difference(whole, places) / largest(places)),
                  1e-10);
    }
  }
}

// From 1 m with 10 m/s^2: peaks of e^(2n) m.
TEST(Restitution, a_ball_rises_to_the_heights_of_newtons_law)
{
  std::vector<double> peaks;
  double highest = 0.;
  bool has_hit = false;
  run_scene(R"(Gravity = 0, -10; Start = given
Mass ball: Position = 0, 1; Mass = 2
Link floor: Type = stop; From = ground; To = ball; Direction = 0, 1; Gap = 1
Time: Step = 1e-3; End = 4
Time/Moreau-Jean: Restitution = 0.8
)",
            {},
            [&](const taut::StepView &view)
            {
              const double height = view.state.distance[0];
              if (view.state.multiplier[0] > 0.)
              {
                if (has_hit && highest > 0.)
                  peaks.push_back(highest);
                has_hit = true;
                highest = 0.;
              }
              highest = has_hit ? std::max(highest, height) : 0.;
            });
  ASSERT_GE(peaks.size(), 4u);
  for (int i = 0; i < 4; ++i)
    EXPECT_NEAR(figure("ball, restitution 0.8, peak " + std::to_string(i + 1), peaks[i], "m"),
                std::pow(.8, 2. * (i + 1)), 4e-3);
}

TEST(RigidLine, moreau_jean_by_name_is_converged_at_a_millisecond)
{
  const Line line = rigid_line({"Time.Scheme=Moreau-Jean"}, 1e-3);
  EXPECT_EQ(line.error, "");
  EXPECT_NEAR(
      figure("EN line, rigid contact, Moreau-Jean, standard deviation", line.deviation, "N"), 28.27,
      .2827);
  EXPECT_GT(figure("EN line, rigid contact, Moreau-Jean, contact loss", 100. * line.loss, "%"), .2);
  EXPECT_LT(line.loss, .005);
  figure("EN line, rigid contact, Moreau-Jean, largest force", line.largest, "N");
}

// Their gaps drift: refused, and if forced, the head leaves the wire and the run ends in an error.
TEST(RigidLine, conditions_on_velocities_are_refused)
{
  const Overrides of_rates = {"Time.Scheme=Moreau-Jean", "Time.Moreau-Jean.Conditions=velocities"};
  const std::string refusal = rigid_line(of_rates, 1e-3).error;
  EXPECT_TRUE(has(refusal, "let the gap of a moving rigid contact drift")) << refusal;
  EXPECT_TRUE(has(refusal, "'gaps then velocities'")) << refusal;
  const Overrides forced = of_rates + Overrides{"Time.Allow unsuitable scheme=true"};
  const std::string error = rigid_line(forced, 1e-3).error;
  EXPECT_TRUE(has(error, "unilateral links gave")) << error;
  const Line line = rigid_line(forced + Overrides{"Time.Allow energy gain=true"}, 1e-3);
  EXPECT_EQ(line.error, "");
  EXPECT_TRUE(has(line.log, "presses across a gap")) << line.log;
}

// Fixed steps of 1 ms, 6912 of them, have 28.33 N.
TEST(RigidLine, adaptive_steps_keep_the_force)
{
  for (const std::string tolerance : {"1e-4", "1e-5"})
  {
    const Line line = rigid_line(
        {"Time.Step control=adaptive", "Time.Adaptive step.Tolerance=" + tolerance}, 1e-3 / 64.);
    const std::string name = "EN line, rigid contact, adaptive, tolerance " + tolerance;
    EXPECT_EQ(line.error, "");
    EXPECT_NEAR(figure(name + ", standard deviation", line.deviation, "N"), 28.27, .02 * 28.27);
    EXPECT_LT(figure(name + ", largest force", line.largest, "N"), 800.);
    EXPECT_LT(figure(name + ", steps", line.n_steps), 6912);
  }
}

// Nodes without mass move in a scheme that projects velocities as damping makes them: the largest
// uplift of the beam over supports is that with mass, beside what its redistribution changes.
TEST(MassRedistribution, of_a_damped_beam_keeps_its_motion)
{
  const auto uplift = [](const std::string &massless)
  {
    const std::vector<double> u = history_of(
        scene_file("beam_over_supports"),
        {"Time.Scheme=Moreau-Jean", "Time.Mass redistribution=" + massless, "Time.End=1"},
        [](const taut::StepView &view) { return displacement(view, 0, 5.); });
    return *std::max_element(u.begin(), u.end());
  };
  const double with_mass = uplift("no"), without = uplift("mass");
  figure("beam over supports, uplift with and without mass at its supports", without / with_mass);
  EXPECT_NEAR(without, with_mass, .02 * with_mass);
}

// A bar's node of 25 g at 10 m/s closes: 0.25 N s in one step, beside 300 N. Elements of 25 mm
// resolve 2 / omega_max = 0.5 ms or less.
TEST(Measures, name_a_peak_that_is_an_impulse)
{
  const auto resolution = [](const std::string &step)
  {
    Session session(scene_file("bar_on_wall"),
                    {"Time.Scheme=automatic", "Time.Mass redistribution=no", "Time.Step=" + step,
                     "Time.End=0.55"});
    double peak = 0.;
    session.run([&](const taut::StepView &view) { peak = view.measures.summary().resolution; });
    figure("bar on a wall, step " + step + " s, peak over its mean", peak);
    EXPECT_EQ(peak > 3., has(session.log(), "is an impulse over a step"));
    return peak;
  };
  EXPECT_LT(resolution("1e-3"), 1.5);
  EXPECT_GT(resolution("1e-5"), 3.);
}
