// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: what is narrower than a step is never lost in silence: a run is right, or a warning names
// the load, place or height and the step that sees it. Source: the same scene in steps of a
// sixteenth of the feature; free vibration after an impulse.
#include "scene_tests.h"

using namespace verification;

namespace
{
  /// A mass of 1 kg on a spring of 400 N/m, under a load.
  std::string loaded_mass(const std::string &load)
  {
    return "Gravity = 0, 0; Start = given\n"
           "Mass m: Mass = 1\nSpring k: To = m; Stiffness = 400\n"
           "Load f: On = m; Magnitude = " +
           load + "\nProbe m: Point = m\nTime: Step = 1e-3; End = 1\n";
  }

  /// The same mass on a base that moves.
  std::string shaken_mass(const std::string &base)
  {
    return "Gravity = 0, 0; Start = given\n"
           "Mass base: Position = 0, -1; Motions = x; Mass = 1e-3; Prescribed y = " +
           base +
           "\nMass m: Motions = y; Mass = 1\nSpring k: From = base; To = m; Stiffness = 400\n"
           "Time: Step = 1e-3; End = 1\n";
  }

  /// A mass that slides along a stiff wire with heights.
  std::string over_heights(const std::string &heights)
  {
    return "Gravity = 0, 0\n"
           "Wire wire: To = 10, 0; Components = string; Mass per length = 1; Tension = 1e9;\n"
           "  Element size = 1\n"
           "Support ends: Wire = wire; Positions = 0, 10\n"
           "Mass m: Position = 1, 0; Mass = 5; Motions = y\n"
           "Spring k: From = ground; To = m; Stiffness = 2000\n"
           "Link contact: Type = sliding contact; From = m; To = wire @ 1; Direction = 0, 1;\n"
           "  Stiffness = 10000; Speed = 8; Height profile = " +
           heights + "\nLoad force: On = m; Magnitude = 60\nTime: Step = 1e-3; End = 1\n";
  }

  /// A wire with a support that moves, and a mass on it.
  std::string over_support(const std::string &place)
  {
    return "Gravity = 0, 0; Start = given\n"
           "Wire wire: To = 10, 0; Components = string; Mass per length = .1; Tension = 1e3;\n"
           "  Element size = 2.5\n"
           "Support ends: Wire = wire; Positions = 0\n"
           "Support mid: Wire = wire; Positions = 10; Displacement = " +
           place +
           "\nPoint mass m: Wire = wire; Positions = 5; Mass = 1\n"
           "Time: Step = 1e-3; End = 1\n";
  }

  /// A string under a load along it.
  std::string wire(const std::string &load)
  {
    return "Gravity = 0, 0\n"
           "Wire w: To = 40, 0; Components = string; Mass per length = 1; Tension = 10000;\n"
           "  Element size = 0.5; Mass damping = 0.5\n"
           "Support ends: Wire = w; Positions = 0, 40\n"
           "Load l: Type = distributed; On = w @ 0; Magnitude = 5*sin(3*t)+" +
           load + "\nTime: Step = 1e-3; End = 1\n";
  }

  /// The largest displacement of the last body at multiples of a step.
  std::vector<double> motion_of(const std::string &scene, const double step,
                                const Overrides &overrides, std::string *const log = nullptr)
  {
    std::vector<double> u;
    Session session(scene, overrides + Overrides{"Output.Link interval=0"});
    session.run(
        [&](const taut::StepView &view)
        {
          const double n = view.state.time / step;
          if (std::fabs(n - std::round(n)) > 1e-6)
            return;
          double largest = 0.;
          const std::size_t k = view.structure.size() - 1;
          for (const double x : view.state.U[k])
            raise(largest, x);
          u.push_back(largest);
        });
    if (log)
      *log = session.log();
    return u;
  }

  double largest_of(const std::vector<double> &u)
  {
    double largest = 0.;
    for (const double x : u)
      raise(largest, x);
    return largest;
  }

  /// The step that a warning names [s]; -1: none.
  double needed(const std::string &log)
  {
    const std::string mark = "Take a step of at most ";
    const std::size_t at = log.find(mark);
    return at == std::string::npos ? -1. : std::stod(log.substr(at + mark.size()));
  }
} // namespace

// Eight steps in a period are too few to see a base. A base that hardly moves the mass, by 25 um of
// 50 mm, needs no warning: shorter steps give the same motion. One at resonance keeps it.
TEST(UnseenFeatures, are_said_where_steps_that_see_them_give_another_motion)
{
  const std::string unseen = "which steps of";
  const std::string weak =
      log_of(shaken_mass("1e-3*sin(2*pi*t/8e-3)"), {"Network.Mass m.Initial velocity=0, 1, 0"});
  EXPECT_FALSE(has(weak, unseen)) << weak;
  EXPECT_TRUE(has(weak, "from runs with other steps")) << weak;
  const std::string strong =
      log_of(shaken_mass("1e-3*sin(20*t)"), {"Time.Step=0.039", "Time.End=3.9"});
  EXPECT_TRUE(has(strong, unseen)) << strong;
}

// 0.2 N s on 1 kg and 400 N/m: 10 mm. Steps of 1 ms see half or all of 1 N s.
TEST(UnseenFeatures, pulse_on_a_mass_at_rest)
{
  const std::string scene = loaded_mass("t > 0.1028 && t < 0.1032 ? 500 : 0");
  std::string log;
  motion_of(scene, 1e-3, {}, &log);
  EXPECT_TRUE(has(log, "Warning: the load on 'm' changes for about 0.0004 s at t = 0.1028 s"))
      << log;
  EXPECT_TRUE(has(log, "Steps: not checked, as something lies between them")) << log;
  const double step = needed(log);
  EXPECT_NEAR(step, 1e-3 / 128., 1e-8);
  const std::vector<double> u = motion_of(scene, step, {"Time.Step=" + number(step)}, &log);
  EXPECT_FALSE(has(log, "Warning")) << log;
  EXPECT_NEAR(
      figure("pulse of 0.4 ms in the step that a warning names, amplitude", largest_of(u), "m"),
      .01, 1e-3);
}

// A pulse of 2e-6 N s on a mass with 1 m/s: runs that see it, in steps of a 199th, give the same
// motion. Where they cost too much the pulse is named.
TEST(UnseenFeatures, pulse_that_hardly_moves_a_mass)
{
  const std::string scene = loaded_mass("t > 0.1028 && t < 0.1032 ? 5e-3 : 0");
  const Overrides moving = {"Network.Mass m.Initial velocity=0, 1, 0", "Time.End=0.5"};
  const std::string log = log_of(scene, moving);
  EXPECT_FALSE(has(log, "changes for about")) << log;
  EXPECT_TRUE(has(log, "from runs with other steps")) << log;
  const std::string longer = log_of(scene, moving + Overrides{"Time.End=10"});
  EXPECT_TRUE(has(longer, "changes for about 0.0004 s")) << longer;
  EXPECT_TRUE(has(longer, "Steps: not checked, as something lies between them")) << longer;
}

// A block of 30 ms, and a smooth pulse of 10 ms, which needs steps of some milliseconds: the step
// that is named is that of the block, whose ends need more.
TEST(UnseenFeatures, the_step_that_is_named_sees_the_wider_features_too)
{
  const std::string block = loaded_mass("t > .6 && t < .63 ? 5 : 0"),
                    pulse = "Load g: On = m; Magnitude = 5*exp(-((t-.3)/6e-3)^2)\n";
  const std::string log = log_of(block + pulse, {"Time.Step=0.025"});
  EXPECT_TRUE(has(log, "changes for about 0.0053 s at t = 0.3 s")) << log;
  const double step = needed(log);
  ASSERT_GT(step, 0.) << log;
  EXPECT_FALSE(has(log_of(block, {"Time.Step=" + number(step)}), "changes for about")) << step;
}

// The larger pulse, at the end, moves nothing: steps that see it and lose the other one, of 0.1 N
// s, agree with the run.
TEST(UnseenFeatures, a_pulse_does_not_hide_a_narrower_one)
{
  const std::string log =
      log_of("Gravity = 0, 0\nMass m: Motions = y; Mass = 1\nSpring k: To = m; Stiffness = 100\n"
             "Load f: On = m; Magnitude = 10*sin(10*t)+29.5*exp(-((t-.295)/3.33e-3)^2)\n"
             "  +2000*(abs(t-.16749)<2.5e-5)\nTime: Step = 1e-2; End = .3\n");
  EXPECT_TRUE(has(log, "the load on 'm' changes for about 5.1e-05 s at t = 0.1675 s")) << log;
  EXPECT_LT(needed(log), 2.5e-6) << log;
}

TEST(UnseenFeatures, pulse_beside_a_slow_load)
{
  std::string log;
  motion_of(loaded_mass("4*sin(13*t)+(t > 0.1021 && t < 0.1029 ? 250 : 0)"), 1e-3, {}, &log);
  EXPECT_TRUE(has(log, "Warning: the load on 'm' changes for about 0.0008 s")) << log;
}

// A load that is gone at the end of the first step acts in full: 1.8 N s move the mass by 90 mm,
// and the first triangle has as much above the line between the ends of the step as below. Steps
// see its value at the end alone.
TEST(UnseenFeatures, pulses_of_the_first_step)
{
  for (const std::string load : {"(t < 0.0009 ? 2000 : 0)", "(t < 0.0009 ? 2000 : 0)+4*sin(13*t)",
                                 "2000*max(0, 1-t/1e-3)", "2000*exp(-(t/1e-4)^2)"})
  {
    std::string log;
    motion_of(loaded_mass(load), 1e-3, {}, &log);
    EXPECT_TRUE(has(log, "Warning: the load on 'm' changes for about")) << load << log;
  }
  std::string log;
  const double step = 1e-5, u = largest_of(motion_of(loaded_mass("(t < 0.0009 ? 2000 : 0)"), step,
                                                     {"Time.Step=1e-5"}, &log));
  EXPECT_FALSE(has(log, "Warning")) << log;
  EXPECT_NEAR(u, .09, .01 * .09);
}

// Opposite pulses of 20 N s, half a millisecond apart, move the mass by 10 mm and leave no
// velocity.
TEST(UnseenFeatures, opposite_pulses_in_a_step)
{
  const std::string pulses =
      "0.5*sin(5*t)+(t > 0.2002 && t < 0.2003 ? 2e5 : 0)-(t > 0.2007 && t < 0.2008 ? 2e5 : 0)";
  std::string log;
  motion_of(loaded_mass(pulses), 1e-3, {}, &log);
  EXPECT_TRUE(has(log, "Warning: the load on 'm' changes for about")) << log;
  const double u = largest_of(motion_of(loaded_mass(pulses), 1e-3, {"Time.Step=1e-5"}));
  EXPECT_NEAR(u, .0115, 1e-3);
}

// A pulse that the ends around it do not announce counts by itself: 0.7 N s are 1.75 % of what the
// slow load has in forty steps, and a tenth of the motion; a bump of a base closes a gap alone.
TEST(UnseenFeatures, small_pulses_beside_a_slow_motion)
{
  std::string log;
  motion_of(loaded_mass("100*sin(3*t)+(t > 0.5002 && t < 0.5004 ? 3500 : 0)"), 1e-2,
            {"Time.Step=1e-2", "Time.End=2"}, &log);
  EXPECT_TRUE(has(log, "Warning: the load on 'm' changes for about")) << log;
  log = log_of(
      "Gravity = 0, 0; Start = given\n"
      "Mass base: Position = 0, -1; Motions = x; Mass = 1;\n"
      "  Prescribed y = -0.0455+0.0545*sin(13*t)+0.005*exp(-((t-0.1204)/0.0001)^2)\n"
      "Mass m: Mass = 1\n"
      "Spring k: To = m; Stiffness = 400; Damping = 1\n"
      "Link l: Type = stop; From = base; To = m; Direction = 0, 1; Gap = 0.01; Stiffness = rigid\n"
      "Time: Step = 1e-3; End = 1\n");
  EXPECT_TRUE(has(log, "Warning: the prescribed place of 'base' changes for about")) << log;
}

// A bending load at the end of a solid has neither a resultant nor a value in the middle.
// Loads in space are looked at in so many places that a pulse on a part of a body is among them.
TEST(UnseenFeatures, pulses_on_a_part_of_a_body)
{
  const std::string pulse = "(abs(t-0.05034) < 2e-5 ? 1 : 0)";
  for (const std::string &pressure : {"3: 1e4*sin(30*t)+(x > 1.2 ? 1e8 : 0)*" + pulse,
                                      "3: 1e4*sin(30*t)+exp(-((x-1.6)/0.1)^2)*1e8*" + pulse,
                                      "3: 1e4*sin(30*t); 1: (y > 0.7 ? 1e8 : 0)*" + pulse})
    for (const std::string mesh : {"4, 2", "16, 8"})
    {
      const std::string log =
          log_of("Generator = network; Gravity = 0, 0; Start = given\n"
                 "Body b: Type = solid; Young's modulus = 2e9; Density = 2000; Degree = 2;\n"
                 "  Mass damping = 5; Fixed boundaries = 0\n"
                 "Body b/Mesh: Arguments = " +
                     mesh + " : 0, 0 : 2, 1\nTime: Step = 1e-4; End = 0.1\n",
                 {"Body b.Pressure=" + pressure});
      EXPECT_TRUE(has(log, "Warning: the load on 'b' changes for about")) << pressure << log;
    }
  for (const std::string load :
       {"(abs(s-20.3) < 0.3 ? (abs(t-0.50037) < 2e-4 ? 1e6 : 0) : 0)",
        "(abs(s-20.3) < 1 ? (abs(t-0.50037) < 2e-4 ? 3e5 : 0) : 0)",
        "(abs(s-20.3+10*(t-0.5)) < 0.3 ? 1e6 : 0)*(abs(t-0.50037) < 2e-4 ? 1 : 0)"})
  {
    const std::string log = log_of(wire(load), {});
    EXPECT_TRUE(has(log, "Warning: the load on 'w")) << load << log;
    EXPECT_FALSE(has(log, "Step control = adaptive")) << load << log;
    EXPECT_TRUE(
        has(log_of(wire(load), {"Time.Step control=adaptive"}), "which adaptive steps do not see"))
        << load;
  }
}

// The edges of a block that moves pass the places at which a load is looked at: it is no pulse.
TEST(UnseenFeatures, a_block_that_moves_is_no_pulse)
{
  const std::string block = "(abs(s-5-30*t) < 0.3 ? 1000 : 0)";
  for (const std::string control : {"fixed", "adaptive"})
  {
    const std::string log = log_of(
        wire(block), {"Time.Step=4e-3", "Time.Step control=" + control, "Time.Check steps=yes"});
    EXPECT_FALSE(has(log, "changes for about")) << log;
  }
}

TEST(UnseenFeatures, traction_without_a_resultant)
{
  const std::string log = log_of(
      "Generator = network; Gravity = 0, 0; Start = given\n"
      "Body bar: Type = solid; Young's modulus = 1e6; Poisson's ratio = 0.3; Density = 1000;\n"
      "  Fixed boundaries = 0;\n"
      "  Traction = 1: 1000*sin(9*t)+(t > 0.2003 && t < 0.2004 ? 5e6*(y-0.1) : 0), 0\n"
      "Body bar/Mesh: Generator = subdivided_hyper_rectangle;\n"
      "  Arguments = 8, 2 : 0, 0 : 1, 0.2\n"
      "Time: Step = 1e-3; End = 0.5\n",
      {});
  EXPECT_TRUE(has(log, "Warning: the load on 'bar' changes for about")) << log;
}

// What steps see is no pulse: jumps, vibrations of fifteen steps, a pulse of ten.
TEST(UnseenFeatures, what_steps_see_is_not_warned_of)
{
  for (const std::string load :
       {"t < 0.3005 ? 0 : 5", "sin(418*t)", "exp(-((t-.3)/5e-3)^2)", "3", "t < .20003 ? 9*t : 2",
        "cos(418*t)", "exp(-t/20e-3)", "t < 0.05 ? 500-100*t : 0"})
  {
    std::string log;
    motion_of(loaded_mass(load), 1e-3, {}, &log);
    EXPECT_FALSE(has(log, "changes for about")) << load << log;
  }
  for (const std::string scheme : {"generalised-alpha", "Moreau-Jean"})
  {
    const std::string log =
        log_of(loaded_mass("500 + 0.1*t"), {"Time.End=0.01", "Time.Scheme=" + scheme});
    EXPECT_FALSE(has(log, "changes for about")) << scheme << log;
  }
}

TEST(UnseenFeatures, accuracy_and_adaptive_steps_see_a_spike)
{
  const std::string spike = loaded_mass("400*exp(-((t-1.00031)/5e-5)^2)+sin(5*t)");
  const Overrides longer = {"Time.End=2", "Time.Step=2e-3"};
  const double exact = largest_of(motion_of(spike, 2e-3, longer + Overrides{"Time.Step=2e-6"}));
  const double adaptive = largest_of(motion_of(
      spike, 2e-3,
      longer + Overrides{"Time.Step control=adaptive", "Time.Adaptive step.Doublings=0"}));
  EXPECT_NEAR(adaptive, exact, .01 * exact);
}

// Pulses of three shapes and random widths from 1e-4 s on, heights, places and signs, some beside a
// slow motion.
TEST(UnseenFeatures, random_features_are_seen_or_warned_of)
{
  const char *const given = std::getenv("TAUT_FEATURES");
  const int n_features = given ? std::atoi(given) : 60;
  std::mt19937_64 random(47);
  const auto uniform = [&](const double a, const double b)
  { return a + (b - a) * std::ldexp(static_cast<double>(random() >> 11), -53); };
  int n_right = 0, n_warned = 0, n_both = 0;
  for (int i = 0; i < n_features; ++i)
  {
    const int family = i % 4, shape = static_cast<int>(uniform(0., 3.));
    const double width = std::pow(10., uniform(-4., -1.5)), at = uniform(.1, .6),
                 height = std::pow(10., uniform(0., 1.)), step = std::pow(10., uniform(-3.5, -2.5));
    const bool is_adaptive = uniform(0., 1.) < .3;
    std::string x = "((t-" + number(at) + ")/" + number(width) + ")";
    if (family == 2)
      x = "((s-" + number(1. + 8. * at) + ")/" + number(8. * width) + ")";
    std::string pulse = shape == 0   ? "(abs(" + x + ")<.5?1:0)"
                        : shape == 1 ? "exp(-" + x + "^2)"
                                     : "max(0,1-abs(" + x + "))";
    pulse = number((family == 0 ? 50. : 1e-2) * height) + "*" + pulse;
    if (uniform(0., 1.) < .5)
      pulse += family == 0 ? "+2*sin(13*t)" : family == 2 ? "+1e-3*sin(2*s)" : "+1e-3*(1-cos(9*t))";
    const std::string scene = family == 0   ? loaded_mass(pulse)
                              : family == 1 ? shaken_mass(pulse)
                              : family == 2 ? over_heights(pulse)
                                            : over_support(pulse);
    SCOPED_TRACE(std::to_string(i) + ": " + pulse + ", step " + number(step) +
                 (is_adaptive ? ", adaptive" : ""));
    Overrides coarse = {"Time.Step=" + number(step)};
    if (is_adaptive)
      coarse = coarse + Overrides{"Time.Step control=adaptive", "Time.Adaptive step.Doublings=0"};
    const int finer = std::max(1, static_cast<int>(std::ceil(std::log2(step / (width / 16.)))));
    std::string log;
    std::vector<double> u;
    const std::string refused = error_of([&] { u = motion_of(scene, step, coarse, &log); });
    if (!refused.empty())
    {
      ++n_warned;
      continue;
    }
    const std::vector<double> exact = motion_of(
        scene, step, {"Time.Step=" + number(std::ldexp(step, -finer)), "Time.Check steps=no"});
    double error = 0.;
    for (std::size_t k = 0; k < std::min(u.size(), exact.size()); ++k)
      raise(error, u[k] - exact[k]);
    const bool is_right = error <= .05 * largest_of(exact), is_warned = has(log, "Warning");
    n_right += is_right;
    n_warned += is_warned;
    n_both += is_right && is_warned;
    EXPECT_TRUE(is_right || is_warned) << "silent, error " << error / largest_of(exact)
                                       << ", pulse of " << width / step << " steps\n"
                                       << log;
  }
  figure("random features that are right", n_right);
  figure("random features that are warned of", n_warned);
  figure("random features that are right and warned of", n_both);
}
