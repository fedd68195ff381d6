// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: mass, axial and bending stiffness of a worn wire are shares of those as new, functions of
// s. Sources: closed forms of bars and beams whose properties change along them; a wire whose half
// is another wire.
#include "scene_tests.h"

using namespace verification;

namespace
{
  /// Displacement of the first wire at s, at rest.
  double at_rest(const std::string &scene, const double s, const taut::WireMotion motion,
                 const Overrides &overrides = {})
  {
    double result = 0.;
    run_scene(scene, overrides,
              [&](const taut::StepView &view)
              {
                std::vector<taut::Term> terms;
                view.structure.motion(0, s, motion, terms);
                result =
                    evaluate(terms, view.reference.displacement) + evaluate(terms, view.state.U);
              });
    return result;
  }
} // namespace

// A bar with EA (1 + s / L) / 2 under a pull F at its end: u = 2 F L ln 2 / EA.
TEST(WornWires, bar_whose_axial_stiffness_grows_stretches_by_a_logarithm)
{
  const double u =
      at_rest("Generator = network; Gravity = 0, 0; Start = equilibrium\n"
              "Network: Wires = w; Supports = s; Loads = f\n"
              "Wire w: To = 10, 0; Components = bar; Mass per length = 2; Axial stiffness = 1e6; "
              "Element size = 0.25; Remaining axial stiffness = (1+s/10)/2\n"
              "Support s: Wire = w; Motion = axial\n"
              "Load f: Type = point; On = w @ 10; Direction = 1, 0; Magnitude = 1e3\n"
              "Time: End = 0\n",
              10., taut::WireMotion::axial);
  const double expected = 2. * 1e3 * 10. * std::log(2.) / 1e6;
  EXPECT_LE(figure("bar whose stiffness grows, error of its end", std::fabs(u / expected - 1.)),
            1e-7);
}

// The weight of a wire that has s / L left of its mass: half, about two thirds of its length. A
// string between supports carries a third of the whole at the light end, two thirds at the other.
TEST(WornWires, weight_is_that_of_the_mass_that_is_left)
{
  const double sag =
      at_rest("Generator = network; Gravity = 0, -10; Start = equilibrium\n"
              "Network: Wires = w; Supports = s\n"
              "Wire w: To = 12, 0; Components = string; Mass per length = 3; Tension = 5e3; "
              "Element size = 0.5; Remaining mass = s/12\n"
              "Support s: Wire = w; Positions = 0, 12; Motion = transverse\n"
              "Time: End = 0\n",
              6., taut::WireMotion::transverse);
  // T w'' = m g s / L, w(0) = w(L) = 0: w = m g (s^3 - s L^2) / (6 T L).
  const double expected = 3. * 10. * (216. - 6. * 144.) / (6. * 5e3 * 12.);
  EXPECT_LE(figure("string whose mass grows, error of its sag", std::fabs(sag / expected - 1.)),
            1e-9);
}

// A beam on two supports that has a quarter of its bending stiffness left in its second half, under
// a force in the middle: w = F L^3 (1 / EI_1 + 1 / EI_2) / 96.
TEST(WornWires, beam_of_two_halves_bends_as_both)
{
  const std::string scene =
      "Generator = network; Gravity = 0, 0; Start = equilibrium\n"
      "Network: Wires = w; Supports = s; Loads = f\n"
      "Wire w: To = 8, 0; Components = beam; Mass per length = 1; Bending stiffness = 400; "
      "Element size = 0.5\n"
      "Support s: Wire = w; Positions = 0, 8; Motion = transverse\n"
      "Load f: Type = point; On = w @ 4; Direction = 0, 1; Magnitude = 3\n"
      "Time: End = 0\n";
  const auto deflection = [&](const Overrides &overrides)
  { return at_rest(scene, 4., taut::WireMotion::transverse, overrides); };
  const double u = deflection({"Network/Wire w/Remaining bending stiffness=1-0.75*(s>4)"});
  const double expected = 3. * 512. * (1. / 400. + 1. / 100.) / 96.;
  EXPECT_LE(figure("beam of two halves, error of its deflection", std::fabs(u / expected - 1.)),
            1e-9);
  EXPECT_EQ(deflection({"Network/Wire w/Remaining bending stiffness=1"}), deflection({}));
}

// Wear of a catenary is a function of x, also where a tension length begins elsewhere: with half
// of its mass left between two masts, droppers there carry less by half of its weight.
TEST(WornWires, droppers_carry_less_where_the_contact_wire_is_worn)
{
  const auto carried = [](const std::string &share)
  {
    Session session(scene_file("en50318_2002_250"),
                    {"Catenary/Contact wire/Remaining mass=" + share, "Time/End=0"});
    session.run();
    const auto table = read_table(session.folder() + "/start.csv");
    double sum = 0.;
    for (std::size_t i = 0; i < table.at("x [m]").size(); ++i)
      if (table.at("x [m]")[i] > 240. && table.at("x [m]")[i] < 300.)
        sum += table.at("force [N or N m]")[i];
    return sum;
  };
  const double less = carried("1") - carried("1-0.5*(s>240)*(s<300)");
  // 1.35 kg/m over 60 m, but for what the halves of the spans beside the masts give.
  EXPECT_NEAR(less, .5 * 1.35 * 9.81 * 60., .05 * .5 * 1.35 * 9.81 * 60.);
}

TEST(WornWires, shares_that_are_not_positive_are_refused)
{
  const std::string scene = "Generator = network; Gravity = 0, 0\nNetwork: Wires = w\n"
                            "Wire w: To = 8, 0; Components = string; Mass per length = 1; "
                            "Tension = 100\nTime: End = 0\n";
  const auto error = [&](const std::string &entry)
  { return error_of([&] { run_scene(scene, {"Network/Wire w/" + entry}, [](const auto &) {}); }); };
  EXPECT_TRUE(has(error("Remaining mass=0"), "Wire w/Remaining mass: '0' is not positive"));
  EXPECT_TRUE(has(error("Remaining mass=1-s/4"), "has the share "));
  EXPECT_TRUE(has(error("Remaining mass=t"), "Remaining mass"));
}
