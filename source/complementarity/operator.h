// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_complementarity_operator_h
#define taut_complementarity_operator_h

#include <taut/base/linear_form.h>

#include <cstddef>
#include <vector>

namespace taut
{
  class SharedRows;

  /**
   * The symmetric positive semidefinite matrix F of a mixed complementarity problem, as its solvers
   * see it: n rows, one per multiplier. In Taut F is the contact Schur complement, F = sum_k B_k^T
   * A_k^-1 B_k + S. Derive from it to bring another representation of F.
   */
  class ComplementarityOperator
  {
  public:
    virtual ~ComplementarityOperator() = default;

    /// Number of rows n.
    virtual std::size_t size() const = 0;

    /// F_ii, not negative.
    virtual double diagonal(std::size_t i) const = 0;

    /// y = F x; y is resized.
    virtual void apply(const std::vector<double> &x, std::vector<double> &y) const = 0;

    /**
     * An upper bound y_i >= sum_j |F_ij| |x_j|, the scale of the rounding error of row i of F x.
     * Exact if the entries are stored; otherwise from |F_ij| <= sqrt(F_ii F_jj), which holds for
     * every semidefinite F.
     */
    virtual void apply_absolute(const std::vector<double> &x, std::vector<double> &y) const = 0;

    /**
     * Solves F_aa x_a = rhs_a on the ordered rows @p set; x is zero on all other rows. With @p
     * shift > 0 solves (F_aa + shift diag(F_aa)) x_a = rhs_a. Returns false, with x unspecified, if
     * the rows are dependent to working precision: the system is then not solved.
     */
    virtual bool solve(const std::vector<std::size_t> &set, const std::vector<double> &rhs,
                       double shift, std::vector<double> &x) = 0;

    /**
     * F_ii - F_ia F_aa^-1 F_ai of the rows @p wanted with the ordered rows a of @p set, 0
     * elsewhere: what row i moves under a unit multiplier while the rows of the set remain closed.
     * Dependent rows of the set are solved with the @p shift. The default takes one product and one
     * solve() for each wanted row. Where rows are @p shared, the wanted ones are the same on all
     * ranks, and SharedRows::elsewhere on a rank that does not have them.
     */
    virtual void condensed_diagonal(const std::vector<std::size_t> &wanted,
                                    const std::vector<std::size_t> &set, double shift,
                                    const SharedRows *shared, std::vector<double> &result);

    /**
     * Solves
     *
     *     F_aa x_a + G_a^T alpha = rhs_a,    G_a x_a = load
     *
     * where each vector of @p null space is a row of G; otherwise as solve(). Returns false, too,
     * if the rows of the set do not hold a body. Called only if has_null_space_solver() is true;
     * other operators take one solve() per null space vector.
     */
    virtual bool solve_with_null_space(const std::vector<std::size_t> & /*set*/,
                                       const std::vector<double> & /*rhs*/,
                                       const std::vector<LinearForm> & /*null_space*/,
                                       const std::vector<double> & /*load*/, double /*shift*/,
                                       std::vector<double> & /*x*/, std::vector<double> & /*alpha*/)
    {
      return false;
    }
    virtual bool has_null_space_solver() const { return false; }

    /// True if an iteration solves the systems, to the tolerance set last.
    virtual bool is_iterative() const { return false; }

    /// Largest residual of the solves to come, in rows scaled to F_ii = 1 and relative to the
    /// largest entry of right-hand side or solution; 0: the smallest that rounding allows, as at
    /// first. Without effect where is_iterative() is false.
    virtual void set_tolerance(double /*tolerance*/) {}
  };
} // namespace taut

#endif
