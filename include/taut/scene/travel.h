// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_travel_h
#define taut_travel_h

#include <string>

namespace taut
{
  /// The way of a sliding contact or of a moving force whose speed changes in time.
  class Travel
  {
  public:
    virtual ~Travel() = default;

    /// Way since t = 0 [m].
    virtual double way(double t) const = 0;

    /// Speed [m/s].
    virtual double speed(double t) const = 0;

    /// The formula or table of the speed, for comparisons of scenes.
    virtual std::string text() const = 0;
  };
} // namespace taut

#endif
