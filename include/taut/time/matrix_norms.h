// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_matrix_norms_h
#define taut_matrix_norms_h

#include <taut/interface/contact_rows.h>
#include <taut/substructure/structure.h>

#include <array>
#include <string>
#include <vector>

namespace taut
{
  /// One number for displacements, one for slopes and rotations: m and rad, N and N m do not mix.
  using PerKind = std::array<double, 2>;

  /// Largest absolute entries of a vector of a substructure; not-a-number if one is.
  PerKind largest(const Substructure &body, const double *x);
  inline PerKind largest(const Substructure &body, const std::vector<double> &x)
  {
    return largest(body, x.data());
  }

  /// Motions and forces beyond this are no result of a sensible scene; sums and squares of those
  /// below it are finite.
  constexpr double largest_number = 1e100;

  /// Throws an EntryError on the section of the body if one of the largest entries is beyond
  /// largest_number. @p when begins the message.
  void check_size(const Substructure &body, const PerKind &force, const PerKind &displacement,
                  const PerKind &velocity, const std::string &when);

  /// Largest force of a single row on each body, |B_i| |N_i|: their sum may cancel.
  void largest_contact_forces(const Structure &structure, const ContactRows &rows,
                              const std::vector<double> &N, std::vector<PerKind> &result);

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
