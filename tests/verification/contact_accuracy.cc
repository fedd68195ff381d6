// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: with conditions on gaps, then velocities, motions in contact are as near to the solution
// in time as an independent program found them with the same scheme, times 1.5, and of second order
// where they are smooth. Reference: the same discrete scene with a much smaller step of the same
// scheme, which BDF2 at a small step agrees with.
#include "run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace verification;

namespace
{
  using History = std::vector<std::vector<double>>; ///< displacements at common times [m]

  /// A scene, the point of its first wire that is compared, and times to compare at. Masses are
  /// compared, too.
  struct Problem
  {
    std::string name, scene;
    double end, interval;
    double wire_point; ///< s [m]; negative: none
  };

  const Overrides ours = {"Time.Scheme=Moreau-Jean",
                          "Time.Moreau-Jean.Conditions=gaps then velocities",
                          "Time.Mass redistribution=no"},
                  bdf2 = {"Time.Scheme=BDF2", "Time.Mass redistribution=no",
                          "Time.Allow unsuitable scheme=true", "Time.Allow energy gain=true"};

  History run(const Problem &problem, Overrides overrides, const double step)
  {
    overrides.push_back("Time.Step=" + number(step));
    overrides.push_back("Time.End=" + number(problem.end));
    const long every = std::lround(problem.interval / step);
    History history;
    long i = 0;
    run_scene(problem.scene, overrides,
              [&](const taut::StepView &view)
              {
                if (i++ % every != 0)
                  return;
                history.emplace_back();
                if (problem.wire_point >= 0.)
                  history.back().push_back(displacement(view, 0, problem.wire_point));
                for (std::size_t m = 0; m < view.scene.masses.size(); ++m)
                {
                  std::vector<taut::Term> terms;
                  view.structure.motion({taut::Attachment::Kind::mass, m, 0.}, false, {0., 1.}, 1.,
                                        terms);
                  history.back().push_back(displacement(view, terms));
                }
              });
    return history;
  }

  /// Root mean square of the difference, over that of the reference unless @p absolute.
  double error(const History &a, const History &reference, const bool absolute = false)
  {
    EXPECT_EQ(a.size(), reference.size());
    double sum = 0., size = 0.;
    std::size_t n = 0;
    for (std::size_t i = 0; i < std::min(a.size(), reference.size()); ++i)
      for (std::size_t j = 0; j < a[i].size(); ++j, ++n)
      {
        sum += std::pow(a[i][j] - reference[i][j], 2);
        size += std::pow(reference[i][j] - reference[0][j], 2);
      }
    return std::sqrt(sum / (absolute ? n : size));
  }

  /// Errors at steps [s], at most 1.5 times those given.
  std::vector<double> compare(const Problem &problem, const double finest,
                              const std::vector<std::pair<double, double>> &expected,
                              const double agreement, const bool absolute = false,
                              const Overrides &other = bdf2)
  {
    const History reference = run(problem, ours, finest);
    const double apart = error(run(problem, other, finest), reference, absolute);
    figure(problem.name + ", the other scheme minus the reference", apart);
    EXPECT_LT(apart, agreement) << problem.name;
    std::vector<double> errors;
    for (const auto &[step, bound] : expected)
    {
      errors.push_back(error(run(problem, ours, step), reference, absolute));
      figure(problem.name + ", step " + number(step) + " s, error (table: " + number(bound) + ")",
             errors.back());
      EXPECT_LT(errors.back(), 1.5 * bound) << problem.name << ", " << step;
    }
    return errors;
  }

  /// 120 m of wire on springs, and a two-mass pantograph at 250 km/h under it.
  std::string line(const std::string &contact, const std::string &force)
  {
    return "set Generator = network\nset Gravity = 0, 0\nset Start = equilibrium\n"
           "subsection Network\n set Wires = wire\n set Supports = ends, soft, hard\n"
           " set Masses = head, frame\n set Springs = upper, lower\n set Links = contact\n"
           " set Loads = lift\n"
           " subsection Wire wire\n  set To = 120, 0\n  set Components = beam\n"
           "  set Mass per length = 1.35\n  set Tension = 20000\n  set Bending stiffness = 195\n"
           "  set Element size = 0.5\n  set Mass damping = 0.0125\n"
           "  set Stiffness damping = 1e-4\n end\n"
           " subsection Support ends\n  set Wire = wire\n  set Positions = 0, 120\n end\n"
           " subsection Support soft\n  set Wire = wire\n  set Type = elastic\n"
           "  set Positions = 6:6:54, 66:6:114\n  set Stiffness = 3000\n end\n"
           " subsection Support hard\n  set Wire = wire\n  set Type = elastic\n"
           "  set Positions = 60\n  set Stiffness = 18000\n end\n"
           " subsection Mass head\n  set Position = 15, 0\n  set Motions = y\n"
           "  set Mass = 7.2\n end\n"
           " subsection Mass frame\n  set Position = 15, -1\n  set Motions = y\n"
           "  set Mass = 15\n end\n"
           " subsection Spring upper\n  set From = frame\n  set To = head\n"
           "  set Stiffness = 4200\n  set Damping = 10\n end\n"
           " subsection Spring lower\n  set From = ground\n  set To = frame\n"
           "  set Stiffness = 50\n  set Damping = 90\n end\n"
           " subsection Link contact\n  set Type = sliding contact\n  set From = head\n"
           "  set To = wire @ 15\n  set Direction = 0, 1\n  set Speed = 69.444444444444443\n" +
           contact +
           " end\n subsection Load lift\n  set Type = point\n  set On = frame\n  set Magnitude = " +
           force + "\n end\nend\nsubsection Time\n set End = 1\nend\n";
  }

  Problem moving_contact(const std::string &name, const std::string &contact = "",
                         const std::string &force = "120")
  {
    return {name, line(contact, force), 1., 4e-3, -1.};
  }
} // namespace

TEST(ContactAccuracy, beam_over_supports)
{
  const Problem problem = {"beam over supports", scene_file("beam_over_supports"), 2., 4e-3, 10.};
  const std::vector<double> e = compare(
      problem, 6.25e-5, {{2e-3, .0057}, {1e-3, .0015}, {5e-4, .0003}, {2.5e-4, .0001}}, 2e-4);
  EXPECT_LT(e[3], e[0] / 16.) << "second order";
}

TEST(ContactAccuracy, beam_on_stiff_stops)
{
  std::string path = scene_file("beam_over_supports");
  Problem problem = {"beam on stops of 1e6 N/m", path, 2., 4e-3, 10.};
  Overrides stiff = {"Network.Link support.Stiffness=1e6"};
  const auto with = [&](Overrides base)
  {
    base.insert(base.end(), stiff.begin(), stiff.end());
    return base;
  };
  const History reference = run(problem, with(ours), 6.25e-5);
  const double apart = error(run(problem, with(bdf2), 6.25e-5), reference);
  figure("beam on stops of 1e6 N/m, BDF2 minus the reference", apart);
  EXPECT_LT(apart, 2e-4);
  for (const auto &[step, bound] :
       std::vector<std::pair<double, double>>{{2e-3, .0085}, {1e-3, .0029}, {5e-4, .0007}})
  {
    const double e = error(run(problem, with(ours), step), reference);
    figure("beam on stops of 1e6 N/m, step " + number(step) + " s, error (table: " + number(bound) +
               ")",
           e);
    EXPECT_LT(e, 1.5 * bound) << step;
  }
}

TEST(ContactAccuracy, rigid_moving_contact)
{
  const std::vector<double> e =
      compare(moving_contact("rigid moving contact"), 6.25e-5,
              {{2e-3, .0103}, {1e-3, .0025}, {5e-4, .0006}, {2.5e-4, .0002}}, 1e-3);
  EXPECT_LT(e[3], e[0] / 16.) << "second order";
}

TEST(ContactAccuracy, rigid_moving_contact_with_loss)
{
  compare(moving_contact("rigid moving contact with loss", "", "120*(1+0.9*sin(2*pi*3*t))"),
          6.25e-5, {{1e-3, .014}, {2.5e-4, .0008}}, 5e-3);
}

TEST(ContactAccuracy, elastic_moving_contact)
{
  compare(moving_contact("moving contact of 5e4 N/m", "  set Stiffness = 5e4\n"), 6.25e-5,
          {{2e-3, .0097}, {1e-3, .0024}, {5e-4, .0006}}, 1e-3);
}

// Without mass its head is in equilibrium, and the contact as elastic as the spring under it.
TEST(ContactAccuracy, moving_contact_from_a_head_without_mass)
{
  for (const std::string damping : {"0", "10"})
  {
    Problem problem = moving_contact("contact from a massless head, damping " + damping);
    for (const auto &[entry, value] :
         {std::pair<std::string, std::string>("  set Mass = 7.2\n", "  set Mass = 0\n"),
          {"  set Damping = 10\n", "  set Damping = " + damping + "\n"}})
      problem.scene.replace(problem.scene.find(entry), entry.size(), value);
    const std::vector<double> e = compare(
        problem, 6.25e-5, {{2e-3, .0083}, {1e-3, .0021}, {5e-4, .0005}, {2.5e-4, .00012}}, 1e-3);
    EXPECT_LT(e[3], e[0] / 16.) << "second order";
  }
}

// Two masses on a spring fall 0.8 m: errors in millimetres. BDF2 would let them rebound; the other
// scheme has conditions on velocities.
TEST(ContactAccuracy, two_masses_on_a_floor)
{
  const std::string scene =
      "set Generator = network\nset Gravity = 0, -10\nset Start = given\n"
      "subsection Network\n set Masses = lower, upper\n set Springs = spring\n set Links = floor\n"
      " subsection Mass lower\n  set Position = 0, 0.8\n  set Motions = y\n  set Mass = 2\n end\n"
      " subsection Mass upper\n  set Position = 0, 1.8\n  set Motions = y\n  set Mass = 2\n end\n"
      " subsection Spring spring\n  set From = lower\n  set To = upper\n  set Stiffness = 400\n"
      " end\n subsection Link floor\n  set Type = stop\n  set From = ground\n  set To = lower\n"
      "  set Direction = 0, 1\n  set Gap = 0.8\n end\nend\nsubsection Time\n set End = 1\nend\n";
  const Overrides of_rates = {"Time.Scheme=Moreau-Jean", "Time.Moreau-Jean.Conditions=velocities"};
  compare({"two masses on a floor [m]", scene, 1.32, .033, -1.}, 1e-5,
          {{.011, 7.1e-3}, {3.3e-3, 1.7e-3}, {1.1e-3, .7e-3}, {3.3e-4, .13e-3}}, 1e-4, true,
          of_rates);
}

// Two beams, simply supported, face to face: the upper one falls on the lower one.
TEST(ContactAccuracy, colliding_beams)
{
  const auto beam = [](const std::string &name, const std::string &y, const std::string &speed)
  {
    return " subsection Wire " + name + "\n  set From = 0, " + y + "\n  set To = 20, " + y +
           "\n  set Components = beam\n  set Mass per length = 20\n"
           "  set Bending stiffness = 2e5\n  set Element size = 0.5\n"
           "  set Stiffness damping = 1e-4\n  set Initial transverse velocity = " +
           speed + "\n end\n subsection Support " + name + "\n  set Wire = " + name +
           "\n  set Positions = 0, 20\n end\n";
  };
  const std::string scene =
      "set Generator = network\nset Gravity = 0, 0\nset Start = given\nsubsection Network\n"
      " set Wires = lower, upper\n set Supports = lower, upper\n set Links = stop\n" +
      beam("lower", "0", "0") + beam("upper", "0.05", "-sin(pi*s/20)") +
      " subsection Link stop\n  set Type = stop\n  set From = lower @ 1:1:19\n"
      "  set To = upper @ 1:1:19\n  set Direction = 0, 1\n  set Gap = 0.05\n end\nend\n"
      "subsection Time\n set End = 1\nend\n";
  compare({"colliding beams", scene, 1., 4e-3, 10.}, 3.125e-5,
          {{2e-3, .040}, {1e-3, .027}, {5e-4, .014}, {2.5e-4, .004}}, 5e-3);
}
