// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/time/time_stepper.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace taut
{
  /**
   * The change of kinetic energy, minus the work of all forces but those of fixed constraints with
   * a mean force, plus what the springs of these take: not positive but for rounding. Where
   * supports move it would be the work of their forces, too, and is not measured. The energies of
   * bodies that are not linear are their own, so that a mean force that is not theirs shows.
   */
  void TimeStepper::measure_energy()
  {
    double sums[] = {0., -balance.work()};
    structure.communicator().agree([&] { sums[1] += nonlinear.energy_surplus(.5, current); });
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      std::vector<double> &V = current.V[k], &product = work_a;
      std::fill(product.begin(), product.end(), 0.);
      structure[k].mass().vmult_add(.5, V.data(), product.data());
      sums[0] += std::inner_product(V.begin(), V.end(), product.begin(), 0.);
    }
    structure.communicator().sum(sums, 2);
    double gain = sums[0] - current.kinetic_energy + sums[1];
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      if (!constraint_motions.mean_force(i))
        continue;
      if (constraints[i].moving)
        gain -= current.constraint_work[i];
      if (!constraints[i].moving && !std::isinf(constraints[i].stiffness))
      {
        const State::LinkSpring &spring = current.link_springs[i];
        const double before = spring.u - spring.du;
        gain += constraints[i].law
                    ? constraints[i].law->mean_force(before, spring.u) * spring.du
                    : .5 * constraints[i].stiffness * (spring.u * spring.u - before * before);
      }
    }
    last.kinetic_energy = current.kinetic_energy = sums[0];
    last.energy_gain = supports_move ? 0. : gain;
  }
} // namespace taut
