// SPDX-License-Identifier: LGPL-2.1-or-later
#include "model/entry_path.h"

#include "base/text.h"
#include "model/check_joints.h"
#include "scene/entries.h"
#include <taut/base/exceptions.h>
#include <taut/cable/cable.h>
#include <taut/mechanism/rigid_body.h>
#include <taut/scene/contact_surface.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace taut
{
  namespace
  {
    const Coordinates axes[] = {{1., 0., 0.}, {0., 1., 0.}, {0., 0., 1.}};

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
             link.any_place([&](const Attachment &at) { return is_on_cable(scene, at); });
    };
    for (const Link &link : scene.links)
      if (is_checked(link))
        Link::visit_places(link, [&](const Attachment &at)
                           { n.push_back(n_motions(bodies, at, false, directions(link))); });
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
      const Attachment *held = nullptr;
      double n_of_all = 0.;
      Link::visit_places(link,
                         [&](const Attachment &at)
                         {
                           if (!held && is_on_cable(scene, at) && *of_end == 0.)
                             held = &at;
                           n_of_all += *of_end++;
                         });
      if (!held)
        continue;
      if (n_of_all == 0.)
        throw EntryError(entry_path(link.origin, held == &link.from ? "From"
                                                 : held == &link.to ? "To"
                                                                    : "Through"),
                         "link '" + link.name + "': it acts at " + at_held_end(scene, *held) +
                             ", and its other end does not move either: it has no effect. Let "
                             "Held ends of the cable leave that end free, or remove the link");
      grounded.push_back(link.name);
    }
    for (const Load &load : scene.loads)
      if (is_on_cable(scene, load.target) && *of_end++ == 0.)
        throw EntryError(entry_path(load.origin, "On"),
                         "load '" + load.name + "': it acts at " + at_held_end(scene, load.target) +
                             ", which takes it: it has no effect. Let Held ends of the cable leave "
                             "that end free, or move the load");
    return grounded;
  }

  namespace
  {
    /// Largest distance of the two places of a ball joint that a start closes, over the length of
    /// the shorter body. This distance is an unbalanced lever of the force, and the error of
    /// direction of a body in rad. Places that are written with three digits have this error.
    constexpr double same_place = 1e-3;

    /// The same up to which the distance is rounding of the places; at a cable where nothing is at
    /// rest, also up to which it stays: in its own equilibrium it is longer by its weight.
    constexpr double rounding_of_places = 1e-9, stretch_of_places = 1e-6;

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
      return !a.origin.empty() && a.origin == b.origin && a.kind == LinkKind::joint && !a.turns &&
             b.kind == LinkKind::joint && is_same(a.from, b.from) && is_same(a.to, b.to);
    }

    bool ties_places(const Scene &scene, const std::size_t link)
    {
      const std::vector<Link> &all = scene.links;
      return (link > 0 && are_one_ball_joint(all[link], all[link - 1])) ||
             (link + 1 < all.size() && are_one_ball_joint(all[link], all[link + 1]));
    }

    /// Where the two places of a link that ties them are.
    struct TiedPlaces
    {
      Coordinates from, to;
      bool are_points = false;
      double rounding = 0., most = 0.; ///< distances that are rounding, and that a start closes [m]

      Coordinates between; ///< the way that the gaps of the joints do not say [m]
    };

    TiedPlaces tied_places(const Scene &scene, const SceneBodies &bodies, const std::size_t i)
    {
      const Link &link = scene.links[i];
      TiedPlaces result;
      const auto has_place = [](const Attachment &end)
      { return end.kind != Attachment::Kind::ground || end.has_place; };
      if (!ties_places(scene, i) || !has_place(link.from) || !has_place(link.to))
        return result;
      result.from = bodies.position(scene, link.from);
      result.to = bodies.position(scene, link.to);
      result.between = result.to - result.from;
      std::size_t k = i;
      while (k > 0 && are_one_ball_joint(scene.links[k - 1], link))
        --k;
      for (; k < scene.links.size() && (k == i || are_one_ball_joint(scene.links[k], link)); ++k)
        result.between = add_scaled(result.between, -scene.links[k].gap, scene.links[k].direction);
      if (result.between == Coordinates())
        return result;
      const double from_origin = std::max(norm(result.from), norm(result.to));
      result.are_points = is_point(link.from) && is_point(link.to);
      const double length = result.are_points ? from_origin
                                              : std::min(length_of(scene, bodies, link.from),
                                                         length_of(scene, bodies, link.to));
      const bool stays = scene.start != Start::equilibrium &&
                         (is_on_cable(scene, link.from) || is_on_cable(scene, link.to));
      result.rounding = (stays ? stretch_of_places : rounding_of_places) *
                        (std::isinf(length) ? from_origin : length);
      result.most = (result.are_points ? written_alike : same_place) * length;
      return result;
    }
  } // namespace

  Coordinates distance_of_tie(const Scene &scene, const SceneBodies &bodies, const std::size_t link)
  {
    const TiedPlaces places = tied_places(scene, bodies, link);
    return norm(places.between) <= places.rounding ? Coordinates() : places.between;
  }

  void check_ball_joints(const Scene &scene, const SceneBodies &bodies)
  {
    for (std::size_t i = 0; i < scene.links.size(); ++i)
    {
      const Link &link = scene.links[i];
      const TiedPlaces places = tied_places(scene, bodies, i);
      const double distance = norm(places.between);
      const bool closes = scene.start == Start::equilibrium;
      if (distance <= (closes ? places.most : places.rounding))
        continue;
      throw EntryError(
          entry_path(link.origin, "To"),
          to_text("link '", link.name, "' is of a ball joint, whose places are ", distance,
                  " m apart before anything moves: From is at ", places.from, ", To at ", places.to,
                  ". Bring them together",
                  closes
                      ? to_text(", to ", places.most, " m (",
                                places.are_points ? "a millionth of their distance from the origin"
                                                  : "a thousandth of the shorter body",
                                "), or take")
                      : std::string(", start from 'equilibrium', which closes up to a thousandth "
                                    "of the shorter body, or take"),
                  " a joint along each direction"));
    }
  }

  std::string warning_of_joints(const Scene &scene)
  {
    // The joints at each place of each two bodies.
    using Place = std::array<double, 6>;
    std::map<std::pair<std::size_t, std::size_t>, std::map<Place, std::vector<std::string>>> all;
    const auto is_rigid = [&](const Attachment &end) {
      return end.kind == Attachment::Kind::body &&
             scene.bodies[end.index].type_name == "rigid body";
    };
    for (const Link &link : scene.links)
    {
      if (link.kind != LinkKind::joint || !link.rigid() || link.turns || link.rotational ||
          !is_rigid(link.from) || !is_rigid(link.to))
        continue;
      const bool is_swapped = link.from.index > link.to.index;
      const Attachment &a = is_swapped ? link.to : link.from, &b = is_swapped ? link.from : link.to;
      all[{a.index, b.index}][{a.place.x, a.place.y, a.place.z, b.place.x, b.place.y, b.place.z}]
          .push_back(link.name);
    }
    std::string pairs;
    for (const auto &[bodies, places] : all)
    {
      std::string names;
      for (const auto &[place, joints] : places)
        for (const std::string &name : joints)
          if (joints.size() < 3 && places.size() > 1)
            names += (names.empty() ? "'" : ", '") + name + "'";
      if (!names.empty())
        pairs += (pairs.empty() ? "joints " : ", ") + names +
                 (pairs.empty() ? " hold the rigid bodies '" : " '") +
                 scene.bodies[bodies.first].name + "' and '" + scene.bodies[bodies.second].name +
                 "'";
    }
    return pairs.empty()
               ? ""
               : pairs + " at a second place along directions that stay in space while the bodies "
                         "turn. This is a hinge, or a clamp, up to a mirror image only: where such "
                         "a direction meets the line between both places, the bodies part. Take a "
                         "link of Type 'hinge' or 'universal joint'";
  }
} // namespace taut
