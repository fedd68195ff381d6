// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_body_constraints_h
#define taut_body_constraints_h

#include <taut/interface/constraints.h>

#include <cstddef>
#include <vector>

namespace taut
{
  /// The constraints by the substructures of this rank that they act on: B_k^T of each.
  class BodyConstraints
  {
  public:
    /// A constraint of B_k^T; all terms of the constraint on this substructure in one form.
    struct Entry
    {
      std::size_t constraint;
      bool varies; ///< moves or turns
      LinearForm form;
    };

    /// The arguments are kept by reference.
    BodyConstraints(const Structure &structure, const Constraints &constraints);

    /// After Constraints::update() or turn(): the constraints that move or turn anew.
    void update();

    std::size_t size() const { return entries.size(); }

    /// Of body k of this rank, as Structure counts them.
    const std::vector<Entry> &operator[](std::size_t k) const { return entries[k]; }

  private:
    void add(std::size_t constraint);

    const Constraints &constraints;
    std::vector<std::vector<Entry>> entries; ///< those that vary are the last ones of each
  };
} // namespace taut

#endif
