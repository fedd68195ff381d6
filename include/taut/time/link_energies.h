// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_link_energies_h
#define taut_link_energies_h

#include <taut/base/archive_forward.h>
#include <taut/interface/connected_bodies.h>
#include <taut/time/state.h>
#include <taut/time/step_report.h>

#include <limits>
#include <vector>

namespace taut
{
  /**
   * An account of the energy that each unilateral constraint gave and took beyond its spring and
   * damper. Its scale is the energy of the group of connected bodies. Use it to check whether steps
   * resolve contacts.
   *
   * In a step an elastic constraint gives L = (work on the bodies) + (change of the spring's
   * energy) + (work of the damper). L is summed from closing to opening, where gains and losses may
   * cancel, and each contact counts with its absolute sum. A rigid constraint may take energy in an
   * impact, so that only the given energy counts.
   *
   * A body that loses the energy |L| in an impact at the speed v loses a momentum of up to
   * 2|L| / v: for all of m v^2 / 2 this is m v. It is compared with the impulse of all constraints
   * of the group from closing until both L and the gap come to rest, in the contact of the group
   * with the largest one: light touches say little, and a long rest does not count.
   */
  class LinkEnergies
  {
  public:
    /// The arguments but @p start are kept by reference.
    LinkEnergies(const Structure &structure, const Constraints &constraints,
                 const Reference &reference, const State &start);

    /// Records an accepted step.
    void record(const State &state, const StepReport &report);

    /// Measures the energies of the scale. @p P are the external forces of the state minus those of
    /// the reference; empty: no step led here. Called by all ranks together.
    void measure_scale(const State &state, const BodyVectors &P);

    /// Energies of a constraint so far.
    struct Account
    {
      double given = 0., taken = 0.; ///< sums over its contacts [J]
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

    /// Account of a constraint, including the contact under way.
    Account account(std::size_t i) const;

    /// Largest kinetic, strain and spring energies of a group so far, plus the energy of its loads
    /// in a step and rounding [J].
    double scale(std::size_t group) const;
    const ConnectedBodies &groups() const { return connected; }

    /// Energy that rounding may give or take at rest [J].
    double rest(const std::size_t group) const { return energies[group].rest; }

    /// Part of the terms of a gap by which its tracked value may be wrong.
    static constexpr double rounding_of_gaps = 1e-12;

    /// Rounding of the gap of a constraint [m, rad].
    double noise(const std::size_t i) const { return rows[i].noise; }

    void save(OutputArchive &archive);
    void load(InputArchive &archive);

  private:
    struct Row
    {
      Account account;
      double closing = 0., begin = 0., end = 0.; ///< of the contact under way
      double rate = 0.,
             fastest = 0.; ///< of the gap: in the last step, in this contact [m/s, rad/s]
      /// Of the group until closing, until the contact rests, and until the last step [N s, N m s].
      double impulse_before = 0., impulse_until = 0., impulse = 0.;
      bool is_fast = false;                                 ///< since closing
      double multiplier = 0., gap = 0., u = 0., noise = 0.; ///< at the end of the last step

      template <typename Archive>
      void serialize(Archive &archive, unsigned int)
      {
        archive &account &closing &begin &end &rate &fastest &multiplier &gap &u &noise;
        archive &impulse_before &impulse_until &impulse &is_fast;
      }
    };
    struct Energies
    {
      double kinetic = 0., strain = 0., springs = 0., loads = 0., rest = 0.;
      double impulse[2] = {0., 0.}; ///< so far, of forces and of moments [N s, N m s]

      template <typename Archive>
      void serialize(Archive &archive, unsigned int)
      {
        archive &kinetic &strain &springs &loads &rest &impulse;
      }
    };
    template <typename Archive>
    void store(Archive &archive);
    double gain(std::size_t i, const State &state, const StepReport &report) const;
    static void add_contact(Account &account, const Row &row, double end);
    void measure_rest(const State &start);
    double energy_of_loads(std::size_t k, const std::vector<double> &P, double step) const;

    const Structure &structure;
    const Constraints &constraints;
    const Reference &reference;
    const ConnectedBodies connected;
    const std::vector<double> masses; ///< of the bodies of this rank [kg]
    std::vector<Row> rows;
    std::vector<Energies> energies; ///< of the groups
    std::vector<double> work, terms;
    std::vector<double> sums, springs; ///< in measure_scale()
  };
} // namespace taut

#endif
