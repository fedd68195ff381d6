// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_matrix_norms_h
#define taut_matrix_norms_h

#include <taut/substructure/substructure.h>

#include <array>
#include <vector>

namespace taut
{
  /// One number for displacements, one for slopes and rotations: m and rad, N and N m do not mix.
  using PerKind = std::array<double, 2>;

  /// Largest absolute entries of a vector of a substructure.
  PerKind largest(const Substructure &body, const std::vector<double> &x);

  /**
   * Largest absolute row sums of a matrix by kind of row and column, free DoFs only: bounds |A| |x|
   * from the largest entries of x.
   */
  class KindNorm
  {
  public:
    KindNorm(const Substructure &body, const SymmetricMatrix &matrix);

    /// Upper bound of (|A| |x|) for each kind of row.
    PerKind times(const PerKind &x) const;

  private:
    std::array<PerKind, 2> sums;
  };
} // namespace taut

#endif
