// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: --accuracy finds settings whose expected errors bound the true ones (oscillator, bar on a
// wall), stores them for Study/Accuracy, and says so where it has no estimate.
#include "study/in_folder.h"

#include "study/accuracy_search.h"
#include "study/quantity_recorder.h"
#include "study/refinements.h"
#include <taut/simulation/parameters.h>

namespace
{
  namespace fs = std::filesystem;
  using studies::expect_fragments;
  using studies::Texts;
  using verification::error_of;
  using verification::has;
  using verification::number;

  const std::string with_end = "Quantity end: Of = place; Quantity = last; Scale = 1\n";

  class AccuracyTest : public studies::InFolder
  {
  protected:
    AccuracyTest() { write(studies::oscillator + with_end); }

    /// All settings of a search; best is the one that it chose.
    taut::StudyResult search(const double accuracy, Texts overrides = {},
                             const std::string &file = "scene.prm")
    {
      log.str("");
      overrides.insert(overrides.begin(), {"Output/Folder=results", "Study/Budget=60"});
      taut::AccuracySearch search(file, overrides, accuracy, true, log);
      best = search.run();
      return search.result();
    }
    std::string error(const double accuracy, const Texts &overrides)
    {
      fs::remove_all("results");
      const std::string message = error_of([&]() { search(accuracy, overrides); });
      EXPECT_FALSE(fs::exists("results/study/study.json")) << "a setting without an estimate";
      return message;
    }

    taut::StudySetting best;
  };

  /// The true errors of all settings against their expected errors. @p exact has the scale 1.
  void expect_bounds(const taut::StudyResult &result, const std::size_t quantity,
                     const double exact)
  {
    const taut::QuantityReference &reference = result.references[quantity];
    EXPECT_LE(std::fabs(reference.quantity.value - exact), reference.error);
    for (const taut::StudySetting &setting : result.settings)
      if (setting.message.empty())
      {
        EXPECT_LE(std::fabs(setting.quantities[quantity] - exact) / reference.scale,
                  setting.bounds[quantity] + reference.error / reference.scale)
            << setting.values[0];
      }
  }
} // namespace

// Exact: cos(13), for schemes of second and first order.
TEST_F(AccuracyTest, expected_errors_bound_the_true_ones)
{
  for (const char *scheme : {"Newmark", "BDF2", "Moreau-Jean", "automatic"})
    for (const double accuracy : {.05, .01, .001})
    {
      SCOPED_TRACE(scheme + std::to_string(accuracy));
      const taut::StudyResult result =
          search(accuracy, {std::string("Time/Scheme=") + scheme, "Time/Step=0.02"});
      expect_bounds(result, 0, std::cos(13.));
      EXPECT_LE(std::fabs(best.quantities[0] - std::cos(13.)), accuracy);
      EXPECT_LE(best.bound + best.reference_error, accuracy);
      EXPECT_GT(best.bound + best.reference_error, accuracy / 300.) << "far too fine";
    }
}

// Two refinements. Exact: impulse 200 N s, contact for 2/3 s.
TEST_F(AccuracyTest, finds_step_and_mesh_of_a_bar_on_a_wall)
{
  const taut::StudyResult result = search(.01, {}, TAUT_PRM_FOLDER "/bar_on_wall.prm");
  expect_bounds(result, 1, 200.);
  expect_bounds(result, 2, 2. / 3.);
  EXPECT_LE(std::fabs(best.quantities[1] / 200. - 1.), .01);
  for (const taut::StudySetting &coarse : result.settings)
    for (const taut::StudySetting &fine : result.settings)
      if (std::stod(fine.values[0]) <= std::stod(coarse.values[0]) &&
          std::stod(fine.values[1]) <= std::stod(coarse.values[1]))
      {
        EXPECT_GE(fine.cost(), coarse.seconds[0]) << "a run that was disturbed decides";
      }
  ASSERT_EQ(result.parameter_lists.size(), 2u);
  EXPECT_EQ(result.parameter_lists[1].entries, Texts{"Network/Wire bar/Element size"});
  EXPECT_TRUE(has(log.str(), "step = " + best.values[0] + ", mesh = " + best.values[1]))
      << log.str();
  for (const char *part : {"expected error", "times that of the setting", "x real time"})
    EXPECT_TRUE(has(log.str(), part)) << log.str();
}

TEST_F(AccuracyTest, a_run_takes_what_was_stored)
{
  search(.01);
  const auto step = [](const std::string &accuracy, const Texts &others = {})
  {
    Texts overrides = {"Study/Accuracy=" + accuracy};
    overrides.insert(overrides.end(), others.begin(), others.end());
    taut::Parameters parameters;
    parameters.read("scene.prm", overrides);
    return parameters.step;
  };
  EXPECT_EQ(step("0.01"), std::stod(best.values[0]));
  EXPECT_GE(step("0.5"), step("0.01"));
  expect_fragments(error_of([&]() { step("1e-9"); }), {"the best setting", "less accuracy"});
  expect_fragments(error_of([&]() { step("0.01", {"Network/Mass block/Mass=3"}); }),
                   {"another scene", "Mass is '3' here"});
}

// A mass that hits a stop with a damper: the steps of its contact do not hang on Time/Step, and are
// refined with it. Exact: it leaves when k x + c v = 0, at e = exp(-zeta w t_c) of its speed.
TEST_F(AccuracyTest, steps_of_a_contact_with_a_damper_are_refined)
{
  constexpr double m = .836, k = 1990., c = 36.7, v = 5.21, gap = .964, end = 1.4846946;
  write("Gravity = 0, 0; Start = given\n"
        "Mass m: Motions = y; Mass = " +
        number(m) + "; Initial velocity = 0, -" + number(v) +
        ", 0\n"
        "Link floor: Type = stop; From = ground; To = m; Direction = 0, 1; Gap = " +
        number(gap) + "; Stiffness = " + number(k) + "; Damping = " + number(c) +
        "\nProbe place: Point = m; Direction = 0, 1\n"
        "Quantity largest: Of = place; Quantity = largest\n"
        "Time: Step = 7.4e-3; End = " +
        number(end));
  const double w = std::sqrt(k / m), zeta = .5 * c / std::sqrt(k * m),
               damped = std::sqrt(1. - zeta * zeta),
               t_c = (M_PI - std::atan2(2. * zeta * damped, 1. - 2. * zeta * zeta)) / (w * damped),
               out = v * std::exp(-zeta * w * t_c),
               exact = -gap - c * out / k + out * (end - gap / v - t_c);
  for (const double accuracy : {.05, .002})
  {
    search(accuracy, {"Time/Scheme=automatic"});
    const double error = std::fabs(best.quantities[0] / exact - 1.);
    EXPECT_LE(error, best.bound + best.reference_error) << log.str();
    EXPECT_LE(error, accuracy) << log.str();
  }
}

// The first swing is right where the phase is lost after twenty of them: the check of steps of the
// run says 40 %, and the search must not say less of the whole.
TEST_F(AccuracyTest, agrees_with_the_check_of_steps_of_its_run)
{
  const std::string line = "  the motion as a whole is less accurate than these quantities: ";
  write(studies::oscillator + "Time: End = 13\nQuantity swing: Of = place; Quantity = smallest\n");
  search(.01);
  EXPECT_TRUE(has(log.str(), line + "the step is too long: the place of 'block' is off by "))
      << log.str();
  write(studies::oscillator + "Time: End = 13\nQuantity all: Of = place; Quantity = history\n");
  search(.01);
  EXPECT_FALSE(has(log.str(), line)) << log.str();
}

// Newmark keeps the amplitude of an oscillation that no step resolves, BDF2 does not.
TEST_F(AccuracyTest, a_second_scheme_must_agree)
{
  const Texts stiff = {"Network/Spring spring/Stiffness=2e5",
                       "Study/Quantity end/Quantity=smallest"};
  const taut::StudyResult result = search(.1, stiff);
  EXPECT_GT(result.settings.size(), 3u) << "the first three settings agree with each other";
  EXPECT_LT(std::stod(best.values[0]), .08);
  EXPECT_TRUE(has(log.str(), "checked by BDF2")) << log.str();
}

TEST_F(AccuracyTest, says_so_without_an_estimate)
{
  expect_fragments(error(.01, {"Study/Budget=0"}),
                   {"no setting is known to have an error of at most 0.01", "Study/Budget of 0 s",
                    "ask for less accuracy"});
  expect_fragments(error(1e-9, {}), {"sixteen times as fine", "'end' is the least certain"});
  expect_fragments(error(.1, {"Time/Scheme=Newmark", "Time/Newmark/Beta=0",
                              "Network/Spring spring/Stiffness=2e7"}),
                   {"no setting is known", "a run failed"});
}

TEST_F(AccuracyTest, mistakes_are_named)
{
  for (const double accuracy : {0., 1., -1., std::nan("")})
    expect_fragments(error(accuracy, {}), {"between 0 and 1"});
  expect_fragments(error(.1, {"Time/End=0"}), {"Time/End", "later end"});
  expect_fragments(error(.1, {"Time/Step control=adaptive"}), {"Time/Step control", "'fixed'"});
  expect_fragments(error(.1, {"Study/Quantity end/Of=plaec"}), {"did you mean 'place'"});
  expect_fragments(
      error(.1, {"Study/Quantity end/Scale=0", "Network/Mass block/Initial displacement=0, 0, 0"}),
      {"Quantity end/Scale", "give a scale"});
  const std::string fixed = error(.1, {"Output/Probe place/Direction=1, 0"});
  expect_fragments(fixed, {"cannot move along it"});
  EXPECT_FALSE(has(fixed, "no setting")) << fixed;
  search(.1);
  const std::string twice =
      error_of([&]() { taut::AccuracySearch("scene.prm", {}, .1, false, log).run(); });
  expect_fragments(twice, {"Study/Folder", "--overwrite"});
  write(studies::oscillator.substr(0, studies::oscillator.find("Probe")));
  expect_fragments(error(.1, {}), {"Study/Quantities", "name quantities of interest"});
}

TEST(DefaultQuantities, follow_the_kind_of_scene)
{
  const auto names = [](const std::vector<taut::NamedQuantity> &known)
  { return taut::default_quantities(known)[0]; };
  const taut::NamedQuantity mean{"p", "mean", 1., "N"}, maximum{"p", "maximum", 2., "N"},
      weak{"a", "largest force", 1., "N"}, strong{"b", "largest force", 2., "N"},
      impulse{"b", "impulse", 3., "N s"}, largest{"q", "largest", 1., "m"},
      smallest{"q", "smallest", -4., "m"}, nothing{"r", "largest", 0., "m"};
  EXPECT_EQ(names({mean, maximum, weak, strong, largest, smallest}),
            "Study/Quantities=p mean, q largest");
  EXPECT_EQ(names({weak, strong, largest, smallest, nothing}),
            "Study/Quantities=q largest, q smallest");
  EXPECT_EQ(names({weak, strong, impulse, nothing}), "Study/Quantities=b largest force, b impulse");
  EXPECT_EQ(taut::default_quantities({largest, smallest})[3], "Study/Quantity q largest/Scale=4");
}

TEST(Dials, halve_sizes_double_counts_and_add_refinements)
{
  const std::vector<taut::Refinement> refinements =
      taut::find_refinements({{"Time/Step", "0.01"},
                              {"Network/Wire a/Element size", "0.5"},
                              {"Network/Wire b/Element size", "0.5"},
                              {"Body c/Elements", "48"},
                              {"Body s/Mesh/Refinements", "2"},
                              {"Body c/Element", "bar"}});
  ASSERT_EQ(refinements.size(), 2u);
  EXPECT_EQ(refinements[0].values(0), Texts{"0.08"});
  EXPECT_EQ(refinements[1].n_coarser, 2) << "two refinements can be taken back";
  ASSERT_EQ(refinements[1].groups.size(), 3u);
  EXPECT_EQ(refinements[1].values(0), (Texts{"12", "0", "2"}));
  EXPECT_EQ(refinements[1].values(3), (Texts{"96", "3", "0.25"}));
  EXPECT_EQ(refinements[1].groups[2].entries.size(), 2u);
  EXPECT_EQ(taut::find_refinements({{"Time/Step", "1"}}).size(), 1u);
  for (const std::string damping : {"0", "5"})
    EXPECT_EQ(taut::find_refinements({{"Time/Step", "1"},
                                      {"Time/Step in damped contacts", "1"},
                                      {"Network/Link s/Type", "stop"},
                                      {"Network/Link s/Damping", damping}})[0]
                  .values(4),
              damping == "0" ? Texts{"0.5"} : (Texts{"0.5", "0.125"}));
  EXPECT_EQ(taut::find_refinements({{"Time/Step", "1"}, {"Body c/Elements", "50"}})[1].n_coarser,
            1);
}
