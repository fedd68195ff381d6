// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_motion_record_h
#define taut_motion_record_h

#include "output/impulse_record.h"
#include <taut/base/archive_forward.h>
#include <taut/interface/connected_bodies.h>
#include <taut/time/state.h>

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace taut
{
  /// The difference of two motions, relative to the largest values of the second one, or of the
  /// first where these are more than twice as large, in the group of connected bodies with the
  /// largest difference.
  struct MotionDifference
  {
    double place = 0., impulse = 0., energy = 0.; ///< [1]

    /// Bounds within which two motions are equally good.
    static constexpr double place_bound = .02, impulse_bound = .02, energy_bound = .05;

    /// The largest ratio of the three to its bound; not-a-number if one is.
    double over_bounds() const;

    /// Multiplies the three.
    void scale(double factor);

    std::size_t body = 0; ///< of Structure::all_bodies(), with the largest difference of places
    double time = 0.;     ///< of this difference [s]
    std::string name; ///< of the constraint with the largest difference of impulses; empty: none

    /// The largest difference of impulses at the end, where an impact that is early or late counts,
    /// and the name of its constraint; empty: none.
    double impulse_at_end = 0.; ///< [1]
    std::string name_at_end;
    bool is_place() const;   ///< the place exceeds its bound most
    bool is_impulse() const; ///< the impulse exceeds its bound most
  };

  /**
   * The data that compare a motion with the same motion in other steps. Use it where the steps of
   * two runs differ, see StepAccuracy. Places and energies of groups of connected bodies are
   * recorded at equal intervals of time. Impulses of constraints since the start are recorded at
   * the ends of steps, as contacts are shorter than such an interval.
   *
   * Of bodies with many DoFs some hundred places are recorded, at least one of each body.
   * Rotations of lumped bodies are compared like places; slopes of wires are not, as their places
   * say it. A place is measured by the largest own motion of its group: that of free DoFs, and
   * relative to a base with a prescribed motion if this is less.
   */
  class MotionRecord
  {
  public:
    /// Records @p n multiples of @p interval [s] after @p start. The arguments but @p start are
    /// kept by reference.
    MotionRecord(const Structure &structure, const Constraints &constraints,
                 const ConnectedBodies &groups, const Reference &reference, const State &start,
                 double interval, std::size_t n);

    /// Records an accepted step. Places inside it are those of the cubic with its end velocities,
    /// energies between those at its ends.
    void record(const State &state, const StepReport &report);

    std::size_t n_samples() const { return n_recorded; }

    /// From another motion. The bounds allow an impact to be early or late by a step, or by the
    /// time in which the fastest place moves as far as their bound.
    struct Differences
    {
      MotionDifference least; ///< beyond this shift of impacts
      MotionDifference most;  ///< beyond a part of it
    };

    /**
     * Differences of this motion from another one, sample by sample. Impulses and energies jump at
     * an impact: they may have any value that the other motion has within the shift, or within the
     * part @p shift [1] of it. Called by all ranks together.
     */
    Differences differences(const MotionRecord &other, double shift) const;

    /// Stores the data of all ranks. Called by all ranks together.
    void save(OutputArchive &archive);
    void load(InputArchive &archive);

  private:
    /// Of each group, sample after sample, the start first: kinetic, potential [J].
    using Energies = std::vector<std::array<double, 2>>;
    struct Sizes;

    /// Places of each body, sample by sample [m].
    using PlacesOfBodies = std::map<std::size_t, std::vector<double>>;
    PlacesOfBodies places_of_bodies() const;
    void add_speeds(const State &state);
    void add_places(const State &state, double part);
    void add_energies(const State &state, double part, bool is_first);
    void find_energies(const State &state, bool at_end, Energies &of_groups);
    double time_of(const std::size_t sample) const { return begin + (sample + 1.) * interval; }
    Sizes sizes() const;
    Energies energies_of_all() const;
    std::vector<double> bases(std::vector<std::size_t> &groups_of_bases) const;
    double own_size(std::size_t place, const std::vector<std::size_t> &groups_of_bases,
                    const std::vector<double> &bases) const;
    std::vector<double> rounding() const;
    void compare_places(const MotionRecord &other, const Sizes &size,
                        MotionDifference &result) const;
    void compare_energies(const Energies &own, const Energies &others, const Sizes &size,
                          double shift, MotionDifference &result) const;

    const Structure &structure;
    const Constraints &constraints;
    const ConnectedBodies &groups;
    const Reference &reference;
    const double begin, interval; ///< [s]
    const std::size_t n;
    std::size_t n_recorded = 0;

    /// A recorded DoF, and its group and kind as one number.
    struct Place
    {
      std::size_t body;
      unsigned int dof;
      std::size_t group; ///< 2 g, or 2 g + 1 of a rotation
      bool is_prescribed;
    };
    std::vector<Place> dofs; ///< body after body

    /// A body and its range in the list of DoFs.
    struct Body
    {
      std::size_t number, first, end;
      std::size_t group;
    };
    std::vector<Body> bodies;
    std::vector<double> start_of_dofs; ///< [m]
    BodyVectors start_load;            ///< K U_ref - P at the start [N, N m]

    std::vector<double> speed; ///< of the groups by kind, largest so far [m/s, rad/s]
    std::vector<double> speed_at_start;
    ImpulseRecord impulses;
    std::vector<double> places; ///< of all DoFs, sample after sample [m]
    Energies energies;          ///< shares of this rank
    Energies before, now;       ///< at the start and the end of the last step
    std::vector<double> work;
  };
} // namespace taut

#endif
