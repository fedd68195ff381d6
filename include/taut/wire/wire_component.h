// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_wire_component_h
#define taut_wire_component_h

#include <taut/scene/scene.h>
#include <taut/substructure/substructure.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace taut
{
  /**
   * One scalar problem of a straight wire: a bar (axial), a string or a beam (transverse, lateral).
   * Use make_wire() to make one without a scene. DoFs are numbered along the wire, in blocks of one
   * node. A beam has displacement w and slope dw/ds at a node. A bar or string of degree p has the
   * value at the node and at the p - 1 inner points of the next element. Positions s run from 0 to
   * the length [m].
   *
   *     bar     M = rho,  K = EA u'v'
   *     string  M = rho,  K = T w'v'
   *     beam    M = rho,  K = T w'v' + EI w"v"
   */
  class WireComponent : public Substructure
  {
  public:
    /// The whole wire; @p motion is axial, transverse or lateral.
    WireComponent(const Scene &scene, std::size_t wire, WireMotion motion);

    /**
     * The piece between two nodes of the @p grid of the wire. Supports, masses and loads on the
     * node where two pieces meet belong to the second piece.
     */
    WireComponent(const Scene &scene, std::size_t wire, WireMotion motion,
                  const std::vector<double> &grid, std::size_t first_node, std::size_t last_node);
    ~WireComponent() override;

    /// Name of the component of a wire, the same for all pieces.
    static std::string name_of(const Scene &scene, std::size_t wire, WireMotion motion);

    /// True if a point of the wire is on this piece.
    bool owns(double s) const;

    /// DoF of the displacement at the first or last node; the slope, if there is one, follows it.
    unsigned int first_dof() const { return 0; }
    unsigned int last_dof() const { return dofs_per_node * (nodes.size() - 1); }

    /// Values of the shape functions at s [m]: u(s) = result . U.
    void value_at(double s, LinearForm &result) const;

    /// Slopes of the shape functions at s: du/ds(s) = result . U [1/m]; at a node of C0 elements,
    /// the slope to the right.
    void slope_at(double s, LinearForm &result) const;

    /// True if slopes are DoFs, so that moments and angular gaps make sense.
    bool has_slopes() const { return beam; }

    /// False for the reduced mass matrix: one Gauss point fewer than nodes gives the shortest wave
    /// hardly any mass.
    bool has_definite_mass() const override { return mass_matrix != MassMatrix::reduced || beam; }

    /// The displacement at position place[0] on the wire: the part of @p direction along the motion
    /// of this component.
    LinearForm displacement(const Coordinates &place, const Coordinates &direction) const override;

    void initial_state(std::vector<double> &U, std::vector<double> &V) const override;
    NullSpace null_space() const override;
    std::string uneven_elements() const override;

  private:
    struct Discretisation; ///< deal.II's triangulation, element and DoFs
    class DistributedLoad;
    class MovingLoad;

    void find_massless_dofs(const Scene &scene, std::size_t wire);
    void assemble(const Wire &wire);
    void add_bedding(const Wire &wire);
    std::vector<LinearForm> inertial_forms(std::size_t element) const;
    void add_supports(const Scene &scene, std::size_t wire);
    void add_point_masses(const Scene &scene, std::size_t wire, double gravity);
    void add_loads(const Scene &scene, std::size_t wire, double gravity);
    void add_distributed_load(const Load &load, double factor);
    void interpolate(const Expression &f, std::vector<double> &U) const;
    void evaluate(double s, bool slope, LinearForm &result) const;

    /// The part of a force along a direction, or of a moment about it, that acts on this component.
    double component(const Coordinates &direction, bool rotational) const;

    std::vector<double> nodes; ///< of this piece, s on the whole wire
    double wire_length;
    bool is_last;                    ///< the piece with the end of the wire
    Coordinates axis, rotation_axis; ///< unit vectors of the motion and of the slope of a beam
    WireMotion motion;
    bool beam = false;
    bool bends_freely = false; ///< no tension: a rigid rotation costs nothing
    bool is_bedded = false;    ///< a foundation resists rigid motions
    unsigned int degree = 1, dofs_per_node = 1;
    MassMatrix mass_matrix = MassMatrix::consistent;
    InitialMotion start;
    std::vector<unsigned int> sprung_dofs; ///< of elastic supports

    /// DoFs without mass at contacts, with the section of the link for messages.
    std::map<unsigned int, std::string> massless_dofs;
    bool keeps_inertia = false; ///< how mass redistribution moves their mass
    std::unique_ptr<Discretisation> discretisation;
  };
  /// A wire as a body for a program without a scene: one of its motions, with supports, point
  /// masses and loads. These count for this wire, whatever wire they name. Throws EntryError for a
  /// wire without this motion, and for values that a scene cannot have, see check_values() and
  /// check_wires().
  std::unique_ptr<Substructure>
  make_wire(const Wire &wire, WireMotion motion = WireMotion::transverse,
            std::vector<Support> supports = {}, std::vector<PointMass> point_masses = {},
            std::vector<Load> loads = {}, const Coordinates &gravity = {0., -9.81});
} // namespace taut

#endif
