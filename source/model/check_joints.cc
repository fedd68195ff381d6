// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/base/text.h>
#include <taut/cable/cable.h>
#include <taut/mechanism/rigid_body.h>
#include <taut/model/check_joints.h>
#include <taut/scene/contact_surface.h>
#include <taut/scene/entries.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace taut
{
  namespace
  {
    const Coordinates axes[] = {{1., 0., 0.}, {0., 1., 0.}, {0., 0., 1.}};

    std::string path(const std::string &origin, const std::string &entry)
    {
      return origin.empty() ? "" : origin + "/" + entry;
    }

    /// The directions that a link acts along, whatever the motion.
    std::vector<Coordinates> directions(const Link &link)
    {
      if (link.turns)
        return {std::begin(axes), std::end(axes)};
      return {link.direction};
    }

    /// Whether a form has a part on DoFs that are free or have a prescribed motion.
    bool moves(const Substructure &body, const LinearForm &form)
    {
      /// Rounding of a form at an end of a cable, on DoFs beside the end.
      constexpr double rounding = 1e-10;
      std::vector<char> stands(body.n_dofs(), 0);
      for (const ConstrainedDof &held : body.constraints())
        stands[held.dof] = !held.motion;
      double free = 0., all = 0.;
      for (std::size_t i = 0; i < form.index.size(); ++i)
      {
        all += std::fabs(form.value[i]);
        if (!stands[form.index[i]])
          free += std::fabs(form.value[i]);
      }
      return free > rounding * all;
    }

    /// Number of directions in which a place moves, if its body is on this rank.
    double n_motions(const SceneBodies &bodies, const Attachment &end, const bool rotational,
                     const std::vector<Coordinates> &along)
    {
      double n = 0.;
      for (const Coordinates &direction : along)
      {
        std::vector<Term> terms;
        bodies.motion(end, rotational, direction, 1., terms);
        for (const Term &term : terms)
          n += moves(bodies[term.substructure], term.form);
      }
      return n;
    }

    std::string at_held_end(const Scene &scene, const Attachment &end)
    {
      return "a held end of cable '" + scene.bodies[end.index].name + "'";
    }
  } // namespace

  std::vector<std::string> check_held_ends(const Scene &scene, const SceneBodies &bodies)
  {
    // The motions of the ends of each link and load that may be at a held end.
    std::vector<double> n;
    const auto is_checked = [&](const Link &link)
    {
      return !link.moving() && !link.rotational &&
             (is_on_cable(scene, link.from) || is_on_cable(scene, link.to));
    };
    for (const Link &link : scene.links)
      if (is_checked(link))
        for (const Attachment *end : {&link.from, &link.to})
          n.push_back(n_motions(bodies, *end, false, directions(link)));
    for (const Load &load : scene.loads)
      if (is_on_cable(scene, load.target))
        n.push_back(n_motions(bodies, load.target, false, {load.direction}));
    bodies.communicator().sum(n);

    std::vector<std::string> grounded;
    auto of_end = n.begin();
    for (const Link &link : scene.links)
    {
      if (!is_checked(link))
        continue;
      const double from = *of_end++, to = *of_end++;
      const bool is_from = is_on_cable(scene, link.from) && from == 0.,
                 is_to = is_on_cable(scene, link.to) && to == 0.;
      if (!is_from && !is_to)
        continue;
      const Attachment &end = is_from ? link.from : link.to;
      if (from == 0. && to == 0.)
        throw EntryError(path(link.origin, is_from ? "From" : "To"),
                         "link '" + link.name + "': it acts at " + at_held_end(scene, end) +
                             ", and its other end does not move either: it has no effect. Let "
                             "Held ends of the cable leave that end free, or remove the link");
      grounded.push_back(link.name);
    }
    for (const Load &load : scene.loads)
      if (is_on_cable(scene, load.target) && *of_end++ == 0.)
        throw EntryError(path(load.origin, "On"),
                         "load '" + load.name + "': it acts at " + at_held_end(scene, load.target) +
                             ", which takes it: it has no effect. Let Held ends of the cable leave "
                             "that end free, or move the load");
    return grounded;
  }

  namespace
  {
    /// Largest distance of the two places of a ball joint over the length of the shorter body. This
    /// distance is an unbalanced lever of the force, and the error of direction of a body in rad.
    /// Places that are written with three digits have this error.
    constexpr double same_place = 1e-3;

    /// Largest distance of two points over their distance from the origin: both places should be
    /// written alike.
    constexpr double written_alike = 1e-6;

    bool is_point(const Attachment &end)
    {
      return end.kind == Attachment::Kind::mass || end.kind == Attachment::Kind::ground;
    }

    /// The diagonal of the box around the surface of a body [m]; 0 for a body without a surface.
    double size_of_surface(const Scene &scene, const CustomBody &body)
    {
      ContactSurface surface;
      try
      {
        surface = body.type->surface({body.name, body.origin, scene.gravity}, {});
      }
      catch (const EntryError &)
      {
        return 0.;
      }
      double squares = 0.;
      for (unsigned int c = 0; c < 3 && !surface.points.empty(); ++c)
      {
        const auto [first, last] = std::minmax_element(
            surface.points.begin(), surface.points.end(),
            [c](const Coordinates &a, const Coordinates &b) { return a[c] < b[c]; });
        squares += std::pow((*last)[c] - (*first)[c], 2);
      }
      return std::sqrt(squares);
    }

    /// The length over which a force at a place turns a body [m]; infinite for points and for
    /// bodies of unknown size.
    double length_of(const Scene &scene, const SceneBodies &bodies, const Attachment &end)
    {
      constexpr double infinity = std::numeric_limits<double>::infinity();
      if (end.kind == Attachment::Kind::wire)
        return scene.wires[end.index].length();
      double length = 0.;
      if (end.kind == Attachment::Kind::body)
      {
        const std::size_t k = bodies.index_at(end.index, end.place);
        if (k != Structure::elsewhere)
        {
          if (const auto *cable = dynamic_cast<const Cable *>(&bodies[k]))
            length = cable->elements().length();
          else if (const auto *rigid = dynamic_cast<const RigidBody *>(&bodies[k]))
            length = rigid->radius_of_gyration();
        }
        bodies.communicator().sum(&length, 1);
        if (length == 0.)
          length = size_of_surface(scene, scene.bodies[end.index]);
      }
      return length > 0. ? length : infinity;
    }

    bool is_same(const Attachment &a, const Attachment &b)
    {
      return a.kind == b.kind && a.index == b.index && a.position == b.position &&
             a.place == b.place;
    }

    /// Only a ball joint makes joints along several directions between two places in one section.
    bool are_one_ball_joint(const Link &a, const Link &b)
    {
      return !a.origin.empty() && a.origin == b.origin && a.kind == LinkKind::joint &&
             b.kind == LinkKind::joint && is_same(a.from, b.from) && is_same(a.to, b.to);
    }
  } // namespace

  void check_ball_joints(const Scene &scene, const SceneBodies &bodies)
  {
    for (std::size_t i = 0; i + 1 < scene.links.size(); ++i)
    {
      const Link &link = scene.links[i];
      const bool is_first = i == 0 || !are_one_ball_joint(scene.links[i - 1], link);
      const auto has_place = [](const Attachment &end)
      { return end.kind != Attachment::Kind::ground || end.has_place; };
      if (!is_first || !are_one_ball_joint(link, scene.links[i + 1]) || !has_place(link.from) ||
          !has_place(link.to))
        continue;
      const bool are_points = is_point(link.from) && is_point(link.to);
      const Coordinates from = bodies.position(scene, link.from),
                        to = bodies.position(scene, link.to);
      // What the gaps of its joints do not say.
      Coordinates between = to - from;
      for (std::size_t k = i; k < scene.links.size() && are_one_ball_joint(scene.links[k], link);
           ++k)
        between = add_scaled(between, -scene.links[k].gap, scene.links[k].direction);
      const double distance = norm(between),
                   least = are_points ? written_alike * std::max(norm(from), norm(to))
                                      : same_place * std::min(length_of(scene, bodies, link.from),
                                                              length_of(scene, bodies, link.to));
      if (std::isinf(least) || distance <= least)
        continue;
      throw EntryError(path(link.origin, "To"),
                       to_text("link '", link.name, "' is of a ball joint, whose places are ",
                               distance, " m apart before anything moves: From is at ", from,
                               ", To at ", to, ". Bring them together, to ", least, " m (",
                               are_points ? "a millionth of their distance from the origin"
                                          : "a thousandth of the shorter body",
                               "), or take a joint along each direction"));
    }
  }
} // namespace taut
