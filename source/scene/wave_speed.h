// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_wave_speed_h
#define taut_wave_speed_h

#include <taut/scene/scene.h>

namespace taut
{
  /**
   * Phase speed of waves across a wire that decides what a contact or a load that runs on it meets
   * [m/s]. Waves of wave number q have m c^2 = T + EI q^2 + k / q^2, with the stiffness k of a
   * bedding.
   *
   * On a bedding it is that of the slowest waves, sqrt((T + 2 sqrt(k EI)) / m), which a force that
   * runs with them would excite without bound. Without bedding it is sqrt(T / m) of a wire whose
   * waves its tension carries. Of a stiff one, such as a conductor rail, it is that of waves of 20
   * Hz, up to which contact forces are judged (EN 50318): longer waves end at its supports.
   */
  double wave_speed(const Wire &wire);

  /// Throws EntryError if a contact or a load runs on a wire under tension at least as fast as its
  /// waves at some time until @p end_time [s], and may not. A wire without tension has no such
  /// bound.
  void check_wave_speed(const Scene &scene, const Link &link, double end_time);
  void check_wave_speed(const Scene &scene, const Load &load, double end_time);
} // namespace taut

#endif
