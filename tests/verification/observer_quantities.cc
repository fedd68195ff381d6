// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: what an observer of a user measures is in statistics.json, in studies and in sweeps.
// Source: a load of 3 N for 0.2 s gives a mass of 2 kg a momentum of 0.6 N s and a speed of 0.3
// m/s.
#include "scene_tests.h"

#include "study/case_runner.h"
#include "study/sweep.h"
#include <taut/base/registry.h>

using namespace verification;

namespace
{
  /// Measures the speed of the first mass.
  class Speed : public taut::Observer
  {
  public:
    void record(const taut::StepView &step) override { speed = step.state.V[0][0]; }

    std::vector<taut::NamedQuantity> quantities() const override
    {
      return {{"load", "speed", speed, "m/s"}, {"load", "twice the speed", 2. * speed, "m/s"}};
    }

  private:
    double speed = 0.;
  };

  const taut::Register<taut::Observer, Speed> entry("speed", "speed of the first mass");

  const char *const scene = R"(Gravity = 0, 0; Start = undeformed
Mass load: Position = 0, 0; Mass = 2; Motions = y
Load push: Type = point; On = load; Magnitude = 3
Time: Step = 1e-2; End = 0.2
Output: Observers = speed
)";

} // namespace

TEST(ObserverQuantities, are_in_the_statistics)
{
  const nlohmann::json load = say(scene).json["observers"]["load"];
  EXPECT_NEAR(value(load, "speed"), .3, 1e-12);
  EXPECT_EQ(load["speed"]["unit"], "m/s");
  EXPECT_NEAR(value(load, "twice_the_speed"), .6, 1e-12);
}

TEST(ObserverQuantities, are_quantities_of_studies)
{
  Session session(scene, {});
  taut::Parameters parameters;
  const std::string file = session.write_scene();
  parameters.read(file, {"Study/Quantities=speed", "Study/Quantity speed/Of=load",
                         "Study/Quantity speed/Quantity=twice the speed"});
  parameters.write_nothing();
  const taut::MeasuredRun run = taut::measure_run(parameters, true, {});
  ASSERT_EQ(run.quantities.size(), 1u);
  EXPECT_NEAR(run.quantities[0].value, .6, 1e-12);

  parameters.read(file, {"Study/Quantities=speed", "Study/Quantity speed/Of=load",
                         "Study/Quantity speed/Quantity=history"});
  EXPECT_TRUE(has(error_of([&] { taut::check_quantities(parameters); }), "has no history"));
}

TEST(ObserverQuantities, are_columns_of_sweeps)
{
  Session session(scene, {});
  const std::string file = session.write_scene();
  std::ostringstream log;
  taut::Sweep sweep(file,
                    {"Sweep/Parameters=mass", "Sweep/Parameter mass/Entries=Network/Mass load/Mass",
                     "Sweep/Parameter mass/Values=1, 2", "Sweep/Folder=" + session.folder() + "/s"},
                    taut::Communicator(), log);
  sweep.run();
  std::ifstream table(session.folder() + "/s/sweep.csv");
  std::string header, first;
  std::getline(table, header);
  std::getline(table, first);
  EXPECT_TRUE(has(header, "load: speed [m/s],load: twice the speed [m/s]")) << header;
  double number = 0., mass = 0., speed = 0.;
  char comma = ' ';
  std::istringstream(first) >> number >> comma >> mass >> comma >> speed;
  EXPECT_EQ(mass, 1.);
  EXPECT_NEAR(speed, .6, 1e-12);
}
