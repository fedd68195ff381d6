// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: where faces of the slave are covered in part, and where nodes are on faces in space,
// either a uniform pressure is uniform or a warning names the contact. Source: blocks without
// lateral contraction between plates, where all is the pressure on top.
#include "solid/limits_run.h"

using namespace solid_limits;

namespace
{
  constexpr double pressure = 1e6;

  struct Pressures
  {
    double least = 1e300, largest = -1e300; ///< over the exact one
    bool is_named = false;
    std::string error, log;
  };

  Pressures pressures(const std::string &text)
  {
    const Ran ran = run(text);
    Pressures result;
    result.error = ran.error;
    for (std::size_t i = 0; i < ran.constraints.size(); ++i)
    {
      const double p = ran.forces[i] / ran.constraints[i].area / pressure;
      result.least = std::fmin(result.least, p);
      result.largest = std::fmax(result.largest, p);
    }
    result.log = ran.log;
    result.is_named = has(result.log, "Warning: contact");
    return result;
  }

  /// A block on two that meet below it at x, all as wide as 1 m.
  Pressures on_two(const double x, const bool chooses)
  {
    const std::string at = verification::number(x);
    std::string contacts = "";
    for (const std::string side : {"a", "b"})
      contacts += "Contact " + side + ": Slave = upper: 2; Master = " + side +
                  ": 3; Choose slave = " + (chooses ? "true" : "false") + "\n";
    return pressures(
        scene("equilibrium",
              box("upper", "10, 3 : 0, 0 : 1, 0.3", "Traction = 3: 0, -1e6; Displacement = 0: 0,") +
                  box("a", "7, 3 : 0, -0.3 : " + at + ", 0", "Fixed boundaries = 2") +
                  box("b", "6, 3 : " + at + ", -0.3 : 1, 0", "Fixed boundaries = 2"),
              contacts + at_rest));
  }
} // namespace

// Elements of 0.1 m above a joint that leaves a part of one of them to each side.
TEST(SolidOverhangs, pass_a_uniform_pressure)
{
  for (const double part : {0., .02, .1, .25, .5, .75, .9, .98})
    for (const bool chooses : {false, true})
    {
      const Pressures found = on_two(.5 + .1 * part, chooses);
      ASSERT_EQ(found.error, "");
      EXPECT_NEAR(found.least, 1., 1e-9) << part;
      EXPECT_NEAR(found.largest, 1., 1e-9) << part;
      EXPECT_EQ(found.is_named, part > 0. && !chooses) << part << found.log;
    }
}

// A punch on a plate that is wider. Expected: nearly the mean away from its ends. As the slave, the
// plate has pairs of nodes there of several times the mean and next to nothing.
TEST(SolidOverhangs, alternate_at_the_ends_and_are_named)
{
  double least = 1., largest = 1.;
  for (const char *const cells : {"41, 12", "17, 6"})
    for (const bool chooses : {false, true})
    {
      const Pressures found = pressures(
          scene("equilibrium",
                box("wide", std::string(cells) + " : 0, 0 : 1, 0.3", "Fixed boundaries = 2") +
                    box("narrow", "8, 4 : 0.1, 0.3 : 0.55, 0.6",
                        "Traction = 3: 0, -1e6; Displacement = 0: 0,"),
                contact("wide: 3", "narrow: 2",
                        std::string("Choose slave =") + (chooses ? "true" : "false")) +
                    at_rest));
      ASSERT_EQ(found.error, "");
      EXPECT_NE(found.is_named, chooses) << found.log;
      EXPECT_EQ(has(found.log, "Choose slave = true"), !chooses) << found.log;
      if (chooses)
      {
        EXPECT_GT(found.least, .88) << cells;
        EXPECT_LT(found.largest, 1.7) << cells;
      }
      else
      {
        least = std::fmin(least, found.least);
        largest = std::fmax(largest, found.largest);
      }
    }
  verification::figure("slave that overhangs, least pressure over the mean", least);
  verification::figure("slave that overhangs, largest pressure over the mean", largest);
  EXPECT_LT(least, .5);
  EXPECT_GT(largest, 3.);
}

TEST(SolidOverhangs, nodes_on_faces_in_space_are_named_where_they_are_off)
{
  double least = 1., largest = 1.;
  for (const auto &[n, m] : {std::pair<int, int>(2, 2), {3, 2}, {4, 2}, {5, 2}, {2, 3}, {3, 4}})
  {
    const auto cells = [](const int k) { return std::to_string(k) + ", " + std::to_string(k); };
    const Pressures found = pressures(scene(
        "equilibrium",
        box("lower", cells(m) + ", 2 : 0, 0, 0 : 1, 1, 1", "Dimension = 3; Fixed boundaries = 4") +
            box("upper", cells(n) + ", 2 : 0, 0, 1 : 1, 1, 2",
                "Dimension = 3; Traction = 5: 0, 0, -1e6; Displacement = 0: 0, , ; 2: , 0,"),
        contact("upper: 4", "lower: 5", "Method = nodes to faces") + at_rest));
    ASSERT_EQ(found.error, "");
    least = std::fmin(least, found.least);
    largest = std::fmax(largest, found.largest);
    EXPECT_TRUE(found.is_named || (found.least >= .99 && found.largest <= 1.01)) << n << found.log;
    if (n == m)
    {
      EXPECT_FALSE(found.is_named) << found.log;
      EXPECT_NEAR(found.least, 1., 1e-9);
    }
  }
  verification::figure("nodes on faces in space, least pressure over the exact one", least);
  verification::figure("nodes on faces in space, largest pressure over the exact one", largest);
  EXPECT_LT(least, .8);
  EXPECT_GT(largest, 1.1);
}

// A slave in space that is twice as wide as its master.
TEST(SolidOverhangs, in_space_are_named)
{
  for (const double width : {.5, .6, 1.})
  {
    const std::string w = verification::number(width);
    const Pressures found = pressures(scene(
        "equilibrium",
        box("lower", "2, 2, 2 : 0, 0, 0 : " + w + ", 1, 1", "Dimension = 3; Fixed boundaries = 4") +
            box("upper", "2, 2, 2 : 0, 0, 1 : 1, 1, 2",
                "Dimension = 3; Displacement = 5: 0, 0, -1e-4"),
        contact("upper: 4", "lower: 5", "Method = nodes to faces") + at_rest));
    ASSERT_EQ(found.error, "");
    EXPECT_EQ(has(found.log, "overhangs the master by"), width < 1.) << width << found.log;
  }
}
