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
  constexpr double g = 9.81;

  /// A mass of 1 kg that falls from a height onto a stop.
  std::string falling_mass(const double height, const std::string &stop, const double step,
                           const double end, const std::string &more = "",
                           const std::string &bodies = "")
  {
    std::ostringstream text;
    text << "Gravity = 0, -9.81; Start = given\n"
            "Mass mass: Position = 0, "
         << height << "; Motions = y; Mass = 1\n"
         << bodies
         << "\nLink stop: Type = stop; From = ground; To = mass; Direction = 0, 1; Gap = " << height
         << "; " << stop << "\nTime: Step = " << step << "; End = " << end << "; " << more;
    return text.str();
  }

  std::string stiffness(const double k)
  {
    return "Stiffness = " + number(k);
  }

  /// Motion of the mass, contacts with a spring k in closed form: falls, half-waves about -g/w^2.
  double exact_motion(const double height, const double k, double t)
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

  /// The end of a run, its largest height after the first contact, and its log.
  struct Result
  {
    double end = 0., rebound = -1e9, energy = 0.;
    long n_steps = 0;
    std::vector<std::pair<double, double>> motion; ///< times [s], places [m]
    std::string log, error;
  };
  Result run(const std::string &text, const double first_contact, const Overrides &overrides = {})
  {
    Result result;
    Session session(text, overrides);
    result.error = verification::error_of(
        [&]
        {
          session.run(
              [&](const taut::StepView &view)
              {
                ++result.n_steps;
                result.end = view.state.U[0][0];
                result.motion.push_back({view.state.time, result.end});
                if (view.state.time > first_contact)
                  result.rebound = std::max(result.rebound, result.end);
                result.energy = view.measures.summary().relative_energy;
              });
        });
    result.log = session.log();
    return result;
  }
} // namespace

// The contact on 1e7 N/m lasts 0.99 ms, one step; on 1e9 N/m a tenth of a step.
TEST(ResolvedContacts, a_mass_rebounds_from_a_stop_that_is_stiff_for_the_step)
{
  const double height = .05;
  for (const double k : {1e5, 1e7, 1e9})
    for (const double step : {1e-3, 1e-4})
    {
      const Result r = run(falling_mass(height, stiffness(k), step, .2), .105);
      const double error = std::fabs(r.end - exact_motion(height, k, .2)) / height;
      double largest = 0.;
      for (const auto &[t, place] : r.motion)
        largest = std::max(largest, std::fabs(place - exact_motion(height, k, t)) / height);
      const std::string what = "drop of 50 mm on " + number(k) + " N/m, step " + number(step);
      figure(what + " s, error over the drop", error);
      figure(what + " s, largest error of all times over the drop", largest);
      EXPECT_LT(error, .02) << k << ' ' << step << ' ' << r.log;
      EXPECT_LT(largest, .05) << k << ' ' << step << ' ' << r.log;
      EXPECT_LT(r.energy, k == 1e5 ? .01 : 1e-9);
      // An impact that is late by a step of 1 ms is an error of 2 %, of which a run may warn.
      if (largest < .01)
      {
        EXPECT_FALSE(has(r.log, "Warning")) << r.log;
      }
    }
}

// 100 stops of 1e6 N/m are one of 1e8 N/m: each alone would be resolved.
TEST(ResolvedContacts, links_in_parallel_count_together)
{
  const double height = .05;
  std::string links, sections;
  for (int i = 0; i < 100; ++i)
  {
    const std::string name = "stop" + std::to_string(i);
    links += (i ? ", " : "") + name;
    sections +=
        "Link " + name +
        ": Type = stop; From = ground; To = mass; Direction = 0, 1; Gap = 0.05; Stiffness = 1e6\n";
  }
  const std::string text =
      R"(Gravity = 0, -9.81; Start = given
Mass mass: Position = 0, 0.05; Motions = y; Mass = 1
)" + sections +
      R"(
Time: Step = 1e-3; End = 0.2
)";
  const Result r = run(text, .105);
  const double error = std::fabs(r.end - exact_motion(height, 1e8, .2)) / height;
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
  const Result r = run(text, 1.);
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

// A beam of ten metres falls flat on 41 stops; most of its mass stands above one.
TEST(ResolvedContacts, a_beam_that_falls_flat_keeps_its_energy)
{
  const auto height_after = [](const std::string &step, const std::string &scheme)
  {
    double mean = 0.;
    run_scene(R"(Gravity = 0, -9.81; Start = given
Wire beam: To = 10, 0; Components = beam; Mass per length = 1; Bending stiffness = 1000;
  Element size = 0.25
Link stop: Type = stop; From = ground; To = beam @ 0:0.25:10; Direction = 0, 1; Gap = 0.05;
  Stiffness = 1e6
Time: Step = )" + step +
                  R"(; End = 0.2
)",
              {"Time.Scheme=" + scheme, "Time.Allow unsuitable scheme=true",
               "Time.Allow energy gain=true"},
              [&](const taut::StepView &view)
              {
                mean = 0.;
                for (int i = 0; i < 40; ++i)
                  mean += displacement(view, 0, .125 + .25 * i) / 40.;
              });
    return mean;
  };
  const double exact = exact_motion(.05, 1e6 * 41. / 10., .2),
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
  double lowest = 0., largest = 0.;
  Session session(text);
  session.run(
      [&](const taut::StepView &view)
      {
        const double y = displacement(view, 0, 0., {0., 1.});
        lowest = std::min(lowest, y);
        largest = std::max(largest, y);
      });
  EXPECT_FALSE(has(session.log(), "gave their mass")) << session.log();
  EXPECT_GE(lowest, -.05 - 1e-9);
  EXPECT_LT(largest, .01);
}

// Fast masses elsewhere do not hide what a contact does.
TEST(ResolvedContacts, a_contact_is_compared_with_what_it_is_connected_with)
{
  const std::string other =
      "Mass other: Position = 5, 0; Motions = y; Mass = 1e6; Initial velocity = 0, 100, 0\n";
  for (const bool has_other : {false, true})
  {
    const Result r =
        run(falling_mass(.05, stiffness(1e7), 1e-3, .2, "Scheme = Newmark", has_other ? other : ""),
            .105, {"Time.Allow unsuitable scheme=true"});
    EXPECT_TRUE(has(r.error, "links gave")) << r.error << r.log;
    EXPECT_TRUE(has(r.error, "steps")) << r.error;
    const Result euler = run(falling_mass(.05, stiffness(1e7), 1e-3, .2, "Scheme = backward Euler",
                                          has_other ? other : ""),
                             .105);
    EXPECT_TRUE(has(euler.error, "links took")) << euler.error << euler.log;
    EXPECT_TRUE(has(euler.error, "'automatic'")) << euler.error;
  }
}
