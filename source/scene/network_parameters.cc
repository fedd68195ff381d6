// SPDX-License-Identifier: LGPL-2.1-or-later
#include "scene/network.h"

#include "base/patterns.h"

#include <deal.II/base/parameter_handler.h>

#include <tuple>

namespace taut
{
  namespace
  {
    using namespace dealii::Patterns;

    const List coordinates()
    {
      return List(Double(), 2, 3);
    }
  } // namespace

  void Network::declare_names(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Network");
    wires.declare_names(prm);
    supports.declare_names(prm);
    point_masses.declare_names(prm);
    masses.declare_names(prm);
    springs.declare_names(prm);
    links.declare_names(prm);
    loads.declare_names(prm);
    probes.declare_names(prm);
    prm.leave_subsection();
  }

  void Network::declare_parameters(dealii::ParameterHandler &prm)
  {
    declare_names(prm);
    prm.enter_subsection("Network");
    wires.declare_parameters(prm);
    supports.declare_parameters(prm);
    point_masses.declare_parameters(prm);
    masses.declare_parameters(prm);
    springs.declare_parameters(prm);
    links.declare_parameters(prm);
    loads.declare_parameters(prm);
    probes.declare_parameters(prm);
    prm.leave_subsection();
  }

  void Network::WireItem::declare(dealii::ParameterHandler &prm)
  {
    prm.add_parameter("From", from, "First end 'x, y' or 'x, y, z' [m]", coordinates());
    prm.add_parameter("To", to, "Last end; positions on the wire are counted from the first [m]",
                      coordinates());
    prm.add_parameter("Components", components,
                      "What the wire resists: 'bar' (along it), and 'string' (tension) or 'beam' "
                      "(bending, with or without tension) across it in the plane of x and y; "
                      "'lateral': the string or beam resists motion out of this plane, too",
                      List(Selection("bar|string|beam|lateral"), 0, 3));
    prm.add_parameter("Mass per length", mass_per_length, "[kg/m]", not_negative());
    prm.add_parameter("Axial stiffness", axial_stiffness, "EA, for a bar [N]", not_negative());
    prm.add_parameter("Tension", tension, "T, for a string or beam [N]", not_negative());
    prm.add_parameter("Bending stiffness", bending_stiffness, "EI, for a beam [N m^2]",
                      not_negative());
    for (const auto &[entry, of, share] :
         {std::tuple("Remaining mass", "Mass per length", &remaining_mass),
          {"Remaining axial stiffness", "Axial stiffness", &remaining_axial},
          {"Remaining bending stiffness", "Bending stiffness", &remaining_bending}})
      prm.add_parameter(entry, *share,
                        "Share of " + std::string(of) +
                            " that a worn wire has left: a number, or a formula or table of s [1]",
                        Anything());
    prm.add_parameter("Degree", degree, "Polynomial degree of bar and string elements [1]",
                      Integer(1, 4));
    prm.add_parameter("Mass matrix", mass_matrix,
                      "Integration of the mass of bar and string elements: 'consistent', 'lumped' "
                      "(diagonal), or 'reduced' (with linear elements, half of Theta or Newmark, "
                      "and step = element / wave speed it carries waves exactly)",
                      Selection("consistent|lumped|reduced"));
    prm.add_parameter("Element size", element_size,
                      "Largest length of an element; supports, masses, links and point loads "
                      "closer than 1e-6 of it stand at one place [m]",
                      not_negative());
    prm.add_parameter("Mass damping", mass_damping, "Rayleigh damping, times M [1/s]",
                      not_negative());
    prm.add_parameter("Stiffness damping", stiffness_damping, "Rayleigh damping, times K [s]",
                      not_negative());
    prm.add_parameter("Foundation stiffness", foundation_stiffness,
                      "Of an elastic bedding along the wire, across it [N/m^2]", not_negative());
    prm.add_parameter("Foundation damping", foundation_damping, "Of the bedding [N s/m^2]",
                      not_negative());
    prm.add_parameter(
        "Tension changes", tension_changes,
        "Parts with another tension, 'from, to, change; from, to, change', e.g. where a "
        "stitch wire takes its own [m, m, N]",
        Anything());
    prm.add_parameter("Weight", weight, "Whether gravity acts on the wire");
    prm.add_parameter("Initial axial displacement", axial_displacement,
                      "At t = 0 if 'Start = given', a formula in s [m]");
    prm.add_parameter("Initial axial velocity", axial_velocity, "[m/s]");
    prm.add_parameter("Initial transverse displacement", transverse_displacement,
                      "Positive to the left of the way from the first to the last end [m]");
    prm.add_parameter("Initial transverse velocity", transverse_velocity, "[m/s]");
    prm.add_parameter(
        "Initial lateral displacement", lateral_displacement,
        "Positive along the tangent x the normal, +z for a wire in the plane of x and y [m]");
    prm.add_parameter("Initial lateral velocity", lateral_velocity, "[m/s]");
  }

  void Network::SupportItem::declare(dealii::ParameterHandler &prm)
  {
    prm.add_parameter("Wire", wire, "Name of the wire");
    prm.add_parameter("Positions", positions,
                      "Where on the wire: numbers and ranges first:step:last [m]");
    prm.add_parameter("Motion", motion,
                      "Which motion of the wire is supported: 'transverse', 'axial', 'slope' (of "
                      "the transverse motion), 'lateral' or 'lateral slope'",
                      Selection("transverse|axial|slope|lateral|lateral slope"));
    prm.add_parameter("Type", kind,
                      "'fixed': displacement prescribed; 'elastic': spring and damper",
                      Selection("fixed|elastic"));
    prm.add_parameter("Displacement", displacement,
                      "Of a fixed support, a formula in t; of an elastic one a number: where "
                      "its spring is free of force [m, rad]");
    prm.add_parameter("Stiffness", stiffness, "Of an elastic support [N/m, N m/rad]",
                      not_negative());
    prm.add_parameter("Damping", damping, "Of an elastic support [N s/m, N m s/rad]",
                      not_negative());
  }

  void Network::PointMassItem::declare(dealii::ParameterHandler &prm)
  {
    prm.add_parameter("Wire", wire, "Name of the wire");
    prm.add_parameter("Positions", positions,
                      "Where on the wire: numbers and ranges first:step:last [m]");
    prm.add_parameter("Mass", mass, "Of each [kg]", not_negative());
    prm.add_parameter("Weight", weight, "Whether gravity acts on it");
  }

  void Network::MassItem::declare(dealii::ParameterHandler &prm)
  {
    prm.add_parameter("Position", position, "'x, y' or 'x, y, z' [m]", coordinates());
    prm.add_parameter("Motions", motions,
                      "Free motions: x, y, rotation (about z), z; "
                      "may be empty if a motion is prescribed",
                      List(Selection("x|y|rotation|z"), 0, 4));
    prm.add_parameter("Mass", mass, "[kg]", not_negative());
    prm.add_parameter("Inertia", inertia, "About z [kg m^2]", not_negative());
    prm.add_parameter("Weight", weight, "Whether gravity acts on it");
    prm.add_parameter("Initial displacement", displacement,
                      "x, y, rotation and, if not 0, z at t = 0 if 'Start = given' [m, m, rad, m]",
                      List(Double(), 3, 4));
    prm.add_parameter("Initial velocity", velocity,
                      "x, y, rotation and, if not 0, z [m/s, m/s, rad/s, m/s]",
                      List(Double(), 3, 4));
    for (int k = 0; k < 4; ++k)
      prm.add_parameter(
          std::string("Prescribed ") + motion_names[k], prescribed[k],
          std::string("Displacement of a motion that is not free, a formula in t, and "
                      "in s, the x of the mass at t = 0 and its way since then, with "
                      "Speed; empty: it is free or fixed [") +
              (k == 2 ? "rad]" : "m]"));
    prm.add_parameter("Speed", speed,
                      "Of what bears a mass with prescribed motions, a number, or a formula in t: "
                      "moves the place s in their formulas [m/s]");
  }

  void Network::SpringItem::declare(dealii::ParameterHandler &prm)
  {
    prm.add_parameter("From", from, "A mass or 'ground'");
    prm.add_parameter("To", to, "A mass or 'ground'");
    prm.add_parameter("Direction", direction,
                      "'x, y' or 'x, y, z'; the length does not matter. Empty: 0, 1",
                      List(Double(), 0, 3));
    prm.add_parameter("Rotational", rotational, "Acts between rotations about z instead");
    prm.add_parameter("Stiffness", stiffness, "[N/m, N m/rad]", not_negative());
    prm.add_parameter("Damping", damping, "[N s/m, N m s/rad]", not_negative());
  }

  void Network::LinkItem::declare(dealii::ParameterHandler &prm)
  {
    declare_places(prm);
    declare_force(prm);
    declare_sliding(prm);
    declare_found_length(prm);
  }

  void Network::LinkItem::declare_places(dealii::ParameterHandler &prm)
  {
    prm.add_parameter("Type", type,
                      "'joint': holds its ends together. 'ball joint': does so along x, y and z, "
                      "as joints named '<name> x' and so on; what is at a body in the plane stays "
                      "in that plane. 'hinge': a ball joint of rigid bodies, or of one and the "
                      "ground, that turns about the Axis only. 'universal joint': one that keeps "
                      "the Axis of one body at a right angle to the Second axis of the other. "
                      "'stop': pushes them apart. 'dropper': pulls them together. "
                      "'sliding contact': a stop whose second end moves on a wire or a cable",
                      Selection("joint|ball joint|hinge|universal joint|stop|dropper|sliding "
                                "contact"));
    prm.add_parameter(
        "From", from,
        "'ground', 'ground @ x, y, z', a mass, 'mass @ x, y' beside the centre of one that "
        "rotates, "
        "'wire @ position', 'body @ x, y, z', or on a cable its unstressed arc length, 'cable @ s, "
        "0', or its x at rest, 'cable @ x = 12.5'; several positions (numbers and ranges "
        "first:step:last) make one link each");
    prm.add_parameter(
        "To", to,
        "As From; for a sliding contact 'wire @ start' or 'cable @ start, 0', or the wires "
        "over a strip, 'wire, other wire', each from below From unless a start is "
        "given; it may run beyond their ends");
    prm.add_parameter("Through", through,
                      "Of a rope, a dropper that Turns: rings without friction on its way from "
                      "From to To, as From, in their order, 'ring, block @ x, y, z, ground @ x, "
                      "y'. Its Length, Gap and Stiffness are those of the whole rope",
                      Anything());
    prm.add_parameter("Direction", direction,
                      "'x, y' or 'x, y, z' from From to To; a stop or sliding contact pushes To "
                      "along it. Empty: along the straight line between the ends",
                      List(Double(), 0, 3));
    prm.add_parameter(
        "Turns", turns,
        "The direction is that from end to end at each time, so that ends may move by any amount; "
        "a dropper then is a rope, a stop a prop. A ground end needs a place");
    prm.add_parameter("Length", length,
                      "Unstressed, of a link that turns or of a dropper between wires, masses and "
                      "places of the ground: the distance of its ends at which a rope or dropper "
                      "becomes taut or a prop touches, instead of Gap. Of a link that turns also a "
                      "formula or table of t, as a winch reels it; 0: as Gap says [m]",
                      Anything());
    prm.add_parameter("Rotational", rotational,
                      "Acts between slopes or rotations about Axis: moments and angular gaps");
    prm.add_parameter("Axis", axis,
                      "Of a rotational link, of a hinge, or of the From end of a universal joint, "
                      "before anything moves, 'x, y, z'; the length does not matter. Empty: z",
                      List(Double(), 0, 3));
    prm.add_parameter("Second axis", second_axis,
                      "Of the To end of a universal joint, before anything moves, 'x, y, z', at a "
                      "right angle to the Axis",
                      List(Double(), 0, 3));
  }

  void Network::LinkItem::declare_force(dealii::ParameterHandler &prm)
  {
    prm.add_parameter("Stiffness", stiffness, "A number or 'rigid' [N/m, N m/rad]");
    prm.add_parameter("Law", law,
                      "Force of a stop, dropper or sliding contact over its compression or "
                      "elongation: 'linear' (the Stiffness), 'table' (Law points) or 'formula'",
                      Selection("linear|table|formula"));
    prm.add_parameter("Law points", law_points,
                      "'elongation: force, ...', both increasing from 0:0, which may be left out; "
                      "linear between them, and on beyond the last one [m, rad: N, N m]");
    prm.add_parameter("Law formula", law_formula,
                      "In the elongation d [m, rad], 0 at d = 0 and increasing [N, N m]");
    prm.add_parameter("Law range", law_range,
                      "Up to this d the formula holds; beyond it goes on straight [m, rad]",
                      not_negative());
    prm.add_parameter("Damping", damping, "Beside the stiffness (Kelvin-Voigt) [N s/m, N m s/rad]",
                      not_negative());
    prm.add_parameter("Gap", gap,
                      "Of the undeformed bodies: distance to contact of a stop, slack of a "
                      "dropper; negative: prestressed [m, rad]",
                      Double());
  }

  void Network::LinkItem::declare_sliding(dealii::ParameterHandler &prm)
  {
    prm.add_parameter("Speed", speed,
                      "Of a sliding contact along its wire, the first of several wires, or its "
                      "unstressed cable: a number, or a formula in t [m/s]",
                      Anything());
    prm.add_parameter(
        "Strip", strip,
        "Of a sliding contact: links with the same name here are one collector strip, "
        "or strips of one head, whose forces add; each may run beyond the ends of its "
        "wire, where it does not touch",
        Anything());
    prm.add_parameter(
        "Faster than waves", faster_than_waves,
        "Lets it run at least as fast as the waves of its wire if that has tension, which is "
        "an error otherwise");
    prm.add_parameter("Straight", straight,
                      "Of a sliding contact on a cable: its Speed is that in space, along the line "
                      "from From to To of the cable and across Direction, and it touches what of "
                      "the cable is there, however the cable sags and moves");
    prm.add_parameter("Height profile", profile,
                      "Of the wire under a sliding contact along Direction, a formula in s [m]");
  }

  void Network::LinkItem::declare_found_length(dealii::ParameterHandler &prm)
  {
    prm.add_parameter("Find length", find_length,
                      "A dropper as long as its To end needs to stand at the prescribed "
                      "displacement in the static state without sliding contacts");
    prm.add_parameter("Find direction", find_direction,
                      "Of a dropper between wires with lateral motion, with its length or with a "
                      "given Length: it hangs from end to end in the static state, and Direction "
                      "is that of the heights of its ends");
    prm.add_parameter("Prescribed displacement", prescribed_displacement,
                      "Of the To end towards From, if the length is found [m]", Double());
    prm.add_parameter("Axial stiffness", axial_stiffness,
                      "EA; if not 0, the stiffness of a found dropper is EA / length [N]",
                      not_negative());
    prm.add_parameter("Mass per length", mass_per_length,
                      "Of a found dropper; half of its mass goes to each end [kg/m]",
                      not_negative());
    prm.add_parameter("Pull", pull,
                      "Of a rope between places that are apart across Direction, such as a Z-rope: "
                      "the part of its tension across Direction. Its length is found from it, in "
                      "place of a prescribed displacement; 0: no such rope [N]",
                      not_negative());
  }

  void Network::LoadItem::declare(dealii::ParameterHandler &prm)
  {
    prm.add_parameter("Type", type,
                      "'point': at a mass or a point of a wire. 'distributed': along a wire, at "
                      "least a sixty-fourth of an element wide; a hundredth if each factor of its "
                      "formula has t alone, s alone, or both as one sum a*s + b, where a and b "
                      "may depend on t, as in exp(-((s-20*t)/(30+t))^2)*cos(t); a fifth if it "
                      "moves otherwise. 'moving': travels on a wire from its position with Speed",
                      Selection("point|distributed|moving"));
    prm.add_parameter("On", on,
                      "A mass, 'wire @ position' or 'body @ x, y, z'; of a distributed load the "
                      "position is not used");
    prm.add_parameter("Direction", direction,
                      "'x, y' or 'x, y, z'; the length does not matter. Empty: 0, 1",
                      List(Double(), 0, 3));
    prm.add_parameter("Rotational", rotational, "A moment about Axis instead of a force");
    prm.add_parameter("Axis", axis,
                      "Of a rotational load, 'x, y, z'; the length does not matter. Empty: z",
                      List(Double(), 0, 3));
    prm.add_parameter(
        "Magnitude", magnitude,
        "A formula in t and, on a wire or a cable, in the position s there [N, N/m, N m]");
    prm.add_parameter("Speed", speed, "Of a moving load: a number, or a formula in t [m/s]",
                      Anything());
    prm.add_parameter(
        "Faster than waves", faster_than_waves,
        "Lets it run at least as fast as the waves of its wire if that has tension, which is "
        "an error otherwise");
    prm.add_parameter("Acts while built", acts_while_built,
                      "Whether lengths of droppers are found with this load; wind blows later");
  }
} // namespace taut
