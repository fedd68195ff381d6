// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/archive.h>
#include <taut/base/exceptions.h>
#include <taut/base/text.h>
#include <taut/model/form_finding.h>
#include <taut/model/scene_constraints.h>
#include <taut/model/scene_part.h>
#include <taut/model/shared_parts.h>
#include <taut/scene/entries.h>
#include <taut/scene/scene_values.h>
#include <taut/time/static_equilibrium.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace taut
{
  namespace
  {
    /// Vectors from end to end of undeformed links [m]. Only a body knows the positions of its
    /// places.
    std::vector<Coordinates> between_ends(const Scene &scene, const std::vector<Link> &links)
    {
      const bool is_on_body = std::any_of(links.begin(), links.end(),
                                          [](const Link &link) {
                                            return link.from.kind == Attachment::Kind::body ||
                                                   link.to.kind == Attachment::Kind::body;
                                          });
      std::optional<SceneBodies> bodies;
      if (is_on_body)
        bodies.emplace(scene);
      const auto at = [&](const Attachment &end)
      { return bodies ? bodies->position(scene, end) : place(scene, end); };
      std::vector<Coordinates> result;
      for (const Link &link : links)
        result.push_back(at(link.to) - at(link.from));
      return result;
    }

    /// Half of the mass of a dropper on each of its ends.
    void add_mass(const Link &link, Scene &scene)
    {
      if (link.form.mass_per_length == 0.)
        return;
      const double half = .5 * link.form.mass_per_length * link.length;
      for (const Attachment *end : {&link.from, &link.to})
        if (end->kind == Attachment::Kind::wire)
          scene.point_masses.push_back(
              {link.name, link.origin, end->index, {end->position}, half, true});
        else
          scene.masses[end->index].mass += half;
    }

    Load force(const Link &link, const Attachment &end, const double magnitude)
    {
      Load load;
      load.name = link.name;
      load.target = end;
      load.direction = link.direction;
      load.magnitude = Expression(magnitude);
      return load;
    }

    /// Masses that springs and fixed links connect with a wire, directly or through other masses.
    std::vector<char> masses_at_wires(const Scene &scene)
    {
      std::vector<char> result(scene.masses.size(), 0);
      bool is_done = false;
      const auto connect = [&](const std::size_t a, const std::size_t b)
      {
        if (a == ground || b == ground || result[a] == result[b])
          return;
        result[a] = result[b] = 1;
        is_done = false;
      };
      for (const Link &link : scene.links)
        for (const auto &[end, other] :
             {std::pair(link.from, link.to), std::pair(link.to, link.from)})
          if (!link.moving() && end.kind == Attachment::Kind::mass &&
              (other.kind == Attachment::Kind::wire || other.kind == Attachment::Kind::body))
            result[end.index] = 1;
      while (!is_done)
      {
        is_done = true;
        for (const Spring &spring : scene.springs)
          connect(spring.from, spring.to);
        for (const Link &link : scene.links)
          if (link.from.kind == Attachment::Kind::mass && link.to.kind == Attachment::Kind::mass)
            connect(link.from.index, link.to.index);
      }
      return result;
    }

    /// Bilateral constraints that hold the `to` ends: their multipliers are minus the tensions.
    std::vector<double> tensions(const Scene &base, const std::vector<Link> &droppers,
                                 const SolverParameters &parameters)
    {
      Scene scene = base;
      for (const Link &dropper : droppers)
      {
        add_mass(dropper, scene);
        Link hold;
        hold.name = dropper.name;
        hold.kind = LinkKind::joint;
        hold.to = dropper.to;
        hold.direction = dropper.direction;
        hold.gap = dropper.form.prescribed_displacement;
        scene.links.push_back(hold);
      }
      const SceneBodies structure(scene);
      const Constraints constraints = scene_constraints(scene, structure);
      const StaticState state = static_equilibrium(structure, constraints, parameters, 0.);
      std::vector<double> result;
      for (std::size_t i = 0; i < droppers.size(); ++i)
      {
        const double tension = -state.multiplier[constraints.index_of_link(base.links.size() + i)];
        if (!(tension >= 0.))
        {
          throw EntryError(droppers[i].origin,
                           to_text("dropper '", droppers[i].name, "' would have to push with ",
                                   -tension, " N to hold its wire at the prescribed height, ",
                                   -droppers[i].form.prescribed_displacement,
                                   " m as it was read. Move or remove it, or prescribe another "
                                   "height."));
        }
        result.push_back(tension);
      }
      return result;
    }

    /// Distances of the ends of the droppers, each along a direction, in the static state of a
    /// scene; @p between their undeformed ends.
    std::vector<double> distances(const Scene &scene, const std::vector<Link> &droppers,
                                  const std::vector<Coordinates> &between,
                                  const std::vector<Coordinates> &directions,
                                  const SolverParameters &parameters)
    {
      const SceneBodies structure(scene);
      const Constraints constraints = scene_constraints(scene, structure);
      const StaticState state = static_equilibrium(structure, constraints, parameters, 0.);
      std::vector<double> result;
      for (std::size_t i = 0; i < droppers.size(); ++i)
      {
        std::vector<Term> terms;
        structure.motion(droppers[i].to, false, directions[i], 1., terms);
        structure.motion(droppers[i].from, false, directions[i], -1., terms);
        result.push_back(dot(between[i], directions[i]) + evaluate(terms, state.displacement));
      }
      return result;
    }

    /// The direction across a dropper and the wire from which it hangs.
    Coordinates sideways(const Scene &scene, const Link &dropper)
    {
      return unit(cross(dropper.direction, scene.wires[dropper.from.index].tangent()),
                  dropper.origin);
    }

    /**
     * The droppers under their tensions. If the direction of a dropper is found, `tension` is the
     * part V of its tension along the prescribed height. The lateral part follows from the
     * direction: V/h times the lateral extent of the dropper, with the distance h along the height,
     * which no lateral force changes. This is a spring of stiffness V/h (a force density, H.-J.
     * Schek, Computer Methods in Applied Mechanics and Engineering 3 (1974), 115-134), so that the
     * static state is that of a linear scene.
     */
    DropperForm form_under(const Scene &base, const std::vector<Link> &droppers,
                           const std::vector<Coordinates> &between,
                           const std::vector<double> &tension, const SolverParameters &parameters)
    {
      Scene scene = base;
      std::vector<Coordinates> directions;
      bool finds_directions = false;
      for (std::size_t i = 0; i < droppers.size(); ++i)
      {
        add_mass(droppers[i], scene);
        scene.loads.push_back(force(droppers[i], droppers[i].from, tension[i]));
        scene.loads.push_back(force(droppers[i], droppers[i].to, -tension[i]));
        directions.push_back(droppers[i].direction);
        finds_directions |= droppers[i].form.find_direction;
      }
      DropperForm form{tension, distances(scene, droppers, between, directions, parameters),
                       std::vector<double>(droppers.size(), 0.)};
      for (std::size_t i = 0; i < droppers.size(); ++i)
        if (!(form.length[i] > 0.))
          throw EntryError(
              droppers[i].origin,
              to_text(
                  "dropper '", droppers[i].name,
                  "' would have no length: its wires touch in the static state. Undeformed they "
                  "are ",
                  dot(between[i], droppers[i].direction),
                  " m apart as it was read: are lengths in millimetres? Otherwise increase the "
                  "encumbrance or the tension of the upper wire."));
      if (!finds_directions)
        return form;

      for (std::size_t i = 0; i < droppers.size(); ++i)
        if (droppers[i].form.find_direction)
        {
          directions[i] = sideways(scene, droppers[i]);
          if (tension[i] == 0.)
            continue;
          Link spring;
          spring.name = droppers[i].name;
          spring.from = droppers[i].from;
          spring.to = droppers[i].to;
          spring.direction = directions[i];
          spring.stiffness = tension[i] / form.length[i];
          spring.gap = dot(between[i], directions[i]);
          scene.links.push_back(spring);
        }
      const std::vector<double> extent =
          distances(scene, droppers, between, directions, parameters);
      for (std::size_t i = 0; i < droppers.size(); ++i)
        if (droppers[i].form.find_direction)
        {
          const double length = std::hypot(form.length[i], extent[i]);
          form.tension[i] *= length / form.length[i];
          form.length[i] = length;
          form.sideways[i] = extent[i];
        }
      return form;
    }

    /// Turns a dropper into the direction that was found.
    void set_direction(const Scene &scene, const double tension, const double length,
                       const double extent, const Coordinates &between, Link &link)
    {
      const double c = std::sqrt(1. - extent * extent / (length * length)), s = extent / length;
      const Coordinates along = link.direction, across = sideways(scene, link), zero;
      link.direction = add_scaled(add_scaled(zero, c, along), s, across);
      link.sideways.direction = add_scaled(add_scaled(zero, -s, along), c, across);
      link.sideways.stiffness = tension / length;
      link.sideways.gap = dot(between, link.sideways.direction);
    }

    /// Tensions and lengths of the droppers between the parts of a scene without them.
    DropperForm find_form(const Scene &base, std::vector<Link> droppers,
                          const std::vector<Coordinates> &between,
                          const SolverParameters &parameters)
    {
      constexpr int max_iterations = 30;
      for (int iteration = 0;; ++iteration)
      {
        const DropperForm form =
            form_under(base, droppers, between, tensions(base, droppers, parameters), parameters);
        double change = 0.;
        for (std::size_t i = 0; i < droppers.size(); ++i)
        {
          if (droppers[i].form.mass_per_length > 0.)
            change =
                std::max(change, std::fabs(form.length[i] - droppers[i].length) / form.length[i]);
          droppers[i].length = form.length[i];
        }
        if (change < 1e-12)
          return form;
        if (iteration + 1 == max_iterations)
          throw EntryError(
              droppers.front().origin,
              "the dropper lengths do not settle: their weight decides the shape of the wires. "
              "Check the mass per length of the droppers.");
      }
    }

    /// The loads of a scene during form finding.
    Scene while_built(Scene scene)
    {
      scene.loads.erase(std::remove_if(scene.loads.begin(), scene.loads.end(),
                                       [](const Load &load) { return !load.acts_while_built; }),
                        scene.loads.end());
      return without_sliding_contacts(std::move(scene));
    }

    /// All data that determine a form.
    std::string key(const Scene &part, const SolverParameters &parameters)
    {
      return values_of(part) + archived([&](OutputArchive &archive) { archive << parameters; });
    }
  } // namespace

  Scene without_sliding_contacts(Scene scene)
  {
    const std::vector<char> at_wires = masses_at_wires(scene);
    std::vector<Link> links;
    for (Link &link : scene.links)
      if (!link.moving())
        links.push_back(std::move(link));
      else if (link.from.kind == Attachment::Kind::mass && !at_wires[link.from.index])
      {
        Link hold;
        hold.name = link.name;
        hold.origin = link.origin;
        hold.to = link.from;
        hold.direction = link.direction;
        links.push_back(hold);
      }
    scene.links = std::move(links);
    return scene;
  }

  Scene find_lengths(Scene scene, const SolverParameters &parameters, SharedParts *const shared)
  {
    std::vector<Link> droppers;
    std::vector<Attachment> ends;
    for (const Link &link : scene.links)
      if (link.form.find_length)
      {
        droppers.push_back(link);
        ends.insert(ends.end(), {link.from, link.to});
      }
    if (droppers.empty())
      return scene;
    // Only the connected part: other parts do not change a bit of the form.
    ScenePart part = connected_part(while_built(scene), ends);
    for (Link &dropper : droppers)
    {
      dropper.from = part.inside(dropper.from);
      dropper.to = part.inside(dropper.to);
    }
    const std::vector<Coordinates> between = between_ends(part.scene, droppers);
    for (std::size_t k = 0; k < droppers.size(); ++k)
      droppers[k].length = dot(between[k], droppers[k].direction);
    const auto find = [&]
    {
      Scene base = part.scene;
      base.links.erase(std::remove_if(base.links.begin(), base.links.end(),
                                      [](const Link &link) { return link.form.find_length; }),
                       base.links.end());
      return find_form(base, droppers, between, parameters);
    };
    const DropperForm form = shared && part.scene.bodies.empty()
                                 ? shared->forms.find(key(part.scene, parameters), find)
                                 : find();

    std::size_t i = 0;
    for (Link &link : scene.links)
      if (link.form.find_length)
      {
        link.form.find_length = false;
        link.length = form.length[i];
        if (link.form.axial_stiffness > 0.)
          link.stiffness = link.form.axial_stiffness / form.length[i];
        if (link.form.find_direction)
          set_direction(scene, form.tension[i], form.length[i], form.sideways[i], between[i], link);
        // D = -n . (u_to - u_from) + gap + N / stiffness = 0 under the tension
        link.gap =
            form.length[i] - dot(between[i], link.direction) - link.elongation(form.tension[i]);
        link.unstressed_length = form.length[i] - link.elongation(form.tension[i]);
        add_mass(link, scene);
        ++i;
      }
    return scene;
  }
} // namespace taut
