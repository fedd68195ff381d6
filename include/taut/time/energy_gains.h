// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_energy_gains_h
#define taut_energy_gains_h

#include <taut/interface/connected_bodies.h>
#include <taut/time/balance_certificate.h>
#include <taut/time/contact_step.h>
#include <taut/time/nonlinear_step.h>

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
                NonlinearStep &nonlinear, const ContactStep &contacts);

    /// Begins from a state.
    void start(const State &state);

    /**
     * With mean forces: the change of the kinetic energy of each group, minus the work of all
     * forces but those of fixed constraints with mean forces, plus the change of their spring
     * energy. The gain is not positive, except for rounding. It is not measured if supports move,
     * as it would need the work of their forces. Nonlinear bodies count with their own energy, so
     * that a wrong mean force shows. @p balance is that of the step.
     */
    void measure(const BalanceCertificate &balance, const State &state, StepReport &report);

    /// Gains with backward Euler and forces at the ends of steps. A body with a non-convex energy
    /// gains more than the work of its forces at the end of the step. The scheme dissipates the
    /// kinetic energy of the change of velocity. The gain of a group is the difference.
    void measure_at_ends(const State &state, StepReport &report);

    /// Kinetic energy of each group at the end of the last step of measure(), or at the start [J].
    const std::vector<double> &kinetic_energies() const { return kinetic; }
    void set_kinetic_energies(const std::vector<double> &of_groups) { kinetic = of_groups; }

  private:
    void add_kinetic_energies(const BodyVectors &V, std::vector<double> &of_groups);
    void add_surplus(double theta, const State &state, double *of_groups);
    double gain_of_spring(std::size_t i, const State &state, const StepReport &report) const;

    const Structure &structure;
    const Constraints &constraints;
    NonlinearStep &nonlinear;
    const ContactStep &contacts;
    const ConnectedBodies groups;
    bool supports_move = false; ///< of any rank
    std::vector<double> kinetic, sums, product;
  };
} // namespace taut

#endif
