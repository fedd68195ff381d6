// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: the lengths of droppers in start.csv are those that the entry Lengths takes: a line with
// them has the state at rest of the line whose lengths were found. Sources: the found line itself;
// N/k, the stretch of a dropper.
#include "scene_tests.h"

using namespace verification;

namespace
{
  struct AtRest
  {
    std::vector<double> force, length, stretched, height;
  };

  AtRest at_rest(const Overrides &overrides, const std::vector<double> &lengths)
  {
    std::string list;
    for (const double length : lengths)
      list += (list.empty() ? "Catenary/Droppers/Lengths=" : ", ") + number(length);
    Session session(scene_file("en50318_2002_250"),
                    overrides +
                        Overrides{"Time/End=0", "Catenary/Number of spans=1",
                                  "Catenary/Uplift positions=", "Statistics/Window="} +
                        (list.empty() ? Overrides() : Overrides{list}));
    AtRest result;
    session.run(
        [&](const taut::StepView &step)
        {
          for (double x = 1.; x < 60.; x += 1.)
            for (const std::size_t wire : {0, 1})
              result.height.push_back(displacement(step, wire, x));
        });
    const auto start = read_table(session.folder() + "/start.csv");
    const auto column = [&](const std::string &title)
    { return std::vector<double>(start.at(title).begin(), start.at(title).begin() + 9); };
    result.force = column("force [N or N m]");
    result.length = column("length [m]");
    result.stretched = column("stretched length [m]");
    return result;
  }
} // namespace

TEST(DropperLengths, of_start_csv_give_the_same_state_at_rest)
{
  double worst = 0.;
  for (const double stiffness : {1e5, 1e4})
  {
    const Overrides overrides = {"Catenary/Droppers/Stiffness=" + number(stiffness),
                                 "Catenary/Droppers/Pre-sag=0, 0.01, 0.02, 0.03, 0.03, 0.03, 0.02,"
                                 " 0.01, 0"};
    const AtRest found = at_rest(overrides, {}), given = at_rest(overrides, found.length);
    for (std::size_t i = 0; i < found.length.size(); ++i)
    {
      EXPECT_GT(found.force[i], 10.);
      EXPECT_NEAR(found.stretched[i] - found.length[i], found.force[i] / stiffness, 1e-12);
      EXPECT_NEAR(given.force[i], found.force[i], 1e-6 * found.force[i]) << i;
      EXPECT_NEAR(given.length[i], found.length[i], 1e-15) << i;
      EXPECT_NEAR(given.stretched[i], found.stretched[i], 1e-9) << i;
    }
    raise(worst, largest_difference(found.height, given.height));
  }
  figure("line with given lengths, largest distance from the line of found ones", worst, "m");
  EXPECT_LT(worst, 1e-9);
}
