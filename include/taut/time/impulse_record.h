// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_impulse_record_h
#define taut_impulse_record_h

#include <taut/interface/connected_bodies.h>
#include <taut/time/state.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace taut
{
  /// Impulses of constraints since the start at the ends of steps, of many steps at every second
  /// end, or fourth, and so on. Use it where contacts of runs in other steps are compared: they are
  /// shorter than an interval between samples.
  class ImpulseRecord
  {
  public:
    explicit ImpulseRecord(const State &start);

    /// An accepted step.
    void record(const State &state);

    /**
     * How far these impulses are from others, until these end but for @p rounding [s]: the largest
     * difference, relative to the largest of the other impulses in a group or to @p largest [N s]
     * of the group if this is more, and its constraint, -1 if nothing differs. Impulses may be
     * early or late by @p late [s] of the group, or by one end.
     */
    std::pair<double, std::size_t>
    difference(const ImpulseRecord &other, const ConnectedBodies &groups,
               std::vector<double> largest, const std::vector<double> &late, double rounding) const;

    /// Saves or loads.
    template <typename Archive>
    void store(Archive &archive)
    {
      archive &impulse &multiplier &times &impulses &stride &n_steps;
    }

  private:
    void keep_every_second_end();
    std::vector<std::vector<double>> at(const std::vector<double> &instants) const;

    std::vector<double> impulse, multiplier;   ///< so far, and at the end of the last step
    std::vector<double> times;                 ///< ends of steps that have impulses [s]
    std::vector<std::vector<double>> impulses; ///< at these [N s]
    long stride = 1, n_steps = 0;              ///< each so many ends are kept; steps so far
  };
} // namespace taut

#endif
