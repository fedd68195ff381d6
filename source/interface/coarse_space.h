// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_coarse_space_h
#define taut_coarse_space_h

#include "interface/shared_factor.h"
#include <taut/base/sparse_cholesky.h>
#include <taut/interface/constraint_operator.h>
#include <taut/substructure/factored_structure.h>

#include <utility>
#include <vector>

namespace taut
{
  /**
   * Deflation of an iteration on F_aa by the rigid body modes of the bodies (Farhat, Chen, Mandel
   * 1995): Z = G^T = B^T R on the active rows, with R the null space vectors of all floating
   * bodies. At large steps A_k has little resistance against R_k, so that F has large eigenvalues
   * on Z. With E = Z^T F Z the balancing preconditioner (Mandel 1993) is
   *
   *     M^-1 -> P^T M^-1 P + Z E^-1 Z^T,    P = 1 - F Z E^-1 Z^T.
   *
   * F Z needs solutions only for bodies at a column, and none for bodies with unchanged rows.
   */
  class CoarseSpace
  {
  public:
    /// The references are kept. Called, as all functions, by all ranks together.
    CoarseSpace(const FactoredStructure &solvers, const BodyConstraints &body_constraints,
                std::size_t largest_whole_factor);

    /// Sets up for the active rows, with the arguments of InterfacePreconditioner::setup().
    void setup(const RowMap &rows, const std::vector<char> &active,
               const std::vector<char> &is_changed, const std::vector<double> &compliance);

    /// Number of columns of Z.
    std::size_t size() const { return n_columns; }

    /// Computes x = Z E^-1 Z^T r and F x, on owned rows.
    void solve(const RowMap &rows, const std::vector<double> &r, std::vector<double> &x,
               std::vector<double> &Fx) const;

    /// z = P^T z = z - Z E^-1 (F Z)^T z, on owned rows.
    void project(const RowMap &rows, std::vector<double> &z) const;

  private:
    using Row = std::vector<std::pair<std::size_t, double>>; ///< column and entry

    void set_columns(const RowMap &rows, const std::vector<char> &active);
    void set_rows(const RowMap &rows, MatrixEntries &entries, std::vector<Row> &result) const;
    void add_responses(std::size_t k, const std::vector<char> &active);
    void factor(const RowMap &rows);

    const FactoredStructure &solvers;
    const BodyConstraints &body_constraints;
    std::vector<std::vector<std::vector<double>>> null_spaces; ///< R of each body of this rank
    std::vector<std::size_t> first_column;                     ///< first column of each body
    std::size_t n_columns = 0;

    std::vector<std::size_t> position;    ///< of a constraint among the held rows
    std::vector<Row> Z, FZ;               ///< the held rows
    std::vector<MatrixEntries> responses; ///< B_k^T A_k^-1 B_k Z of each body of this rank
    SharedFactor E;
    mutable std::vector<double> amplitude;
  };
} // namespace taut

#endif
