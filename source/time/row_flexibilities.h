// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_row_flexibilities_h
#define taut_row_flexibilities_h

#include "interface/schur_complement.h"
#include <taut/time/integrator.h>
#include <taut/time/step_parameters.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace taut
{
  /// Upper bound of the largest eigenvalue of the rows @p group of a nonnegative matrix (L.
  /// Collatz, 1942): the largest (G x)_i / x_i for a positive x.
  double largest_eigenvalue(const std::vector<std::vector<double>> &G,
                            const std::vector<std::size_t> &group);

  /// Groups of rows that entries of a symmetric matrix couple.
  std::vector<std::vector<std::size_t>> coupled_rows(const std::vector<std::vector<double>> &G);

  /// F of the bodies in one step of generalised-alpha without springs of the constraints, for
  /// ContactResolution.
  class RowFlexibilities
  {
  public:
    /// @p step in [s]; references are kept. Called, as all functions, by all ranks together.
    RowFlexibilities(const Structure &structure, const Constraints &constraints,
                     const SolverParameters &parameters, double step);

    /// S of the constraints with their dampers [m/N, rad/(N m)].
    const std::vector<double> &compliances() const { return S; }

    /// Factor of M in A [1/s^2].
    double mass_factor() const { return c.mass_factor(); }

    /// B_i^T A^-1 B_i for one body of this rank [m/N, rad/(N m)].
    double of_body(const Term &term) const;

    /// Column i of F with the constraints in @p closed imposed, each with its S; no_link on a rank
    /// that does not have this row.
    void column(std::size_t i, const std::vector<std::size_t> &closed,
                std::vector<double> &result) const;

    /// After a move of the constraints.
    void update_moving() { schur->update_moving(); }

  private:
    void add_modes(std::size_t i, std::vector<double> &result) const;

    const Structure &structure;
    const Constraints &constraints;
    const StepCoefficients c;
    FactoredStructure solvers;
    std::unique_ptr<SchurComplement> schur;
    std::vector<double> S;
  };
} // namespace taut

#endif
