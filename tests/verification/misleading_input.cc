// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: input that is allowed but hardly meant gets a warning, messages begin with their reason
// and are short, and a folder has the results of one run at a time.
#include "scene_tests.h"

#include "scene/network_entries.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

using namespace verification;

namespace
{
  const std::string line = R"(Gravity = 0, -9.81
Start = undeformed
Wire line: From = 0, 0; To = 10, 0; Components = string; Mass per length = 1; Tension = 1000
Time: Step = 0.01; End = 0.02
)";
} // namespace

TEST(UnheldWire, with_tension_has_a_warning)
{
  const std::string log = log_of(line);
  EXPECT_TRUE(has(log, "Warning: wire 'line' has a tension of 1000 N and neither a support"))
      << log;
  EXPECT_TRUE(has(log, "support at 0, 10 m"));
}

TEST(UnheldWire, that_something_holds_has_none)
{
  for (const std::string holds :
       {"Support ends: Wire = line; Positions = 0, 10\n", "Wire line: Foundation stiffness = 10\n",
        "Link hook: Type = dropper; From = ground; To = line @ 5; Direction = 0, -1\n"})
    EXPECT_FALSE(has(log_of(line + holds), "neither a support")) << holds;
}

TEST(StartOfWires, that_hang_too_deep_has_warnings_in_the_log_and_of_the_check)
{
  // A parabola of sag f = m g L^2/(8 T) has the slope 4 f/L at its ends, less half an element.
  const auto log = [](const double tension)
  {
    Session session(
        "Gravity = 0, -9.81\nWire line: From = 0, 0; To = 10, 0; Components = string; "
        "Mass per length = 1; Element size = 0.1; Tension = " +
        number(tension) +
        "\nSupport ends: Wire = line; Positions = 0, 10\nTime: Step = 0.01; End = 0.01\n");
    session.simulation().check();
    return session.log();
  };
  const double slope_of_1 = 9.81 * 10. / 2. * (1. - .01), sag_of_1 = 9.81 * 100. / 8.;
  for (const double part : {.99, 1.01})
  {
    EXPECT_EQ(has(log(slope_of_1 / (part * .2)), "Warning: wire 'line' has a slope of "), part > 1.)
        << part;
    EXPECT_EQ(has(log(sag_of_1 / (part * 1.)), "m below the line between two supports"), part > 1.)
        << part;
  }
  EXPECT_TRUE(has(log(sag_of_1 / 2.), "hangs 2 m below")) << log(sag_of_1 / 2.);
}

TEST(FasterThanWaves, is_allowed_where_an_entry_says_so_and_written_out)
{
  const std::string scene = line +
                            "Support ends: Wire = line; Positions = 0, 10\nLoad push: Type = "
                            "moving; On = line @ 1; Magnitude = 1; Speed = ";
  EXPECT_TRUE(has(error_of([&] { Session(scene + "31.7\n"); }), "speed of the waves"));
  EXPECT_EQ(error_of([&] { Session(scene + "31.6\n"); }), "");
  const auto of_time = [&](const char *const end)
  { return error_of([&] { Session(scene + "20 + 20 * t\nTime: End = " + end + "\n"); }); };
  EXPECT_TRUE(has(of_time("0.6"), "32 m/s = 115.2 km/h are not less")) << of_time("0.6");
  EXPECT_EQ(of_time("0.3"), "");
  Session allowed(scene + "40; Faster than waves = true\n");
  const auto entries = taut::network_entries(allowed.simulation().scene());
  EXPECT_TRUE(std::any_of(entries.begin(), entries.end(),
                          [](const taut::WrittenEntry &entry) {
                            return entry.path.back() == "Faster than waves" &&
                                   entry.value == "true";
                          }));
}

TEST(UpliftPositions, take_ranges)
{
  Session session(scene_file("en50318_2002_250"), {"Catenary/Uplift positions=240:60:360, 400.5",
                                                   "Time/End=0", "Statistics/Window="});
  std::vector<double> found;
  for (const taut::Probe &probe : session.simulation().scene().probes)
    found.push_back(probe.point.position);
  EXPECT_EQ(found, (std::vector<double>{240., 300., 360., 400.5}));
}

TEST(Messages, about_a_name_in_a_long_list_are_short_and_begin_with_the_reason)
{
  std::string masses = "set Generator = network\nsubsection Network\nset Masses = ", sections;
  for (int i = 0; i < 400; ++i)
  {
    masses += (i > 0 ? ", mass " : "mass ") + std::to_string(i);
    sections += "subsection Mass mass " + std::to_string(i) + "\nset Mass = 1\nend\n";
  }
  const std::string of_list = error_of(
      [&]
      { Session(masses + ", lost\n" + sections + "end\nsubsection Time\nset End = 0\nend\n"); });
  EXPECT_TRUE(has(of_list, "there is no section 'Mass lost'")) << of_list;
  EXPECT_LT(of_list.size(), 400u);

  const std::string of_end = error_of(
      [&]
      {
        Session(masses + "\nset Loads = push\n" + sections +
                "subsection Load push\nset On = nobody of these\nend\nend\n"
                "subsection Time\nset End = 0\nend\n");
      });
  EXPECT_TRUE(has(of_end, "'nobody of these' is not known")) << of_end;
  EXPECT_TRUE(has(of_end, "and 389 more"));
  EXPECT_LT(of_end.size(), 500u);
}

// A ball joint between a cable and a solid in the plane, which does not move across it, and a
// dropper from the ground beside one with a length.
TEST(StartTable, has_one_place_of_a_ball_joint_and_no_length_of_droppers_from_the_ground)
{
  Session session(R"(Gravity = 0, -9.81; Start = equilibrium
Body bracket: Type = solid; Young's modulus = 1e7; Density = 1000; Thickness = 0.01; Fixed boundaries = 0
Body bracket/Mesh: Generator = subdivided_hyper_rectangle; Arguments = 4, 1 : -0.8, 0 : 0, 0.08
Body guy: Type = cable; From = -0.8, 0.68; To = 0, 0.08; Unstressed length = 0.9995;
  Axial stiffness = 2e4; Mass per length = 0.25; Element = bar; Elements = 4; Held ends = from
Wire line: From = 0, 5; To = 10, 5; Components = string; Mass per length = 1; Tension = 1000
Wire low: From = 0, 4; To = 10, 4; Components = string; Mass per length = 1; Tension = 1000
Support ends: Wire = line; Positions = 0, 10
Support low ends: Wire = low; Positions = 0, 10
Link eye: Type = ball joint; From = guy @ 0.9995, 0; To = bracket @ 0, 0.08
Link hook: Type = dropper; From = ground; To = line @ 5; Direction = 0, -1
Link hanger: Type = dropper; From = line @ 3; To = low @ 3; Length = 0.99
Time: End = 0
)");
  session.run();
  const auto table = read_table(session.folder() + "/start.csv");
  const std::vector<double> &length = table.at("length [m]"),
                            &stretched = table.at("stretched length [m]");
  ASSERT_EQ(length.size(), 5u);
  for (const char *const axis : {"x [m]", "y [m]", "z [m]"})
    for (const std::size_t row : {1, 2})
      EXPECT_EQ(table.at(axis)[row], table.at(axis)[0]) << axis << ' ' << row;
  EXPECT_NE(table.at("x [m]")[3], table.at("x [m]")[0]);
  for (const std::size_t row : {0, 1, 2, 3})
    EXPECT_TRUE(std::isnan(length[row]) && std::isnan(stretched[row])) << row;
  EXPECT_EQ(length[4], .99);
  EXPECT_GE(stretched[4], .99);
}

// A constant force on a mass and a spring: from 0 to 2 F/k within half a period, 2 ms or 2 us here.
// A stop beyond is open all the time.
TEST(Messages, of_small_scenes_keep_their_digits)
{
  const auto log = [](const std::string &load, const std::string &mass, const std::string &time)
  {
    return log_of("Gravity = 0, 0\nStart = undeformed\n"
                  "Mass tip: Position = 0, 0; Motions = y; Mass = " +
                  mass +
                  "\nSpring spring: From = ground; To = tip; Stiffness = 1\n"
                  "Link stop: Type = stop; From = tip; To = ground; Direction = 0, 1; Gap = 1; "
                  "Stiffness = 100\nLoad push: On = tip; Magnitude = " +
                  load + "\nProbe tip: Point = tip\nTime: Scheme = Newmark; " + time + "\n");
  };
  const std::string small = log("1.234e-7", "4.0528473e-13", "Step = 1e-8; End = 2e-6"),
                    large = log("1.234e-4", "4.0528473e-7", "Step = 1e-5; End = 2e-3");
  const std::string name = "  tip                                 ";
  EXPECT_TRUE(has(small, name + "  0.000247         0 mm")) << small;
  EXPECT_TRUE(has(small, "longest 'stop', 2e-06 s")) << small;
  EXPECT_TRUE(has(large, name + "      0.25      0.00 mm")) << large;
  EXPECT_TRUE(has(large, "longest 'stop', 0.0020 s")) << large;
}

TEST(ResultsFolder, of_a_run_on_its_way_is_refused_to_another)
{
  Session first(line + "Support ends: Wire = line; Positions = 0, 10\n");
  bool was_asked = false;
  first.run(
      [&](const taut::StepView &)
      {
        if (std::exchange(was_asked, true))
          return;
        taut::Parameters parameters;
        parameters.read(scene_file("en50318_2002_250"),
                        {"Output/Folder=" + first.folder(), "Statistics/Window="});
        parameters.output.overwrite = true;
        const std::string error = error_of([&] { taut::check_results_folder(parameters); });
        EXPECT_TRUE(has(error, "another run writes its results to '" + first.folder())) << error;
      });
  EXPECT_TRUE(was_asked);
  // Its end, also a violent one, ends the lock, and leaves no file of it.
  const int folder = open(first.folder().c_str(), O_RDONLY | O_DIRECTORY);
  EXPECT_EQ(flock(folder, LOCK_EX | LOCK_NB), 0);
  close(folder);
  for (const auto &entry : std::filesystem::directory_iterator(first.folder()))
    EXPECT_FALSE(has(entry.path().filename().string(), "lock"));
}
