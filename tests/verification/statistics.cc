// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: statistics.json says what happened. Source: the same figures from the forces, gaps and
// displacements that an observer of the same run sees, by their definitions: moments of all samples
// of the force whose position lies in the window, over their number; the filter of the whole record
// before the window is cut out; impulse and open time as sums over the steps.
#include "run.h"

#include <taut/output/low_pass.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>

using namespace verification;

namespace
{
  constexpr double window_begin = 3., window_end = 8., speed = 4., start = 1., step = 1e-3;

  // A mass is driven along a wavy wire and jumps; a joint holds another mass back, which pulls and
  // pushes; a stop is hit now and then.
  const char *const scene =
      "set Generator = network\nset Gravity = 0, 0\nset Start = equilibrium\n"
      "subsection Network\n set Wires = wire\n set Supports = ends\n set Masses = head, frame\n"
      " set Springs = spring\n set Links = contact, rod, stop\n set Loads = force\n"
      " subsection Wire wire\n  set To = 10, 0\n  set Components = string\n"
      "  set Mass per length = 1\n  set Tension = 1e5\n  set Element size = 0.5\n end\n"
      " subsection Support ends\n  set Wire = wire\n  set Positions = 0, 10\n end\n"
      " subsection Mass head\n  set Position = 1, 0\n  set Mass = 2\n  set Motions = y\n end\n"
      " subsection Mass frame\n  set Position = 1, -1\n  set Mass = 3\n  set Motions = y\n end\n"
      " subsection Spring spring\n  set From = ground\n  set To = frame\n  set Stiffness = 2000\n"
      "  set Damping = 20\n end\n"
      " subsection Link contact\n  set Type = sliding contact\n  set From = head\n"
      "  set To = wire @ 1\n  set Direction = 0, 1\n  set Stiffness = 10000\n  set Speed = 4\n"
      "  set Height profile = 1.5e-2*sin(3*pi*(s-1))\n end\n"
      " subsection Link rod\n  set Type = joint\n  set From = head\n  set To = frame\n"
      "  set Direction = 0, 1\n  set Stiffness = 1e5\n end\n"
      " subsection Link stop\n  set Type = stop\n  set To = frame\n  set Direction = 0, 1\n"
      "  set Stiffness = 1e4\n  set Gap = -0.002\n end\n"
      " subsection Load force\n  set Type = point\n  set On = frame\n  set Magnitude = 15\n end\n"
      "end\n"
      "subsection Time\n set Scheme = generalised-alpha\n set Step = 1e-3\n set End = 2.2\nend\n"
      "subsection Output\n set Probes = head\n subsection Probe head\n  set Point = head\n"
      "  set Direction = 0, 1\n end\nend\n"
      "subsection Statistics\n set Window = 3, 8\n set Filter frequency = 20\nend\n";

  struct Moments
  {
    double mean = 0., deviation = 0., least = INFINITY, largest = -INFINITY;
  };

  Moments moments(const std::vector<double> &x)
  {
    Moments m;
    for (const double value : x)
    {
      m.mean += value / x.size();
      m.least = std::min(m.least, value);
      m.largest = std::max(m.largest, value);
    }
    double squares = 0.;
    for (const double value : x)
      squares += std::pow(value - m.mean, 2);
    m.deviation = std::sqrt(squares / x.size());
    return m;
  }

  /// The samples taken while the contact is in the window.
  std::vector<double> inside(const std::vector<double> &x)
  {
    std::vector<double> result;
    for (std::size_t i = 0; i < x.size(); ++i)
    {
      const double s = start + speed * step * i;
      if (s > window_begin - 1e-9 && s < window_end + 1e-9)
        result.push_back(x[i]);
    }
    return result;
  }

  void expect_moments(const nlohmann::json &said, const Moments &m)
  {
    const auto near = [&](const char *name, const double value)
    { EXPECT_NEAR(said.at(name).get<double>(), value, 1e-10 * m.largest) << name; };
    near("mean [N]", m.mean);
    near("standard deviation [N]", m.deviation);
    near("mean + 3 standard deviations [N]", m.mean + 3. * m.deviation);
    near("mean - 3 standard deviations [N]", m.mean - 3. * m.deviation);
    near("maximum [N]", m.largest);
    near("minimum [N]", m.least);
  }

  struct Run
  {
    /// Forces of rod, stop and contact, in the order of the rows, and the probe, step by step.
    std::vector<double> force[3], probe;
    nlohmann::json said;
  };

  const Run &run()
  {
    static const Run result = []
    {
      Run r;
      Session session(scene);
      session.run(
          [&](const taut::StepView &view)
          {
            for (int i = 0; i < 3; ++i)
              r.force[i].push_back(view.state.multiplier[i]);
            r.probe.push_back(view.probes[0]);
          });
      std::ifstream(session.folder() + "/statistics.json") >> r.said;
      return r;
    }();
    return result;
  }
} // namespace

TEST(Statistics, moments_of_the_contact_force_are_those_of_the_samples_in_the_window)
{
  const auto &said = run().said["sliding contacts"]["contact"];
  const std::vector<double> raw = inside(run().force[2]);
  EXPECT_EQ(raw.size(), 1251u);
  EXPECT_EQ(said["samples"], raw.size());
  expect_moments(said["raw"], moments(raw));
  expect_moments(said["filtered"], moments(inside(taut::low_pass(run().force[2], step, 20.))));

  const double loss = double(std::count(raw.begin(), raw.end(), 0.)) / raw.size();
  EXPECT_GT(loss, .05);
  EXPECT_LT(loss, .45);
  EXPECT_NEAR(said["contact loss [1]"].get<double>(), loss, 1e-12);
  figure("statistics, contact loss of a jumping contact", loss);
  figure("statistics, standard deviation said over that of the samples - 1",
         said["raw"]["standard deviation [N]"].get<double>() / moments(raw).deviation - 1.);
}

TEST(Statistics, links_have_their_impulse_largest_force_and_open_time)
{
  const char *const names[] = {"rod", "stop"};
  for (int i = 0; i < 2; ++i)
  {
    double impulse = 0., largest = 0., open = 0.;
    for (std::size_t k = 0; k < run().force[i].size(); ++k)
    {
      const double N = run().force[i][k];
      largest = std::fabs(N) > std::fabs(largest) ? N : largest;
      impulse += k > 0 ? step * N : 0.;
      open += k > 0 && N == 0. ? step : 0.;
    }
    const auto &said = run().said["links"][names[i]];
    EXPECT_NEAR(said["impulse [N s, N m s]"].get<double>(), impulse, 1e-9 * std::fabs(impulse));
    EXPECT_EQ(said["largest force [N, N m]"].get<double>(), largest);
    EXPECT_NEAR(said["open time [s]"].get<double>(), open, 1e-9);
    if (i == 0)
      EXPECT_LT(largest, 0.)
          << "the rod has to pull more than it pushes, or the sign is not tested";
    else
      EXPECT_GT(std::min(open, 2.2 - open), .1) << "the stop has to open and to close";
  }
}

TEST(Statistics, probes_have_their_largest_and_smallest_displacement)
{
  const auto &said = run().said["probes"]["head"];
  const auto [least, largest] = std::minmax_element(run().probe.begin(), run().probe.end());
  EXPECT_LT(*least, 0.);
  EXPECT_GT(*largest, 0.);
  EXPECT_EQ(said["largest [m, rad]"].get<double>(), *largest);
  EXPECT_EQ(said["smallest [m, rad]"].get<double>(), *least);
}
