// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: places on a wire that differ by less than 1e-6 of an element are one node, so that scenes
// whose positions are written with different numbers of digits are those with equal ones.
#include "run.h"

#include <taut/base/exceptions.h>
#include <taut/scene/shared_places.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace verification;

namespace
{
  /// A wire that a support, a point mass, a dropper with a mass and a load meet at.
  std::string scene(const std::string &components, const std::vector<std::string> &places,
                    const std::string &end)
  {
    return "set Generator = network\nsubsection Network\n set Wires = wire, other\n"
           " set Supports = ends, spring, others\n set Point masses = clamp\n"
           " set Links = dropper\n set Loads = push\n"
           " subsection Wire wire\n  set To = 10, 0\n  set Components = " +
           components +
           "\n  set Mass per length = 1\n  set Tension = 500\n  set Bending stiffness = 200\n"
           "  set Element size = 0.5\n end\n"
           " subsection Wire other\n  set From = 0, 1\n  set To = 10, 1\n  set Components = " +
           components +
           "\n  set Mass per length = 2\n  set Tension = 900\n  set Bending stiffness = 300\n"
           "  set Element size = 0.5\n end\n"
           " subsection Support ends\n  set Wire = wire\n  set Positions = 0, " +
           end +
           "\n end\n"
           " subsection Support others\n  set Wire = other\n  set Positions = 0, 10\n end\n"
           " subsection Support spring\n  set Wire = wire\n  set Type = elastic\n"
           "  set Stiffness = 300\n  set Positions = " +
           places.at(0) +
           "\n end\n"
           " subsection Point mass clamp\n  set Wire = wire\n  set Mass = 2\n  set Positions = " +
           places.at(1) +
           "\n end\n"
           " subsection Link dropper\n  set Type = dropper\n  set From = other @ 3.333333\n  set "
           "To = wire @ " +
           places.at(2) +
           "\n  set Direction = 0, -1\n end\n"
           " subsection Load push\n  set On = wire @ " +
           places.at(3) +
           "\n  set Magnitude = -60\n end\nend\n"
           "subsection Time\n set Scheme = BDF2\n set Step = 1e-2\n set End = 0.1\nend\n";
  }

  struct Answers
  {
    std::vector<double> values; ///< of the last step
    std::size_t n_nodes = 0;
  };

  Answers answers(const std::string &text, const std::string &parts)
  {
    Answers result;
    run_scene(text, {"Partition/Number of substructures=" + parts},
              [&](const taut::StepView &step)
              {
                result.values = step.supports;
                for (std::size_t i = 0; i < step.constraints.size(); ++i)
                  if (step.constraints[i].is_link())
                    result.values.push_back(step.state.multiplier[i]);
                result.values.push_back(displacement(step, 0, 3.));
                result.n_nodes = taut::grid(step.scene, 0).size();
              });
    return result;
  }

  std::string error_of(const std::string &text)
  {
    try
    {
      run_scene(text, {}, [](const taut::StepView &) {});
    }
    catch (const taut::UserError &error)
    {
      return error.what();
    }
    return "";
  }

  std::string replaced(std::string text, const std::string &a, const std::string &b)
  {
    const std::size_t at = text.find(a);
    return at == std::string::npos ? "" : text.replace(at, a.size(), b);
  }
} // namespace

TEST(PlacesOnWires, written_with_different_numbers_of_digits_are_one)
{
  double worst = 0.;
  for (const std::string components : {"string", "beam"})
    for (const std::string parts : {"1", "4"})
    {
      const Answers equal =
          answers(scene(components, {"3.333333", "3.333333", "3.333333", "3.333333"}, "10"), parts);
      for (const auto &places :
           {std::vector<std::string>{"3.333333", "3.3333333333", "3.33333333333333", "3.3333333"},
            {"3.33333333333333", "3.333333", "3.3333333333", "3.33333335"}})
      {
        const Answers found = answers(scene(components, places, "9.9999999"), parts);
        EXPECT_EQ(found.n_nodes, equal.n_nodes) << components;
        ASSERT_EQ(found.values.size(), equal.values.size());
        for (std::size_t i = 0; i < equal.values.size(); ++i)
        {
          const double error =
              std::fabs(found.values[i] - equal.values[i]) / std::fabs(equal.values[i]);
          worst = std::max(worst, error);
          EXPECT_LT(error, 1e-9) << components << ", " << parts << " parts, " << i;
        }
      }
    }
  figure("places that nearly coincide, largest change of forces", worst);
}

// Where they differ by more than that, the message has both.
TEST(PlacesOnWires, that_are_too_close_are_named)
{
  for (const std::string components : {"string", "beam"})
  {
    const std::string text =
        scene(components, {"3.333333", "3.333333", "3.333333", "3.333333"}, "10");
    const std::string held_twice =
        error_of(replaced(replaced(text, "set Type = elastic\n  set Stiffness = 300\n", ""),
                          "set Positions = 3.333333", "set Positions = 3.333333, 3.3333333333"));
    EXPECT_NE(held_twice.find("is held there already, at 3.333333 m"), std::string::npos)
        << held_twice;
    const std::string two_links =
        error_of(replaced(text, "wire @ 3.333333", "wire @ 3.333333, 3.3333333333"));
    EXPECT_NE(two_links.find("between the same two points"), std::string::npos) << two_links;
  }
}

TEST(PlacesOnWires, stay_where_they_are_unless_they_nearly_coincide)
{
  taut::Scene scene;
  scene.wires.resize(2);
  for (taut::Wire &wire : scene.wires)
  {
    wire.b = {10., 0.};
    wire.element_size = .5;
  }
  scene.supports.resize(2);
  const double rounding = 4. + 1e-15, near = 4. + 4e-7, away = 4. + 1.1e-6;
  scene.supports[0].positions = {near, 4., away, rounding, 1e-8, 10. - 1e-8};
  scene.supports[1].wire = 1;
  scene.supports[1].positions = {near, 9.};
  taut::share_places(scene);
  EXPECT_EQ(scene.supports[0].positions, (std::vector<double>{4., 4., away, rounding, 0., 10.}));
  EXPECT_EQ(scene.supports[1].positions, (std::vector<double>{near, 9.}));
}
