// SPDX-License-Identifier: LGPL-2.1-or-later Steady arms of a tension length.
#include "scene/tension_length.h"
#include "scene/written_items.h"

#include <taut/base/exceptions.h>
#include <taut/scene/body_type.h>

#include <cmath>

namespace taut
{
  void TensionLength::add_arms(const std::size_t contact, const std::vector<double> &masts)
  {
    const std::string arm_name = (contact == contacts.front() ? "" : "twin ") + named("arm");
    const LineSupportsItem &own = items.supports;
    const bool is_hinged = own.arm_kind == "hinged";
    if (own.has_rigid_arms())
      for (std::size_t mast = 1; mast + 1 < line.masts.size(); ++mast)
        add_rigid_arm(contact, mast);
    else if (own.arm_mass > 0.)
    {
      // Energy of a uniform bar about its end: (m l^2 / 3) (v / l)^2 / 2.
      scene.point_masses.push_back({arm_name, "Catenary/Supports", contact, masts,
                                    is_hinged ? own.arm_mass / 3. : own.arm_mass, false});
      if (is_hinged)
        for (std::size_t i = 0; i < masts.size(); ++i)
        {
          Load weight;
          weight.name = arm_name + " weight " + std::to_string(i + 1);
          weight.origin = "Catenary/Supports";
          weight.target = {Attachment::Kind::wire, contact, masts[i]};
          weight.magnitude = Expression(.5 * own.arm_mass * scene.gravity.y);
          scene.loads.push_back(weight);
        }
    }
    if (own.arm_stiffness > 0. || own.arm_damping > 0.)
    {
      Support arm;
      arm.name = arm_name;
      arm.origin = "Catenary/Supports";
      arm.wire = contact;
      arm.fixed = false;
      arm.stiffness = own.arm_stiffness;
      arm.damping = own.arm_damping;
      hold(arm, masts, line.heights(masts));
    }
  }

  /// A uniform bar from the clamp on the contact wire to its hinge.
  void TensionLength::add_rigid_arm(const std::size_t contact, const std::size_t mast)
  {
    const LineSupportsItem &own = items.supports;
    const std::string title = "Catenary/Supports",
                      arm_name = (contact == contacts.front() ? "" : "twin ") + named("arm") + " " +
                                 std::to_string(mast);
    const LineMast &at = line.masts[mast], &before = line.masts[mast - 1],
                   &behind = line.masts[mast + 1];
    // It pulls against the wire: to where the wire would go on, from neighbour to neighbour.
    const double pull = (at.contact_z - before.contact_z) / (at.x - before.x) +
                        (at.contact_z - behind.contact_z) / (behind.x - at.x),
                 side = pull != 0. ? pull : at.contact_z;
    const Coordinates clamp = {begin() + at.x, at.height, line.offset + at.contact_z},
                      hinge = {clamp.x, clamp.y + own.arm_rise,
                               clamp.z + std::copysign(own.arm_reach, side)};
    const double length = norm(hinge - clamp), inertia = own.arm_mass * length * length / 12.;
    if (!(own.arm_mass > 0. && own.arm_reach > 0.))
      throw EntryError(title + (own.arm_mass > 0. ? "/Arm reach" : "/Arm mass"),
                       "an arm that is a rigid body needs a positive one");
    const Coordinates centre = add_scaled(clamp, .5, hinge - clamp);
    const std::size_t body = scene.bodies.size();
    scene.bodies.push_back(make_body(
        arm_name, title, "rigid body",
        {{"Mass", written_number(own.arm_mass)},
         {"Centre", written_coordinates(centre)},
         // It turns about x alone, so that the moment about its own axis has no effect.
         {"Moments of inertia", written_numbers({inertia, inertia, inertia})},
         {"First axis", "1, 0, 0"},
         {"Second axis", written_coordinates(hinge - clamp)},
         {"Outline", written_numbers({clamp.x, clamp.y, clamp.z, hinge.x, hinge.y, hinge.z})}}));
    const auto join = [&](const std::string &what, const Attachment &from, const Coordinates &place,
                          const Coordinates &direction, const double gap)
    {
      Link joint;
      joint.name = arm_name + " " + what;
      joint.origin = title;
      joint.from = from;
      joint.to = {Attachment::Kind::body, body, 0., place};
      joint.direction = direction;
      joint.gap = gap;
      scene.links.push_back(joint);
    };
    const Coordinates x = {1., 0., 0.}, y = {0., 1., 0.}, z = {0., 0., 1.},
                      on_axis = add_scaled(hinge, 1., x);
    join("hinge x", {}, hinge, x, 0.);
    join("hinge y", {}, hinge, y, 0.);
    join("hinge z", {}, hinge, z, 0.);
    join("axis y", {}, on_axis, y, 0.);
    join("axis z", {}, on_axis, z, 0.);
    const Attachment on_wire = {Attachment::Kind::wire, contact, at.x};
    join("clamp y", on_wire, clamp, y, at.height);
    join("clamp z", on_wire, clamp, z, at.contact_z);
  }
} // namespace taut
