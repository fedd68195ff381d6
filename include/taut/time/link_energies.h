// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_link_energies_h
#define taut_link_energies_h

#include <taut/base/archive_forward.h>
#include <taut/interface/connected_bodies.h>
#include <taut/time/integrator.h>
#include <taut/time/state.h>

#include <limits>
#include <vector>

namespace taut
{
  /**
   * An account of the energy of each unilateral constraint: what it gave the bodies and took from
   * them beside what its spring stores and its damper takes, over the energy of the bodies that it
   * is connected with. Use it to see whether steps resolve contacts.
   *
   * In a step an elastic constraint gives L = (work on the bodies) + (change of its spring's
   * energy) + (work of its damper). L is summed from closing to opening, as what closing takes and
   * opening gives may cancel; each contact then counts with its size. A rigid constraint may take
   * energy, in an impact, and only what it gives counts.
   *
   * A body that lost the energy |L| of an impact at the speed v lacks a momentum of up to 2 |L| /
   * v: all of it, m v, where it lost all of m v^2 / 2.
   */
  class LinkEnergies
  {
  public:
    /// The arguments but @p start are kept by reference.
    LinkEnergies(const Structure &structure, const Constraints &constraints,
                 const Reference &reference, const State &start);

    /// An accepted step, made with these coefficients.
    void record(const State &state, const StepCoefficients &c);

    /// Measures the energies that others are compared with. Called by all ranks together.
    void measure_scale(const State &state);

    /// What a constraint did so far.
    struct Account
    {
      double given = 0., taken = 0.; ///< sums over its contacts [J]
      double begin = 0., end = 0.;   ///< of the contact that counts most [s]
      double largest = 0.;           ///< what this one gave or took [J]
      double momentum = 0.;          ///< largest that energies of a contact had [N s, N m s]
      double shortest = std::numeric_limits<double>::infinity(); ///< contact so far [s]
      double step = 0.;                                          ///< that it ended with [s]

      template <typename Archive>
      void serialize(Archive &archive, unsigned int)
      {
        archive &given &taken &begin &end &largest &momentum &shortest &step;
      }
    };

    /// Of a constraint, with its contact that is not over.
    Account account(std::size_t i) const;

    /// Largest kinetic, strain and spring energies so far of a group, what its loads give in a
    /// step, and rounding [J].
    double scale(std::size_t group) const;
    const ConnectedBodies &groups() const { return connected; }

    /// What rounding may give or take at rest [J].
    double rest(const std::size_t group) const { return energies[group].rest; }

    /// Part of the terms of a gap that its carried value may be off by.
    static constexpr double rounding_of_gaps = 1e-12;

    /// What the gap of a constraint rounds with [m, rad].
    double noise(const std::size_t i) const { return rows[i].noise; }

    void save(OutputArchive &archive);
    void load(InputArchive &archive);

  private:
    struct Row
    {
      Account account;
      double closing = 0., begin = 0., end = 0.; ///< of the contact that goes on
      double rate = 0.,
             fastest = 0.; ///< of the gap: in the last step, in this contact [m/s, rad/s]
      double multiplier = 0., gap = 0., u = 0., noise = 0.; ///< at the end of the last step

      template <typename Archive>
      void serialize(Archive &archive, unsigned int)
      {
        archive &account &closing &begin &end &rate &fastest &multiplier &gap &u &noise;
      }
    };
    struct Energies
    {
      double kinetic = 0., strain = 0., springs = 0., loads = 0., rest = 0.;

      template <typename Archive>
      void serialize(Archive &archive, unsigned int)
      {
        archive &kinetic &strain &springs &loads &rest;
      }
    };
    template <typename Archive>
    void store(Archive &archive);
    double gain(std::size_t i, const State &state, const StepCoefficients &c) const;
    static void add_contact(Account &account, const Row &row, double end);
    void measure_rest(const State &start);
    double energy_of_loads(std::size_t k, const State &state);

    const Structure &structure;
    const Constraints &constraints;
    const Reference &reference;
    const ConnectedBodies connected;
    const std::vector<double> masses; ///< of the bodies of this rank [kg]
    std::vector<Row> rows;
    std::vector<Energies> energies; ///< of the groups
    std::vector<double> work, terms;
  };
} // namespace taut

#endif
