// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_wave_speed_h
#define taut_wave_speed_h

#include <taut/scene/scene.h>

namespace taut
{
  /// Throws EntryError if a contact or a load runs on a wire under tension at least as fast, at
  /// some time until @p end_time [s], as its slowest waves across it, and may not: sqrt(T / m), or
  /// of a beam on a bedding sqrt((T + 2 sqrt(k EI)) / m). A wire without tension has no such speed.
  void check_wave_speed(const Scene &scene, const Link &link, double end_time);
  void check_wave_speed(const Scene &scene, const Load &load, double end_time);
} // namespace taut

#endif
