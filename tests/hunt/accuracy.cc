// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: --accuracy finds a setting whose error is what it expects at most, for scenes at random,
// or says that it finds none. Source: motions between events by the exponential of the matrices.
#include "event_driven.h"
#include "reference.h"
#include "scene_text.h"

#include "study/accuracy_search.h"
#include "verification/run.h"

namespace
{
  constexpr double accuracy = .05;
  constexpr int n_times = 40000; ///< at which the reference is looked at

  /// Part of an extreme that lies between them, at an impact.
  constexpr double sampling = 10. / n_times;

  /// Largest and smallest place of the first mass [m].
  struct Extremes
  {
    double largest = 0., smallest = 0.;
  };

  /// Nothing where the reference does not know itself.
  std::optional<Extremes> exact(const hunt::HuntScene &scene, const double end)
  {
    hunt::Recorder recorder(scene.frequency);
    verification::Session session(scene.text,
                                  {"Time/Check steps=no", "Time/Step=" + hunt::number(end / 10),
                                   "Time/End=" + hunt::number(end)});
    session.run(std::ref(recorder));
    std::vector<double> times;
    for (int k = 0; k <= n_times; ++k)
      times.push_back(end * k / n_times);
    Extremes found[2];
    try
    {
      for (int k = 0; k < 2; ++k)
        for (const hunt::Sample &sample : hunt::event_driven_history(
                 *recorder.model, scene.restitution, scene.reach, times, 1. + k, k * 1e-9))
        {
          found[k].largest = std::max(found[k].largest, sample.place[0]);
          found[k].smallest = std::min(found[k].smallest, sample.place[0]);
        }
    }
    catch (const hunt::NoReference &)
    {
      return {};
    }
    const double size = found[0].largest - found[0].smallest;
    if (std::fabs(found[0].largest - found[1].largest) > 1e-3 * size ||
        std::fabs(found[0].smallest - found[1].smallest) > 1e-3 * size)
      return {};
    return found[0];
  }
} // namespace

TEST(HuntOfAccuracy, errors_are_at_most_those_expected)
{
  const char *const given = std::getenv("TAUT_HUNT_ACCURACY"), *const seeds =
                                                                   std::getenv("TAUT_HUNT_SEED");
  const int n_scenes = given ? std::atoi(given) : 15;
  const unsigned long seed = seeds ? std::strtoul(seeds, nullptr, 10) : 1;
  int n_promised = 0, n_kept = 0, n_nearly = 0, n_wrong = 0, n_refused = 0, n_undecided = 0;
  double largest = 0.;
  for (std::size_t number = 0, n = 0; n < std::size_t(n_scenes); ++number)
  {
    const hunt::HuntScene scene = hunt::make_scene(seed, number);
    if (!verification::has("smooth masses, elastic stop, rigid stop, damped stop, several links",
                           scene.family))
      continue;
    ++n;
    const double end = scene.step * scene.n_steps;
    const std::optional<Extremes> right = exact(scene, end);
    if (!right)
    {
      ++n_undecided;
      continue;
    }
    const bool is_up = right->largest > -right->smallest;
    verification::Folder folder;
    const std::string file = folder.write("scene.prm", scene.text);
    std::ostringstream log;
    double error = 0., expected = 0.;
    const std::string refused = verification::error_of(
        [&]
        {
          taut::AccuracySearch search(
              file,
              {"Output/Folder=" + (folder / "results"), "Study/Budget=60",
               "Time/Step=" + hunt::number(end / 200), "Time/End=" + hunt::number(end),
               "Network/Probes=p", "Network/Probe p/Point=m0", "Network/Probe p/Direction=0, 1",
               "Study/Quantities=extreme", "Study/Quantity extreme/Of=p",
               std::string("Study/Quantity extreme/Quantity=") + (is_up ? "largest" : "smallest")},
              accuracy, true, log);
          const taut::StudySetting best = search.run();
          const taut::StudyResult result = search.result();
          expected = best.bound + best.reference_error + sampling;
          verification::raise(error,
                              (best.quantities[0] - (is_up ? right->largest : right->smallest)) /
                                  result.references[0].scale);
        });
    if (!refused.empty())
      ++n_refused;
    else
    {
      ++(error <= expected ? n_kept : error <= 2. * expected ? n_nearly : n_wrong);
      n_promised += error <= accuracy;
      verification::raise(largest, error);
    }
    if (std::getenv("TAUT_HUNT_VERBOSE"))
      std::printf("%4zu %-16s error %9.2e expected %9.2e %s\n", number, scene.family.c_str(), error,
                  expected, refused.c_str());
    if (error > 2. * expected)
      std::printf("scene %zu: error %g, expected %g\n%s", number, error, expected,
                  scene.text.c_str());
  }
  const int n_found = n_kept + n_nearly + n_wrong;
  std::printf("promised %g: kept %d of %d, largest error %g\n", accuracy, n_promised, n_found,
              largest);
  std::printf("at most expected %d, at most twice %d, wrong %d, refused %d, undecided %d\n", n_kept,
              n_nearly, n_wrong, n_refused, n_undecided);
  EXPECT_GE(n_promised, .9 * n_found);
  EXPECT_LE(largest, 2. * accuracy);
  EXPECT_GE(n_kept, .9 * n_found - 1.);
  EXPECT_LE(n_wrong, .02 * n_found);
  EXPECT_GE(n_found, .6 * (n_scenes - n_undecided));
}
