// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_matrix_norms_h
#define taut_matrix_norms_h

#include <taut/substructure/structure.h>

#include <array>
#include <string>
#include <vector>

namespace taut
{
  /// One number for displacements, one for slopes and rotations: m and rad, N and N m do not mix.
  using PerKind = std::array<double, 2>;

  /**
   * Largest absolute entries of several vectors of one substructure, read side by side and piece by
   * piece; not-a-number if one is.
   */
  template <std::size_t n_vectors>
  class Largest
  {
  public:
    explicit Largest(const Substructure &body);

    /// The next @p n entries of each vector; all pieces but the last are of whole nodes.
    void add(const std::array<const double *, n_vectors> &x, std::size_t n);

    std::array<PerKind, n_vectors> result() const;

  private:
    // Side by side, so that the comparisons do not wait for each other. A comparison loses what is
    // not a number, a sum keeps it.
    static constexpr std::size_t most_lanes = 24;
    using Lanes = std::array<std::array<double, most_lanes>, n_vectors>;

    template <std::size_t lanes>
    void add_rows(const std::array<const double *, n_vectors> &x, std::size_t n);

    const Substructure &body;
    const std::size_t lanes; ///< kinds repeat themselves with them; 0: with none
    Lanes largest = {}, sums = {};
    std::array<PerKind, n_vectors> others = {};
  };

  /// Largest absolute entries of a vector of a substructure; not-a-number if one is. What @p x has
  /// beyond its DoFs is not looked at.
  PerKind largest(const Substructure &body, const std::vector<double> &x);

  /// Motions and forces beyond this are no result of a sensible scene; sums and squares of them
  /// below it are finite.
  constexpr double largest_number = 1e100;

  /// Throws an EntryError on the section of the body if one of the largest entries is beyond
  /// largest_number. @p when begins the message.
  void check_size(const Substructure &body, const PerKind &force, const PerKind &displacement,
                  const PerKind &velocity, const std::string &when);

  /// Mass of each body of this rank that moves as a whole, e . M e with e = 1 for displacements and
  /// 0 for slopes; of bodies with several displacements a node that many times their mass [kg].
  std::vector<double> total_masses(const Structure &structure);

  /**
   * Largest absolute row sums of a matrix by kind of row and column, free DoFs only:
   * bounds |A| |x| from the largest entries of x.
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
