// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: places on a wire that differ by less than 1e-6 of an element are one node, so that scenes
// whose positions are written with different numbers of digits are those with equal ones.
#include "cable/errors_of_runs.h"
#include "common.h"

#include "scene/shared_places.h"

using namespace verification;

namespace
{
  /// A wire that a support, a point mass, a dropper with a mass and a load meet at.
  std::string scene(const std::string &components, const std::vector<std::string> &places,
                    const std::string &end)
  {
    return "Wire wire: To = 10, 0; Components = " + components +
           R"(; Mass per length = 1; Tension = 500;
  Bending stiffness = 200; Element size = 0.5
Wire other: From = 0, 1; To = 10, 1; Components = )" +
           components + R"(; Mass per length = 2;
  Tension = 900; Bending stiffness = 300; Element size = 0.5
Support ends: Wire = wire; Positions = 0, )" +
           end + R"(
Support spring: Wire = wire; Type = elastic; Stiffness = 300; Positions = )" +
           places.at(0) + R"(
Support others: Wire = other; Positions = 0, 10
Point mass clamp: Wire = wire; Mass = 2; Positions = )" +
           places.at(1) + R"(
Link dropper: Type = dropper; From = other @ 3.333333; To = wire @ )" +
           places.at(2) + R"(;
  Direction = 0, -1
Load push: On = wire @ )" +
           places.at(3) + R"(; Magnitude = -60
Time: Scheme = BDF2; Step = 1e-2; End = 0.1
)";
  }

  struct Answers
  {
    std::vector<double> values; ///< of the last step
    std::size_t n_nodes = 0;
  };
  const std::vector<std::string> one_place(4, "3.333333");

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
} // namespace

TEST(PlacesOnWires, written_with_different_numbers_of_digits_are_one)
{
  double worst = 0.;
  for (const std::string components : {"string", "beam"})
    for (const std::string parts : {"1", "4"})
    {
      const Answers equal = answers(scene(components, one_place, "10"), parts);
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
    const std::string text = scene(components, one_place, "10");
    const std::string held_twice =
        error_of(text + "Support spring: -Type; -Stiffness; Positions = 3.333333, 3.3333333333\n");
    EXPECT_TRUE(has(held_twice, "is held there already, at 3.333333 m")) << held_twice;
    const std::string two_links =
        error_of(text + "Link dropper: To = wire @ 3.333333, 3.3333333333\n");
    EXPECT_TRUE(has(two_links, "between the same two points")) << two_links;
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
