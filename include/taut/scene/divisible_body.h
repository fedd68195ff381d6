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

    /// Those of cell c are dofs[begin[c]] to dofs[begin[c + 1] - 1]: all on which a DoF of the cell
    /// depends, too.
    std::vector<std::size_t> begin = {0};
    std::vector<unsigned int> dofs;

    std::vector<std::pair<unsigned int, unsigned int>> faces; ///< pairs of cells that share one

    /// Of each DoF: its displacement is given or follows from others, in every part alike.
    std::vector<char> is_determined;

    std::size_t size() const { return begin.size() - 1; }
    std::size_t n_dofs() const { return is_determined.size(); }
  };

  /**
   * A body that can be cut along the faces of its cells. A part has the DoFs of its cells, in
   * ascending order, and the elements of these cells only: DoFs on a cut are in all parts beside
   * it, and are tied by bilateral constraints. Every rank has one.
   */
  class DivisibleBody
  {
  public:
    virtual ~DivisibleBody() = default;

    virtual const BodyCells &cells() const = 0;

    /// The cell that a place is in; throws UserError if the place is not on the body.
    virtual std::size_t cell_at(const Coordinates &place) const = 0;

    /// A cell at a node of BodyType::surface().
    virtual std::size_t cell_at_node(unsigned int node) const = 0;

    /// A part of these cells, in ascending order. Called on the rank that owns it; throws
    /// EntryError.
    virtual std::unique_ptr<Substructure>
    make_part(const BodySetting &setting, const std::vector<unsigned int> &part) const = 0;
  };
} // namespace taut

#endif
