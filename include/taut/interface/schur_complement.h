// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_schur_complement_h
#define taut_schur_complement_h

#include <taut/complementarity/operator.h>
#include <taut/interface/constraints.h>
#include <taut/substructure/factored_structure.h>

#include <memory>
#include <string>
#include <vector>

namespace taut
{
  /// How systems with F are solved, by name.
  struct InterfaceParameters
  {
    /// "assembled dense", "condensed" (dense without the columns A_k^-1 B_k), "assembled sparse",
    /// "matrix-free", or "automatic" for the form that suits number of constraints and step.
    std::string form = "automatic";

    /// Of the matrix-free form: "diagonal", "lumped", "Dirichlet".
    std::string preconditioner = "Dirichlet";

    /// Of the matrix-free form: "rigid body modes" of the floating bodies, or "none".
    std::string coarse_space = "rigid body modes";
  };

  /// What the iterative solution of systems with F has cost so far; all 0 where F is assembled.
  struct InterfaceStatistics
  {
    long n_systems = 0;      ///< solved
    long n_iterations = 0;   ///< of conjugate gradients
    long n_applications = 0; ///< products with F
    long n_local_solves = 0; ///< systems of one A_k for these products, on this rank

    InterfaceStatistics &operator+=(const InterfaceStatistics &other);
  };

  /**
   * The contact Schur complement F = sum_k B_k^T A_k^-1 B_k + S of the constraints [m/N, rad/(N
   * m)], the interface operator of FETI (C. Farhat, F.-X. Roux, Int. J. Numer. Meth. Engng 32
   * (1991)), in one of four forms: assembled dense or sparse, with the columns A_k^-1 B_k of the
   * fixed constraints stored once, condensed, which is dense without these, or matrix-free.
   */
  class SchurComplement
  {
  public:
    virtual ~SchurComplement() = default;

    /// After a change of A_k or of the compliances S (diagonal, [m/N, rad/(N m)]): everything anew.
    virtual void setup(const std::vector<double> &S) = 0;

    /// After a change of the compliances alone: only the diagonal changes.
    virtual void set_compliance(const std::vector<double> &S) = 0;

    /// After Constraints::update() or turn(): the constraints that move or turn anew.
    virtual void update_moving() = 0;

    /// d = B^T A^-1 P, the motion of the constraints under forces P, and the sum of the absolute
    /// terms that each d_i was summed from and rounds with [m, rad]: the shares of this rank.
    virtual void contact_free_predictor(const BodyVectors &P, std::vector<double> &d,
                                        std::vector<double> &terms_size) const = 0;

    /// F, for the complementarity solver.
    virtual ComplementarityOperator &matrix() = 0;

    /// Form and size, for the log; after setup().
    virtual std::string description() const = 0;

    virtual InterfaceStatistics statistics() const { return {}; }
  };

  /// Throws UserError for unknown names. The references are kept.
  std::unique_ptr<SchurComplement> make_schur_complement(const InterfaceParameters &parameters,
                                                         const FactoredStructure &solvers,
                                                         const Constraints &constraints);
} // namespace taut

#endif
