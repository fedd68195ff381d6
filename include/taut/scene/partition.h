// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_scene_partition_h
#define taut_scene_partition_h

#include <taut/base/communicator.h>
#include <taut/base/coordinates.h>
#include <taut/scene/scene.h>

#include <cstddef>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace taut
{
  class Substructure;
  struct BodySetting;

  /// The cells of a body on this rank, all of them unless its mesh is distributed, and the DoFs on
  /// them.
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

    /// Of a distributed mesh: the number of each DoF here among those of the whole body, ascending;
    /// and the sizes of the whole body. Empty and 0: all cells are here.
    std::vector<unsigned int> numbers = {};
    std::size_t n_cells_of_all = 0, n_dofs_of_all = 0;

    std::size_t size() const { return begin.size() - 1; }
    std::size_t n_dofs() const { return numbers.empty() ? is_determined.size() : n_dofs_of_all; }
    std::size_t n_cells() const { return numbers.empty() ? size() : n_cells_of_all; }
  };

  /**
   * A body that can be cut along the faces of its cells. Return one from BodyType::division() to
   * let the partition cut a body of your own. A part has the DoFs of its cells, in ascending order,
   * and the elements of these cells only. A DoF on a cut is in all adjacent parts, and bilateral
   * constraints tie its copies. Every rank has the object.
   *
   * The cells of a body may be distributed over the ranks. Each rank then cuts its own ones, and
   * "all cells" below are those of this rank.
   */
  class DivisibleBody
  {
  public:
    virtual ~DivisibleBody() = default;

    virtual const BodyCells &cells() const = 0;

    /// The ranks over which the cells are distributed; one process: every rank has all cells.
    virtual Communicator processes() const { return {}; }
    bool is_distributed() const { return processes().size() > 1; }

    /// The cell that contains a place; throws UserError if the place is on none of the cells.
    virtual std::size_t cell_at(const Coordinates &place) const = 0;

    /// A cell at a node of BodyType::surface(). If the cells are distributed, one rank has it, and
    /// others return cells().size().
    virtual std::size_t cell_at_node(unsigned int node) const = 0;

    /// Makes the part of these cells, in ascending order. Called on the rank that owns the part.
    /// Throws EntryError.
    virtual std::unique_ptr<Substructure>
    make_part(const BodySetting &setting, const std::vector<unsigned int> &part) const = 0;
  };

  /**
   * How the wires and the bodies of a scene are cut (domain decomposition). A wire is cut at nodes
   * of its grid, a body along faces of its cells, so that cutting never changes the mesh. Every
   * piece belongs to one part.
   */
  struct Partition
  {
    /// A piece of a wire: the nodes from `first` to the first node of the next piece, or to the
    /// end.
    struct Piece
    {
      std::size_t first = 0; ///< index in grid(scene, wire)
      unsigned int part = 0;
    };
    std::vector<std::vector<Piece>> wires; ///< at least one piece a wire, in ascending order

    /// How a custom body is cut; without `body` it is not cut.
    struct Division
    {
      std::shared_ptr<const DivisibleBody> body;
      std::vector<unsigned int> part; ///< part of each cell

      /// Of a distributed body: its parts on all ranks, ascending.
      std::vector<unsigned int> parts = {};
    };
    std::vector<Division> bodies; ///< one for each custom body, or empty

    unsigned int n_parts = 1;

    /// The ranks of parts that are settled, as their ranks alone have cells of them.
    std::map<unsigned int, unsigned int> rank_of_part = {};

    /// Number of cuts of wires.
    std::size_t n_cuts() const;
  };

  /// The partition without cuts: all wires and bodies in one part.
  Partition whole(const Scene &scene);

  /// How a scene is to be cut.
  struct PartitionParameters
  {
    std::string method = "METIS";
    std::string n_substructures = "automatic"; ///< or a number
    std::string cuts;

    /// Declares the members in subsection "Partition".
    void declare_parameters(dealii::ParameterHandler &prm);
  };
} // namespace taut

#endif
