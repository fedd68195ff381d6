// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_divisible_body_h
#define taut_divisible_body_h

#include <taut/base/coordinates.h>

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace taut
{
  class Substructure;
  struct BodySetting;

  /// The cells of a body, and the DoFs on them.
  struct BodyCells
  {
    unsigned int dim = 0; ///< 2: in the plane, 3: in space

    /// DoFs of cell c are dofs[begin[c]] to dofs[begin[c + 1] - 1], including all DoFs on which a
    /// DoF of the cell depends.
    std::vector<std::size_t> begin = {0};
    std::vector<unsigned int> dofs;

    std::vector<std::pair<unsigned int, unsigned int>> faces; ///< pairs of cells that share a face

    /// For each DoF, not 0 if its displacement is prescribed or follows from other DoFs, in every
    /// part alike.
    std::vector<char> is_determined;

    std::size_t size() const { return begin.size() - 1; }
    std::size_t n_dofs() const { return is_determined.size(); }
  };

  /**
   * A body that can be cut along the faces of its cells. Return one from BodyType::division() to
   * let the partition cut a body of your own. A part has the DoFs of its cells, in ascending order,
   * and the elements of these cells only. A DoF on a cut is in all adjacent parts, and bilateral
   * constraints tie its copies. Every rank has the object.
   */
  class DivisibleBody
  {
  public:
    virtual ~DivisibleBody() = default;

    virtual const BodyCells &cells() const = 0;

    /// The cell that contains a place; throws UserError if the place is not on the body.
    virtual std::size_t cell_at(const Coordinates &place) const = 0;

    /// A cell at a node of BodyType::surface().
    virtual std::size_t cell_at_node(unsigned int node) const = 0;

    /// Makes the part of these cells, in ascending order. Called on the rank that owns the part.
    /// Throws EntryError.
    virtual std::unique_ptr<Substructure>
    make_part(const BodySetting &setting, const std::vector<unsigned int> &part) const = 0;
  };
} // namespace taut

#endif
