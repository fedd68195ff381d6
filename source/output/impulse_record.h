// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_impulse_record_h
#define taut_impulse_record_h

#include <taut/base/archive_forward.h>
#include <taut/interface/connected_bodies.h>
#include <taut/time/state.h>
#include <taut/time/step_report.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace taut
{
  /**
   * Impulses of constraints, but for cuts, since the start, at the ends of
   * steps. Use it to compare contacts of runs in other steps: a contact may be shorter than an
   * interval between samples. A long run keeps every second end, fourth end, and so on, and the
   * last one.
   *
   * Three or more rigid unilateral constraints on the same DoFs of lumped bodies may share an
   * impulse in any way if their linear forms depend on each other, as the four legs of a box do.
   * Their sum counts.
   *
   * A rank records the constraints that it counts. The constructor, sizes(), difference() and
   * store() are called by all ranks together, and say what all ranks recorded.
   */
  class ImpulseRecord
  {
  public:
    /// @p constraints are kept by reference.
    ImpulseRecord(const Structure &structure, const Constraints &constraints,
                  const ConnectedBodies &groups, const State &start);

    /// Records an accepted step.
    void record(const State &state, const StepReport &report);

    /// Sums of the sizes of the impulses so far, by group and kind [N s, N m s].
    std::vector<double> sizes() const;

    /// Relative differences, the largest and that of unilateral constraints at the end of the
    /// comparison, where nothing may be early or late, and the names of their constraints; empty:
    /// nothing differs.
    struct Difference
    {
      double largest = 0., at_end = 0.; ///< [1]
      std::string name, name_at_end;
    };

    /**
     * The difference from the other impulses. It is relative to the largest other impulse of the
     * group and kind, or to that of this run if it is more than twice as large, or to @p largest [N
     * s, N m s] if that is more. An impulse may be early or late by a part @p shift [1] of a step
     * or of the time @p late [s]. The comparison ends with the other run, but for @p rounding [s].
     */
    Difference difference(const ImpulseRecord &other, std::vector<double> largest,
                          const std::vector<double> &late, double shift, double rounding) const;

    /// Saves or loads.
    template <typename Archive>
    void store(Archive &archive);

  private:
    struct Stored;
    Difference named(double largest, std::size_t row, double at_end, std::size_t row_at_end) const;
    void keep_every_second_end();

    /// A time between two recorded ends.
    struct Instant
    {
      std::size_t next; ///< end
      double part;      ///< of the time between both
    };
    std::vector<Instant> instants(const std::vector<double> &of_times) const;

    /// The impulse of an item, linear between the ends.
    double at(const Instant &instant, std::size_t item) const;

    /// A constraint, or some that share an impulse.
    struct Item
    {
      std::size_t row;   ///< the first one
      std::size_t group; ///< 2 g, or 2 g + 1 of rotational ones
      bool may_open;
    };
    const Constraints &constraints;
    const std::size_t n_groups;
    std::vector<std::size_t> rows;    ///< all but cuts
    std::vector<Item> items;          ///< that this rank counts
    std::vector<std::size_t> item_of; ///< of each of the rows; no_link: of another rank
    std::size_t most_ends;            ///< that are kept; even

    std::vector<double> impulse;    ///< of the items so far [N s, N m s]
    std::vector<double> multiplier; ///< of the rows in the last step
    std::vector<double> times;      ///< ends of steps with recorded impulses; the last one [s]
    std::vector<double> impulses;   ///< of all items, time after time
    long stride = 1, n_steps = 0;   ///< one of so many ends is kept; steps so far
  };
} // namespace taut

#endif
