// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: the scene of a generator that is written out as a network gives the same run, to the last
// bit of all tables and statistics. Source: the run of the generator itself.
#include "scene_tests.h"

#include "scene/network_entries.h"
#include "simulation/network_file.h"

using namespace verification;

namespace
{
  /// The network of a scene, in a file.
  struct Written
  {
    Written(const std::string &file, const Overrides &overrides)
    {
      taut::Parameters parameters;
      parameters.read(file, overrides);
      taut::write_network(parameters, name, left_out);
    }

    const Folder folder;
    const std::string name = folder / "network.prm";
    std::vector<std::string> left_out;
  };

  /// All tables of a run by their names, but for those that it read; statistics without the names
  /// of scene and generator.
  std::map<std::string, std::string> results_of(const std::string &file, const Overrides &overrides)
  {
    Session session(file, Overrides{"Output.Interval=0", "Output.Link interval=0.01"} + overrides);
    session.run();
    std::map<std::string, std::string> results;
    for (const fs::directory_entry &entry : fs::directory_iterator(session.folder()))
      if (entry.path().extension() == ".csv" &&
          !fs::exists(fs::path(file).parent_path() / entry.path().filename()))
        results[entry.path().filename().string()] = file_text(entry.path().string());
    const std::string path = session.folder() + "/statistics.json";
    if (!fs::exists(path)) // without time
      return results;
    auto statistics = nlohmann::json::parse(file_text(path));
    statistics.erase("scene");
    statistics.erase("generator");
    results["statistics.json"] = statistics.dump(1);
    return results;
  }

  void expect_same_run(const std::string &scene, const Overrides &overrides,
                       const std::size_t n_tables)
  {
    const Written written(scene_file(scene), overrides);
    const auto expected = results_of(scene_file(scene), overrides),
               found = results_of(written.name, {});
    EXPECT_GE(expected.size(), n_tables);
    for (const auto &[name, text] : expected)
    {
      ASSERT_EQ(found.count(name), 1u) << name;
      // Not both texts: they are long.
      EXPECT_TRUE(found.at(name) == text) << scene << ": " << name << " differs";
    }
    EXPECT_EQ(found.size(), expected.size());
  }

  /// Overrides of the whole scene in the file that is written, too.
  const Overrides short_run = {"Time.End=0.05", "Statistics.Window="};
} // namespace

TEST(WrittenNetwork, line_of_the_standard_runs_bit_by_bit)
{
  expect_same_run("en50318_2002_250", short_run, 5);
}

TEST(WrittenNetwork, line_in_space_with_found_directions_and_wind_runs_bit_by_bit)
{
  expect_same_run("en50318_in_space", short_run, 5);
}

TEST(WrittenNetwork, line_at_rest_has_the_same_lengths_bit_by_bit)
{
  expect_same_run("line_55m", {}, 1);
}

TEST(WrittenNetwork, overlap_with_stitch_wires_and_strips_runs_bit_by_bit)
{
  expect_same_run("real_line", {"Time.End=0.02", "Statistics.Window="}, 5);
}

TEST(WrittenNetwork, droppers_of_given_lengths_run_bit_by_bit)
{
  for (const Overrides &more : {Overrides(), Overrides{"Catenary.Contact wire.Stagger=0.2",
                                                       "Catenary.Messenger wire.Wind=1",
                                                       "Catenary.Droppers.Axial stiffness=1e5",
                                                       "Catenary.Droppers.Mass per length=0.14"}})
    expect_same_run("en50318_2002_250",
                    Overrides{"Catenary.Number of spans=3",
                              "Catenary.Uplift positions=", "Catenary.Droppers.Pre-sag=",
                              "Catenary.Droppers.Lengths=0.98, 0.81, 0.65, 0.55, 0.52, 0.55, "
                              "0.65, 0.81, 0.98",
                              "Catenary.Pantograph pantograph.Start=65"} +
                        more + short_run,
                    5);
}

TEST(WrittenNetwork, bump_stops_with_laws_run_bit_by_bit)
{
  expect_same_run(
      "en50318_2002_250",
      Overrides{"Catenary.Pantograph pantograph.Bump stop gaps=0.01, 0",
                "Catenary.Pantograph pantograph.Bump stop laws=0.001: 0.1, 0.003: 77.7"} +
          short_run,
      5);
}

TEST(WrittenNetwork, speeds_in_time_and_mid_points_run_bit_by_bit)
{
  expect_same_run("en50318_2002_250",
                  Overrides{"Catenary.Pantograph pantograph.Speed=250 - 60*t^2/(1 + t)",
                            "Catenary.Pantograph pantograph.Lift=0.003, 0.001",
                            "Catenary.Pantograph pantograph.Base motion=0.001*sin(s)",
                            "Catenary.Mid-points=0, 0, 0, 0, 0, 16, 0, 0, 0, 0, 0",
                            "Catenary.Mid-point ropes.Pull=700",
                            "Catenary.Mid-point ropes.Axial stiffness=1e6"} +
                      short_run,
                  5);
}

TEST(WrittenNetwork, arms_that_are_rigid_bodies_run_bit_by_bit)
{
  expect_same_run("en50318_in_space",
                  Overrides{"Catenary.Supports.Arm kind=rigid body",
                            "Catenary.Supports.Arm reach=1.1", "Time.Scheme=Moreau-Jean"} +
                      short_run,
                  5);
}

TEST(WrittenNetwork, laws_by_formula_run_bit_by_bit)
{
  expect_same_run("oscillator_with_stop",
                  {"Network.Link stop.Stiffness=rigid", "Network.Link stop.Law=formula",
                   "Network.Link stop.Law formula=1e4*d+1e9*d^3",
                   "Network.Link stop.Law range=0.0123456789"},
                  1);
}

TEST(WrittenNetwork, parameters_of_studies_that_vary_the_generator_are_left_out)
{
  const Written written(scene_file("en50318_2002_250"), {});
  EXPECT_EQ(written.left_out, std::vector<std::string>{"Study/Parameter mesh"});
  const std::string text = file_text(written.name);
  EXPECT_TRUE(has(text, "set Parameters = scheme, step\n"));
  EXPECT_FALSE(has(text, "Catenary"));
}

TEST(WrittenNetwork, what_is_written_again_is_the_same_and_no_file_is_replaced)
{
  const Written written(scene_file("line_55m"), {});
  taut::Parameters parameters;
  parameters.read(written.name);
  const taut::Scene scene = parameters.generated_scene();
  EXPECT_EQ(scene.links.size(), 90u);
  EXPECT_EQ(scene.links[0].name, "dropper 1.1");
  std::vector<std::string> left_out;
  EXPECT_TRUE(has(error_of([&] { taut::write_network(parameters, written.name, left_out); }),
                  "already; name another file, or add --overwrite"));
}

TEST(NamesWithDots, are_found_in_sections_with_dots_or_slashes_between_them)
{
  const std::string scene = R"(Wire a.1: From = 0, 0; To = 10, 0; Components = string
  ; Mass per length = 1; Tension = 1000
Support ends: Wire = a.1; Positions = 0, 10
Load push 1.02: On = a.1 @ 5; Magnitude = 1
Time: End = 0
)";
  for (const std::string entry :
       {"Network/Load push 1.02/Magnitude", "Network.Load push 1.02.Magnitude"})
  {
    Session session(scene, {entry + "=7"});
    EXPECT_EQ(session.simulation().scene().loads.at(0).magnitude(0., 0.), 7.) << entry;
  }
}

TEST(FoundLengths, of_a_network_leave_out_loads_that_do_not_act_while_it_is_built)
{
  const auto length = [](const std::string &acts)
  {
    Session session(R"(Gravity = 0, -9.81
Wire upper: From = 0, 1; To = 10, 1; Components = string; Mass per length = 1; Tension = 1000
Wire lower: From = 0, 0; To = 10, 0; Components = string; Mass per length = 1; Tension = 2000
Support upper: Wire = upper; Positions = 0, 10
Support lower: Wire = lower; Positions = 0, 10
Link hanger: Type = dropper; From = upper @ 5; To = lower @ 5; Direction = 0, -1; Find length = true
Load push: On = upper @ 5; Magnitude = -100; Acts while built = )" +
                    acts + "\nTime: End = 0\n");
    return session.simulation().scene().links.at(0).length;
  };
  // The lower wire stays level at the hanger, which then carries 10 m g/2; T/L gives the sag of the
  // upper wire under its own weight, this force and the load.
  const double force = 9.81 * 5., own = 9.81 * 100. / (8. * 1000.);
  EXPECT_NEAR(length("false"), 1. - own - force * 10. / 4000., 1e-10);
  EXPECT_NEAR(length("true"), 1. - own - (force + 100.) * 10. / 4000., 1e-10);
}

TEST(Length, of_a_dropper_that_does_not_turn_gives_its_gap)
{
  Session session(
      R"(Wire upper: From = 0, 1.2; To = 10, 1.2; Components = string; Mass per length = 1; Tension = 1000
Wire lower: From = 0, 0; To = 10, 0; Components = string; Mass per length = 1; Tension = 2000
Support upper: Wire = upper; Positions = 0, 10
Support lower: Wire = lower; Positions = 0, 10
Link hanger: Type = dropper; From = upper @ 5; To = lower @ 5; Direction = 0, -1; Length = 1.3
Time: End = 0
)");
  const taut::Link &hanger = session.simulation().scene().links.at(0);
  EXPECT_EQ(hanger.gap, 1.3 - 1.2);
  EXPECT_EQ(hanger.length, 1.3);
}

TEST(Probes, of_a_network_come_before_those_of_the_output)
{
  Session session(
      R"(Wire line: From = 0, 0; To = 10, 0; Components = string; Mass per length = 1; Tension = 1000
Support ends: Wire = line; Positions = 0, 10
Network: Probes = uplift at 5.5 m
Network/Probe uplift at 5.5 m: Point = line @ 5.5
Probe middle: Point = line @ 5
Time: End = 0
)");
  const std::vector<taut::Probe> &probes = session.simulation().scene().probes;
  ASSERT_EQ(probes.size(), 2u);
  EXPECT_EQ(probes[0].name, "uplift at 5.5 m");
  EXPECT_EQ(probes[0].point.position, 5.5);
  EXPECT_EQ(probes[1].name, "middle");
}
