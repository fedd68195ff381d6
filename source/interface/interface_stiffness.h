// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_interface_stiffness_h
#define taut_interface_stiffness_h

#include <taut/base/sparse_cholesky.h>
#include <taut/interface/constraint_operator.h>
#include <taut/substructure/factored_structure.h>

#include <memory>
#include <vector>

namespace taut
{
  /**
   * The stiffness T = sum_k T_k of all bodies at the DoFs b of active constraints, and the forms B
   * of the constraints on these DoFs. Use it where a preconditioner needs stiffnesses at the
   * constraints in place of the bodies. T_k is the Schur complement of A_k on b.
   *
   * The Schur complement of a body with many such DoFs is not formed, but applied with a factor of
   * the rest of the body. It takes the DoFs of all constraints, active or not, so that the factor
   * stays as long as A_k does, unless it follows the sets: T is then exact on the DoFs of active
   * constraints, and new with each set. Where entries are needed, A_k on b stands for it.
   */
  class InterfaceStiffness
  {
  public:
    /// The references are kept.
    InterfaceStiffness(const FactoredStructure &solvers, const BodyConstraints &body_constraints);

    /// All A_k are new.
    void reset() { blocks = std::vector<Block>(blocks.size()); }

    /// From the next setup() on, for bodies that have changed.
    void follow_sets(const bool follow) { follows_sets = follow; }

    /// Bodies of this rank whose Schur complement is applied; with @p coarse only those for which
    /// it takes more DoFs than the active constraints have.
    std::vector<std::size_t> applied_bodies(const std::vector<char> &active, bool coarse) const;

    /// See InterfacePreconditioner::setup(). T and B of the bodies of this rank, with which no
    /// others are coupled. Called by all ranks together.
    void setup(const std::vector<char> &active, const std::vector<char> &is_changed);

    /// Number of DoFs in the lists b, and the forms B in order of the numbers of their rows.
    std::size_t n_dofs() const { return n_constrained; }
    const MatrixEntries &constraints() const { return B; }

    /// T with entries for all its bodies, and its diagonal.
    SymmetricEntries entries() const;
    std::vector<double> diagonal() const;

    /// f = T u.
    void multiply(const std::vector<double> &u, std::vector<double> &f) const;

  private:
    /// T_k, by position in the list of DoFs b.
    struct Block
    {
      std::vector<unsigned int> dofs;
      SymmetricEntries entries;
      std::size_t first = 0; ///< position of its first DoF in the lists

      /// Solver of the other DoFs, if the Schur complement is applied and not formed.
      std::unique_ptr<LocalSolver> interior;
    };

    void compute_block(std::size_t k, const std::vector<char> &active);
    std::vector<unsigned int> constrained_together(std::size_t k,
                                                   const std::vector<char> &active) const;
    void set_entries(std::size_t k, Block &block) const;
    void condense(std::size_t k, Block &block) const;
    void apply_substituted(const std::vector<double> &u, std::vector<double> &f) const;

    const FactoredStructure &solvers;
    const BodyConstraints &body_constraints;
    std::vector<Block> blocks;
    bool follows_sets = false;
    std::size_t n_constrained = 0;
    SymmetricEntries T;          ///< formed blocks
    SymmetricEntries substitute; ///< A_k on b of blocks that are not formed
    MatrixEntries B;             ///< number of the row of F, DoF
    mutable std::vector<double> whole, image;
  };
} // namespace taut

#endif
