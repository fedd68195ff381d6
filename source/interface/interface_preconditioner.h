// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_interface_preconditioner_h
#define taut_interface_preconditioner_h

#include <taut/base/sparse_cholesky.h>
#include <taut/interface/body_constraints.h>
#include <taut/substructure/factored_structure.h>

#include <memory>
#include <string>
#include <vector>

namespace taut
{
  /**
   * A cheap approximation of F^-1 on an active set, by name. With the DoFs b in active constraints,
   *
   *     "diagonal"   1 / F_ii
   *     "lumped"     A_k on b in place of the body
   *     "Dirichlet"  the Schur complement of A_k on b: the stiffness for b if other DoFs follow
   *
   * The last two assemble a sparse matrix T over all DoFs b, with the elastic constraints c as
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
   * This is the (B^T B)^-1 scaling for equal D on all sides. Q has small blocks, one for the
   * constraints at a node that several parts share. Moving constraints have no special treatment.
   *
   * For a body with many DoFs b the Schur complement is not formed, but applied with a factor of
   * the other DoFs. Its b are the DoFs of all constraints, active or not, so that the factor
   * remains while A_k does. In the factor of T, for the elastic constraints, A_k on b replaces it.
   */
  class InterfacePreconditioner
  {
  public:
    /// The references are kept. Throws UserError for an unknown name.
    InterfacePreconditioner(const std::string &name, const FactoredStructure &solvers,
                            const BodyConstraints &body_constraints);

    /// Resets after a change of all A_k.
    void reset() { blocks = std::vector<Block>(blocks.size()); }

    /// Sets up for the active constraints. Bodies in @p is_changed have another A_k or other
    /// constraints than in the last call. @p diagonal is that of F.
    void setup(const std::vector<char> &active, const std::vector<char> &is_changed,
               const std::vector<double> &compliance, const std::vector<double> &diagonal);

    /// z = M^-1 r; zero on inactive constraints. Called by all ranks together.
    void apply(const std::vector<double> &r, std::vector<double> &z) const;

    /// r = Q^-1 r: local stiffness at a constraint, without the bodies behind; 1 / F_ii for elastic
    /// constraints and without T. Zero on inactive constraints.
    void scale(std::vector<double> &r) const;

  private:
    /// T_k, by position in the list of DoFs b.
    struct Block
    {
      std::vector<unsigned int> dofs;
      SymmetricEntries entries;
      std::size_t first = 0; ///< position of its first DoF among those of all bodies

      /// Solver for the other DoFs, if the Schur complement is applied and not formed.
      std::unique_ptr<LocalSolver> interior;
    };

    void compute_block(std::size_t k, const std::vector<char> &active);
    std::vector<unsigned int> constrained_together(std::size_t k,
                                                   const std::vector<char> &active) const;
    void set_entries(std::size_t k, Block &block) const;
    void condense(std::size_t k, Block &block) const;
    void multiply(const std::vector<double> &u, std::vector<double> &f) const;
    void gather_blocks(const std::vector<char> &active);
    void add_springs(const std::vector<char> &active, const std::vector<double> &diagonal,
                     const std::vector<double> &compliance);
    void set_scaling();

    const FactoredStructure &solvers;
    const BodyConstraints &body_constraints;
    bool is_diagonal, is_dirichlet;
    std::vector<Block> blocks;

    // The same on all ranks.
    std::size_t n_dofs = 0;      ///< of all lists b
    SymmetricEntries T;          ///< of formed blocks and springs
    SymmetricEntries substitute; ///< A_k on b for other blocks
    bool has_substitute = false;
    SparseCholesky inverse_T;
    MatrixEntries B;               ///< row of F, DoF
    MatrixEntries scaled_B;        ///< D^-1 B_r, in the same order
    SparseCholesky Q;              ///< of rigid rows, 1 on others
    std::vector<char> is_rigid;    ///< a row of Q
    std::vector<double> other;     ///< 1 / F_ii of active constraints outside Q, else 0
    std::vector<double> own;       ///< the part of other without further treatment
    std::vector<double> stiffness; ///< 1 / S_i of elastic constraints, else 0
    bool has_springs = false;
    mutable std::vector<double> motion, force, jump, scaled, whole, image;
  };
} // namespace taut

#endif
