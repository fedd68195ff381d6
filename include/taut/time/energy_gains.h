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
  /// Energy that groups of connected bodies gain in a step from nowhere [J]: what neither loads nor
  /// moving constraints gave. All functions are called by all ranks together.
  class EnergyGains
  {
  public:
    /// The arguments are kept by reference.
    EnergyGains(const Structure &structure, const Constraints &constraints,
                NonlinearBodies &nonlinear, const ContactConditions &conditions,
                const TurningConstraints &turning);

    /// Kinetic energies of the groups at the start, into the state.
    void start(State &state);

    /**
     * With mean forces. Of each group the change of kinetic energy, minus the work of all forces
     * but those of fixed constraints with a mean force, plus what the springs of these take: not
     * positive but for rounding. Where supports move it would be the work of their forces, too, and
     * is not measured. The energies of bodies that are not linear are their own, so that a mean
     * force that is not theirs shows. @p balance is that of the step.
     */
    void measure(const BalanceCertificate &balance, State &state, Certificate &certificate);

    /**
     * Backward Euler with forces at the ends of steps: kinetic energy falls by the work of inertia
     * and by that of the change of velocity with itself, and the energies of bodies rise by more
     * than the work of their forces at the end where they are not convex. The sum of both gains
     * comes from nowhere.
     */
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
    bool supports_move = false; ///< of a body of some rank
    std::vector<double> sums, product;
  };
} // namespace taut

#endif
