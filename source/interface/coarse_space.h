// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_coarse_space_h
#define taut_coarse_space_h

#include <taut/base/sparse_cholesky.h>
#include <taut/interface/body_constraints.h>
#include <taut/substructure/factored_structure.h>

#include <utility>
#include <vector>

namespace taut
{
  /**
   * Deflation of an iteration on F_aa by the rigid body modes of the bodies (Farhat, Chen, Mandel
   * 1995): Z = G^T = B^T R on the active rows, with R the null space vectors of all floating
   * bodies. At large steps A_k has hardly any resistance against R_k, and F the large eigenvalues
   * on Z that an iteration would have to find. With E = Z^T F Z the balancing preconditioner
   * (Mandel 1993) is
   *
   *     M^-1 -> P^T M^-1 P + Z E^-1 Z^T,    P = 1 - F Z E^-1 Z^T.
   *
   * F Z comes from solves on the bodies that a column touches only, and is kept for those whose
   * rows stay the same.
   */
  class CoarseSpace
  {
  public:
    /// The references are kept. Called by all ranks together, as are the others.
    CoarseSpace(const FactoredStructure &solvers, const BodyConstraints &body_constraints);

    /// For the active rows; arguments as for InterfacePreconditioner::setup().
    void setup(const std::vector<char> &active, const std::vector<char> &is_changed,
               const std::vector<double> &compliance);

    /// Number of columns of Z.
    std::size_t size() const { return n_columns; }

    /// Z E^-1 Z^T r, and F times it.
    void solve(const std::vector<double> &r, std::vector<double> &x, std::vector<double> &Fx) const;

    /// z -= Z E^-1 (F Z)^T z: P^T z.
    void project(std::vector<double> &z) const;

  private:
    void set_columns(const std::vector<char> &active);
    void add_responses(std::size_t k, const std::vector<char> &active);
    void factor();

    const FactoredStructure &solvers;
    const BodyConstraints &body_constraints;
    std::vector<std::vector<std::vector<double>>> null_spaces; ///< R of each body of this rank
    std::vector<std::size_t> first_column;                     ///< of each of them
    std::size_t n_columns = 0;

    using Row = std::vector<std::pair<std::size_t, double>>; ///< column and entry
    std::vector<Row> Z;
    std::vector<MatrixEntries> responses; ///< B_k^T A_k^-1 B_k Z of each body of this rank
    MatrixEntries FZ;
    SparseCholesky E;
    mutable std::vector<double> amplitude;
  };
} // namespace taut

#endif
