// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/dot.h>
#include <taut/time/energy_gains.h>

#include <cmath>
#include <functional>

namespace taut
{
  EnergyGains::EnergyGains(const Structure &structure, const Constraints &constraints,
                           NonlinearStep &nonlinear, const ContactStep &contacts)
      : structure(structure), constraints(constraints), nonlinear(nonlinear), contacts(contacts),
        groups(structure, constraints)
  {
    bool here = false;
    for (std::size_t k = 0; k < structure.size(); ++k)
      here = here || structure[k].has_moving_constraints();
    supports_move = structure.communicator().any(here);
  }

  void EnergyGains::start(const State &state)
  {
    kinetic.assign(groups.n_groups(), 0.);
    add_kinetic_energies(state.V, kinetic);
    structure.communicator().sum(kinetic);
  }

  /// Adds V . M V / 2 of each body to its group.
  void EnergyGains::add_kinetic_energies(const BodyVectors &V, std::vector<double> &of_groups)
  {
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      product.resize(V[k].size());
      structure[k].mass().vmult_rows(0, product.size(), V[k].data(), product.data());
      of_groups[groups.of_body(k)] += .5 * dot_in_lanes(V[k], product);
    }
  }

  void EnergyGains::add_surplus(const double theta, const State &state, double *const of_groups)
  {
    const auto add = [&]
    {
      for (const std::size_t k : nonlinear.bodies().indices())
        of_groups[groups.of_body(k)] += nonlinear.bodies().energy_surplus(k, theta, state);
    };
    structure.communicator().agree(std::ref(add)); // a reference allocates nothing
  }

  /// Contribution of a constraint with a mean force: the change of its spring energy, or minus its
  /// work if it slides.
  double EnergyGains::gain_of_spring(const std::size_t i, const State &state,
                                     const StepReport &report) const
  {
    const ConstraintData &constraint = constraints[i];
    if (!report.is_mean(i))
      return 0.;
    if (constraints.slides(i))
      return -report.work[i];
    if (constraint.spring.is_rigid())
      return 0.;
    const State::LinkSpring &spring = state.link_springs[i];
    const double before = spring.u - spring.du;
    return constraint.spring.law
               ? constraint.spring.law->mean_force(before, spring.u) * spring.du
               : .5 * constraint.spring.stiffness * (spring.u * spring.u - before * before);
  }

  void EnergyGains::measure(const BalanceCertificate &balance, const State &state,
                            StepReport &report)
  {
    const std::size_t n = groups.n_groups();
    sums.assign(2 * n, 0.);
    add_surplus(.5, state, sums.data() + n);
    for (std::size_t k = 0; k < structure.size(); ++k)
      sums[n + groups.of_body(k)] -= balance.work(k);
    add_kinetic_energies(state.V, sums);
    structure.communicator().sum(sums);
    for (std::size_t i = 0; i < constraints.size(); ++i)
      sums[n + groups.of_constraint(i)] += gain_of_spring(i, state, report);
    report.gains.assign(n, 0.);
    for (std::size_t g = 0; g < n; ++g)
    {
      if (!supports_move)
        report.gains[g] = sums[g] - kinetic[g] + sums[n + g];
      kinetic[g] = sums[g];
    }
  }

  void EnergyGains::measure_at_ends(const State &state, StepReport &report)
  {
    std::vector<double> lost(groups.n_groups(), 0.);
    sums.assign(groups.n_groups(), 0.);
    add_surplus(1., state, sums.data());
    BodyVectors change = state.V;
    for (std::size_t k = 0; k < change.size(); ++k)
      for (std::size_t i = 0; i < change[k].size(); ++i)
        change[k][i] -= state.V_old[k][i];
    add_kinetic_energies(change, lost);
    for (std::size_t g = 0; g < sums.size(); ++g)
      sums[g] -= lost[g];
    structure.communicator().sum(sums);
    for (const std::size_t i : constraints.turning_rows())
      sums[groups.of_constraint(i)] +=
          nonlinear.constraints().surplus(i, state.multiplier[i], contacts.increments()[i]);
    report.gains = sums;
  }
} // namespace taut
