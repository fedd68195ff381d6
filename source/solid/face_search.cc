// SPDX-License-Identifier: LGPL-2.1-or-later
#include "face_search.h"

// The R-tree includes a deprecated header of Boost, which every build would be told.
#define BOOST_ALLOW_DEPRECATED_HEADERS
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/multi_point.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/geometries/ring.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <algorithm>

namespace taut
{
  namespace
  {
    namespace bg = boost::geometry;

    template <std::size_t dim>
    using Point = bg::model::point<double, dim, bg::cs::cartesian>;
    template <std::size_t dim>
    using Entry = std::pair<bg::model::box<Point<dim>>, std::size_t>;
    template <std::size_t dim>
    using Tree = bg::index::rtree<Entry<dim>, bg::index::rstar<16>>;
  } // namespace

  /// One of the two is empty.
  struct FaceSearch::Trees
  {
    Tree<2> plane;
    Tree<3> space;
  };

  FaceSearch::FaceSearch(const SurfaceGeometry &geometry)
  {
    std::vector<Entry<2>> plane;
    std::vector<Entry<3>> space;
    for (std::size_t f = 0; f < geometry.n_faces(); ++f)
    {
      const Box b = geometry.box(f);
      if (geometry.surface().dim == 2)
        plane.push_back({{{b.lower.x, b.lower.y}, {b.upper.x, b.upper.y}}, f});
      else
        space.push_back(
            {{{b.lower.x, b.lower.y, b.lower.z}, {b.upper.x, b.upper.y, b.upper.z}}, f});
    }
    trees = std::make_unique<Trees>(Trees{Tree<2>(plane), Tree<3>(space)});
  }

  FaceSearch::~FaceSearch() = default;

  std::vector<std::size_t> FaceSearch::meet_hull(const std::vector<Coordinates> &points) const
  {
    bg::model::multi_point<Point<2>> corners;
    for (const Coordinates &x : points)
      corners.push_back({x.x, x.y});
    bg::model::ring<Point<2>> hull;
    bg::convex_hull(corners, hull);
    std::vector<std::size_t> faces;
    for (auto it = trees->plane.qbegin(bg::index::intersects(hull)); it != trees->plane.qend();
         ++it)
      faces.push_back(it->second);
    std::sort(faces.begin(), faces.end());
    return faces;
  }

  void FaceSearch::visit_nearest(const Coordinates &x,
                                 const std::function<bool(std::size_t, double)> &visit) const
  {
    const auto visit_tree = [&visit](const auto &tree, const auto &point)
    {
      const auto nearest = bg::index::nearest(point, static_cast<unsigned int>(tree.size()));
      for (auto it = tree.qbegin(nearest); it != tree.qend(); ++it)
        if (!visit(it->second, bg::distance(point, it->first)))
          return;
    };
    if (!trees->plane.empty())
      visit_tree(trees->plane, Point<2>(x.x, x.y));
    else
      visit_tree(trees->space, Point<3>(x.x, x.y, x.z));
  }
} // namespace taut
