// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: statistics.json says what happened. Source: the same figures from the forces, gaps and
// displacements that an observer of the same run sees, by their definitions: moments of all samples
// of the force whose position lies in the window, over their number; the filter of the whole record
// before the window is cut out; impulse and open time as sums over the steps.
#include "scene_tests.h"

#include "output/signals.h"

using namespace verification;

namespace
{
  constexpr double window_begin = 3., window_end = 8., speed = 4., start = 1., step = 1e-3;

  // A mass is driven along a wavy wire and jumps; a joint holds another mass back, which pulls and
  // pushes; a stop is hit now and then.
  const char *const scene =
      R"(Gravity = 0, 0; Start = equilibrium
Wire wire: To = 10, 0; Components = string; Mass per length = 1; Tension = 1e5; Element size = 0.5
Support ends: Wire = wire; Positions = 0, 10
Mass head: Position = 1, 0; Mass = 2; Motions = y
Mass frame: Position = 1, -1; Mass = 3; Motions = y
Spring spring: From = ground; To = frame; Stiffness = 2000; Damping = 20
Link contact: Type = sliding contact; From = head; To = wire @ 1; Direction = 0, 1;
  Stiffness = 10000; Speed = 4; Height profile = 1.5e-2*sin(3*pi*(s-1))
Link rod: Type = joint; From = head; To = frame; Direction = 0, 1; Stiffness = 1e5
Link stop: Type = stop; To = frame; Direction = 0, 1; Stiffness = 1e4; Gap = -0.002
Load force: Type = point; On = frame; Magnitude = 15
Time: Scheme = generalised-alpha; Step = 1e-3; End = 2.2
Probe head: Point = head; Direction = 0, 1
Statistics: Window = 3, 8; Filter frequency = 20
)";

  struct Moments
  {
    double mean, deviation, least, largest;
  };

  Moments moments(const std::vector<double> &x)
  {
    const auto [least, largest] = std::minmax_element(x.begin(), x.end());
    Moments m = {0., 0., *least, *largest};
    for (const double value : x)
      m.mean += value / x.size();
    for (const double value : x)
      m.deviation += std::pow(value - m.mean, 2);
    m.deviation = std::sqrt(m.deviation / x.size());
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
    const auto near = [&](const char *name, const double expected)
    {
      EXPECT_NEAR(value(said, name), expected, 1e-10 * m.largest) << name;
      EXPECT_EQ(said.at(name).at("unit"), "N") << name;
    };
    near("mean", m.mean);
    near("standard_deviation", m.deviation);
    near("mean_plus_3_standard_deviations", m.mean + 3. * m.deviation);
    near("mean_minus_3_standard_deviations", m.mean - 3. * m.deviation);
    near("maximum", m.largest);
    near("minimum", m.least);
  }

  const std::string mean = "Statistics.Expected ranges.Mean=";

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
      r.said = say(scene, {},
                   [&](const taut::StepView &view)
                   {
                     for (int i = 0; i < 3; ++i)
                       r.force[i].push_back(view.state.multiplier[i]);
                     r.probe.push_back(view.probes[0]);
                   })
                   .json;
      return r;
    }();
    return result;
  }
} // namespace

TEST(Statistics, moments_of_the_contact_force_are_those_of_the_samples_in_the_window)
{
  const auto &said = run().said["sliding_contacts"]["contact"];
  const std::vector<double> raw = inside(run().force[2]);
  EXPECT_EQ(raw.size(), 1251u);
  EXPECT_EQ(said["samples"], raw.size());
  expect_moments(said["raw"], moments(raw));
  expect_moments(said["filtered"], moments(inside(taut::low_pass(run().force[2], step, 20.))));

  const double loss = double(std::count(raw.begin(), raw.end(), 0.)) / raw.size();
  EXPECT_GT(loss, .05);
  EXPECT_LT(loss, .45);
  EXPECT_NEAR(value(said, "contact_loss"), loss, 1e-12);
  figure("statistics, contact loss of a jumping contact", loss);
  figure("statistics, standard deviation said over that of the samples - 1",
         value(said["raw"], "standard_deviation") / moments(raw).deviation - 1.);
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
      impulse += k > 0 ? .5 * step * (run().force[i][k - 1] + N) : 0.;
      open += k > 0 && N == 0. ? step : 0.;
    }
    const auto &said = run().said["links"][names[i]];
    EXPECT_NEAR(value(said, "impulse"), impulse, 1e-9 * std::fabs(impulse));
    EXPECT_EQ(value(said, "largest_force"), largest);
    EXPECT_NEAR(value(said, "open_time"), open, 1e-9);
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
  EXPECT_EQ(value(said, "largest"), *largest);
  EXPECT_EQ(said["largest"]["unit"], "m");
  EXPECT_EQ(value(said, "smallest"), *least);
}

// Claim: a window that the run does not reach to its end is named with what was used of it, and
// does not count as passed. Expected: from 3 m to 1 m + 4 m/s 1.25 s = 6 m of 3 to 8 m.
TEST(Statistics, a_window_that_is_not_passed_says_what_was_used)
{
  const Said part = say(scene, {"Time.End=1.25", mean + "0, 100"});
  EXPECT_TRUE(has(part.log, "3.00 to 6.00 m of the window 3.00 to 8.00 m (751 samples"))
      << part.log;
  const auto &window = part.json["sliding_contacts"]["contact"]["window"];
  EXPECT_EQ(window["value"], nlohmann::json({3., 8.}));
  EXPECT_FALSE(window["complete"].get<bool>());
  for (const int i : {0, 1})
    EXPECT_NEAR(window["evaluated"][i].get<double>(), 3. + 3. * i, 1e-9);
  EXPECT_EQ(part.json["verdict"], "incomplete");

  const Said whole = say(scene, {mean + "0, 100"});
  EXPECT_TRUE(has(whole.log, "'contact', 3.00 to 8.00 m (1251 samples"));
  EXPECT_TRUE(whole.json["sliding_contacts"]["contact"]["window"]["complete"].get<bool>());
  EXPECT_EQ(whole.json["verdict"], "inside");
  EXPECT_EQ(say(scene, {mean + "100, 200"}).json["verdict"], "outside");
  EXPECT_EQ(say(scene, {}).json["verdict"], "none");
}

// Claim: what the step cannot filter is not compared with ranges of filtered forces. Expected: at
// 1 ms, 4 steps a period are 250 Hz; without a filter the forces themselves are compared.
TEST(Statistics, forces_that_cannot_be_filtered_are_not_judged)
{
  const std::string frequency = "Statistics.Filter frequency=";
  const Said beyond = say(scene, {frequency + "260", mean + "0, 100"});
  EXPECT_TRUE(
      has(beyond.log, "not judged: a filter at 260 Hz needs steps shorter than 0.000961538"))
      << beyond.log;
  const auto &contact = beyond.json["sliding_contacts"]["contact"];
  EXPECT_EQ(contact.count("filtered"), 0u);
  EXPECT_EQ(contact["raw"]["mean"].count("inside"), 0u);
  EXPECT_FALSE(contact["filter_frequency"]["resolved"].get<bool>());
  EXPECT_EQ(beyond.json["verdict"], "incomplete");

  const Said below = say(scene, {frequency + "240", mean + "0, 100"});
  EXPECT_TRUE(below.json["sliding_contacts"]["contact"]["filtered"]["mean"]["inside"].get<bool>());
  const Said none = say(scene, {frequency + "0", mean + "0, 100"});
  EXPECT_TRUE(none.json["sliding_contacts"]["contact"]["raw"]["mean"]["inside"].get<bool>());
  EXPECT_EQ(none.json["verdict"], "inside");
}

// Claim: statistics.json says what it is of, and value and range are in one unit, of SI. Expected:
// the entries of the file.
TEST(Statistics, the_run_is_named_and_ranges_have_the_unit_of_the_value)
{
  const Said said = say(scene, {"Statistics.Expected ranges.Uplift=0, 50",
                                "Statistics.Expected ranges.Contact loss=5, 45"});
  const nlohmann::json &j = said.json;
  EXPECT_EQ(j["scene"], "scene.prm");
  EXPECT_EQ(j["generator"], "network");
  EXPECT_EQ(j["scheme"], "generalised-alpha (spectral radius 0.8)");
  EXPECT_EQ(j["step"], nlohmann::json({{"value", 1e-3}, {"unit", "s"}}));
  EXPECT_EQ(j["end"]["value"], 2.2);
  EXPECT_FALSE(j["version"].get<std::string>().empty());
  const auto &uplift = j["probes"]["head"]["largest"],
             &loss = j["sliding_contacts"]["contact"]["contact_loss"];
  EXPECT_EQ(uplift["unit"], "m");
  EXPECT_EQ(uplift["expected"], nlohmann::json({0., .05}));
  EXPECT_EQ(uplift["inside"].get<bool>(), uplift["value"] <= .05);
  EXPECT_EQ(loss["unit"], "1");
  EXPECT_TRUE(loss["inside"].get<bool>());
  EXPECT_EQ(j["links"]["rod"]["impulse"]["unit"], "N s");
}

// A load that grows with time pulls a rod until the end: its impulse is c T^2 / 2, the mass has
// none. Forces at the ends of steps alone have half a step too much, 1.25 %.
TEST(Statistics, the_impulse_of_a_link_that_is_loaded_at_the_end)
{
  constexpr double rate = 30., until = .4;
  const nlohmann::json said =
      say("Gravity = 0, 0; Start = given\nMass m: Motions = y; Mass = 2e-3\n"
          "Link rod: Type = joint; From = ground; To = m; Direction = 0, 1; Stiffness = 1e6\n"
          "Load l: On = m; Magnitude = -" +
              number(rate) + "*t\nTime: Step = 0.01; End = " + number(until) +
              "; Scheme = generalised-alpha; Check steps = no\n",
          {})
          .json;
  const double exact = .5 * rate * until * until;
  EXPECT_NEAR(value(said["links"]["rod"], "impulse"), exact, 1e-3 * exact);
}
