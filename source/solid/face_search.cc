// SPDX-License-Identifier: LGPL-2.1-or-later
#include "solid/face_search.h"

// The R-tree includes a deprecated header of Boost, of which every build would warn.
#define BOOST_ALLOW_DEPRECATED_HEADERS
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/multi_point.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/geometries/ring.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

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

    template <std::size_t dim>
    bg::model::box<Point<dim>> box_around(const Point<dim> &x, const double radius)
    {
      Point<dim> lower = x, upper = x;
      bg::subtract_value(lower, radius);
      bg::add_value(upper, radius);
      return {lower, upper};
    }

    /// Visits faces by shells around a point, each twice as far as the shell before. The queries of
    /// the tree for nearest entries would sort all visited entries again and again.
    template <std::size_t dim, typename Visit>
    void visit_shells(const Tree<dim> &tree, const Point<dim> &x, const double first_radius,
                      const Visit &visit)
    {
      std::vector<std::pair<double, std::size_t>> shell;
      std::size_t n_seen = 0;
      double inner = -1., outer = std::max(first_radius, bg::distance(x, tree.bounds()));
      // A face at the end of the shell must not be lost by rounding of the corners of its box: no
      // other shell would have this face.
      constexpr double rounding = 8. * std::numeric_limits<double>::epsilon();
      const double size = bg::distance(x, Point<dim>());
      while (n_seen < tree.size())
      {
        shell.clear();
        const auto box = box_around(x, outer + rounding * (outer + size));
        for (auto it = tree.qbegin(bg::index::intersects(box)); it != tree.qend(); ++it)
          if (const double d = bg::distance(x, it->first); d > inner && d <= outer)
            shell.push_back({d, it->second});
        std::sort(shell.begin(), shell.end());
        for (const auto &[d, face] : shell)
          if (!visit(face, d))
            return;
        n_seen += shell.size();
        inner = outer;
        outer *= 2.;
      }
    }
  } // namespace

  /// One of the two trees is empty.
  struct FaceSearch::Trees
  {
    Tree<2> plane;
    Tree<3> space;
  };

  FaceSearch::FaceSearch(const SurfaceGeometry &geometry)
  {
    for (std::size_t f = 0; f < geometry.n_faces(); ++f)
      mean_size += geometry.box(f).diagonal() / static_cast<double>(geometry.n_faces());
    if (mean_size > 0.)
      scale = std::ldexp(1., -std::ilogb(mean_size));
    std::vector<Entry<2>> plane;
    std::vector<Entry<3>> space;
    for (std::size_t f = 0; f < geometry.n_faces(); ++f)
    {
      const Box box = geometry.box(f);
      const Coordinates a = scaled(scale, box.lower), b = scaled(scale, box.upper);
      if (geometry.surface().dim == 2)
        plane.push_back({{{a.x, a.y}, {b.x, b.y}}, f});
      else
        space.push_back({{{a.x, a.y, a.z}, {b.x, b.y, b.z}}, f});
    }
    trees = std::make_unique<Trees>(Trees{Tree<2>(plane), Tree<3>(space)});
  }

  FaceSearch::~FaceSearch() = default;

  std::vector<std::size_t> FaceSearch::meet_hull(const std::vector<Coordinates> &points) const
  {
    bg::model::multi_point<Point<2>> corners;
    for (const Coordinates &x : points)
      corners.push_back({scale * x.x, scale * x.y});
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
    const auto visit_scaled = [this, &visit](const std::size_t face, const double distance)
    { return visit(face, distance / scale); };
    const Coordinates y = scaled(scale, x);
    if (!trees->plane.empty())
      visit_shells(trees->plane, Point<2>(y.x, y.y), scale * mean_size, visit_scaled);
    else
      visit_shells(trees->space, Point<3>(y.x, y.y, y.z), scale * mean_size, visit_scaled);
  }
} // namespace taut
