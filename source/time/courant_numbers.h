// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_courant_numbers_h
#define taut_courant_numbers_h

#include <taut/scene/scene.h>

#include <cstddef>
#include <vector>

namespace taut
{
  /// Elements that the slowest and the fastest waves of a place cross in a step [1].
  struct CourantRange
  {
    double least, most;
  };

  /// How far waves get in a step [s] at the ends of links on wires, on the elements of the grid.
  class CourantNumbers
  {
  public:
    /// @p scene is kept by reference.
    CourantNumbers(const Scene &scene, double step);

    /**
     * Wave speed times step over element, of the waves that the link's motion starts at one of its
     * ends: along the wire, across it, or both, the slowest on the longest element beside the end
     * and the fastest on the shortest one. The end that moves passes all elements of its wire.
     * Infinite where there is no wire.
     */
    CourantRange at(const Link &link, const Attachment &end) const;

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
  bool bends(const Wire &wire, const Point &direction);
} // namespace taut

#endif
