// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_body_constraints_h
#define taut_body_constraints_h

#include <taut/interface/constraints.h>

#include <cstddef>
#include <vector>

namespace taut
{
  /// The constraints on each substructure of this rank: the rows of B_k^T.
  class BodyConstraints
  {
  public:
    /// Row of B_k^T with all terms of a constraint on one substructure.
    struct Entry
    {
      std::size_t constraint;
      bool varies; ///< slides or turns
      LinearForm form;
    };

    /// @p constraints are kept by reference.
    BodyConstraints(const Structure &structure, Lasting<Constraints> constraints);

    /// After Constraints::update() or turn(): updates the sliding and turning constraints.
    void update();

    std::size_t size() const { return entries.size(); }

    /// Constraints on body k of this rank.
    const std::vector<Entry> &operator[](std::size_t k) const { return entries[k]; }

  private:
    void add(std::size_t constraint);

    const Constraints &constraints;
    std::vector<std::vector<Entry>> entries; ///< sliding and turning constraints last
  };
} // namespace taut

#endif
