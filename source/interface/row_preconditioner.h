// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_row_preconditioner_h
#define taut_row_preconditioner_h

#include <taut/base/sparse_cholesky.h>
#include <taut/interface/body_rows.h>
#include <taut/substructure/factored_structure.h>

#include <string>
#include <vector>

namespace taut
{
  /**
   * A cheap approximation of F^-1 on an active set, by name. With b the DoFs of body k that active
   * rows act on and D the diagonal of S_k,
   *
   *     "diagonal"   1 / F_ii
   *     "lumped"     S_k = A_k on b
   *     "Dirichlet"  S_k = the Schur complement of A_k on b: what b feels of the body when the rest
   *                  of it follows
   *
   *     L = Q^-1 (sum_k B_k^T D^-1 S_k D^-1 B_k) Q^-1,    Q = diag(sum_k B_k^T D^-1 B_k).
   *
   * Q makes the preconditioner split a jump between the bodies that meet there; where no two rows
   * share a DoF and D is the same on both sides it is the (B^T B)^-1 scaling of FETI (Rixen and
   * Farhat 1999 for unequal sides). L approximates F without compliance, so the whole is (L^-1 +
   * S)^-1 = L - L S^1/2 (1 + S^1/2 L S^1/2)^-1 S^1/2 L with a sparse factor in row space: elastic
   * and moving rows are treated like cuts.
   */
  class RowPreconditioner
  {
  public:
    /// The references are kept. Throws UserError for an unknown name.
    RowPreconditioner(const std::string &name, const FactoredStructure &solvers,
                      const BodyRows &body_rows);

    /// For the active rows. The bodies marked in @p is_changed have another A_k or other rows than
    /// at the last call. @p diagonal is that of F.
    void setup(const std::vector<char> &active, const std::vector<char> &is_changed,
               const std::vector<double> &compliance, const std::vector<double> &diagonal);

    /// z = M^-1 r; zero on rows that are not active.
    void apply(const std::vector<double> &r, std::vector<double> &z) const;

    /// Bodies factored for a Schur complement so far.
    long n_factorisations() const { return factorisations; }

  private:
    /// S_k, by position in the list of DoFs b, and where it acts.
    struct Block
    {
      std::vector<unsigned int> dofs;
      SymmetricEntries entries;
      std::vector<double> inverse_diagonal; ///< D^-1; 0 where the body resists nothing
    };

    void compute_block(std::size_t k, const std::vector<char> &active);
    void condense(std::size_t k, Block &block) const;
    void assemble(const std::vector<char> &active, const std::vector<double> &diagonal);
    void factor_compliant_part(const std::vector<double> &compliance);

    const FactoredStructure &solvers;
    const BodyRows &body_rows;
    bool is_diagonal, is_dirichlet;
    std::vector<Block> blocks;
    SymmetricEntries L;
    std::vector<double> own; ///< 1 / F_ii of active rows that L does not reach
    std::vector<double> root_compliance;
    bool has_compliance = false;
    SparseCholesky compliant_part; ///< of 1 + S^1/2 L S^1/2
    long factorisations = 0;
    mutable std::vector<double> work, image;
  };
} // namespace taut

#endif
