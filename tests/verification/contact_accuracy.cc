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
  using History = std::vector<std::vector<double>>; ///< of points, at common times [m]

  std::string number(const double x)
  {
    std::ostringstream text;
    text.precision(17);
    text << x;
    return text.str();
  }

  /// A scene, points of its wires (or all masses), and times to compare them at.
  struct Problem
  {
    std::string name, scene;
    double end, interval;
    std::vector<std::pair<std::size_t, double>> points; ///< wire and s
  };

  const Overrides ours = {"Time.Scheme=Moreau-Jean",
                          "Time.Moreau-Jean.Conditions=gaps then velocities",
                          "Time.Massless contact=no"},
                  bdf2 = {"Time.Scheme=BDF2", "Time.Massless contact=no",
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
                for (const auto &[wire, s] : problem.points)
                  history.back().push_back(displacement(view, wire, s));
                if (problem.points.empty())
                  for (const std::vector<double> &U : view.state.U)
                    history.back().insert(history.back().end(), U.begin(), U.end());
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

  std::vector<std::pair<std::size_t, double>> along(const std::size_t wire, const double length,
                                                    const int n)
  {
    std::vector<std::pair<std::size_t, double>> points;
    for (int i = 0; i <= n; ++i)
      points.emplace_back(wire, length * i / n);
    return points;
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
    return {name, line(contact, force), 1.2, 4e-3, along(0, 120., 20)};
  }
} // namespace

TEST(ContactAccuracy, beam_over_supports)
{
  const Problem problem = {"beam over supports", scene_file("beam_over_supports"), 2., 4e-3,
                           along(0, 20., 20)};
  const std::vector<double> e = compare(
      problem, 3.125e-5, {{2e-3, .0057}, {1e-3, .0015}, {5e-4, .0003}, {2.5e-4, .0001}}, 2e-4);
  EXPECT_LT(e[3], e[0] / 16.) << "second order";
}

TEST(ContactAccuracy, beam_on_stiff_stops)
{
  std::string path = scene_file("beam_over_supports");
  Problem problem = {"beam on stops of 1e6 N/m", path, 2., 4e-3, along(0, 20., 20)};
  Overrides stiff = {"Network.Link support.Stiffness=1e6"};
  const auto with = [&](Overrides base)
  {
    base.insert(base.end(), stiff.begin(), stiff.end());
    return base;
  };
  const History reference = run(problem, with(ours), 3.125e-5);
  const double apart = error(run(problem, with(bdf2), 3.125e-5), reference);
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
      compare(moving_contact("rigid moving contact"), 3.125e-5,
              {{2e-3, .0103}, {1e-3, .0025}, {5e-4, .0006}, {2.5e-4, .0002}}, 1e-3);
  EXPECT_LT(e[3], e[0] / 16.) << "second order";
}

TEST(ContactAccuracy, rigid_moving_contact_with_loss)
{
  compare(moving_contact("rigid moving contact with loss", "", "120*(1+0.9*sin(2*pi*3*t))"),
          3.125e-5, {{1e-3, .014}, {2.5e-4, .0008}}, 5e-3);
}

TEST(ContactAccuracy, elastic_moving_contact)
{
  compare(moving_contact("moving contact of 5e4 N/m", "  set Stiffness = 5e4\n"), 3.125e-5,
          {{2e-3, .0097}, {1e-3, .0024}, {5e-4, .0006}}, 1e-3);
}
