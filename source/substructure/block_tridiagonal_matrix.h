// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_block_tridiagonal_matrix_h
#define taut_block_tridiagonal_matrix_h

#include "substructure/cable_nodes.h"
#include "substructure/diagonals.h"

#include <taut/substructure/symmetric_matrix.h>

#include <array>
#include <type_traits>
#include <vector>

namespace taut
{
  /**
   * A block-tridiagonal matrix of b x b blocks: the matrices of a wire with b DoFs per node. Where
   * elements are alike, rows repeat from node to node, and a product reads them once.
   */
  template <int b>
  class BlockTridiagonalMatrix : public SymmetricMatrix
  {
  public:
    /// @p n is a multiple of b.
    explicit BlockTridiagonalMatrix(unsigned int n);

    using SymmetricMatrix::add;
    unsigned int size() const override { return n; }
    unsigned int block_size() const override { return b; }
    void add(unsigned int i, unsigned int j, double value) override;
    void set_zero() override;
    void find_repetitions() override;
    void vmult_add(double factor, const double *x, double *y) const override;
    void vmult(const double *x, double *y) const override;
    void visit(const Visitor &visitor) const override;
    std::unique_ptr<SymmetricMatrix> clone() const override;

    /// factor * (this) added to the blocks D_i of the nodes and L_i of node i with i - 1.
    template <typename AnyBlock>
    void add_to(const double factor, std::vector<AnyBlock> &D, std::vector<AnyBlock> &L) const
    {
      entries.add_to(factor, D, L);
    }

    /// For cables: true if nothing couples the plane of x and y with z.
    bool decouples() const { return entries.decouples(); }

  private:
    static constexpr int width = 2 * b - 1; ///< diagonals below the main one
    static constexpr bool is_cable = b == CableNodes::b;
    static constexpr int n_directions = 3;                       ///< of cables
    static constexpr int lanes = b % n_directions == 0 ? 24 : 8; ///< whole nodes

    /// Rows begin to end - 1 repeat `lanes` rows, which are whole nodes. For cables only if
    /// directions are uncoupled: other rows are read as fast without repetition.
    struct Repetition
    {
      std::size_t begin, end;
      bool is_zero; ///< no damping
      std::array<std::array<double, lanes>, 2 * width + 1> rows;
    };

    double entry(std::size_t i, int offset) const;
    template <typename Result>
    void product(const double *x, double *y, const Result &result) const;
    template <bool has_before, bool has_after, typename Result>
    void product_at_node(std::size_t node, const double *x, double *y, const Result &result) const;
    template <typename Result>
    void product_at_end(std::size_t begin, std::size_t end, const double *x, double *y,
                        const Result &result) const;

    std::size_t n;
    std::conditional_t<is_cable, CableNodes, Diagonals<b>> entries;
    std::vector<Repetition> repetitions;
  };
} // namespace taut

#endif
