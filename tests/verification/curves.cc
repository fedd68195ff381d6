// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: in a curve of the track wires run on chords between the masts and pull their arms.
// Source: the geometry of a polygon in a circle: a chord of an arc L is R (1 - cos(L / 2R)) inside
// of it, and a wire with tension T turns by L / R at each mast, by 2 T sin(L / 2R).
#include "scene_tests.h"

#include <algorithm>
#include <array>
#include <cmath>

using namespace verification;

namespace
{
  constexpr double span = 50., tension = 10000.;

  /// Strings without droppers and pantographs.
  const std::string line = R"(Generator = catenary
Start = equilibrium
Catenary: Number of spans = 6; Span length = 50; Pantographs =
Catenary/Contact wire: Model = string; Mass per length = 1; Tension = 10000; Element size = 1
Catenary/Messenger wire: Model = string; Mass per length = 0.8; Tension = 12000; Element size = 1
Catenary/Supports: Arm mass = 0
Catenary/Droppers: Positions =
Time: End = 0
)";

  /// Offsets of the contact wire at the middles of the spans along z.
  std::vector<double> offsets(const Overrides &overrides, const std::string &scene = line)
  {
    std::vector<double> result;
    run_scene(scene, overrides,
              [&](const taut::StepView &view)
              {
                for (std::size_t w = 0; w < view.scene.wires.size(); ++w)
                  if (has(view.scene.wires[w].name, "contact"))
                    for (double s = .5 * span;
                         s < norm(view.scene.wires[w].b - view.scene.wires[w].a); s += span)
                      result.push_back(displacement(view, w, s, {0., 0., 1.}));
              });
    return result;
  }

  const std::vector<double> none(6, 0.);
} // namespace

TEST(Curves, wires_run_on_chords)
{
  for (const double R : {300., 1000., -1000., 1e4})
  {
    // What small angles cost is a 24th of the square of the angle at a mast.
    const double chord = std::copysign(R - R * std::cos(.5 * span / R), R),
                 small = std::pow(span / R, 2) / 23. + 1e-7;
    for (const double offset : offsets({"Catenary/Curvature=1/(" + number(R) + ")"}))
      EXPECT_NEAR(offset, chord, small * std::fabs(chord)) << R;
    Session session(line, {"Catenary/Curvature=1/(" + number(R) + ")"});
    session.run();
    const auto supports = read_table(session.folder() + "/supports.csv");
    const double pull = -supports.at("steady arm at mast 3 force [N]").front(),
                 exact = std::copysign(2. * tension * std::sin(std::fabs(.5 * span / R)), R);
    EXPECT_NEAR(pull, exact, small * std::fabs(exact)) << R;
  }
  figure("offset of a chord of 50 m, R = 300 m",
         offsets({"Catenary/Curvature=1/300"})[2] / (300. - 300. * std::cos(25. / 300.)) - 1.);
  EXPECT_EQ(offsets({"Catenary/Lateral component=true"}), none);
}

// A curve that begins and ends: Mohr's analogy, each chord sees the curvature of its span alone.
TEST(Curves, a_table_is_the_track_of_its_formula)
{
  const Folder folder;
  const std::string table =
      folder.write("track.csv", "x [m];Curvature [1]\n0;0\n100;0\n150;0,001\n200;0,001\n300;0\n");
  const std::vector<double> found =
      offsets({"Catenary/Curvature=table(" + table + ", curvature, s)"});
  const auto curvature = [](const double x) {
    return x < 100. ? 0. : x < 150. ? (x - 100.) / 5e4 : x < 200. ? .001 : (300. - x) / 1e5;
  };
  ASSERT_EQ(found.size(), 6u);
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    // w = integral of G(x, y) k(y) dy with Green's function of a string, at the middle.
    double w = 0.;
    constexpr int n = 1000;
    for (int k = 0; k < n; ++k)
    {
      const double y = (k + .5) * span / n;
      w += .5 * std::min(y, span - y) * curvature(i * span + y) * span / n;
    }
    EXPECT_NEAR(found[i], w, 1e-5) << i;
  }

  // Of a tension length that begins elsewhere x is that of the line.
  std::string two = line;
  const std::string one = "Number of spans = 6; Span length = 50; ";
  two.replace(two.find(one), one.size(), "Tension lengths = a, b; ");
  const std::string bare = "Catenary/Droppers: Positions =\n";
  two.replace(two.find(bare), bare.size(),
              "Catenary/Tension length a/Droppers: Positions =\n"
              "Catenary/Tension length b/Droppers: Positions =\n");
  two += "Catenary/Tension length a: Number of spans = 2; Span length = 50\n"
         "Catenary/Tension length b: Number of spans = 4; Span length = 50; Begin = 100\n";
  for (const std::string &curve : {"table(" + table + ", curvature, s)",
                                   std::string("(s>=100)*(s<150)*(s-100)/5e4+(s>=150)*(s<200)*"
                                               "0.001+(s>=200)*(300-s)/1e5")})
  {
    const std::vector<double> parts = offsets({"Catenary/Curvature=" + curve}, two);
    ASSERT_EQ(parts.size(), 6u);
    for (std::size_t i = 0; i < parts.size(); ++i)
      EXPECT_NEAR(parts[i], found[i], 1e-6) << curve << ", " << i;
  }
}

// The pantograph meets the same wire: what droppers and arms do across the track is of second
// order.
TEST(Curves, a_pantograph_feels_the_line_of_a_straight_track)
{
  const Overrides run = {"Time/End=0.5", "Statistics/Window=", "Time/Check steps=no",
                         "Catenary/Lateral component=true"};
  const auto mean = [&](const Overrides &more)
  {
    const Said said = say(scene_file("en50318_2002_250"), run + more);
    double sum = 0.;
    const std::vector<double> &forces = said.sliding.at("pantograph force [N]");
    for (const double force : forces)
      sum += force;
    return sum / forces.size();
  };
  const double straight = mean({}), curved = mean({"Catenary/Curvature=1/1000"});
  EXPECT_NEAR(figure("mean force in a curve of 1000 m", curved / straight), 1., 1e-3);
}

// A load from below on the whole messenger wire lifts each span by q L^2 / 8 T. The contact wire
// hangs from its ends alone here: Green's function of a string.
TEST(Lines, vertical_loads_lift_their_wire)
{
  using Heights = std::map<std::string, std::vector<double>>;
  const auto heights = [](const Overrides &overrides)
  {
    Heights result;
    run_scene(line, overrides,
              [&](const taut::StepView &view)
              {
                for (std::size_t w = 0; w < view.scene.wires.size(); ++w)
                  for (double s = .5 * span; s < 6. * span; s += span)
                    result[view.scene.wires[w].name].push_back(displacement(view, w, s));
              });
    return result;
  };
  const Heights still = heights({}),
                lifted = heights({"Catenary/Contact wire/Vertical load=4*(s>100)*(s<150)",
                                  "Catenary/Messenger wire/Vertical load=3"});
  for (std::size_t i = 0; i < 6; ++i)
  {
    EXPECT_NEAR(lifted.at("messenger")[i] - still.at("messenger")[i],
                3. * span * span / 8. / 12000., 1e-9);
    const double x = (i + .5) * span, L = 6. * span;
    double moment = 0.;
    constexpr int n = 1000;
    for (int k = 0; k < n; ++k)
    {
      const double y = 100. + (k + .5) * 50. / n;
      moment += 4. * std::min(x, y) * (L - std::max(x, y)) / L * 50. / n;
    }
    EXPECT_NEAR(lifted.at("contact")[i] - still.at("contact")[i], moment / tension, 1e-6);
  }
}

TEST(Curves, scene_of_the_page)
{
  Session session(scene_file("line_in_a_curve"));
  double of_new = 0., of_worn = 0.; // droppers
  session.run(
      [&](const taut::StepView &view)
      {
        for (std::size_t i = 0; i < view.constraints.size(); ++i)
          if (view.constraints[i].name == "dropper bend 4.3")
            of_new = view.state.multiplier[i];
          else if (view.constraints[i].name == "dropper worn 4.3")
            of_worn = view.state.multiplier[i];
      });
  const auto probes = read_table(session.folder() + "/probes.csv"),
             supports = read_table(session.folder() + "/supports.csv");
  // A beam turns within sqrt(EI / T) of a mast.
  const double turns = .5 * span / 800. * std::sqrt(195. / 20000.);
  EXPECT_NEAR(probes.at("middle [m]").front(), -.2 + span * span / 8. / 800. - turns, 1e-3);
  EXPECT_NEAR(supports.at("steady arm at mast bend 6 force [N]").front(), -20000. * span / 800.,
              1.);
  // Droppers at equal distances carry equal shares of a level wire.
  constexpr double weight = 1.07 * 9.81 * 10.;
  EXPECT_NEAR(of_new, weight, .1);
  EXPECT_NEAR(of_worn, .9 * weight, .1);
  const double sag = probes.at("rail at arm [m]").front() - probes.at("rail between [m]").front();
  EXPECT_NEAR(sag, 5.9 * 9.81 * 1e4 / 384. / 2e5, 2e-5);
}

namespace
{
  /// A pantograph of one mass, pushed up by 100 N.
  const Overrides pantograph = {"Catenary/Pantographs=p", "Catenary/Pantograph p/Masses=10",
                                "Catenary/Pantograph p/Stiffnesses=0",
                                "Catenary/Pantograph p/Dampings=0",
                                "Catenary/Pantograph p/Static force=100"};
} // namespace

// Claim: a strip that the cant turns pushes the wire aside. Source: a string between its supports
// under a point load, N cos(phi) along y, where it is held at its ends, N sin(phi) along z, where
// arms hold it at the masts.
TEST(Curves, a_turned_strip_pushes_wires_aside)
{
  constexpr double x = 125., N = 100.;
  const auto place = [&](const Overrides &overrides)
  {
    std::array<double, 2> result = {};
    run_scene(line, overrides,
              [&](const taut::StepView &view)
              {
                for (std::size_t w = 0; w < view.scene.wires.size(); ++w)
                  if (has(view.scene.wires[w].name, "contact"))
                    result = {displacement(view, w, x), displacement(view, w, x, {0., 0., 1.})};
              });
    return result;
  };
  for (const double cant : {.1, -.05})
  {
    const Overrides canted = {"Catenary/Cant=" + number(cant)};
    const auto still = place(canted),
               lifted = place(canted + pantograph +
                              Overrides{"Catenary/Pantograph p/Start=" + number(x)});
    EXPECT_NEAR(lifted[0] - still[0],
                N * std::cos(cant) * x * (6. * span - x) / 6. / span / tension, 1e-9);
    EXPECT_NEAR(lifted[1] - still[1], N * std::sin(cant) * span / 4. / tension, 1e-9);
  }
}

// Claim: a pantograph under a wire that is aside of the axis rises and falls with the cant.
// Source: its height is z sin(phi) under a wire that does not give way, N = F - m w''.
TEST(Curves, a_turned_strip_follows_the_cant)
{
  constexpr double z = .3, speed = 20., wave = 50., begin = 62.5, mass = 10., h = 1e-3;
  const auto height = [&](const double t)
  { return z * std::sin(.1 * std::sin(2. * M_PI / wave * (begin + speed * t))); };
  Overrides run = pantograph + Overrides{"Gravity=0, 0",
                                         "Time/End=3",
                                         "Time/Step=1e-3",
                                         "Statistics/Window=",
                                         "Time/Check steps=no",
                                         "Catenary/Cant=0.1*sin(2*pi/50*s)",
                                         "Catenary/Contact wire/Tension=1e10",
                                         "Catenary/Pantograph p/Speed=72",
                                         "Catenary/Pantograph p/Start=62.5"};
  // The second tension length takes all force from the first one, which is far above, and its wire
  // begins at another place.
  for (const std::string aside :
       {"Catenary/Contact wire/Stagger=0.3, 0.3, 0.3, 0.3, 0.3, 0.3, 0.3",
        "Catenary/Tension length a/Offset=0.3", "Catenary/Tension length b/Offset=0.3"})
    for (const std::string stiffness : {"rigid", "1e7"})
    {
      std::string scene = line;
      if (has(aside, "Offset"))
      {
        const std::string spans = "Number of spans = 6; Span length = 50; ";
        const bool has_two = has(aside, "length b");
        scene.replace(scene.find(spans), spans.size(),
                      has_two ? "Tension lengths = a, b; " : "Tension lengths = a; ");
        const std::string bare = "Catenary/Droppers: Positions =\n",
                          of_a = "Catenary/Tension length a/Droppers: Positions =\n",
                          of_b = "Catenary/Tension length b/Droppers: Positions =\n";
        scene.replace(scene.find(bare), bare.size(), has_two ? of_a + of_b : of_a);
        scene += "Catenary/Tension length a: Number of spans = 6; Span length = 50" +
                 std::string(has_two ? "; Heights = 1\n" : "\n");
        if (has_two)
          scene += "Catenary/Tension length b: Number of spans = 6; Span length = 50; Begin = 20\n";
      }
      const Said said = say(
          scene, run + Overrides{aside, "Catenary/Pantograph p/Contact stiffness=" + stiffness});
      const auto &times = said.sliding.at("time [s]"), &forces = said.sliding.at("p force [N]");
      double worst = 0.;
      for (std::size_t i = 0; i < times.size(); ++i)
        if (const double t = times[i]; t > .5)
          worst = std::max(
              worst, std::fabs(forces[i] - 100. +
                               mass * (height(t + h) - 2. * height(t) + height(t - h)) / h / h));
      EXPECT_LT(figure(aside + ", " + stiffness + " [N]", worst), .02) << aside << stiffness;
    }
}

TEST(Curves, that_move_are_refused)
{
  EXPECT_TRUE(has(error_of([] { Session(line, {"Catenary/Cant=0.1*t"}).simulation().check(); }),
                  "a track does not move"));
  EXPECT_TRUE(has(error_of([] { Session(line, {"Catenary/Cant=150"}).simulation().check(); }),
                  "write the angle in rad"));
  EXPECT_TRUE(
      has(error_of([] { Session(line, {"Catenary/Curvature=0.001*t"}).simulation().check(); }),
          "a track does not move"));
  EXPECT_TRUE(has(error_of([] { Session(line, {"Catenary/Curvature=1/R"}); }), "Curvature"));
}
