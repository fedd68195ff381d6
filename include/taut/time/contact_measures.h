// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_contact_measures_h
#define taut_contact_measures_h

#include <taut/base/archive_forward.h>
#include <taut/base/warning.h>
#include <taut/interface/constraints.h>
#include <taut/time/energy_account.h>
#include <taut/time/state.h>
#include <taut/time/step_report.h>

#include <cstddef>
#include <string>
#include <vector>

namespace taut
{
  /**
   * Measures of the contacts of a run that show whether the scheme suits them. The residuals of a
   * step shows only that its equations are solved.
   *
   * Energy and momentum: see EnergyAccount.
   *
   * Gap: the largest penetration, or gap of a pressing constraint, of rigid unilateral constraints.
   *
   * Resolution: the largest force of a unilateral constraint over its largest mean across the
   * shortest time that its element resolves, max(step, 2 / omega_max). Far above one, the force is
   * an impulse over a step, and its size depends on the step.
   */
  class ContactMeasures
  {
  public:
    /// The arguments but @p start are kept by reference.
    ContactMeasures(const Structure &structure, const Constraints &constraints,
                    const EnergyAccount &energy, const State &start);

    /// Whether the scheme was chosen automatically and whether steps are adaptive: the advice of
    /// warnings depends on both.
    void set_scheme(const bool automatic, const bool adaptive)
    {
      is_automatic = automatic;
      is_adaptive = adaptive;
    }

    /// Records an accepted step, after the account.
    void record(const State &state, const StepReport &report);

    /// Measures so far, for checkpoints.
    void save(OutputArchive &archive);
    void load(InputArchive &archive);

    /// Name and path of a row that the summary() has, by its number.
    Constraints::Label label(std::size_t number) const;

    /// Mean of the force of a constraint over the time that its element resolves [N, N m].
    double mean_force(std::size_t i) const { return forces[i].mean; }

    /// Largest impulse of a constraint from closing to opening [N s, N m s].
    double largest_impulse(std::size_t i) const { return forces[i].largest_impulse; }

    struct Summary : EnergySummary
    {
      double gap = 0.;                      ///< [m, rad]
      std::size_t gap_constraint = no_link; ///< number; none: no gap
      std::size_t drifting_row = no_link;   ///< number; gap the largest above the motion of a step
      double drifting_gap = 0.;             ///< [m, rad]
      bool drift_is_rotation = false;
      double resolution = 1.;                           ///< [1]
      std::size_t resolution_row = no_link;             ///< number
      double peak = 0., mean_peak = 0., mean_time = 0.; ///< of this constraint [N, N m; s]
    };

    /// Of the rows of all ranks, until the last recorded step.
    Summary summary() const { return constraints.shared() ? agreed : found_now(); }

    /// Parts of the scale above which contact energy is a warning, and an error: a fifth of the 5 %
    /// that a run promises of energies, and twice that.
    static constexpr double suspicious_energy = 1e-2, wrong_energy = .1;

    /// Part of the impulse above which a momentum error is a warning: the 2 % that a run promises
    /// of impulses.
    static constexpr double suspicious_momentum = .02;

    /// Largest force over its largest mean in the window of add_force() above which the report
    /// mentions it. A choice: a peak that is resolved is less than twice its mean there, as a half
    /// sine is pi / 2 times its own.
    static constexpr double unresolved = 3.;

    /// A contact that left its wire across an end of it and was pressed there.
    struct WireEnd
    {
      double time = 0.;   ///< [s]
      double force = 0.;  ///< in the step before; 0: there was none [N]
      double energy = 0.; ///< that its spring held, and that nothing has from then on [J]

      template <typename Archive>
      void serialize(Archive &archive, unsigned int)
      {
        archive &time &force &energy;
      }
    };

    /// The end with the largest force that a constraint crossed.
    const WireEnd &wire_end(const std::size_t i) const { return forces[i].end; }

    /// Part of its largest force at which a contact is pressed at the end of its wire: the force
    /// that it loses at once is then a load of its own.
    static constexpr double pressed_at_end = 1e-2;

    /// Warnings for the measures beyond their bounds.
    std::vector<Warning> warnings() const;

    /// One line for the log, without the warnings.
    std::string report() const;

    /// Message for a run with an energy beyond wrong_energy; empty: no error.
    std::string error() const;

    /// Path in the parameter file that error() is about; empty: the whole file.
    std::string error_origin() const;

  private:
    /// History of the force of a constraint.
    struct Force
    {
      double window = 0.;                              ///< [s]; 0: one step
      std::vector<std::pair<double, double>> impulses; ///< time and impulse until then
      std::size_t first = 0;                           ///< of the impulses in the window
      double impulse = 0., last = 0., mean = 0., peak = 0., mean_peak = 0.;
      double event_impulse = 0., largest_impulse = 0.;
      double gap = 0., motion = 0.; ///< largest, and of a step [m, rad]
      WireEnd end;

      template <typename Archive>
      void serialize(Archive &archive, unsigned int)
      {
        archive &impulses &impulse &mean &peak &mean_peak &event_impulse;
        archive &largest_impulse &gap &motion &last &end;
      }
    };

    template <typename Archive>
    void store(Archive &archive);
    Summary found_now() const;
    void agree();
    void add_force(Force &force, double t, double dt, double value);
    static void forget_past(Force &force);
    std::string energy_message(const Summary &s) const;
    std::string remedy() const;
    void add_gap(std::size_t i, const State &state, const StepReport &report);
    void add_wire_end(std::size_t i, const State &state);
    std::vector<double> resolved_times() const;

    const Structure &structure;
    const Constraints &constraints;
    const EnergyAccount &energy;
    std::vector<Force> forces;
    bool is_automatic = false, is_adaptive = false;
    double largest_gap = 0.;                      ///< of the rows of this rank [m, rad]
    std::size_t gap_row = no_link;                ///< row with the largest gap
    Summary agreed;                               ///< where rows are distributed
    std::vector<std::size_t> numbers;             ///< of the rows in the summary, ascending
    std::vector<Constraints::Label> labels;       ///< of the rows in the summary
    mutable std::vector<double> largest, of_rows; ///< in found_now()
    mutable std::vector<std::size_t> number;
  };
} // namespace taut

#endif
