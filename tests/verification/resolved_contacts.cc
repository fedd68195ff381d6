// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: contacts that a step does not resolve keep their energy; parallel links, joined masses and
// the way of moving contacts count in the choice of the scheme; a link with a damper is met by
// shorter steps; and what a link gives or takes is compared with what it is connected with.
// Sources: free fall and the oscillation of a mass on a spring in closed form, runs with a smaller
// step.
#include "run.h"

#include <taut/base/exceptions.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

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
    text << "set Generator = network\nset Gravity = 0, -9.81\nset Start = given\n"
            "subsection Network\n set Masses = mass"
         << (bodies.empty() ? "" : ", other") << "\n set Links = stop\n"
         << " subsection Mass mass\n  set Position = 0, " << height
         << "\n  set Motions = y\n  set Mass = 1\n end\n"
         << bodies << " subsection Link stop\n  set Type = stop\n  set From = ground\n"
         << "  set To = mass\n  set Direction = 0, 1\n  set Gap = " << height << "\n"
         << stop << " end\nend\nsubsection Time\n set Step = " << step << "\n set End = " << end
         << "\n"
         << more << "end\n";
    return text.str();
  }

  std::string stiffness(const double k)
  {
    return "  set Stiffness = " + number(k) + "\n";
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
    try
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
    }
    catch (const taut::UserError &e)
    {
      result.error = e.what();
    }
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
        EXPECT_EQ(r.log.find("Warning"), std::string::npos) << r.log;
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
    sections += " subsection Link " + name +
                "\n  set Type = stop\n  set From = ground\n  set To = mass\n"
                "  set Direction = 0, 1\n  set Gap = 0.05\n  set Stiffness = 1e6\n end\n";
  }
  const std::string text =
      "set Generator = network\nset Gravity = 0, -9.81\nset Start = given\nsubsection Network\n"
      " set Masses = mass\n set Links = " +
      links +
      "\n subsection Mass mass\n  set Position = 0, 0.05\n  set Motions = y\n  set Mass = 1\n"
      " end\n" +
      sections + "end\nsubsection Time\n set Step = 1e-3\n set End = 0.2\nend\n";
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
      "set Generator = network\nset Gravity = 0, 0\nset Start = given\nsubsection Network\n"
      " set Masses = mass\n set Links = floor, roof\n subsection Mass mass\n"
      "  set Position = 0, 0\n  set Motions = y\n  set Mass = 1\n"
      "  set Initial velocity = 0, 1, 0\n end\n"
      " subsection Link floor\n  set Type = stop\n  set From = ground\n  set To = mass\n"
      "  set Direction = 0, 1\n  set Gap = 0.01\n  set Stiffness = 39000\n end\n"
      " subsection Link roof\n  set Type = stop\n  set From = mass\n  set To = ground\n"
      "  set Direction = 0, 1\n  set Gap = 0.01\n  set Stiffness = 39000\n end\n"
      "end\nsubsection Time\n set Step = 1e-3\n set End = 0.01\nend\n";
  const Result r = run(text, 1.);
  EXPECT_NE(r.log.find("generalised-alpha"), std::string::npos) << r.log;
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
        "set Generator = network\nset Gravity = 0, 0\nset Start = given\nsubsection Network\n"
        " set Masses = mass\n set Links = stop\n subsection Mass mass\n"
        "  set Position = 0, 0\n  set Motions = y\n  set Mass = 1\n"
        "  set Initial velocity = 0, -1, 0\n end\n"
        " subsection Link stop\n  set Type = stop\n  set From = ground\n  set To = mass\n"
        "  set Direction = 0, 1\n  set Gap = 0.0123\n  set Stiffness = 1e7\n  set Damping = " +
        number(2. * zeta * std::sqrt(k * m)) +
        "\n end\nend\nsubsection Time\n set Step = 1e-3\n set End = 0.03\nend\n";
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
    run_scene("set Generator = network\nset Gravity = 0, -9.81\nset Start = given\n"
              "subsection Network\n set Wires = beam\n set Links = stop\n"
              " subsection Wire beam\n  set To = 10, 0\n  set Components = beam\n"
              "  set Mass per length = 1\n  set Bending stiffness = 1000\n"
              "  set Element size = 0.25\n end\n"
              " subsection Link stop\n  set Type = stop\n  set From = ground\n"
              "  set To = beam @ 0:0.25:10\n  set Direction = 0, 1\n  set Gap = 0.05\n"
              "  set Stiffness = 1e6\n end\nend\nsubsection Time\n set Step = " +
                  step + "\n set End = 0.2\nend\n",
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
      "set Generator = network\nset Gravity = 0, 0\nset Start = given\nsubsection Network\n"
      " set Wires = bar\n set Masses = block\n set Links = floor, joint\n"
      " subsection Wire bar\n  set From = 0, 0\n  set To = 0, 10\n  set Components = bar\n"
      "  set Mass per length = 1\n  set Axial stiffness = 10000\n  set Element size = 0.25\n"
      "  set Initial axial velocity = -1\n end\n"
      " subsection Mass block\n  set Position = 0, 0\n  set Motions = y\n  set Mass = 5\n"
      "  set Initial velocity = 0, -1, 0\n end\n"
      " subsection Link floor\n  set Type = stop\n  set From = ground\n  set To = bar @ 0\n"
      "  set Direction = 0, 1\n  set Gap = 0.05\n end\n"
      " subsection Link joint\n  set Type = joint\n  set From = block\n  set To = bar @ 0\n"
      "  set Direction = 0, 1\n end\nend\n"
      "subsection Time\n set Step = 1e-3\n set End = 0.3\nend\n";
  double lowest = 0., largest = 0.;
  Session session(text);
  session.run(
      [&](const taut::StepView &view)
      {
        const double y = displacement(view, 0, 0., {0., 1.});
        lowest = std::min(lowest, y);
        largest = std::max(largest, y);
      });
  EXPECT_EQ(session.log().find("gave their mass"), std::string::npos) << session.log();
  EXPECT_GE(lowest, -.05 - 1e-9);
  EXPECT_LT(largest, .01);
}

// Fast masses elsewhere do not hide what a contact does.
TEST(ResolvedContacts, a_contact_is_compared_with_what_it_is_connected_with)
{
  const std::string other =
      " subsection Mass other\n  set Position = 5, 0\n  set Motions = y\n  set Mass = 1e6\n"
      "  set Initial velocity = 0, 100, 0\n end\n";
  for (const bool has_other : {false, true})
  {
    const Result r = run(falling_mass(.05, stiffness(1e7), 1e-3, .2, " set Scheme = Newmark\n",
                                      has_other ? other : ""),
                         .105, {"Time.Allow unsuitable scheme=true"});
    EXPECT_NE(r.error.find("links gave"), std::string::npos) << r.error << r.log;
    EXPECT_NE(r.error.find("steps"), std::string::npos) << r.error;
    const Result euler = run(falling_mass(.05, stiffness(1e7), 1e-3, .2,
                                          " set Scheme = backward Euler\n", has_other ? other : ""),
                             .105);
    EXPECT_NE(euler.error.find("links took"), std::string::npos) << euler.error << euler.log;
    EXPECT_NE(euler.error.find("'automatic'"), std::string::npos) << euler.error;
  }
}
