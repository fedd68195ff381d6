// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_motion_rate_h
#define taut_motion_rate_h

#include <functional>

namespace taut
{
  /// u'(t), at a kink or jump that of the motion after it, by finite differences inside of a small
  /// part of @p step [s]. At the end of the times where u is defined, that of the motion before.
  /// [m/s, rad/s]
  double rate_of_motion(const std::function<double(double)> &u, double t, double step);

  /// A jump of a motion; size 0: none.
  struct JumpOfMotion
  {
    double time = 0.; ///< [s]
    double size = 0.; ///< [m, rad]
  };

  /// Looks for a jump of u between the times @p begin and @p end [s]. @p way is u(end) - u(begin),
  /// and @p lack the part of it that the velocities at both ends do not make [m, rad]. A jump is
  /// most of what lacks.
  JumpOfMotion find_jump(const std::function<double(double)> &u, double begin, double end,
                         double way, double lack);
} // namespace taut

#endif
