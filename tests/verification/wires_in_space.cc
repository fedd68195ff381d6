// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: wires and masses in space move along all three axes by the same equations. Sources: a
// scene of the plane, turned about x; the parabola of a taut string; forces at the kinks of a
// polygon; statics of a mass on two ropes; the uncut wire.
#include "scene_tests.h"

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

using namespace verification;

namespace
{
  /// All that a run shows: multipliers, gaps, probes and forces of supports of each step.
  struct History
  {
    std::vector<double> values;
    std::size_t n_steps = 0, n_open = 0, n_cuts = 0;
  };

  History history(const std::string &scene, const std::size_t n_supports,
                  const Overrides &overrides = {})
  {
    History result;
    run_scene(scene, overrides,
              [&](const taut::StepView &step)
              {
                ++result.n_steps;
                result.n_cuts = step.structure.cut_constraints().size();
                std::vector<double> &values = result.values;
                for (std::size_t i = 0; i < step.constraints.size(); ++i)
                  if (step.constraints[i].is_link())
                  {
                    values.push_back(step.state.multiplier[i]);
                    result.n_open += step.state.multiplier[i] == 0.;
                  }
                values.insert(values.end(), step.probes.begin(), step.probes.end());
                values.insert(values.end(), step.supports.begin(),
                              step.supports.begin() + n_supports);
              });
    return result;
  }

  /// Largest difference of each column over the largest value of that column in any step.
  double difference(const History &a, const History &b)
  {
    if (a.values.size() != b.values.size() || a.n_steps != b.n_steps || a.n_steps == 0)
      return INFINITY;
    const std::size_t n = a.values.size() / a.n_steps;
    double worst = 0.;
    for (std::size_t column = 0; column < n; ++column)
    {
      double error = 0., size = 0.;
      for (std::size_t i = column; i < a.values.size(); i += n)
      {
        raise(error, a.values[i] - b.values[i]);
        raise(size, a.values[i]);
      }
      EXPECT_GT(size, 0.) << "column " << column << " says nothing";
      worst = std::max(worst, error / size);
    }
    return worst;
  }

  /// Two wires, one inclined, droppers, a mass with a stop, a sliding contact and loads in the
  /// plane of x and y; or turned about x into that of x and z.
  std::string scene_in_a_plane(const bool turned)
  {
    std::string text = R"(Gravity = (0, -9.81)
Wire lower: From = (0, 0); To = (24, 0); Components = beam{lateral}; Mass per length = 1.2;
  Tension = 9000; Bending stiffness = 150; Element size = 0.5; Stiffness damping = 1e-3
Wire upper: From = (0, 1.4); To = (24, 3); Components = bar, string{lateral};
  Mass per length = 0.8; Tension = 8000; Axial stiffness = 1e6; Element size = 1;
  Mass damping = 0.1
Support lower ends: Wire = lower; Positions = 0, 24; Motion = {across}
Support clamp: Wire = lower; Motion = {slope}
Support arm: Wire = lower; Positions = 14; Motion = {across}; Type = elastic; Stiffness = 300;
  Damping = 12
Support upper ends: Wire = upper; Positions = 0, 24; Motion = {across};
  Displacement = 0.01*sin(3*t)
Support upper foot: Wire = upper; Motion = axial
Point mass clip: Wire = upper; Positions = 9.3; Mass = 0.6
Mass head: Position = (4, -1); Motions = x, {y}; Mass = 8; Weight = false
Mass block: Position = (4, -2); Motions = {y}; Mass = 15
Spring spring: From = block; To = head; Direction = (0.3, 1); Stiffness = 5000; Damping = 60
Spring base: From = ground; To = head; Direction = (1, -0.2); Stiffness = 700; Damping = 20
Link hanger: Type = dropper; From = upper @ 6; To = lower @ 6; Stiffness = 1e5; Gap = -0.03
Link slanting: Type = dropper; From = upper @ 19; To = lower @ 17; Stiffness = 1e5; Gap = 0.002
Link slider: Type = sliding contact; From = head; To = lower @ 4; Direction = (0, 1);
  Stiffness = 50000; Speed = 12
Link bump: Type = stop; From = ground; To = block; Direction = (0, 1); Stiffness = 1e5
Load push: On = block; Direction = (0, 1); Magnitude = 190
Load gust: Type = distributed; On = upper @ 0; Direction = (0.2, -1); Magnitude = 2*sin(2*t)*s
Load wheel: Type = moving; On = upper @ 1; Direction = (0, -1); Magnitude = 120; Speed = 15
Load shove: On = upper @ 20; Direction = (1, 1); Magnitude = 60*sin(9*t)
Time: Scheme = BDF2; Step = 2e-3; End = 1
Probe under: Point = lower @ 11; Direction = (0, 1)
Probe over: Point = upper @ 13.7; Direction = (0, 1)
Probe along: Point = upper @ 13.7; Direction = (1, 0)
Probe head across: Point = head; Direction = (0, 1)
Probe head along: Point = head; Direction = (1, 0)
)";
    const auto replace = [&](const std::string &from, const std::string &to)
    { text = std::regex_replace(text, std::regex(from), to); };
    replace("\\((\\S+), (\\S+)\\)", turned ? "$1, 0, $2" : "$1, $2");
    replace("\\{lateral\\}", turned ? ", lateral" : "");
    replace("\\{across\\}", turned ? "lateral" : "transverse");
    replace("\\{slope\\}", turned ? "lateral slope" : "slope");
    replace("\\{y\\}", turned ? "z" : "y");
    if (turned)
      text += "Support lower level: Wire = lower; Positions = 0, 24\n"
              "Support upper level: Wire = upper; Positions = 0, 24\n";
    return text;
  }

  /// A contact wire with stagger, its lateral supports at every mast; wind across it.
  const char *const staggered = R"(Gravity = 0, 0
Wire contact: From = 0, 0; To = 250, 0; Components = string, lateral; Mass per length = 1.35;
  Tension = 20000; Element size = 5
Wire by links: From = 0, 0, 5; To = 250, 0, 5; Components = string, lateral;
  Mass per length = 1.35; Tension = 20000; Element size = 5
Support height: Wire = contact; Positions = 0:50:250
Support height by links: Wire = by links; Positions = 0:50:250
Support left: Wire = contact; Positions = 0, 100, 200; Motion = lateral; Displacement = 0.2
Support right: Wire = contact; Positions = 50, 150, 250; Motion = lateral; Displacement = -0.2
Link arms left: To = by links @ 0, 100, 200; Direction = 0, 0, 1; Gap = -0.2
Link arms right: To = by links @ 50, 150, 250; Direction = 0, 0, 1; Gap = 0.2
Time: End = 0
)";

  double sum(const std::vector<double> &values, const std::size_t begin, const std::size_t end)
  {
    return std::accumulate(values.begin() + begin, values.begin() + end, 0.);
  }

  const std::vector<taut::Coordinates> axes = {{1., 0., 0.}, {0., 1., 0.}, {0., 0., 1.}};

  /// Supports of a wire at some places, one for each motion.
  std::string held(const std::string &wire, const std::string &places,
                   const std::vector<std::string> &motions = {"transverse", "lateral"})
  {
    std::string text;
    for (const std::string &motion : motions)
      text += "Support " + wire + " " + motion + ": Wire = " + wire + "; Positions = " + places +
              "; Motion = " + motion + "\n";
    return text;
  }

  const std::vector<std::string> all_motions = {"axial", "transverse", "lateral"};

  /// A wire without weight, held where it begins.
  std::string stay(const std::string &name, const std::string &from, const std::string &to,
                   const double tension)
  {
    return "Wire " + name + ": From = " + from + "; To = " + to +
           "; Components = bar, string, lateral; Tension = " + std::to_string(tension) +
           "; Mass per length = 1; Axial stiffness = 1e6; Weight = false; Element size = 5\n" +
           held(name, "0", all_motions);
  }

  std::string joint(const std::string &name, const std::string &from, const std::string &to,
                    const std::string &direction)
  {
    return "Link " + name + ": From = " + from + "; To = " + to +
           (direction.empty() ? "; Type = ball joint" : "; Direction = " + direction) + "\n";
  }

  /// Displacement in a static state of the end of wire 0 along x, y and z.
  std::array<double, 3> rest(const std::string &sections, std::vector<taut::Load> *loads = nullptr)
  {
    std::array<double, 3> u;
    run_scene("Gravity = 0, 0\nTime: End = 0\n" + sections, {},
              [&](const taut::StepView &step)
              {
                for (unsigned int i = 0; i < 3; ++i)
                  u[i] = displacement(step, 0, step.scene.wires[0].length(), axes[i]);
                if (loads != nullptr)
                  *loads = step.scene.loads;
              });
    return u;
  }
} // namespace

TEST(WiresInSpace, a_scene_turned_about_x_moves_as_in_the_plane)
{
  constexpr std::size_t n_supports = 7; // those that both scenes have
  const History plane = history(scene_in_a_plane(false), n_supports),
                space = history(scene_in_a_plane(true), n_supports);
  EXPECT_GT(plane.n_open, 0u);
  const double worst = difference(plane, space);
  EXPECT_LT(worst, 1e-10);
  figure("motion of a scene turned about x against the plane, relative", worst);
}

TEST(WiresInSpace, wind_blows_a_string_off_by_the_parabola)
{
  const double L = 60., T = 10000., w = 8., sin = .6; // the wind is inclined by 3/5
  const std::string scene =
      R"(Wire wire: To = 60, 0; Components = string, lateral; Mass per length = 1;
  Tension = 10000; Element size = 2.5
Load wind: Type = distributed; On = wire @ 0; Direction = 0, 3, 4; Magnitude = 8
Time: End = 0
)";
  run_scene(scene + held("wire", "0, 60"), {},
            [&](const taut::StepView &step)
            {
              const double across = displacement(step, 0, 30., axes[2]),
                           up = displacement(step, 0, 30., axes[1]),
                           exact = .8 * w * L * L / (8. * T);
              EXPECT_NEAR(across, exact, 1e-6 * across);
              EXPECT_NEAR(up, (sin * w - 9.81) * L * L / (8. * T), 1e-6 * across);
              EXPECT_NEAR(step.supports.at(2), -.8 * w * L / 2., 1e-9 * w * L);
              figure("blow-off of a string, error relative", std::fabs(across / exact - 1.));
            });
}

TEST(WiresInSpace, a_wire_along_z_has_its_transverse_motion_along_y)
{
  run_scene(R"(Wire headspan: From = 3, 6, -10; To = 3, 6, 10; Components = string, lateral;
  Mass per length = 2; Tension = 5000
Support height: Wire = headspan; Positions = 0, 20
Support side: Wire = headspan; Positions = 0, 20; Motion = lateral; Displacement = 0.1
Time: End = 0
)",
            {},
            [](const taut::StepView &step)
            {
              EXPECT_NEAR(displacement(step, 0, 10., axes[1]), -2. * 9.81 * 400. / 40000., 1e-9);
              // z x y = -x
              EXPECT_NEAR(displacement(step, 0, 10., axes[0]), -.1, 1e-12);
              EXPECT_EQ(displacement(step, 0, 10., axes[2]), 0.);
            });
}

TEST(WiresInSpace, stagger_pulls_at_the_arms_by_tension_times_change_of_direction)
{
  const double T = 20000., at_end = T * .4 / 50.;
  Session session(staggered);
  double worst = 0.;
  session.run(
      [&](const taut::StepView &step)
      {
        // left at 0, 100, 200 m, then right at 50, 150, 250 m
        const std::vector<double> expected = {at_end,       2. * at_end,  2. * at_end,
                                              -2. * at_end, -2. * at_end, -at_end};
        ASSERT_EQ(step.supports.size(), 18u);
        ASSERT_EQ(step.constraints.size(), 6u);
        for (std::size_t i = 0; i < 6; ++i)
        {
          for (const double found : {step.supports[12 + i], step.state.multiplier[i]})
          {
            EXPECT_NEAR(found, expected[i], 1e-8 * at_end) << i;
            raise(worst, found - expected[i]);
          }
          EXPECT_NEAR(step.supports[i], 0., 1e-8 * at_end) << i;
        }
        for (const double x : {0., 12.5, 50., 80., 250.})
          EXPECT_NEAR(displacement(step, 0, x, axes[2]),
                      .2 - .4 * std::fabs(std::remainder(x, 100.)) / 50., 1e-12);
      });
  figure("lateral force at an arm against tension times change of direction, relative",
         worst / at_end);
}

TEST(WiresInSpace, inclined_droppers_pull_along_their_lines)
{
  // A mass at the origin hangs on points of two wires along x, both in the vertical plane through
  // the horizontal h = (3, 0, 4)/5: 2 m along h and 3 m above it, 1 m against h and 4 m above it.
  const double W = 20. * 9.81, l1 = std::hypot(2., 3.), l2 = std::hypot(1., 4.);
  const double T1 = W * l1 * 1. / (3. * 1. + 4. * 2.), T2 = W * l2 * 2. / (3. * 1. + 4. * 2.);
  std::string text = R"(Mass weight: Position = 0, 0, 0; Motions = x, y, z; Mass = 20
Spring stay: To = weight; Direction = -4, 0, 3; Stiffness = 1000
Link right rope: Type = dropper; From = right @ 11.2; To = weight; Stiffness = 1e5
Link left rope: Type = dropper; From = left @ 9.4; To = weight
Time: End = 0
)";
  for (const auto &[name, height] :
       {std::pair<std::string, std::string>("right", "3, 1.6"), {"left", "4, -0.8"}})
    text += "Wire " + name + ": From = -10, " + height + "; To = 10, " + height +
            "; Components = bar, beam, lateral; Mass per length = 1; Tension = 4000; "
            "Bending stiffness = 300; Axial stiffness = 1e6; Weight = false\n" +
            held(name, "0, 20") + held(name, "0", {"axial"});
  run_scene(text, {},
            [&](const taut::StepView &step)
            {
              ASSERT_EQ(step.state.multiplier.size(), 2u);
              EXPECT_NEAR(step.state.multiplier[0], T1, 1e-9 * W);
              EXPECT_NEAR(step.state.multiplier[1], T2, 1e-9 * W);
              // The wires are held against the ropes along all three axes.
              const double right = T1 / l1, left = T2 / l2;
              EXPECT_NEAR(sum(step.supports, 0, 2), 3. * right, 1e-9 * W);
              EXPECT_NEAR(sum(step.supports, 2, 4), 1.6 * right, 1e-9 * W);
              EXPECT_NEAR(step.supports[4], 1.2 * right, 1e-9 * W);
              EXPECT_NEAR(sum(step.supports, 5, 7), 4. * left, 1e-9 * W);
              EXPECT_NEAR(sum(step.supports, 7, 9), -.8 * left, 1e-9 * W);
              EXPECT_NEAR(step.supports[9], -.6 * left, 1e-9 * W);
              figure("tensions of two inclined ropes in space, relative",
                     std::max(std::fabs(step.state.multiplier[0] / T1 - 1.),
                              std::fabs(step.state.multiplier[1] / T2 - 1.)));
            });
}

TEST(WiresInSpace, length_of_an_inclined_dropper_is_found_along_its_line)
{
  std::string text =
      "Link dropper: Type = dropper; From = messenger @ 20, 30; To = contact @ 20, 30; "
      "Find length = true; Prescribed displacement = -0.01; Axial stiffness = 1e5; "
      "Mass per length = 0.1\n"
      "Time: End = 0\n";
  for (const auto &[name, end] :
       {std::pair<std::string, std::string>("messenger", ", 1.2, 0.5"), {"contact", ", 0, 0"}})
    text += "Wire " + name + ": From = 0" + end + "; To = 50" + end +
            "; Components = string, lateral; Mass per length = 1.1; Tension = 15000\n" +
            held(name, "0, 50");
  run_scene(text, {},
            [&](const taut::StepView &step)
            {
              const taut::Coordinates n = {0., -1.2 / 1.3, -.5 / 1.3};
              for (const std::size_t i : {0, 1})
              {
                const double s = i == 0 ? 20. : 30., from = displacement(step, 0, s, n),
                             to = displacement(step, 1, s, n);
                EXPECT_NEAR(to, .01, 1e-10);
                EXPECT_GT(step.state.multiplier[i], 0.);
                EXPECT_NEAR(step.scene.links[i].length, 1.3 + to - from, 1e-10);
              }
            });
}

TEST(WiresInSpace, a_polygon_of_wires_is_joined_along_all_axes)
{
  // Two wires with a kink of 0.016 under a skew load: as one straight string but for the square of
  // the angle. The kink pulls with tension times change of direction, 320 N along z.
  const std::string place = "50.001599974400820", first = "first @ " + place,
                    properties = "; Components = bar, string, lateral; Mass per length = 1; "
                                 "Tension = 20000; Axial stiffness = 1e7\n",
                    text = "Gravity = 0, 0\nTime: End = 0\n"
                           "Wire first: From = 0, 0, 0.2; To = 50, 0, -0.2" +
                           properties + "Wire second: From = 50, 0, -0.2; To = 100, 0, 0.2" +
                           properties + held("first", "0", all_motions) +
                           held("second", place, all_motions) +
                           joint("along", first, "second @ 0", "1, 0, 0") +
                           joint("up", first, "second @ 0", "0, 1, 0") +
                           joint("across", first, "second @ 0", "0, 0, 1") +
                           "Load wind: On = " + first + "; Direction = 0, -3, 4; Magnitude = 200\n";
  run_scene(text, {},
            [&](const taut::StepView &step)
            {
              const double stiffness = 4. * 20000. / 100.;
              const double force[3] = {0., -120., 160. + 320.};
              for (unsigned int i = 0; i < 3; ++i)
              {
                const double first = displacement(step, 0, 50.001599974400820, axes[i]),
                             second = displacement(step, 1, 0., axes[i]);
                EXPECT_NEAR(first, second, 1e-11);
                // Along z the bars hold the kink, too: EA angle^2 beside T.
                const double k = stiffness + (i == 2 ? 4. * 1e7 * .008 * .008 / 100. : 0.);
                if (i > 0)
                {
                  EXPECT_NEAR(first, force[i] / k, 1e-3 * std::fabs(force[i] / k)) << i;
                }
              }
            });
}

TEST(WiresInSpace, pulls_where_wires_meet_are_in_equilibrium_with_their_stiffness)
{
  // Three wires of 20 m meet at the origin, with tensions that are not in equilibrium there. Each
  // gives way by EA along itself and by T across: a 3 x 3 system.
  const double EA = 1e6, length = 20.;
  const std::array<std::array<double, 3>, 3> tangent = {
      {{1., 0., 0.}, {-.6, 0., .8}, {0., -.6, -.8}}}; // towards the origin
  const std::array<double, 3> T = {2000., 3000., 2500.};
  std::string sections;
  for (unsigned int k = 0; k < 3; ++k)
  {
    std::string from;
    for (const double t : tangent[k])
      from += (from.empty() ? "" : ", ") + std::to_string(-length * t);
    sections += stay(std::string(1, 'a' + k), from, "0, 0, 0", T[k]);
  }
  dealii::FullMatrix<double> A(3, 3);
  dealii::Vector<double> pull(3), exact(3);
  for (unsigned int k = 0; k < 3; ++k)
    for (unsigned int i = 0; i < 3; ++i)
    {
      pull[i] -= T[k] * tangent[k][i];
      for (unsigned int j = 0; j < 3; ++j)
        A(i, j) += ((EA - T[k]) * tangent[k][i] * tangent[k][j] + (i == j ? T[k] : 0.)) / length;
    }
  A.gauss_jordan();
  A.vmult(exact, pull);
  const auto expect = [&](const std::array<double, 3> &found)
  {
    for (unsigned int i = 0; i < 3; ++i)
      EXPECT_NEAR(found[i], exact[i], 1e-9 * exact.l2_norm()) << i;
  };
  expect(
      rest(sections + joint("ab", "a @ 20", "b @ 20", "") + joint("ac", "a @ 20", "c @ 20", "")));
  // The same with directions that are not orthogonal.
  for (const std::string other : {"b", "c"})
    for (const auto &[number, direction] :
         {std::pair("1", "1, 0, 0"), {"2", "1, 1, 0"}, {"3", "0, 1, -2"}})
      sections += joint(other + number, "a @ 20", other + " @ 20", direction);
  expect(rest(sections));
}

TEST(WiresInSpace, pulls_do_not_depend_on_the_order_of_joints)
{
  // One joint each, along directions that are neither alike nor across each other.
  const std::string sections = stay("a", "-20, 0, 0", "0, 0, 0", 2000.) +
                               stay("b", "12, 0, 16", "0, 0, 0", 3000.) +
                               stay("c", "0, 12, -16", "0, 0, 0", 2500.),
                    first = joint("ab", "a @ 20", "b @ 20", "1, 0, 0"),
                    second = joint("ac", "a @ 20", "c @ 20", "1, 1, 0");
  const std::array<double, 3> one = rest(sections + first + second),
                              other = rest(sections + second + first);
  EXPECT_GT(std::fabs(one[1]), .1);
  for (unsigned int i = 0; i < 3; ++i)
    EXPECT_NEAR(one[i], other[i], 1e-12);
}

TEST(WiresInSpace, a_wire_that_goes_on_straight_pulls_nothing)
{
  const auto sections = [](const double second) {
    return stay("a", "0, 0, 0", "16, 12, 0", 2000.) + stay("b", "32, 24, 0", "16, 12, 0", second);
  };
  const std::string joints = joint("j", "a @ 20", "b @ 20", "");
  std::vector<taut::Load> loads;
  const std::array<double, 3> straight = rest(sections(2000.) + joints, &loads);
  EXPECT_TRUE(loads.empty());
  EXPECT_EQ(straight[0], 0.);
  // Another tension in the second one draws the joint towards it, held by both bars.
  const std::array<double, 3> drawn = rest(sections(3000.) + joints, &loads);
  ASSERT_FALSE(loads.empty());
  EXPECT_NEAR(std::hypot(drawn[0], drawn[1]), 1000. * 20. / 2e6, 1e-9);
  EXPECT_NEAR(drawn[1] / drawn[0], .75, 1e-9);
  // A joint across alone passes on none of it.
  rest(sections(3000.) + joint("j", "a @ 20", "b @ 20", "-3, 4, 0"), &loads);
  EXPECT_TRUE(loads.empty());
}

TEST(WiresInSpace, a_wire_in_four_parts_moves_as_the_whole)
{
  const std::string text = staggered + std::string(R"(Gravity = 0, -9.81, 2
Wire contact: Components = beam, lateral; Bending stiffness = 150
Wire by links: Components = beam, lateral; Bending stiffness = 150
Load gust: Type = distributed; On = contact @ 0; Direction = 0, 1, 2;
  Magnitude = 5*sin(6*t)*sin(s/30)
Time: Scheme = BDF2; Step = 2e-3; End = 0.4
Probe side: Point = contact @ 133; Direction = 0, 0, 1
Probe height: Point = contact @ 133
)");
  const History whole = history(text, 18),
                parts = history(text, 18, {"Partition.Number of substructures=4"});
  // Value and slope of the transverse and the lateral motion at each cut.
  EXPECT_GT(parts.n_cuts, 0u);
  EXPECT_EQ(parts.n_cuts % 4, 0u);
  const double worst = difference(whole, parts);
  EXPECT_LT(worst, 1e-10);
  figure("staggered wire in four parts against the whole, relative", worst);
}

TEST(WiresInSpace, steady_arms_that_only_pull_go_slack_in_the_wind)
{
  const double T = 20000., L = 50., a = .2;
  bool is_start = true;
  double slack = 0., force = 0., moved = 0.;
  run_scene(scene_file("wire_in_space"), {},
            [&](const taut::StepView &step)
            {
              const std::vector<double> &N = step.state.multiplier;
              ASSERT_EQ(N.size(), 3u);
              if (is_start)
              {
                EXPECT_NEAR(N[0], 4. * a * T / L - 4. * L, 1e-6);
                EXPECT_NEAR(N[1], N[0], 1e-6);
                EXPECT_NEAR(N[2], 4. * a * T / L + 4. * L, 1e-6);
                EXPECT_NEAR(displacement(step, 0, 25., axes[2]), 4. * L * L / (8. * T), 1e-9);
                EXPECT_NEAR(displacement(step, 0, 25., axes[1]), -1.35 * 9.81 * L * L / (8. * T),
                            1e-9);
              }
              is_start = false;
              slack = N[0] == 0. ? step.state.distance[0] : 0.;
              force = N[2];
              moved = step.probes.at(0);
            });
  EXPECT_NEAR(figure("slack of a steady arm in the wind", slack, "m"),
              8. * L * L / (2. * T) - 2. * a, 1e-3);
  EXPECT_NEAR(figure("force of the other arm", force, "N"), 2. * 8. * L, 8.);
  EXPECT_NEAR(moved, .1125, 1e-3);
}

TEST(WiresInSpace, given_starts_move_along_z)
{
  // A string between two supports in its first mode, w = a cos(c pi t/L) sin(pi s/L), and a mass
  // that flies, each along z.
  const double a = .01, L = 10., c = 20., g = 3., v = .5, z = .2;
  double worst = 0.;
  run_scene(R"(Gravity = 0, 0, -3; Start = given
Wire string: To = 10, 0; Components = string, lateral; Mass per length = 1; Tension = 400;
  Element size = 0.5; Weight = false; Initial lateral displacement = 0.01*sin(pi*s/10)
Support level: Wire = string; Positions = 0, 10
Support ends: Wire = string; Positions = 0, 10; Motion = lateral
Mass ball: Motions = z; Mass = 2; Initial displacement = 0, 0, 0, 0.2;
  Initial velocity = 0, 0, 0, 0.5
Time: Scheme = BDF2; Step = 2e-4; End = 1
Probe middle: Point = string @ 5; Direction = 0, 0, 1
Probe ball: Point = ball; Direction = 0, 0, 1
)",
            {},
            [&](const taut::StepView &step)
            {
              const double t = step.state.time;
              raise(worst, step.probes.at(0) - a * std::cos(c * std::acos(-1.) * t / L));
              EXPECT_NEAR(step.probes.at(1), z + v * t - .5 * g * t * t, 1e-3);
            });
  EXPECT_LT(worst, 1e-3 * a);
}
