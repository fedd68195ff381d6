// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_motion_record_h
#define taut_motion_record_h

#include <taut/base/archive_forward.h>
#include <taut/interface/connected_bodies.h>
#include <taut/time/impulse_record.h>
#include <taut/time/state.h>

#include <array>
#include <cstddef>
#include <map>
#include <vector>

namespace taut
{
  /// How far two motions are apart, relative to the largest values of the second one, in the group
  /// of connected bodies where they are apart most.
  struct MotionDifference
  {
    double place = 0., impulse = 0., energy = 0.; ///< [1]

    /// Within these a motion is as good as the other one.
    static constexpr double place_bound = .02, impulse_bound = .02, energy_bound = .05;

    /// The largest of the three over its bound; not-a-number if one is.
    double over_bounds() const;

    std::size_t body = 0;    ///< of Structure::all_bodies(), whose place differs most
    double time = 0.;        ///< of that place [s]
    std::size_t row = -1;    ///< constraint whose impulse differs most; -1: none does
    bool is_place() const;   ///< the place exceeds its bound by more than the others do
    bool is_impulse() const; ///< the impulse does
  };

  /**
   * What a motion is compared by with the same motion in other steps: places and energies of groups
   * of connected bodies at equal intervals of time, and impulses of constraints since the start at
   * the ends of steps, as contacts are shorter than such an interval. Use it where the steps of two
   * runs differ, see StepAccuracy.
   */
  class MotionRecord
  {
  public:
    /// At @p n multiples of @p interval [s] after @p start. The arguments but @p start are kept by
    /// reference.
    MotionRecord(const Structure &structure, const Constraints &constraints,
                 const ConnectedBodies &groups, const Reference &reference, const State &start,
                 double interval, std::size_t n);

    /// An accepted step. Places between its ends are those of the cubic with its velocities.
    void record(const State &state);

    std::size_t n_samples() const { return places.size(); }

    /**
     * How far this motion is from another one, sample by sample. Impulses and energies jump at an
     * impact, and the bound of the places lets it be early or late by what the fastest place takes
     * for so much motion: they may be anything that the other motion has within this time, or
     * within an interval. Called by all ranks together.
     */
    MotionDifference difference(const MotionRecord &other) const;

    /// What all ranks have. Called by all ranks together.
    void save(OutputArchive &archive);
    void load(InputArchive &archive);

  private:
    using Energies = std::vector<std::array<double, 2>>; ///< of groups: kinetic, potential [J]
    struct Sizes;

    /// Of each body its places, sample by sample [m].
    using PlacesOfBodies = std::map<std::size_t, std::vector<double>>;
    PlacesOfBodies places_of_bodies() const;
    void add_speeds(const State &state);
    void add_places(const State &state, double part);
    Energies energies_of(const State &state);
    double time_of(const std::size_t sample) const { return begin + (sample + 1.) * interval; }
    Sizes sizes() const;
    void compare_places(const MotionRecord &other, const Sizes &size,
                        MotionDifference &result) const;
    void compare_energies(const Sizes &other, MotionDifference &result) const;

    const Structure &structure;
    const Constraints &constraints;
    const ConnectedBodies &groups;
    const Reference &reference;
    const double begin, interval; ///< [s]
    const std::size_t n;

    /// The DoFs that are displacements of a place, and the group of each.
    struct Place
    {
      std::size_t body;
      unsigned int dof;
      std::size_t group;
    };
    std::vector<Place> dofs;
    std::vector<double> start_of_dofs; ///< [m]
    BodyVectors start_load;            ///< K U_ref - P at the start [N, N m]

    std::vector<double> speed; ///< of the groups, largest so far [m/s]
    ImpulseRecord impulses;
    std::vector<std::vector<double>> places; ///< of each sample [m]
    std::vector<Energies> energies;          ///< the start first; shares of this rank
    std::vector<double> work;
  };
} // namespace taut

#endif
