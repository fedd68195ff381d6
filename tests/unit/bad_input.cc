// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: a mistake in the input is one error of one line that names file, line, entry, value and
// remedy; results of an earlier run are as they were. Source: the rows of bad_input.txt, and below.
#include "common.h"
#include "verification/scene_builder.h"

#include <taut/simulation/simulation.h>

namespace
{
  using namespace verification;
  namespace fs = std::filesystem;
  using Texts = std::vector<std::string>;

  /// A scene with a mistake, and what the message says; it names the line that ends with "# here".
  struct Case
  {
    std::string name, scene;
    Texts fragments;
    bool begins_with_place = false; ///< the message begins with path and value of the marked line
    bool in_run = false; ///< the mistake shows while the run is on its way, with its results begun
  };

  Texts split(const std::string &text, const std::string &separator)
  {
    Texts parts;
    std::size_t begin = 0, at;
    for (; (at = text.find(separator, begin)) != std::string::npos; begin = at + separator.size())
      parts.push_back(text.substr(begin, at - begin));
    parts.push_back(text.substr(begin));
    return parts;
  }

  struct Rows
  {
    Rows()
    {
      std::ifstream in(TAUT_TESTS_FOLDER "/unit/bad_input.txt");
      std::string row;
      for (std::string line; std::getline(in, line);)
      {
        if (line.rfind("  ", 0) != 0)
          add(std::exchange(row, ""));
        row += line.rfind("  ", 0) == 0 ? line.substr(1) : line;
      }
      add(row);
    }

    std::map<std::string, SceneBuilder> scenes = {{"", SceneBuilder()}};
    std::vector<Case> cases;

  private:
    void add(const std::string &row)
    {
      if (row.empty() || row[0] == '#')
        return;
      const Texts sides = split(row, " => ");
      Texts changes = split(sides[0], " | ");
      const Texts head = split(changes[0], " (");
      const std::string brackets = head.size() > 1 ? head[1] : "network)";
      SceneBuilder builder = scenes.at(brackets.substr(0, brackets.find_first_of(",)")));
      for (std::size_t i = 1; i < changes.size(); ++i)
        builder.add(changes[i]);
      if (head[0].rfind("scene ", 0) == 0)
      {
        scenes[head[0].substr(6)] = builder;
        return;
      }
      const std::string text = builder.text();
      cases.push_back({head[0], text, sides.size() > 1 ? split(sides[1], " | ") : Texts(),
                       text.find(" # here") != std::string::npos,
                       brackets.find(", in run)") != std::string::npos});
    }
  };

  const Rows &rows()
  {
    static const Rows all;
    return all;
  }

  std::string scene(const std::string &name, const std::string &changes = "")
  {
    return SceneBuilder(rows().scenes.at(name)).add(changes).text();
  }

  /// The network with a piece of its text replaced.
  std::string with(const std::string &from, const std::string &to)
  {
    std::string text = scene("network");
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << "the scene has no '" << from << "'";
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
  }

  std::vector<Case> mistakes_of_text()
  {
    const std::string output = "subsection Output\n";
    std::string sections;
    for (int i = 0; i < 21; ++i)
      sections += i < 20 ? "subsection a\n" : "subsection a # here\n";
    std::vector<Case> cases;
    const auto add = [&](const std::string &name, const std::string &text, const Texts &fragments) {
      cases.push_back({name, text, fragments});
    };
    add("unknown_entry", with("set Tension ", "set Tensoin # here\n#"),
        {"cannot read", "set Tensoin"});
    add("misspelt_entry", with("set Tension = 1000", "set Tensoin = 1000 # here"),
        {"there is no entry 'Tensoin' in 'Wire line'", "did you mean 'Tension'"});
    add("misspelt_section", with("subsection Wire line", "subsection Wire lime # here"),
        {"there is no section 'Wire lime'", "did you mean 'Wire line'"});
    add("section_without_its_name_in_the_list",
        scene("network", "Network: Loads =\nLoad push: *\nNetwork: Loads ="),
        {"there is no section 'Load push' in 'Network'", "add 'push' to the names in 'Loads'"});
    add("figure_without_a_name",
        scene("network", "Quantity impulze: *\nStudy: Quantities = impulse"),
        {"no section 'Quantity impulze'", "did you mean 'Quantity impulse'"});
    add("duplicate_entry",
        with("set Positions = 0, 10", "set Positions = 0, 10\nset Positions = 1 # here"),
        {"Network/Support ends/Positions", "was set before, at", "remove one"});
    add("missing_end",
        with("subsection Statistics\n  set Window = \nend",
             "subsection Statistics # here\n  set Window ="),
        {"Statistics", "never closed", "add 'end'"});
    add("stray_end", with(output, "end # here\n" + output), {"'end' without a 'subsection'"});
    add("nonsense_line", with(output, "hello # here\n" + output),
        {"cannot read 'hello'", "set Name = value"});
    add("entry_without_name", with("set Gap = 0.5", "set = 0.5 # here"),
        {"the name of an entry", "empty"});
    add("trailing_backslash", "set Start = equilibrium \\\\ # here\n",
        {"Start", "continues a line"});
    add("binary",
        "set A = 1\n\x7f"
        "ELF\x02\x01 # here\n",
        {"not text", "byte 0x7f"});
    add("binary_with_zero", std::string("set A = 1\n\0 # here\n", 19), {"not text", "byte 0x00"});
    add("latin_1",
        with("set Wires = line, arm", "set Wires = l\xfc"
                                      "ne, arm # here"),
        {"not text", "byte 0xfc", "UTF-8"});
    add("sections_without_end", sections, {"more than 20 sections", "'end'"});
    add("include_of_a_missing_file", "set Start = given\ninclude nowhere.prm # here\n",
        {"cannot include", "nowhere.prm", "no such file"});
    add("include_of_a_folder", "include results # here\n", {"cannot include", "no such file"});
    add("include_loop", "\ninclude scene.prm # here\n",
        {"cannot include", "include itself", "remove"});
    add("empty_file", "# nothing but a comment\n", {"scene.prm: it sets no entry"});
    add("no_bodies", "set Generator = network\n",
        {"scene.prm", "the scene is empty", "name at least one"});
    return cases;
  }

  class BadInput : public testing::Test
  {
  protected:
    void SetUp() override
    {
      make_earlier_results();
      before = fs::current_path();
      fs::current_path(folder);
    }

    void TearDown() override { fs::current_path(before); }

    void write(const std::string &name, const std::string &text) { scratch.write(name, text); }

    std::string content(const std::string &name) { return file_text(scratch / name); }

    void make_earlier_results()
    {
      write("results/used.prm", "earlier");
      write("results/links.csv", "earlier");
    }

    bool earlier_results_are_whole()
    {
      return content("results/used.prm") == "earlier" &&
             content("results/links.csv") == "earlier" &&
             std::distance(fs::directory_iterator(folder / "results"), {}) == 2;
    }

    /// The error of reading and running a file, as the program prints it; empty if there is none.
    std::string error_of(const std::string &file, const Texts &overrides = {},
                         bool overwrite = true)
    {
      taut::Parameters parameters;
      std::ostringstream log;
      try
      {
        parameters.read(file, overrides);
        parameters.output.overwrite = overwrite;
        taut::check_results_folder(parameters);
        taut::Simulation(parameters, log).run();
      }
      catch (const taut::EntryError &e)
      {
        EXPECT_TRUE(exists(e.entry(), parameters.values())) << "no entry or section " << e.entry();
        return parameters.explain(e);
      }
      catch (const taut::UserError &e)
      {
        return e.what();
      }
      return "";
    }

    /// Whether an entry or a section of this path is among the entries; the whole file has none.
    static bool exists(const std::string &path, const std::map<std::string, std::string> &entries)
    {
      return path.empty() ||
             std::any_of(entries.begin(), entries.end(),
                         [&](const auto &entry)
                         { return entry.first == path || entry.first.rfind(path + "/", 0) == 0; });
    }

    const Folder scratch;
    const fs::path folder = scratch.path;
    fs::path before;
  };

  /// "scene.prm:<line>:" of the mark " # here", if there is one, and with the path and the value
  /// that stand there if they are asked for; the mark leaves the text.
  std::string take_mark(std::string &text, const bool with_place)
  {
    const std::size_t mark = text.find(" # here");
    if (mark == std::string::npos)
      return "";
    text.erase(mark, 7);
    std::string path, line;
    std::istringstream in(text.substr(0, text.find('\n', mark)));
    int n = 0;
    for (; std::getline(in, line); ++n)
    {
      line.erase(0, line.find_first_not_of(' '));
      if (line.rfind("subsection ", 0) == 0)
        path += (path.empty() ? "" : "/") + line.substr(11);
      else if (line == "end")
        path.erase(path.find('/') == std::string::npos ? 0 : path.rfind('/'));
    }
    std::string place = "scene.prm:" + std::to_string(n) + ":";
    if (with_place)
      place += " " + path;
    if (with_place && line.rfind("set ", 0) == 0)
    {
      const Texts entry = split(line.substr(4), " = ");
      place += (path.empty() ? "" : "/") + entry[0] + " = '" + entry[1] + "'";
    }
    return place;
  }

  void expect_fragments(const std::string &message, const Texts &fragments)
  {
    EXPECT_NE(message, "") << "accepted";
    EXPECT_FALSE(has(message, "\n")) << message;
    for (const std::string &fragment : fragments)
      EXPECT_TRUE(has(message, fragment)) << "'" << fragment << "' is missing in: " << message;
  }

} // namespace

TEST_F(BadInput, TheScenesBeforeTheChangesRun)
{
  for (const char *name : {"network", "catenary"})
  {
    write("scene.prm", scene(name));
    EXPECT_EQ(error_of("scene.prm"), "");
  }
}

TEST_F(BadInput, EachMistakeIsNamedWithItsPlaceAndRemedy)
{
  std::vector<Case> cases = mistakes_of_text();
  cases.insert(cases.end(), rows().cases.begin(), rows().cases.end());
  std::set<std::string> names;
  for (Case &c : cases)
  {
    SCOPED_TRACE(c.name);
    EXPECT_TRUE(names.insert(c.name).second);
    fs::remove_all("results");
    make_earlier_results();
    const std::string place = take_mark(c.scene, c.begins_with_place);
    write("scene.prm", c.scene);
    const std::string message = error_of("scene.prm");
    expect_fragments(message, c.fragments);
    EXPECT_EQ(message.rfind(place, 0), 0u) << message << "\ndoes not begin with " << place;
    EXPECT_TRUE(c.in_run || earlier_results_are_whole());
    if (std::getenv("TAUT_PRINT_MESSAGES"))
      std::printf("%s\n  %s\n", c.name.c_str(), message.c_str());
  }
  EXPECT_EQ(names.size(), 243u);
}

TEST_F(BadInput, FilesThatCannotBeRead)
{
  expect_fragments(error_of("nowhere.prm"), {"cannot read 'nowhere.prm'", "no such file"});
  expect_fragments(error_of("scene.json"), {"scene.json: scenes are not", "take a .prm file"});
  write("scene_250.prm", scene("network"));
  expect_fragments(error_of("scene_25.prm"), {"no such file", "did you mean 'scene_250.prm'"});
  expect_fragments(error_of("results"), {"cannot read 'results'", "it is a folder"});
  fs::create_directories("folder.prm");
  expect_fragments(error_of("folder.prm"), {"cannot read 'folder.prm'", "it is a folder"});
  write("a.prm", "set Start = given\ninclude b.prm\n");
  write("b.prm", "# back\ninclude ./a.prm\n");
  expect_fragments(error_of("a.prm"), {"b.prm:2:", "include itself"});
  EXPECT_TRUE(earlier_results_are_whole());
}

TEST_F(BadInput, ChangesOnTheCommandLine)
{
  write("scene.prm", scene("network"));
  const std::vector<std::pair<std::string, Texts>> cases = {
      {"Time.Step", {"--set 'Time.Step'", "Section.Entry=value"}},
      {"=3", {"--set", "Section.Entry=value"}},
      {"Time.Stp=3", {"--set", "no entry 'Stp'", "did you mean 'Step'"}},
      {"Time.Stiffness=1",
       {"no entry 'Stiffness' in 'Time'", "There is 'Network/Link hanger/Stiffness' and"}},
      {"Link stop/To=ground", {"no section 'Link stop'", "There is 'Network/Link stop'"}},
      {"Time.Step=0,001", {"--set: Time/Step = '0,001'", "decimals have a point"}},
      {"Time.Step=fast", {"--set: Time/Step = 'fast'", "not allowed"}},
      {"Time..Step=1", {"--set", "empty"}},
      {"Foo=1", {"no entry 'Foo'", "Generator", "Sections here: ", "Network", "Time"}},
      {"Time.Step=1\\", {"--set: Time/Step", "continues a line"}},
      {"Time.Step=1 # 2", {"--set", "no '#'"}},
  };
  for (const auto &[assignment, fragments] : cases)
  {
    SCOPED_TRACE(assignment);
    expect_fragments(error_of("scene.prm", {assignment}), fragments);
    EXPECT_TRUE(earlier_results_are_whole());
  }
}

TEST_F(BadInput, ResultsOfAnEarlierRunStayWithoutOverwrite)
{
  write("scene.prm", scene("network"));
  expect_fragments(error_of("scene.prm", {}, false),
                   {"scene.prm:", "Output/Folder = 'results'", "--overwrite"});
  EXPECT_TRUE(earlier_results_are_whole());
  // A table of somebody else's without a run beside it is as much worth.
  fs::remove("results/used.prm");
  expect_fragments(error_of("scene.prm", {}, false), {"Output/Folder = 'results'", "--overwrite"});
  EXPECT_EQ(content("results/links.csv"), "earlier");
  // Files that no run writes are left alone.
  fs::remove("results/links.csv");
  write("results/notes.txt", "mine");
  EXPECT_EQ(error_of("scene.prm", {}, false), "");
  EXPECT_EQ(content("results/notes.txt"), "mine");
}

TEST_F(BadInput, EarlierResultsAreFoundBeforeTheWork)
{
  // The lengths of these droppers cannot be found: whoever hears of that first has searched.
  write("scene.prm", scene("catenary", "Catenary/Droppers: Pre-sag = 0.1, 0.5, 0.1"));
  expect_fragments(error_of("scene.prm", {}, false), {"Output/Folder = 'results'", "--overwrite"});
  expect_fragments(error_of("scene.prm", {}, true), {"would have to push"});
  EXPECT_TRUE(earlier_results_are_whole());
}

TEST_F(BadInput, EntriesOfAnotherSchemeAreSaidNotToBeUsed)
{
  write("scene.prm", scene("network"));
  const auto log_and_used = [&](const Texts &overrides)
  {
    taut::Parameters parameters;
    std::ostringstream log;
    parameters.read("scene.prm", overrides);
    parameters.output.overwrite = true;
    taut::Simulation(parameters, log).run();
    return log.str() + content("results/used.prm");
  };
  // The rigid stop of the scene makes 'automatic' choose another scheme.
  const std::string said = log_and_used({"Time.Generalised-alpha.Spectral radius=0.5"});
  for (const char *sentence :
       {"  not used by it: Time/Generalised-alpha/Spectral radius = 0.5\n",
        "# Not used by it: Time/Generalised-alpha/Spectral radius = 0.5\n", "# The scheme was "})
    EXPECT_TRUE(has(said, sentence)) << said;
  // A default is not worth a word, however it is written.
  EXPECT_FALSE(has(log_and_used({"Time.Generalised-alpha.Spectral radius=0.80"}), "ot used by it"));
  EXPECT_FALSE(
      has(log_and_used({"Time.Scheme=generalised-alpha", "Time.Allow unsuitable scheme=true",
                        "Time.Generalised-alpha.Spectral radius=0.5"}),
          "ot used by it"));
}

TEST_F(BadInput, ARunThatFailsKeepsWhatItHad)
{
  write("scene.prm", scene("network", "Load push: Magnitude = sqrt(0.025-t)"));
  EXPECT_NE(error_of("scene.prm"), "");
  std::istringstream lines(content("results/certificate.csv"));
  int n = 0;
  for (std::string line; std::getline(lines, line);)
    ++n;
  EXPECT_EQ(n, 4) << "head, start and two steps";
  EXPECT_TRUE(has(content("results/statistics.json"), "\"partial\": true"));
}
