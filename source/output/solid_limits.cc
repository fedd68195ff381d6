// SPDX-License-Identifier: LGPL-2.1-or-later
#include "output/solid_limits.h"
#include "base/text.h"
#include <taut/base/exceptions.h>
#include <taut/solid/contact_constraints.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>
#include <sstream>

namespace taut
{
  namespace
  {
    /// Rotation above which there is a warning [rad]: slope^2 / 2 = 0.5 % of stretch is neglected.
    constexpr double small_turn = .1;

    /// Sliding above which there is a warning, in elements: another element is nearer then.
    constexpr double small_sliding = .5;

    /// Part of the elastic energy that may be where strains are not small.
    constexpr double strained_part = .5;

    /// Elastic energy that elements store as they cannot bend, over the rest.
    constexpr double small_locking = .05;

    /// Strains of a body that moves as a whole, over its turn.
    constexpr double rounding_of_turn = 1e-10;

    /// Growth of a stretch or turn after which strains are looked at again.
    constexpr double growth = 1.1;

    /// Depth between nodes above which there is a warning: over the face, at a contact that never
    /// carries, where there should have been a force; over how far the bodies came into each other,
    /// at one that carries: with two elements in half of a contact of Hertz it is 0.06.
    constexpr double no_depth = 1e-4, small_depth = .1;

    /// Part of the weights of a master by which a point is beside its nodes.
    constexpr double at_node = 1e-6;

    constexpr std::size_t most_lines = 2000; ///< of a body
    const Coordinates axes[] = {{1.}, {0., 1.}, {0., 0., 1.}};
  } // namespace

  SolidLimits::SolidLimits(const Scene &scene, const SceneBodies &structure)
  {
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
      if (scene.bodies[i].type && scene.bodies[i].type->largest_turn() > 0.)
        add_body(scene, structure, i);
    for (std::size_t c = 0; c < scene.contacts.size(); ++c)
      add_contact(scene, structure, c);
  }

  namespace
  {
    /// Appends the motion of a node if its body is on this rank.
    void append(const SceneBodies &structure, const std::size_t body, const unsigned int node,
                const Coordinates &direction, std::vector<Term> &terms)
    {
      if (const std::size_t k = structure.index_at_node(body, node); k != Structure::elsewhere)
        terms.push_back({k, structure[k].node_displacement(node, direction)});
    }
  } // namespace

  void SolidLimits::add_body(const Scene &scene, const SceneBodies &structure,
                             const std::size_t body)
  {
    const CustomBody &b = scene.bodies[body];
    const ContactSurface surface = b.type->surface({b.name, b.origin, scene.gravity}, {});
    Turning turning{b.name, b.origin, b.type->largest_turn(), body, forms.size(), {}, {}};
    const std::size_t n = surface.faces.size() * (surface.faces.front().size() - 1),
                      stride = (n + most_lines - 1) / most_lines;
    for (std::size_t f = 0; f < surface.faces.size(); f += std::max<std::size_t>(stride, 1))
      for (std::size_t i = 0; i + 1 < surface.faces[f].size(); ++i)
      {
        const unsigned int from = surface.faces[f][i], to = surface.faces[f][i + 1];
        turning.chords.push_back(surface.points[to] - surface.points[from]);
        turning.places.push_back(add_scaled(surface.points[from], .5, turning.chords.back()));
        for (const Coordinates &axis : axes)
        {
          std::vector<Term> terms;
          append(structure, body, to, axis, terms);
          append(structure, body, from, add_scaled({}, -1., axis), terms);
          forms.add(terms);
        }
      }
    bodies.push_back(std::move(turning));
  }

  /// Sets elements, facets, and nodes between those of the master.
  void SolidLimits::describe(const Scene &scene, Sliding &contact) const
  {
    const ContactGeometry &geometry = contact.geometry;
    const bool has_master_faces =
        geometry.slave.dim > 1 && !geometry.master.points.empty() && geometry.master.dim > 1;
    const std::vector<double> slave = element_lengths(geometry.slave),
                              master = element_lengths(geometry.master);
    contact.facets = FacetLimits(geometry);
    contact.is_mortar = scene.contacts[contact.contact].method == SurfaceMethod::mortar;
    for (const SurfaceConstraint &c : geometry.constraints)
    {
      double element = slave[c.node], largest = 0.;
      for (const NodeWeight &w : c.master)
      {
        element = std::min(element, master[w.node]);
        largest = std::max(largest, norm(w.weight));
      }
      contact.elements.push_back(element);
      contact.between.push_back(has_master_faces && !contact.is_mortar && largest < 1. - at_node);
    }
  }

  void SolidLimits::add_contact(const Scene &scene, const SceneBodies &structure,
                                const std::size_t number)
  {
    const SurfaceContact &given = scene.contacts[number];
    Sliding contact;
    contact.name = given.name;
    contact.origin = given.origin;
    contact.largest = given.largest_sliding;
    contact.contact = number;
    contact.geometry = contact_geometry(scene, number);
    contact.left_out = left_out_constraints(scene, number, contact.geometry);
    // A cable, and its contacts with it, may move far.
    contact.can_slide =
        given.obstacle.shape != ObstacleSetting::Shape::plane && contact.geometry.slave.dim > 1;
    contact.first = forms.size();
    describe(scene, contact);
    // Along the normal the weights are those of displacements in any direction.
    const auto add = [&](const SurfaceConstraint &c, const Coordinates *const axis)
    {
      std::vector<Term> terms;
      const auto direction = [&](const Coordinates &weight)
      { return axis ? add_scaled({}, dot(weight, c.normal), *axis) : weight; };
      for (const NodeWeight &w : c.slave)
        append(structure, given.slave.body, w.node, direction(w.weight), terms);
      for (const NodeWeight &w : c.master)
        append(structure, given.master.body, w.node, direction(w.weight), terms);
      forms.add(terms);
    };
    for (const SurfaceConstraint &c : contact.geometry.constraints)
      for (unsigned int d = 0; d < (contact.can_slide ? 3u : 0u); ++d)
        add(c, &axes[d]);
    contact.first_left_out = forms.size();
    for (const SurfaceConstraint &c : contact.left_out)
      add(c, nullptr);
    contact.inner = contact_inner_points(scene, number, contact.geometry);
    contact.first_gap = std::numeric_limits<double>::infinity();
    for (const SurfaceConstraint &c : contact.geometry.constraints)
      contact.first_gap = std::min(contact.first_gap, c.gap);
    for (const InnerPoint &p : contact.inner)
    {
      contact.first_gap = std::min(contact.first_gap, p.constraint.gap);
      add(p.constraint, nullptr);
    }
    contacts.push_back(std::move(contact));
  }

  void SolidLimits::keep(const Kind kind, const double value, const double limit, const double time,
                         const std::size_t item, const std::size_t place)
  {
    if (value / limit > worst[kind].excess)
      worst[kind] = {value / limit, value, limit, time, item, place};
  }

  void SolidLimits::record(const StepView &step)
  {
    if (bodies.empty() && contacts.empty())
      return;
    values.assign(forms.size(), 0.);
    forms.evaluate(step.reference.displacement, values.data());
    forms.evaluate(step.state.U, values.data());
    step.structure.communicator().sum(values);
    record_turns(step.state.time);
    record_strains(step);
    record_contacts(step);
    const Worst &t = worst[turn], &s = worst[sliding];
    if (t.excess > 1. && t.value > bodies[t.item].largest)
      throw EntryError(bodies[t.item].origin + "/Largest turn", text_of(turn, t));
    if (s.excess > 1. && s.value > contacts[s.item].largest)
      throw EntryError(contacts[s.item].origin + "/Largest sliding", text_of(sliding, s));
  }

  void SolidLimits::record_turns(const double time)
  {
    for (std::size_t b = 0; b < bodies.size(); ++b)
      for (std::size_t i = 0; i < bodies[b].chords.size(); ++i)
      {
        const double *const u = values.data() + bodies[b].first + 3 * i;
        const Coordinates change{u[0], u[1], u[2]}, &chord = bodies[b].chords[i];
        const double square = dot(chord, chord), along = dot(change, chord) / square;
        const double across = norm(add_scaled(change, -along, chord)) / std::sqrt(square);
        // A line that points back has turned by more than a right angle.
        keep(turn, along > -1. ? across : std::atan2(across, 1. + along), small_turn, time, b, i);
        bodies[b].stretch = std::max(bodies[b].stretch, std::fabs(along));
        bodies[b].turn = std::max(bodies[b].turn, across);
      }
  }

  /// Looks at strains where a stretch or turn grew. That of most energy counts: waves of little
  /// energy are shorter than elements.
  void SolidLimits::record_strains(const StepView &step)
  {
    const Communicator &processes = step.structure.communicator();
    for (std::size_t b = 0; b < bodies.size(); ++b)
    {
      Turning &body = bodies[b];
      if (!(body.stretch > growth * body.seen_stretch || body.turn > growth * body.seen_turn))
        continue;
      body.seen_stretch = body.stretch;
      body.seen_turn = body.turn;
      Straining now;
      for (const std::size_t k : step.structure.indices_of_body(body.body))
      {
        const auto *const strained = k == Structure::elsewhere
                                         ? nullptr
                                         : dynamic_cast<const StrainedBody *>(&step.structure[k]);
        if (!strained)
          continue;
        displacement = step.reference.displacement[k];
        for (std::size_t i = 0; i < displacement.size(); ++i)
          displacement[i] += step.state.U[k][i];
        const Straining part = strained->straining(displacement);
        now.energy += part.energy;
        now.large += part.large;
        now.locked += part.locked;
        if (part.strain > now.strain)
        {
          now.strain = part.strain;
          now.place = part.place;
        }
      }
      const double largest = processes.max(now.strain), is_here = now.strain == largest ? 1. : 0.;
      const Coordinates &x = now.place;
      double sums[] = {now.energy,    now.large,     now.locked,   is_here,
                       is_here * x.x, is_here * x.y, is_here * x.z};
      processes.sum(sums, 7);
      if (sums[0] > body.most.energy)
      {
        body.most = {sums[0],
                     sums[1],
                     sums[2],
                     largest,
                     {sums[4] / sums[3], sums[5] / sums[3], sums[6] / sums[3]}};
        body.time = step.state.time;
      }
    }
    worst[strain] = worst[locking] = {};
    for (std::size_t b = 0; b < bodies.size(); ++b)
    {
      const Straining &most = bodies[b].most;
      if (most.large > strained_part * most.energy)
        keep(strain, most.strain, small_strain, bodies[b].time, b, 0);
      if (most.strain > rounding_of_turn * std::max(small_strain, bodies[b].turn))
        keep(locking, most.locked / (most.energy - most.locked), small_locking, bodies[b].time, b,
             0);
    }
  }

  void SolidLimits::record_contacts(const StepView &step)
  {
    const double time = step.state.time;
    worst[facets] = {};
    for (std::size_t k = 0; k < contacts.size(); ++k)
    {
      Sliding &contact = contacts[k];
      const std::vector<SurfaceConstraint> &all = contact.geometry.constraints;
      forces =
          step.constraints.of_contact(step.state.multiplier, contact.contact, std::move(forces));
      contact.facets.record(forces.data());
      const double n = contact.facets.faces(), least = contact.facets.least_faces();
      if (least / n > worst[facets].excess)
        worst[facets] = {least / n, n, least, time, k, 0};
      for (std::size_t i = 0; i < all.size(); ++i)
      {
        if (!(forces[i] > 0.))
          continue;
        contact.carries = true;
        if (contact.can_slide)
        {
          const double *const u = values.data() + contact.first + 3 * i;
          const Coordinates motion{u[0], u[1], u[2]};
          const Coordinates along = add_scaled(motion, -dot(motion, all[i].normal), all[i].normal);
          keep(sliding, norm(along) / contact.elements[i], small_sliding, time, k, i);
        }
        // Even one of these is too many.
        constexpr double none = std::numeric_limits<double>::min();
        if (all[i].uncovered > worst[overhang].value)
          worst[overhang] = {2., all[i].uncovered, 0., time, k, i};
        if (contact.between[i] && worst[nodes_on_faces].excess < none)
          worst[nodes_on_faces] = {2., 1., 0., time, k, i};
      }
      for (std::size_t i = 0; i < contact.left_out.size(); ++i)
        keep(search, -values[contact.first_left_out + i], contact.left_out[i].gap, time, k, i);
      const double *const motion = values.data() + contact.first_left_out + contact.left_out.size();
      for (std::size_t i = 0; i < contact.inner.size(); ++i)
      {
        const double depth = -contact.inner[i].constraint.gap - motion[i],
                     excess = depth / contact.inner[i].face;
        const double limit =
            std::max(contact.entered.limit, small_depth * (-motion[i] - contact.first_gap));
        if (excess > contact.entered.excess)
          contact.entered = {excess, depth, 0., time, k, i};
        contact.entered.limit = limit;
      }
    }
  }

  void SolidLimits::print_left_out(std::ostream &out) const
  {
    for (const Sliding &contact : contacts)
      if (!contact.left_out.empty())
        out << "Contact '" << contact.name
            << "': nodes of the slave that face the master from beyond the automatic search "
               "distance and take no part: "
            << contact.left_out.size() << "; a Search distance takes them in\n";
  }

  std::string SolidLimits::text_of_body(const Kind kind, const Worst &w) const
  {
    const Turning &body = bodies[w.item];
    std::ostringstream out;
    out.precision(4);
    if (kind == turn)
      out << "a line on the boundary of '" << body.name << "' turns by " << w.value << " rad at "
          << '(' << body.places[w.place] << "), t = " << w.time
          << " s: the equations are those of small turns, up to " << w.limit
          << " rad. Check loads and supports; a body that moves far as a whole may be a rigid body";
    else if (kind == strain)
      out << "'" << body.name << "' is strained by " << w.value << " at (" << body.most.place
          << "), t = " << w.time << " s, and by more than " << w.limit << " where "
          << 100. * body.most.large / body.most.energy
          << " % of its elastic energy is: the equations are those of small strains. Check loads "
             "and Young's modulus";
    else
      out << "'" << body.name << "' is too stiff by about " << 100. * w.value
          << " % or more, t = " << w.time
          << " s: elements of degree 1 lock in bending with less than four through the thickness, "
             "triangles and tetrahedra with less than eight, and with Poisson's ratios above 0.45. "
             "Take Degree = 2, or smaller elements";
    return out.str();
  }

  std::string SolidLimits::text_of(const Kind kind, const Worst &w) const
  {
    if (kind == turn || kind == strain || kind == locking)
      return text_of_body(kind, w);
    std::ostringstream out;
    out.precision(4);
    const Sliding &contact = contacts[w.item];
    const SurfaceConstraint &c = kind == search          ? contact.left_out[w.place]
                                 : kind == between_nodes ? contact.inner[w.place].constraint
                                                         : contact.geometry.constraints[w.place];
    const std::string at = to_text(std::setprecision(4), '(', c.point, ')');
    out << "contact '" << contact.name << "' ";
    if (kind == sliding)
      out << "slides by " << w.value << " of its elements, " << w.value * contact.elements[w.place]
          << " m, at " << at << ", t = " << w.time
          << " s: its forces act where the undeformed surfaces meet, up to " << w.limit
          << " of an element. Check loads and supports";
    else if (kind == overhang)
      out << "acts at " << at << ", where the slave overhangs the master by " << 100. * w.value
          << " % of a face: pressures of single nodes there may alternate, resultants do not. "
          << (contact.is_mortar && contact.geometry.slave.dim == 2
                  ? "Exchange Slave and Master, or set Choose slave = true"
                  : "Exchange Slave and Master, or end the boundary of the slave where the master "
                    "ends");
    else if (kind == nodes_on_faces)
      out << "carries at " << at
          << ", between nodes of the master: nodes on faces do not pass a uniform pressure, and "
             "pressures of single nodes are off by some ten per cent, and on curved faces also "
             "resultants are off. "
          << (contact.geometry.slave.dim == 2 ? "Take Method = mortar"
                                              : "Let the meshes match, or average over nodes");
    else if (kind == facets)
      out << contact.facets.text();
    else if (kind == between_nodes)
    {
      const bool has_master = !contact.geometry.master.points.empty();
      out << "does not act at " << at << ", inside a face of the slave of "
          << contact.inner[w.place].face << " m, where the " << (has_master ? "master" : "obstacle")
          << " enters by " << w.value << " m, t = " << w.time
          << " s: forces act at nodes of the slave. Take elements of at most "
          << contact.inner[w.place].needed_face << " m there"
          << (has_master ? ", or exchange Slave and Master" : "");
    }
    else
      out << "does not act at " << at << ", which comes " << w.value << " m nearer to the master, "
          << w.limit << " m away, t = " << w.time
          << " s: it passes through it, beyond the automatic search distance. Give a Search "
             "distance of more than "
          << w.limit << " m";
    return out.str();
  }

  /// The worst case of places that the other side enters between nodes.
  SolidLimits::Worst SolidLimits::worst_between_nodes() const
  {
    Worst result;
    for (const Sliding &contact : contacts)
    {
      Worst one = contact.entered;
      if (!(one.excess > 0.))
        continue;
      const double smallest = no_depth * contact.inner[one.place].face;
      one.limit = contact.carries ? std::max(one.limit, smallest) : smallest;
      one.excess = one.value / one.limit;
      if (one.excess > result.excess)
        result = one;
    }
    return result;
  }

  std::vector<Warning> SolidLimits::warnings() const
  {
    const char *const names[] = {"turn",           "strain", "locking", "sliding",      "overhang",
                                 "nodes_on_faces", "facets", "search",  "between_nodes"};
    const char *const units[] = {"rad", "1", "1", "elements", "1", "1", "faces", "m", "m"};
    std::vector<Warning> result;
    for (int k = 0; k < n_kinds; ++k)
    {
      const Kind kind = static_cast<Kind>(k);
      if (const Worst w = kind == between_nodes ? worst_between_nodes() : worst[kind];
          w.excess > 1.)
        result.push_back({names[kind], text_of(kind, w), w.value, w.limit, units[kind], w.time});
    }
    return result;
  }
} // namespace taut
