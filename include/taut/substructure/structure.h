// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_structure_h
#define taut_structure_h

#include <taut/base/communicator.h>
#include <taut/scene/partition.h>
#include <taut/scene/scene.h>
#include <taut/substructure/mechanism.h>
#include <taut/substructure/wire_component.h>

#include <memory>
#include <string>
#include <vector>

namespace taut
{
  /// A linear form on the displacements of one substructure of this rank: a summand of a row.
  struct Term
  {
    std::size_t substructure = 0;
    SparseVector form;
  };

  /// One vector of DoFs for each substructure.
  using BlockVector = std::vector<std::vector<double>>;

  /// What holds two pieces of a wire together where it was cut: a linear form that is zero.
  struct CutRow
  {
    std::string name;
    bool rotational = false;
    std::vector<Term> terms;
  };

  /**
   * The substructures of a scene, and where the scene's points are in them. A part of the partition
   * lives on one rank, with all its pieces: this one knows its own substructures only, and of a
   * point on another rank no terms.
   */
  class Structure
  {
  public:
    /// All wires whole, on this rank.
    explicit Structure(const Scene &scene) : Structure(scene, whole(scene)) {}

    /// The wires cut as @p partition says, the parts shared out so that all ranks have about the
    /// same number of DoFs. Called by all ranks together.
    Structure(const Scene &scene, const Partition &partition,
              const Communicator &processes = Communicator());

    const Communicator &communicator() const { return processes; }

    /// Substructures of this rank.
    std::size_t size() const { return substructures.size(); }
    const Substructure &operator[](std::size_t k) const { return *substructures[k]; }
    std::size_t n_dofs() const;

    /// A substructure of any rank.
    struct Body
    {
      std::string name;
      std::size_t n_dofs = 0;
    };

    /// The substructures of all ranks, in the order of the scene.
    const std::vector<Body> &all_bodies() const { return bodies; }

    /**
     * The displacement along @p direction, or the slope or rotation, of an attachment as linear
     * forms: appends factor * form, nothing for the ground or for a body of another rank. A wire
     * counts only the components it has.
     */
    void motion(const Attachment &point, bool rotational, const Point &direction, double factor,
                std::vector<Term> &terms) const
    {
      append_motion(point, rotational, direction, factor, false, terms);
    }

    /// The same of the derivative of the displacement by the position along the wire [1/m]: what a
    /// contact that slides is displaced by.
    void slope(const Attachment &point, const Point &direction, double factor,
               std::vector<Term> &terms) const
    {
      append_motion(point, false, direction, factor, true, terms);
    }

    /// One row a cut for each motion that is continuous there: displacement, and slope of a beam.
    const std::vector<CutRow> &cut_rows() const { return cuts; }

    /// Part of the partition that a point of a wire belongs to.
    unsigned int part(std::size_t wire, double s) const;

    /// Zero vectors of the right sizes.
    BlockVector zero() const;

  private:
    void append_motion(const Attachment &point, bool rotational, const Point &direction,
                       double factor, bool derivative, std::vector<Term> &terms) const;
    static constexpr std::size_t elsewhere = -1; ///< a substructure of another rank

    /// Substructures of a wire's pieces, in order; none where it lacks the component.
    struct WireParts
    {
      std::vector<double> begins; ///< position of the first node of each piece [m]
      std::vector<unsigned int> part;
      std::vector<std::size_t> axial, transverse;
    };

    void build(const Scene &scene, const Partition &partition);
    void add_pieces(const Scene &scene, std::size_t wire, WireMotion motion,
                    const std::vector<Partition::Piece> &pieces,
                    const std::vector<unsigned int> &owner, std::vector<std::size_t> &indices);
    std::size_t piece(const WireParts &parts, double s) const;

    Communicator processes;
    std::vector<std::unique_ptr<Substructure>> substructures;
    std::vector<Body> bodies;
    std::vector<WireParts> wires;
    std::vector<Point> tangents, normals;
    std::vector<double> lengths;
    std::vector<std::size_t> mechanism_of_mass;
    std::vector<CutRow> cuts;
  };

  /// Sum of the absolute values of the terms applied to U: what a sum that cancels rounds against.
  double magnitude(const std::vector<Term> &terms, const BlockVector &U);

  /// Sum of the forms of @p terms applied to U.
  double evaluate(const std::vector<Term> &terms, const BlockVector &U);
} // namespace taut

#endif
