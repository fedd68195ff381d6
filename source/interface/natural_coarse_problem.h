// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_natural_coarse_problem_h
#define taut_natural_coarse_problem_h

#include "interface/interface_preconditioner.h"
#include <taut/base/linear_form.h>
#include <taut/base/sparse_cholesky.h>

#include <taut/interface/row_map.h>

#include <functional>
#include <vector>

namespace taut
{
  /**
   * The natural coarse problem of FETI in statics: multipliers must balance the loads on the rigid
   * body modes of the bodies, G x = e. With the projector on the null space of G,
   *
   *     P = 1 - Q^-1 G^T (G Q^-1 G^T)^-1 G,
   *
   * an iteration on P^T F P keeps the balance of its start, and its remaining gaps are G^T alpha
   * (Farhat and Roux 1991). Q, a flexibility like F, suits bodies of any stiffness and chains of
   * constraints (Bhardwaj, Day, Farhat, Lesoinne, Pierson and Rixen 2000).
   */
  class NaturalCoarseProblem
  {
  public:
    /// Vectors are over the rows of @p blocks, the owned ones among them: @p null_space has a row
    /// of G in each vector, and @p scale a factor for each of its columns, of which only those of
    /// active rows count. @p solve applies Q^-1; zero on rows that are not active.
    /// Other functions take vectors on owned rows. All are called by all ranks together.
    NaturalCoarseProblem(const std::vector<LinearForm> &null_space,
                         const std::vector<double> &scale, const std::vector<double> &active,
                         const RowMap &rows, const RowBlocks &blocks,
                         const std::function<void(std::vector<double> &)> &solve,
                         std::size_t largest_whole_factor);

    /// False if rows of G are dependent: the active rows do not hold a body.
    bool holds_the_bodies() const { return is_definite; }

    /// x += Q^-1 G^T (G Q^-1 G^T)^-1 e.
    void balance(const std::vector<double> &e, std::vector<double> &x) const;

    /// x = P x.
    void project(std::vector<double> &x) const;

    /// r = P^T r.
    void project_residual(std::vector<double> &r) const;

    /// Amplitudes (G Q^-1 G^T)^-1 G Q^-1 r that fit r best.
    std::vector<double> amplitudes(const std::vector<double> &r) const;

  private:
    std::vector<double> products(const std::vector<LinearForm> &forms,
                                 const std::vector<double> &x) const;

    const RowMap &rows;
    std::size_t n_modes;                 ///< of all ranks
    std::vector<std::size_t> mode;       ///< those with entries on the rows of the blocks
    std::vector<LinearForm> G, scaled_G; ///< G Q^-1; a row for each of these modes, of owned rows
    SharedFactor squares;                ///< G Q^-1 G^T
    bool is_definite = false;
  };
} // namespace taut

#endif
