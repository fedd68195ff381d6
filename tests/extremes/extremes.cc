// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: whatever the numbers of a scene, from steps of 1e-9 to 1e6 s, ratios of 1e12, loads of
// 1e-12 and 1e12 N, the program gives the answer of the model, or one error with its reason.
// Expected: a copy of each scene in 120 digits, a twin in millimetres, grams and milliseconds.
#include "extended_run.h"
#include "scene_matrix.h"
#include "tally.h"

using namespace extremes;

namespace
{
  Tally tally;

  void check(const Case &given)
  {
    Case c = given;
    const std::string name = c.family + ": " + c.name;
    SCOPED_TRACE(name);
    const Answer ours = program_answer(c);
    c.conserving = ours.conserving;
    const Answer exact = extended_answer(c);
    std::vector<Answer> neighbours;
    if (ours.error.empty() && exact.error.empty())
      neighbours = {extended_answer(in_last_digits(c, 1)), extended_answer(in_last_digits(c, 2)),
                    extended_answer(c, true)};
    // Millimetres, grams and milliseconds; long wires in kilometres, tons and kiloseconds.
    const double factor = !c.scene.wires.empty() && c.scene.wires[0].b.x > 1e6 ? 1e-3 : 1e3;
    const Units other = {factor, factor, factor};
    tally.judge(c.family, name, ours, exact, scales(c, exact), neighbours, other,
                [&] { return program_answer(in_units(c, other)); });
  }

  void check_covers(std::vector<Case> (*cover)(unsigned int))
  {
    for_each_seed(7,
                  [&](const unsigned int seed)
                  {
                    for (const Case &c : cover(seed))
                      if (is_chosen(c.family + ": " + c.name))
                        check(c);
                  });
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
  tally.print();
}
