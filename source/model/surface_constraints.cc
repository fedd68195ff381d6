// SPDX-License-Identifier: LGPL-2.1-or-later
#include "model/surface_constraints.h"
#include "base/about_entry.h"
#include <taut/solid/contact_constraints.h>
#include <taut/solid/rigid_obstacle.h>
#include <taut/substructure/body_traits.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

namespace taut
{
  namespace
  {
    ContactSurface surface_of(const Scene &scene, const SurfaceContact::Side &side)
    {
      const CustomBody &body = scene.bodies[side.body];
      ContactSurface surface =
          body.type->surface({body.name, body.origin, scene.gravity}, side.boundaries);
      surface.name = body.name;
      return surface;
    }

    std::unique_ptr<RigidObstacle> make_obstacle(const ObstacleSetting &o, const unsigned int dim)
    {
      const ObstacleSide side = o.encloses_body ? ObstacleSide::inside : ObstacleSide::outside;
      switch (o.shape)
      {
      case ObstacleSetting::Shape::plane:
        return std::make_unique<PlaneObstacle>(o.point, o.direction);
      case ObstacleSetting::Shape::cylinder:
        return std::make_unique<CylinderObstacle>(o.point, o.direction, o.radius, side);
      case ObstacleSetting::Shape::sphere:
        return std::make_unique<SphereObstacle>(o.point, o.radius, side);
      default:
        return std::make_unique<HeightObstacle>(
            dim, o.direction,
            [height = o.height](const Coordinates &foot) { return height(foot, 0.); },
            o.height_change);
      }
    }

    /// Takes a line beside a surface in the plane as a line in this plane. Throws EntryError for
    /// other pairs.
    void lay_into_plane(const SurfaceContact &contact, ContactSurface &slave,
                        ContactSurface &master)
    {
      ContactSurface &line = slave.dim == 1 ? slave : master;
      const ContactSurface &other = slave.dim == 1 ? master : slave;
      const std::string entry = contact.origin + "/Master";
      if (other.dim != 2)
        throw EntryError(entry, "a cable touches obstacles, and bodies in the plane that it lies "
                                "in; '" +
                                    other.name +
                                    "' is none. Set Obstacle, or couple them by links");
      for (const Coordinates &x : line.points)
        if (x.z != 0.)
          throw EntryError(entry, "the cable '" + line.name + "' leaves the plane z = 0 of '" +
                                      other.name + "'; keep its ends, weight and wind in it");
      line.dim = 2;
    }

    WholeBoundaries whole_boundaries(const ContactGeometry &geometry)
    {
      return {geometry.slave_body.points.empty() ? nullptr : &geometry.slave_body,
              geometry.master_body.points.empty() ? nullptr : &geometry.master_body};
    }

    std::vector<SurfaceConstraint> constraints_of(const SurfaceContact &contact,
                                                  const ContactGeometry &geometry)
    {
      ContactSurface slave = geometry.slave, master = geometry.master;
      const WholeBoundaries bodies = whole_boundaries(geometry);
      const double reach = contact.search_distance;
      if (contact.obstacle.shape != ObstacleSetting::Shape::none)
      {
        const auto obstacle = make_obstacle(contact.obstacle, slave.dim == 2 ? 2 : 3);
        return obstacle_constraints(slave, *obstacle, slave.thickness,
                                    reach > 0. ? reach : std::numeric_limits<double>::infinity());
      }
      if (slave.dim == 1 || master.dim == 1)
        lay_into_plane(contact, slave, master);
      if (master.dim != slave.dim)
        throw UserError("one side is in the plane and the other in space");
      const double distance = reach > 0. ? reach : automatic_search_distance;
      if (slave.dim == 3 && contact.method == SurfaceMethod::mortar)
        throw EntryError(contact.origin + "/Method",
                         "mortar is for the plane; set Method = nodes to faces in space");
      if (slave.dim == 3)
        return node_to_face_constraints(slave, master, distance, bodies);
      if (contact.method == SurfaceMethod::mortar)
        return mortar_constraints(slave, master, slave.thickness, distance, bodies);
      return node_to_segment_constraints(slave, master, slave.thickness, distance, bodies);
    }

    /// Largest sine of the angle between two normals of one plane: the error of a gap over the
    /// sliding of a body along the plane.
    constexpr double same_normal = 1e-6;

    /// True if a body is on this rank and moves by large amounts. A body with small motions about
    /// its reference position from the start on does not.
    bool moves_far(const Scene &scene, const SceneBodies &bodies, const std::size_t body)
    {
      for (const std::size_t k : bodies.indices_of_body(body))
      {
        if (k == Structure::elsewhere || bodies[k].is_linear())
          continue;
        const auto *const slender = dynamic_cast<const SlenderBody *>(&bodies[k]);
        if (!(slender && slender->is_to_be_linearised() && scene.start == Start::undeformed))
          return true;
      }
      return false;
    }

    bool are_parallel(const std::vector<SurfaceConstraint> &rows)
    {
      return std::all_of(rows.begin(), rows.end(),
                         [&](const SurfaceConstraint &row)
                         { return norm(row.normal - rows.front().normal) <= same_normal; });
    }

    /// Constraints keep normals and distances of the reference position, which hold for large
    /// motions on planes only. Throws EntryError for a body that moves by large amounts on another
    /// surface.
    void check_large_motions(const Scene &scene, const SceneBodies &bodies,
                             const SurfaceContact &contact,
                             const std::vector<SurfaceConstraint> &rows)
    {
      const bool has_obstacle = contact.obstacle.shape != ObstacleSetting::Shape::none;
      const bool is_far = moves_far(scene, bodies, contact.slave.body) ||
                          (!has_obstacle && moves_far(scene, bodies, contact.master.body));
      const bool is_plane = contact.obstacle.shape == ObstacleSetting::Shape::plane ||
                            (!has_obstacle && are_parallel(rows));
      if (is_plane || !bodies.communicator().any(is_far))
        return;
      const std::string kept = "a contact keeps the normals and distances of the shape at rest: a "
                               "body that moves by large amounts would touch tangent planes "
                               "instead of ",
                        small = ", or small motions of the cable: Geometry = linear, or linearised "
                                "with Start = undeformed";
      if (has_obstacle)
        throw EntryError(contact.origin + "/Obstacle",
                         kept + "this obstacle. Take a plane" + small);
      throw EntryError(contact.origin + "/Slave",
                       kept +
                           "this surface, whose normals differ. Take a plane side of a solid "
                           "as Slave" +
                           small);
    }

    /// A distance beyond the automatic search is a mean along a face: it may be less than the
    /// search distance by this factor.
    constexpr double part_of_search = .5;

    /// Diagonal of the box around all faces of surfaces [m].
    double diagonal(const std::vector<const ContactSurface *> &surfaces)
    {
      constexpr double infinity = std::numeric_limits<double>::infinity();
      Coordinates lower{infinity, infinity, infinity}, upper{-infinity, -infinity, -infinity};
      for (const ContactSurface *const surface : surfaces)
        for (const std::vector<unsigned int> &face : surface->faces)
          for (const unsigned int node : face)
          {
            const Coordinates &x = surface->points[node];
            lower = {std::min(lower.x, x.x), std::min(lower.y, x.y), std::min(lower.z, x.z)};
            upper = {std::max(upper.x, x.x), std::max(upper.y, x.y), std::max(upper.z, x.z)};
          }
      return norm(upper - lower);
    }

    /// Gives the areas of hanging nodes to the nodes that they depend on, in the proportion of
    /// their forces.
    void condense(const ContactSurface &slave, std::vector<SurfaceConstraint> &constraints)
    {
      std::map<unsigned int, std::size_t> of_node;
      for (std::size_t i = 0; i < constraints.size(); ++i)
        of_node[constraints[i].node] = i;
      std::vector<char> is_hanging(constraints.size(), 0);
      for (const ContactSurface::HangingNode &hanging : slave.hanging)
      {
        const auto own = of_node.find(hanging.node);
        if (own == of_node.end())
          continue;
        is_hanging[own->second] = 1;
        for (const auto &[parent, weight] : hanging.parents)
          if (const auto found = of_node.find(parent); found != of_node.end())
            constraints[found->second].area += weight * constraints[own->second].area;
      }
      std::size_t n = 0;
      for (std::size_t i = 0; i < constraints.size(); ++i)
        if (!is_hanging[i])
        {
          if (n != i)
            constraints[n] = std::move(constraints[i]);
          ++n;
        }
      constraints.resize(n);
    }

    /// The linear form of weights of the nodes of a body, restricted to its parts on this rank.
    void append(const SceneBodies &bodies, const std::size_t body,
                const std::vector<NodeWeight> &weights, std::vector<Term> &terms)
    {
      std::map<std::size_t, LinearForm> of_part;
      for (const NodeWeight &w : weights)
      {
        const std::size_t k = bodies.index_at_node(body, w.node);
        if (k == Structure::elsewhere)
          continue;
        const LinearForm form = bodies[k].node_displacement(w.node, w.weight);
        for (std::size_t e = 0; e < form.index.size(); ++e)
          of_part[k].add(form.index[e], form.value[e]);
      }
      for (auto &[k, form] : of_part)
        terms.push_back({k, std::move(form)});
    }
  } // namespace

  ContactGeometry contact_geometry(const Scene &scene, const std::size_t number)
  {
    const SurfaceContact &contact = scene.contacts[number];
    return about_entry(contact.origin,
                       [&]
                       {
                         ContactGeometry geometry;
                         geometry.slave = surface_of(scene, contact.slave);
                         if (contact.obstacle.shape == ObstacleSetting::Shape::none)
                         {
                           geometry.master = surface_of(scene, contact.master);
                           if (!contact.slave.boundaries.empty())
                             geometry.slave_body = surface_of(scene, {contact.slave.body, {}});
                           if (!contact.master.boundaries.empty())
                             geometry.master_body = surface_of(scene, {contact.master.body, {}});
                         }
                         geometry.constraints = constraints_of(contact, geometry);
                         condense(geometry.slave, geometry.constraints);
                         for (const Coordinates &x : geometry.slave.points)
                           geometry.size = std::max(geometry.size, norm(x));
                         for (SurfaceConstraint &constraint : geometry.constraints)
                           constraint.gap += contact.gap;
                         return geometry;
                       });
  }

  std::vector<SurfaceConstraint> left_out_constraints(const Scene &scene, const std::size_t number,
                                                      const ContactGeometry &geometry)
  {
    SurfaceContact contact = scene.contacts[number];
    if (contact.search_distance > 0. || geometry.master.points.empty() || geometry.slave.dim == 1 ||
        geometry.master.dim == 1)
      return {};
    // From one end of both surfaces to the other.
    const double reach = diagonal({&geometry.slave, &geometry.master}),
                 searched = std::min(diagonal({&geometry.slave}), diagonal({&geometry.master}));
    contact.search_distance = reach;
    std::vector<char> is_known(geometry.slave.points.size(), 0);
    for (const SurfaceConstraint &constraint : geometry.constraints)
      is_known[constraint.node] = 1;
    for (const ContactSurface::HangingNode &hanging : geometry.slave.hanging)
      is_known[hanging.node] = 1;
    std::vector<SurfaceConstraint> result;
    for (SurfaceConstraint &far : constraints_of(contact, geometry))
      if (!is_known[far.node] && far.gap > part_of_search * searched)
      {
        far.gap += contact.gap;
        result.push_back(std::move(far));
      }
    return result;
  }

  std::vector<InnerPoint> contact_inner_points(const Scene &scene, const std::size_t number,
                                               const ContactGeometry &geometry)
  {
    const SurfaceContact &contact = scene.contacts[number];
    const double reach = contact.search_distance;
    ContactSurface slave = geometry.slave, master = geometry.master;
    std::vector<InnerPoint> result;
    if (contact.obstacle.shape != ObstacleSetting::Shape::none)
      result =
          obstacle_inner_points(slave, *make_obstacle(contact.obstacle, slave.dim == 2 ? 2 : 3),
                                reach > 0. ? reach : std::numeric_limits<double>::infinity());
    else
    {
      if (slave.dim == 1 || master.dim == 1)
        lay_into_plane(contact, slave, master);
      result = inner_points(slave, master, reach > 0. ? reach : automatic_search_distance,
                            whole_boundaries(geometry));
    }
    for (InnerPoint &p : result)
      p.constraint.gap += contact.gap;
    return result;
  }

  Scene choose_slaves(Scene scene)
  {
    const auto n_overhanging = [](const ContactGeometry &geometry)
    {
      return std::count_if(geometry.constraints.begin(), geometry.constraints.end(),
                           [](const SurfaceConstraint &c) { return c.uncovered > 0.; });
    };
    for (std::size_t c = 0; c < scene.contacts.size(); ++c)
    {
      SurfaceContact &contact = scene.contacts[c];
      if (!contact.chooses_slave)
        continue;
      const auto n = n_overhanging(contact_geometry(scene, c));
      std::swap(contact.slave, contact.master);
      if (n_overhanging(contact_geometry(scene, c)) >= n)
        std::swap(contact.slave, contact.master);
    }
    return scene;
  }

  std::vector<ConstraintData> surface_constraints(const Scene &scene, const SceneBodies &bodies)
  {
    std::vector<ConstraintData> result;
    for (std::size_t c = 0; c < scene.contacts.size(); ++c)
    {
      const SurfaceContact &contact = scene.contacts[c];
      const ContactGeometry geometry = contact_geometry(scene, c);
      check_large_motions(scene, bodies, contact, geometry.constraints);
      for (const SurfaceConstraint &constraint : geometry.constraints)
      {
        ConstraintData data{contact.name + " node " + std::to_string(constraint.node),
                            contact.origin};
        data.contact = c;
        data.cone = Cone::half_line();
        data.gap = constraint.gap;
        data.gap_size = geometry.size + std::fabs(contact.gap);
        if (contact.compliance > 0.)
          data.spring.stiffness = constraint.area / contact.compliance;
        append(bodies, contact.slave.body, constraint.slave, data.terms);
        if (contact.obstacle.shape == ObstacleSetting::Shape::none)
          append(bodies, contact.master.body, constraint.master, data.terms);
        result.push_back(std::move(data));
      }
    }
    return result;
  }
} // namespace taut
