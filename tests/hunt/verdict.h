// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_hunt_verdict_h
#define taut_hunt_verdict_h

#include "reference.h"

namespace hunt
{
  /// What became of a scene.
  enum class Verdict
  {
    agreed,
    agreed_but_warned,
    agreed_but_refused, ///< ended with an error after the last step
    warned_and_wrong,
    refused,
    silent_and_wrong,
    crashed, ///< an error that is not the user's, or one without a reason
    not_decidable
  };
  constexpr std::size_t n_verdicts = 8;

  const char *name(Verdict verdict);

  struct Finding
  {
    Verdict verdict = Verdict::crashed;
    Difference difference;
    std::string what;            ///< warnings, error, or why it is not decidable
    bool compares_places = true; ///< false: the motion is chaotic, sums only
    std::string log;
  };

  /// Runs a scene, with a part of its step, and its reference.
  Finding judge(const HuntScene &scene, double parts = 1.);
} // namespace hunt

#endif
