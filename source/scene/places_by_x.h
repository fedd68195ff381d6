// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_places_by_x_h
#define taut_places_by_x_h

#include <taut/scene/body_type.h>

#include <memory>
#include <vector>

namespace taut
{
  /// What a BodyType is, too, if places on its bodies are counted along them but can be named by
  /// their x.
  class PlacesByX
  {
  public:
    virtual ~PlacesByX() = default;

    /// The places, counted along the body, that are at these x in its shape at rest alone [m].
    /// Throws UserError for an x that the body does not have, or has more than once.
    virtual std::vector<double> places_at(const std::vector<double> &x,
                                          const BodySetting &setting) const = 0;

    /// The same type, with bodies that have nodes at these places [m]: those of loads and links, in
    /// any order. nullptr: bodies have no nodes that could be moved.
    virtual std::shared_ptr<const BodyType> divided(const std::vector<double> &) const
    {
      return nullptr;
    }
  };
} // namespace taut

#endif
