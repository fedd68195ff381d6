// SPDX-License-Identifier: LGPL-2.1-or-later
#include "catenary.h"

#include <taut/base/exceptions.h>
#include <taut/base/patterns.h>
#include <taut/scene/entries.h>
#include <taut/scene/named_items.h>

#include <deal.II/base/parameter_handler.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace taut
{
  using namespace dealii::Patterns;

  void Catenary::declare_names(dealii::ParameterHandler &prm)
  {
    check_item_names(pantographs, "Catenary/Pantographs");
    prm.enter_subsection("Catenary");
    prm.add_parameter("Pantographs", pantographs,
                      "Names, separated by commas; each has a section 'Pantograph <name>'. Empty: "
                      "the line alone",
                      List(Anything()));
    prm.leave_subsection();
  }

  void Catenary::WireItem::declare(dealii::ParameterHandler &prm, const std::string &section)
  {
    prm.enter_subsection(section);
    prm.add_parameter("Model", model, "'beam': tension and bending; 'string': tension only",
                      Selection("beam|string"));
    prm.add_parameter("Mass per length", mass_per_length, "[kg/m]", not_negative());
    prm.add_parameter("Tension", tension, "[N]", not_negative());
    prm.add_parameter("Bending stiffness", bending_stiffness, "EI; not used by a string [N m^2]",
                      not_negative());
    prm.add_parameter("Element size", element_size, "Largest length of an element [m]",
                      not_negative());
    prm.add_parameter("Degree", degree, "Polynomial degree of string elements [1]", Integer(1, 4));
    prm.add_parameter("Mass damping", mass_damping, "Rayleigh damping, times the mass [1/s]",
                      not_negative());
    prm.add_parameter("Stiffness damping", stiffness_damping,
                      "Rayleigh damping, times the stiffness [s]", not_negative());
    prm.add_parameter("Stagger", stagger,
                      "z at the first mast, where the wire is held aside; from mast to mast it "
                      "changes its sign [m]",
                      Double());
    prm.add_parameter("Wind", wind,
                      "Load along z, a formula in t and in s (= x); lengths of droppers are found "
                      "without it [N/m]",
                      Anything());
    prm.leave_subsection();
  }

  void Catenary::PantographItem::declare(dealii::ParameterHandler &prm)
  {
    prm.add_parameter("Masses", masses, "From the head down [kg]", List(not_negative(), 1));
    prm.add_parameter("Stiffnesses", stiffnesses,
                      "Of the spring below each mass, the last to the base [N/m]",
                      List(not_negative(), 1));
    prm.add_parameter("Dampings", dampings, "Of the damper beside each spring [N s/m]",
                      List(not_negative(), 1));
    prm.add_parameter("Static force", static_force,
                      "Upwards on the lowest mass, net of the weight [N]", Double());
    prm.add_parameter("Start", start, "x at t = 0 [m]", Double());
    prm.add_parameter("Speed", speed, "[km/h]", Double());
    prm.add_parameter("Contact stiffness", contact_stiffness,
                      "Between head and contact wire; a number or 'rigid' [N/m]", Anything());
    prm.add_parameter("Contact damping", contact_damping, "Beside the stiffness [N s/m]",
                      not_negative());
    prm.add_parameter("Height profile", profile,
                      "Irregularity of the contact wire, a formula in s (= x) [m]", Anything());
  }

  void Catenary::declare_parameters(dealii::ParameterHandler &prm)
  {
    declare_names(prm);
    prm.enter_subsection("Catenary");
    prm.add_parameter("Number of spans", n_spans, "[1]", Integer(1, 100000));
    prm.add_parameter("Span length", span_length, "[m]", not_negative());
    prm.add_parameter("Encumbrance", encumbrance,
                      "Height of the messenger wire over the contact wire at the supports [m]",
                      not_negative());
    prm.add_parameter("Lateral component", lateral,
                      "Motion along z, also where neither Stagger nor Wind asks for it");
    contact.declare(prm, "Contact wire");
    messenger.declare(prm, "Messenger wire");

    prm.enter_subsection("Supports");
    prm.add_parameter("Messenger stiffness", messenger_support_stiffness,
                      "Of the messenger's supports at the inner masts; a number or 'rigid' [N/m]",
                      Anything());
    prm.add_parameter("Arm mass", arm_mass,
                      "Point mass on the contact wire at each inner mast; its weight is carried by "
                      "the arm [kg]",
                      not_negative());
    prm.add_parameter("Arm stiffness", arm_stiffness, "Vertical [N/m]", not_negative());
    prm.add_parameter("Arm damping", arm_damping, "Vertical [N s/m]", not_negative());
    prm.leave_subsection();

    droppers.declare(prm);

    prm.add_parameter("Uplift positions", uplift_positions,
                      "x where the contact wire's motion is recorded; empty: all inner masts [m]",
                      List(Double(), 0));
    pantograph_items.resize(pantographs.size());
    for (std::size_t i = 0; i < pantographs.size(); ++i)
    {
      enter_item(prm, "Pantograph", pantographs, i);
      pantograph_items[i].declare(prm);
      leave_item(prm);
    }
    prm.leave_subsection();
  }

  Wire Catenary::WireItem::wire(const std::string &name, const double y, const double length) const
  {
    Wire wire;
    wire.name = name;
    wire.origin = name == "contact" ? "Catenary/Contact wire" : "Catenary/Messenger wire";
    wire.a = {0., y};
    wire.b = {length, y};
    wire.mass_per_length = mass_per_length;
    wire.transverse = model == "beam" ? TransverseKind::beam : TransverseKind::string;
    wire.tension = tension;
    wire.bending_stiffness = model == "beam" ? bending_stiffness : 0.;
    wire.degree = degree;
    wire.element_size = element_size;
    wire.damping = {mass_damping, stiffness_damping};
    return wire;
  }

  void Catenary::add_wires(Scene &scene) const
  {
    const double length = n_spans * span_length;
    scene.wires = {messenger.wire("messenger", encumbrance, length),
                   contact.wire("contact", 0., length)};
    std::vector<double> masts;
    for (unsigned int i = 1; i < n_spans; ++i)
      masts.push_back(i * span_length);

    Support ends;
    ends.origin = "Catenary";
    ends.positions = {0., length};
    for (const std::size_t wire : {messenger_wire, contact_wire})
    {
      ends.name = scene.wires[wire].name + " ends";
      ends.wire = wire;
      scene.supports.push_back(ends);
    }
    if (!masts.empty())
    {
      Support mast;
      mast.name = "messenger at masts";
      mast.origin = "Catenary/Supports";
      mast.wire = messenger_wire;
      mast.positions = masts;
      const double stiffness =
          parse_stiffness(messenger_support_stiffness, "Catenary/Supports/Messenger stiffness");
      mast.fixed = std::isinf(stiffness);
      mast.stiffness = mast.fixed ? 0. : stiffness;
      scene.supports.push_back(mast);
      if (arm_mass > 0.)
        scene.point_masses.push_back(
            {"arm", "Catenary/Supports", contact_wire, masts, arm_mass, false});
      if (arm_stiffness > 0. || arm_damping > 0.)
      {
        Support arm;
        arm.name = "arm";
        arm.origin = "Catenary/Supports";
        arm.wire = contact_wire;
        arm.positions = masts;
        arm.fixed = false;
        arm.stiffness = arm_stiffness;
        arm.damping = arm_damping;
        scene.supports.push_back(arm);
      }
    }

    const std::vector<double> &places = uplift_positions.empty() ? masts : uplift_positions;
    const bool whole = std::all_of(places.begin(), places.end(),
                                   [](const double x) { return x == std::floor(x); });
    for (const double x : places)
    {
      Probe probe;
      probe.origin = "Catenary/Uplift positions";
      // All names have the same number of decimals, so that no two names differ by the point alone.
      std::ostringstream name;
      name << std::fixed << std::setprecision(whole ? 0 : 3) << "contact wire at " << x << " m";
      probe.name = name.str();
      probe.point = {Attachment::Kind::wire, contact_wire, x};
      scene.probes.push_back(probe);
    }
  }

  void Catenary::add_pantograph(const std::string &name, const PantographItem &item,
                                Scene &scene) const
  {
    const std::string section = "Catenary/Pantograph " + name;
    const std::size_t n = item.masses.size(), first = scene.masses.size();
    if (item.stiffnesses.size() != n || item.dampings.size() != n)
      throw EntryError(section, "Masses, Stiffnesses and Dampings are lists of one length; got " +
                                    std::to_string(n) + ", " +
                                    std::to_string(item.stiffnesses.size()) + ", " +
                                    std::to_string(item.dampings.size()));
    for (std::size_t i = 0; i < n; ++i)
    {
      Mass mass;
      mass.name = name + (i == 0 ? " head" : " mass " + std::to_string(i + 1));
      mass.origin = section;
      mass.position = {item.start, 0.};
      mass.mass = item.masses[i];
      mass.weight = false;
      scene.masses.push_back(mass);
      if (item.stiffnesses[i] == 0. && item.dampings[i] == 0.)
        continue;
      Spring spring;
      spring.name = name + " spring " + std::to_string(i + 1);
      spring.origin = section;
      spring.from = i + 1 < n ? first + i + 1 : ground;
      spring.to = first + i;
      spring.stiffness = item.stiffnesses[i];
      spring.damping = item.dampings[i];
      scene.springs.push_back(spring);
    }
    Load force;
    force.name = name + " static force";
    force.origin = section;
    force.target = {Attachment::Kind::mass, first + n - 1, 0.};
    force.magnitude = Expression(item.static_force);
    scene.loads.push_back(force);

    Link contact_link;
    contact_link.name = name;
    contact_link.origin = section;
    contact_link.kind = LinkKind::sliding_contact;
    contact_link.from = {Attachment::Kind::mass, first, 0.};
    contact_link.to = {Attachment::Kind::wire, contact_wire, item.start};
    contact_link.stiffness =
        parse_stiffness(item.contact_stiffness, section + "/Contact stiffness");
    contact_link.damping = item.contact_damping;
    contact_link.speed = item.speed / 3.6;
    contact_link.profile =
        Expression(item.profile, section + "/Height profile", Expression::Variables::position);
    scene.links.push_back(contact_link);
  }

  void Catenary::fill(Scene &scene) const
  {
    check_line();
    check_pantographs();
    add_wires(scene);
    if (is_in_space())
      add_lateral(scene);
    droppers.add(messenger_wire, contact_wire, n_spans, span_length, scene);
    for (std::size_t i = 0; i < pantographs.size(); ++i)
      add_pantograph(pantographs[i], pantograph_items[i], scene);
  }

  namespace
  {
    const Register<SceneGenerator, Catenary>
        registration("catenary", "a railway overhead line with droppers and pantographs");
  }
} // namespace taut
