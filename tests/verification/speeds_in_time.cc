// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: a speed that changes in time moves contacts, loads and pantographs along its integral.
// Sources: a constant speed as a number, and two in turn; an accelerated force on a string in
// closed form.
#include "scene_tests.h"

using namespace verification;

namespace
{
  constexpr double tension = 400., mass = 1., force = 10., begin = 60., acceleration = 4.;
  const double c = std::sqrt(tension / mass);

  std::string string_under_load(const std::string &speed)
  {
    return R"(Gravity = 0, 0; Start = undeformed
Wire string: To = 140, 0; Components = string; Mass per length = 1; Tension = 400;
  Element size = 0.1; Degree = 2
Support ends: Wire = string; Positions = 0, 140
Load push: Type = moving; On = string @ 60; Magnitude = 10; Speed = )" +
           speed + R"(
Time: Scheme = Newmark; Step = 1e-3; End = 2
)";
  }

  /// u = F tau/(2 m c): the force pushed from t = 0 to the time tau whose waves arrive now.
  double exact(const double x, const double t)
  {
    const double tau = end_of(0., t,
                              [&](const double time)
                              {
                                const double p = begin + .5 * acceleration * time * time;
                                return std::fabs(x - p) <= c * (t - time);
                              });
    const double latest = std::fabs(x - begin) <= c * t ? tau : 0.;
    return force * latest / (2. * mass * c);
  }

  TEST(SpeedInTime, accelerated_force_on_a_string)
  {
    double error = 0., size = 0.;
    run_scene(string_under_load("4*t"), {},
              [&](const taut::StepView &view)
              {
                if (view.state.time < 1.)
                  return;
                for (const double x : {52., 60., 62.3, 65., 67.5, 68., 71., 80.})
                {
                  const double u = exact(x, view.state.time);
                  raise(error, displacement(view, 0, x) - u);
                  raise(size, u);
                }
              });
    figure("accelerated force on a string, error over the largest displacement", error / size);
    EXPECT_NEAR(size, force * 2. / (2. * mass * c), .02 * size);
    EXPECT_LT(error, 2e-3 * size);
  }

  TEST(SpeedInTime, a_run_in_pieces)
  {
    // The speed jumps from 4 to 8 m/s inside of a step: two forces of constant speed in turn, the
    // second of which comes from where it takes over.
    const double jump = 1.0005;
    const std::string at = number(jump);
    const auto probed = [](const std::string &scene)
    {
      return history_of(scene, {},
                        [](const taut::StepView &view)
                        {
                          double sum = 0.;
                          for (const double x : {50., 62., 66.5, 71.})
                            sum += x * displacement(view, 0, x);
                          return sum;
                        });
    };
    const std::vector<double> whole = probed(string_under_load("if(t < " + at + ", 4, 8)")),
                              pieces =
                                  probed(string_under_load("4") + "Load push: Magnitude = if(t < " +
                                         at + ", 10, 0)\nLoad then: Type = moving; On = string @ " +
                                         number(begin - 4. * jump) +
                                         "; Speed = 8; Magnitude = if(t < " + at + ", 0, 10)\n"),
                              constant = probed(string_under_load("4"));
    EXPECT_LT(largest_difference(whole, pieces), 1e-10 * largest(whole));
    EXPECT_GT(largest_difference(whole, constant), 1e-2 * largest(whole));
  }

  std::string roller(const std::string &speed)
  {
    return R"(Gravity = 0, 0; Start = equilibrium
Wire wire: To = 10, 0; Components = string; Mass per length = 1; Tension = 1000; Element size = 0.5
Support ends: Wire = wire; Positions = 0, 10
Mass mass: Position = 1, 0; Mass = 5; Motions = y
Spring spring: From = ground; To = mass; Stiffness = 2000
Link contact: Type = sliding contact; From = mass; To = wire @ 1; Direction = 0, 1;
  Stiffness = 10000; Height profile = 1e-3*(1-cos(pi*(s-1))); Speed = )" +
           speed + R"(
Load force: Type = point; On = mass; Magnitude = 60
Time: Scheme = generalised-alpha; Step = 1e-2; End = 2
)";
  }

  /// Sum of the forces of all constraints, or displacements of a wire where there is none.
  std::vector<double> history(const std::string &scene, const Overrides &overrides = {})
  {
    return history_of(scene, overrides,
                      [](const taut::StepView &view)
                      {
                        const std::vector<double> &N = view.state.multiplier;
                        return N.empty() ? displacement(view, 0, 65.)
                                         : std::accumulate(N.begin(), N.end(), 0.);
                      });
  }

  TEST(SpeedInTime, constant_formulas_are_numbers)
  {
    const Overrides brief = {"Time/End=0.3", "Statistics/Window="};
    const Overrides short_run = {"Time/End=0.05", "Statistics/Window="};
    const std::string line = scene_file("en50318_2002_250"), overlap = scene_file("real_line"),
                      entry = "Catenary/Pantograph pantograph/Speed=";
    const std::vector<std::pair<std::vector<double>, std::vector<double>>> pairs = {
        {history(roller("4")), history(roller("4 + 0*t"))},
        {history(string_under_load("4")), history(string_under_load("4 + 0*t"))},
        {history(line, brief), history(line, brief + Overrides{entry + "250 + 0*t"})},
        {history(overlap, short_run),
         history(overlap, short_run + Overrides{"Catenary/Pantograph leading/Speed=160 + 0*t",
                                                "Catenary/Pantograph trailing/Speed=160 + 0*t"})}};
    for (const auto &[number, formula] : pairs)
    {
      EXPECT_GT(largest(number), 0.);
      EXPECT_LT(largest_difference(number, formula), 1e-11 * largest(number));
    }
  }

  TEST(SpeedInTime, contact_is_where_its_way_ends)
  {
    double error = 0.;
    run_scene(roller("4*t"), {},
              [&](const taut::StepView &view)
              {
                const double t = view.state.time;
                raise(error, view.constraints.position(0, t) - (1. + 2. * t * t));
              });
    EXPECT_LT(error, 1e-12 * 9.);
  }

  TEST(SpeedInTime, contacts_stay_on_their_wires)
  {
    const auto refused = [](const std::string &scene, const Overrides &overrides = {})
    { return error_of([&] { Session(scene, overrides); }); };
    const std::string end = refused(roller("5*t"));
    EXPECT_TRUE(has(end, "Network/Link contact/Speed")) << end;
    EXPECT_TRUE(has(end, "from 1 to 11 m of 10 m. Set Time/End to 1.897366596")) << end;
    const std::string back = refused(roller("1 - 3*t"));
    EXPECT_TRUE(has(back, "it leaves its wire")) << back;
    EXPECT_EQ(refused(roller("8*(1 - t)")), "") << "4 m there, and back again";
    EXPECT_TRUE(
        has(refused(roller("8*(1 - t)"), {"Statistics/Window=6, 9"}), "goes from 1 to 1 m"));
    EXPECT_EQ(refused(roller("8*(1 - t)"), {"Statistics/Window=4, 9"}), "");
    EXPECT_TRUE(has(refused(roller("fast")), "Network/Link contact/Speed"));
    EXPECT_TRUE(has(refused(roller("s")), "Network/Link contact/Speed"));
    EXPECT_TRUE(has(refused(roller("1/t")), "is not finite"));
  }

  TEST(SpeedInTime, fast_contacts_are_warned_of)
  {
    const std::string fast = string_under_load("12*t; Faster than waves = true");
    EXPECT_TRUE(has(log_of(fast, {"Time/Step=1e-2"}), "faster than the waves"));
    const std::string slow = string_under_load("9*t");
    EXPECT_FALSE(has(log_of(slow, {"Time/Step=1e-2"}), "faster than the waves"));
  }

  /// Time and place at the end of a run.
  std::pair<double, double> last(const std::string &scene, const std::string &end)
  {
    std::pair<double, double> result;
    run_scene(scene, {"Time/End=" + end},
              [&](const taut::StepView &view) {
                result = {view.state.time, view.constraints.position(0, view.state.time)};
              });
    return result;
  }

  TEST(EndOfRun, where_a_contact_comes_to)
  {
    const auto [time, place] = last(roller("4"), "until x = 5 m");
    EXPECT_NEAR(time, 1., 1e-12);
    EXPECT_NEAR(place, 5., 1e-12);
    const auto [later, there] = last(roller("4*t"), "until x = 3");
    EXPECT_NEAR(later, 1., 1e-12);
    EXPECT_NEAR(there, 3., 1e-12);
  }

  TEST(EndOfRun, errors_say_why_there_is_none)
  {
    const auto refused = [](const std::string &scene, const std::string &end)
    { return error_of([&] { Session(scene, {"Time/End=" + end}); }); };
    const auto says = [](const std::string &text, const std::string &part)
    { return has(text, "Time/End") && has(text, part); };
    EXPECT_PRED2(says, refused(roller("4"), "until x = 0.5 m"), "never comes to x = 0.5 m");
    EXPECT_PRED2(says, refused(roller("8*(1-t)"), "until x = 6 m"), "never comes to x = 6 m");
    EXPECT_PRED2(says, refused(roller("0"), "until x = 6 m"), "with 0 m/s along x");
    EXPECT_PRED2(says, refused(string_under_load("4"), "until x = 6 m"), "nothing slides");
    EXPECT_PRED2(says, refused(roller("4"), "until 6 m"), "is no end; write a time");
    EXPECT_PRED2(says, refused(roller("4"), "-1"), "not negative");
  }
} // namespace
