// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_line_constants_h
#define taut_line_constants_h

#include <taut/scene/scene.h>

#include <string>
#include <vector>

namespace taut
{
  /**
   * What waves in a wire mean to a contact that slides under it, from tensions T and masses per
   * length m (F. Kiessling, R. Puschmann, A. Schmieder, E. Schneider, Contact Lines for Electric
   * Railways).
   */
  struct LineConstants
  {
    std::string contact, wire;
    double speed = 0.;         ///< v, the largest |v| of the run [m/s]
    double wave_speed = 0.;    ///< c, see wave_speed() [m/s]
    double doppler = 0.;       ///< (c - v) / (c + v); 0 if not slower than the waves [1]
    double reflection = 0.;    ///< r of waves in the wire at a dropper; 0 without droppers [1]
    double amplification = 0.; ///< r / Doppler factor; 0 without one, or without droppers [1]
  };

  /// Of each sliding contact on a wire with tension, in the order of the scene.
  std::vector<LineConstants> line_constants(const Scene &scene);
} // namespace taut

#endif
