// SPDX-License-Identifier: LGPL-2.1-or-later
#include "output/scene_sketch.h"
#include "base/memory.h"
#include "base/write_file.h"
#include <taut/base/exceptions.h>
#include <taut/scene/contact_surface.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <map>
#include <sstream>
#include <tuple>
#include <utility>
#include <vector>

namespace taut
{
  namespace
  {
    /// A drawing on a page of at most 1000 x 700 pixels.
    class Sketch
    {
    public:
      void include(const Coordinates &p)
      {
        left = std::min(left, p.x);
        right = std::max(right, p.x);
        bottom = std::min(bottom, p.y);
        top = std::max(top, p.y);
      }

      double lowest() const { return bottom; }

      /// Begins the drawing, after all points were included. Masses at one place hang below each
      /// other, @p most_masses of them.
      void begin(const int most_masses)
      {
        constexpr double most_width = 1000., most_height = 700., least_height = 120.;
        if (left > right) // nothing to draw
          left = right = bottom = top = 0.;
        const double wide = right - left, high = top - bottom, span = std::max({wide, high, 1e-12});
        sx = std::min(most_width / std::max(wide, 1e-12 * span),
                      most_height / std::max(high, 1e-12 * span));
        const double most = 1e3 * sx;
        sy = high > 0. ? std::clamp(least_height / high, sx, most) : sx;
        width = std::max(wide * sx, least_height);
        height = std::max(high * sy, least_height);
        const double below = mass_distance * std::max(0, most_masses - 1);
        out << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\""
            << std::max(width + 2. * margin, legend_width) << "\" height=\""
            << height + below + 2. * margin << "\" font-family=\"sans-serif\" font-size=\"11\">\n"
            << "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
      }

      void line(const Coordinates &p, const Coordinates &q, const std::string &style)
      {
        out << "<line x1=\"" << X(p) << "\" y1=\"" << Y(p) << "\" x2=\"" << X(q) << "\" y2=\""
            << Y(q) << "\" " << style << "/>\n";
      }
      void dot(const Coordinates &p, const double radius, const std::string &style)
      {
        out << "<circle cx=\"" << X(p) << "\" cy=\"" << Y(p) << "\" r=\"" << radius << "\" "
            << style << "/>\n";
      }
      /// A mass, below those at the same place.
      void mass(const Coordinates &p, const std::string &name)
      {
        const int before = n_masses[pixel(p)]++;
        const double y = Y(p) + mass_distance * before;
        if (before > 0)
          out << "<line x1=\"" << X(p) << "\" y1=\"" << y - mass_distance << "\" x2=\"" << X(p)
              << "\" y2=\"" << y << "\" stroke=\"#393\"/>\n";
        out << "<circle cx=\"" << X(p) << "\" cy=\"" << y << "\" r=\"5\" fill=\"#393\"/>\n";
        if (before == 0)
          label(p, name);
        else
          text(X(p) + 9., y + 4., name);
      }

      /// The ground: a triangle below a point.
      void ground(const Coordinates &p)
      {
        out << "<path d=\"M" << X(p) << ' ' << Y(p) << " l-5 8 h10 z\" fill=\"#36c\"/>\n";
      }
      void label(const Coordinates &p, const std::string &name)
      {
        // Names of one place stand above each other.
        constexpr double line_height = 12.;
        const int before = n_labels[pixel(p)]++;
        text(X(p) + 6., Y(p) - 6. - line_height * before, name);
      }

      std::string end()
      {
        out << "<text x=\"8\" y=\"14\">black: wires and bodies, blue: supports and ground, green: "
               "masses, red: links (hollow: unilateral); heights x "
            << std::setprecision(2) << sy / sx << "</text>\n</svg>\n";
        return whole_text(out);
      }

    private:
      static constexpr double margin = 40., legend_width = 620., mass_distance = 16.;

      void text(const double x, const double y, const std::string &name)
      {
        std::string safe;
        for (const char c : name)
          safe += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
        out << "<text x=\"" << x << "\" y=\"" << y << "\">" << safe << "</text>\n";
      }
      std::pair<long, long> pixel(const Coordinates &p) const
      {
        return {std::lround(X(p)), std::lround(Y(p))};
      }
      double X(const Coordinates &p) const
      {
        return margin + .5 * width + (p.x - .5 * (left + right)) * sx;
      }
      double Y(const Coordinates &p) const
      {
        return margin + .5 * height - (p.y - .5 * (bottom + top)) * sy;
      }

      double left = 1e300, right = -1e300, bottom = 1e300, top = -1e300;
      double sx = 1., sy = 1., width = 0., height = 0.;
      std::map<std::pair<long, long>, int> n_labels, n_masses; ///< at a pixel
      std::ostringstream out;
    };

    bool is_ground(const Attachment &end)
    {
      return end.kind == Attachment::Kind::ground;
    }

    /// Where a link to the ground begins that acts at @p end. The ground has a place, or the link
    /// comes from the lowest point of the scene.
    Coordinates foot(const Link &link, const Attachment &ground, const Coordinates &place,
                     const Coordinates &end, const double lowest)
    {
      if (ground.has_place)
        return place;
      const Coordinates &n = link.direction;
      constexpr double flat = 1e-6;
      if (link.rotational || link.turns || std::fabs(n.y) < flat * norm(n))
        return end;
      return add_scaled(end, (lowest - end.y) / n.y, n);
    }

    struct Ends
    {
      Coordinates begin, end; ///< the begin is that on the ground, if there is one
    };

    Ends ends(const Link &link, const Coordinates &from, const Coordinates &to, const double lowest)
    {
      if (is_ground(link.from))
        return {foot(link, link.from, from, to, lowest), to};
      if (is_ground(link.to))
        return {foot(link, link.to, to, from, lowest), from};
      return {from, to};
    }

    using Lines = std::vector<std::pair<Coordinates, Coordinates>>;

    /// Edges of the faces of a surface.
    Lines edges_of(const ContactSurface &surface)
    {
      Lines lines;
      for (const std::vector<unsigned int> &face : surface.faces)
      {
        const auto at = [&](const std::size_t corner) { return surface.points[face[corner]]; };
        if (surface.dim < 3)
        {
          lines.emplace_back(at(0), at(1));
          continue;
        }
        // Triangles have 3 or 6 nodes, quadrilaterals (degree + 1)^2 in lexicographic order.
        const std::size_t n = surface.degree + 1, last = n * n - 1;
        const std::vector<std::size_t> corners =
            face.size() == n * n ? std::vector<std::size_t>{0, n - 1, last, last - (n - 1)}
                                 : std::vector<std::size_t>{0, 1, 2};
        for (std::size_t c = 0; c < corners.size(); ++c)
          lines.emplace_back(at(corners[c]), at(corners[(c + 1) % corners.size()]));
      }
      return lines;
    }

    /// Calls @p visit with each place of all links and where it is.
    template <typename Visit>
    void visit_places(const Scene &scene, const ScenePlaces &places, const Visit &visit)
    {
      for (std::size_t i = 0; i < scene.links.size(); ++i)
      {
        auto at = places.links[i].begin();
        Link::visit_places(scene.links[i], [&](const Attachment &end) { visit(end, *at++); });
      }
    }

    /// What shows body @p b, unless it is a cable: its surface or, without one, lines from the
    /// first to the other places where links act on it.
    Lines outline_of(const Scene &scene, const ScenePlaces &places, const std::size_t b)
    {
      const CustomBody &body = scene.bodies[b];
      try
      {
        return edges_of(body.type->surface({body.name, body.origin, scene.gravity}, {}));
      }
      catch (const EntryError &)
      {
      }
      std::vector<Coordinates> held;
      visit_places(scene, places,
                   [&](const Attachment &end, const Coordinates &at)
                   {
                     if (end.kind == Attachment::Kind::body && end.index == b)
                       held.push_back(at);
                   });
      Lines lines;
      for (std::size_t j = 1; j < held.size(); ++j)
        lines.emplace_back(held[0], held[j]);
      return lines;
    }

    /// Of all bodies, in their order.
    std::vector<Lines> outlines_of(const Scene &scene, const ScenePlaces &places)
    {
      std::vector<Lines> result;
      for (std::size_t b = 0; b < scene.bodies.size(); ++b)
        result.push_back(places.cables[b].empty() ? outline_of(scene, places, b) : Lines());
      return result;
    }

    void include_all(const Scene &scene, const ScenePlaces &places,
                     const std::vector<Lines> &outlines, Sketch &sketch)
    {
      for (const Lines &outline : outlines)
        for (const auto &[p, q] : outline)
          for (const Coordinates &end : {p, q})
            sketch.include(end);
      for (const Wire &wire : scene.wires)
        for (const Coordinates &end : {wire.a, wire.b})
          sketch.include(end);
      for (const Mass &mass : scene.masses)
        sketch.include(mass.position);
      for (const std::vector<Coordinates> &cable : places.cables)
        for (const Coordinates &p : cable)
          sketch.include(p);
      visit_places(scene, places,
                   [&](const Attachment &end, const Coordinates &at)
                   {
                     if (end.kind == Attachment::Kind::body || end.has_place)
                       sketch.include(at);
                   });
      const double lowest = sketch.lowest();
      for (std::size_t i = 0; i < scene.links.size(); ++i)
        if (const Link &link = scene.links[i]; is_ground(link.from) || is_ground(link.to))
          sketch.include(ends(link, places.links[i].front(), places.links[i].back(), lowest).begin);
    }

    /// A rope through rings, from place to place.
    void draw_rope(const Link &link, const std::vector<Coordinates> &places, Sketch &sketch)
    {
      auto at = places.begin();
      Link::visit_places(link,
                         [&](const Attachment &end)
                         {
                           if (is_ground(end))
                             sketch.ground(*at);
                           if (at != places.begin())
                             sketch.line(*(at - 1), *at, "stroke=\"#888\"");
                           sketch.dot(*at++, 2.5, "fill=\"none\" stroke=\"#c33\"");
                         });
    }

    void draw_link(const Link &link, const Coordinates &from, const Coordinates &to, Sketch &sketch)
    {
      const auto [begin, end] = ends(link, from, to, sketch.lowest());
      if (is_ground(link.from) || is_ground(link.to))
        sketch.ground(begin);
      sketch.line(begin, end, "stroke=\"#888\"");
      sketch.dot(end, link.moving() ? 5. : 2.5,
                 link.unilateral() ? "fill=\"none\" stroke=\"#c33\"" : "fill=\"#c33\"");
    }

    /// The most masses at one place.
    int most_at_one_place(const std::vector<Mass> &masses)
    {
      std::map<std::tuple<double, double, double>, int> n;
      int most = 0;
      for (const Mass &mass : masses)
        most = std::max(most, ++n[{mass.position.x, mass.position.y, mass.position.z}]);
      return most;
    }

    /// Labels of wires. Of many whose names differ in a number at the end only the first one has a
    /// label: "stitch 1 to 11".
    std::vector<std::string> labels_of(const std::vector<Wire> &wires)
    {
      constexpr std::size_t many = 3;
      const auto family = [](const std::string &name)
      {
        const std::size_t last = name.find_last_not_of("0123456789");
        return last == std::string::npos ? "" : name.substr(0, last + 1);
      };
      std::map<std::string, std::vector<std::size_t>> members;
      for (std::size_t w = 0; w < wires.size(); ++w)
        members[family(wires[w].name)].push_back(w);
      std::vector<std::string> labels;
      for (const Wire &wire : wires)
        labels.push_back(wire.name);
      for (const auto &[name, of] : members)
      {
        if (of.size() < many || name.empty())
          continue;
        labels[of.front()] += " to " + wires[of.back()].name.substr(name.size());
        for (std::size_t m = 1; m < of.size(); ++m)
          labels[of[m]].clear();
      }
      return labels;
    }
  } // namespace

  void write_sketch(const Scene &scene, const ScenePlaces &places, const std::string &path)
  {
    Sketch sketch;
    const std::vector<Lines> outlines = outlines_of(scene, places);
    include_all(scene, places, outlines, sketch);
    sketch.begin(most_at_one_place(scene.masses));
    const std::string thick = "stroke=\"black\" stroke-width=\"2\"";
    for (std::size_t i = 0; i < scene.links.size(); ++i)
      if (scene.links[i].through.empty())
        draw_link(scene.links[i], places.links[i].front(), places.links[i].back(), sketch);
      else
        draw_rope(scene.links[i], places.links[i], sketch);
    for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    {
      const std::vector<Coordinates> &cable = places.cables[b];
      for (std::size_t j = 1; j < cable.size(); ++j)
        sketch.line(cable[j - 1], cable[j], thick);
      for (const auto &[p, q] : outlines[b])
        sketch.line(p, q, "stroke=\"black\"");
      if (!cable.empty() || !outlines[b].empty())
        sketch.label(cable.empty() ? outlines[b][0].first : cable[0], scene.bodies[b].name);
    }
    const std::vector<std::string> labels = labels_of(scene.wires);
    for (std::size_t w = 0; w < scene.wires.size(); ++w)
    {
      sketch.line(scene.wires[w].a, scene.wires[w].b, thick);
      if (!labels[w].empty())
        sketch.label(scene.wires[w].a, labels[w]);
    }
    for (const Spring &spring : scene.springs)
      if (spring.from != ground && spring.to != ground)
        sketch.line(scene.masses[spring.from].position, scene.masses[spring.to].position,
                    "stroke=\"#393\"");
    for (const Support &support : scene.supports)
      for (const double s : support.positions)
        sketch.dot(scene.wires[support.wire].at(s), 3.5, "fill=\"#36c\"");
    for (const Mass &mass : scene.masses)
      sketch.mass(mass.position, mass.name);
    write_file(path, sketch.end());
  }
} // namespace taut
