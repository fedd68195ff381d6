// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_unseen_feature_h
#define taut_unseen_feature_h

#include "time/excitations.h"
#include <taut/base/communicator.h>

#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace taut
{
  /// What steps of one length do not see of an excitation.
  struct UnseenFeature
  {
    std::string name, origin; ///< of the excitation; empty name: none
    double time = 0.;         ///< where most is lost [s]
    /// Of a block of the same height and area there; infinite: there is none [s].
    double width = std::numeric_limits<double>::infinity();

    /// The longest step that sees what each excitation loses most, a part of the step by a power of
    /// two [s].
    double longest_step = std::numeric_limits<double>::infinity();

    /// Whether a search with this step was complete and found nothing.
    bool is_all_seen = false;

    /// Whether all excitations that have samples were looked at, those in space in many places.
    bool is_complete = true;

    /// Whether few places of a load in space, at which adaptive steps look, do not show it.
    bool is_local = false;

    /// Of adaptive steps, which look at few places: the narrowest local one that their longest step
    /// does not see; null: there is none.
    std::shared_ptr<const UnseenFeature> local = nullptr;
  };

  /// Where loads in space are looked at.
  enum class Places
  {
    few,
    many
  };

  /// What the first step makes of loads at the start: they are in balance there; they count as at
  /// the end of any other step; or the step knows its own end alone, as backward Euler does.
  enum class LoadsAtStart
  {
    balanced,
    seen,
    unseen
  };

  /**
   * Looks for the narrowest feature of the excitations that the ends of steps do not see, in @p
   * n_steps steps of length @p step from @p start on [s]. A run is sampled at least twenty thousand
   * times and each step eight times; a feature narrower than that may be missed. Loads without a
   * sample of their own and runs of more than ten million steps are not searched.
   *
   * Of loads in space a few places show all but what is local. With Places::many only what they do
   * not show is looked for, in up to 256 places if a run is not too long. Edges of a load that
   * moves pass places, which is no feature: all forces together have to show it, too.
   *
   * Loads act by their impulse. Compared are the area below the samples and that of the trapezoids
   * between the ends of steps, and so their moments about the middle of the step, which opposite
   * pulses have. They count from the value at the start if this is in balance. A load is seen if
   * the differences in forty steps are at most 2 % of the largest area in forty steps. So a jump
   * inside a step is seen: it is late by a part of a step. Of a sine the thirteenth of a period is
   * seen. A place also has to stay within its values at both ends of each step, by a tenth of its
   * range. A pulse inside of a step, which the ends around it do not announce, may have 0.5 % of
   * that area, or 2 % of that range. Called by all ranks together.
   */
  UnseenFeature find_unseen_feature(const std::vector<Excitation> &all,
                                    const Communicator &processes, LoadsAtStart loads, double start,
                                    double step, long n_steps, Places places);
} // namespace taut

#endif
