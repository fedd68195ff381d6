// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: what an elastic link without damper takes or gives is a warning from 1 % of the energy on,
// with its name and the time of a contact in steps, and an error from 10 % on; contacts that take
// and others that give are added; and a run that does what the message advises has no warning.
// Sources: energy of a falling mass in flight, m v^2 / 2 + m g y, before and after each contact;
// the time of a contact in closed form.
#include "scene_tests.h"

using namespace verification;

namespace
{

  /// A mass of 1 kg that falls from a height onto a stop.
  std::string falling_mass(const double height, const double stiffness, const double step,
                           const double end, const std::string &scheme)
  {
    return R"(Gravity = 0, -9.81; Start = given
Mass mass: Position = 0, )" +
           number(height) + R"(; Motions = y; Mass = 1
Link stop: Type = stop; From = ground; To = mass; Direction = 0, 1;
  Gap = )" +
           number(height) + "; Stiffness = " + number(stiffness) + R"(
Time: Step = )" +
           number(step) + "; End = " + number(end) + "; Scheme = " + scheme + R"(;
  Allow unsuitable scheme = true
)";
  }

  struct Fall
  {
    double taken = 0., given = 0.; ///< of the energy in flight, by contacts [J]
    taut::ContactMeasures::Summary summary;
    std::vector<taut::Warning> warnings; ///< of contact energy and momentum
    std::string error, log;
  };

  Fall fall_of(const std::string &text, const Overrides &overrides = {})
  {
    Fall fall;
    Session session(text, overrides);
    double flight = 0., before = 0.;
    bool was_closed = false;
    const auto end_flight = [&]
    {
      (flight < before ? fall.taken : fall.given) += std::fabs(flight - before);
      before = flight;
    };
    const Callback record = [&](const taut::StepView &view)
    {
      const bool is_closed = view.state.multiplier[0] > 0.;
      const double v = view.state.V[0][0];
      if (is_closed && !was_closed)
        end_flight();
      if (!is_closed)
        flight = .5 * v * v + g * view.state.U[0][0];
      was_closed = is_closed;
      fall.summary = view.measures.summary();
      fall.warnings.clear();
      for (const auto &warning : view.measures.warnings())
        if (warning.kind == "contact_energy" || warning.kind == "contact_momentum")
          fall.warnings.push_back(warning);
    };
    fall.error = error_of([&] { session.run(record); });
    end_flight();
    fall.log = session.log();
    return fall;
  }

  const std::string of_scheme = "Set 'Time/Scheme' to 'automatic', or take a smaller step",
                    of_fixed = "Take a smaller Step, or 'Step control = adaptive'";
} // namespace

// A contact of 3 to 30 steps, by the height in one or another part of a step.
TEST(ContactLosses, warn_from_one_percent_and_fail_from_ten)
{
  struct Case
  {
    double stiffness, height;
    bool warns, fails, takes;
  };
  for (const Case &c : {Case{1e4, .05, false, false, false}, Case{2e5, .0494, false, false, false},
                        Case{2e5, .045, true, false, true}, Case{4e5, .045, true, false, true},
                        Case{8e5, .0494, true, false, true}, Case{8e5, .045, true, false, false},
                        Case{8e5, .0483, true, true, true}, Case{3e6, .0472, true, true, false}})
  {
    const double fall_time = std::sqrt(2. * c.height / g);
    const Fall fall = fall_of(falling_mass(
        c.height, c.stiffness, 1e-3, std::ceil(1.9e3 * fall_time) * 1e-3, "generalised-alpha"));
    std::ostringstream of_case;
    of_case << "drop of " << c.height << " m on " << c.stiffness << " N/m, generalised-alpha";
    const std::string name = of_case.str();
    const double change = (fall.taken + fall.given) / (g * c.height);
    figure(name + ", change of energy", (fall.given - fall.taken) / (g * c.height));
    figure(name + ", contact energy over the change",
           fall.summary.contact_energy / (fall.taken + fall.given));
    EXPECT_EQ(change > .01, c.warns) << name << change;
    EXPECT_EQ(change > .1, c.fails) << name << change;
    EXPECT_EQ(fall.taken > fall.given, c.takes) << name;
    ASSERT_EQ(fall.warnings.size(), c.warns) << name << fall.log;
    EXPECT_EQ(!fall.error.empty(), c.fails) << fall.error;
    if (!c.warns)
      continue;
    EXPECT_NEAR(fall.summary.contact_energy, fall.taken + fall.given,
                .15 * (fall.taken + fall.given))
        << name;
    // The steps in which it closes and opens count as a whole.
    // Of the closed form: from touch to lift on a spring, the weight included.
    const double w = std::sqrt(c.stiffness), v = std::sqrt(2. * g * c.height),
                 contact = 2. * (std::acos(-1.) - std::atan2(v / w, g / c.stiffness)) / w;
    EXPECT_GE(fall.summary.contact_time, contact - 1e-9);
    EXPECT_LE(fall.summary.contact_time, contact + 2e-3);
    std::ostringstream time;
    time.precision(3);
    time << "its shortest contact lasts " << fall.summary.contact_time << " s, "
         << std::lround(fall.summary.contact_time / 1e-3) << " steps";
    for (const std::string &text : {fall.warnings[0].message, c.fails ? fall.error : fall.log})
    {
      for (const std::string &part :
           {std::string("unilateral links ") + (c.takes ? "took" : "gave"),
            std::string("most at 'stop'"), time.str(), of_scheme})
        EXPECT_TRUE(has(text, part)) << part << " in " << text;
    }
    EXPECT_EQ(has(fall.error, "The motion is wrong"), c.fails) << fall.error;
  }
}

TEST(ContactLosses, of_one_contact_and_gains_of_another_are_added)
{
  const Fall fall = fall_of(falling_mass(.045, 4e5, 1e-3, .45, "generalised-alpha"));
  const double all = fall.taken + fall.given;
  EXPECT_GT(figure("two contacts on 4e5 N/m, taken", fall.taken, "J"), .2 * all);
  EXPECT_GT(figure("two contacts on 4e5 N/m, given", fall.given, "J"), .2 * all);
  EXPECT_NEAR(fall.summary.contact_energy, all, .15 * all);
}

// Two contacts of 15 steps, each of which changes the energy by a percent.
TEST(ContactLosses, after_automatic_the_advice_helps)
{
  const std::string text = falling_mass(.05, 5e4, 1e-3, .5, "automatic");
  const Fall fall = fall_of(text);
  ASSERT_EQ(fall.warnings.size(), 1u) << fall.log;
  EXPECT_EQ(fall.error, "");
  EXPECT_TRUE(has(fall.warnings[0].message, of_fixed)) << fall.warnings[0].message;
  EXPECT_FALSE(has(fall.warnings[0].message, "'Time/Scheme'")) << fall.warnings[0].message;
  for (const Overrides &advice : {Overrides{"Time.Step=2.5e-4"}, {"Time.Step control=adaptive"}})
  {
    const Fall better = fall_of(text, advice);
    figure("drop on 5e4 N/m, " + advice[0] + ", contact energy over its scale",
           better.summary.relative_energy);
    EXPECT_TRUE(better.warnings.empty()) << better.log;
    EXPECT_EQ(better.error, "");
  }
}

TEST(ContactLosses, after_a_scheme_by_name_the_advice_helps)
{
  const std::string text = falling_mass(.0472, 3e6, 1e-3, .18, "generalised-alpha");
  EXPECT_TRUE(has(fall_of(text).error, of_scheme));
  for (const Overrides &advice : {Overrides{"Time.Scheme=automatic"}, {"Time.Step=1e-5"}})
  {
    const Fall better = fall_of(text, advice);
    EXPECT_TRUE(better.warnings.empty()) << better.log;
    EXPECT_EQ(better.error, "");
  }
}

// A bob falls by h beside its pivot until its rope is taut, and swings. The rope takes the velocity
// along it, sqrt(2 g h) times the sine of its angle, which a rope that the step resolves gives
// back. The lack remains one of the catch, however long it swings then, and whatever pressed
// before.
TEST(ContactLosses, a_rope_that_does_not_rebound_lacks_a_momentum)
{
  constexpr double m = .178, length = 2.42, x = 2.34, y = .409;
  const std::string rope = R"(Gravity = 0, -1.25; Start = undeformed
Mass bob: Position = -2.34, -0.409; Motions = x, y; Mass = 0.178
Link rope: Type = dropper; From = ground @ 0, 0; To = bob; Turns = true; Length = 2.42;
  Stiffness = 5660
Time: Step = 0.05; End = 5
)";
  const double depth = std::sqrt(length * length - x * x),
               along = std::sqrt(2. * 1.25 * (depth - y)) * depth / length;
  const Fall fall = fall_of(rope);
  const double lacks = fall.summary.momentum / (m * along);
  figure("rope that does not rebound, momentum that it lacks over the exact one", lacks);
  EXPECT_GT(lacks, .95); // by the mean rate of its last step in flight, which is less
  EXPECT_LT(lacks, 1.2);
  EXPECT_LT(fall.summary.relative_energy, taut::ContactMeasures::suspicious_energy);
  ASSERT_EQ(fall.warnings.size(), 1) << fall.log;
  EXPECT_EQ(fall.warnings[0].kind, "contact_momentum");
  EXPECT_TRUE(has(fall.warnings[0].message, "the impulse of 'rope' may be off by"))
      << fall.warnings[0].message;

  const Fall swing = fall_of(rope, {"Time.End=200"});
  EXPECT_GE(swing.summary.relative_momentum, fall.summary.relative_momentum);
  figure("rope that does not rebound, momentum that it lacks over its impulse meanwhile",
         fall.summary.relative_momentum);
  EXPECT_TRUE(std::any_of(swing.warnings.begin(), swing.warnings.end(),
                          [](const auto &warning) { return warning.kind == "contact_momentum"; }))
      << swing.log;

  // A load holds the bob for 40 s, in which a mass of its group presses on a floor.
  const double busy = 40., mass = 1.;
  const Fall late = fall_of(rope + R"(
Load hold: On = bob; Direction = 0, 1; Magnitude = t < 40 ? 0.178 * 1.25 : 0
Mass pile: Position = -2.34, -9; Motions = y; Mass = 1
Link floor: Type = stop; From = ground; To = pile; Direction = 0, 1; Gap = 0
Link slack: Type = dropper; From = bob; To = pile; Turns = true; Length = 50
)",
                            {"Time.End=45"});
  EXPECT_GT(late.summary.momentum, .95 * m * along);
  EXPECT_LT(late.summary.momentum, taut::ContactMeasures::suspicious_momentum * mass * 1.25 * busy);
  figure("the same after 40 s, in which a mass of its group lies on a floor",
         late.summary.relative_momentum);
  ASSERT_EQ(late.warnings.size(), 1) << late.log;
  EXPECT_TRUE(has(late.warnings[0].message, "the impulse of 'rope' may be off by"))
      << late.warnings[0].message;
}
