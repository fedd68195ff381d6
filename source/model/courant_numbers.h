// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_courant_numbers_h
#define taut_courant_numbers_h

#include <taut/scene/scene.h>

#include <cstddef>
#include <vector>

namespace taut
{
  /// Courant numbers: the number of elements that waves cross in a step [s], at the ends of links
  /// on wires.
  class CourantNumbers
  {
  public:
    /// @p scene is kept by reference.
    CourantNumbers(const Scene &scene, double step);

    /// Elements that the fastest waves of the motion of a link cross in a step, from an end on a
    /// wire: wave speed times step over the shortest adjacent element [1].
    double at(const Link &link, const Attachment &end) const;

    /// Index in grid(scene, wire) of the node nearest to an attachment on a wire.
    std::size_t node(const Attachment &end) const;

    /// Elements of a wire.
    std::size_t n_elements(std::size_t wire) const { return grids[wire].size() - 1; }

  private:
    const Scene &scene;
    const double step;
    std::vector<std::vector<double>> grids; ///< of each wire
  };

  /// True if a motion of the wire along the direction is across it, and bends it.
  bool bends(const Wire &wire, const Coordinates &direction);
} // namespace taut

#endif
