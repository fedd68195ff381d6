// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: --accuracy finds a setting with at most the error that it expects, for kinds of scenes
// that it was not made on, and says so where it finds none. Source: the same scenes in steps
// and elements half as long as the finest of the search.
#include "scene_tests.h"

#include "study/accuracy_search.h"

#include <taut/simulation/parameters.h>

using namespace verification;

namespace
{
  /// A mass that slides over a bump in the height of a wire.
  const std::string line_with_a_spike =
      "Gravity = 0, 0\n"
      "Wire wire: To = 40, 0; Components = string; Mass per length = 1; Tension = 1e4;\n"
      "  Element size = 2\n"
      "Support ends: Wire = wire; Positions = 0, 20, 40\n"
      "Mass m: Position = 5, 0; Mass = 5; Motions = y\n"
      "Spring k: From = ground; To = m; Stiffness = 500\n"
      "Link contact: Type = sliding contact; From = m; To = wire @ 5; Direction = 0, 1;\n"
      "  Stiffness = 5000; Speed = 20; Height profile = 2e-3*exp(-((s-17.03)/.05)^2)\n"
      "Load force: On = m; Magnitude = 60\nProbe p: Point = m\nTime: Step = 5e-3; End = 1\n"
      "Quantity largest: Of = p; Quantity = largest\n";

  const std::string rattling_mass =
      "Gravity = 0, 0; Start = given\n"
      "Mass m: Motions = y; Mass = 1\nSpring k: To = m; Stiffness = 100\n"
      "Load f: On = m; Magnitude = 20*sin(9*t)\n"
      "Link low: Type = stop; From = ground; To = m; Direction = 0, 1; Gap = 0.05; Stiffness = "
      "2e4\n"
      "Link high: Type = stop; From = m; To = ground; Direction = 0, 1; Gap = 0.05; Stiffness = "
      "2e4\n"
      "Probe p: Point = m\nTime: Step = 2e-3; End = 1\n";

  const std::string torsional_stop =
      "Gravity = 0, 0; Start = given\n"
      "Mass m: Motions = rotation; Mass = 1; Inertia = 0.5; Initial velocity = 0, 0, 2\n"
      "Spring k: To = m; Rotational = true; Stiffness = 5000\n"
      "Link s: Type = stop; From = ground; To = m; Rotational = true; Gap = 0.01; Stiffness = 2e5\n"
      "Probe p: Point = m; Rotational = true\nTime: Step = 5e-3; End = 0.3\n";

  /// A pulse between the steps, which sees the probe at rest.
  const std::string pulse_at_rest =
      "Gravity = 0, 0; Start = given\n"
      "Mass m: Mass = 1\nSpring k: To = m; Stiffness = 400; Damping = 1\n"
      "Load f: On = m; Magnitude = max(0,400*(1-abs(t-.5013)/5e-4))\n"
      "Probe p: Point = m\nTime: Step = 4e-3; End = 1\n";

  /// A mass that falls into a slack cable.
  const std::string cable_that_snaps =
      "Gravity = 0, -9.81; Start = given\n"
      "Body cable: Type = cable; From = 0, 0; To = 2, 0; Unstressed length = 3; Axial stiffness = "
      "2e4; Mass per length = 0.1; Axial damping = 2; Element = bar; Elements = 12; Held ends = "
      "from\n"
      "Mass m: Position = 2, 0; Motions = x, y; Mass = 3\n"
      "Link at the mass: Type = ball joint; From = m; To = cable @ 3, 0\n"
      "Probe p: Point = m; Direction = 0, 1\nTime: Step = 2e-3; End = 1\n";

  /// A soft block that falls on a floor.
  const std::string solid_that_hits =
      "Generator = network; Gravity = 0, -9.81; Start = given\n"
      "Body block: Type = solid; Young's modulus = 1e6; Poisson's ratio = 0.3; Density = 1000; "
      "Stiffness damping = 1e-4; Initial velocity = 0, -1\n"
      "Body block/Mesh: Generator = subdivided_hyper_rectangle; "
      "Arguments = 3, 3 : 0, 0.01 : 0.2, 0.21\n"
      "Contact floor: Slave = block: 2; Obstacle = plane; Point = 0, 0; Direction = 0, 1\n"
      "Probe p: Point = block @ 0.1, 0.21; Direction = 0, 1\nTime: Step = 1e-3; End = 0.1\n";

  /// A finer level than all @p values of an entry.
  std::string finer(const std::string &entry, const std::vector<std::string> &values)
  {
    std::vector<double> levels;
    for (const std::string &value : values)
      levels.push_back(std::stod(value));
    const double least = *std::min_element(levels.begin(), levels.end()),
                 largest = *std::max_element(levels.begin(), levels.end());
    return number(has(entry, "efinements")  ? largest + 1.
                  : has(entry, "/Elements") ? 2. * largest
                                            : least / 2.);
  }

  struct Promise
  {
    double expected = 0., error = 0.;
  };

  Promise promise_of(const std::string &scene, const double accuracy)
  {
    Folder folder;
    const std::string file =
        folder.write("scene.prm", SceneBuilder(scene + "Output: Field interval = 0\n").text());
    const Overrides own = {"Output/Folder=" + (folder / "results"), "Study/Budget=60"};
    std::ostringstream log;
    taut::AccuracySearch search(file, own, accuracy, true, log);
    const taut::StudySetting best = search.run();
    const taut::StudyResult result = search.result();
    for (const auto &file_of_results : fs::directory_iterator(folder / "results"))
      EXPECT_EQ(file_of_results.path().filename(), "study") << "its runs write no files";
    Promise promise{best.bound + best.reference_error};
    std::vector<std::string> finest;
    for (const auto &list : result.parameter_lists)
      for (const std::string &entry : list.entries)
        finest.push_back(entry + "=" + finer(entry, list.values));
    std::vector<double> exact;
    {
      double largest = 0., smallest = 0.;
      Session session(file, own + finest + Overrides{"Time/Check steps=no"});
      session.run(
          [&](const taut::StepView &view)
          {
            largest = std::max(largest, view.probes[0]);
            smallest = std::min(smallest, view.probes[0]);
          });
      exact = {largest, smallest};
    }
    for (std::size_t i = 0; i < best.quantities.size(); ++i)
    {
      const bool is_largest = has(result.quantity_names[i], "largest");
      raise(promise.error,
            (best.quantities[i] - exact[is_largest ? 0 : 1]) / result.references[i].scale);
    }
    return promise;
  }
} // namespace

TEST(AccuracyOfKinds, errors_are_at_most_those_expected)
{
  int n = 0, n_kept = 0;
  for (const auto &[name, scene] : {std::pair("line with a spike", line_with_a_spike),
                                    {"rattling mass", rattling_mass},
                                    {"torsional stop", torsional_stop},
                                    {"pulse at rest", pulse_at_rest},
                                    {"cable that snaps", cable_that_snaps},
                                    {"solid that hits", solid_that_hits}})
    for (const double accuracy : {.05, .01})
    {
      const Promise promise = promise_of(scene, accuracy);
      figure(std::string(name) + ", accuracy " + number(accuracy) + ", expected error",
             promise.expected);
      figure("the same, error", promise.error);
      EXPECT_LE(promise.expected, accuracy) << name;
      EXPECT_LE(promise.error, 2. * promise.expected) << name;
      ++n;
      n_kept += promise.error <= promise.expected;
    }
  EXPECT_GE(n_kept, .9 * n - 1.);
}
