// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_travel_h
#define taut_travel_h

#include <cmath>
#include <memory>
#include <string>

namespace taut
{
  struct Scene;

  /// What a sliding contact or a moving force reaches from t = 0 to some time.
  struct TravelRange
  {
    double least = 0., greatest = 0.; ///< way [m]
    double fastest = 0.;              ///< largest magnitude of the speed [m/s]
  };

  /// The way of a sliding contact or of a moving force whose speed changes in time.
  class Travel
  {
  public:
    virtual ~Travel() = default;

    /// Way since t = 0 [m]. Of a travel from until() it allocates nothing up to that time, and
    /// takes no longer for long runs.
    virtual double way(double t) const = 0;

    /// Speed [m/s].
    virtual double speed(double t) const = 0;

    /// The formula or table of the speed, for messages and, with the content of its tables, for
    /// comparisons of scenes.
    virtual std::string text() const = 0;

    /// The entry Speed from which a travel in m/s has the same bits.
    virtual std::string formula() const = 0;

    /// The same travel, prepared for times up to @p end [s]. Throws EntryError where its speed has
    /// no value.
    virtual std::shared_ptr<const Travel> until(double end) const = 0;

    /// From t = 0 to the end that the travel is prepared for.
    virtual TravelRange range() const = 0;
  };

  /// Way since t = 0 of a link or a load that moves [m].
  template <typename Item>
  double way(const Item &item, const double t)
  {
    return item.travel ? item.travel->way(t) : item.speed * t;
  }

  /// Speed of a link or a load that moves [m/s].
  template <typename Item>
  double speed_at(const Item &item, const double t)
  {
    return item.travel ? item.travel->speed(t) : item.speed;
  }

  template <typename Item>
  bool moves(const Item &item)
  {
    return item.travel || item.speed != 0.;
  }

  /// What a link or a load that moves reaches until @p end [s].
  template <typename Item>
  TravelRange travel_range(const Item &item, const double end)
  {
    if (item.travel)
      return item.travel->until(end)->range();
    const double last = item.speed * end;
    return {std::fmin(0., last), std::fmax(0., last), std::fabs(item.speed)};
  }

  /// The entry Speed: a number, or a formula or table of t.
  struct Speed
  {
    double constant = 0.;                 ///< [m/s]
    std::shared_ptr<const Travel> travel; ///< null for a number
  };

  /// Reads an entry Speed, of which @p units are 1 m/s. Throws EntryError.
  Speed parse_speed(const std::string &text, const std::string &entry, double units = 1.);

  /// Prepares the links and loads of a scene that move for times up to @p end [s].
  void prepare_travels(Scene &scene, double end);

  /// First time at which a link or a load has made a way [s]; infinite if it does not within @p
  /// latest [s]. Throws EntryError if the speed has no value before.
  double time_of_way(const Speed &speed, double way, double latest);
} // namespace taut

#endif
