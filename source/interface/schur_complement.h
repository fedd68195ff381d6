// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_schur_complement_h
#define taut_schur_complement_h

#include "complementarity/operator.h"
#include <taut/interface/constraints.h>
#include <taut/interface/interface_parameters.h>
#include <taut/substructure/factored_structure.h>

#include <memory>
#include <string>
#include <vector>

namespace taut
{
  /// Cost of the iterative solution of systems with F so far; all 0 if F is assembled.
  struct InterfaceStatistics
  {
    long n_systems = 0;      ///< solved systems with F
    long n_iterations = 0;   ///< of conjugate gradients
    long n_applications = 0; ///< products with F
    long n_local_solves = 0; ///< systems with one A_k in these products, on this rank

    InterfaceStatistics &operator+=(const InterfaceStatistics &other);
  };

  /**
   * The contact Schur complement F = sum_k B_k^T A_k^-1 B_k + S of the constraints [m/N, rad/(N
   * m)], the interface operator of FETI (C. Farhat, F.-X. Roux, Int. J. Numer. Meth. Engng 32
   * (1991)). It is matrix-free, or assembled: dense or sparse.
   */
  class SchurComplement
  {
  public:
    virtual ~SchurComplement() = default;

    /// After a change of A_k: sets F up with compliances S (diagonal, [m/N, rad/(N m)]).
    virtual void setup(const std::vector<double> &S) = 0;

    /// After a change of the compliances alone: updates the diagonal.
    virtual void set_compliance(const std::vector<double> &S) = 0;

    /// After Constraints::update() or turn(): updates the sliding and turning constraints.
    virtual void update_moving() = 0;

    /// The part of this rank in the motion d = B^T A^-1 P of the constraints under forces P, and in
    /// the rounding scale of d, the sum of its absolute terms [m, rad].
    virtual void contact_free_predictor(const BodyVectors &P, std::vector<double> &d,
                                        std::vector<double> &terms_size) const = 0;

    /// F for the complementarity solver.
    virtual ComplementarityOperator &matrix() = 0;

    /// Form and size, for the log; after setup().
    virtual std::string description() const = 0;

    virtual InterfaceStatistics statistics() const { return {}; }
  };

  /// Whether F is matrix-free on several ranks, by name, or at rest with so many rows that it is by
  /// itself: the ranks then do better to have their own rows, see Constraints::distribute(). Of
  /// linear bodies without turning constraints. Called by all ranks together.
  bool suits_distributed_rows(const InterfaceParameters &parameters, const Structure &structure,
                              const Constraints &constraints, bool is_at_rest);

  /// Throws UserError for unknown names; std::invalid_argument if constraints are distributed and
  /// F is assembled by name. The arguments are kept by reference.
  std::unique_ptr<SchurComplement> make_schur_complement(const InterfaceParameters &parameters,
                                                         const FactoredStructure &solvers,
                                                         const Constraints &constraints);
} // namespace taut

#endif
