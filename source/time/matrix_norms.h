// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_matrix_norms_h
#define taut_matrix_norms_h

#include <taut/substructure/structure.h>

#include <array>
#include <string>
#include <vector>

namespace taut
{
  /// One number for displacements, one for slopes and rotations: their units differ.
  using ByKind = std::array<double, 2>;

  /// Largest absolute entries of a vector of a substructure; not-a-number if an entry is. Entries
  /// of @p x beyond its DoFs are ignored.
  ByKind max_norms(const Substructure &body, const double *x);
  inline ByKind max_norms(const Substructure &body, const std::vector<double> &x)
  {
    return max_norms(body, x.data());
  }

  /// The largest entry on the diagonal; 0 if none is positive.
  double largest_on_diagonal(const SymmetricMatrix &matrix);

  /// Larger motions and forces are no result of a sensible scene. Sums and squares of smaller
  /// numbers are finite.
  constexpr double largest_number = 1e100;

  /// Throws an EntryError on the section of the body if one of the largest entries exceeds
  /// largest_number. @p when begins the message.
  void check_size(const Substructure &body, const ByKind &force, const ByKind &displacement,
                  const ByKind &velocity, const std::string &when);

  /// Mass of each body of this rank in translation, e . M e with e = 1 for displacements and 0 for
  /// slopes. A body with several displacements a node counts that many times its mass [kg].
  std::vector<double> total_masses(const Structure &structure);

  /// Largest absolute row sums of a matrix by kind of row and column, for free DoFs only. With the
  /// largest entries of x they bound |A| |x|.
  class RowSumNorm
  {
  public:
    RowSumNorm(const Substructure &body, const SymmetricMatrix &matrix);

    /// Upper bound of |A| |x| for each kind of row.
    ByKind times(const ByKind &x) const;

  private:
    std::array<ByKind, 2> sums;
  };
} // namespace taut

#endif
