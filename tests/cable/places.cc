// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: what acts at a place on a cable acts there or is refused, and results say where the place
// is in space. Expected values: the same scene written otherwise, closed forms, and the messages.
#include "verification/run.h"

#include <taut/base/exceptions.h>
#include <taut/output/scene_report.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

namespace
{
  using namespace taut;
  using verification::Overrides;
  using verification::Session;

  /// A span with sections of a network, which lists these items.
  std::string span(const std::string &network, const std::string &top = "")
  {
    return R"(set Generator = network
set Gravity = 0, -9.81
set Start = equilibrium
set Bodies = span
subsection Body span
  set Type = cable
  set From = 0, 0, 0
  set To = 30, 0, 0
  set Unstressed length = 31
  set Axial stiffness = 1e6
  set Mass per length = 1
end
subsection Time
  set End = 0
  set Step = 0.01
end
)" + top + "subsection Network\n" +
           network + "end\n";
  }

  std::string load(const std::string &name, const std::string &on, const std::string &magnitude)
  {
    return "subsection Load " + name + "\nset On = " + on +
           "\nset Direction = 0.3, -1, 0.5\nset Magnitude = " + magnitude + "\nend\n";
  }

  std::string link(const std::string &name, const std::string &type, const std::string &from,
                   const std::string &to, const std::string &more = "")
  {
    return "subsection Link " + name + "\nset Type = " + type + "\nset From = " + from +
           "\nset To = " + to + "\n" + more + "end\n";
  }

  const std::string lamp = "set Masses = lamp\nsubsection Mass lamp\nset Position = 30, 0\nset "
                           "Motions = x, y, z\nset Mass = 2\nend\n";

  /// All displacements of the last step.
  BodyVectors last(const std::string &scene, const Overrides &overrides)
  {
    BodyVectors U;
    verification::run_scene(scene, overrides,
                            [&](const StepView &step)
                            {
                              U = step.reference.displacement;
                              for (std::size_t k = 0; k < U.size(); ++k)
                                for (std::size_t i = 0; i < U[k].size(); ++i)
                                  U[k][i] += step.state.U[k][i];
                            });
    return U;
  }

  /// "entry: message" of the error that a run ends with.
  std::string error_of(const std::string &scene, const Overrides &overrides = {})
  {
    try
    {
      verification::run_scene(scene, overrides, [](const StepView &) {});
    }
    catch (const EntryError &e)
    {
      return e.entry() + ": " + e.message();
    }
    catch (const std::exception &e)
    {
      return e.what();
    }
    return "";
  }

  void expect(const std::string &text, const std::vector<std::string> &parts)
  {
    for (const std::string &part : parts)
      EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' in\n" << text;
  }

  std::string text_in(const std::string &path)
  {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }

  /// An array of a .vtu file.
  std::vector<float> array_in(const std::string &path, const std::string &name)
  {
    const std::string text = text_in(path), mark = "Name=\"" + name + "\"";
    const std::size_t at = text.find(mark), offset = text.find("offset=\"", at) + 8,
                      data = text.find("encoding=\"raw\">\n_") + 17;
    EXPECT_NE(at, std::string::npos) << name;
    const char *const begin = text.data() + data + std::stoul(text.substr(offset));
    std::uint64_t size = 0;
    std::memcpy(&size, begin, sizeof size);
    std::vector<float> values(size / sizeof(float));
    std::memcpy(values.data(), begin + sizeof size, size);
    return values;
  }
} // namespace

TEST(CablePlaces, a_load_knows_its_arc_length)
{
  const std::string one = "set Loads = a\n";
  for (const std::string geometry : {"linearised", "nonlinear"})
    for (const std::string factor : {"2", "(2+t)"})
    {
      // Slack has no small motions.
      const Overrides entries = {"Body span/Geometry=" + geometry,
                                 "Body span/Unstressed length=" +
                                     std::string(geometry == "linearised" ? "29.9" : "31"),
                                 "Time/End=" + std::string(factor == "2" ? "0" : "0.02")};
      const auto formula =
                     last(span(one + load("a", "span @ 9, 0; 21.5, 0", factor + "*s")), entries),
                 numbers =
                     last(span("set Loads = a, b\n" + load("a", "span @ 9, 0", factor + "*9") +
                               load("b", "span @ 21.5, 0", factor + "*21.5")),
                          entries),
                 none = last(span(one + load("a", "span @ 9, 0", "0")), entries);
      double largest = 0.;
      ASSERT_EQ(formula.size(), 1u);
      for (std::size_t i = 0; i < formula[0].size(); ++i)
      {
        EXPECT_NEAR(formula[0][i], numbers[0][i], 1e-9) << i;
        largest = std::max(largest, std::fabs(formula[0][i] - none[0][i]));
      }
      EXPECT_GT(largest, 1e-5) << geometry << factor;
    }
}

TEST(CablePlaces, a_load_elsewhere_has_no_arc_length)
{
  const std::string scene = span("set Loads = a\n" + lamp + load("a", "lamp", "2*s"));
  expect(error_of(scene), {"Load a/Magnitude", "does not depend on s", "formula in t"});
}
