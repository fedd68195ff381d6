// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: wires and masses in space move along all three axes by the same equations. Sources: a
// scene of the plane, turned about x; the parabola of a taut string; forces at the kinks of a
// polygon; statics of a mass on two ropes; the uncut wire.
#include "run.h"

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <regex>
#include <string>
#include <vector>

using namespace verification;

namespace
{
  /// All that a run shows: multipliers, gaps, probes and forces of supports of each step.
  struct History
  {
    std::vector<double> values;
    std::size_t n_steps = 0, n_open = 0;

    void operator()(const taut::StepView &step, const std::size_t n_supports)
    {
      ++n_steps;
      for (std::size_t i = 0; i < step.constraints.size(); ++i)
        if (step.constraints[i].is_link())
        {
          values.push_back(step.state.multiplier[i]);
          n_open += step.state.multiplier[i] == 0. ? 1 : 0;
        }
      values.insert(values.end(), step.probes.begin(), step.probes.end());
      values.insert(values.end(), step.supports.begin(), step.supports.begin() + n_supports);
    }
  };

  History history(const std::string &scene, const std::size_t n_supports,
                  const Overrides &overrides = {})
  {
    History result;
    run_scene(scene, overrides, [&](const taut::StepView &step) { result(step, n_supports); });
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
        error = std::max(error, std::fabs(a.values[i] - b.values[i]));
        size = std::max(size, std::fabs(a.values[i]));
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
    std::string text = R"(set Generator = network
set Gravity   = (0, -9.81)
subsection Network
  set Wires        = lower, upper
  set Supports     = lower ends, clamp, arm, upper ends, upper foot{names}
  set Point masses = clip
  set Masses       = head, block
  set Springs      = spring, base
  set Links        = hanger, slanting, slider, bump
  set Loads        = push, gust, wheel, shove
  subsection Wire lower
    set From              = (0, 0)
    set To                = (24, 0)
    set Components        = beam{lateral}
    set Mass per length   = 1.2
    set Tension           = 9000
    set Bending stiffness = 150
    set Element size      = 0.5
    set Stiffness damping = 1e-3
  end
  subsection Wire upper
    set From            = (0, 1.4)
    set To              = (24, 3)
    set Components      = bar, string{lateral}
    set Mass per length = 0.8
    set Tension         = 8000
    set Axial stiffness = 1e6
    set Element size    = 1
    set Mass damping    = 0.1
  end
  subsection Support lower ends
    set Wire      = lower
    set Positions = 0, 24
    set Motion    = {across}
  end
  subsection Support clamp
    set Wire   = lower
    set Motion = {slope}
  end
  subsection Support arm
    set Wire      = lower
    set Positions = 14
    set Motion    = {across}
    set Type      = elastic
    set Stiffness = 300
    set Damping   = 12
  end
  subsection Support upper ends
    set Wire         = upper
    set Positions    = 0, 24
    set Motion       = {across}
    set Displacement = 0.01*sin(3*t)
  end
  subsection Support upper foot
    set Wire   = upper
    set Motion = axial
  end
{sections}
  subsection Point mass clip
    set Wire      = upper
    set Positions = 9.3
    set Mass      = 0.6
  end
  subsection Mass head
    set Position = (4, -1)
    set Motions  = x, {y}
    set Mass     = 8
    set Weight   = false
  end
  subsection Mass block
    set Position = (4, -2)
    set Motions  = {y}
    set Mass     = 15
  end
  subsection Spring spring
    set From      = block
    set To        = head
    set Direction = (0.3, 1)
    set Stiffness = 5000
    set Damping   = 60
  end
  subsection Spring base
    set From      = ground
    set To        = head
    set Direction = (1, -0.2)
    set Stiffness = 700
    set Damping   = 20
  end
  subsection Link hanger
    set Type      = dropper
    set From      = upper @ 6
    set To        = lower @ 6
    set Stiffness = 1e5
    set Gap       = -0.03
  end
  subsection Link slanting
    set Type      = dropper
    set From      = upper @ 19
    set To        = lower @ 17
    set Stiffness = 1e5
    set Gap       = 0.002
  end
  subsection Link slider
    set Type      = sliding contact
    set From      = head
    set To        = lower @ 4
    set Direction = (0, 1)
    set Stiffness = 50000
    set Speed     = 12
  end
  subsection Link bump
    set Type      = stop
    set From      = ground
    set To        = block
    set Direction = (0, 1)
    set Stiffness = 1e5
  end
  subsection Load push
    set On        = block
    set Direction = (0, 1)
    set Magnitude = 190
  end
  subsection Load gust
    set Type      = distributed
    set On        = upper @ 0
    set Direction = (0.2, -1)
    set Magnitude = 2*sin(2*t)*s
  end
  subsection Load wheel
    set Type      = moving
    set On        = upper @ 1
    set Direction = (0, -1)
    set Magnitude = 120
    set Speed     = 15
  end
  subsection Load shove
    set On        = upper @ 20
    set Direction = (1, 1)
    set Magnitude = 60*sin(9*t)
  end
end
subsection Time
  set Scheme = BDF2
  set Step   = 2e-3
  set End    = 1
end
subsection Output
  set Probes = under, over, along, head across, head along
  subsection Probe under
    set Point     = lower @ 11
    set Direction = (0, 1)
  end
  subsection Probe over
    set Point     = upper @ 13.7
    set Direction = (0, 1)
  end
  subsection Probe along
    set Point     = upper @ 13.7
    set Direction = (1, 0)
  end
  subsection Probe head across
    set Point     = head
    set Direction = (0, 1)
  end
  subsection Probe head along
    set Point     = head
    set Direction = (1, 0)
  end
end
)";
    const auto replace = [&](const std::string &from, const std::string &to)
    { text = std::regex_replace(text, std::regex(from), to); };
    replace("\\((\\S+), (\\S+)\\)", turned ? "$1, 0, $2" : "$1, $2");
    replace("\\{lateral\\}", turned ? ", lateral" : "");
    replace("\\{across\\}", turned ? "lateral" : "transverse");
    replace("\\{slope\\}", turned ? "lateral slope" : "slope");
    replace("\\{y\\}", turned ? "z" : "y");
    replace("\\{names\\}", turned ? ", lower level, upper level" : "");
    replace("\\{sections\\}", !turned ? "" : R"(  subsection Support lower level
    set Wire      = lower
    set Positions = 0, 24
  end
  subsection Support upper level
    set Wire      = upper
    set Positions = 0, 24
  end)");
    return text;
  }

  /// A contact wire with stagger, its lateral supports at every mast; wind across it.
  const char *const staggered = R"(set Generator = network
set Gravity   = 0, 0
subsection Network
  set Wires    = contact, by links
  set Supports = height, height by links, left, right
  set Links    = arms left, arms right
  subsection Wire contact
    set From            = 0, 0
    set To              = 250, 0
    set Components      = string, lateral
    set Mass per length = 1.35
    set Tension         = 20000
    set Element size    = 5
  end
  subsection Wire by links
    set From            = 0, 0, 5
    set To              = 250, 0, 5
    set Components      = string, lateral
    set Mass per length = 1.35
    set Tension         = 20000
    set Element size    = 5
  end
  subsection Support height
    set Wire      = contact
    set Positions = 0:50:250
  end
  subsection Support height by links
    set Wire      = by links
    set Positions = 0:50:250
  end
  subsection Support left
    set Wire         = contact
    set Positions    = 0, 100, 200
    set Motion       = lateral
    set Displacement = 0.2
  end
  subsection Support right
    set Wire         = contact
    set Positions    = 50, 150, 250
    set Motion       = lateral
    set Displacement = -0.2
  end
  subsection Link arms left
    set To        = by links @ 0, 100, 200
    set Direction = 0, 0, 1
    set Gap       = -0.2
  end
  subsection Link arms right
    set To        = by links @ 50, 150, 250
    set Direction = 0, 0, 1
    set Gap       = 0.2
  end
end
subsection Time
  set End = 0
end
)";

  double sum(const std::vector<double> &values, const std::size_t begin, const std::size_t end)
  {
    return std::accumulate(values.begin() + begin, values.begin() + end, 0.);
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
  run_scene(R"(set Generator = network
subsection Network
  set Wires    = wire
  set Supports = height, side
  set Loads    = wind
  subsection Wire wire
    set To              = 60, 0
    set Components      = string, lateral
    set Mass per length = 1
    set Tension         = 10000
    set Element size    = 2.5
  end
  subsection Support height
    set Wire      = wire
    set Positions = 0, 60
  end
  subsection Support side
    set Wire      = wire
    set Positions = 0, 60
    set Motion    = lateral
  end
  subsection Load wind
    set Type      = distributed
    set On        = wire @ 0
    set Direction = 0, 3, 4
    set Magnitude = 8
  end
end
subsection Time
  set End = 0
end
)",
            {},
            [&](const taut::StepView &step)
            {
              const double across = displacement(step, 0, 30., {0., 0., 1.}),
                           up = displacement(step, 0, 30., {0., 1.});
              EXPECT_NEAR(across, .8 * w * L * L / (8. * T), 1e-6 * across);
              EXPECT_NEAR(up, (sin * w - 9.81) * L * L / (8. * T), 1e-6 * across);
              EXPECT_NEAR(step.supports.at(2), -.8 * w * L / 2., 1e-9 * w * L);
              figure("blow-off of a string, error relative",
                     std::fabs(across / (.8 * w * L * L / (8. * T)) - 1.));
            });
}

TEST(WiresInSpace, a_wire_along_z_has_its_transverse_motion_along_y)
{
  run_scene(R"(set Generator = network
subsection Network
  set Wires    = headspan
  set Supports = height, side
  subsection Wire headspan
    set From            = 3, 6, -10
    set To              = 3, 6, 10
    set Components      = string, lateral
    set Mass per length = 2
    set Tension         = 5000
  end
  subsection Support height
    set Wire      = headspan
    set Positions = 0, 20
  end
  subsection Support side
    set Wire         = headspan
    set Positions    = 0, 20
    set Motion       = lateral
    set Displacement = 0.1
  end
end
subsection Time
  set End = 0
end
)",
            {},
            [](const taut::StepView &step)
            {
              EXPECT_NEAR(displacement(step, 0, 10., {0., 1.}), -2. * 9.81 * 400. / 40000., 1e-9);
              // z x y = -x
              EXPECT_NEAR(displacement(step, 0, 10., {1., 0.}), -.1, 1e-12);
              EXPECT_EQ(displacement(step, 0, 10., {0., 0., 1.}), 0.);
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
          EXPECT_NEAR(step.supports[12 + i], expected[i], 1e-8 * at_end) << i;
          EXPECT_NEAR(step.state.multiplier[i], expected[i], 1e-8 * at_end) << i;
          worst = std::max({worst, std::fabs(step.supports[12 + i] - expected[i]),
                            std::fabs(step.state.multiplier[i] - expected[i])});
          EXPECT_NEAR(step.supports[i], 0., 1e-8 * at_end) << i;
        }
        for (const double x : {0., 12.5, 50., 80., 250.})
          EXPECT_NEAR(displacement(step, 0, x, {0., 0., 1.}),
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
  const auto wire = [](const std::string &name, const std::string &height)
  {
    return "  subsection Wire " + name + "\n    set From = -10, " + height + "\n    set To = 10, " +
           height + R"(
    set Components        = bar, beam, lateral
    set Mass per length   = 1
    set Tension           = 4000
    set Bending stiffness = 300
    set Axial stiffness   = 1e6
    set Weight            = false
  end
)";
  };
  std::string text = "set Generator = network\nsubsection Network\n  set Wires = right, left\n" +
                     wire("right", "3, 1.6") + wire("left", "4, -0.8");
  text +=
      "  set Supports = right height, right side, right foot, left height, left side, left foot\n";
  for (const std::string name : {"right", "left"})
  {
    text += "  subsection Support " + name + " height\n    set Wire = " + name +
            "\n    set Positions = 0, 20\n  end\n";
    text += "  subsection Support " + name + " side\n    set Wire = " + name +
            "\n    set Positions = 0, 20\n    set Motion = lateral\n  end\n";
    text += "  subsection Support " + name + " foot\n    set Wire = " + name +
            "\n    set Motion = axial\n  end\n";
  }
  text += R"(  set Masses  = weight
  set Springs = stay
  set Links   = right rope, left rope
  subsection Mass weight
    set Position = 0, 0, 0
    set Motions  = x, y, z
    set Mass     = 20
  end
  subsection Spring stay
    set To        = weight
    set Direction = -4, 0, 3
    set Stiffness = 1000
  end
  subsection Link right rope
    set Type      = dropper
    set From      = right @ 11.2
    set To        = weight
    set Stiffness = 1e5
  end
  subsection Link left rope
    set Type = dropper
    set From = left @ 9.4
    set To   = weight
  end
end
subsection Time
  set End = 0
end
)";
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
      "set Generator = network\nsubsection Network\n  set Wires = messenger, contact\n"
      "  set Supports = messenger height, messenger side, contact height, contact side\n";
  for (const std::string name : {"messenger", "contact"})
  {
    const std::string end = name == "messenger" ? ", 1.2, 0.5" : ", 0, 0";
    text += "  subsection Wire " + name + "\n    set From = 0" + end + "\n    set To = 50" + end +
            "\n    set Components = string, lateral\n    set Mass per length = 1.1\n"
            "    set Tension = 15000\n  end\n";
    for (const std::string motion : {"height", "side"})
      text += "  subsection Support " + name + " " + motion + "\n    set Wire = " + name +
              "\n    set Positions = 0, 50\n    set Motion = " +
              (motion == "side" ? "lateral" : "transverse") + "\n  end\n";
  }
  text += R"(  set Links = dropper
  subsection Link dropper
    set Type                   = dropper
    set From                   = messenger @ 20, 30
    set To                     = contact @ 20, 30
    set Find length            = true
    set Prescribed displacement = -0.01
    set Axial stiffness        = 1e5
    set Mass per length        = 0.1
  end
end
subsection Time
  set End = 0
end
)";
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
  std::string text = "set Generator = network\nset Gravity = 0, 0\nsubsection Network\n"
                     "  set Wires = first, second\n  set Supports = ";
  std::string sections;
  for (const std::string name : {"first", "second"})
  {
    const bool first = name == "first";
    sections += "  subsection Wire " + name +
                "\n    set From = " + (first ? "0, 0, 0.2" : "50, 0, -0.2") +
                "\n    set To = " + (first ? "50, 0, -0.2" : "100, 0, 0.2") + R"(
    set Components      = bar, string, lateral
    set Mass per length = 1
    set Tension         = 20000
    set Axial stiffness = 1e7
  end
)";
    for (const std::string motion : {"axial", "transverse", "lateral"})
    {
      text += (sections.find("Support") == std::string::npos ? "" : ", ") + name + " " + motion;
      sections += "  subsection Support " + name + " " + motion + "\n    set Wire = " + name +
                  "\n    set Positions = " + (first ? "0" : "50.001599974400820") +
                  "\n    set Motion = " + motion + "\n  end\n";
    }
  }
  text += "\n" + sections + "  set Links = along, up, across\n";
  for (const std::string name : {"along", "up", "across"})
    text += "  subsection Link " + name +
            "\n    set From = first @ 50.001599974400820\n    set To = second @ 0\n"
            "    set Direction = " +
            (name == "along" ? "1, 0, 0"
             : name == "up"  ? "0, 1, 0"
                             : "0, 0, 1") +
            "\n  end\n";
  text += R"(  set Loads = wind
  subsection Load wind
    set On        = first @ 50.001599974400820
    set Direction = 0, -3, 4
    set Magnitude = 200
  end
end
subsection Time
  set End = 0
end
)";
  run_scene(text, {},
            [&](const taut::StepView &step)
            {
              const double stiffness = 4. * 20000. / 100.;
              const double force[3] = {0., -120., 160. + 320.};
              for (unsigned int i = 0; i < 3; ++i)
              {
                const taut::Coordinates n = {i == 0 ? 1. : 0., i == 1 ? 1. : 0., i == 2 ? 1. : 0.};
                const double first = displacement(step, 0, 50.001599974400820, n),
                             second = displacement(step, 1, 0., n);
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

namespace
{
  /// A wire without mass and weight, held where it begins.
  std::string stay(const std::string &name, const std::string &from, const std::string &to,
                   const double tension)
  {
    std::string text =
        "  subsection Wire " + name + "\n    set From = " + from + "\n    set To = " + to +
        "\n    set Components = bar, string, lateral\n    set Tension = " +
        std::to_string(tension) +
        "\n    set Mass per length = 1\n    set Axial stiffness = 1e6\n    set Weight = "
        "false\n    set Element size = 5\n  end\n";
    for (const std::string motion : {"axial", "transverse", "lateral"})
      text += "  subsection Support " + name + " " + motion + "\n    set Wire = " + name +
              "\n    set Positions = 0\n    set Motion = " + motion + "\n  end\n";
    return text;
  }

  std::string supports_of(const std::string &names)
  {
    return std::regex_replace(names, std::regex("(\\w+)"), "$1 axial, $1 transverse, $1 lateral");
  }

  std::string joint(const std::string &name, const std::string &from, const std::string &to,
                    const std::string &direction)
  {
    return "  subsection Link " + name + "\n    set From = " + from + "\n    set To = " + to +
           (direction.empty() ? "\n    set Type = ball joint"
                              : "\n    set Direction = " + direction) +
           "\n  end\n";
  }

  /// Displacement in a static state of the end of wire 0 along x, y and z.
  std::array<double, 3> rest(const std::string &names, const std::string &sections,
                             const std::string &joints, std::vector<taut::Load> *loads = nullptr)
  {
    std::array<double, 3> u;
    run_scene(
        "set Generator = network\nset Gravity = 0, 0\nsubsection Network\n  set Wires = " + names +
            "\n  set Supports = " + supports_of(names) + "\n" + sections +
            "  set Links = " + joints + "end\nsubsection Time\n  set End = 0\nend\n",
        {},
        [&](const taut::StepView &step)
        {
          const double end = step.scene.wires[0].length();
          u = {displacement(step, 0, end, {1., 0., 0.}), displacement(step, 0, end, {0., 1., 0.}),
               displacement(step, 0, end, {0., 0., 1.})};
          if (loads != nullptr)
            *loads = step.scene.loads;
        });
    return u;
  }
} // namespace

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
      rest("a, b, c", sections,
           "ab, ac\n" + joint("ab", "a @ 20", "b @ 20", "") + joint("ac", "a @ 20", "c @ 20", "")));
  // The same with directions that are not orthogonal.
  std::string names, joints;
  for (const std::string other : {"b", "c"})
    for (const auto &[number, direction] :
         {std::pair("1", "1, 0, 0"), {"2", "1, 1, 0"}, {"3", "0, 1, -2"}})
    {
      names += (names.empty() ? "" : ", ") + other + number;
      joints += joint(other + number, "a @ 20", other + " @ 20", direction);
    }
  expect(rest("a, b, c", sections, names + "\n" + joints));
}

TEST(WiresInSpace, pulls_do_not_depend_on_the_order_of_joints)
{
  // One joint each, along directions that are neither alike nor across each other.
  const std::string sections = stay("a", "-20, 0, 0", "0, 0, 0", 2000.) +
                               stay("b", "12, 0, 16", "0, 0, 0", 3000.) +
                               stay("c", "0, 12, -16", "0, 0, 0", 2500.),
                    first = joint("ab", "a @ 20", "b @ 20", "1, 0, 0"),
                    second = joint("ac", "a @ 20", "c @ 20", "1, 1, 0");
  const std::array<double, 3> one = rest("a, b, c", sections, "ab, ac\n" + first + second),
                              other = rest("a, b, c", sections, "ac, ab\n" + first + second);
  EXPECT_GT(std::fabs(one[1]), .1);
  for (unsigned int i = 0; i < 3; ++i)
    EXPECT_NEAR(one[i], other[i], 1e-12);
}

TEST(WiresInSpace, a_wire_that_goes_on_straight_pulls_nothing)
{
  const auto sections = [](const double second) {
    return stay("a", "0, 0, 0", "16, 12, 0", 2000.) + stay("b", "32, 24, 0", "16, 12, 0", second);
  };
  const std::string joints = "j\n" + joint("j", "a @ 20", "b @ 20", "");
  std::vector<taut::Load> loads;
  const std::array<double, 3> straight = rest("a, b", sections(2000.), joints, &loads);
  EXPECT_TRUE(loads.empty());
  EXPECT_EQ(straight[0], 0.);
  // Another tension in the second one draws the joint towards it, held by both bars.
  const std::array<double, 3> drawn = rest("a, b", sections(3000.), joints, &loads);
  ASSERT_FALSE(loads.empty());
  EXPECT_NEAR(std::hypot(drawn[0], drawn[1]), 1000. * 20. / 2e6, 1e-9);
  EXPECT_NEAR(drawn[1] / drawn[0], .75, 1e-9);
  // A joint across alone passes on none of it.
  rest("a, b", sections(3000.), "j\n" + joint("j", "a @ 20", "b @ 20", "-3, 4, 0"), &loads);
  EXPECT_TRUE(loads.empty());
}

TEST(WiresInSpace, a_wire_in_four_parts_moves_as_the_whole)
{
  std::string text = staggered;
  const auto replace = [&](const std::string &from, const std::string &to)
  { text = std::regex_replace(text, std::regex(from), to); };
  replace("= string, lateral", "= beam, lateral\n    set Bending stiffness = 150");
  replace("set End = 0", "set Scheme = BDF2\n  set Step = 2e-3\n  set End = 0.4");
  replace("set Gravity   = 0, 0", "set Gravity   = 0, -9.81, 2");
  replace("set Links ", "set Loads = gust\n  set Links ");
  text.replace(text.find("  subsection Link"), 0, R"(  subsection Load gust
    set Type      = distributed
    set On        = contact @ 0
    set Direction = 0, 1, 2
    set Magnitude = 5*sin(6*t)*sin(s/30)
  end
)");
  text += R"(subsection Output
  set Probes = side, height
  subsection Probe side
    set Point     = contact @ 133
    set Direction = 0, 0, 1
  end
  subsection Probe height
    set Point = contact @ 133
  end
end
)";
  const History whole = history(text, 18),
                parts = history(text, 18, {"Partition.Number of substructures=4"});
  std::size_t n_cuts = 0;
  run_scene(text, {"Partition.Number of substructures=4", "Time.End=0"},
            [&](const taut::StepView &step) { n_cuts = step.structure.cut_constraints().size(); });
  // Value and slope of the transverse and the lateral motion at each cut.
  EXPECT_GT(n_cuts, 0u);
  EXPECT_EQ(n_cuts % 4, 0u);
  const double worst = difference(whole, parts);
  EXPECT_LT(worst, 1e-10);
  figure("staggered wire in four parts against the whole, relative", worst);
}

TEST(WiresInSpace, steady_arms_that_only_pull_go_slack_in_the_wind)
{
  const double T = 20000., L = 50., a = .2;
  bool is_start = true;
  double slack = 0., force = 0., moved = 0.;
  run_scene(
      scene_file("wire_in_space"), {},
      [&](const taut::StepView &step)
      {
        const std::vector<double> &N = step.state.multiplier;
        ASSERT_EQ(N.size(), 3u);
        if (is_start)
        {
          EXPECT_NEAR(N[0], 4. * a * T / L - 4. * L, 1e-6);
          EXPECT_NEAR(N[1], N[0], 1e-6);
          EXPECT_NEAR(N[2], 4. * a * T / L + 4. * L, 1e-6);
          EXPECT_NEAR(displacement(step, 0, 25., {0., 0., 1.}), 4. * L * L / (8. * T), 1e-9);
          EXPECT_NEAR(displacement(step, 0, 25., {0., 1.}), -1.35 * 9.81 * L * L / (8. * T), 1e-9);
        }
        is_start = false;
        slack = N[0] == 0. ? step.state.geometric_gap[0] : 0.;
        force = N[2];
        moved = step.probes.at(0);
      });
  EXPECT_NEAR(slack, 8. * L * L / (2. * T) - 2. * a, 1e-3);
  EXPECT_NEAR(force, 2. * 8. * L, 8.);
  EXPECT_NEAR(moved, .1125, 1e-3);
  figure("slack of a steady arm in the wind", slack, "m");
  figure("force of the other arm", force, "N");
}

TEST(WiresInSpace, given_starts_move_along_z)
{
  // A string between two supports in its first mode, w = a cos(c pi t/L) sin(pi s/L), and a mass
  // that flies, each along z.
  const double a = .01, L = 10., c = 20., g = 3., v = .5, z = .2;
  double worst = 0.;
  run_scene(R"(set Generator = network
set Gravity   = 0, 0, -3
set Start     = given
subsection Network
  set Wires    = string
  set Supports = level, ends
  set Masses   = ball
  subsection Wire string
    set To                           = 10, 0
    set Components                   = string, lateral
    set Mass per length              = 1
    set Tension                      = 400
    set Element size                 = 0.5
    set Weight                       = false
    set Initial lateral displacement = 0.01*sin(pi*s/10)
  end
  subsection Support level
    set Wire      = string
    set Positions = 0, 10
  end
  subsection Support ends
    set Wire      = string
    set Positions = 0, 10
    set Motion    = lateral
  end
  subsection Mass ball
    set Motions              = z
    set Mass                 = 2
    set Initial displacement = 0, 0, 0, 0.2
    set Initial velocity     = 0, 0, 0, 0.5
  end
end
subsection Time
  set Scheme = BDF2
  set Step   = 2e-4
  set End    = 1
end
subsection Output
  set Probes = middle, ball
  subsection Probe middle
    set Point     = string @ 5
    set Direction = 0, 0, 1
  end
  subsection Probe ball
    set Point     = ball
    set Direction = 0, 0, 1
  end
end
)",
            {},
            [&](const taut::StepView &step)
            {
              const double t = step.state.time;
              worst = std::max(
                  worst, std::fabs(step.probes.at(0) - a * std::cos(c * std::acos(-1.) * t / L)));
              EXPECT_NEAR(step.probes.at(1), z + v * t - .5 * g * t * t, 1e-3);
            });
  EXPECT_LT(worst, 1e-3 * a);
}
