// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: a program with a System gets tables, statistics, fields and checkpoints of adaptive steps
// by adding observers, and goes on from a checkpoint with the same bits. Source: free fall.
#include "cable/slack_cable.h"
#include "common.h"
#include "fuzz/library_bodies.h"

#include <taut/output/fields.h>
#include <taut/output/series.h>
#include <taut/output/statistics.h>
#include <taut/simulation/checkpoints.h>
#include <taut/simulation/observed_run.h>

namespace
{
  constexpr double end = .4, height = .2;

  std::map<std::string, std::string> files_in(const std::string &folder)
  {
    std::map<std::string, std::string> files;
    for (const auto &entry : std::filesystem::recursive_directory_iterator(folder))
      if (entry.is_regular_file())
        files[std::filesystem::relative(entry.path(), folder)] =
            verification::file_text(entry.path());
    return files;
  }

  struct Result
  {
    taut::State state;
    double impulse, uplift;
    std::string log;
  };

  /// A mass that falls on a stop beside a cable, until @p until or the end.
  Result run(const std::string &folder, const double until, const bool goes_on)
  {
    taut::System system;
    const auto mass = system.add("mass", [] { return library::chain_of("mass", {2.}, {0.}); });
    system.add("cable", [] { return std::make_unique<taut::Cable>(verification::slack_cable()); });
    const taut::Displacement up = system.displacement(mass, {}, {0., 1., 0.});
    system.add(taut::Constraint::unilateral("stop", up).gap(height));
    taut::StepperOptions options;
    options.start = taut::Start::undeformed;
    options.steps.control = "adaptive";
    taut::Stepper stepper(system, options);
    std::ostringstream log;
    taut::Checkpoints checkpoints(folder, .05, log);
    if (goes_on)
      checkpoints.find();
    taut::ObservedRun run(stepper, folder, .01);
    run.add_probe("mass", up);
    taut::Statistics statistics({}, run.scene(), run.constraints());
    taut::Series tables(run.scene(), run.constraints());
    taut::Fields fields(folder, run.scene(), run.structure(), .1, 1);
    const auto energy = taut::Registry<taut::Observer>::instance().create("energy");
    for (taut::Observer *observer :
         std::initializer_list<taut::Observer *>{&statistics, &tables, &fields, energy.get()})
      run.observe(*observer);
    run.observe(checkpoints);
    run.begin();
    while (run.time() < until)
      run.advance();
    if (until < end) // as if it was killed: nothing is finished
      return {stepper.state(), 0., 0., log.str()};
    run.finish();
    run.report(log);
    double impulse = 0.;
    for (const auto &quantity : statistics.named_quantities())
      if (quantity.item == "stop" && quantity.quantity == "impulse")
        impulse = quantity.value;
    return {stepper.state(), impulse, statistics.largest_displacement(0), log.str()};
  }
} // namespace

TEST(ObservedRun, goes_on_from_a_checkpoint_with_the_same_bits)
{
  const verification::Folder folder;
  const Result whole = run(folder / "whole", end, false);
  run(folder / "parts", .23, false);
  const Result parts = run(folder / "parts", end, true);
  EXPECT_NE(parts.log.find("Resumed after t = 0.2"), std::string::npos) << parts.log;
  EXPECT_NE(parts.log.find(" steps in "), std::string::npos) << parts.log;
  EXPECT_EQ(whole.state.U, parts.state.U);
  EXPECT_EQ(whole.state.V, parts.state.V);
  EXPECT_EQ(whole.impulse, parts.impulse);
  // The impact takes the momentum, and the mass lies until the end.
  const double fall = std::sqrt(2. * height / library::gravity);
  const double exact =
      2. * library::gravity * fall + 2. * library::gravity * (whole.state.time - fall);
  EXPECT_NEAR(whole.impulse, exact, 1e-2 * exact);
  EXPECT_EQ(whole.uplift, 0.);
  const auto files = files_in(folder / "whole"), others = files_in(folder / "parts");
  for (const char *name : {"links.csv", "probes.csv", "certificate.csv", "energy.csv",
                           "fields/body_cable.pvd", "fields/body_cable_00000.vtu", "checkpoint"})
    EXPECT_EQ(files.count(name), 1u) << name;
  for (const auto &[name, content] : files)
  {
    ASSERT_EQ(others.count(name), 1u) << name;
    EXPECT_TRUE(content == others.at(name)) << name;
  }
  EXPECT_EQ(files.size(), others.size());
}
