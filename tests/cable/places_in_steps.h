// SPDX-License-Identifier: LGPL-2.1-or-later
// Where a place of a scene is in a step of its run.
#ifndef taut_tests_places_in_steps_h
#define taut_tests_places_in_steps_h

#include "verification/run.h"

/// Displacement of a place along a direction, from the undeformed structure [m].
inline double moved(const taut::StepView &step, const taut::Attachment &place,
                    const taut::Coordinates &direction)
{
  std::vector<taut::Term> terms;
  step.structure.motion(place, false, direction, 1., terms);
  return verification::displacement(step, terms);
}

/// A place of the undeformed structure with its displacement [m].
inline taut::Coordinates displaced(const taut::StepView &step, const taut::Attachment &place,
                                   const taut::Coordinates &undeformed)
{
  return add_scaled(undeformed, 1.,
                    {moved(step, place, {1., 0., 0.}), moved(step, place, {0., 1., 0.}),
                     moved(step, place, {0., 0., 1.})});
}

/// The same of the place that the structure has for it.
inline taut::Coordinates displaced(const taut::StepView &step, const taut::Attachment &place)
{
  return displaced(step, place, step.structure.position(step.scene, place));
}

#endif
