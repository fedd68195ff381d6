// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: a scene with tables is the scene with the same functions as formulas; its results take
// their tables with them, and no run goes on with another table. Sources: the same functions.
#include "scene_tests.h"

#include "study/sweep.h"

using namespace verification;

namespace
{
  /// A mass on a contact spring that slides along a sloping wire under a changing force.
  std::string scene(const std::string &profile, const std::string &force)
  {
    return prm(R"(Gravity = 0, 0; Start = equilibrium
Wire wire: To = 10, 0; Components = string; Mass per length = 1; Tension = 1000; Element size = 0.5
Support ends: Wire = wire; Positions = 0, 10
Mass mass: Position = 1, 0; Mass = 5; Motions = y
Spring spring: From = ground; To = mass; Stiffness = 2000
Link contact: Type = sliding contact; From = mass; To = wire @ 1; Direction = 0, 1;
  Stiffness = 10000; Speed = 4; Height profile = )" +
               profile + R"(
Load force: Type = point; On = mass; Magnitude = )" +
               force + R"(
Time: Scheme = generalised-alpha; Step = 1e-2; End = 2
)");
  }

  /// A folder with a scene, its tables and results.
  class MeasuredData : public ::testing::Test
  {
  protected:
    MeasuredData()
    {
      write("data/profile.csv", "s, height\n0, 0\n4, 0.004\n10, 0.001\n");
      write("force.csv", "t; F\n0; 60\n1; 70,5\n2; 60\n");
      write("scene.prm", scene("table(data/profile.csv, height)", "table(force.csv, F)"));
      write("formulas.prm",
            scene("if(s < 4, 0.001*s, 0.006 - 0.0005*s)", "if(t < 1, 60 + 10.5*t, 81 - 10.5*t)"));
    }

    void write(const std::string &name, const std::string &text) const
    {
      scratch.write(name, text);
    }

    void append_sweep(const std::string &entry, const std::string &values) const
    {
      std::ofstream(folder / "scene.prm", std::ios::app)
          << "subsection Sweep\n  set Parameters = varied\n  subsection Parameter varied\n"
             "    set Entries = "
          << entry << "\n    set Values = " << values << "\n  end\nend\n";
    }

    void sweep(const bool resume) const
    {
      std::ostringstream log;
      taut::Sweep all((folder / "scene.prm").string(),
                      {"Output.Folder=" + (folder / "results").string()}, taut::Communicator(),
                      log);
      all.set_resume(resume);
      all.run();
    }

    /// Runs a file with results in a folder; returns the table of the contact.
    std::string run(const fs::path &file, const std::string &results,
                    const Overrides &overrides = {}, const bool resume = false) const
    {
      taut::Parameters parameters;
      parameters.read(file.string(),
                      Overrides{"Output.Folder=" + (folder / results).string()} + overrides);
      parameters.output.resume = resume;
      std::ostringstream log;
      taut::Simulation(parameters, log).run();
      return file_text((folder / results / "sliding.csv").string());
    }

    const Folder scratch;
    const fs::path folder = scratch.path;
  };

  TEST_F(MeasuredData, tables_are_formulas)
  {
    std::vector<double> forces[2];
    for (const char *const name : {"scene.prm", "formulas.prm"})
      run_scene((folder / name).string(), {},
                [&](const taut::StepView &view)
                { forces[name[0] == 's'].push_back(view.state.multiplier.back()); });
    EXPECT_GT(largest(forces[0]), 20.);
    EXPECT_LT(largest_difference(forces[0], forces[1]), 1e-10 * largest(forces[0]));
  }

  TEST_F(MeasuredData, results_take_their_tables_with_them)
  {
    const std::string first = run(folder / "scene.prm", "results");
    EXPECT_TRUE(fs::exists(folder / "results/force.csv"));
    EXPECT_TRUE(fs::exists(folder / "results/data/profile.csv"));
    fs::remove_all(folder / "data");
    fs::remove(folder / "force.csv");
    EXPECT_EQ(run(folder / "results/used.prm", "again"), first);
    EXPECT_EQ(run(folder / "again/used.prm", "once more"), first);
  }

  TEST_F(MeasuredData, tables_from_elsewhere_are_copied_beside_the_scene)
  {
    fs::create_directories(folder / "scenes");
    write("scenes/scene.prm", scene("table(../data/profile.csv, height)",
                                    "table(" + (folder / "force.csv").string() + ", F)"));
    const std::string first = run(folder / "scenes/scene.prm", "results/a/b");
    EXPECT_TRUE(fs::exists(folder / "results/a/b/profile.csv"));
    fs::remove_all(folder / "data");
    fs::remove(folder / "force.csv");
    EXPECT_EQ(run(folder / "results/a/b/used.prm", "again"), first);
  }

  TEST_F(MeasuredData, no_run_goes_on_with_another_table)
  {
    const Overrides often = {"Output.Checkpoint interval=0.3"};
    const std::string first = run(folder / "scene.prm", "results", often);
    EXPECT_EQ(run(folder / "scene.prm", "results", often, true), first);
    write("force.csv", "t; F\n0; 60\n1; 70,5\n2; 60,1\n");
    const std::string error = error_of([&] { run(folder / "scene.prm", "results", often, true); });
    EXPECT_TRUE(has(error, "the file 'force.csv' is not what it was")) << error;
    EXPECT_TRUE(has(error, "begin anew with --overwrite")) << error;
  }

  TEST_F(MeasuredData, runs_to_a_place_go_on)
  {
    write("speed.csv", "t, v\n0, 0\n1, 4\n3, 4\n");
    const Overrides ramp = {"Network/Link contact/Speed=table(speed.csv, v)",
                            "Time/End=until x = 6 m", "Output.Checkpoint interval=0.4"};
    const std::string first = run(folder / "scene.prm", "results", ramp);
    EXPECT_EQ(run(folder / "scene.prm", "results", ramp, true), first);
    // 2 m in the first second, and 3 m in 0.75 s more.
    const auto table = read_table((folder / "results/sliding.csv").string());
    EXPECT_NEAR(table.at("time [s]").back(), 1.75, 1e-12);
  }

  TEST_F(MeasuredData, no_sweep_goes_on_with_another_table)
  {
    append_sweep("Network/Mass mass/Mass", "4, 5");
    sweep(false);
    EXPECT_TRUE(fs::exists(folder / "results/sweep/force.csv"));
    EXPECT_EQ(error_of([&] { sweep(true); }), "");
    write("data/profile.csv", "s, height\n0, 0\n4, 0.003\n10, 0.001\n");
    const std::string error = error_of([&] { sweep(true); });
    EXPECT_TRUE(has(error, "the file 'data/profile.csv' is not what it was when")) << error;
  }

  // The table of the last case is in no run before.
  TEST_F(MeasuredData, a_sweep_over_tables_keeps_each_of_them)
  {
    write("gusts.csv", "t; F\n0; 60\n2; 65\n");
    append_sweep("Network/Load force/Magnitude", "table(force.csv, F); table(gusts.csv, F)");
    sweep(false);
    const auto text = [&](const std::string &name)
    {
      std::ifstream in(folder / name);
      return std::string(std::istreambuf_iterator<char>(in), {});
    };
    for (const char *const table : {"force.csv", "gusts.csv", "data/profile.csv"})
      EXPECT_EQ(text(std::string("results/sweep/") + table), text(table)) << table;

    // A sweep that was killed before its last case finds that another file has taken its place.
    const std::string lines = text("results/sweep/sweep.csv");
    std::ofstream(folder / "results/sweep/sweep.csv")
        << lines.substr(0, lines.rfind('\n', lines.size() - 2) + 1);
    write("gusts.csv", "t; F\n0; 60\n2; 66\n");
    const std::string error = error_of([&] { sweep(true); });
    EXPECT_TRUE(has(error, "the file 'gusts.csv' is not what it was when")) << error;
  }

  TEST_F(MeasuredData, tables_have_no_names_of_results)
  {
    write("links.csv", "t; F\n0; 60\n2; 60\n");
    write("bad.prm", scene("0", "table(links.csv, F)"));
    const std::string error = error_of([&] { run(folder / "bad.prm", "results"); });
    EXPECT_TRUE(has(error, "'links.csv' of a file of results; rename it")) << error;
  }

  TEST_F(MeasuredData, tables_end_before_the_run_does)
  {
    const std::string error =
        error_of([&] { run(folder / "scene.prm", "results", {"Time/End=2.2"}); });
    EXPECT_TRUE(has(error, "Network/Load force/Magnitude")) << error;
    EXPECT_TRUE(has(error, "file 'force.csv' has 'F' from 0 to 2 and none at ")) << error;
  }
} // namespace
