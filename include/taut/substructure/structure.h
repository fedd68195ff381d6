// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_structure_h
#define taut_structure_h

#include <taut/scene/scene.h>
#include <taut/substructure/mechanism.h>
#include <taut/substructure/wire_component.h>

#include <memory>
#include <vector>

namespace taut
{
  /// A linear form on the displacements of one substructure: a summand of a row.
  struct Term
  {
    std::size_t substructure = 0;
    SparseVector form;
  };

  /// One vector of DoFs for each substructure.
  using BlockVector = std::vector<std::vector<double>>;

  /// All substructures of a scene, and where the scene's points are in them.
  class Structure
  {
  public:
    explicit Structure(const Scene &scene);

    std::size_t size() const { return substructures.size(); }
    const Substructure &operator[](std::size_t k) const { return *substructures[k]; }
    std::size_t n_dofs() const;

    /**
     * The displacement along @p direction, or the slope or rotation, of an attachment as linear
     * forms: appends factor * form, nothing for the ground. A wire counts only the components it
     * has.
     */
    void motion(const Attachment &point, bool rotational, const Point &direction, double factor,
                std::vector<Term> &terms) const;

    /// Zero vectors of the right sizes.
    BlockVector zero() const;

  private:
    /// Substructures of a wire; `ground` (none) where it lacks the component.
    struct WireParts
    {
      std::size_t axial = ground, transverse = ground;
    };

    std::vector<std::unique_ptr<Substructure>> substructures;
    std::vector<WireParts> wires;
    std::vector<Point> tangents, normals;
    std::vector<std::size_t> mechanism_of_mass;
  };

  /// Sum of the forms of @p terms applied to U.
  double evaluate(const std::vector<Term> &terms, const BlockVector &U);
} // namespace taut

#endif
