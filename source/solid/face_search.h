// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_face_search_h
#define taut_face_search_h

#include "solid/surface_geometry.h"

#include <functional>
#include <memory>
#include <vector>

namespace taut
{
  /// Finds faces of a surface by their bounding boxes, in an R-tree: n log n to build, log n a
  /// query and face found.
  class FaceSearch
  {
  public:
    explicit FaceSearch(const SurfaceGeometry &geometry);
    ~FaceSearch();

    /// Faces whose boxes meet the convex hull of some points of the plane, in ascending order.
    std::vector<std::size_t> meet_hull(const std::vector<Coordinates> &points) const;

    /// Calls @p visit with faces and the distances of their boxes from @p x [m], in ascending
    /// order, as long as @p visit returns true.
    void visit_nearest(const Coordinates &x,
                       const std::function<bool(std::size_t face, double distance)> &visit) const;

  private:
    struct Trees;
    std::unique_ptr<const Trees> trees;
    double mean_size = 0.; ///< of the boxes [m]
    double scale = 1.;     ///< of lengths in the trees: Boost rounds as if all were about 1 [1/m]
  };
} // namespace taut

#endif
