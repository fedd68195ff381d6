// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: figures of lines are the same wherever a run says them. Source: one against the other,
// formulas of strings.
#include "scene_tests.h"

#include "output/signals.h"
#include "study/case_runner.h"
#include "study/study.h"
#include "study/sweep.h"
#include <taut/output/spans.h>

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

  std::vector<nlohmann::json> spans_of(const Said &said, const std::string &wire)
  {
    std::vector<nlohmann::json> spans;
    for (const auto &[name, span] : said.json.at("spans").items())
      if (span.at("wire") == wire)
        spans.push_back(span);
    return spans;
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

TEST(LineFigures, ratios_have_no_unit_in_the_log)
{
  const std::string log = log_of(line);
  EXPECT_TRUE(std::regex_search(log, std::regex(R"(Standard deviation over mean +\S+ *\n)")))
      << log;
}

TEST(LineFigures, columns_of_sweeps_are_the_statistics)
{
  Session session(line);
  session.run();
  const nlohmann::json said = session.statistics();
  const std::string file = session.write_scene();
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
    if (!cells[i].empty())
      swept[heads[i]] = std::stod(cells[i]);
  // Each column is "item: figure [unit]". Files have m in mm and shares in %.
  std::map<std::string, int> n_compared;
  double n_slackenings = 0., n_losses = 0.;
  for (const auto &[title, number] : swept)
  {
    std::smatch parts;
    if (std::isnan(number) || !std::regex_match(title, parts, std::regex(R"((.+): (.+) \[(.+)\])")))
      continue;
    std::string key = std::regex_replace(parts[2].str(), std::regex(" - "), " minus ");
    key = std::regex_replace(std::regex_replace(key, std::regex("\\+"), "plus"), std::regex(" "),
                             "_");
    for (const auto &[section, items] : said.items())
      if (items.is_object() && items.contains(parts[1].str()))
      {
        const nlohmann::json &item = items.at(parts[1].str()),
                             &figures = item.contains(key) ? item : item.value("filtered", item);
        if (!figures.contains(key))
          continue;
        const std::string unit = figures.at(key).at("unit");
        EXPECT_EQ(unit, parts[3].str()) << title;
        EXPECT_NEAR(number, value(figures.at(key)), 1e-12 * std::fabs(number)) << title;
        ++n_compared[section];
        n_slackenings += section == "links" && key == "slackenings" ? number : 0.;
        n_losses += key == "losses_over_20_ms" ? number : 0.;
      }
  }
  EXPECT_GT(n_slackenings, 0.);
  EXPECT_GT(n_losses, 0.);
  const std::map<std::string, int> expected = {{"line_constants", 6},
                                               {"links", 6 * 9},
                                               {"probes", 3},
                                               {"sliding_contacts", 8 + 4 + 6 + 1},
                                               {"spans", 2 * 2 + 2 * 4 + 2 * 2},
                                               {"supports", 4 * int(said.at("supports").size())}};
  EXPECT_EQ(n_compared, expected);
}

TEST(LineFigures, a_study_knows_the_sag_of_a_span)
{
  Session session(line, {"Time/End=0.01", "Statistics/Window="});
  session.run();
  std::ostringstream log;
  taut::Study study(session.write_scene(),
                    {"Output/Folder=" + session.folder() + "/study", "Study/Parameters=step",
                     "Study/Parameter step/Entries=Time/Step",
                     "Study/Parameter step/Values=2e-3, 1e-3", "Study/Parameter step/Refined=true",
                     "Study/Repeats=1", "Study/Reference levels=1", "Study/Quantities=sag",
                     "Study/Quantity sag/Of=messenger span 1", "Study/Quantity sag/Quantity=sag"},
                    true, log);
  const nlohmann::json said = session.statistics();
  const double sag = value(said.at("spans").at("messenger span 1").at("sag"));
  EXPECT_GT(sag, 1e-3);
  EXPECT_NEAR(study.run().settings.at(0).quantities.at(0), sag, 1e-9);
}

// Expected of a string between rigid supports: the moment of its loads as on a beam, over T,
// whatever the slope of the chord. The contact wire has no arms, so that it is lowest at the masts
// and nowhere below its chords.
TEST(LineFigures, sags_of_spans_are_those_of_strings)
{
  const Said said =
      say(line + "Pantograph pantograph: -\n"
                 "Catenary: Pantographs =; Number of spans = 3; Encumbrance = 1.2, 1.2, 1.4, 1.2\n"
                 "Time: End = 2e-3\nStatistics: Window =\n");
  const std::vector<nlohmann::json> contact = spans_of(said, "contact"),
                                    messenger = spans_of(said, "messenger");
  ASSERT_EQ(contact.size(), 3u);
  ASSERT_EQ(messenger.size(), 3u);
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_NEAR(value(messenger[i].at("from")), 40. * i, 1e-9);
    EXPECT_NEAR(value(messenger[i].at("to")), 40. * (i + 1), 1e-9);
  }
  // Droppers carry 15, 10 and 15 m of the contact wire: 20 g * 20 - 15 g * 10 in the middle.
  const double moment = .8 * g * 40. * 40. / 8. + 250. * g;
  EXPECT_NEAR(value(messenger[1].at("sag")), moment / 12000., 1e-9);
  EXPECT_NEAR(value(contact[1].at("sag")), 0., 1e-6);
}

namespace
{
  /// Unequal spans at unequal heights with given pre-sags, under whose second span a pantograph
  /// without a spring below it stands.
  const Overrides uneven = {
      "Catenary/Span lengths=40, 50, 45",
      "Catenary/Heights=5, 5, 5.2, 5.2",
      "Catenary/Begin=-20",
      "Catenary/Droppers/Positions=10, 20, 30; 10, 20, 30, 40; 15, 30",
      "Catenary/Droppers/Pre-sag=0.01, 0.02, 0.01; 0.02, 0.03, 0.03, 0.02; 0.01, 0.01",
      "Time/End=2e-3",
      "Statistics/Window="};
  const std::string under = line + "Pantograph pantograph: Start = 42\n",
                    alone = line + "Pantograph pantograph: -\nCatenary: Pantographs =\n";

  /// Places on that contact wire and heights of the lower ends of its droppers, and of its ends.
  /// The line rises over one span alone, where its cubic has no slope at both ends.
  std::vector<std::pair<double, double>> held_places()
  {
    std::vector<std::pair<double, double>> held = {{0., 5.}};
    const double x[] = {10., 20., 30., 50., 60., 70., 80., 105., 120.},
                 pre_sag[] = {.01, .02, .01, .02, .03, .03, .02, .01, .01};
    for (int i = 0; i < 9; ++i)
    {
      const double t = std::clamp((x[i] - 40.) / 50., 0., 1.);
      held.emplace_back(x[i], 5. + .2 * t * t * (3. - 2. * t) - pre_sag[i]);
    }
    held.emplace_back(135., 5.2);
    return held;
  }

  constexpr double contact_tension = 10000., contact_weight = 9.81;
} // namespace

// Expected of droppers: the heights that their lengths are for, and the force that a string of
// parabolas through these heights leaves to them; of start.csv that the pantograph carries some of
// it.
TEST(LineFigures, droppers_have_heights_and_forces_of_the_line_alone)
{
  Session session(under, uneven);
  session.run();
  const auto table = read_table(session.folder() + "/droppers.csv"),
             start = read_table(session.folder() + "/start.csv");
  const std::vector<std::pair<double, double>> held = held_places();
  ASSERT_EQ(table.at("x [m]").size(), held.size() - 2);
  double most_lifted = 0.;
  for (std::size_t i = 1; i + 1 < held.size(); ++i)
  {
    const auto &[x, y] = held[i];
    const double left = x - held[i - 1].first, right = held[i + 1].first - x,
                 force = contact_weight * (left + right) / 2. +
                         contact_tension *
                             ((y - held[i - 1].second) / left + (y - held[i + 1].second) / right);
    EXPECT_NEAR(table.at("x [m]")[i - 1], x - 20., 1e-9);
    EXPECT_NEAR(table.at("height of the lower end [m]")[i - 1], y, 1e-9) << x;
    EXPECT_NEAR(table.at("static force [N]")[i - 1], force, 1e-6) << x;
    most_lifted = std::max(most_lifted, force - start.at("force [N or N m]")[i - 1]);
  }
  EXPECT_GT(most_lifted, 10.);
}

// Expected: depths of the string of parabolas below the chords of its own heights at the masts.
TEST(LineFigures, sags_are_those_of_the_line_alone)
{
  const std::vector<std::pair<double, double>> held = held_places();
  const auto height = [&](const double x)
  {
    std::size_t i = 1;
    while (held[i].first < x)
      ++i;
    const double left = x - held[i - 1].first, right = held[i].first - x;
    return (held[i - 1].second * right + held[i].second * left) / (left + right) -
           contact_weight / (2. * contact_tension) * left * right;
  };
  const double masts[] = {0., 40., 90., 135.};
  for (const std::string &scene : {under, alone})
  {
    const Said said = say(scene, uneven);
    const std::vector<nlohmann::json> spans = spans_of(said, "contact");
    ASSERT_EQ(spans.size(), 3u);
    for (int i = 0; i < 3; ++i)
    {
      const double from = masts[i], to = masts[i + 1];
      double sag = 0.;
      for (double x = from; x <= to; x += .25)
        sag = std::max(sag, (height(from) * (to - x) + height(to) * (x - from)) / (to - from) -
                                height(x));
      EXPECT_NEAR(value(spans[i].at("sag")), sag, 1e-9) << i;
      EXPECT_GT(sag, 1e-3) << i;
    }
  }
}

// Expected: the low-passed force at the places of its own times, span by span.
TEST(LineFigures, figures_of_spans_are_those_of_the_filtered_force)
{
  const Said said = say(line + "Catenary: Span lengths = 36, 44; Begin = 3\n",
                        {"Statistics/Window=", "Output/Interval=0"});
  const std::vector<nlohmann::json> spans = spans_of(said, "contact");
  const std::vector<double> &place = said.sliding.at("pantograph position [m]"),
                            &raw = said.sliding.at("pantograph force [N]");
  const std::vector<double> force = taut::low_pass(raw, 2e-3, 20.);
  const double masts[] = {0., 36., 80.};
  ASSERT_EQ(spans.size(), 2u);
  for (int i = 0; i < 2; ++i)
  {
    double least = 1e9, largest = -1e9, largest_raw = 0.;
    for (std::size_t k = 0; k < force.size(); ++k)
      if (place[k] > masts[i] - 1e-9 && place[k] < masts[i + 1] - 1e-9)
      {
        least = std::min(least, force[k]);
        largest = std::max(largest, force[k]);
        largest_raw = std::max(largest_raw, raw[k]);
      }
    EXPECT_NEAR(value(spans[i].at("maximum_of_pantograph")), largest, 1e-6);
    EXPECT_NEAR(value(spans[i].at("minimum_of_pantograph")), least, 1e-6);
    EXPECT_GT(largest_raw, largest + 5.);
  }
}

// Two pantographs, of which the first one is in the window.
TEST(LineFigures, sums_of_contacts_are_those_of_the_table)
{
  const std::string two =
      line + "Catenary: Pantographs = pantograph, other\nPantograph other: Masses = 7, 15; "
             "Stiffnesses = 5000, 0; Dampings = 10, 20; Static force = 70; Start = 2; Speed = 180; "
             "Contact stiffness = 50000\nStatistics: Sums = both: pantograph + other; Filter "
             "frequency = 0\n";
  Session session(two, {"Output/Interval=0"});
  session.run();
  const nlohmann::json said = session.statistics();
  const auto sliding = read_table(session.folder() + "/sliding.csv");
  const auto column = [&](const std::string &name) { return sliding.at(name); };
  const std::vector<double> place = column("pantograph position [m]"),
                            first = column("pantograph force [N]"),
                            second = column("other force [N]");
  double n = 0., total = 0., squares = 0., least = 1e9, n_open = 0.;
  std::vector<double> history;
  for (std::size_t i = 0; i < place.size(); ++i)
  {
    const double force = first[i] + second[i];
    history.push_back(force);
    if (!(place[i] > 20. - 1e-9 && place[i] < 65. + 1e-9))
      continue;
    n += 1.;
    total += force;
    squares += force * force;
    least = std::min(least, force);
    n_open += force == 0.;
  }
  const nlohmann::json &both = said.at("sums").at("both");
  EXPECT_EQ(both.at("samples").get<double>(), n);
  EXPECT_NEAR(value(both.at("raw").at("mean")), total / n, 1e-8);
  EXPECT_NEAR(value(both.at("raw").at("standard_deviation")),
              std::sqrt(squares / n - total * total / n / n), 1e-6);
  EXPECT_NEAR(value(both.at("raw").at("minimum")), least, 1e-9);
  EXPECT_NEAR(value(both.at("contact_loss")), n_open / n, 1e-11);
  EXPECT_TRUE(has(session.log(), "Contact force of 'both', the sum of 'pantograph' + 'other', "
                                 "20.00 to 65.00 m"))
      << session.log();

  const std::string file = session.write_scene();
  taut::Parameters parameters;
  parameters.read(file, {"Study/Quantities=mean, motion", "Study/Quantity mean/Of=both",
                         "Study/Quantity mean/Quantity=mean", "Study/Quantity motion/Of=both",
                         "Study/Quantity motion/Quantity=history"});
  parameters.write_nothing();
  const taut::MeasuredRun run = taut::measure_run(parameters, true, {});
  ASSERT_EQ(run.quantities.size(), 2u);
  EXPECT_EQ(run.quantities[0].value, value(both.at("raw").at("mean")));
  ASSERT_EQ(run.quantities[1].history.size(), history.size());
  for (std::size_t i = 0; i < history.size(); ++i)
    EXPECT_NEAR(run.quantities[1].history[i], history[i], 1e-9);
}

// No largest displacement is negative: the range is left by each probe that it is for.
TEST(LineFigures, a_range_of_uplift_is_for_the_probes_that_it_names)
{
  const std::string probes = line + "Catenary: Uplift positions = 30, 40, 50\n"
                                    "Statistics/Expected ranges: Uplift = -2, -1\n";
  const std::string second = "contact wire at 40 m", third = "contact wire at 50 m";
  const auto judged = [](const Said &said)
  {
    std::vector<std::string> names;
    for (const auto &[name, probe] : said.json.at("probes").items())
      if (probe.at("largest").count("expected") > 0)
        names.push_back(name);
    return names;
  };
  const Said all = say(probes, {"Time/End=0.1", "Statistics/Window="}),
             some =
                 say(probes, {"Time/End=0.1", "Statistics/Window=",
                              "Statistics/Expected ranges/Uplift probes=" + third + ", " + second});
  EXPECT_EQ(judged(all).size(), 3u);
  EXPECT_EQ(judged(some), (std::vector<std::string>{second, third}));
  EXPECT_TRUE(has(all.log, "0 quantities inside, 3 outside")) << all.log;
  EXPECT_TRUE(has(some.log, "0 quantities inside, 2 outside")) << some.log;
}

// Expected of strings whose droppers keep the contact wire on its chords: at a mast the shear of
// the loads of both spans as on beams, and T times the slopes of both chords. In a span between
// arms droppers carry 15, 10 and 15 m of the contact wire, in a span to an end 10, 10 and 15 m.
TEST(LineFigures, reactions_at_rest_are_those_of_strings)
{
  const Said said =
      say(line + "Pantograph pantograph: -\n"
                 "Catenary: Pantographs =; Number of spans = 3; Encumbrance = 1.2, 1.4, 1.4, 1.2\n"
                 "Time: End = 2e-3\nStatistics: Window =\n");
  const double messenger_end = .8 * 20. * g + 16.25 * g - 12000. * .2 / 40.,
               messenger_mast = .8 * 40. * g + (18.75 + 20.) * g + 12000. * .2 / 40.;
  int n = 0;
  for (const auto &[name, support] : said.json.at("supports").items())
  {
    if (support.at("wire") != "messenger")
      continue;
    const double place = value(support.at("position"));
    const bool is_end = place < 1. || place > 119.;
    for (const char *const figure :
         {"reaction_at_the_start", "smallest_reaction", "largest_reaction", "mean_reaction"})
    {
      EXPECT_NEAR(value(support.at(figure)), is_end ? messenger_end : messenger_mast, 1e-6)
          << name << ' ' << figure;
      EXPECT_EQ(support.at(figure).at("unit"), "N") << name;
    }
    ++n;
  }
  EXPECT_EQ(n, 4);
}

TEST(LineFigures, reactions_are_those_of_the_table)
{
  Session session(line, {"Output/Interval=0", "Output/Link interval=0"});
  session.run();
  const nlohmann::json said = session.statistics();
  const auto supports = read_table(session.folder() + "/supports.csv"),
             sliding = read_table(session.folder() + "/sliding.csv");
  const std::vector<double> &place = sliding.at("pantograph position [m]");
  EXPECT_EQ(said.at("supports").size(), supports.size() - 1);
  for (const auto &[name, support] : said.at("supports").items())
  {
    const std::vector<double> &force = supports.at(name + " force [N]");
    ASSERT_EQ(force.size(), place.size());
    double n = 0., sum = 0., least = 1e9, largest = -1e9;
    for (std::size_t i = 0; i < force.size(); ++i)
      if (place[i] > 20. - 1e-9 && place[i] < 65. + 1e-9)
      {
        n += 1.;
        sum += force[i];
        least = std::min(least, force[i]);
        largest = std::max(largest, force[i]);
      }
    ASSERT_GT(n, 0.);
    EXPECT_LT(n, place.size());
    EXPECT_NEAR(value(support.at("reaction_at_the_start")), force.at(0), 1e-9) << name;
    EXPECT_NEAR(value(support.at("mean_reaction")), sum / n, 1e-8) << name;
    EXPECT_NEAR(value(support.at("smallest_reaction")), least, 1e-9) << name;
    EXPECT_NEAR(value(support.at("largest_reaction")), largest, 1e-9) << name;
  }
}

// Of a study: the same number, and the column of the table as a history.
TEST(LineFigures, reactions_are_quantities_of_studies)
{
  Session session(line, {"Output/Link interval=0"});
  session.run();
  const nlohmann::json said = session.statistics();
  const std::string name = "messenger at masts", file = session.write_scene();
  taut::Parameters parameters;
  parameters.read(file,
                  {"Study/Quantities=mean, motion", "Study/Quantity mean/Of=" + name,
                   "Study/Quantity mean/Quantity=mean reaction", "Study/Quantity motion/Of=" + name,
                   "Study/Quantity motion/Quantity=history"});
  parameters.write_nothing();
  const taut::MeasuredRun run = taut::measure_run(parameters, true, {});
  ASSERT_EQ(run.quantities.size(), 2u);
  EXPECT_EQ(run.quantities[0].value, value(said.at("supports").at(name).at("mean_reaction")));
  const std::vector<double> column =
      read_table(session.folder() + "/supports.csv").at(name + " force [N]");
  ASSERT_EQ(run.quantities[1].history.size(), column.size());
  for (std::size_t i = 0; i < column.size(); ++i)
    EXPECT_NEAR(run.quantities[1].history[i], column[i], 1e-9);
}

// A sample at a mast belongs to the span after it; the window cuts the span.
TEST(LineFigures, forces_of_a_span_are_those_of_its_samples)
{
  taut::ContactRecord record;
  record.position = {0., 1., 2., 3., 4., 5., 6.};
  record.force = {7., 10., 20., 60., 30., 5., 9.};
  record.mean_force = {7., 10., 20., 50., 30., 5., 9.};
  taut::StatisticsParameters parameters;
  const taut::SpanForce f = taut::SpanForce::of({"", 1., 5.}, record, parameters);
  EXPECT_EQ(f.n_samples, 4u);
  EXPECT_NEAR(f.moments.mean, 30., 1e-12);
  EXPECT_NEAR(f.moments.deviation, std::sqrt((400. + 100. + 900.) / 4.), 1e-12);
  EXPECT_EQ(f.moments.minimum, 10.);
  EXPECT_EQ(f.moments.maximum, 50.);
  parameters.window = {2., 3.};
  EXPECT_EQ(taut::SpanForce::of({"", 1., 5.}, record, parameters).n_samples, 2u);
  EXPECT_EQ(taut::SpanForce::of({"", 5., 6.}, record, parameters).n_samples, 0u);
}

TEST(LineFigures, forces_of_spans_are_those_of_the_table)
{
  const Said said =
      say(line, {"Statistics/Filter frequency=0", "Statistics/Window=", "Output/Interval=0"});
  const std::vector<nlohmann::json> spans = spans_of(said, "contact");
  ASSERT_EQ(spans.size(), 2u);
  double n_slackenings = 0.;
  for (const auto &[name, link] : said.json.at("links").items())
    n_slackenings += value(link.at("slackenings"));
  EXPECT_EQ(value(spans[0].at("slackenings")) + value(spans[1].at("slackenings")), n_slackenings);
  EXPECT_GT(n_slackenings, 0.);
  const std::vector<double> *place = nullptr, *force = nullptr;
  for (const auto &[title, column] : said.sliding)
  {
    if (has(title, "position"))
      place = &column;
    if (has(title, "force"))
      force = &column;
  }
  ASSERT_TRUE(place && force);
  for (int i = 0; i < 2; ++i)
  {
    double n = 0., sum = 0., squares = 0., least = 1e9;
    for (std::size_t k = 0; k < force->size(); ++k)
      if ((*place)[k] > 40. * i - 1e-9 && (*place)[k] < 40. * (i + 1) - 1e-9)
      {
        n += 1.;
        sum += (*force)[k];
        squares += (*force)[k] * (*force)[k];
        least = std::min(least, (*force)[k]);
      }
    EXPECT_NEAR(value(spans[i].at("mean_of_pantograph")), sum / n, 1e-8);
    EXPECT_NEAR(value(spans[i].at("standard_deviation_of_pantograph")),
                std::sqrt(squares / n - sum * sum / n / n), 1e-6);
    EXPECT_NEAR(value(spans[i].at("minimum_of_pantograph")), least, 1e-9);
  }
}
