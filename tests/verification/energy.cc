// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: energy.csv accounts for all energy of a run. Sources: closed form of a damped oscillator
// under a constant force; an identity of each scheme elsewhere (the error is rounding); a rigid
// impact takes what Newton's law says.
#include "scene_tests.h"

using namespace verification;

namespace
{
  /// Columns of energy.csv.
  enum Column
  {
    seconds,
    kinetic,
    strain,
    links,
    loads,
    supports,
    contacts,
    damping,
    link_dampers,
    algorithmic,
    error,
    n_columns
  };

  std::vector<std::vector<double>> energies(const std::string &scene, const Overrides &overrides)
  {
    Session session(scene, overrides + Overrides{"Output.Observers=energy", "Output.Interval=0"});
    session.run();
    std::istringstream lines(file_text(session.folder() + "/energy.csv"));
    std::vector<std::vector<double>> table;
    std::string line;
    std::getline(lines, line);
    while (std::getline(lines, line))
    {
      table.emplace_back();
      for (const std::string &cell : cells_of(line))
        table.back().push_back(std::stod(cell));
      EXPECT_EQ(table.back().size(), std::size_t(n_columns));
    }
    return table;
  }

  /// Largest error of the balance over the largest energy or work.
  double relative_error(const std::vector<std::vector<double>> &table)
  {
    double largest = 0., size = 0.;
    for (const std::vector<double> &constraint : table)
    {
      raise(largest, constraint[error]);
      for (int i = kinetic; i < error; ++i)
        raise(size, constraint[i]);
    }
    return largest / size;
  }
} // namespace

// 2 kg, 800 N/m, 8 N s/m, 10 N from the start, released at rest at 50 mm: u = p + e^(-d t)
// (a cos w t + b sin w t) with p = 10/800, d = 2, w = sqrt(400 - 4).
TEST(Energy, of_a_damped_oscillator)
{
  const std::string scene =
      R"(Gravity = 0, 0; Start = given
Mass mass: Mass = 2; Motions = y; Initial displacement = 0, 0.05, 0
Spring spring: From = ground; To = mass; Stiffness = 800; Damping = 8
Load force: Type = point; On = mass; Magnitude = 10
Time: Scheme = Newmark; Step = 1e-4; End = 0.5
)";
  const auto table = energies(scene, {});
  const double p = 10. / 800., d = 2., w = std::sqrt(400. - 4.), a = .05 - p, b = d * a / w, t = .5,
               e = std::exp(-d * t);
  const double u = p + e * (a * std::cos(w * t) + b * std::sin(w * t)),
               v = e * ((-d * a + w * b) * std::cos(w * t) + (-d * b - w * a) * std::sin(w * t));
  const double exact_kinetic = v * v, exact_strain = 400. * u * u, exact_loads = 10. * (u - .05),
               exact_damping = 400. * .05 * .05 + exact_loads - exact_kinetic - exact_strain;
  const std::vector<double> &last = table.back();
  figure("damped oscillator, kinetic energy over exact - 1", last[kinetic] / exact_kinetic - 1.);
  figure("damped oscillator, dissipated energy over exact - 1", last[damping] / exact_damping - 1.);
  EXPECT_NEAR(last[seconds], .5, 1e-12);
  EXPECT_NEAR(last[kinetic], exact_kinetic, 2e-3 * exact_damping);
  EXPECT_NEAR(last[strain], exact_strain, 2e-3 * exact_damping);
  EXPECT_NEAR(last[loads], exact_loads, 2e-3 * exact_damping);
  EXPECT_NEAR(last[damping], exact_damping, 2e-3 * exact_damping);
  EXPECT_LT(relative_error(table), 1e-12);
}

TEST(Energy, every_scheme_accounts_for_every_scene)
{
  for (const std::string scheme : {"backward Euler", "BDF2", "Newmark", "generalised-alpha", "HHT",
                                   "Moreau-Jean", "velocities", "gaps"})
    for (const std::string scene : {"en50318_2002_250", "bar_on_wall", "oscillator_with_stop"})
    {
      // Also where contacts give energy, as Newmark's do on the wall.
      Overrides overrides = {"Time.Scheme=" + scheme, "Time.End=0.7",
                             "Statistics.Window=", "Time.Allow energy gain=true"};
      if (scheme == "gaps" || scheme == "velocities")
        overrides = {"Time.Scheme=Moreau-Jean", "Time.Moreau-Jean.Conditions=" + scheme,
                     "Time.End=0.7", "Time.Allow energy gain=true", "Statistics.Window="};
      const double defect = relative_error(energies(scene_file(scene), overrides));
      figure(scene + ", " + scheme + ", error of the energy balance", defect);
      EXPECT_LT(defect, 1e-9) << scheme << ", " << scene;
    }
}

// A mean force closes a gap D_0 to zero: it does the work -N D_0 and never gives energy, on any
// mesh and at any step, even where forces ring.
TEST(Energy, conditions_on_gaps_never_give_any)
{
  for (const std::string matrix : {"consistent", "lumped", "reduced"})
    for (const std::string step : {"2e-4", "8.33333333333333333e-4", "1.7e-3"})
    {
      const auto table = energies(scene_file("bar_on_wall"),
                                  {"Time.Scheme=Moreau-Jean", "Time.Moreau-Jean.Conditions=gaps",
                                   "Network.Wire bar.Mass matrix=" + matrix, "Time.Step=" + step});
      double gained = 0.;
      for (std::size_t i = 1; i < table.size(); ++i)
        gained = std::max(gained, table[i][contacts] - table[i - 1][contacts]);
      EXPECT_LT(gained, 1e-9 * table[0][kinetic]) << matrix << ", " << step;
      EXPECT_LT(table.back()[contacts], 0.) << matrix << ", " << step;
      EXPECT_NEAR(table.back()[algorithmic], 0., 1e-9 * table[0][kinetic])
          << matrix << ", " << step;
    }
}

// 2 kg fall on a rigid floor with restitution 1/2: a quarter of the kinetic energy is left.
TEST(Energy, an_impact_takes_what_newtons_law_says)
{
  const auto table = energies(R"(Gravity = 0, 0; Start = given
Mass ball: Mass = 2; Initial velocity = 0, -3, 0
Link floor: Type = stop; From = ground; To = ball; Direction = 0, 1; Gap = 0.8
Time: Scheme = Moreau-Jean; Step = 1e-3; End = 0.5
Time/Moreau-Jean: Restitution = 0.5
)",
                              {});
  EXPECT_NEAR(table.front()[kinetic], 9., 1e-12);
  EXPECT_NEAR(table.back()[kinetic], 2.25, 1e-12);
  EXPECT_NEAR(table.back()[contacts], -6.75, 1e-9);
  EXPECT_NEAR(table.back()[algorithmic], 0., 1e-9);
}

// Claim: a support that is displaced and stands is a support. A string that a force swings against
// a spring, with ends that are 10 mm up. Reference: the same string, drawn 10 mm higher. Expected:
// the same motion, and in each step the same balance of energy, which no moving support hides.
TEST(Energy, a_support_with_a_constant_displacement_stands)
{
  struct Record
  {
    std::vector<double> height, gain;
    double first = 0.;
  };
  const auto run = [](const double y, const double of_ends, const std::string &start)
  {
    Record result;
    const auto record = [&](const taut::StepView &view)
    {
      const double at = y + displacement(view, 0, 5.);
      if (result.height.empty())
        result.first = y + displacement(view, 0, 10.);
      result.height.push_back(at);
      for (const double gain : view.report.gains)
        result.gain.push_back(gain);
    };
    run_scene("Gravity = 0, 0; Start = " + start + "\nWire line: From = 0, " + number(y) +
                  "; To = 10, " + number(y) +
                  "; Components = string; Mass per length = 1; Tension = 1000; "
                  "Element size = 0.25\nSupport ends: Wire = line; Positions = 0, 10; "
                  "Displacement = " +
                  number(of_ends) +
                  "\nLoad push: Type = point; On = line @ 3; Magnitude = 100*sin(20*t)\n"
                  "Link stop: Type = stop; From = ground; To = line @ 5; Direction = 0, 1; "
                  "Stiffness = 1e5; Gap = " +
                  number(.02 - of_ends) + "\nTime: Step = 1e-3; End = 0.5\n",
              {"Time.Scheme=Moreau-Jean", "Time.Moreau-Jean.Conditions=gaps"}, record);
    return result;
  };
  const Record higher = run(.01, 0., "equilibrium"), displaced = run(0., .01, "equilibrium");
  ASSERT_EQ(displaced.height.size(), higher.height.size());
  ASSERT_EQ(displaced.gain.size(), higher.gain.size());
  double worst = 0., worst_gain = 0., largest_gain = 0.;
  for (std::size_t i = 0; i < higher.height.size(); ++i)
    raise(worst, std::fabs(displaced.height[i] - higher.height[i]));
  for (std::size_t i = 0; i < higher.gain.size(); ++i)
  {
    raise(worst_gain, std::fabs(displaced.gain[i] - higher.gain[i]));
    raise(largest_gain, displaced.gain[i]);
  }
  EXPECT_LT(worst, 1e-12);
  EXPECT_LT(worst_gain, 1e-12);
  EXPECT_GT(largest_gain, 0.) << "rounding at least, or the balance is not measured";
  EXPECT_EQ(run(0., .01, "undeformed").first, .01);
}
