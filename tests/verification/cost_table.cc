// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: the times of the parts of a step add up to the step, and their table has all steps.
// Source: a clock around the same work, and the log of the run.
#include "scene_tests.h"

#include <taut/time/step_costs.h>

#include <regex>
#include <thread>

using namespace verification;
using taut::StepCosts;
using taut::StepPart;

namespace
{
  double sum_of_parts(const StepCosts::Sums &sums)
  {
    return std::accumulate(sums.parts.begin(), sums.parts.end(), 0.);
  }

  double part(const StepCosts::Sums &sums, const StepPart part)
  {
    return sums.parts[static_cast<std::size_t>(part)];
  }

  void make_step(StepCosts &costs, const std::chrono::microseconds &pause)
  {
    costs.begin_step();
    std::this_thread::sleep_for(pause);
    costs.lap(StepPart::contacts);
    std::this_thread::sleep_for(2 * pause);
    costs.lap(StepPart::bodies);
    costs.end_step();
  }

  double sum(const std::vector<double> &values)
  {
    return std::accumulate(values.begin(), values.end(), 0.);
  }
} // namespace

TEST(StepCosts, parts_add_up_to_the_steps)
{
  StepCosts costs;
  for (int i = 0; i < 10; ++i)
    make_step(costs, std::chrono::microseconds(500));
  const StepCosts::Sums &sums = costs.sums();
  EXPECT_EQ(sums.n_steps, 10);
  EXPECT_GE(part(sums, StepPart::contacts), 10 * .5e-3);
  EXPECT_GE(part(sums, StepPart::bodies), 10 * 1e-3);
  const double in_steps = sum_of_parts(sums) - part(sums, StepPart::output);
  EXPECT_LE(in_steps, sums.stepping);
  EXPECT_GE(in_steps, .9 * sums.stepping);
}

TEST(StepCosts, output_is_between_the_steps)
{
  StepCosts costs;
  for (int i = 0; i < 3; ++i)
  {
    make_step(costs, std::chrono::microseconds(0));
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  EXPECT_GE(part(costs.sums(), StepPart::output), 4e-3); // the last one is not over
}

TEST(StepCosts, laps_outside_of_a_step_are_not_measured)
{
  StepCosts costs;
  costs.lap(StepPart::contacts);
  costs.begin_step();
  costs.end_step();
  costs.lap(StepPart::contacts);
  EXPECT_EQ(part(costs.sums(), StepPart::contacts), 0.);
}

TEST(CostTable, has_all_steps_of_a_run)
{
  for (const std::string interval : {"0", "0.1"})
  {
    Session session(scene_file("pendulum_cable"),
                    {"Output/Observers=cost", "Output/Interval=" + interval, "Time/End=1"});
    long iterations = 0;
    session.run([&](const taut::StepView &view)
                { iterations += view.state.time > 0. ? view.residuals.iterations : 0; });
    const auto table = read_table(session.folder() + "/cost.csv");
    const std::vector<double> &steps = table.at("steps [1]"), &times = table.at("time [s]");
    const double n = static_cast<double>(session.simulation().n_steps());
    EXPECT_EQ(sum(steps), n);
    EXPECT_NEAR(times.back(), 1., 1e-12);
    EXPECT_EQ(steps.size(), interval == "0" ? n : 11.);

    double newton = 0., active = 0., seconds = 0.;
    for (std::size_t i = 0; i < steps.size(); ++i)
    {
      newton += steps[i] * table.at("Newton iterations [1]")[i];
      active += steps[i] * table.at("active-set iterations [1]")[i];
      for (const auto &[name, column] : table)
        if (name.find("[us]") != std::string::npos && name != "output [us]")
          seconds += 1e-6 * steps[i] * column[i];
    }
    EXPECT_NEAR(active, iterations, 1e-6 * iterations);
    std::smatch match;
    const std::string log = session.log();
    ASSERT_TRUE(std::regex_search(log, match, std::regex("method: ([0-9.]+) solves a step")));
    EXPECT_NEAR(newton / n, std::stod(match[1]), 1e-4 * newton / n);
    const double all = session.simulation().stepping_seconds();
    EXPECT_LE(seconds, all);
    EXPECT_GE(seconds, .9 * all);
  }
}

TEST(CostTable, log_says_where_the_time_goes)
{
  const std::string log = log_of(scene_file("bar_on_wall"), {"Output/Observers=cost"});
  const std::size_t begin = log.find("Where the time goes, us a step:\n");
  ASSERT_NE(begin, std::string::npos) << log;
  std::istringstream lines(log.substr(begin));
  std::string line;
  std::getline(lines, line);
  const std::regex part("  ([^0-9]+) +([0-9.]+) +([0-9.]+) %");
  double all = 0., before = 100.;
  for (std::smatch match; std::getline(lines, line) && std::regex_match(line, match, part);)
  {
    EXPECT_LE(std::stod(match[3]), before) << "the largest first";
    all += before = std::stod(match[3]);
  }
  EXPECT_NEAR(all, 100., 1.5);
}

// Claim: a scene at rest has no steps, and says nothing of them.
TEST(CostTable, is_empty_at_rest)
{
  Session session(scene_file("en50318_2002_string"), {"Output/Observers=cost"});
  session.run();
  EXPECT_EQ(session.log().find("Where the time goes"), std::string::npos);
  EXPECT_TRUE(read_table(session.folder() + "/cost.csv").empty());
}
