// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: contacts that a step does not resolve keep their energy; parallel links, joined masses and
// the way of moving contacts count in the choice of the scheme; a link with a damper is met by
// shorter steps; and what a link gives or takes is compared with what it is connected with.
// Sources: free fall and the oscillation of a mass on a spring in closed form, runs with a smaller
// step.
#include "scene_tests.h"

using namespace verification;

namespace
{

  constexpr double height = .05; // [m]

  /// A mass of 1 kg that falls from there onto a stop.
  std::string falling_mass(const std::string &stop, const double step, const std::string &more = "")
  {
    return R"(Gravity = 0, -9.81; Start = given
Mass mass: Position = 0, 0.05; Motions = y; Mass = 1
Link stop: Type = stop; To = mass; Direction = 0, 1; Gap = 0.05; )" +
           stop + "\nTime: End = 0.2; Step = " + number(step) + "\n" + more;
  }

  /// Motion of the mass, contacts with a spring k in closed form: falls, half-waves about -g/w^2.
  double exact_motion(const double k, double t)
  {
    const double fall = std::sqrt(2. * height / g), v = std::sqrt(2. * height * g),
                 w = std::sqrt(k), sag = g / (w * w), amplitude = std::hypot(sag, v / w),
                 phase = std::atan2(v / w, sag), contact = 2. * (std::acos(-1.) - phase) / w;
    if (t < fall)
      return -.5 * g * t * t;
    t = std::fmod(t - fall, contact + 2. * v / g);
    if (t < contact)
      return -height - sag + amplitude * std::cos(w * t + phase);
    t -= contact;
    return -height + v * t - .5 * g * t * t;
  }

  /// The end of a run, and its log.
  struct Result
  {
    double end = 0., energy = 0.;
    std::vector<std::pair<double, double>> motion; ///< times [s], places [m]
    std::string log, error;
  };
  Result run(const std::string &text, const Overrides &overrides = {})
  {
    Result result;
    Session session(text, overrides);
    const Callback record = [&](const taut::StepView &view)
    {
      result.end = view.state.U[0][0];
      result.motion.push_back({view.state.time, result.end});
      result.energy = view.measures.summary().relative_energy;
    };
    result.error = error_of([&] { session.run(record); });
    result.log = session.log();
    return result;
  }
} // namespace

// The contact on 1e7 N/m lasts 0.99 ms, one step; on 1e9 N/m a tenth of a step.
TEST(ResolvedContacts, a_mass_rebounds_from_a_stop_that_is_stiff_for_the_step)
{
  for (const double k : {1e5, 1e7, 1e9})
    for (const double step : {1e-3, 1e-4})
    {
      const Result r = run(falling_mass("Stiffness = " + number(k), step));
      const double error = std::fabs(r.end - exact_motion(k, .2)) / height;
      double largest = 0.;
      for (const auto &[t, place] : r.motion)
        raise(largest, (place - exact_motion(k, t)) / height);
      const std::string what = "drop of 50 mm on " + number(k) + " N/m, step " + number(step);
      figure(what + " s, error over the drop", error);
      figure(what + " s, largest error of all times over the drop", largest);
      EXPECT_LT(error, .02) << k << ' ' << step << ' ' << r.log;
      EXPECT_LT(largest, .05) << k << ' ' << step << ' ' << r.log;
      EXPECT_LT(r.energy, k == 1e5 ? .01 : 1e-9);
      // An impact that is late by a step of 1 ms is an error of 2 %, of which a run may warn.
      EXPECT_TRUE(largest >= .01 || !has(r.log, "Warning")) << r.log;
    }
}

// 100 stops of 1e6 N/m are one of 1e8 N/m: each alone would be resolved.
TEST(ResolvedContacts, links_in_parallel_count_together)
{
  std::string text;
  for (int i = 1; i < 100; ++i)
    text += "Link stop" + std::to_string(i) +
            ": Type = stop; To = mass; Direction = 0, 1; Gap = 0.05; Stiffness = 1e6\n";
  const Result r = run(falling_mass("Stiffness = 1e6", 1e-3, text));
  const double error = std::fabs(r.end - exact_motion(1e8, .2)) / height;
  figure("drop of 50 mm on 100 stops of 1e6 N/m, step 1 ms, error over the drop", error);
  EXPECT_LT(error, .005) << r.log << r.error;
}

// Stops above and below never close together: they count each for itself.
TEST(ResolvedContacts, opposite_links_do_not_count_together)
{
  // 0.01 of the ratio of a resolved contact each; together they would have 0.02.
  const std::string text =
      R"(Gravity = 0, 0; Start = given
Mass mass: Position = 0, 0; Motions = y; Mass = 1; Initial velocity = 0, 1, 0
Link floor: Type = stop; From = ground; To = mass; Direction = 0, 1; Gap = 0.01; Stiffness = 39000
Link roof: Type = stop; From = mass; To = ground; Direction = 0, 1; Gap = 0.01; Stiffness = 39000
Time: Step = 1e-3; End = 0.01
)";
  const Result r = run(text);
  EXPECT_TRUE(has(r.log, "generalised-alpha")) << r.log;
}

// Restitution of a spring and damper side by side that only push, without gravity, as the contact
// ends where the force is zero.
TEST(ResolvedContacts, a_link_with_a_damper_is_met_by_shorter_steps)
{
  const double k = 1e7, m = 1., w0 = std::sqrt(k / m);
  for (const double zeta : {.02, .1, .3})
  {
    const double beta = zeta * w0, w = w0 * std::sqrt(1. - zeta * zeta),
                 exact = std::exp(
                     -beta / w * (std::acos(-1.) - std::atan2(2. * beta * w, w * w - beta * beta)));
    const std::string text =
        R"(Gravity = 0, 0; Start = given
Mass mass: Position = 0, 0; Motions = y; Mass = 1; Initial velocity = 0, -1, 0
Link stop: Type = stop; From = ground; To = mass; Direction = 0, 1; Gap = 0.0123;
  Stiffness = 1e7; Damping = )" +
        number(2. * zeta * std::sqrt(k * m)) + R"(
Time: Step = 1e-3; End = 0.03
)";
    double velocity = 0., last = 0.;
    run_scene(text, {},
              [&](const taut::StepView &view)
              {
                velocity = view.state.V[0][0];
                last = view.state.time;
              });
    figure("stop with damper, ratio " + number(zeta) + ", restitution", velocity);
    EXPECT_NEAR(last, .03, 1e-12);
    EXPECT_NEAR(velocity, exact, .02 * exact) << zeta;
  }
}

namespace
{
  /// Velocity with which a mass of 1 kg leaves a law with a damper beside it that it meets with 1
  /// m/s, where both together stop to push: classical Runge-Kutta steps.
  double rebound(const std::function<double(double)> &force, const double damping)
  {
    constexpr double h = 1e-6;
    const auto a = [&](const double u, const double v) { return -force(u) - damping * v; };
    double u = 0., v = 1.;
    do
    {
      const double a1 = a(u, v), v2 = v + .5 * h * a1, a2 = a(u + .5 * h * v, v2),
                   v3 = v + .5 * h * a2, a3 = a(u + .5 * h * v2, v3), v4 = v + h * a3,
                   a4 = a(u + h * v3, v4);
      u += h / 6. * (v + 2. * v2 + 2. * v3 + v4);
      v += h / 6. * (a1 + 2. * a2 + 2. * a3 + a4);
    } while (a(u, v) < 0.);
    return v;
  }

  struct Met
  {
    double velocity = 0.;
    int n_steps = -1;
  };

  Met meet(const std::string &law, const double damping)
  {
    Met result;
    run_scene(R"(Gravity = 0, 0; Start = given
Mass mass: Position = 0, 0; Motions = y; Mass = 1; Initial velocity = 0, -1, 0
Link stop: Type = stop; From = ground; To = mass; Direction = 0, 1; Gap = 0.0123; )" +
                  law + "; Damping = " + number(damping) + "\nTime: Step = 1e-3; End = 0.06\n",
              {},
              [&](const taut::StepView &view)
              {
                result.velocity = view.state.V[0][0];
                ++result.n_steps;
              });
    return result;
  }
} // namespace

// Of 1e4 N/m the mass compresses 10 mm; a contact lasts 31 steps then. At the end of each law waits
// a stiffness that takes thousands of steps.
TEST(ResolvedContacts, steps_follow_the_stiffness_that_a_law_reaches)
{
  const double c = 20.;
  const Met soft = meet("Law = table; Law points = 0.02: 200, 0.021: 1e6", c),
            formula =
                meet("Law = formula; Law formula = 50 * (exp(d / 0.005) - 1); Law range = 0.1", c),
            stiff = meet("Law = table; Law points = 0.005: 50, 0.02: 15050, 0.021: 1e6", c);
  EXPECT_EQ(soft.n_steps, 60);
  EXPECT_NEAR(soft.velocity, -rebound([](const double u) { return 1e4 * u; }, c), .02);
  EXPECT_LT(formula.n_steps, 300);
  EXPECT_NEAR(formula.velocity,
              -rebound([](const double u) { return 50. * (std::exp(u / .005) - 1.); }, c), .02);
  EXPECT_GT(stiff.n_steps, 90);
  EXPECT_LT(stiff.n_steps, 600);
  EXPECT_NEAR(stiff.velocity,
              -rebound([](const double u) { return 1e4 * u + 9.9e5 * std::max(0., u - .005); }, c),
              .02);
}

// Three masses on springs above a base that moves. A law with a damper between two of them is of
// 2.75e9 N/m at the end of its range, 10 mm, of which the motion needs a tenth.
TEST(ResolvedContacts, law_with_damper)
{
  int n_steps = -1;
  double deepest = 0.;
  run_scene(R"(Gravity = 0, 0; Start = given
Mass base: Position = 0, -1; Motions = x; Mass = 1; Prescribed y = 0.01 * sin(6 * t)
Mass m0: Position = 0, 0; Motions = y; Mass = 0.676
Mass m1: Position = 0, 1; Motions = y; Mass = 0.872
Mass m2: Position = 0, 2; Motions = y; Mass = 1.308
Spring s0: From = base; To = m0; Stiffness = 1251.5
Spring s1: From = m0; To = m1; Stiffness = 4732.3
Spring s2: From = m1; To = m2; Stiffness = 4912.6
Link l0: Type = stop; From = m1; To = m2; Direction = 0, 1; Gap = -0.000722; Damping = 15.2719
  ; Law = formula; Law formula = 124.8595551 * (exp(d / 0.001) - 1); Law range = 0.01
Link l1: Type = stop; From = ground; To = m1; Direction = 0, 1; Gap = -0.000958
  ; Stiffness = 1514.90675862
Time: Step = 0.0014; End = 0.28
)",
            {},
            [&](const taut::StepView &view)
            {
              ++n_steps;
              deepest = std::min(deepest, view.state.distance[0]);
            });
  figure("law with damper, steps for 200", n_steps);
  figure("law with damper, compression", -1e3 * deepest, "mm");
  EXPECT_LT(n_steps, 20 * 200);
  EXPECT_GT(-deepest, .7e-3);
}

// The spring of a contact that has opened comes back with c u' = -f(u), while its mass flies on.
TEST(ResolvedContacts, a_spring_with_a_law_and_a_damper_comes_back_slowly)
{
  const auto force = [](const double u) { return 137. * u + 569000. * u * u * u; };
  constexpr double damping = 26.;
  double time = 0., opened = -1., u = 0., exact = 0.;
  bool was_closed = false;
  run_scene(R"(Gravity = 0, 0; Start = given
Mass m: Motions = y; Mass = 0.54; Initial velocity = 0, -0.3, 0
Link floor: Type = stop; From = ground; To = m; Direction = 0, 1; Gap = 0.005; Law = formula;
  Law formula = 137*d + 569000*d^3; Law range = 0.155; Damping = 26
Time: Step = 5e-4; End = 0.3
)",
            {},
            [&](const taut::StepView &view)
            {
              u = view.state.springs[0].u;
              const bool is_closed = view.state.multiplier[0] > 0.;
              if (was_closed && !is_closed)
              {
                opened = view.state.time;
                exact = u;
              }
              else if (opened > 0.)
              {
                const double dt = view.state.time - time,
                             middle = exact - .5 * dt * force(exact) / damping;
                exact -= dt * force(middle) / damping;
              }
              was_closed = is_closed;
              time = view.state.time;
            });
  EXPECT_GT(opened, 0.);
  EXPECT_LT(opened, .2);
  EXPECT_GT(figure("spring that comes back, compression at the end", u, "m"), 5e-4);
  EXPECT_NEAR(u, exact, .01 * exact);
}

// A beam of ten metres falls flat on 41 stops; most of its mass stands above one.
TEST(ResolvedContacts, a_beam_that_falls_flat_keeps_its_energy)
{
  const auto height_after = [](const std::string &step, const std::string &scheme)
  {
    return history_of(R"(Gravity = 0, -9.81; Start = given
Wire beam: To = 10, 0; Components = beam; Mass per length = 1; Bending stiffness = 1000;
  Element size = 0.25
Link stop: Type = stop; From = ground; To = beam @ 0:0.25:10; Direction = 0, 1; Gap = 0.05;
  Stiffness = 1e6
Time: End = 0.2; Step = )" +
                          step + "\n",
                      {"Time.Scheme=" + scheme, "Time.Allow unsuitable scheme=true",
                       "Time.Allow energy gain=true"},
                      [](const taut::StepView &view)
                      {
                        double mean = 0.;
                        for (int i = 0; i < 40; ++i)
                          mean += displacement(view, 0, .125 + .25 * i) / 40.;
                        return mean;
                      })
        .back();
  };
  const double exact = exact_motion(1e6 * 41. / 10., .2),
               fine = height_after("2.5e-5", "generalised-alpha");
  for (const std::string step : {"1e-3", "5e-3"})
  {
    const double chosen = height_after(step, "automatic");
    figure("flat beam on stops of 1e6 N/m, step " + step + " s, error over the drop",
           std::fabs(chosen - fine) / .05);
    EXPECT_NEAR(chosen, fine, .05 * .05) << "a rigid beam has " << exact;
  }
}

// A wire ends on a rigid stop; a mass that is joined to the node makes it heavy.
TEST(ResolvedContacts, a_node_with_a_joined_mass_keeps_its_mass)
{
  const std::string text =
      R"(Gravity = 0, 0; Start = given
Wire bar: From = 0, 0; To = 0, 10; Components = bar; Mass per length = 1;
  Axial stiffness = 10000; Element size = 0.25; Initial axial velocity = -1
Mass block: Position = 0, 0; Motions = y; Mass = 5; Initial velocity = 0, -1, 0
Link floor: Type = stop; From = ground; To = bar @ 0; Direction = 0, 1; Gap = 0.05
Link joint: Type = joint; From = block; To = bar @ 0; Direction = 0, 1
Time: Step = 1e-3; End = 0.3
)";
  std::vector<double> y;
  const std::string log = log_of(text, {},
                                 [&](const taut::StepView &view) {
                                   y.push_back(displacement(view, 0, 0., {0., 1.}));
                                 });
  EXPECT_FALSE(has(log, "gave their mass")) << log;
  const auto [lowest, highest] = std::minmax_element(y.begin(), y.end());
  EXPECT_GE(*lowest, -.05 - 1e-9);
  EXPECT_LT(*highest, .01);
}

// Fast masses elsewhere do not hide what a contact does.
TEST(ResolvedContacts, a_contact_is_compared_with_what_it_is_connected_with)
{
  const std::string other =
      "Mass other: Position = 5, 0; Motions = y; Mass = 1e6; Initial velocity = 0, 100, 0\n";
  for (const std::string &more : {std::string(), other})
  {
    const std::string text = falling_mass("Stiffness = 1e7", 1e-3, more);
    const Result newmark = run(text, {"Time.Scheme=Newmark", "Time.Allow unsuitable scheme=true"}),
                 euler = run(text, {"Time.Scheme=backward Euler"});
    EXPECT_TRUE(has(newmark.error, "links gave")) << newmark.error << newmark.log;
    EXPECT_TRUE(has(newmark.error, "steps")) << newmark.error;
    EXPECT_TRUE(has(euler.error, "links took")) << euler.error << euler.log;
    EXPECT_TRUE(has(euler.error, "'automatic'")) << euler.error;
  }
}
