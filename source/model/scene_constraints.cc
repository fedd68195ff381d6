// SPDX-License-Identifier: LGPL-2.1-or-later
#include "model/scene_constraints.h"
#include "base/text.h"
#include "interface/schur_complement.h"
#include "model/check_joints.h"
#include "model/surface_constraints.h"
#include "scene/travel.h"
#include <taut/base/exceptions.h>
#include <taut/cable/cable.h>

#include <algorithm>
#include <cmath>

namespace taut
{
  namespace
  {
    /// Appends B_i of a link with its `to` end at an attachment, along @p direction there.
    void append_link(const SceneBodies &bodies, const Link &link, const Attachment &to,
                     const Coordinates &direction, std::vector<Term> &terms)
    {
      const double sign = link.kind == LinkKind::dropper ? -1. : 1.;
      bodies.motion(to, link.rotational, direction, sign, terms);
      bodies.motion(link.from, link.rotational, link.direction, -sign, terms);
    }

    void append_link(const SceneBodies &bodies, const Link &link, const Attachment &to,
                     std::vector<Term> &terms)
    {
      append_link(bodies, link, to, link.direction, terms);
    }

    LinkEnd link_end(const Scene &scene, const SceneBodies &bodies, const Attachment &at)
    {
      LinkEnd end{bodies.position(scene, at)};
      const Coordinates axes[] = {{1., 0., 0.}, {0., 1., 0.}, {0., 0., 1.}};
      for (unsigned int c = 0; c < 3; ++c)
        bodies.motion(at, false, axes[c], 1., end.motion[c]);
      return end;
    }

    /// The direction of a link that turns.
    std::shared_ptr<TurningDirection> turning_direction(const Scene &scene,
                                                        const SceneBodies &bodies, const Link &link)
    {
      std::vector<LinkEnd> places;
      Link::visit_places(link, [&](const Attachment &at)
                         { places.push_back(link_end(scene, bodies, at)); });
      auto result = std::make_shared<TurningDirection>(std::move(places),
                                                       link.kind == LinkKind::dropper ? -1. : 1.);
      for (std::size_t k = 0; k < result->size(); ++k)
        if (!(norm(result->start[k]) > 0.))
          throw EntryError(link.origin,
                           to_text("link '", link.name, "' turns, and ",
                                   link.through.empty() ? "its ends start at"
                                                        : "two places next to each other are",
                                   " one place, (", result->places[k].position,
                                   ") m: it has no direction. Move one of them, or take a ball "
                                   "joint"));
      if (link.unstressed_length > 0.)
        result->length = link.unstressed_length;
      else
        result->length -= result->sign * link.gap;
      if (!link.length_in_time.is_zero())
        result->length_at =
            [of_time = link.length_in_time, name = link.name, origin = link.origin](const double t)
        {
          const double length = of_time(0., t);
          if (!(length > 0.))
            throw EntryError(origin.empty() ? "" : origin + "/Length",
                             to_text("link '", name, "' has a length of ", length, " m at t = ", t,
                                     " s: end the run before it is reeled in, or give a positive "
                                     "length"));
          return length;
        };
      if (!(result->length > 0.))
        throw EntryError(link.origin.empty() ? "" : link.origin + "/Gap",
                         "link '" + link.name +
                             "' has no length left: its ends are nearer than that. Give it a "
                             "Length");
      return result;
    }

    /// A contact that slides along a wire or a cable at a speed that does not depend on the motion.
    class SlidingPlace : public MovingPlace
    {
    public:
      SlidingPlace(const Scene &scene, const SceneBodies &bodies, const Link &link)
          : scene(scene), bodies(bodies), link(link), start(height(0.)), foot(foot_of_strip())
      {
      }

      double position(const double t) const override { return link.to.position + way(link, t); }

      void append_terms(const double t, std::vector<Term> &terms) const override
      {
        if (is_on_wire())
        {
          if (link.strip.empty())
            check(t);
          append_link(bodies, link, place(t), direction(sliding_position(t)), terms);
        }
        else
          bodies.communicator().agree([&] { append_on_cable(t, terms); });
      }

      void append_rates(const double t, std::vector<Term> &terms) const override
      {
        if (is_beyond(t))
          return;
        bodies.slope(place(t), direction(sliding_position(t)), speed(t), terms);
        if (is_canted())
          bodies.motion(place(t), false, turn(sliding_position(t)), speed(t), terms);
      }

      /// A contact on a cable: displacements count from the shape at rest, whose height the contact
      /// follows.
      double gap(const double t) const override
      {
        return link.gap + link.profile(sliding_position(t), t) + (height(t) - start) +
               height_above_strip(t) + cant_of_undeformed(sliding_position(t));
      }

      double profile(const double t) const override
      {
        return link.profile.is_constant() ? 0. : link.profile(sliding_position(t), t);
      }

      /// Whether the wire of a strip has not begun at a time, or has ended, not by rounding.
      bool is_beyond(const double t) const override
      {
        if (link.strip.empty())
          return false;
        const double s = position(t), rounding = same_end * wire_length();
        return s < -rounding || s > wire_length() + rounding;
      }

      /// A wire takes over from above the strip. Its end at the height of the strip, or below it,
      /// would be hit from the side, which no gap along the direction of the contact describes.
      void follow(const Motion &motion, const double start, const double end) override
      {
        if (!is_beyond(start) || is_beyond(end))
          return;
        ends_of_strip.clear();
        append_link(bodies, link, place(start), direction(sliding_position(start)), ends_of_strip);
        const double D = motion(ends_of_strip, start) + gap(start);
        if (!(D < -same_height))
          return;
        const Wire &wire = scene.wires[link.to.index];
        throw EntryError(link.origin,
                         to_text("strip '", link.strip, "' comes to an end of wire '", wire.name,
                                 "' at t = ", end, " s that is ", -D,
                                 " m below it: it would hit this end from the side. Raise this end "
                                 "of the wire, or start the strip beside it, not before it"));
      }

    protected:
      virtual double speed(const double t) const { return speed_at(link, t); }

      const Scene &scene;
      const SceneBodies &bodies;
      const Link link;

    private:
      static constexpr double same_end = 1e-9;    ///< over the length of a wire
      static constexpr double same_height = 1e-6; ///< of a strip and the end of a wire [m]
      static constexpr double along_wire = 1e-3;  ///< half of a difference over s [m]

      /// Position of the contact or, beyond the ends of the wire of a strip, of this end.
      double sliding_position(const double t) const
      {
        const double s = position(t);
        return link.strip.empty() ? s : std::clamp(s, 0., wire_length());
      }

      Attachment place(const double t) const
      {
        return SceneBodies::moved(link.to, sliding_position(t));
      }

      /// Height of the first wire of the strip at the start, along the direction of the contact
      /// [m].
      double foot_of_strip() const
      {
        for (const Link &other : scene.links)
          if (!link.strip.empty() && other.strip == link.strip)
            return height_of_wire(other, other.to.position);
        return 0.;
      }

      double height_of_wire(const Link &other, const double s) const
      {
        return dot(link.direction, scene.wires[other.to.index].at(s));
      }

      /// Undeformed wires of a strip may have different heights and slopes [m].
      double height_above_strip(const double t) const
      {
        return link.strip.empty() ? 0. : height_of_wire(link, sliding_position(t)) - foot;
      }

      double wire_length() const { return scene.wires[link.to.index].length(); }

      bool is_canted() const { return !link.cant.is_zero(); }
      double cant(const double s) const { return link.cant(std::clamp(s, 0., wire_length()), 0.); }

      /// The direction a quarter turn further about the wire.
      Coordinates sideways() const
      {
        return cross(scene.wires[link.to.index].tangent(), link.direction);
      }

      /// n at a place of the wire.
      Coordinates direction(const double s) const
      {
        if (!is_canted())
          return link.direction;
        const double phi = cant(s);
        return add_scaled(add_scaled({}, std::cos(phi), link.direction), std::sin(phi), sideways());
      }

      /// dn / ds [1/m].
      Coordinates turn(const double s) const
      {
        const double a = std::max(0., s - along_wire), b = std::min(wire_length(), s + along_wire);
        return add_scaled({}, 1. / (b - a), direction(b) - direction(a));
      }

      /// What the undeformed wire has along n beside its height along the direction [m].
      double cant_of_undeformed(const double s) const
      {
        if (!is_canted())
          return 0.;
        const Coordinates at = scene.wires[link.to.index].at(s);
        const double axis = link.strip.empty() ? height_of_wire(link, link.to.position) : foot,
                     phi = cant(s);
        return (std::cos(phi) - 1.) * (dot(link.direction, at) - axis) +
               std::sin(phi) * dot(sideways(), at);
      }

      /// Height of the place on the cable at rest, along the direction of the contact [m].
      double height(const double t) const
      {
        return is_on_wire() ? 0. : dot(link.direction, bodies.position(scene, place(t)));
      }

      /// Only the cable knows its length.
      void append_on_cable(const double t, std::vector<Term> &terms) const
      {
        try
        {
          append_link(bodies, link, place(t), terms);
        }
        catch (const UserError &e)
        {
          throw EntryError(link.origin,
                           to_text("sliding contact '", link.name, "' at t = ", t, " s: ", e.what(),
                                   ". End the run earlier or lengthen the cable."));
        }
      }

      bool is_on_wire() const { return link.to.kind == Attachment::Kind::wire; }

      /// A step that ends at the end of the wire, up to rounding, is on the wire.
      void check(const double t) const
      {
        const Wire &wire = scene.wires[link.to.index];
        const double length = wire.length(), s = position(t);
        if (s >= -same_end * length && s <= (1. + same_end) * length)
          return;
        throw EntryError(link.origin,
                         to_text("sliding contact '", link.name, "' leaves wire '", wire.name,
                                 "' at t = ", t, " s, position ", s, " m of ", length,
                                 " m. End the run earlier or lengthen the wire."));
      }

      const double start, foot;
      std::vector<Term> ends_of_strip; ///< in follow()
    };

    /// A contact with this speed in space, on a cable that moves along under it. The place at the
    /// end of a step follows from the motion at the start of the step.
    class StraightPlace : public SlidingPlace
    {
    public:
      StraightPlace(const Scene &scene, const SceneBodies &bodies, const Link &link)
          : SlidingPlace(scene, bodies, link)
      {
        double sizes[] = {0., 0.};
        if (const std::size_t k = bodies.index_at(link.to.index, link.to.place);
            k != Structure::elsewhere)
        {
          const CableElements &elements = dynamic_cast<const Cable &>(bodies[k]).elements();
          sizes[0] = elements.length();
          sizes[1] = elements.element_length();
        }
        bodies.communicator().sum(sizes, 2);
        length = sizes[0];
        element_length = sizes[1];
        const Coordinates chord = rest(length) - rest(0.);
        along = add_scaled(chord, -dot(chord, link.direction), link.direction);
        if (!(norm(along) > nearly_across * norm(chord)))
          throw EntryError(link.origin + "/Straight",
                           "the line between the ends of the cable is along the Direction of the "
                           "contact, and none is left that it could travel; set it to false");
        along = add_scaled({}, 1. / norm(along), along);
      }

      double position(const double t) const override
      {
        return is_known ? known.position + known.speed * (t - known.time)
                        : SlidingPlace::position(t);
      }

      void follow(const Motion &motion, const double start, const double end) override
      {
        if (!is_known)
          known.origin = reached(motion, position(start), start) - taut::way(link, start);
        const double before = position(start), way = known.origin + taut::way(link, end),
                     enough = same_place * (length + std::fabs(way)),
                     first_error = reached(motion, before, end) - way;
        // A place on this leg of the cable.
        const double a = std::max(0., before - difference * element_length),
                     b = std::min(length, before + difference * element_length),
                     leg = (reached(motion, b, end) - reached(motion, a, end)) / (b - a);
        double s = before, error = first_error, slope = leg;
        for (int i = 0; !(std::fabs(error) <= enough); ++i)
        {
          const double next = std::clamp(s - error / slope, 0., length);
          if (!(std::fabs(next - s) > 0.) || i == most_searches)
            leave(s, end);
          const double error_there = reached(motion, next, end) - way;
          if (error_there == error)
            leave(s, end);
          slope = (error_there - error) / (next - s);
          s = next;
          error = error_there;
        }
        const int n = static_cast<int>(std::ceil(std::fabs(s - before) / element_length));
        double last = first_error + way;
        for (int i = 1; i <= n; ++i)
        {
          const double next = reached(motion, before + (s - before) * i / n, end);
          if (!((next - last) * (s - before) * leg >= 0.))
            leave(s, end);
          last = next;
        }
        known = {known.origin, end, s, (s - before) / (end - start)};
        is_known = true;
      }

      void append_course(std::vector<double> &course) const override
      {
        if (is_known)
          course.insert(course.end(), {known.origin, known.time, known.position, known.speed});
      }

      void set_course(const std::vector<double> &course) override
      {
        is_known = !course.empty();
        if (is_known)
          known = {course[0], course[1], course[2], course[3]};
      }

    private:
      static constexpr double nearly_across = 1e-6; ///< sine of an angle
      static constexpr double same_place = 1e-13;   ///< over length of the cable and path
      static constexpr double difference = 1e-3;    ///< over the length of an element
      static constexpr int most_searches = 50;      ///< a secant method takes five

      double speed(const double t) const override
      {
        return is_known ? known.speed : speed_at(link, t);
      }

      Coordinates rest(const double s) const
      {
        return bodies.position(scene, SceneBodies::moved(link.to, s));
      }

      /// Position along the path of a place of the cable at a time [m].
      double reached(const Motion &motion, const double s, const double t)
      {
        form.clear();
        bodies.motion(SceneBodies::moved(link.to, s), false, along, 1., form);
        return dot(along, rest(s)) + motion(form, t);
      }

      [[noreturn]] void leave(const double s, const double t) const
      {
        throw EntryError(
            link.origin + "/Speed",
            to_text("sliding contact '", link.name, "' finds no place of the cable at t = ", t,
                    " s, near ", s, " m of ", length,
                    " m: it has come to an end of it, or the cable turns back there. End the run "
                    "earlier, lengthen the cable, or take a smaller step"));
      }

      Coordinates along;      ///< direction of the path
      std::vector<Term> form; ///< in reached()
      double length = 0., element_length = 0.;

      struct Course
      {
        double origin;                ///< along the path at t = 0 [m]
        double time, position, speed; ///< along the cable [s, m, m/s]
      };
      Course known = {};
      bool is_known = false;
    };
  } // namespace

  Constraints scene_constraints(const Scene &scene, const SceneBodies &bodies)
  {
    std::vector<ConstraintData> constraints;
    for (std::size_t i = 0; i < scene.links.size(); ++i)
    {
      const Link &link = scene.links[i];
      ConstraintData constraint{link.name, link.origin, i};
      constraint.cone = Cone::unilateral_if(link.unilateral());
      constraint.rotational = link.rotational;
      constraint.spring = {link.stiffness, link.damping, link.law};
      constraint.gap = link.gap;
      if (link.moving())
        constraint.geometry = link.straight ? std::make_shared<StraightPlace>(scene, bodies, link)
                                            : std::make_shared<SlidingPlace>(scene, bodies, link);
      else if (link.turns)
        constraint.geometry = turning_direction(scene, bodies, link);
      else
        append_link(bodies, link, link.to, constraint.terms);
      constraint.gap += dot(link.direction, distance_of_tie(scene, bodies, i));
      constraints.push_back(std::move(constraint));
    }
    for (const Link &link : scene.links)
      if (link.sideways.stiffness > 0.)
      {
        ConstraintData constraint{link.name + " sideways", link.origin};
        constraint.spring.stiffness = link.sideways.stiffness;
        constraint.gap = link.sideways.gap;
        bodies.motion(link.to, false, link.sideways.direction, 1., constraint.terms);
        bodies.motion(link.from, false, link.sideways.direction, -1., constraint.terms);
        constraints.push_back(std::move(constraint));
      }
    std::vector<ConstraintData> of_surfaces = surface_constraints(scene, bodies);
    constraints.reserve(constraints.size() + of_surfaces.size() + bodies.cut_constraints().size());
    for (ConstraintData &constraint : of_surfaces)
      constraints.push_back(std::move(constraint));
    RowNumbers numbers{bodies.n_cuts()};
    for (const CutConstraint &cut : bodies.cut_constraints())
    {
      ConstraintData constraint{cut.name};
      constraint.rotational = cut.rotational;
      constraint.terms = cut.terms;
      constraints.push_back(std::move(constraint));
      numbers.here.push_back(cut.number);
    }
    if (bodies.communicator().any(numbers.here.size() < numbers.n_of_all))
      return Constraints(bodies, std::move(constraints), std::move(numbers));
    return Constraints(bodies, std::move(constraints));
  }

  void choose_rows(Constraints &constraints, const InterfaceParameters &parameters,
                   const SceneBodies &bodies, const bool is_at_rest)
  {
    constraints.distribute(suits_distributed_rows(parameters, bodies, constraints, is_at_rest));
  }
} // namespace taut
