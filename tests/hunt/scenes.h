// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_hunt_scenes_h
#define taut_hunt_scenes_h

#include "common.h"

namespace hunt
{
  /// A mass on a rope that turns about the origin, for its own equation of motion.
  struct Pendulum
  {
    double mass = 0., stiffness = 0., length = 0., gravity = 0.; ///< [kg, N/m, m, m/s^2]
    std::array<double, 4> start = {};                            ///< x, y and their rates [m, m/s]
  };

  /// A load that rises from nothing to its size and falls again, straight.
  struct Pulse
  {
    double begin = 0., width = 0.; ///< [s]; width 0: none

    double rise() const { return 2. / width; } ///< [1/s]
    double at(const double t) const
    {
      return width > 0. ? std::max(0., 1. - rise() * std::fabs(t - begin - .5 * width)) : 0.;
    }
  };

  /// What integrates the reference.
  enum class ReferenceKind
  {
    event_driven, ///< the matrices of the scene
    pendulum,     ///< its own equation of motion
    program       ///< another scheme with a sixteenth of the step
  };

  /// A parameter file of a family, and what the reference needs beside it.
  struct HuntScene
  {
    std::string family, text;
    ReferenceKind kind = ReferenceKind::event_driven;
    double frequency = 0.;  ///< of the loads; 0: constant [rad/s]
    bool is_driven = false; ///< by a prescribed place: the energy of the rest is none of its own
    Pulse pulse = {};
    double restitution = 0.; ///< of rigid stops
    double reach = 0.;       ///< springs of links stay far below this compression [m]
    double step = 0.;        ///< [s]
    double n_steps = 0.;     ///< of this length
    Pendulum pendulum = {};
  };

  /// Families by what they are about.
  enum class Field
  {
    contacts, ///< masses, wires and links
    given,    ///< prescribed motions, rotations
    compound  ///< laws with dampers, strips
  };

  /// Names of the families, in the order of the table.
  std::vector<std::string> families(Field field);

  /// The scene of a number; the same on every machine. Families of a field take turns.
  HuntScene make_scene(std::uint64_t seed, std::size_t number, Field field = Field::contacts);
} // namespace hunt

#endif
