// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: whatever the numbers of a scene, from steps of 1e-9 to 1e6 s, ratios of 1e12, loads of
// 1e-12 and 1e12 N, the program gives the answer of the model, or one error with its reason.
// Expected values: a copy of each scene in 120 digits, and a twin in millimetres, grams and
// milliseconds.
#include "extended_run.h"
#include "program_run.h"
#include "scene_matrix.h"
#include "scene_numbers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>

using namespace extremes;

namespace
{
  /// What is allowed of an entry's own largest value, and of the scale of its quantity; and the
  /// part of scenes that may end in an error (doc/extremes.md has the figure).
  constexpr double relative = 1e-6, absolute = 1e-7, largest_part_of_errors = .05;

  struct Summary
  {
    unsigned int n_scenes = 0, n_answers = 0, n_wrong = 0, n_fallbacks = 0, iterations = 0;
    double deviation = 0., twin = 0., certificate = 0.; ///< deviations over what is allowed
  };
  std::map<std::string, Summary> summaries;
  std::map<std::string, std::vector<std::string>> errors; ///< scenes by reason

  std::string reason(const std::string &message)
  {
    if (message.find("singular to working precision") != std::string::npos)
      return "is lost in the rounding";
    for (const char *known :
         {"contradict", "not held", "nothing holds", "nothing that moves",
          "is lost in the rounding", "misses the contact tolerance", "is not solved", "beyond"})
      if (message.find(known) != std::string::npos)
        return known;
    return message;
  }

  std::string name_of(const Case &c)
  {
    return c.family + ": " + c.name;
  }

  void check(const Case &given)
  {
    Case c = given;
    const std::string name = name_of(c);
    SCOPED_TRACE(name);
    Summary &s = summaries[c.family];
    ++s.n_scenes;
    const Answer ours = program_answer(c);
    c.conserving = ours.conserving;
    const Answer exact = extended_answer(c);
    if (!ours.error.empty())
    {
      errors[reason(ours.error)].push_back(name);
      if (exact.error.empty())
        std::printf("no answer | %s | %s\n", name.c_str(), ours.error.c_str());
      return;
    }
    ++s.n_answers;
    s.certificate = std::max(s.certificate, ours.certificate);
    s.iterations = std::max(s.iterations, ours.iterations);
    s.n_fallbacks += ours.n_fallbacks;
    if (!exact.error.empty())
    {
      ++s.n_wrong;
      ADD_FAILURE() << "an answer to a scene that has none: " << exact.error;
      return;
    }
    std::vector<std::vector<Observation>> neighbours;
    for (Answer neighbour : {extended_answer(in_last_digits(c, 1)),
                             extended_answer(in_last_digits(c, 2)), extended_answer(c, true)})
      if (neighbour.error.empty())
        neighbours.push_back(std::move(neighbour.steps));
    const auto scale = scales(c, exact);
    const Deviation d = compare(ours.steps, exact.steps, scale, neighbours, relative, absolute);

    EXPECT_LE(d.excess, 1.) << d.where << "; certificate " << ours.certificate;

    // Millimetres, grams and milliseconds; long wires in kilometres, tons and kiloseconds.
    const double factor = !c.scene.wires.empty() && c.scene.wires[0].b.x > 1e6 ? 1e-3 : 1e3;
    const Units other = {factor, factor, factor};
    Answer twin = program_answer(in_units(c, other));
    to_units_of_origin(twin.steps, other);
    if (!twin.error.empty())
    {
      --s.n_answers;
      errors["in other units: " + reason(twin.error)].push_back(name);
      return;
    }
    const Deviation t = compare(twin.steps, ours.steps, scale, neighbours, relative, absolute);
    s.n_wrong += d.excess > 1. || t.excess > 1.;
    EXPECT_LE(t.excess, 1.) << "in other units: " << t.where;
    if (d.excess <= 1. && t.excess <= 1.)
    {
      s.deviation = std::max(s.deviation, d.excess);
      s.twin = std::max(s.twin, t.excess);
    }
  }

  /// TAUT_EXTREMES_SEEDS=first:last, 1:7 without it: covers of the matrix; TAUT_EXTREMES_ONLY=text:
  /// of them the scenes whose names have the text.
  void check_covers(std::vector<Case> (*cover)(unsigned int))
  {
    const char *const only = std::getenv("TAUT_EXTREMES_ONLY");
    unsigned int first = 1, last = 7;
    if (const char *const seeds = std::getenv("TAUT_EXTREMES_SEEDS"))
    {
      ASSERT_EQ(std::sscanf(seeds, "%u:%u", &first, &last), 2) << seeds;
    }
    for (unsigned int seed = first; seed <= last; ++seed)
      for (const Case &c : cover(seed))
        if (!only || name_of(c).find(only) != std::string::npos)
          check(c);
  }
} // namespace

TEST(Extremes, masses_and_springs)
{
  check_covers(masses);
}

TEST(Extremes, wires_and_stops)
{
  check_covers(wires);
}

TEST(Extremes, sliding_contacts)
{
  check_covers(sliding);
}

TEST(Extremes, bodies_that_only_links_hold)
{
  check_covers(resting);
}

TEST(Extremes, scenes_without_an_answer_end_with_its_reason)
{
  for (const Case &c : impossible())
    check(c);
}

// Last, after all others: the table, and the bound on errors.
TEST(Summary, few_scenes_end_in_an_error)
{
  unsigned int n_scenes = 0, n_answers = 0;
  std::printf("family | scenes | answers | wrong | deviation | of twin | certificate | "
              "iterations | fallbacks\n");
  for (const auto &[family, s] : summaries)
  {
    std::printf("%s | %u | %u | %u | %.1e | %.1e | %.1e | %u | %u\n", family.c_str(), s.n_scenes,
                s.n_answers, s.n_wrong, s.deviation, s.twin, s.certificate, s.iterations,
                s.n_fallbacks);
    n_scenes += s.n_scenes;
    n_answers += s.n_answers;
  }
  for (const auto &[text, scenes] : errors)
  {
    std::printf("error | %zu | %s\n", scenes.size(), text.c_str());
    for (const std::string &scene : scenes)
      std::printf("  %s\n", scene.c_str());
  }
  EXPECT_LE(n_scenes - n_answers, largest_part_of_errors * n_scenes);
}
