// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: a study measures errors that are the real ones (free oscillator, u = cos(w t)), its
// refined reference is as far from the exact value as it says, a setting that fails is a row, and
// Accuracy takes the cheapest setting of a study of the same scene and of no other.
#include "study/in_folder.h"

#include "study/study.h"
#include "study/sweep.h"
#include <taut/simulation/simulation.h>

#include <nlohmann/json.hpp>

namespace
{
  namespace fs = std::filesystem;
  using studies::expect_fragments;
  using studies::Texts;
  using verification::error_of;
  using verification::has;

  // w = 10 1/s; at t = 1.3 s the mass is at cos(13) m.
  const std::string &bare_oscillator = studies::oscillator;
  const std::string parameters_of_the_study = R"(Study: Repeats = 1; Reference levels = 5
Parameter step: Entries = Time/Step; Values = 0.02, 0.01, 0.005, 0.0025; Refined = true
Parameter scheme: Entries = Time/Scheme; Values = Newmark, backward Euler; Reference = Newmark
)";
  const std::string oscillator = bare_oscillator + parameters_of_the_study +
                                 R"(Quantity end: Of = place; Quantity = last
Quantity motion: Of = place; Quantity = history
)";

  class StudyTest : public studies::InFolder
  {
  protected:
    StudyTest() { write(oscillator); }

    taut::StudyResult study(const Texts &overrides = {}, const bool overwrite = false)
    {
      log.str("");
      return taut::Study("scene.prm", overrides, overwrite, log).run();
    }
  };

  taut::StudyQuantity number(const double value)
  {
    taut::StudyQuantity quantity;
    quantity.value = value;
    return quantity;
  }
} // namespace

// a + b h^p at h = 1, 1/2, 1/4: Richardson's value is a.
TEST(Extrapolation, finds_the_limit_and_order_of_a_power)
{
  for (const double p : {1., 1.5, 2.})
  {
    std::vector<taut::StudyQuantity> levels;
    for (int k = 0; k < 3; ++k)
      levels.push_back(number(3. + .1 * std::exp2(-p * k)));
    const taut::QuantityReference reference = taut::extrapolate(levels);
    EXPECT_NEAR(reference.quantity.value, 3., 1e-13);
    EXPECT_NEAR(reference.order, p, 1e-10);
    EXPECT_GE(reference.error, std::fabs(levels[2].value - reference.quantity.value));
  }
}

// A high order from errors that cancel is not believed, changes that do not fall even less.
TEST(Extrapolation, doubts_what_does_not_converge_regularly)
{
  const taut::QuantityReference fast = taut::extrapolate({number(1.), number(1.1), number(1.1001)});
  EXPECT_GE(fast.error, .025);
  const taut::QuantityReference erratic =
      taut::extrapolate({number(1.), number(1.1), number(1.05)});
  EXPECT_EQ(erratic.order, 0.);
  EXPECT_NEAR(erratic.error, .1, 1e-12);
  EXPECT_TRUE(std::isinf(taut::extrapolate({number(1.)}).error));
  EXPECT_NEAR(taut::extrapolate({number(1.), number(1.5)}).error, .5, 1e-15);
}

// u = t on a coarse grid against u = t + 0.25 on a finer one: 0.25 everywhere.
TEST(Distance, compares_histories_at_their_own_times)
{
  taut::StudyQuantity coarse, fine;
  for (int i = 0; i <= 4; ++i)
  {
    coarse.time.push_back(.3 * i);
    coarse.history.push_back(.3 * i);
  }
  for (int i = 0; i <= 12; ++i)
  {
    fine.time.push_back(.1 * i);
    fine.history.push_back(.1 * i + .25);
  }
  EXPECT_NEAR(taut::distance(coarse, fine), .25, 1e-14);
  EXPECT_NEAR(taut::distance(fine, coarse), .25, 1e-14);
}

// Exact: cos(13). The stated error of the reference contains it.
TEST_F(StudyTest, reference_is_as_far_from_the_exact_value_as_it_says)
{
  const taut::StudyResult result = study();
  const taut::QuantityReference &end = result.references[0], &motion = result.references[1];
  EXPECT_LE(std::fabs(end.quantity.value - std::cos(13.)), end.error);
  EXPECT_LT(end.error, 1e-3);
  EXPECT_NEAR(end.order, 2., .6);
  EXPECT_NEAR(motion.order, 2., .05);
  double sum = 0.;
  for (std::size_t i = 0; i < motion.quantity.time.size(); ++i)
    sum += std::pow(motion.quantity.history[i] - std::cos(10. * motion.quantity.time[i]), 2);
  const double rms = std::sqrt(sum / motion.quantity.time.size());
  EXPECT_NEAR(rms, motion.error, .05 * rms) << "the error of a history is estimated, not bounded";
}

// Exact values instead of a reference: the errors of the rows fall with the order of the scheme,
// 2 (Newmark) and 1 (backward Euler), and are those of a run outside of the study.
TEST_F(StudyTest, errors_are_the_real_ones)
{
  const taut::StudyResult result =
      study({"Study/Quantity end/Exact=cos(13)", "Study/Quantity motion/Exact=cos(10*t)",
             "Study/Quantity end/Scale=1", "Study/Quantity motion/Scale=1"});
  ASSERT_EQ(result.settings.size(), 8u);
  struct Last : taut::Observer
  {
    void record(const taut::StepView &step) override { u = step.probes[0]; }
    double u = 0.;
  } alone;
  taut::Parameters parameters;
  parameters.read("scene.prm", {"Time/Step=0.005", "Output/Folder=alone"});
  taut::Simulation simulation(parameters, log);
  simulation.observe(alone);
  simulation.run();
  const auto error = [&](const std::string &step, const std::string &scheme)
  {
    for (const taut::StudySetting &setting : result.settings)
      if (setting.values == Texts{step, scheme})
        return setting.errors;
    return std::vector<double>();
  };
  EXPECT_NEAR(std::log2(error("0.005", "Newmark")[1] / error("0.0025", "Newmark")[1]), 2., .05);
  EXPECT_NEAR(std::log2(error("0.005", "backward Euler")[1] / error("0.0025", "backward Euler")[1]),
              1., .25);
  EXPECT_EQ(error("0.005", "Newmark")[0], std::fabs(alone.u - std::cos(13.)));
  for (const taut::StudySetting &setting : result.settings)
  {
    EXPECT_EQ(setting.error, std::max(setting.errors[0], setting.errors[1]));
    EXPECT_EQ(setting.reference_error, 0.);
    EXPECT_EQ(setting.n_steps, std::lround(1.3 / std::stod(setting.values[0])));
    EXPECT_GT(setting.least_seconds(), 0.);
    EXPECT_GT(setting.seconds_with_output, 0.);
  }
}

TEST_F(StudyTest, a_setting_that_fails_is_a_row_with_its_reason)
{
  const taut::StudyResult result = study(
      {"Study/Parameter step/Values=2, 0.01", "Study/Parameter scheme/Values=Newmark, Euler"});
  int n_failed = 0;
  for (const taut::StudySetting &setting : result.settings)
  {
    EXPECT_EQ(setting.message.empty(), setting.values == Texts({"0.01", "Newmark"}));
    n_failed += !setting.message.empty();
    if (setting.values == Texts({"2", "Newmark"}))
      expect_fragments(setting.message, {"Time/End", "shorter than one step"});
    if (setting.values == Texts({"0.01", "Euler"}))
      expect_fragments(setting.message, {"Time/Scheme = 'Euler' is not allowed"});
  }
  EXPECT_EQ(n_failed, 3);
  const std::string text = verification::file_text("results/study/work_precision.csv");
  EXPECT_TRUE(has(text, "shorter than one step"));
}

TEST_F(StudyTest, failures_are_one_line_for_each_reason_with_the_line_of_the_file)
{
  write(oscillator + "Parameter step: Values = 2, 3, 0.01\n"
                     "Parameter scheme: Values = Newmark, Euler\n");
  const taut::StudyResult result = study();
  const std::string said = log.str();
  std::ifstream file("scene.prm");
  int n_lines = 0, line_of_schemes = 0;
  for (std::string line; std::getline(file, line);)
  {
    ++n_lines;
    if (has(line, "Newmark, Euler"))
      line_of_schemes = n_lines;
  }
  EXPECT_TRUE(has(said, "5 settings failed; the reasons are in work_precision.csv\n")) << said;
  EXPECT_TRUE(has(said, "  3 settings: scene.prm:" + std::to_string(line_of_schemes) +
                            ": Time/Scheme = 'Euler' is not allowed"))
      << said;
  EXPECT_TRUE(has(said, "  2 settings: scene.prm:")) << said;
  EXPECT_EQ(said.find("shorter than one step"), said.rfind("shorter than one step")) << said;
  EXPECT_FALSE(has(said, "--set")) << said;
  for (const taut::StudySetting &setting : result.settings)
    EXPECT_FALSE(has(setting.message, "--set")) << setting.message;
}

// Values of one entry with the same fault are one reason.
TEST_F(StudyTest, reasons_are_the_same_whatever_the_value)
{
  write(bare_oscillator + R"(Study: Repeats = 1; Reference levels = 1
Parameter law: Entries = Network/Spring spring/Stiffness; Values = 200, none, nothing
Quantity end: Of = place; Quantity = last
)");
  study();
  EXPECT_TRUE(has(log.str(), "  2 settings: scene.prm:")) << log.str();
  EXPECT_TRUE(has(log.str(), "Network/Spring spring/Stiffness = 'none' is not allowed"))
      << log.str();
}

namespace
{
  /// Head and first two lines.
  std::array<std::string, 3> table_of_a_sweep()
  {
    std::istringstream table(verification::file_text("results/sweep/sweep.csv"));
    std::array<std::string, 3> lines;
    for (std::string &line : lines)
      std::getline(table, line);
    return lines;
  }
} // namespace

// One line for each case, whose heads have the units of the help and whose messages have the line
// of the values.
TEST_F(StudyTest, a_sweep_has_units_in_its_heads_and_lines_of_the_file_in_its_messages)
{
  write(bare_oscillator +
        R"(Sweep: Parameters = mass, k, scheme, both; Combination = zipped
Sweep/Parameter mass: Entries = Network/Mass block/Mass; Values = 2, 3
Sweep/Parameter k: Entries = Network/Spring spring/Stiffness; Values = 200, 300
Sweep/Parameter scheme: Entries = Time/Scheme; Values = Newmark, Euler
Sweep/Parameter both: Entries = Time/Step, Network/Mass block/Inertia; Values = 0.01, 0.02
)");
  taut::Sweep("scene.prm", {}, taut::Communicator(), log).run();
  const auto [head, first, second] = table_of_a_sweep();
  EXPECT_EQ(head.rfind("case,mass [kg],\"k [N/m, N m/rad]\",scheme,both,", 0), 0u) << head;
  EXPECT_EQ(first.rfind("1,2,200,Newmark,0.01,", 0), 0u) << first;
  EXPECT_TRUE(has(second, "scene.prm:")) << second;
  EXPECT_FALSE(has(second, "--set")) << second;
}

// A pulse that is shorter than the longer one of the steps.
TEST_F(StudyTest, a_sweep_says_which_cases_warn)
{
  write(bare_oscillator + "Load pulse: On = block; Magnitude = 500*exp(-((t-0.505)/1e-3)^2)\n"
                          "Sweep: Parameters = step\n"
                          "Sweep/Parameter step: Entries = Time/Step; Values = 0.01, 1e-4\n");
  taut::Sweep("scene.prm", {}, taut::Communicator(), log).run();
  const auto [head, first, second] = table_of_a_sweep();
  const auto ends = [](const std::string &line, const std::string &tail)
  { return line.size() > tail.size() && line.substr(line.size() - tail.size()) == tail; };
  EXPECT_TRUE(ends(head, ",balance [1],warnings,message")) << head;
  EXPECT_TRUE(ends(first, ",feature,")) << first;
  EXPECT_TRUE(ends(second, ",,")) << second;
}

TEST_F(StudyTest, a_step_that_does_not_divide_the_run_is_measured_to_its_last_step)
{
  const taut::StudyResult odd =
      study({"Study/Parameter step/Values=0.017, 0.0005", "Study/Parameter scheme/Values=Newmark"});
  EXPECT_EQ(odd.settings[0].n_steps, 76);
  EXPECT_GT(odd.settings[0].least_seconds(), .002 * odd.settings[1].least_seconds());
}

TEST(Front, holds_what_nothing_beats)
{
  std::vector<taut::StudySetting> settings(5);
  const double errors[] = {.1, .2, .01, .01, .001};
  for (int i = 0; i < 5; ++i)
  {
    settings[i].seconds = {i + 2., i + 1.};
    settings[i].error = settings[i].bound = errors[i];
  }
  settings[4].message = "failed";
  taut::find_front(settings);
  for (int i = 0; i < 5; ++i)
    EXPECT_EQ(settings[i].is_on_front, i == 0 || i == 2) << i;
  EXPECT_EQ(taut::cheapest(settings, .05), &settings[2]);
  EXPECT_EQ(taut::cheapest(settings, .2), &settings[0]);
  EXPECT_EQ(taut::cheapest(settings, .001), nullptr);
  settings[2].reference_error = .045;
  EXPECT_EQ(taut::cheapest(settings, .05), &settings[3]) << "the reference's error counts";
  settings[1].coarser_seconds = 1.;
  settings[1].seconds = {.5};
  EXPECT_EQ(taut::cheapest(settings, .2), &settings[1]) << "of one cost, the coarsest";
}

// Cancellation at (4, 4), and a scheme that fails at the finest step: by hand.
TEST(Bounds, hold_for_all_finer_settings)
{
  const std::vector<taut::ParameterList> parameter_lists = {
      {"step", {}, {}, "", true}, {"mesh", {}, {}, "", true}, {"scheme", {}, {}, "", false}};
  std::vector<taut::StudySetting> settings(5);
  const Texts values[] = {
      {"4", "4", "a"}, {"2", "4", "a"}, {"4", "2", "a"}, {"2", "2", "a"}, {"2", "2", "b"}};
  const double errors[] = {.001, .1, .2, .01, .5};
  for (int i = 0; i < 5; ++i)
  {
    settings[i].values = values[i];
    settings[i].errors = {errors[i], 2. * errors[i]};
  }
  taut::find_bounds(parameter_lists, settings);
  const double expected[] = {.2, .1, .2, .01, .5};
  for (int i = 0; i < 5; ++i)
  {
    EXPECT_EQ(settings[i].bounds[0], expected[i]) << i;
    EXPECT_EQ(settings[i].bound, 2. * expected[i]) << i;
  }
  settings[2].message = "failed";
  taut::find_bounds(parameter_lists, settings);
  EXPECT_EQ(settings[0].bounds[0], .1);
}

TEST_F(StudyTest, accuracy_takes_the_cheapest_setting_that_has_it)
{
  study({"Study/Parameter step/Values=0.05, 0.005, 0.00005", "Study/Quantity end/Exact=cos(13)",
         "Study/Quantity motion/Exact=cos(10*t)"});
  taut::Parameters parameters;
  parameters.read("scene.prm", {"Study/Accuracy=0.02"});
  EXPECT_EQ(parameters.step, .005);
  EXPECT_EQ(parameters.scheme, "Newmark");
  expect_fragments(parameters.accuracy_choice(), {"step = 0.005", "scheme = Newmark", "error"});
  parameters.read("scene.prm", {"Study/Accuracy=1e-6"});
  EXPECT_EQ(parameters.step, .00005);

  // What used.prm says runs alike, without the study.
  std::ostringstream used, said;
  parameters.print(used);
  std::ofstream("again.prm") << used.str();
  fs::rename("results/study", "elsewhere");
  taut::Parameters again;
  again.read("again.prm");
  EXPECT_EQ(again.step, .00005);
  EXPECT_EQ(again.accuracy_choice(), "");

  again.read("scene.prm", {"Study/Accuracy=0.02", "Study/Folder=elsewhere"});
  taut::Simulation(again, said).check();
  EXPECT_TRUE(has(said.str(), again.accuracy_choice()));
}

TEST_F(StudyTest, accuracy_refuses_a_study_of_another_scene)
{
  const auto read = [&](Texts overrides, const std::string &accuracy = "0.1")
  {
    overrides.push_back("Study/Accuracy=" + accuracy);
    return error_of([&]() { taut::Parameters().read("scene.prm", overrides); });
  };
  expect_fragments(
      read({}), {"Study/Accuracy", "there is no study 'results/study/study.json'", "taut --study"});
  study();
  EXPECT_EQ(read({}), "");
  EXPECT_EQ(read({"Network/Spring spring/Stiffness=2e2", "Gravity=0.0,0"}), "") << "same numbers";
  EXPECT_EQ(read({"Time/Step=0.5", "Output/Interval=0.1", "Study/Repeats=7"}), "")
      << "varied by the study, or of no effect on it";
  expect_fragments(read({"Network/Spring spring/Stiffness=201"}),
                   {"another scene", "Network/Spring spring/Stiffness is '201' here and '200'"});
  expect_fragments(read({"Gravity=0, 0, 0"}), {"Gravity"});
  expect_fragments(read({"Network/Masses=block, two", "Network/Mass two/Mass=1"}),
                   {"Network/Mass two/Inertia is '0' here and missing in the study", "more"});
  expect_fragments(read({"Output/Probe place/Direction=1, 1"}), {"Output/Probe place/Direction"});
  expect_fragments(read({}, "1e-9"), {"the best setting", "has an error of", "less accuracy"});

  std::ofstream("results/study/study.json") << "{\"parameter_lists\": [";
  expect_fragments(read({}), {"is damaged"});
  std::ofstream("results/study/study.json") << "{\"parameter_lists\": [{\"entries\": 3}]}";
  expect_fragments(read({}), {"not a study of this version"});
}

TEST_F(StudyTest, mistakes_are_named_before_anything_runs)
{
  const std::vector<std::pair<Texts, Texts>> cases = {
      {{"Study/Quantity end/Of=palce"}, {"Quantity end/Of = 'palce'", "did you mean 'place'"}},
      {{"Study/Quantity end/Quantity=lost"}, {"Quantity end/Quantity = 'lost'", "mean 'last'"}},
      {{"Time/End=0"}, {"Time/End", "later end"}},
      {{"Study/Parameter step/Values=1:2"},
       {"Parameter step/Values", "'1:2' is no positive number"}},
      {{"Study/Quantity end/Exact=cos("}, {"Quantity end/Exact"}},
      {{"Study/Quantity end/Exact=0"}, {"Quantity end/Scale", "reference is 0"}},
  };
  for (const auto &[overrides, fragments] : cases)
  {
    SCOPED_TRACE(overrides[0]);
    expect_fragments(error_of([&, o = overrides]() { study(o); }), fragments);
    EXPECT_FALSE(fs::exists("results/study/study.json"));
  }
  write(bare_oscillator);
  expect_fragments(error_of([&]() { study(); }), {"Study/Parameters", "one or more lists"});
  write(bare_oscillator + parameters_of_the_study);
  expect_fragments(error_of([&]() { study(); }), {"Study/Quantities", "one or more quantities"});
  write(oscillator);
  study();
  expect_fragments(error_of([&]() { study(); }), {"Study/Folder", "--overwrite"});
  EXPECT_EQ(error_of([&]() { study({}, true); }), "");
}
