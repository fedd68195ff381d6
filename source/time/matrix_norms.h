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

  /// Largest absolute entries of several vectors of one substructure, read together in pieces;
  /// not-a-number if an entry is.
  template <std::size_t n_vectors>
  class Largest
  {
  public:
    explicit Largest(const Substructure &body);

    /// Adds the next @p n entries of each vector; all pieces but the last consist of whole nodes.
    void add(const std::array<const double *, n_vectors> &x, std::size_t n);

    /// To be called once, after the last piece.
    std::array<ByKind, n_vectors> result();

  private:
    // Independent lanes compare in parallel. A comparison loses not-a-number, a sum keeps it.
    static constexpr std::size_t most_lanes = 24;
    using Lanes = std::array<std::array<double, most_lanes>, n_vectors>;

    template <std::size_t lanes>
    void add_rows(const std::array<const double *, n_vectors> &x, std::size_t n);

    const Substructure &body;
    const std::size_t period, lanes; ///< of kinds; a multiple of it, or 0: no lanes
    Lanes largest, sums;
    std::array<ByKind, n_vectors> others = {};
  };

  /// Largest absolute entries of a vector of a substructure; not-a-number if an entry is. Entries
  /// of @p x beyond its DoFs are ignored.
  ByKind largest(const Substructure &body, const std::vector<double> &x);

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
