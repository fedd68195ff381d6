// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_energy_account_h
#define taut_energy_account_h

#include <taut/base/archive_forward.h>
#include <taut/interface/connected_bodies.h>
#include <taut/time/state.h>
#include <taut/time/step_report.h>

#include <cstddef>
#include <limits>
#include <vector>

namespace taut
{
  class NonlinearStep;
  class Step;

  /// What an EnergyAccount says about a run: the worst contact, and large motions.
  struct EnergySummary
  {
    double contact_energy = 0.;                ///< given and taken by the worst constraint [J]
    double taken = 0.;                         ///< part of it that the constraint took [J]
    double scale = 0.;                         ///< energy of its group [J]
    double relative_energy = 0.;               ///< contact energy over the scale [1]
    double contact_time = 0., step = 0.;       ///< its shortest contact, and the step then [s]
    double motion_energy = 0.;                 ///< gained in large motions [J]
    double relative_motion_energy = 0.;        ///< over the scale [1]
    std::size_t energy_constraint = no_link;   ///< number of the worst constraint; none: no energy
    double energy_begin = 0., energy_end = 0.; ///< of its largest contact [s]
    double momentum = 0.;                      ///< error of a contact [N s, N m s]
    double relative_momentum = 0.;             ///< over the impulse of a contact of its group [1]
    std::size_t momentum_constraint = no_link; ///< number; none: no error
  };

  /**
   * The account of the energy that steps and contacts gave and took beyond loads, springs and
   * dampers. Use it to check whether steps resolve contacts, and whether a scheme suits large
   * motions. Groups are those of connected bodies; the scale of a group is its energy.
   *
   * Gain of a group in a step: the change of its kinetic energy, minus the work of all forces but
   * those of fixed constraints with mean forces, plus the change of their spring energy. It is not
   * positive, except for rounding, where mean forces meet conditions on gaps. It is not measured if
   * supports move, as it would need the work of their forces. Nonlinear bodies count with their own
   * energy, so that a wrong mean force shows. With backward Euler, a body with a non-convex energy
   * gains more than the work of its forces at the end of the step, and the scheme dissipates the
   * kinetic energy of the change of velocity: the gain is the difference.
   *
   * Contact of a unilateral constraint: an elastic one gives L = (work on the bodies) + (change of
   * the spring's energy) + (work of the damper) in a step. L is summed from closing to opening,
   * where gains and losses may cancel, and each contact counts with its absolute sum. A rigid
   * constraint may take energy in an impact, so that only the given energy counts.
   *
   * Momentum: a body that loses the energy |L| in an impact at the speed v loses a momentum of up
   * to 2|L| / v: for all of m v^2 / 2 this is m v. It is compared with the impulse of all
   * constraints of the group from closing until both L and the gap come to rest, in the contact of
   * the group with the largest one: light touches say little, and a long rest does not count.
   *
   * All functions but those that return what is known are called by all ranks together. The
   * summary is made of the rows of all ranks.
   */
  class EnergyAccount
  {
  public:
    /// The arguments but @p start are kept by reference.
    EnergyAccount(const Structure &structure, const Constraints &constraints,
                  const Reference &reference, const State &start);

    /// Sets the gains of the groups in a step that is solved, in its report.
    void measure(Step &step, NonlinearStep &nonlinear, const State &state);

    /// Kinetic energy of each group at the end of the last step, or at the start, for steps that
    /// are taken back [J].
    const std::vector<double> &kinetic_energies() const { return kinetic; }
    void set_kinetic_energies(const std::vector<double> &of_groups) { kinetic = of_groups; }

    /// Records an accepted step, and the external forces @p P at its end minus those of the
    /// reference.
    void record(const State &state, const StepReport &report, const BodyVectors &P);

    EnergySummary summary() const;

    /// Whether some group has large motions.
    bool has_large_motions() const;

    /// Part of the terms of a gap by which its tracked value may be wrong: a sum of the increments
    /// of some thousand steps, each with 1e-16 of rounding.
    static constexpr double rounding_of_gaps = 1e-12;

    /// Rounding of the gap of a constraint [m, rad].
    double noise(const std::size_t i) const { return rows[i].noise; }

    void save(OutputArchive &archive) { store(archive); }
    void load(InputArchive &archive) { store(archive); }

  private:
    /// Sums over the contacts of a constraint.
    struct Contacts
    {
      double given = 0., taken = 0.; ///< [J]
      double begin = 0., end = 0.;   ///< times of the contact with most energy [s]
      double largest = 0.;           ///< energy given or taken in it [J]
      double momentum = 0.;          ///< largest momentum error of a contact [N s, N m s]
      double impulse = 0.; ///< largest impulse of the group in the time of an error [N s, N m s]
      double shortest = std::numeric_limits<double>::infinity(); ///< shortest contact so far [s]
      double step = 0.;                                          ///< last step of a contact [s]

      template <typename Archive>
      void serialize(Archive &archive, unsigned int)
      {
        archive &given &taken &begin &end &largest &momentum &impulse &shortest &step;
      }
    };
    struct Row
    {
      Contacts contacts;
      double closing = 0., begin = 0., end = 0.; ///< of the contact under way
      double rate = 0., fastest = 0.; ///< of the gap: last, and in this contact [m/s, rad/s]
      /// Of the group until closing, until the contact rests, and until the last step [N s, N m s].
      double impulse_before = 0., impulse_until = 0., impulse = 0.;
      bool is_fast = false;                                 ///< since closing
      double multiplier = 0., gap = 0., u = 0., noise = 0.; ///< at the end of the last step

      template <typename Archive>
      void serialize(Archive &archive, unsigned int)
      {
        archive &contacts &closing &begin &end &rate &fastest &multiplier &gap &u &noise;
        archive &impulse_before &impulse_until &impulse &is_fast;
      }
    };
    struct Group
    {
      double kinetic = 0., strain = 0., springs = 0., loads = 0.; ///< largest so far [J]
      double rest = 0.;             ///< that rounding may give or take at rest [J]
      double impulse[2] = {0., 0.}; ///< so far, of forces and of moments [N s, N m s]
      double contact_gains = 0., motion_gains = 0.; ///< so far [J]
      double rest_of_step = 0.;                     ///< rounding of motion_gains in a step [J]
      bool moves_far = false;                       ///< has a nonlinear body or a turning row
      std::size_t first_one_sided = no_link;        ///< number of a unilateral constraint

      double scale() const { return kinetic + strain + springs + loads + rest; }

      template <typename Archive>
      void serialize(Archive &archive, unsigned int)
      {
        archive &kinetic &strain &springs &loads &rest &impulse &contact_gains &motion_gains;
      }
    };

    /// Of each group, over all ranks.
    struct WorstOfGroups
    {
      /// Largest energy of a constraint, momentum error, and impulse of a contact, in turn.
      std::vector<double> largest;
      std::vector<std::size_t> number; ///< of the constraint; no_link: none
      std::vector<double> sums;        ///< energy given and taken, in turn [J]
      std::vector<double> contact;     ///< of the worst constraint: begin, end, shortest, step [s]

      static constexpr std::size_t n_of_largest = 3;
      enum Of : std::size_t
      {
        energy,
        momentum,
        impulse
      };
      double of(const std::size_t g, const Of of) const { return largest[n_of_largest * g + of]; }
      std::size_t number_of(const std::size_t g, const Of of) const
      {
        return number[n_of_largest * g + of];
      }
    };

    void set_rest(const State &start);
    void add_kinetic_energies(const BodyVectors &V, std::vector<double> &of_groups);
    void add_surplus(NonlinearStep &nonlinear, double theta, const State &state, double *of_groups);
    double gain_of_spring(std::size_t i, const State &state, const StepReport &report) const;
    void measure_means(Step &step, NonlinearStep &nonlinear, const State &state);
    void measure_at_ends(Step &step, NonlinearStep &nonlinear, const State &state);
    void add_gains(const StepReport &report);
    double gain(std::size_t i, const State &state, const StepReport &report) const;
    void record_row(std::size_t i, const State &state, const StepReport &report);
    static void add_contact(Contacts &contacts, const Row &row, double end);
    Contacts contacts_of(std::size_t i) const;
    void measure_scale(const State &state, const BodyVectors &P);
    double energy_of_loads(std::size_t k, const std::vector<double> &P, double step) const;
    void set_first_one_sided();
    void find_worst() const;
    void find_energy(EnergySummary &result) const;
    void find_momentum(EnergySummary &result) const;
    void add_impulses(const State &state);
    double impulse_of(std::size_t i) const;
    template <typename Archive>
    void store(Archive &archive);

    const Structure &structure;
    const Constraints &constraints;
    const Reference &reference;
    const ConnectedBodies connected;
    const std::vector<double> masses; ///< of the bodies of this rank [kg]
    bool supports_move = false;       ///< of any rank
    std::vector<Row> rows;
    std::vector<Group> groups;
    long n_steps = 0;
    std::vector<double> kinetic;                    ///< of the groups
    std::vector<double> sums, springs, work, terms; ///< of one call
    mutable WorstOfGroups worst;                    ///< in summary()
  };
} // namespace taut

#endif
