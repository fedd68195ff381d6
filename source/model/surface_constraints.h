// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_surface_constraints_h
#define taut_surface_constraints_h

#include <taut/interface/constraints.h>
#include <taut/model/scene_bodies.h>
#include <taut/scene/contact_surface.h>
#include <taut/solid/contact_constraints.h>

#include <vector>

namespace taut
{
  /// The surfaces of a contact of a scene, and its constraints.
  struct ContactGeometry
  {
    ContactSurface slave;
    ContactSurface master;                  ///< without points against an obstacle
    ContactSurface slave_body, master_body; ///< whole boundaries; without points: as the surfaces
    std::vector<SurfaceConstraint> constraints;
    double size = 0.; ///< largest distance of a node of the slave body from the origin [m]
  };

  /// Geometry and constraints of contact number @p contact of the scene, from the reference
  /// positions; the same on all ranks. Throws EntryError on the section of the contact, with the
  /// message of mortar_constraints() and its like.
  ContactGeometry contact_geometry(const Scene &scene, std::size_t contact);

  /// Constraints that an automatic search distance left out: those of further nodes that face the
  /// master, at any distance. None if the distance is given or the master is an obstacle.
  std::vector<SurfaceConstraint> left_out_constraints(const Scene &scene, std::size_t contact,
                                                      const ContactGeometry &geometry);

  /// Places inside faces of the slave that the other side may enter between nodes.
  std::vector<InnerPoint> contact_inner_points(const Scene &scene, std::size_t contact,
                                               const ContactGeometry &geometry);

  /// The scene with slave and master exchanged for contacts with SurfaceContact::chooses_slave, if
  /// the slave then overhangs the master at fewer nodes. Throws EntryError, as contact_geometry()
  /// does.
  Scene choose_slaves(Scene scene);

  /// The constraints of all contacts of a scene, one contact after the other, with the linear forms
  /// of the bodies of this rank. Throws EntryError, also if a body that moves by large amounts
  /// touches anything but a plane. Called by all ranks together.
  std::vector<ConstraintData> surface_constraints(const Scene &scene, const SceneBodies &bodies);
} // namespace taut

#endif
