// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_energy_descent_h
#define taut_energy_descent_h

#include "complementarity/dense_operator.h"
#include "complementarity/options.h"
#include "complementarity/problem.h"

namespace taut
{
  /**
   * The primal active-set method (energy-ordered) for a problem without null space;
   * EnergyOrderedActiveSet uses it. The energy 1/2 N^T F N + d^T N falls with every change of the
   * active set, so no set comes back and the method is finite (the argument of Lawson and Hanson,
   * Solving Least Squares Problems, 1974, chapter 23):
   *
   * - Bilateral rows are closed first and remain closed.
   * - The open row with a negative gap and the largest D_i^2 / (2 F_ii) closes.
   * - On the way to the minimum on the new set, the first multiplier that would turn negative ends
   *   the move; its row opens, and the move goes on with the other rows.
   * - A row that depends on the closed rows changes places with one of them: along the direction z
   *   with F z = 0 the energy falls until a multiplier reaches zero. If no multiplier does, the
   *   gaps of the rows with z_i != 0 contradict each other.
   */
  class EnergyDescent
  {
  public:
    explicit EnergyDescent(const ComplementarityOptions &options) : options(options) {}

    /**
     * Sets zero multipliers, and closes independent bilateral rows. Returns false if gaps of
     * dependent bilateral rows contradict the closed rows; contradictory_rows() then names them.
     */
    bool start(const MixedComplementarityProblem &problem, DenseOperator &matrix);

    /**
     * Descends to the minimum, or until 20 (n + 5) rows have been closed, which only rounding can
     * cause. May be called again after the free gaps have changed: it then starts from the
     * multipliers and the set of the last call. Returns false if there is no minimum: the gaps of
     * contradictory_rows() contradict each other.
     */
    bool descend(const MixedComplementarityProblem &problem, DenseOperator &matrix);

    const std::vector<double> &multiplier() const { return multipliers; }

    /// Closed rows in the order in which they closed; they are independent.
    const std::vector<std::size_t> &set() const { return closed_rows; }

    const std::vector<std::size_t> &contradictory_rows() const { return contradiction; }

    /// Changes of the set since start().
    unsigned int n_changes() const { return changes; }

  private:
    std::size_t most_violated() const;
    bool close(std::size_t row);
    bool exchange(std::size_t row);
    bool minimize();

    std::size_t first_zero(double length) const;
    bool move(double length);
    void round_off();
    double largest_residual() const;
    void open(std::size_t position);
    void update_gaps();
    bool is_settled() const;

    double find_null_direction(std::size_t row);
    bool is_rounding(std::size_t row, double null_terms) const;

    ComplementarityOptions options;

    /// Problem and matrix of the current call.
    const MixedComplementarityProblem *problem = nullptr;
    DenseOperator *matrix = nullptr;

    std::vector<double> multipliers, gap, terms, rhs;
    std::vector<double> direction; ///< zero outside the set
    std::vector<std::size_t> closed_rows, contradiction;
    std::vector<char> is_closed;

    /// Rows that could not close because of rounding, until the multipliers move again.
    std::vector<char> blocked;
    unsigned int changes = 0;
  };
} // namespace taut

#endif
