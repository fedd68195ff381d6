// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_scene_h
#define taut_scene_h

#include <taut/base/coordinates.h>
#include <taut/base/force_law.h>
#include <taut/base/start.h>
#include <taut/scene/body_type.h>
#include <taut/scene/expression.h>
#include <taut/scene/surface_contact.h>

#include <cstddef>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace taut
{
  /// A scalar motion a wire point can have: along the wire, along its normal, the slope of that,
  /// along its binormal, the slope of that.
  enum class WireMotion
  {
    axial,
    transverse,
    slope,
    lateral,
    lateral_slope
  };

  /// The components that a wire can have, each named by its displacement.
  constexpr WireMotion wire_components[] = {WireMotion::axial, WireMotion::transverse,
                                            WireMotion::lateral};

  constexpr bool is_slope(const WireMotion motion)
  {
    return motion == WireMotion::slope || motion == WireMotion::lateral_slope;
  }

  /// The component that has a motion.
  constexpr WireMotion component_of(const WireMotion motion)
  {
    return motion == WireMotion::slope           ? WireMotion::transverse
           : motion == WireMotion::lateral_slope ? WireMotion::lateral
                                                 : motion;
  }

  /// Of the component of a motion, for people.
  const char *component_name(WireMotion motion);

  /// What a wire resists transverse motion with. A string has tension only (C0 elements), a beam
  /// bends (Hermite).
  enum class TransverseKind
  {
    none,
    string,
    beam
  };

  /// How the mass of a bar or string element is integrated. With step = element / wave speed and
  /// Moreau-Jean or Newmark at 1/2, reduced linear elements carry waves exactly; lumped ones have a
  /// diagonal matrix and slow short waves, consistent ones make them too fast.
  enum class MassMatrix
  {
    consistent, ///< exactly
    lumped,     ///< at the nodes of the element, Gauss-Lobatto
    reduced     ///< by one Gauss point less than the element has nodes
  };

  /// C = mass * M + stiffness * K of a wire, without its supports and point masses.
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

  /// A straight wire from a to b. Each of its components is an independent scalar problem.
  struct Wire
  {
    std::string name;
    std::string origin; ///< path of its section in the parameter file, for messages; may be empty
    Coordinates a, b;
    double mass_per_length = 0.; ///< [kg/m]
    bool has_axial = false;      ///< an elastic bar along the wire
    double axial_stiffness = 0.; ///< EA [N]
    TransverseKind transverse = TransverseKind::none;
    bool has_lateral = false;      ///< resists lateral motion as it does transverse motion
    double tension = 0.;           ///< T [N]
    double bending_stiffness = 0.; ///< EI [N m^2]
    unsigned int degree = 2;       ///< of the elements of bar and string
    MassMatrix mass_matrix = MassMatrix::consistent;
    double element_size = 1.; ///< largest element [m]
    RayleighDamping damping;
    bool weight = true; ///< gravity acts
    InitialMotion axial_start, transverse_start, lateral_start;

    double length() const;
    Coordinates tangent() const; ///< unit vector from a to b

    /// Across the wire in the plane of x and y: the tangent's part in this plane, turned by +90
    /// degrees; y for a wire along z.
    Coordinates normal() const;
    Coordinates binormal() const; ///< tangent x normal: +z for a wire in the plane

    /// Unit vector of the component of a motion.
    Coordinates axis(WireMotion motion) const;

    /// What a slope of a component turns the wire about: tangent x its axis; 0 of the axial one.
    Coordinates rotation_axis(WireMotion motion) const;
    bool has(WireMotion motion) const;
    unsigned int n_dofs_per_node() const; ///< of all components
    Coordinates at(double s) const;
  };

  /// One motion of one wire held, moved or sprung at given positions.
  struct Support
  {
    std::string name;
    std::string origin; ///< path of its section in the parameter file, for messages; may be empty
    std::size_t wire = 0;
    std::vector<double> positions; ///< s [m]
    WireMotion motion = WireMotion::transverse;
    bool fixed = true;     ///< displacement prescribed; otherwise spring and damper to the ground
    Expression prescribed; ///< u(t) [m, rad], if fixed
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
    bool weight = true;            ///< false: inertia only, its weight is carried elsewhere
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
  };

  /// Index of the ground in a spring.
  constexpr std::size_t ground = std::numeric_limits<std::size_t>::max();

  /// A spring and damper between two masses, or a mass and the ground. Connected masses form one
  /// mechanism.
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

  /// Where a link or a load acts.
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
    Coordinates place = {}; ///< of a body, in its own coordinates, undeformed; of the ground [m]
    bool has_place = false; ///< of the ground, which need not have one
  };

  enum class LinkKind
  {
    joint,          ///< gap = 0
    stop,           ///< gap >= 0, pushes its ends apart
    dropper,        ///< slack >= 0, pulls its ends together
    sliding_contact ///< a stop whose `to` end moves along a wire
  };

  /// Where the mass of a DoF at a rigid unilateral link goes: to its neighbours, so that the total
  /// mass stays, or also its centre and its moment of inertia.
  enum class ContactMass
  {
    stays,
    keeps_total,
    keeps_inertia
  };

  /**
   * A link between two attachments. With n the unit direction and u the displacements, its gap is
   *
   *     D =  n . (u_to - u_from) + gap          joint, stop, sliding contact: N > 0 pushes `to`
   * along +n D = -n . (u_to - u_from) + gap          dropper: N > 0 is tension, n from `from` to
   * `to`
   *
   * plus N over its stiffness; a rotational link has rotations about n instead of n . u. With
   * `turns` n is the direction from end to end at each time, and D is
   *
   *     D = |Delta| - length    or of a dropper    D = length - |Delta|
   *
   * of the vector Delta from the `from` to the `to` end.
   */
  struct Link
  {
    std::string name;
    std::string origin; ///< path of its section in the parameter file, for messages; may be empty
    LinkKind kind = LinkKind::joint;
    Attachment from, to;
    bool rotational = false;
    Coordinates direction = {0., 1.};
    double stiffness = std::numeric_limits<double>::infinity(); ///< [N/m, N m/rad]; infinite: rigid

    /// Force over the elongation of a dropper, or the compression of a stop, that does not follow
    /// the stiffness, which then is the largest one; may be null.
    std::shared_ptr<const ForceLaw> law = {};
    double damping = 0.; ///< [N s/m, N m s/rad]
    double gap = 0.;     ///< D at U = 0, N = 0 [m, rad]

    /// The direction is that from end to end at each time, and `direction` counts for nothing.
    bool turns = false;
    double unstressed_length = 0.; ///< once known; of a link that turns, 0: as `gap` says [m]

    double speed = 0.; ///< of the `to` end along its wire [m/s]

    /// The speed of a contact on a cable is not that along its unstressed length, but in space:
    /// along the line between the ends of the cable as given, across `direction`.
    bool straight = false;
    Expression
        profile; ///< height r(s) of the wire under a sliding contact [m]: adds to the gap along n

    /// A dropper whose length follows from a height that its `to` end shall have in the static
    /// state.
    bool find_length = false;
    double prescribed_displacement = 0.; ///< of the `to` end, along -n [m]
    double axial_stiffness = 0.;         ///< EA [N]; if not 0, stiffness = EA / length
    double mass_per_length = 0.;         ///< [kg/m]; half of the mass goes to each end
    double length = 0.;                  ///< geometric length in the static state, once known [m]

    /// With the length of a dropper between wires without axial motion its direction is found, too:
    /// that from end to end in the static state. `direction` is where its height is prescribed.
    bool find_direction = false;
    /// Across such a dropper and its wires, once known: a unit vector, and what pulls the ends back
    /// into line, the static tension over the length.
    Coordinates sideways = {};
    double sideways_stiffness = 0.; ///< [N/m]
    double sideways_gap = 0.;       ///< sideways . (to - from) of the undeformed ends [m]

    /// Whether the DoFs of wires that a fixed rigid unilateral link acts on keep their mass.
    ContactMass contact_mass = ContactMass::stays;

    bool unilateral() const { return kind != LinkKind::joint; }
    bool moving() const { return kind == LinkKind::sliding_contact; }

    /// Of the spring under a force [m, rad].
    double elongation(const double N) const { return law ? law->elongation(N) : N / stiffness; }
    bool rigid() const { return stiffness == std::numeric_limits<double>::infinity(); }
  };

  /// A force, or with `rotational` a moment about its direction.
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

    /// False: lengths and directions of droppers are found without it.
    bool acts_while_built = true;
  };

  /// A point whose displacement along a direction is recorded, or with `rotational` its rotation
  /// about it, and whose largest uplift is reported.
  struct Probe
  {
    std::string name;
    std::string origin; ///< path of its section in the parameter file, for messages; may be empty
    Attachment point;
    bool rotational = false;
    Coordinates direction = {0., 1.};
  };

  /// What is modelled, as plain values.
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
   * Checks what a generator cannot express in types: numbers that are finite and of the right sign,
   * indices of items that exist, positive masses and lengths, attachments inside their wires,
   * motions that exist, a contact that stays on its wire until @p end_time [s]. Throws UserError.
   */
  void check(const Scene &scene, double end_time);

  /// The part of it about single values: numbers and indices, and bodies and laws that are there.
  void check_values(const Scene &scene);

  /// The part of it about wires, their supports, point masses and loads.
  void check_wires(const Scene &scene);

  /**
   * Node positions [m] of a wire's grid: sorted, 0 and length included, every support, point mass
   * and fixed link end a node, elements not longer than the wire's element size and of equal length
   * between two such points.
   */
  std::vector<double> grid(const Scene &scene, std::size_t wire);
} // namespace taut

#endif
