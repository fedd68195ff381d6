// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: a table with an interval shows what happened between its lines. Source: forces, gaps and
// displacements that an observer of the same run sees in every step.
#include "scene_tests.h"

#include <cctype>

using namespace verification;

namespace
{
  // A ball of 0.5 kg hits a buffer of 5e5 N/m at 0.26 m/s: half a period of sqrt(k/m) = 1000 rad/s,
  // 3.1 ms, and a peak of 0.26 m/s sqrt(k m) = 130 N. A joint holds another ball.
  const char *const scene =
      R"(Gravity = 0, 0; Start = given
Mass ball: Mass = 0.5; Initial velocity = 0, -0.26, 0
Mass block: Mass = 2; Initial velocity = 0, 0.01, 0
Link buffer: Type = stop; To = ball; Direction = 0, 1; Stiffness = 5e5; Gap = 0.00325
Link rod: Type = joint; To = block; Direction = 0, 1; Stiffness = 1e5
Time: Scheme = generalised-alpha; Step = 1e-4; End = 0.0345
Probe ball: Point = ball
)";

  using Table = std::map<std::string, std::vector<double>>;

  Table read_binary(const std::string &path)
  {
    std::ifstream in(path, std::ios::binary);
    std::string line;
    std::getline(in, line);
    const std::vector<std::string> head = cells_of(line);
    Table table;
    double value;
    for (std::size_t i = 0; in.read(reinterpret_cast<char *>(&value), sizeof value); ++i)
      table[head[i % head.size()]].push_back(value);
    return table;
  }

  struct Step
  {
    double time, force, gap, probe;
  };

  std::vector<Step> run(Session &session)
  {
    std::vector<Step> steps;
    session.run(
        [&](const taut::StepView &view)
        {
          steps.push_back(
              {view.state.time, view.state.multiplier[0], view.state.distance[0], view.probes[0]});
        });
    return steps;
  }
} // namespace

// Claim: a buffer hit for 3 ms between two lines shows its peak, the depth and both changes.
TEST(Series, lines_at_intervals_show_a_hit_between_them)
{
  Session session(scene, {"Output.Link interval=0.01", "Output.Interval=0.01"});
  const std::vector<Step> steps = run(session);
  const Table links = read_table(session.folder() + "/links.csv"),
              probes = read_table(session.folder() + "/probes.csv");
  const std::vector<double> &time = links.at("time [s]");
  const std::vector<double> expected_times = {0., .01, .02, .03, .0345};
  ASSERT_EQ(time, expected_times) << "the last line covers the rest";
  for (const double force : links.at("buffer force [N]"))
    EXPECT_EQ(force, 0.) << "the hit has to be between two lines";
  double last = -1., peak = 0., n_changes = 0.;
  for (std::size_t k = 0; k < time.size(); ++k)
  {
    double least = INFINITY, largest = -INFINITY, least_gap = INFINITY, lowest = INFINITY;
    for (std::size_t i = 0; i < steps.size(); ++i)
      if (steps[i].time > last + 1e-9 && steps[i].time < time[k] + 1e-9)
      {
        least = std::min(least, steps[i].force);
        largest = std::max(largest, steps[i].force);
        least_gap = std::min(least_gap, steps[i].gap);
        lowest = std::min(lowest, steps[i].probe);
      }
    EXPECT_EQ(links.at("buffer force least [N]")[k], least);
    EXPECT_EQ(links.at("buffer force largest [N]")[k], largest);
    EXPECT_EQ(links.at("buffer gap least [m]")[k], least_gap);
    EXPECT_EQ(probes.at("ball least [m]")[k], lowest);
    EXPECT_GE(links.at("buffer gap largest [m]")[k], links.at("buffer gap [m]")[k]);
    peak = std::max(peak, links.at("buffer force largest [N]")[k]);
    n_changes += links.at("buffer changes [1]")[k];
    last = time[k];
  }
  EXPECT_NEAR(peak, 130., 1.3);
  EXPECT_EQ(n_changes, 2.) << "closed and opened";
  EXPECT_EQ(links.at("buffer changes [1]")[2], 2.);
  EXPECT_EQ(links.count("rod gap least [m]"), 0u) << "of unilateral links only";
  EXPECT_EQ(links.count("rod changes [1]"), 0u);
  figure("peak of a buffer hit for 3.1 ms, largest value in a line of 10 ms", peak, "N");
}

// Claim: a line a step needs no extremes. Expected: the head of the table, and the forces.
TEST(Series, a_line_each_step_has_no_more_columns)
{
  Session session(scene, {"Output.Link interval=0", "Output.Interval=0"});
  const std::vector<Step> steps = run(session);
  const std::string links = file_text(session.folder() + "/links.csv");
  EXPECT_EQ(links.substr(0, links.find('\n')),
            "time [s],buffer force [N],buffer gap [m],rod force [N],rod gap [m]");
  const Table table = read_table(session.folder() + "/links.csv");
  ASSERT_EQ(table.at("time [s]").size(), steps.size());
  for (std::size_t i = 0; i < steps.size(); ++i)
    EXPECT_EQ(table.at("buffer force [N]")[i], steps[i].force);
}

// Claim: binary tables have the numbers of those in text, which are written without loss, and times
// to all digits.
TEST(Series, binary_tables_have_the_same_numbers)
{
  for (const char *interval : {"0", "0.01"})
  {
    const Overrides settings = {std::string("Output.Link interval=") + interval,
                                std::string("Output.Interval=") + interval};
    Session text_session(scene, settings),
        binary_session(scene, settings + Overrides{"Output.Tables=binary"});
    text_session.run();
    binary_session.run();
    for (const std::string name : {"/links", "/probes", "/certificate"})
    {
      Table expected = read_table(text_session.folder() + name + ".csv"),
            found = read_binary(binary_session.folder() + name + ".bin");
      ASSERT_GT(expected.size(), 1u);
      const std::vector<double> time = expected.at("time [s]");
      ASSERT_EQ(found["time [s]"].size(), time.size());
      EXPECT_LE(largest_difference(time, found["time [s]"]), 1e-14);
      found["time [s]"] = time;
      EXPECT_EQ(found, expected) << name;
      EXPECT_EQ(file_text(binary_session.folder() + name + ".csv"), "") << "of one kind only";
    }
  }
}

// Claim: times are printed as they are meant. Expected: multiples of 0.001 with three decimals,
// where 9 * 0.001 is 0.009000000000000001.
TEST(Series, times_are_written_as_multiples_of_the_step)
{
  Session session(scene, {"Time.Step=1e-3", "Time.End=0.03", "Output.Interval=0",
                          "Output.Link interval=0", "Output.Observers=energy"});
  run(session);
  for (const char *name : {"links", "probes", "certificate", "energy"})
  {
    std::istringstream lines(file_text(session.folder() + "/" + name + ".csv"));
    std::string line;
    std::getline(lines, line);
    for (int n = 0; n <= 30; ++n)
    {
      ASSERT_TRUE(std::getline(lines, line)) << name;
      std::string expected = "0.0" + std::string(n < 10 ? "0" : "") + std::to_string(n);
      while (n > 0 && expected.back() == '0')
        expected.pop_back();
      EXPECT_EQ(cells_of(line)[0], n == 0 ? "0" : expected) << name;
    }
  }
}

// Claim: columns keep different names in programs that drop what is neither letter nor digit.
// Expected: the rule of numpy's genfromtxt(names=True), where 1.11 and 11.1 would be one.
TEST(Series, columns_have_names_that_numpy_can_tell_apart)
{
  Session session(scene_file("en50318_2002_250"),
                  {"Catenary.Number of spans=11", "Catenary.Span length=24", "Time.End=0.01",
                   "Catenary.Droppers.Positions=2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22",
                   "Catenary.Contact wire.Element size=4", "Catenary.Messenger wire.Element size=4",
                   "Catenary.Uplift positions=24.5, 245, 2.45",
                   "Statistics.Window=", "Output.Field interval=0"});
  session.run();
  for (const char *name : {"links", "probes", "supports", "sliding", "certificate", "start"})
  {
    std::istringstream lines(file_text(session.folder() + "/" + name + ".csv"));
    std::string head;
    std::getline(lines, head);
    std::map<std::string, std::string> known;
    EXPECT_EQ(head.find('"'), std::string::npos) << "numpy knows no quotes";
    for (const std::string &column : cells_of(head))
    {
      std::string plain;
      for (const char c : column)
        if (std::isalnum(static_cast<unsigned char>(c)))
          plain += c;
      const auto [other, is_new] = known.emplace(plain, column);
      EXPECT_TRUE(is_new) << other->second << " and " << column;
    }
    EXPECT_GE(known.size(), 4u) << name;
  }
}
