// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: links that turn hold rigid bodies, cables and wires as they hold masses. Expected values:
// the lowest place, conservation of energy, impulses of Newton's laws.
#include "turning_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

using namespace turning;

namespace
{
  /// The columns of the last line of energy.csv.
  std::vector<double> last_energies(const std::string &folder)
  {
    std::ifstream table(folder + "/energy.csv");
    std::string line, last;
    while (std::getline(table, line))
      last = line;
    std::vector<double> values;
    std::istringstream in(last);
    for (std::string value; std::getline(in, value, ',');)
      values.push_back(std::stod(value));
    return values;
  }

  /// A bar that spins and pulls a weight behind it on a rope from its end; a cable hangs below.
  const char *const bar_and_cable = R"(
set Generator = network
set Gravity   = 0, -9.81
set Start     = given
set Bodies    = bar, cable

subsection Body bar
  set Type               = rigid body
  set Mass               = 20
  set Moments of inertia = 1, 6, 6
  set Angular velocity   = 0.5, 1, 4
  set Velocity           = 0, 3, 0
end

subsection Body cable
  set Type              = cable
  set From              = 1, -1
  set To                = 2, -1
  set Unstressed length = 1.2
  set Axial stiffness   = 1e5
  set Mass per length   = 0.5
  set Element           = bar
  set Elements          = 4
  set Held ends         = none
end

subsection Network
  set Masses = weight
  subsection Mass weight
    set Position = 3.1, -1
    set Motions  = x, y, z
    set Mass     = 5
  end
  set Links = rope, rod
  subsection Link rope
    set Type   = dropper
    set From   = bar @ 1, 0
    set To     = cable @ 0, 0
    set Turns  = true
    set Length = 1.05
  end
  subsection Link rod
    set Type  = joint
    set From  = cable @ 1.2, 0
    set To    = weight
    set Turns = true
  end
end

subsection Time
  set End  = 1
  set Step = 1e-3
end

subsection Output
  set Observers = energy
end
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
        gain = std::max(gain, view.certificate.energy_gain);
        const std::vector<Coordinates> ends =
            view.constraints.differences(view.reference.displacement, view.state.U);
        rod = std::max(rod, std::fabs(norm(ends[1]) - 1.1));
      });
  EXPECT_TRUE(opens && closes);
  EXPECT_LT(gain, 1e-8);
  EXPECT_LT(rod, 1e-10);
  const std::vector<double> energies = last_energies(session.folder());
  EXPECT_LT(std::fabs(energies.back()), 1e-6 * energies[1]);
}

TEST(TurningBodies, bar_hangs_on_two_ropes)
{
  // Level, by symmetry: half of the difference of the lengths along x is known.
  const char *const bar = R"(
set Generator = network
set Gravity   = 0, -9.81
set Bodies    = bar
subsection Body bar
  set Type               = rigid body
  set Mass               = 40
  set Moments of inertia = 1, 6, 6
end
subsection Network
  set Links = left, right
  subsection Link left
    set Type   = dropper
    set Turns  = true
    set From   = ground @ -2, 2
    set To     = bar @ -1, 0
    set Length = 2.5
  end
  subsection Link right
    set Type   = dropper
    set Turns  = true
    set From   = ground @ 2, 2
    set To     = bar @ 1, 0
    set Length = 2.5
  end
end
subsection Time
  set End = 0
end
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
  const char *const string = R"(
set Generator = network
set Gravity   = 0, 0
set Start     = equilibrium
subsection Network
  set Wires = wire
  subsection Wire wire
    set From            = 0, 0
    set To              = 10, 0
    set Components      = string
    set Tension         = 2000
    set Mass per length = 1
  end
  set Supports = ends
  subsection Support ends
    set Wire      = wire
    set Positions = 0, 10
  end
  set Links = rope
  subsection Link rope
    set Type   = dropper
    set Turns  = true
    set From   = ground @ 5, 1
    set To     = wire @ 5
    set Length = 0.9
  end
end
subsection Time
  set End  = 0.1
  set Step = 1e-3
end
)";
  verification::run_scene(string, {},
                          [](const taut::StepView &view)
                          { EXPECT_NEAR(view.state.multiplier[0], 4. * 2000. * .1 / 10., 1e-8); });
}
