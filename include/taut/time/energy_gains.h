// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_energy_gains_h
#define taut_energy_gains_h

#include <taut/interface/connected_bodies.h>
#include <taut/time/balance_certificate.h>
#include <taut/time/contact_conditions.h>
#include <taut/time/nonlinear_bodies.h>

#include <vector>

namespace taut
{
  /// Energy that groups of connected bodies gain in a step beyond the work of loads and moving
  /// constraints [J]. All functions are called by all ranks together.
  class EnergyGains
  {
  public:
    /// The arguments are kept by reference.
    EnergyGains(const Structure &structure, const Constraints &constraints,
                NonlinearBodies &nonlinear, const ContactConditions &conditions,
                const TurningConstraints &turning);

    /// Stores the kinetic energies of the groups at the start in the state.
    void start(State &state);

    /**
     * With mean forces: the change of the kinetic energy of each group, minus the work of all
     * forces but those of fixed constraints with mean forces, plus the change of their spring
     * energy. The gain is not positive, except for rounding. It is not measured if supports move,
     * as it would need the work of their forces. Nonlinear bodies count with their own energy, so
     * that a wrong mean force shows. @p balance is that of the step.
     */
    void measure(const BalanceCertificate &balance, State &state, Certificate &certificate);

    /// Gains with backward Euler and forces at the ends of steps. A body with a non-convex energy
    /// gains more than the work of its forces at the end of the step. The scheme dissipates the
    /// kinetic energy of the change of velocity. The gain of a group is the difference.
    void measure_at_ends(State &state, Certificate &certificate);

  private:
    void add_kinetic_energies(const BodyVectors &V, std::vector<double> &of_groups);
    void add_surplus(double theta, const State &state, double *of_groups);
    double gain_of_spring(std::size_t i, const State &state) const;

    const Structure &structure;
    const Constraints &constraints;
    NonlinearBodies &nonlinear;
    const ContactConditions &conditions;
    const TurningConstraints &turning;
    const ConnectedBodies groups;
    bool supports_move = false; ///< of any rank
    std::vector<double> sums, product;
  };
} // namespace taut

#endif
