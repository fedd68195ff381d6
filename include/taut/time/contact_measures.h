// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_contact_measures_h
#define taut_contact_measures_h

#include <taut/base/archive_forward.h>
#include <taut/interface/constraints.h>
#include <taut/time/certificate.h>
#include <taut/time/integrator.h>
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
   * Contact energy: what contacts gave that only can take it. Forces at the ends of steps do the
   * work W = (N_0 + N_1)(D_1 - D_0) / 2 on a unilateral constraint, and the positive ones are
   * summed; with mean forces on conditions on velocities W = N (D_1 - D_0); with mean forces and
   * conditions on gaps, where W cannot be positive, it is the gain of energy of the whole system
   * that nothing explains (Certificate::energy_gain). Over the largest kinetic energy plus the
   * largest strain energy plus the largest work of loads, measured from the reference.
   *
   * Energy of large motions: the gains of energy that nothing explains (Certificate::energy_gain)
   * of all steps of a system with a body that is not linear, over the same.
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
      double contact_energy = 0.;                ///< [J]
      double scale = 0.;                         ///< kinetic + strain + loads, and rounding [J]
      double relative_energy = 0.;               ///< contact energy over the scale [1]
      double motion_energy = 0.;                 ///< of large motions [J]
      double relative_motion_energy = 0.;        ///< over the scale [1]
      std::size_t energy_constraint = 0;         ///< of the contact that gave most
      double energy_begin = 0., energy_end = 0.; ///< when it closed and opened [s]
      double gap = 0.;                           ///< [m, rad]
      std::size_t gap_constraint = 0;
      bool gap_drifts = false; ///< more than a step of motion
      double resolution = 1.;  ///< [1]
      std::size_t resolution_row = 0;
      double peak = 0., mean_peak = 0., mean_time = 0.; ///< of that constraint [N, N m; s]
    };
    Summary summary() const;

    /// Part of the scale from which a gain of energy is a warning, and an error.
    static constexpr double suspicious_energy = 1e-2, wrong_energy = .1;

    /// Resolution above which it is said.
    static constexpr double unresolved = 3.;

    /// A measure beyond its bound.
    struct Warning
    {
      std::string kind; ///< an identifier
      std::string message;
      double value = 0., limit = 0., time = 0.; ///< [1; 1; s]
    };
    std::vector<Warning> warnings() const;

    /// One line for the log, and one for each warning.
    std::string report() const;

    /// The message of a run with a gain of energy beyond wrong_energy; empty if it has none.
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
      double event_energy = 0., event_begin = 0.;
      double gap = 0., motion = 0.; ///< largest, and of a step [m, rad]
    };

    template <typename Archive>
    void store(Archive &archive);
    void add_force(Force &force, double t, double dt, double value);
    void add_energy(std::size_t i, const State &state, const StepCoefficients &c);
    void add_gap(std::size_t i, const State &state, const StepCoefficients &c);
    void measure_rest(const State &start);
    void measure_scale(const State &state, const Certificate &certificate);
    std::vector<double> resolved_times() const;

    const Structure &structure;
    const Constraints &constraints;
    const Reference &reference;
    std::vector<Force> forces;
    std::vector<double> multiplier0, gap0, noise;
    bool moves_far = false; ///< a body of some rank is not linear
    Summary found;
    double worst_event = 0.;
    double kinetic = 0., strain = 0., loads = 0.; ///< largest so far [J]
    double rest = 0.;                             ///< rounding at rest [J]
    double rest_of_step = 0.;                     ///< in a step of bodies that are not linear [J]
    long n_steps = 0;
    std::vector<double> work;
  };
} // namespace taut

#endif
