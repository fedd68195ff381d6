// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_softer_bodies_h
#define taut_softer_bodies_h

#include <taut/substructure/structure.h>

#include <memory>
#include <vector>

namespace taut
{
  /// K += a part of the mass matrix that grows with @p attempt from 2 on; before, nothing. Makes a
  /// tangent that is not definite into one that is.
  void add_some_mass(int attempt, const SymmetricMatrix &M, SymmetricMatrix &K);

  /// The bodies of this rank at rest, with slender ones as soft along their axis as a search of an
  /// equilibrium wants them.
  class SofterBodies
  {
  public:
    /// @p structure is kept by reference. Bodies have their own stiffness.
    explicit SofterBodies(const Structure &structure);

    /// Of the bodies that are not linear; 0: of none [N].
    double largest_axial_stiffness() const;

    /// From now on no axial stiffness is larger than @p EA [N]; infinite: all are their own.
    void limit_axial_stiffness(double EA);

    /// The bodies of this rank that are not linear.
    const std::vector<std::size_t> &nonlinear_bodies() const { return nonlinear; }

    /// Energy [J], internal force [N, N m] and tangent of body k at a displacement U from the
    /// undeformed body; @p attempt as in NonlinearBodies::tangent().
    double energy(std::size_t k, const std::vector<double> &U) const;
    void force(std::size_t k, const std::vector<double> &U, std::vector<double> &f) const;
    std::unique_ptr<SymmetricMatrix> tangent(std::size_t k, const std::vector<double> &U,
                                             int attempt) const;

    /// True if all of them are slender, and their own tangents at @p U are definite but for
    /// rounding: what a motion costs no energy of is no tension, as of a cable that lies slack.
    bool are_indifferent(const BodyVectors &U) const;

    /// True if all of them are slender and in tension at @p U but at free ends.
    bool are_in_tension(const BodyVectors &U) const;

  private:
    const Substructure &body(std::size_t k) const { return softer[k] ? *softer[k] : structure[k]; }

    const Structure &structure;
    std::vector<std::size_t> nonlinear;
    std::vector<std::unique_ptr<Substructure>> softer; ///< of each body, or null
  };
} // namespace taut

#endif
