// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_contact_measures_h
#define taut_contact_measures_h

#include <taut/base/archive_forward.h>
#include <taut/base/warning.h>
#include <taut/interface/constraints.h>
#include <taut/time/certificate.h>
#include <taut/time/integrator.h>
#include <taut/time/link_energies.h>
#include <taut/time/motion_record.h>
#include <taut/time/state.h>

#include <deque>
#include <string>
#include <vector>

namespace taut
{
  /**
   * What a run's contacts did, where the certificate of each step sees nothing: it proves that a
   * step's equations are solved, not that the scheme suits the contacts.
   *
   * Contact energy: what a constraint gave or took beside what its spring stores and its damper
   * takes, see LinkEnergies, over the energy of the bodies that it is connected with. Where rigid
   * constraints have mean forces and conditions on gaps, what a group of connected bodies gained
   * that nothing explains (State::energy_gains) counts, too.
   *
   * Momentum: what a body lacks after a contact whose energy is not right, over the largest impulse
   * of a constraint of its group.
   *
   * Energy of large motions: the gains of energy that nothing explains of all steps, of a group
   * with a body that is not linear, over the same.
   *
   * Gap: the largest penetration, or gap of a constraint that presses, of rigid unilateral
   * constraints.
   *
   * Resolution: largest force of a unilateral constraint over the largest of its means across the
   * shortest time that its element resolves, max(step, 2 / omega_max). Far above one, the force is
   * an impulse over a step, and its size says how short the step is.
   */
  class ContactMeasures
  {
  public:
    /// The arguments but @p start are kept by reference.
    ContactMeasures(const Structure &structure, const Constraints &constraints,
                    const Reference &reference, const State &start);

    /// Whether the scheme was chosen by its constraints, and by whose step: what to do about a
    /// wrong contact depends on it.
    void set_scheme(const bool automatic, const bool adaptive)
    {
      is_automatic = automatic;
      is_adaptive = adaptive;
    }

    /// An accepted step, made with these coefficients. Called by all ranks together.
    void record(const State &state, const StepCoefficients &c, const Certificate &certificate);

    /// For checkpoints: what was measured so far.
    void save(OutputArchive &archive);
    void load(InputArchive &archive);

    /// Mean of the force of a constraint over the time that its element resolves [N, N m].
    double mean_force(std::size_t i) const { return forces[i].mean; }

    /// Largest impulse of a constraint from closing to opening [N s, N m s].
    double largest_impulse(std::size_t i) const { return forces[i].largest_impulse; }

    /// Results of the run so far.
    struct Summary
    {
      double contact_energy = 0.;                ///< given and taken by the worst constraint [J]
      double taken = 0.;                         ///< of that what it took [J]
      double scale = 0.;                         ///< of its group, see LinkEnergies [J]
      double relative_energy = 0.;               ///< contact energy over the scale [1]
      double contact_time = 0., step = 0.;       ///< its shortest contact, and its step [s]
      double motion_energy = 0.;                 ///< of large motions [J]
      double relative_motion_energy = 0.;        ///< over the scale [1]
      std::size_t energy_constraint = 0;         ///< the worst one
      double energy_begin = 0., energy_end = 0.; ///< of its largest contact [s]
      double relative_momentum = 0.; ///< of such an energy, over the largest impulse of a group [1]
      std::size_t momentum_constraint = 0;
      double gap = 0.; ///< [m, rad]
      std::size_t gap_constraint = 0;
      bool gap_drifts = false; ///< more than a step of motion
      double resolution = 1.;  ///< [1]
      std::size_t resolution_row = 0;
      double peak = 0., mean_peak = 0., mean_time = 0.; ///< of that constraint [N, N m; s]
    };
    Summary summary() const;

    /// Part of the scale from which energy given or taken is a warning, and an error.
    static constexpr double suspicious_energy = 1e-2, wrong_energy = .1;

    /// Part of the largest impulse from which the momentum of such an energy is a warning.
    static constexpr double suspicious_momentum = MotionDifference::impulse_bound;

    /// Resolution above which it is said.
    static constexpr double unresolved = 3.;

    /// Of the measures beyond their bounds.
    std::vector<Warning> warnings() const;

    /// One line for the log, and one for each warning.
    std::string report() const;

    /// The message of a run with an energy beyond wrong_energy; empty if it has none.
    std::string error() const;

    /// Path in the parameter file of what error() is about; empty: all of it.
    std::string error_origin() const;

  private:
    /// Force of a constraint in time.
    struct Force
    {
      double window = 0.; ///< [s]; 0: each step for itself
      std::deque<std::pair<double, double>>
          impulses; ///< time and impulse until then, in the window
      double impulse = 0., mean = 0., peak = 0., mean_peak = 0.;
      double event_impulse = 0., largest_impulse = 0.;
      double gap = 0., motion = 0.; ///< largest, and of a step [m, rad]
    };

    template <typename Archive>
    void store(Archive &archive);
    void add_force(Force &force, double t, double dt, double value);
    void add_gains(const State &state, const StepCoefficients &c);
    void find_contact_energy(Summary &result) const;
    void find_momentum(Summary &result) const;
    std::string energy_message(const Summary &s) const;
    std::string remedy() const;
    void add_gap(std::size_t i, const State &state, const StepCoefficients &c);
    void measure_rest(const State &start);
    std::vector<double> resolved_times() const;

    const Structure &structure;
    const Constraints &constraints;
    const Reference &reference;
    std::vector<Force> forces;
    LinkEnergies energies;
    std::vector<char> moves_far;                     ///< groups with a body that is not linear
    std::vector<double> contact_gains, motion_gains; ///< of the groups [J]
    std::vector<double> rest_of_step;                ///< rounding in a step of the latter [J]
    std::vector<std::size_t> first_one_sided;        ///< constraint of each group
    bool is_automatic = false, is_adaptive = false;
    Summary found;
    long n_steps = 0;
  };
} // namespace taut

#endif
