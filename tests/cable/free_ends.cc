// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: a cable that one end holds hangs straight down at rest, wherever To is given, or says what
// it lacks; one that is exactly taut is straight. Expected: the length, L + w L^2 / (2 EA).
#include "cable/errors_of_runs.h"
#include "cable/places_in_steps.h"

namespace
{
  using namespace taut;
  using verification::Overrides;

  constexpr double rope_length = 10., w = 9.81, EA = 1e5,
                   stretched = rope_length + w * rope_length * rope_length / (2. * EA);

  const std::string rope = R"(Generator = network; Gravity = 0, -9.81; Start = equilibrium
Body rope: Type = cable; From = 0, 0; To = 0, -10; Unstressed length = 10;
  Axial stiffness = 1e5; Mass per length = 1; Held ends = from
Time: End = 0; Step = 5e-3
)";

  std::vector<Coordinates> places(const Overrides &overrides, const double s,
                                  const std::string &scene = rope)
  {
    std::vector<Coordinates> result;
    Attachment at{Attachment::Kind::body, 0};
    at.place = {s};
    verification::run_scene(scene, overrides,
                            [&](const StepView &view) { result.push_back(displaced(view, at)); });
    return result;
  }
} // namespace

// As near as the stretched length or nearer, and farther.
TEST(FreeEnds, hang_straight_down)
{
  for (const std::string element : {"ANCF", "bar"})
    for (const std::string elements : {"1", "7"})
      for (const char *const to :
           {"0, 0", "0, -4", "0, -10", "0, -10.0049", "0, -10.1", "1e-9, -9"})
      {
        SCOPED_TRACE(element + elements + to);
        const Overrides entries = {std::string("Body rope/To=") + to,
                                   "Body rope/Element=" + element,
                                   "Body rope/Elements=" + elements};
        const Coordinates end = places(entries, rope_length).back(),
                          middle = places(entries, rope_length / 2.).back();
        EXPECT_NEAR(end.y, -stretched, 1e-9);
        EXPECT_NEAR(end.x, 0., 1e-6);
        EXPECT_NEAR(middle.y, -(rope_length / 2. + w * rope_length * rope_length * 3. / 8. / EA),
                    1e-9);
      }
  const Coordinates other =
      places({"Body rope/Held ends=to", "Body rope/From=0, -9", "Body rope/To=0, 0"}, 0.).back();
  EXPECT_NEAR(other.y, -stretched, 1e-9);
}

// From the side; ANCF elements with a little bending stiffness, for the last one has no tension.
TEST(FreeEnds, come_down_from_the_side)
{
  for (const char *const to : {"5, -5", "9.9, 0", "0.1, -9.9"})
  {
    const std::string entry = std::string("Body rope/To=") + to;
    for (const char *const kind : {"Body rope/Element=bar", "Body rope/Bending stiffness=1e-3"})
      EXPECT_NEAR(places({entry, kind}, rope_length).back().y, -stretched, 1e-6) << to << kind;
    expect(error_of(rope, {entry}), {"Body rope/Bending stiffness", "free end at To", "bar"});
  }
}

// The direction of the last ANCF element, which costs no energy, does not start to move either.
TEST(FreeEnds, stay_at_rest)
{
  for (const char *const element : {"ANCF", "bar"})
    for (const char *const start : {"equilibrium", "undeformed"})
    {
      const std::vector<Coordinates> way =
          places({std::string("Start=") + start, std::string("Body rope/Element=") + element,
                  "Time/End=1"},
                 rope_length);
      ASSERT_EQ(way.size(), 201u);
      for (const Coordinates &end : way)
        EXPECT_LT(norm(end - Coordinates{0., -stretched}), 1e-9) << element << start;
    }
}

TEST(FreeEnds, slack_between_two_places_above_each_other)
{
  expect(error_of(rope, {"Body rope/Held ends=both", "Body rope/To=0, -9"}),
         {"Body rope", "no plane to hang in", "Held ends"});
  expect(error_of(rope, {"Body rope/To=0, 10"}), {"no plane to hang in"});
}

// As long as the way between its ends, without weight: a straight line that its inertia holds.
TEST(FreeEnds, exactly_taut_without_weight)
{
  const Overrides straight = {"Gravity=0, 0", "Start=undeformed", "Body rope/Held ends=both",
                              "Body rope/To=6, -8", "Time/End=0.05"};
  for (const Coordinates &middle : places(straight, rope_length / 2.))
    EXPECT_LT(norm(middle - Coordinates{3., -4.}), 1e-12);
  Overrides slack = straight;
  slack.push_back("Body rope/Unstressed length=10.000001");
  expect(error_of(rope, slack), {"no shape of its own"});
}
