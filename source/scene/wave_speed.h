// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_wave_speed_h
#define taut_wave_speed_h

#include <taut/scene/scene.h>

#include <string>

namespace taut
{
  /// Whether a contact or load runs on a wire under tension at least as fast as its slowest waves
  /// across it: sqrt(T / m), or of a beam on a bedding sqrt((T + 2 sqrt(k EI)) / m). False for
  /// wires without tension.
  bool is_faster_than_waves(const Wire &wire, double speed);

  /// Throws EntryError on the entry Speed of a section if it is, unless that is allowed.
  void check_speed(const Wire &wire, double speed, bool is_allowed, const std::string &section);
} // namespace taut

#endif
