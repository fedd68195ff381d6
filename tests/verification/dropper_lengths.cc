// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: the lengths of droppers in start.csv are those that the entry Lengths takes: a line with
// them has the state at rest of the line whose lengths were found. Sources: the found line itself;
// N/k, the stretch of a dropper.
#include "scene_tests.h"

#include <map>

using namespace verification;

namespace
{
  /// The columns of start.csv by their names.
  std::map<std::string, std::vector<double>> start_of(const Session &session)
  {
    std::ifstream file(session.folder() + "/start.csv");
    std::string line, cell;
    std::vector<std::string> names;
    std::getline(file, line);
    for (std::istringstream cells(line); std::getline(cells, cell, ',');)
      names.push_back(cell);
    std::map<std::string, std::vector<double>> columns;
    while (std::getline(file, line))
    {
      std::istringstream cells(line);
      for (std::size_t i = 0; std::getline(cells, cell, ','); ++i)
        if (i > 0)
          columns[names.at(i)].push_back(std::stod(cell));
    }
    return columns;
  }

  struct AtRest
  {
    std::vector<double> force, length, stretched, height;
  };

  AtRest at_rest(Overrides overrides, const std::vector<double> &lengths)
  {
    overrides.insert(overrides.end(), {"Time/End=0", "Catenary/Number of spans=1",
                                       "Catenary/Uplift positions=", "Statistics/Window="});
    if (!lengths.empty())
    {
      std::string list = "Catenary/Droppers/Lengths=";
      for (const double length : lengths)
        list += (list.back() == '=' ? "" : ", ") + number(length);
      overrides.push_back(list);
    }
    Session session(scene_file("en50318_2002_250"), overrides);
    AtRest result;
    session.run(
        [&](const taut::StepView &step)
        {
          for (double x = 1.; x < 60.; x += 1.)
            for (const std::size_t wire : {0, 1})
              result.height.push_back(displacement(step, wire, x));
        });
    auto start = start_of(session);
    for (std::size_t i = 0; i < 9; ++i)
    {
      result.force.push_back(start.at("force [N or N m]").at(i));
      result.length.push_back(start.at("length [m]").at(i));
      result.stretched.push_back(start.at("stretched length [m]").at(i));
    }
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
    for (std::size_t i = 0; i < found.height.size(); ++i)
      worst = std::max(worst, std::fabs(given.height[i] - found.height[i]));
  }
  figure("line with given lengths, largest distance from the line of found ones", worst, "m");
  EXPECT_LT(worst, 1e-9);
}
