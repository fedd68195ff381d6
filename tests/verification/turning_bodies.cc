// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: links that turn hold rigid bodies, cables and wires as they hold masses. Expected values:
// the lowest place, conservation of energy, impulses of Newton's laws.
#include "cable/places_in_steps.h"
#include "turning_scene.h"

using verification::g;

using namespace turning;

namespace
{
  /// A bar that spins and pulls a weight behind it on a rope from its end; a cable hangs below.
  const char *const bar_and_cable = R"(Gravity = 0, -9.81; Start = given
Body bar: Type = rigid body; Mass = 20; Moments of inertia = 1, 6, 6;
  Angular velocity = 0.5, 1, 4; Velocity = 0, 3, 0
Body cable: Type = cable; From = 1, -1; To = 2, -1; Unstressed length = 1.2;
  Axial stiffness = 1e5; Mass per length = 0.5; Element = bar; Elements = 4; Held ends = none
Mass weight: Position = 3.1, -1; Motions = x, y, z; Mass = 5
Link rope: Type = dropper; From = bar @ 1, 0; To = cable @ 0, 0; Turns = true; Length = 1.05
Link rod: Type = joint; From = cable @ 1.2, 0; To = weight; Turns = true
Time: End = 1; Step = 1e-3
Output: Observers = energy
)";
} // namespace

TEST(TurningBodies, bar_pulls_cable_and_weight)
{
  verification::Session session(bar_and_cable);
  bool opens = false, closes = false;
  double gain = 0., rod = 0.;
  session.run(
      [&](const taut::StepView &view)
      {
        const double N = view.state.multiplier[view.constraints.index_of_link(0)];
        opens = opens || (view.state.time > 0. && N == 0.);
        closes = closes || N > 0.;
        gain = std::max(gain, view.report.gain());
        const std::vector<Coordinates> ends =
            view.constraints.differences(view.reference.displacement, view.state.U);
        rod = std::max(rod, std::fabs(norm(ends[1]) - 1.1));
      });
  EXPECT_TRUE(opens && closes);
  EXPECT_LT(gain, 1e-8);
  EXPECT_LT(rod, 1e-10);
  const auto energies = verification::read_table(session.folder() + "/energy.csv");
  EXPECT_LT(std::fabs(energies.at("error [J]").back()), 1e-6 * energies.at("kinetic [J]").back());
}

TEST(TurningBodies, bar_hangs_on_two_ropes)
{
  // Level, by symmetry: half of the difference of the lengths along x is known.
  const char *const bar = R"(Gravity = 0, -9.81
Body bar: Type = rigid body; Mass = 40; Moments of inertia = 1, 6, 6
Link left: Type = dropper; Turns = true; From = ground @ -2, 2; To = bar @ -1, 0; Length = 2.5
Link right: Type = dropper; Turns = true; From = ground @ 2, 2; To = bar @ 1, 0; Length = 2.5
Time: End = 0
)";
  verification::run_scene(
      bar, {},
      [](const taut::StepView &view)
      {
        const double depth = std::sqrt(2.5 * 2.5 - 1.), N = 20. * g * 2.5 / depth;
        for (const std::size_t i : {0, 1})
          EXPECT_NEAR(view.state.multiplier[i], N, 1e-6 * N);
        const auto ends = view.constraints.differences(view.reference.displacement, view.state.U);
        EXPECT_NEAR(ends[0].y, -depth, 1e-8);
        EXPECT_NEAR(ends[0].x, 1., 1e-8);
        EXPECT_NEAR(ends[1].x, -1., 1e-8);
      });
}

TEST(TurningBodies, wire_hangs_on_a_rope)
{
  // A string of 10 m under 2 kN on a rope in its middle that turns little: its linear answer.
  const char *const string = R"(Gravity = 0, 0; Start = equilibrium
Wire wire: From = 0, 0; To = 10, 0; Components = string; Tension = 2000; Mass per length = 1
Support ends: Wire = wire; Positions = 0, 10
Link rope: Type = dropper; Turns = true; From = ground @ 5, 1; To = wire @ 5; Length = 0.9
Time: End = 0.1; Step = 1e-3
)";
  verification::run_scene(string, {},
                          [](const taut::StepView &view)
                          { EXPECT_NEAR(view.state.multiplier[0], 4. * 2000. * .1 / 10., 1e-8); });
}

// A body in two slings over its own rings with a load at a corner: what the ropes pull with, from
// the places of their ends alone, balances its weight and the load, and their moments. The search
// gains a tenth in each iteration near its end.
TEST(TurningBodies, bodies_in_slings_are_in_balance)
{
  using verification::operator+;
  struct Sling
  {
    Coordinates from, first, second, to; ///< rings on the body between places of the ground
    double length;
  };
  struct Hung
  {
    Coordinates load; ///< at (-0.8, -0.2, 0) of the body [N]
    Sling slings[2];
  };
  constexpr double mass = 50., stiffness = 4e4;
  const Coordinates at_load = {-.8, -.2, 0.};
  const Hung scenes[] = {{{70.64, 27.69, 118.56},
                          {{{-1.747, 3.252, -.182},
                            {-.785, .17, .134},
                            {.605, .12, -.192},
                            {1.979, 3.405, -.119},
                            8.3343},
                           {{.057, 2.994, -1.817},
                            {.145, .246, -.646},
                            {-.17, .363, .342},
                            {-.109, 2.954, 2.073},
                            7.2483}}},
                         {{51.69, 113.92, -11.35},
                          {{{-2.316, 2.583, -.192},
                            {-.534, .38, .012},
                            {.615, .289, -.11},
                            {1.783, 2.602, .159},
                            6.7056},
                           {{-.783, 2.604, -1.395},
                            {-.106, .193, -.507},
                            {-.049, .431, .301},
                            {.311, 3.157, 2.137},
                            6.9078}}}};
  for (const Hung &hung : scenes)
  {
    std::string text = "Gravity = 0, " + verification::number(-g) +
                       "; Start = equilibrium\nTime: End = 0\n"
                       "Body b: Type = rigid body; Mass = 50; Moments of inertia = 1.2, 2.5, 2\n"
                       "Load f: On = b @ -0.8, -0.2, 0; Direction = " +
                       turning::text(hung.load) +
                       "; Magnitude = " + verification::number(norm(hung.load)) + "\n";
    for (const Sling &sling : hung.slings)
      text += "Link r" + std::to_string(&sling - hung.slings) +
              ": Type = dropper; Turns = true; From = ground @ " + turning::text(sling.from) +
              "; Through = b @ " + turning::text(sling.first) + ", b @ " +
              turning::text(sling.second) + "; To = ground @ " + turning::text(sling.to) +
              "; Length = " + verification::number(sling.length) + "; Stiffness = 4e4\n";
    verification::run_scene(
        text, {},
        [&](const taut::StepView &view)
        {
          const auto place = [&](const Coordinates &on_body)
          {
            taut::Attachment at;
            at.kind = taut::Attachment::Kind::body;
            at.place = on_body;
            return displaced(view, at);
          };
          Coordinates force = add_scaled(hung.load, -mass * g, {0., 1., 0.}),
                      moment = cross(place(at_load), hung.load);
          moment = add_scaled(moment, 1., cross(place({}), {0., -mass * g, 0.}));
          for (const Sling &sling : hung.slings)
          {
            const Coordinates a = place(sling.first), b = place(sling.second), up = sling.from - a,
                              along = b - a, other = sling.to - b;
            const double N =
                stiffness * std::max(0., norm(up) + norm(along) + norm(other) - sling.length);
            EXPECT_GT(N, 1.);
            const auto pull = [&](const Coordinates &at, const Coordinates &way)
            {
              const Coordinates P = add_scaled({}, N / norm(way), way);
              force = add_scaled(force, 1., P);
              moment = add_scaled(moment, 1., cross(at, P));
            };
            pull(a, up);
            pull(b, other);
          }
          EXPECT_LT(norm(force), 1e-6 * mass * g);
          EXPECT_LT(norm(moment), 1e-6 * mass * g);
        });
  }
}
