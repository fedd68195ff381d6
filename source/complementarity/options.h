// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_options_h
#define taut_options_h

namespace taut
{
  /// Parameters of the complementarity solvers. All tolerances are relative to the terms of a row.
  ///
  struct ComplementarityOptions
  {
    /**
     * Half-width of the band around N = 0 and D = 0 in which a row keeps its state, relative to the
     * terms s_i of its gap. With 0, a row with exact touch (N = D = 0) flips for ever on rounding
     * errors.
     */
    double dead_band = 1e-13;

    /// Gaps of closed rows are corrected until they are below this tolerance.
    double linear_tolerance = 1e-12;

    /**
     * Tolerance of the gaps, and dead band, of an iterative operator while the active set changes:
     * the solution then only decides which rows flip. A set that repeats is solved to
     * linear_tolerance, and so is a set that repeated in the problem before.
     */
    double inexact_tolerance = 1e-4;

    /// Residual up to which a problem counts as solved, and gaps of dependent rows as consistent.
    double tolerance = 1e-10;

    /// Iterations of the semismooth Newton method before the energy-ordered active set takes over.
    unsigned int max_iterations = 200;

    /// Whether Newton's method stops as soon as an active set comes back, instead of at
    /// max_iterations.
    bool detect_cycles = true;

    /// Multiple of diag(F) that is added to F if closed rows are dependent. Corrections remove its
    /// effect, see max_corrections.
    double redundancy_shift = 1e-9;

    /// Corrections of one active set (proximal if it is redundant) before it counts as
    /// contradictory.
    unsigned int max_corrections = 10;
  };
} // namespace taut

#endif
