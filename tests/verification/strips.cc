// SPDX-License-Identifier: LGPL-2.1-or-later
// One strip under several wires. Source: strings of tension T and length L are springs of stiffness
// T L / (s (L - s)) under a force at s, so that strings of equal length share a force like their
// tensions. With masses that are in the ratio of the tensions, too, both strings are one string:
// they share in this ratio at all times, whatever the strip does.
#include "scene_tests.h"

using namespace verification;

namespace
{
  constexpr double length = 10., force = 60.;

  // A head under two strings, 10 m long, at the same height.
  std::string two_strings(const double tension, const double other)
  {
    const auto wire = [](const std::string &name, const double z, const double T)
    {
      return "Wire " + name + ": From = 0, 0, " + number(z) + "; To = 10, 0, " + number(z) +
             "; Components = string; Mass per length = " + number(1e-4 * T) +
             "; Tension = " + number(T) + "; Element size = 0.25\nSupport ends " + name +
             ": Wire = " + name + "; Positions = 0, 10\n";
    };
    return "Gravity = 0, 0; Start = equilibrium\n" + wire("one", 0., tension) +
           wire("two", 0.4, other) +
           "Mass head: Position = 5, 0; Mass = 0.5; Motions = y\n"
           "Link strip: Type = sliding contact; From = head; To = one @ 2, two @ 2; "
           "Direction = 0, 1; Speed = 10\n"
           "Load push: Type = point; On = head; Magnitude = 60\n"
           "Time: Step = 1e-3; End = 0.5\n";
  }

  double share(const taut::StepView &view, const std::size_t link)
  {
    return view.state.multiplier[view.constraints.index_of_link(link)];
  }

  /// Largest step of the sum of both shares, and of a share [N].
  struct Steps
  {
    double of_sum = 0., of_share = 0., least_sum = 1e300, largest_sum = 0.;
  };

  Steps steps_of(const std::string &text, const Overrides &overrides, const std::size_t first = 0,
                 const std::size_t second = 1)
  {
    Steps result;
    std::vector<double> before;
    run_scene(text, overrides,
              [&](const taut::StepView &view)
              {
                const std::vector<double> now = {share(view, first), share(view, second)};
                const double sum = now[0] + now[1];
                result.least_sum = std::min(result.least_sum, sum);
                result.largest_sum = std::max(result.largest_sum, sum);
                if (!before.empty())
                {
                  raise(result.of_sum,
                        std::max(result.of_sum, std::fabs(sum - before[0] - before[1])));
                  raise(result.of_share, std::max(result.of_share, std::fabs(now[0] - before[0])));
                }
                before = now;
              });
    return result;
  }
} // namespace

TEST(Strips, strings_share_the_force_at_rest_like_their_tensions)
{
  for (const double other : {2e4, 5e3})
  {
    double forces[2] = {}, height = 0.;
    run_scene(two_strings(2e4, other), {"Time/End=1e-3"},
              [&](const taut::StepView &view)
              {
                if (view.state.time > 0.)
                  return;
                for (const std::size_t i : {0, 1})
                  forces[i] = share(view, i);
                height = displacement(view, point_of_mass(view, 0));
              });
    const double sum = 2e4 + other;
    EXPECT_NEAR(forces[0], force * 2e4 / sum, 1e-9);
    EXPECT_NEAR(forces[1], force * other / sum, 1e-9);
    EXPECT_NEAR(height, force * 2. * 8. / (length * sum), 1e-12);
  }
}

TEST(Strips, strings_share_the_force_of_a_moving_strip_like_their_tensions)
{
  for (const double other : {2e4, 5e3})
  {
    double error = 0., least = 1e300, largest = 0.;
    run_scene(two_strings(2e4, other), {},
              [&](const taut::StepView &view)
              {
                const double one = share(view, 0), two = share(view, 1), sum = one + two;
                raise(error, std::max(error, std::fabs(two - sum * other / (2e4 + other))));
                least = std::min(least, sum);
                largest = std::max(largest, sum);
              });
    figure("strip on two strings, error of a share", error, "N");
    EXPECT_LT(error, 1e-7);
    EXPECT_GT(largest - least, .1) << "the force has to change, or its sharing is not tested";
  }
}

// Claim: each wire has the strip at its own place. Strings whose mass is a thousandth of the head's
// are springs, of stiffness T L / (s (L - s)). Expected: the forces are in the ratio of these
// stiffnesses at the places under the strip. The ratio goes from 0.44 to 1.9.
namespace
{
  /// A head under two strings in space, from x = 8 m on with 20 m/s. The second one is drawn as it
  /// is said.
  std::string opposite_wires(const std::string &second, const std::string &strip)
  {
    const std::string wire = "; Components = string; Mass per length = 1; Tension = 1e4"
                             "; Element size = 0.25; Stiffness damping = 0.001; Weight = false\n";
    return "Gravity = 0, 0; Start = equilibrium\nWire a: From = 0, 0, 0; To = 20, 0, 0" + wire +
           "Wire b: " + second + wire +
           R"(Support a: Wire = a; Positions = 0, 20
Support b: Wire = b; Positions = 0, 20
Mass h: Position = 8, 0; Motions = y; Mass = 2; Weight = false
Load F: On = h; Magnitude = 60
)" + strip +
           "Time: Step = 0.0002; End = 0.4\n";
  }

  const std::string along = "From = 0, 0, 0.3; To = 20, 0, 0.3",
                    against = "From = 20, 0, 0.3; To = 0, 0, 0.3",
                    on_both = "; Type = sliding contact; From = h; Direction = 0, 1; Stiffness = "
                              "50000; Speed = ";

  std::vector<double> shares(const std::string &scene)
  {
    std::vector<double> result;
    run_scene(scene, {},
              [&](const taut::StepView &view)
              {
                for (const std::size_t link : {0, 1})
                  result.push_back(share(view, link));
              });
    return result;
  }
} // namespace

// Two equal strings share the force by their symmetry, whichever end is the first of each.
TEST(Strips, strip_on_opposite_wires)
{
  const std::string strip = "Link s: To = a, b" + on_both + "20\n";
  std::vector<double> positions;
  run_scene(opposite_wires(against, strip), {},
            [&](const taut::StepView &view)
            {
              positions = {view.constraints.position(0, view.state.time),
                           view.constraints.position(1, view.state.time)};
            });
  ASSERT_EQ(positions.size(), 2u);
  EXPECT_NEAR(positions[0], 16., 1e-9);
  EXPECT_NEAR(positions[1], 4., 1e-9);
  const std::vector<double> found = shares(opposite_wires(against, strip));
  EXPECT_NEAR(found[found.size() - 2], 28.64, .005);
  EXPECT_NEAR(found[found.size() - 1], 28.64, .005);
}

// The same with a speed that changes, a slower wire in front, and links of their own.
TEST(Strips, move_with_their_head_however_a_wire_is_drawn)
{
  for (const char *const speed : {"20", "8 + 40 * t"})
  {
    const std::string list = "Link s: To = b, a" + on_both + speed + "\n",
                      backwards = "Link s: To = b, a" + on_both + "-(" + speed + ")\n";
    const std::vector<double> expected = shares(opposite_wires(along, list));
    EXPECT_LT(largest_difference(shares(opposite_wires(against, backwards)), expected),
              1e-9 * largest(expected));
    const auto own = [&](const std::string &sign)
    {
      return "Link one: Strip = s; To = b @ 12" + on_both + sign + "(" + speed + ")\n" +
             "Link two: Strip = s; To = a @ 8" + on_both + speed + "\n";
    };
    EXPECT_LT(largest_difference(shares(opposite_wires(against, own("-"))), expected),
              1e-9 * largest(expected));
    const std::string error = error_of([&] { Session(opposite_wires(against, own(""))).run(); });
    EXPECT_TRUE(has(error, "Speed")) << error;
    EXPECT_TRUE(has(error, " m on wire 'a' and by ")) << error;
  }
}

TEST(Strips, strings_of_unequal_ends_share_the_force_by_the_place_of_the_strip)
{
  const auto wire = [](const std::string &name, const double from, const double to, const double z)
  {
    return "Wire " + name + ": From = " + number(from) + ", 0, " + number(z) +
           "; To = " + number(to) + ", 0, " + number(z) +
           "; Components = string; Mass per length = 1e-5; Tension = 2e4; Element size = 0.025\n"
           "Support ends " +
           name + ": Wire = " + name + "; Positions = 0, " + number(to - from) + "\n";
  };
  const auto flexibility = [](const double s, const double L) { return s * (L - s) / L; };
  const double begin = 3., speed = 10.;
  double error = 0., least = 1e300, largest = 0.;
  run_scene("Gravity = 0, 0; Start = equilibrium\n" + wire("one", 0., 10., 0.) +
                wire("two", 2., 14., .4) + "Mass head: Position = " + number(begin) +
                ", 0; Mass = 0.5; Motions = y\n"
                "Link strip: Type = sliding contact; From = head; To = one, two; "
                "Direction = 0, 1; Speed = " +
                number(speed) +
                "\nLoad push: Type = point; On = head; Magnitude = 60\n"
                "Time: Step = 1e-3; End = 0.5\n",
            {},
            [&](const taut::StepView &view)
            {
              const double x = begin + speed * view.state.time,
                           expected = flexibility(x, 10.) / flexibility(x - 2., 12.),
                           ratio = share(view, 1) / share(view, 0);
              raise(error, std::max(error, std::fabs(ratio / expected - 1.)));
              least = std::min(least, ratio);
              largest = std::max(largest, ratio);
            });
  figure("strip on unequal strings, relative error of the ratio", error, "1");
  EXPECT_LT(error, 5e-3);
  EXPECT_GT(largest, 4. * least);
}

// Claim: a wire that begins or ends above the strip takes over without a step. The second wire is
// 20 mm higher than the first one where it begins, and falls by 4 mm a metre. Expected: the sum of
// the forces is as smooth as the step is short, both to the wire and back from it.
TEST(Strips, the_force_has_no_step_where_a_wire_begins_or_ends_above)
{
  const auto text = [](const double start, const double speed)
  {
    return "Gravity = 0, 0; Start = equilibrium\n"
           "Wire one: To = 20, 0; Components = string; Mass per length = 1; Tension = 2e4; "
           "Element size = 0.1\n"
           "Wire two: From = 8, 0.02, 0.4; To = 20, -0.028, 0.4; Components = string; "
           "Mass per length = 1; Tension = 2e4; Element size = 0.1\n"
           "Support ends one: Wire = one; Positions = 0, 20\n"
           "Support ends two: Wire = two; Positions = 0, 12\n"
           "Mass head: Position = " +
           number(start) +
           ", 0; Mass = 5; Motions = y\n"
           "Link strip: Type = sliding contact; From = head; To = one, two; Direction = 0, 1; "
           "Stiffness = 5e4; Speed = " +
           number(speed) +
           "\n"
           "Load push: Type = point; On = head; Magnitude = 60\n"
           "Time: Step = 1e-3; End = 0.95\n";
  };
  for (const double direction : {1., -1.})
  {
    const std::string scene = text(direction > 0. ? 5. : 14.5, 10. * direction);
    const Steps coarse = steps_of(scene, {}), fine = steps_of(scene, {"Time/Step=5e-4"});
    figure("strip, largest step of the sum at 1 ms", coarse.of_sum, "N");
    figure("strip, largest step of the sum at 0.5 ms", fine.of_sum, "N");
    EXPECT_LT(coarse.of_sum, 3.);
    EXPECT_LT(fine.of_sum, .65 * coarse.of_sum);
    EXPECT_GT(fine.least_sum, 0.);
  }
}

namespace
{
  /// A head that a force pushes against one wire, and against another one from x = 8 to 18 m.
  std::string begin_and_end(const double begin, const double end, const std::string &stiffness)
  {
    return "Gravity = 0, 0; Start = equilibrium\n"
           "Wire one: To = 20, 0; Components = string; Mass per length = 1; Tension = 2e4; "
           "Element size = 0.1\n"
           "Wire two: From = 8, " +
           number(begin) + ", 0.4; To = 18, " + number(end) +
           ", 0.4; Components = string; Mass per length = 1; Tension = 2e4; "
           "Element size = 0.1\n"
           "Support ends one: Wire = one; Positions = 0, 20\n"
           "Support ends two: Wire = two; Positions = 0, 10\n"
           "Mass head: Position = 6, 0; Mass = 5; Motions = y\n"
           "Link strip: Type = sliding contact; From = head; To = one, two; Direction = 0, 1; "
           "Stiffness = " +
           stiffness +
           "; Speed = 10\n"
           "Load push: Type = point; On = head; Magnitude = 60\n"
           "Time: Step = 1e-3; End = 1.3\n";
  }
} // namespace

// Claim: an end of a wire below the strip is an error, not a blow of any size.
TEST(Strips, a_wire_that_begins_below_the_strip_is_refused)
{
  const std::string error = error_of([] { run_scene(begin_and_end(-.02, .02, "5e4"), {}); });
  EXPECT_TRUE(has(error, "strip 'strip' comes to an end of wire 'two' at t = 0.2")) << error;
  EXPECT_TRUE(has(error, "Raise this end")) << error;
}

// Claim: what the spring of a contact has stored is lost where the wire ends, the run goes on, and
// a warning says so. The wire is pressed where it ends. Expected: no energy is said to come from
// the step, the head falls back to the first wire, and the warning has the force and the energy of
// the spring, N^2 / (2 k).
TEST(Strips, a_wire_may_end_while_it_is_pressed)
{
  for (const char *const stiffness : {"5e4", "rigid"})
  {
    double before = 0., at_the_end = 0.;
    taut::ContactMeasures::WireEnd end;
    Session session(begin_and_end(.02, -.01, stiffness), {});
    session.run(
        [&](const taut::StepView &view)
        {
          if (view.state.time < 1.1995)
            before = share(view, 1);
          if (view.state.time > 1.2005)
          {
            EXPECT_EQ(share(view, 1), 0.);
          }
          at_the_end = view.measures.summary().relative_energy;
          end = view.measures.wire_end(1);
        });
    EXPECT_GT(before, 1.) << "the wire has to be pressed where it ends";
    EXPECT_LT(at_the_end, .01);
    EXPECT_FALSE(has(session.log(), "unilateral links")) << session.log();
    EXPECT_EQ(end.force, before);
    EXPECT_NEAR(end.time, 1.2, 2e-3);
    const double k = std::string(stiffness) == "rigid" ? 1e300 : 5e4;
    EXPECT_NEAR(end.energy, .5 * before * before / k, 1e-12);
    EXPECT_TRUE(has(session.log(), "'strip on two' slid off the end of its wire at t = 1.2"))
        << session.log();
  }
}

// Claim: a pantograph goes from wire to wire of an overlap without a step, and without losses that
// a smaller step removes. Expected: the sum of both shares changes by less than 10 N a millisecond,
// which is what the droppers do, and half of this in half the step.
TEST(Strips, an_overlap_hands_a_pantograph_over)
{
  const Overrides fixed = {"Time/Check steps=no", "Time/End=1.7"};
  for (const char *const step : {"1e-3", "5e-4"})
  {
    double largest = 0., before = 0.;
    bool both = false;
    Session session(scene_file("real_line"), fixed + Overrides{std::string("Time/Step=") + step});
    std::size_t first = 0;
    while (session.simulation().scene().links[first].strip != "trailing")
      ++first;
    session.run(
        [&](const taut::StepView &view)
        {
          const double sum = share(view, first) + share(view, first + 1);
          both = both || (share(view, first) > 10. && share(view, first + 1) > 10.);
          if (view.state.time > 0.)
            raise(largest, std::max(largest, std::fabs(sum - before)));
          before = sum;
        });
    figure(std::string("overlap, largest step of the sum at ") + step, largest, "N");
    EXPECT_TRUE(both);
    EXPECT_LT(largest, 1e4 * std::stod(step));
    const nlohmann::json said = session.statistics();
    const auto &strip = said["sliding_contacts"]["trailing"];
    EXPECT_EQ(strip["contact_loss"]["value"], 0.);
    EXPECT_EQ(strip["wires"].size(), 2u);
    const auto share = [](const nlohmann::json &of)
    { return of["mean_share"]["value"].get<double>(); };
    const nlohmann::json &wires = strip["wires"];
    EXPECT_NEAR(strip["raw"]["mean"]["value"],
                share(wires["trailing on contact 1"]) + share(wires["trailing on contact 2"]),
                1e-9);
    EXPECT_GT(strip["wires"]["trailing on contact 2"]["not_touched"]["value"], .5);
  }
}
