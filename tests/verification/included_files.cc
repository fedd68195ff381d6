// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: a file that includes another may set its entries again, after the include; all else that
// is set twice is an error. A line with a pantograph from a file is the line, to the last bit.
// Files of the library have the numbers of their sources.
#include "scene_tests.h"

#include <taut/simulation/parameter_file.h>

using namespace verification;

namespace
{
  class IncludedFiles : public ::testing::Test
  {
  protected:
    IncludedFiles()
    {
      write("inner.prm", "set A = inner\nset B = inner\nset C = inner\n");
      write("outer.prm", "include inner.prm\nset B = outer\n");
      write("other.prm", "set A = other\n");
    }

    void write(const std::string &name, const std::string &text) const
    {
      scratch.write(name, text);
    }

    /// "A = 1; B = 2", or the error.
    std::string entries(const std::string &text) const
    {
      write("main.prm", text);
      std::string result;
      const std::string error = error_of(
          [&]
          {
            taut::ParameterFile file;
            file.read((folder / "main.prm").string());
            for (const auto &entry : file.entries())
              result += (result.empty() ? "" : "; ") + entry.name() + " = " + entry.value;
          });
      return error.empty() ? result : error;
    }

    /// A line of one span at rest, with entries of its wires and of the catenary.
    void write_line(const std::string &contact, const std::string &messenger,
                    const std::string &more) const
    {
      const std::string usual = "set Mass per length = 1\nset Model = string\n";
      write("line.prm", "set Generator = catenary\nset Start = equilibrium\nsubsection Catenary\n"
                        "set Number of spans = 1\nset Span length = 40\n"
                        "subsection Contact wire\n" +
                            (contact.empty() ? usual : contact) +
                            "set Tension = 12000\nend\nsubsection Messenger wire\n" +
                            (messenger.empty() ? usual : messenger) +
                            "set Tension = 12000\nend\n"
                            "subsection Droppers\nset Positions = 10, 20, 30\nend\n" +
                            more +
                            "end\nsubsection Time\nset Step = 1e-3\nset End = 0\nend\n"
                            "subsection Statistics\nset Window =\nend\n");
    }

    /// That of a contact wire of the library, in a beam.
    double bending_stiffness(const std::string &name) const
    {
      taut::ParameterFile file;
      file.read(TAUT_PRM_FOLDER "/wires/" + name + ".prm");
      for (const auto &entry : file.entries())
        if (entry.name() == "Bending stiffness")
          return std::stod(entry.value);
      return 0.;
    }

    const Folder scratch;
    const fs::path folder = scratch.path;
  };

  TEST_F(IncludedFiles, entries_are_set_again_after_the_include)
  {
    EXPECT_EQ(entries("include inner.prm\n"), "A = inner; B = inner; C = inner");
    EXPECT_EQ(entries("include inner.prm\nset A = main\n"), "A = main; B = inner; C = inner");
    EXPECT_EQ(entries("include outer.prm\nset A = main\n"), "A = main; B = outer; C = inner");
    EXPECT_EQ(entries("subsection S\ninclude inner.prm\nset C = main\nend\n"),
              "S/A = inner; S/B = inner; S/C = main");
  }

  TEST_F(IncludedFiles, all_else_that_is_set_twice_is_an_error)
  {
    for (const char *const text :
         {"set A = main\ninclude inner.prm\n", "include inner.prm\ninclude inner.prm\n",
          "include inner.prm\ninclude other.prm\n", "set A = 1\nset A = 2\n",
          "include inner.prm\nset A = 1\nset A = 2\n",
          "include inner.prm\nset A = 1\ninclude other.prm\n"})
    {
      const std::string error = entries(text);
      EXPECT_TRUE(has(error, "'A' was set before, at ")) << text << error;
      EXPECT_TRUE(has(error, "set again, after the include")) << error;
    }
  }

  TEST_F(IncludedFiles, pantograph_from_a_file)
  {
    const std::string name = scene_file("en50318_2002_250");
    std::string text = file_text(name);
    const std::size_t first = text.find("    set Masses "), last = text.find("    set Start  ");
    ASSERT_NE(first, std::string::npos);
    ASSERT_GT(last, first);
    text.replace(first, last - first,
                 "include " + std::string(TAUT_PRM_FOLDER) + "/pantographs/en50318_2002.prm\n");
    const std::size_t stiffness = text.find("    set Contact stiffness");
    ASSERT_NE(stiffness, std::string::npos);
    text.erase(stiffness, text.find('\n', stiffness) + 1 - stiffness);
    write("line.prm", text);
    const auto history = [](const std::string &file)
    {
      return history_of(file, {"Time/End=0.1", "Statistics/Window="},
                        [](const taut::StepView &view) { return view.state.multiplier.back(); });
    };
    const std::vector<double> forces = history(name);
    EXPECT_EQ(forces.size(), 101u);
    EXPECT_EQ(history((folder / "line.prm").string()), forces);
  }

  // Every pantograph of the library runs; entries of the line that follow it count.
  TEST_F(IncludedFiles, every_pantograph_of_the_library_stands_under_a_line)
  {
    const std::map<std::string, std::vector<double>> masses = {{"dsa250", {7.51, 5.855, 4.645}},
                                                               {"dsa380", {7.12, 6., 5.8}},
                                                               {"en50318_2002", {7.2, 15.}}};
    std::size_t n_files = 0;
    for (const auto &file : fs::directory_iterator(TAUT_PRM_FOLDER "/pantographs"))
    {
      ++n_files;
      write_line("", "",
                 "subsection Pantograph pantograph\ninclude " + file.path().string() +
                     "\nset Static force = 80\nset Start = 15\nset Speed = 0\nend\n");
      const std::vector<double> &expected = masses.at(file.path().stem().string());
      int n_seen = 0;
      run_scene((folder / "line.prm").string(), {},
                [&](const taut::StepView &view)
                {
                  ++n_seen;
                  ASSERT_EQ(view.scene.masses.size(), expected.size());
                  for (std::size_t i = 0; i < expected.size(); ++i)
                    EXPECT_EQ(view.scene.masses[i].mass, expected[i]);
                  EXPECT_TRUE(has(view.scene.links.back().name, "pantograph"));
                  EXPECT_NEAR(view.state.multiplier.back(), 80., 5.); // less its lowest spring
                });
      EXPECT_EQ(n_seen, 1);
    }
    EXPECT_EQ(n_files, masses.size());
  }

  // Droppers 10 m apart carry 10 m of a level string. Reference: the masses of the files' sources.
  TEST_F(IncludedFiles, every_wire_of_the_library_weighs_what_its_source_says)
  {
    const std::map<std::string, double> contact = {{"cu_ac_100", .889},
                                                   {"cu_ac_107", .9515},
                                                   {"cu_ac_120", 1.067},
                                                   {"cu_ac_150", 1.3335}},
                                        messenger = {{"bz_ii_50", .437}, {"bz_ii_70", .596}};
    const std::string wires = TAUT_PRM_FOLDER "/wires/";
    const auto from_file = [&](const std::string &name)
    { return "include " + wires + name + ".prm\n"; };
    for (const auto &[name, mass] : contact)
      for (const auto &[rope, rope_mass] : messenger)
      {
        write_line(from_file(name) + "set Model = string\n", from_file(rope),
                   "set Pantographs =\n");
        int n_seen = 0;
        run_scene((folder / "line.prm").string(), {},
                  [&, mass = mass, rope_mass = rope_mass](const taut::StepView &view)
                  {
                    ++n_seen;
                    EXPECT_NEAR(view.state.multiplier[1], 10. * mass * 9.81, 1e-8);
                    EXPECT_EQ(view.scene.wires[0].mass_per_length, rope_mass);
                    // E = 120 GPa and a round section of the nominal area.
                    const double area = std::stod(name.substr(6)) * 1e-6;
                    EXPECT_EQ(view.scene.wires[0].transverse, taut::TransverseKind::string);
                    EXPECT_NEAR(bending_stiffness(name), 120e9 * area * area / (4. * M_PI),
                                .005 * bending_stiffness(name));
                  });
        EXPECT_EQ(n_seen, 1);
      }
    for (const auto &file : fs::directory_iterator(wires))
    {
      const std::string name = file.path().stem().string();
      EXPECT_EQ(contact.count(name) + messenger.count(name), 1u) << name;
    }
  }
} // namespace
