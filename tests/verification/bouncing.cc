// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: the elastic bar that bounces on a rigid floor keeps touching it when the exact solution
// does, with its force and its energy, for ten periods of 16/3 s (D. Doyen, A. Ern, S. Piperno,
// SIAM J. Sci. Comput. 33 (2011), 223-249: contacts at 1 .. 5/3 and 11/3 .. 13/3 s of each period,
// force between 300 and 500 N).
#include "run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace verification;

namespace
{
  struct Contact
  {
    double first = 0., last = 0., impulse = 0., largest = 0.;
  };

  /// Kinetic, elastic and potential energy of the first body; displacements count from the
  /// undeformed bar.
  double energy(const taut::StepView &view)
  {
    const taut::Substructure &body = view.structure[0];
    const std::vector<double> &U = view.state.U[0], &V = view.state.V[0];
    std::vector<double> MV(body.n_dofs(), 0.), KU(body.n_dofs(), 0.), P;
    body.mass().vmult_add(1., V.data(), MV.data());
    body.stiffness().vmult_add(1., U.data(), KU.data());
    body.external_force(0., P);
    double sum = 0.;
    for (std::size_t i = 0; i < U.size(); ++i)
      sum += .5 * (MV[i] * V[i] + KU[i] * U[i]) - P[i] * U[i];
    return sum;
  }
} // namespace

// HHT (0.002), reduced linear elements of 12.5 mm, step = element / wave speed.
TEST(BouncingBar, contacts_force_and_energy_last_for_ten_periods)
{
  const double period = 16. / 3., step = 1. / 2400.;
  std::vector<Contact> contacts(20);
  double largest = 0., potential = 0., first_energy = 0., last_energy = 0.;
  run_scene(scene_file("bouncing_bar"),
            {"Network.Wire bar.Element size=0.0125", "Time.Step=4.16666666666666667e-4",
             "Time.HHT.Alpha=0.002"},
            [&](const taut::StepView &view)
            {
              const double t = view.state.time, N = view.state.multiplier[0];
              if (t == 0.)
                first_energy = energy(view);
              if (t > 10. * period - 1.5 * step)
                last_energy = energy(view);
              largest = std::max(largest, N);
              potential = 10. * 10. * 5.;
              // One contact in each half of a period.
              const auto index = static_cast<std::size_t>(2. * t / period);
              if (!(N > 0.) || index >= contacts.size())
                return;
              Contact &c = contacts[index];
              if (c.impulse == 0.)
                c.first = t;
              c.last = t;
              c.impulse += N * step;
              c.largest = std::max(c.largest, N);
            });
  for (const std::size_t i : {0, 9})
  {
    const Contact &c = contacts[i];
    const double begin = (i / 2) * period + (i % 2 == 0 ? 1. : 11. / 3.), length = 2. / 3.,
                 lasted = c.last - c.first + step;
    const std::string name = "bouncing bar, contact " + std::to_string(i + 1) + ", ";
    figure(name + "begins late by", c.first - begin, "s");
    figure(name + "ends late by", c.last - begin - length, "s");
    figure(name + "length over the exact one - 1", lasted / length - 1.);
    figure(name + "mean force over 400 N - 1", c.impulse / lasted / 400. - 1.);
    figure(name + "largest force over 500 N", c.largest / 500.);
    EXPECT_NEAR(c.first, begin, .01 * period) << i;
    EXPECT_NEAR(c.last, begin + length, .01 * period) << i;
    EXPECT_NEAR(lasted, length, .01 * length) << i;
    EXPECT_NEAR(c.impulse / lasted, 400., .02 * 400.) << i;
  }
  figure("bouncing bar, largest force of all contacts over 500 N", largest / 500.);
  figure("bouncing bar, change of energy in ten periods over that of the fall",
         (last_energy - first_energy) / potential);
  EXPECT_LT(largest, 1.25 * 500.);
  EXPECT_NEAR(last_energy, first_energy, .01 * potential);
}
