// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_interface_preconditioner_h
#define taut_interface_preconditioner_h

#include "interface/interface_stiffness.h"
#include "interface/shared_factor.h"

#include <taut/interface/interface_parameters.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace taut
{
  /// Rows of the constraints in blocks between which a matrix has no entries.
  struct RowBlocks
  {
    std::vector<std::size_t> rows;  ///< their numbers, ascending
    std::vector<std::size_t> block; ///< the number of that of each row

    std::size_t n_blocks() const
    {
      return block.empty() ? 0 : *std::max_element(block.begin(), block.end()) + 1;
    }
  };

  /**
   * A cheap approximation of F^-1 on an active set, by name. With the DoFs b in active constraints,
   *
   *     "diagonal"   1 / F_ii
   *     "Dirichlet"  the Schur complement of A_k on b: the stiffness for b if other DoFs follow
   *
   * The last one assembles a sparse matrix T over all DoFs b, with the elastic constraints c as
   * springs in it: T = sum_k T_k + B_c S_c^-1 B_c^T. In
   *
   *     [F_cc F_cr]         F = B^T (sum_k T_k)^-1 B + S
   *     [F_rc F_rr],
   *
   * a factor of T inverts the elastic part exactly. The preconditioner of FETI approximates the
   * remainder for the rigid constraints r, B_r^T T^-1 B_r. It splits a jump between both sides by
   * their stiffness D = diag(T) (Rixen and Farhat 1999):
   *
   *     Q^-1 B_r^T D^-1 T D^-1 B_r Q^-1,    Q = B_r^T D^-1 B_r.
   *
   * the (B^T B)^-1 scaling where D is the same on all sides. Q is small blocks, one for the
   * constraints at a node that several parts share. Moving constraints are constraints like the
   * others.
   *
   * Each of several ranks has T_k and B of its own bodies, and applies them to the rows that these
   * see: the elastic ones, and those of the blocks of Q with a term on one of them. The factor of
   * T with springs is a SharedFactor.
   */
  class InterfacePreconditioner
  {
  public:
    /// The references to bodies and constraints are kept. Throws UserError for an unknown name.
    InterfacePreconditioner(const InterfaceParameters &parameters, const FactoredStructure &solvers,
                            const BodyConstraints &body_constraints);

    /// All A_k are new.
    void reset() { T.reset(); }

    /// See InterfaceStiffness.
    void follow_sets(const bool follow) { T.follow_sets(follow); }
    std::vector<std::size_t> applied_bodies(const std::vector<char> &active, bool coarse) const
    {
      return T.applied_bodies(active, coarse);
    }

    /// Sets up for the active constraints, by vectors over the constraints of this rank. Bodies in
    /// @p is_changed have another A_k or other constraints than in the last call. @p diagonal is
    /// that of F.
    void setup(const RowMap &rows, const std::vector<char> &active,
               const std::vector<char> &is_changed, const std::vector<double> &compliance,
               const std::vector<double> &diagonal);

    /// z = M^-1 r on owned rows; zero on inactive constraints. Called by all ranks together.
    void apply(const std::vector<double> &r, std::vector<double> &z) const;

    /// The blocks of Q that this rank has, with the owned rows: all on one rank.
    RowBlocks blocks() const;

    /// True if these are all rows, and the constraints of this rank are, too.
    bool has_all_rows() const { return !own_rows && !is_diagonal && !constraints.shared(); }

    /// Values on the rows of blocks(), from a vector over the constraints of this rank; and the
    /// entries there of a matrix, by the numbers of rows, of which each rank has those in the rows
    /// that it owns. Called by all ranks together.
    std::vector<double> on_blocks(const std::vector<double> &of_constraints) const;
    void copy_to_blocks(MatrixEntries &of_owned, std::size_t n_columns) const;

    /// r = Q^-1 r on the rows of blocks(): local stiffness at a constraint, without the bodies
    /// behind; 1 / F_ii for elastic constraints and without T. Zero on inactive constraints.
    void scale(std::vector<double> &r) const;

  private:
    template <typename Values>
    std::vector<double> on_blocks_of(const Values &of_constraints) const;
    std::size_t position(int number) const;
    void set_rows(const std::vector<char> &active, const std::vector<double> &diagonal,
                  const std::vector<double> &compliance);
    void set_springs(const std::vector<char> &active, const std::vector<double> &own_compliance,
                     const std::vector<double> &own_diagonal);
    void factor_with_springs();
    double spring(int number) const;
    MatrixEntries scale_by_stiffness();
    void keep_blocks(const MatrixEntries &products);
    void set_scaling(const MatrixEntries &products);
    void set_forms();
    void solve_springs() const;
    void multiply_with_springs() const;
    void take_shares() const;
    void sum_shares() const;

    const bool is_diagonal;
    const Constraints &constraints;
    InterfaceStiffness T;

    const RowMap *owners = nullptr;
    bool has_springs = false;
    SharedFactor inverse_T; ///< with springs

    // Of the rows of blocks(), by their positions.
    std::vector<std::size_t> kept;  ///< their numbers, ascending
    std::vector<char> is_rigid;     ///< a row of Q
    std::vector<double> other;      ///< 1 / F_ii of active constraints outside Q, else 0
    std::vector<double> stiffness;  ///< 1 / S_i of elastic constraints, else 0
    std::vector<std::size_t> place; ///< of an owned row
    MatrixEntries B;                ///< of rigid and elastic rows
    std::vector<double> scaled_B;   ///< D^-1 B_r, in the order of B
    SymmetricEntries Q_entries;     ///< of the rigid rows, 1 on the others
    SparseCholesky Q;

    std::vector<double> springs; ///< 1 / S_i of elastic constraints, else 0; of held rows
    std::vector<double> D;       ///< diagonal of T with springs

    // Of one of several ranks.
    std::unique_ptr<const RowMap> own_rows; ///< holds the rows of blocks()
    MatrixEntries pattern;                  ///< of the products that they follow from
    std::vector<std::size_t> with_springs;  ///< held rows then
    std::vector<std::size_t> owned;         ///< rows of the owners then

    /// @p motion and @p force: of the DoFs of T; @p jump and @p residual: of the rows of blocks();
    /// @p sums: of owned rows.
    mutable std::vector<double> motion, force, jump, residual, sums;
  };
} // namespace taut

#endif
