// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: a cable as a body of a scene is in balance in its found shape, moves as closed forms say,
// and refuses what makes no cable. Expected values: closed forms; the element of the other kind.
#include "cable/elastic_catenary.h"
#include "cable/errors_of_runs.h"
#include "cable/slack_cable.h"

#include "base/dot.h"
#include <taut/cable/find_shape.h>

namespace
{
  using namespace verification;
  using namespace taut;

  TEST(CableBodies, FoundShapeIsInBalance)
  {
    for (const CableElement element : {CableElement::ancf, CableElement::bar})
    {
      CableData data = slack_cable(element);
      data.force = {0., 0., 8.};
      const Cable cable(data);
      const std::vector<double> U(cable.n_dofs(), 0.), r = unbalanced(cable, U);
      EXPECT_FALSE(cable.is_linear());
      EXPECT_LT(largest_of(r, cable.constrained_dofs()), 1e-6);
      // Where it is held the forces are whole.
      const ElasticCatenary exact({}, {60., 0., 0.}, {0., -1.07 * 9.81, 8.}, 1.3e7, 78.);
      EXPECT_NEAR(std::hypot(std::hypot(r[0], r[1]), r[2]) / exact.end_force(), 1., 1e-6);
      EXPECT_GT(cable.strain_energy(U), 0.);
    }
  }

  TEST(CableBodies, WeightInTheMiddle)
  {
    // Two halves of catenaries with V = (w L + F) / 2 at the ends; a kink is for bars.
    const double w = 1.07 * 9.81, L = 78., F = 100., V = .5 * (w * L + F), EA = 1.3e7;
    const auto is_short = [&](const double H) {
      return .5 * H * L / EA + H / w * (std::asinh(V / H) - std::asinh((V - .5 * w * L) / H)) < 30.;
    };
    const double H = end_of(1., 1e5, is_short);
    const double depth =
        .5 * L / EA * (V - .25 * w * L) + (std::hypot(H, V) - std::hypot(H, V - .5 * w * L)) / w;
    const ElasticCatenary before({}, {60., 0., 0.}, {0., -w, 0.}, EA, L);
    const double sinking = depth + before.position(39.).y;
    EXPECT_NEAR(sinking, 1.045262, 1e-6);
    Cable cable(slack_cable(CableElement::bar));
    const LinearForm middle = cable.displacement({39., 0.}, {0., -1., 0.});
    cable.add_force(middle, F);
    const double found = middle.dot(equilibrium(cable));
    figure("error of a cable sinking by 1.045 m under a weight", found - sinking, "m");
    EXPECT_NEAR(found, sinking, 1e-5);
  }

  TEST(CableBodies, ElementsAgreeOnAPull)
  {
    // A force in space on a third of the cable; ANCF rounds the kink.
    std::vector<Coordinates> places;
    for (const CableElement element : {CableElement::ancf, CableElement::bar})
    {
      CableData data = slack_cable(element);
      data.n_elements = 96;
      Cable cable(data);
      cable.add_force(cable.displacement({26., 0.}, {1., 2., 3.}), 20.);
      const std::vector<double> q = cable.positions(equilibrium(cable));
      places.push_back(cable.elements().position(q, 52.));
    }
    EXPECT_LT(norm(places[0] - places[1]), .02);
    EXPECT_GT(places[0].z, 1.);
  }

  TEST(CableBodies, ClampsHoldTheDirectionAndNotTheStrain)
  {
    CableData data = slack_cable();
    data.length = 60.5;
    data.section.bending_stiffness = 2e4;
    data.clamped = true;
    data.force = {0., 0., 5.};
    Cable cable(data);
    const LinearForm middle = cable.displacement({.5 * data.length, 0.}, {0., -1., 0.});
    cable.add_force(middle, 5e3);
    const std::vector<double> U = equilibrium(cable), rest(U.size(), 0.);
    for (const double s : {0., data.length})
    {
      const Coordinates before = cable.elements().tangent(cable.positions(rest), s),
                        after = cable.elements().tangent(cable.positions(U), s);
      EXPECT_NEAR(dot(before, after) / (norm(before) * norm(after)), 1., 1e-14);
      EXPECT_GT(norm(after) - norm(before), 1e-4);
      EXPECT_NEAR(cable.elements().tension(cable.positions(U), s) /
                      cable.elements().tension(cable.positions(U), .25 * data.length),
                  1., .02);
    }
    // The tangent is the derivative of the force in these axes, too.
    const auto K = cable.tangent(U, {}, 0., false);
    std::vector<double> direction(U.size()), f, g;
    for (std::size_t i = 0; i < U.size(); ++i)
      direction[i] = std::cos(3. * i) * 1e-6;
    const std::vector<double> Kd = matrix_times(*K, direction);
    std::vector<double> ahead = U, behind = U;
    for (std::size_t i = 0; i < U.size(); ++i)
    {
      ahead[i] += direction[i];
      behind[i] -= direction[i];
    }
    cable.internal_force(ahead, {}, f);
    cable.internal_force(behind, {}, g);
    for (std::size_t i = 0; i < U.size(); ++i)
      EXPECT_NEAR(Kd[i], .5 * (f[i] - g[i]), 1e-6 * largest_of(Kd, {}));
    cable.internal_force(U, {}, f);
    const double work = dot(f, direction);
    EXPECT_NEAR(.5 * (cable.strain_energy(ahead) - cable.strain_energy(behind)), work,
                1e-6 * std::fabs(work) + 1e-9);
  }

  TEST(CableBodies, StartsStraight)
  {
    CableData data = slack_cable();
    data.holds_to = false;
    data.starts_straight = true;
    data.start_direction = {0., 0., 2.};
    const Cable cable(data);
    EXPECT_EQ(cable.constrained_dofs(), (std::vector<unsigned int>{0, 1, 2}));
    std::vector<double> U, V;
    cable.initial_state(U, V);
    EXPECT_NEAR(cable.strain_energy(U), 0., 1e-12);
    const Coordinates tip = cable.elements().position(cable.positions(U), 78.);
    EXPECT_NEAR(norm(tip - Coordinates{0., 0., 78.}), 0., 1e-12);
  }

  TEST(CableBodies, PlacesAndFields)
  {
    const Cable cable(slack_cable());
    EXPECT_THROW(cable.displacement({78.1, 0.}, {0., 1., 0.}), UserError);
    EXPECT_THROW(cable.displacement({-.1, 0.}, {0., 1., 0.}), UserError);
    const std::string path = testing::TempDir() + "taut_cable.vtu";
    cable.write_vtu(path, std::vector<double>(cable.n_dofs(), 0.));
    const std::string text = file_text(path);
    for (const char *name : {"tension", "unstressed_arc_length", "displacement"})
      EXPECT_TRUE(has(text, std::string("Name=\"") + name)) << name;
    std::remove(path.c_str());
  }

  const std::string scene = R"(Generator = network
Body cable: Type = cable; From = 0, 0; To = 60, 0, 0; Axial stiffness = 1.3e7;
  Mass per length = 1.07
Time: End = 0
)";

  TEST(CableEntries, LengthTensionOrSag)
  {
    // Horizontal tension and sag of the same cable of 78 m.
    const ElasticCatenary exact({}, {60., 0., 0.}, {0., -1.07 * 9.81, 0.}, 1.3e7, 78.);
    const double sag = -exact.position(39.).y;
    for (const std::string &entry :
         {std::string("Unstressed length=78"),
          "Horizontal tension=" + std::to_string(exact.horizontal()), "Sag=" + std::to_string(sag)})
      run_scene(scene,
                {"Body cable/Elements=32", "Body cable/Geometry=linearised", "Body cable/" + entry},
                [&](const StepView &view)
                {
                  const auto &cable = dynamic_cast<const Cable &>(view.structure[0]);
                  EXPECT_NEAR(cable.elements().length(), 78., 1e-5) << entry;
                  EXPECT_NEAR(cable.elements().position(cable.shape().positions, 39.).y, -sag,
                              1e-4);
                });
  }

  TEST(CableEntries, WhatMakesNoCable)
  {
    const std::tuple<Overrides, std::string, std::string> cases[] = {
        {{}, "Unstressed length", "exactly one"},
        {{"Unstressed length=78", "Sag=3"}, "Unstressed length", "exactly one"},
        {{"Unstressed length=-78"}, "Unstressed length", "negative"},
        {{"Unstressed length=78", "Through=30,-5"}, "Unstressed length", "exactly one"},
        {{"Through=30,5"}, "Through", "5 m above the straight line"},
        {{"Through=30,-5,1"}, "Through", "1 m beside it"},
        {{"Through=-1,-5"}, "Through", "not between the ends"},
        {{"Through=30"}, "Through", "one component"},
        {{"Through=30,-5", "Mass per length=0"}, "Through", "give the unstressed length"},
        {{"Horizontal tension=-1"}, "Horizontal tension", "negative"},
        {{"Unstressed length=58"}, "Largest strain", "longer or stiffer"},
        {{"Horizontal tension=1e6"}, "Largest strain", "longer or stiffer"},
        {{"Horizontal tension=1e3", "To=0,0"}, "To", "one place"},
        {{"Sag=3", "To=0,-10"}, "Sag", "not apart"},
        {{"Sag=3", "Mass per length=0"}, "Sag", "without weight"},
        {{"Unstressed length=78", "Mass per length=0"}, "", "without weight or wind"},
        {{"Unstressed length=78", "To=0,-70"}, "", "no stable equilibrium"},
        {{"Unstressed length=1e300"}, "", "beyond the range"},
        {{"Unstressed length=78", "Mass per length=1e300"}, "", "beyond the range"},
        {{"Unstressed length=78", "Axial stiffness=0"}, "Axial stiffness", "positive"},
        {{"Unstressed length=78", "Element=bar", "Bending stiffness=1"},
         "Bending stiffness",
         "ANCF"},
        {{"Unstressed length=78", "Element=bar", "Clamped=true"}, "Clamped", "ANCF"},
        {{"Unstressed length=78", "Force per length=3"}, "Force per length", "one component"},
        {{"Unstressed length=10.05", "To=10,0", "Bending stiffness=1e4", "Geometry=linearised"},
         "Geometry",
         "slack"},
    };
    for (auto [overrides, entry, text] : cases)
    {
      for (std::string &change : overrides)
        change = "Body cable/" + change;
      const std::string error = error_of(scene, overrides),
                        place = "Body cable" + (entry.empty() ? "" : "/" + entry) + ": ";
      EXPECT_EQ(error.substr(0, place.size()), place) << text;
      EXPECT_TRUE(has(error, text, place.size())) << error;
    }
  }
} // namespace
