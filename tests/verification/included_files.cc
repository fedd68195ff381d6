// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: a file that includes another may set its entries again, after the include; all else that
// is set twice is an error. A line with a pantograph from a file is the line, to the last bit.
#include "scene_tests.h"

#include <taut/simulation/parameter_file.h>

#include <unistd.h>

#include <filesystem>

using namespace verification;
namespace fs = std::filesystem;

namespace
{
  class IncludedFiles : public ::testing::Test
  {
  protected:
    IncludedFiles()
        : folder(fs::temp_directory_path() / ("taut_included_" + std::to_string(getpid())))
    {
      fs::create_directories(folder);
      write("inner.prm", "set A = inner\nset B = inner\nset C = inner\n");
      write("outer.prm", "include inner.prm\nset B = outer\n");
      write("other.prm", "set A = other\n");
    }
    ~IncludedFiles() override
    {
      std::error_code ignored;
      fs::remove_all(folder, ignored);
    }

    void write(const std::string &name, const std::string &text) const
    {
      std::ofstream(folder / name) << text;
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

    const fs::path folder;
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
} // namespace
