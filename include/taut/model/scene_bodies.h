// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_scene_bodies_h
#define taut_scene_bodies_h

#include <taut/scene/partition.h>
#include <taut/scene/scene.h>
#include <taut/substructure/structure.h>

#include <array>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace taut
{
  /// The bilateral constraint that holds two pieces of a wire or body together at a cut: a linear
  /// form that is zero [m], or [rad] if it is rotational.
  struct CutConstraint
  {
    std::string name;
    bool rotational = false;
    std::size_t number = 0; ///< among the cuts of all ranks
    std::vector<Term> terms = {};
  };

  struct SharedParts;

  /// The substructures of a scene, and the places of the points of the scene in them.
  class SceneBodies : public Structure
  {
  public:
    /// The bodies of a program that has no scene: each is one of indices_of_body().
    explicit SceneBodies(const Structure &bodies);

    /// All wires without cuts, on this rank.
    explicit SceneBodies(const Scene &scene) : SceneBodies(scene, whole(scene)) {}

    /// The wires cut by @p partition. All ranks get about the same number of DoFs. Wires that @p
    /// shared knows come from there. Called by all ranks together.
    SceneBodies(const Scene &scene, const Partition &partition,
                const Communicator &processes = Communicator(), SharedParts *shared = nullptr);

    /**
     * The displacement of an attachment along @p direction, or its slope or rotation, as linear
     * forms: appends factor * form, and nothing for the ground or for a body of another rank. A
     * wire counts only its components.
     */
    void motion(const Attachment &point, bool rotational, const Coordinates &direction,
                double factor, std::vector<Term> &terms) const
    {
      append_motion(point, rotational, direction, factor, false, terms);
    }

    /// Undeformed position of an attachment in space [m]; the attachment must not be a ground
    /// without a place. Called by all ranks together.
    Coordinates position(const Scene &scene, const Attachment &point) const;

    /// As motion(), for the derivative of the displacement with respect to the position along the
    /// wire or slender body [1/m]. Sliding contacts need it.
    void slope(const Attachment &point, const Coordinates &direction, double factor,
               std::vector<Term> &terms) const
    {
      append_motion(point, false, direction, factor, true, terms);
    }

    /// The attachment at another place along its wire or slender body [m].
    static Attachment moved(const Attachment &point, double position);

    /// A motion of a point of a wire, s [m] from its first end, whichever way the wire runs.
    void motion(std::size_t wire, double s, WireMotion motion, std::vector<Term> &terms) const;

    /**
     * The constraints of the cuts, by their numbers: of all but those of distributed bodies that do
     * not act on bodies of this rank. A cut of a wire has one constraint for each continuous
     * motion: displacement, and slope of a beam. A DoF of a body on a cut has a chain of
     * constraints from part to part, one fewer than parts. So the constraints are independent where
     * several cuts meet.
     */
    const std::vector<CutConstraint> &cut_constraints() const { return cuts; }

    /// Number of cuts of all ranks.
    std::size_t n_cuts() const { return n_cuts_of_all; }

    /// The indices on this rank of the parts of a custom body of the scene, one index if the body
    /// is not cut; Structure::elsewhere for parts on other ranks.
    const std::vector<std::size_t> &indices_of_body(std::size_t body) const
    {
      return custom_bodies[body].index;
    }

    /// The ranks that share the mesh of a body; 0: none is shared.
    unsigned int n_sharing_ranks() const;

    /// The index of the part with a place on the body; throws UserError if the place is not on the
    /// body. On a distributed body it is a place that the scene names.
    std::size_t index_at(std::size_t body, const Coordinates &place) const;

    /// The index of the part with a node of the surface of the body (BodyType::surface()).
    std::size_t index_at_node(std::size_t body, unsigned int node) const;

    /// Part of the partition that a point of a wire belongs to.
    unsigned int part(std::size_t wire, double s) const;

  private:
    void append_motion(const Attachment &point, bool rotational, const Coordinates &direction,
                       double factor, bool derivative, std::vector<Term> &terms) const;

    /// Substructures of the pieces of a wire, in order; none if the wire lacks the component.
    struct WireParts
    {
      std::vector<double> begins; ///< position of the first node of each piece [m]
      std::vector<unsigned int> part;
      std::array<std::vector<std::size_t>, 3> components; ///< in the order of wire_components

      /// The substructure of a component of a piece; `elsewhere` also if the wire lacks the
      /// component.
      std::size_t index(const std::size_t component, const std::size_t piece) const
      {
        return components[component].empty() ? elsewhere : components[component][piece];
      }
    };

    /// A custom body, uncut or in parts.
    struct BodyParts
    {
      std::vector<std::size_t> index; ///< of each part
      Partition::Division division;   ///< with the position in `index` of the part of each cell
    };

    /// A part with a DoF, and the position of the DoF in the part, if it is here.
    struct PartWithDof
    {
      unsigned int part, own_dof;
    };

    /// Cells of the parts of a body.
    using CellsOfParts = std::vector<std::vector<unsigned int>>;

    CellsOfParts number_parts(const Partition &partition, std::size_t body,
                              std::vector<unsigned int> &part);
    void list_custom_bodies(const Scene &scene, const Partition &partition,
                            const std::vector<unsigned int> &owner, std::vector<NewBody> &list,
                            std::vector<CellsOfParts> &cells);
    void find_places(const Scene &scene);
    void tie_parts(const std::string &name, const BodyParts &body, const CellsOfParts &cells);
    void tie_distributed_parts(const std::string &name, const BodyParts &body,
                               const CellsOfParts &cells);
    void add_cut(const std::string &name, const BodyParts &body, unsigned int dof,
                 const std::array<PartWithDof, 2> &sides);
    std::size_t part_at(std::size_t body, const Coordinates &place) const;
    void add_loads(const Scene &scene, std::size_t body, std::size_t part,
                   Substructure &made) const;
    void check_places(const Scene &scene) const;
    void list_wire(const Scene &scene, std::size_t wire,
                   const std::vector<Partition::Piece> &pieces,
                   const std::vector<unsigned int> &owner, SharedParts *shared,
                   std::vector<NewBody> &list);
    void tie_pieces(const Scene &scene, std::size_t wire, WireMotion motion,
                    const std::vector<std::size_t> &indices);
    std::size_t piece(const WireParts &parts, double s) const;

    std::vector<WireParts> wires;

    /// For the components of each wire: directions of displacements, and rotation axes of slopes.
    std::vector<std::array<Coordinates, 3>> axes, rotation_axes;
    std::vector<double> lengths;
    std::vector<std::size_t> mechanism_of_mass;
    std::vector<BodyParts> custom_bodies;

    /// Parts at the places of the scene on distributed bodies; none: the place is on no cell.
    std::map<std::tuple<std::size_t, double, double, double>, std::optional<std::size_t>>
        part_of_place;
    std::vector<CutConstraint> cuts;
    std::size_t n_cuts_of_all = 0;
  };
} // namespace taut

#endif
