// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: a tension length may be of another kind than the line, and have other wires, arms and
// droppers. Source: lines of one tension length, whose entries are these.
#include "scene_tests.h"

using namespace verification;

namespace
{
  /// A line under a pantograph that starts at x = @p start.
  std::string line(const std::string &entries, const std::string &start)
  {
    return R"(Generator = catenary
Start = equilibrium
Time: Scheme = Newmark; Step = 1e-3; End = 0.2
Catenary/Contact wire: Mass per length = 1.35; Tension = 20000; Bending stiffness = 195; Element size = 1
  ; Mass damping = 0.1; Stiffness damping = 1e-4
Catenary/Messenger wire: Mass per length = 1.07; Tension = 16000; Element size = 1
Pantograph pantograph: Masses = 8, 10; Stiffnesses = 5000, 60; Dampings = 20, 80; Static force = 110
  ; Speed = 108; Contact stiffness = 5e4; Start = )" +
           start + "\n" + entries;
  }

  const std::string
      wires_and_rail = R"(Catenary: Tension lengths = wires, rail
Catenary/Tension length wires: Number of spans = 4; Span length = 50
Catenary/Tension length wires/Messenger wire: Mass per length = 0.9; Tension = 14000; Bending stiffness = 80
Catenary/Tension length wires/Contact wire: Bending stiffness = 150
Catenary/Tension length wires/Droppers: Positions = 5, 15, 25, 35, 45; Stiffness = 5e4; Damping = 3; Mass per length = 0.2
Catenary/Tension length rail: Kind = conductor rail; Begin = 300; Number of spans = 5; Span length = 8
Catenary/Tension length rail/Contact wire: Mass per length = 10; Tension = 0; Bending stiffness = 2.1e5
Catenary/Tension length rail/Supports: Arm mass = 2; Arm stiffness = 4e5; Arm damping = 300
)",
      wires = R"(Catenary: Number of spans = 4; Span length = 50
Catenary/Messenger wire: Mass per length = 0.9; Tension = 14000; Bending stiffness = 80
Catenary/Contact wire: Bending stiffness = 150
Catenary/Droppers: Positions = 5, 15, 25, 35, 45; Stiffness = 5e4; Damping = 3; Mass per length = 0.2
)",
      rail = R"(Catenary: Kind = conductor rail; Begin = 300; Number of spans = 5; Span length = 8
Catenary/Contact wire: Mass per length = 10; Tension = 0; Bending stiffness = 2.1e5
Catenary/Supports: Arm mass = 2; Arm stiffness = 4e5; Arm damping = 300
)";

  /// Heights of a wire at a place, over the time.
  std::vector<double> heights(const std::string &scene, const std::string &wire, const double s,
                              const Overrides &overrides = {})
  {
    return history_of(scene, overrides,
                      [&](const taut::StepView &view)
                      {
                        std::size_t w = 0;
                        while (view.scene.wires[w].name != wire)
                          ++w;
                        return displacement(view, w, s);
                      });
  }
} // namespace

TEST(TensionLengths, of_other_kinds_and_wires_are_lines_of_their_own)
{
  const std::vector<double> contact = heights(line(wires_and_rail, "60"), "contact wires", 62.),
                            alone = heights(line(wires, "60"), "contact", 62.),
                            on_rail = heights(line(wires_and_rail, "310"), "contact rail", 12.),
                            rail_alone = heights(line(rail, "310"), "contact", 12.);
  EXPECT_GT(largest(alone), 1e-3);
  EXPECT_GT(largest(rail_alone), 1e-5);
  EXPECT_LT(figure("wires beside a rail, over wires alone",
                   largest_difference(contact, alone) / largest(alone)),
            1e-9);
  EXPECT_LT(figure("rail beside wires, over a rail alone",
                   largest_difference(on_rail, rail_alone) / largest(rail_alone)),
            1e-9);
  // It bends, whatever the wires beside it do.
  const std::vector<double> beside_strings = heights(line(wires_and_rail, "310"), "contact rail",
                                                     12., {"Catenary/Contact wire/Model=string"});
  EXPECT_LT(largest_difference(beside_strings, rail_alone), 1e-9 * largest(rail_alone));
  // Each own entry has an effect.
  for (const std::string entry :
       {"wires/Messenger wire/Mass per length", "wires/Messenger wire/Tension",
        "wires/Messenger wire/Bending stiffness", "wires/Contact wire/Bending stiffness",
        "wires/Droppers/Stiffness", "wires/Droppers/Damping", "wires/Droppers/Mass per length"})
  {
    const std::vector<double> other =
        history_of(line(wires_and_rail, "60"), {"Catenary/Tension length " + entry + "="},
                   [](const taut::StepView &view) { return displacement(view, 1, 62.); });
    EXPECT_GT(largest_difference(other, contact), 1e-7) << entry;
  }
}

TEST(TensionLengths, a_rail_beside_wires_needs_its_own_numbers)
{
  const auto error = [](const std::string &entry)
  {
    return error_of(
        [&] { Session(line(wires_and_rail, "60"), {"Catenary/Tension length rail/" + entry}); });
  };
  for (const std::string entry : {"Mass per length", "Tension", "Bending stiffness"})
    EXPECT_TRUE(has(error("Contact wire/" + entry + "="), "has its own")) << entry;
  EXPECT_TRUE(has(error("Supports/Arm mass=-1"), "must not be negative"));
  const std::string massless = error("Contact wire/Mass per length=0");
  EXPECT_TRUE(has(massless, "must be positive")) << massless;
  EXPECT_TRUE(has(massless, "Tension length rail/Contact wire/Mass per length")) << massless;
  EXPECT_TRUE(has(error("Supports/Arm mass=two"), "'two' is not a finite number"));
  EXPECT_TRUE(has(error_of(
                      []
                      {
                        Session(line(wires_and_rail, "60"),
                                {"Catenary/Kind=conductor rail",
                                 "Catenary/Tension length wires/Kind=catenary"});
                      }),
                  "Mass per length: a wire beside a conductor rail has its own"));
  EXPECT_TRUE(
      has(error_of([] { Session(line(rail, "310"), {"Catenary/Contact wire/Model=string"}); }),
          "a conductor rail bends"));
}
