// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_scene_h
#define taut_scene_h

#include <taut/base/coordinates.h>
#include <taut/base/force_law.h>
#include <taut/base/start.h>
#include <taut/scene/body_type.h>
#include <taut/scene/contact_surface.h>
#include <taut/scene/expression.h>

#include <cstddef>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace taut
{
  class Travel;

  /// A scalar motion of a point of a wire: along the wire, along its normal, the slope of this
  /// displacement, along its binormal, and the slope of that displacement.
  enum class WireMotion
  {
    axial,
    transverse,
    slope,
    lateral,
    lateral_slope
  };

  /// The components of a wire, each named by its displacement.
  constexpr WireMotion wire_components[] = {WireMotion::axial, WireMotion::transverse,
                                            WireMotion::lateral};

  constexpr bool is_slope(const WireMotion motion)
  {
    return motion == WireMotion::slope || motion == WireMotion::lateral_slope;
  }

  /// The component that a motion belongs to.
  constexpr WireMotion component_of(const WireMotion motion)
  {
    return motion == WireMotion::slope           ? WireMotion::transverse
           : motion == WireMotion::lateral_slope ? WireMotion::lateral
                                                 : motion;
  }

  /// Name of the component of a motion, for messages.
  const char *component_name(WireMotion motion);

  /// How a wire resists transverse motion. A string has tension only (C0 elements); a beam has
  /// bending stiffness (Hermite elements).
  enum class TransverseKind
  {
    none,
    string,
    beam
  };

  /// How the mass of a bar or string element is integrated. With step = element / wave speed and
  /// Moreau-Jean or Newmark at 1/2, reduced linear elements carry waves exactly. Lumped elements
  /// have a diagonal matrix and short waves that are too slow; consistent elements have short waves
  /// that are too fast.
  enum class MassMatrix
  {
    consistent, ///< exactly
    lumped,     ///< at the nodes of the element, Gauss-Lobatto
    reduced     ///< by one Gauss point less than the element has nodes
  };

  /// Rayleigh damping of a wire, without its supports and point masses: C = mass * M + stiffness *
  /// K.
  struct RayleighDamping
  {
    double mass = 0.;      ///< [1/s]
    double stiffness = 0.; ///< [s]
  };

  /// Motion at t = 0, expressions in s.
  struct InitialMotion
  {
    Expression displacement; ///< [m]
    Expression velocity;     ///< [m/s]
  };

  /// A part of a wire with another tension: a stitch wire takes its own from the messenger wire
  /// between its clamps.
  struct TensionChange
  {
    double from, to; ///< s of the ends of the part [m]
    double change;   ///< to add to the tension [N]
  };

  /// A straight wire from a to b that moves by small amounts; take a cable for large motions. Each
  /// component of a wire is an independent scalar problem.
  struct Wire
  {
    std::string name;
    std::string origin; ///< path of its section in the parameter file, for messages; may be empty
    Coordinates a, b;
    double mass_per_length = 0.; ///< [kg/m]
    bool has_axial = false;      ///< an elastic bar along the wire
    double axial_stiffness = 0.; ///< EA [N]
    TransverseKind transverse = TransverseKind::none;
    bool has_lateral = false;      ///< resists lateral motion like transverse motion
    double tension = 0.;           ///< T [N]
    double bending_stiffness = 0.; ///< EI [N m^2]

    /// What a worn wire has left of these values at s; zero: all of it [1].
    struct Remaining
    {
      Expression mass, axial_stiffness, bending_stiffness;

      /// At s [m].
      static double share(const Expression &of, const double s)
      {
        return of.is_zero() ? 1. : of(s, 0.);
      }
    };
    Remaining remaining;

    unsigned int degree = 2; ///< of bar and string elements
    MassMatrix mass_matrix = MassMatrix::consistent;
    double element_size = 1.; ///< largest element [m]
    RayleighDamping damping;
    std::vector<TensionChange> tension_changes;
    double foundation_stiffness = 0.; ///< of an elastic bedding across the wire, per length [N/m^2]
    double foundation_damping = 0.;   ///< of the bedding, per length [N s/m^2]
    bool weight = true;               ///< gravity acts
    InitialMotion axial_start, transverse_start, lateral_start;

    double length() const;
    Coordinates tangent() const; ///< unit vector from a to b

    /// Unit vector across the wire in the plane of x and y: the part of the tangent in this plane,
    /// turned by +90 degrees; y for a wire along z.
    Coordinates normal() const;
    Coordinates binormal() const; ///< tangent x normal: +z for a wire in the plane

    /// Unit vector of the component of a motion.
    Coordinates axis(WireMotion motion) const;

    /// Rotation axis of the slope of a component: tangent x axis; 0 for the axial component.
    Coordinates rotation_axis(WireMotion motion) const;
    bool has(WireMotion motion) const;
    unsigned int n_dofs_per_node() const; ///< of all components
    Coordinates at(double s) const;
  };

  /// A support of one motion of one wire at given positions: fixed, moved (Dirichlet condition) or
  /// elastic.
  struct Support
  {
    std::string name;
    std::string origin; ///< path of its section in the parameter file, for messages; may be empty
    std::size_t wire = 0;
    std::vector<double> positions; ///< s [m]
    WireMotion motion = WireMotion::transverse;
    bool fixed = true;     ///< displacement prescribed; otherwise spring and damper to the ground
    Expression prescribed; ///< u(t), if fixed; else u where the spring is free of force [m, rad]
    double stiffness = 0.; ///< [N/m, N m/rad], if not fixed
    double damping = 0.;   ///< [N s/m, N m s/rad], if not fixed
  };

  /// Masses on a wire.
  struct PointMass
  {
    std::string name;
    std::string origin; ///< path of its section in the parameter file, for messages; may be empty
    std::size_t wire = 0;
    std::vector<double> positions; ///< s [m]
    double mass = 0.;              ///< [kg]
    bool weight = true;            ///< false: inertia only, without weight
  };

  /// A lumped body: up to four scalar motions, in the order x, y, rotation, z.
  struct Mass
  {
    std::string name;
    std::string origin; ///< path of its section in the parameter file, for messages; may be empty
    Coordinates position;
    double mass = 0.;    ///< [kg]; 0: a massless node
    double inertia = 0.; ///< about z [kg m^2]
    bool moves[4] = {false, true, false, false};
    bool weight = true;
    double displacement[4] = {0., 0., 0., 0.}; ///< at t = 0 [m, m, rad, m]
    double velocity[4] = {0., 0., 0., 0.};     ///< at t = 0 [m/s, m/s, rad/s, m/s]

    /// Motions that are not free but u(s, t), such as those of the base of a pantograph [m, m, rad,
    /// m]. s is the x of the mass at t = 0 and its way along the line since then [m].
    bool is_prescribed[4] = {false, false, false, false};
    Expression prescribed[4];
    double speed = 0.;                         ///< along the line [m/s]
    std::shared_ptr<const Travel> travel = {}; ///< way in time; null: the constant speed
  };

  /// Index of the ground in a spring.
  constexpr std::size_t ground = std::numeric_limits<std::size_t>::max();

  /// A spring and damper between two masses, or between a mass and the ground. Connected masses
  /// form one mechanism.
  struct Spring
  {
    std::string name;
    std::string origin; ///< path of its section in the parameter file, for messages; may be empty
    std::size_t from = ground, to = ground; ///< masses
    bool rotational = false;
    Coordinates direction = {0., 1.}; ///< unit vector; z, if rotational
    double stiffness = 0.;            ///< [N/m, N m/rad]
    double damping = 0.;              ///< [N s/m, N m s/rad]
  };

  /// The point where a link or a load acts.
  struct Attachment
  {
    enum class Kind
    {
      ground,
      wire,
      mass,
      body
    };
    Kind kind = Kind::ground;
    std::size_t index = 0;  ///< of the wire, mass or body
    double position = 0.;   ///< s on the wire [m], at t = 0 if it moves
    Coordinates place = {}; ///< on a body, in its undeformed coordinates; of the ground; on a mass
                            ///< that rotates, from its centre [m]
    bool has_place = false; ///< whether the ground has a place
  };

  enum class LinkKind
  {
    joint,          ///< gap = 0
    stop,           ///< gap >= 0, pushes its ends apart
    dropper,        ///< slack >= 0, pulls its ends together
    sliding_contact ///< a stop whose `to` end moves along a wire
  };

  /// Mass redistribution: where the mass of a DoF at a rigid unilateral link goes. The neighbours
  /// of the DoF take it, so that the total mass is kept, or also the centre of mass and the moment
  /// of inertia.
  enum class ContactMass
  {
    stays,
    keeps_total,
    keeps_inertia
  };

  /// What form finding determines of a dropper in the static state, and from what.
  struct FormFinding
  {
    /// The length follows from the prescribed height of the `to` end.
    bool find_length = false;
    double prescribed_displacement = 0.; ///< of the `to` end, along -n [m]
    double axial_stiffness = 0.;         ///< EA [N]; if not 0, stiffness = EA / length
    double mass_per_length = 0.;         ///< [kg/m]; half of the mass goes to each end

    /// Of a rope whose ends are apart across `direction`, such as a Z-rope: the part of its tension
    /// across `direction` [N]. The length follows from it, not from a height; 0: from the height.
    double pull = 0.;

    /// The direction from end to end, too, for a dropper between wires without axial motion;
    /// `direction` of the link is the direction in which the height is prescribed.
    bool find_direction = false;
  };

  /// Pulls the ends of a dropper back into line: along the unit vector across the dropper and its
  /// wires, with the static tension over the length.
  struct SidewaysSpring
  {
    Coordinates direction = {};
    double stiffness = 0.; ///< [N/m]; 0: there is none
    double gap = 0.;       ///< direction . (to - from) of the undeformed ends [m]
  };

  /**
   * A link, that is a constraint between two attachments. With the unit direction n and the
   * displacements u, the gap is
   *
   *     D =  n . (u_to - u_from) + gap          joint, stop, sliding contact: N > 0 pushes `to`
   * along +n D = -n . (u_to - u_from) + gap          dropper: N > 0 is tension, n from `from` to
   * `to`
   *
   * plus N over the stiffness of the link, with the Lagrange multiplier N. A rotational link has
   * rotations about n instead of n . u. With `turns`, n is the direction from end to end at each
   * time, and D is
   *
   *     D = |Delta| - length    or of a dropper    D = length - |Delta|
   *
   * with the vector Delta from the `from` end to the `to` end.
   */
  struct Link
  {
    std::string name;
    std::string origin; ///< path of its section in the parameter file, for messages; may be empty
    LinkKind kind = LinkKind::joint;
    Attachment from, to;

    /// Of a rope, a dropper that turns: the rings without friction that it runs through from `from`
    /// to `to`, in their order.
    std::vector<Attachment> through = {};
    bool rotational = false;
    Coordinates direction = {0., 1.};
    double stiffness = std::numeric_limits<double>::infinity(); ///< [N/m, N m/rad]; infinite: rigid

    /// Law of the force over the elongation of a dropper, or the compression of a stop; may be
    /// null. With a law `stiffness` is the largest stiffness of the law.
    std::shared_ptr<const ForceLaw> law = {};
    double damping = 0.; ///< [N s/m, N m s/rad]
    double gap = 0.;     ///< D at U = 0, N = 0 [m, rad]

    /// The direction is that from end to end at each time; `direction` has no effect.
    bool turns = false;
    double unstressed_length = 0.; ///< once known [m]; for a link that turns 0: from `gap`

    /// Unstressed length of a link that turns over time, as a winch reels it; what it has at t = 0
    /// is `unstressed_length`. Zero: it is constant [m].
    Expression length_in_time;

    double speed = 0.; ///< of the `to` end along its wire [m/s]

    /// Way of the `to` end in time; null: the constant speed.
    std::shared_ptr<const Travel> travel = {};
    bool faster_than_waves = false; ///< may outrun the waves of its wire, else an error

    /// Of a sliding contact: the name of its strip, if that may touch several wires, each by a link
    /// of its own. Such a link may run beyond the ends of its wire, where it does not touch. Empty:
    /// it has to remain on its wire.
    std::string strip = {};

    /// The speed of a contact on a cable is that in space, along the line between the given ends of
    /// the cable and across `direction`, not that along the unstressed length.
    bool straight = false;
    Expression
        profile; ///< height r(s) of the wire under a sliding contact [m]: adds to the gap along n

    /// Angle phi(s) by which the strip of a sliding contact is turned about its wire with tangent
    /// x: it meets the wire along n = cos(phi) direction + sin(phi) x cross direction, at the axis
    /// through z = 0 at the height of the first wire [rad]. Zero for contacts on cables.
    Expression cant;

    FormFinding form;
    double length = 0.;      ///< geometric length in the static state, once known [m]
    SidewaysSpring sideways; ///< of a dropper whose direction was found

    /// Mass redistribution at the DoFs of wires that a fixed rigid unilateral link acts on.
    ContactMass contact_mass = ContactMass::stays;

    bool unilateral() const { return kind != LinkKind::joint; }
    bool moving() const { return kind == LinkKind::sliding_contact; }

    /// Calls @p visit with each place of a link: its ends and the rings between them, in order.
    template <typename AnyLink, typename Visit>
    static void visit_places(AnyLink &link, const Visit &visit)
    {
      visit(link.from);
      for (auto &ring : link.through)
        visit(ring);
      visit(link.to);
    }

    /// Whether @p is_wanted of one of its places.
    template <typename IsWanted>
    bool any_place(const IsWanted &is_wanted) const
    {
      bool is_found = false;
      visit_places(*this, [&](const Attachment &at) { is_found = is_found || is_wanted(at); });
      return is_found;
    }

    /// Elongation of the spring under a force [m, rad].
    double elongation(const double N) const { return law ? law->elongation(N) : N / stiffness; }
    bool rigid() const { return stiffness == std::numeric_limits<double>::infinity(); }
  };

  /// A force along `direction`, or with `rotational` a moment about it.
  struct Load
  {
    enum class Kind
    {
      point,
      distributed,
      moving
    };
    std::string name;
    std::string origin; ///< path of its section in the parameter file, for messages; may be empty
    Kind kind = Kind::point;
    Attachment target;
    bool rotational = false;
    Coordinates direction = {0., 1.};
    Expression magnitude; ///< [N, N m; N/m if distributed]
    double speed = 0.;    ///< of a moving force [m/s]

    /// Way of a moving force in time; null: the constant speed.
    std::shared_ptr<const Travel> travel = {};
    bool faster_than_waves = false; ///< may outrun the waves of its wire, else an error

    /// False: form finding of droppers leaves the load out.
    bool acts_while_built = true;
  };

  /// A point whose displacement along `direction` is recorded, or with `rotational` its rotation
  /// about this direction. The largest uplift is reported.
  struct Probe
  {
    enum class Quantity
    {
      displacement,
      velocity,    ///< as the scheme has it at the end of a step
      acceleration ///< the same
    };
    std::string name;
    std::string origin; ///< path of its section in the parameter file, for messages; may be empty
    Attachment point;
    bool rotational = false;
    Coordinates direction = {0., 1.};
    Quantity quantity = Quantity::displacement;

    /// "m", "rad", "m/s" and so on.
    std::string unit() const;
  };

  /// The model as plain values. A SceneGenerator fills it; SceneBodies makes bodies from it.
  struct Scene
  {
    Coordinates gravity = {0., -9.81}; ///< [m/s^2]
    Start start = Start::equilibrium;
    std::vector<Wire> wires;
    std::vector<Support> supports;
    std::vector<PointMass> point_masses;
    std::vector<Mass> masses;
    std::vector<CustomBody> bodies;
    std::vector<Spring> springs;
    std::vector<Link> links;
    std::vector<SurfaceContact> contacts;
    std::vector<Load> loads;
    std::vector<Probe> probes;
  };

  /**
   * Checks a scene of a generator. Numbers must be finite and of the right sign, indices must be
   * those of existing items, and masses and lengths positive. Attachments must be inside their
   * wires, motions must exist, and a contact must remain on its wire until @p end_time [s]. Throws
   * UserError.
   */
  void check(const Scene &scene, double end_time);

  /// The part of check() about single values: numbers, indices, and bodies and laws that must
  /// exist.
  void check_values(const Scene &scene);

  /// The part of check() about wires, their supports, point masses and loads.
  void check_wires(const Scene &scene);

  /**
   * Node positions [m] of the grid of a wire, sorted, with 0 and the length. Every support, point
   * mass and fixed link end is a node. Elements are not longer than the element size of the wire,
   * and of equal length between two of these points.
   */
  std::vector<double> grid(const Scene &scene, std::size_t wire);
} // namespace taut

#endif
