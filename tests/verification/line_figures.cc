// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: figures of lines are the same wherever a run says them. Source: one against the other,
// formulas of strings.
#include "scene_tests.h"

#include <taut/study/sweep.h>

#include <nlohmann/json.hpp>

#include <filesystem>
#include <regex>

using namespace verification;

namespace
{
  /// A pantograph runs under two spans of strings with droppers, and leaves the wire at times.
  const std::string line = R"(Generator = catenary
Start = equilibrium
Catenary: Number of spans = 2; Span length = 40; Pantographs = pantograph
Catenary/Contact wire: Model = string; Mass per length = 1; Tension = 10000; Element size = 1
Catenary/Messenger wire: Model = string; Mass per length = 0.8; Tension = 12000; Element size = 1
Catenary/Supports: Arm mass = 0
Catenary/Droppers: Positions = 10, 20, 30
Pantograph pantograph: Masses = 7, 15; Stiffnesses = 5000, 0; Dampings = 10, 20; Static force = 60; Start = 10; Speed = 180; Contact stiffness = 50000
Time: Step = 2e-3; End = 1.2; Scheme = Newmark
Statistics: Window = 20, 65
)";

  struct Said
  {
    nlohmann::json json;
    std::string log;
    std::map<std::string, std::vector<double>> sliding;
  };

  Said say(const std::string &scene, const Overrides &overrides = {})
  {
    Session session(scene, overrides);
    session.run();
    Said said;
    std::ifstream(session.folder() + "/statistics.json") >> said.json;
    said.log = session.log();
    said.sliding = read_table(session.folder() + "/sliding.csv");
    return said;
  }

  double value(const nlohmann::json &quantity)
  {
    return quantity.at("value").get<double>();
  }
} // namespace

TEST(LineFigures, constants_of_lines_are_those_of_the_log)
{
  const Said said = say(line, {"Time/End=0.01", "Statistics/Window="});
  const nlohmann::json &constants = said.json.at("line_constants").at("pantograph");
  EXPECT_EQ(constants.at("wire"), "contact");
  EXPECT_NEAR(value(constants.at("wave_speed")), 100., 1e-9);
  EXPECT_NEAR(value(constants.at("speed_over_wave_speed")), .5, 1e-12);
  EXPECT_NEAR(value(constants.at("doppler_factor")), 1. / 3., 1e-12);
  const std::regex text(R"('pantograph' at (\S+) m/s under 'contact', whose waves have (\S+) m/s: )"
                        R"(v/c (\S+), Doppler factor (\S+), reflection at droppers (\S+), )"
                        R"(amplification (\S+))");
  std::smatch found;
  ASSERT_TRUE(std::regex_search(said.log, found, text)) << said.log;
  const char *const names[] = {"speed",
                               "wave_speed",
                               "speed_over_wave_speed",
                               "doppler_factor",
                               "reflection_at_droppers",
                               "amplification"};
  for (int i = 0; i < 6; ++i)
  {
    const double in_log = std::stod(found[i + 1]);
    EXPECT_NEAR(value(constants.at(names[i])), in_log, 6e-3 * in_log) << names[i];
  }
}

TEST(LineFigures, columns_of_sweeps_are_the_statistics)
{
  Session session(line);
  session.run();
  nlohmann::json said;
  std::ifstream(session.folder() + "/statistics.json") >> said;
  const std::string file = session.folder() + "/scene.prm";
  {
    std::ofstream text(file);
    session.parameters().print(text);
  }
  std::ostringstream log;
  taut::Sweep sweep(file,
                    {"Sweep/Parameters=step", "Sweep/Parameter step/Entries=Time/Step",
                     "Sweep/Parameter step/Values=2e-3", "Sweep/Folder=" + session.folder() + "/s"},
                    taut::Communicator(), log);
  sweep.run();
  std::ifstream table(session.folder() + "/s/sweep.csv");
  std::string titles, numbers;
  std::getline(table, titles);
  std::getline(table, numbers);
  std::map<std::string, double> swept;
  const std::vector<std::string> heads = cells_of(titles), cells = cells_of(numbers);
  for (std::size_t i = 0; i < cells.size(); ++i)
    swept[heads[i]] = std::stod(cells[i]);
  int n_compared = 0;
  const auto compare = [&](const std::string &title, const double expected)
  {
    ASSERT_EQ(swept.count(title), 1u) << title;
    EXPECT_NEAR(swept.at(title), expected, 1e-12 * std::fabs(expected)) << title;
    ++n_compared;
  };
  const nlohmann::json &force = said.at("sliding_contacts").at("pantograph");
  compare("pantograph: standard deviation over mean [1]",
          value(force.at("filtered").at("standard_deviation_over_mean")));
  compare("pantograph: height range [m]", 1e-3 * value(force.at("height_range")));
  const char *const bands[] = {"0 to 2", "0 to 5", "5 to 20", "0 to 20"};
  for (int i = 0; i < 4; ++i)
    compare(std::string("pantograph: standard deviation ") + bands[i] + " Hz [N]",
            value(force.at("bands").at(i).at("standard_deviation")));
  const char *const durations[] = {"5", "10", "20"};
  for (int i = 0; i < 3; ++i)
  {
    const std::string over = std::string("losses over ") + durations[i] + " ms [1]";
    const nlohmann::json &losses = force.at("losses").at(i);
    EXPECT_GT(losses.at("number"), 0);
    compare("pantograph: " + over, losses.at("number").get<double>());
    compare("pantograph: share of " + over, 1e-2 * value(losses.at("share")));
  }
  double n_slackenings = 0.;
  for (const auto &[name, link] : said.at("links").items())
    for (const auto &[key, quantity] : link.items())
    {
      compare(name + ": " + std::regex_replace(key, std::regex("_"), " ") + " [" +
                  quantity.at("unit").get<std::string>() + "]",
              value(quantity));
      n_slackenings += key == "slackenings" ? value(quantity) : 0.;
    }
  EXPECT_EQ(n_compared, 12 + 6 * 9);
  EXPECT_GT(n_slackenings, 0.);
}
