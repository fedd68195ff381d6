// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_connected_bodies_h
#define taut_connected_bodies_h

#include <taut/interface/constraints.h>

#include <functional>
#include <vector>

namespace taut
{
  /// The groups of bodies that constraints connect with each other, whether these are closed or
  /// not. Energies are compared within a group: what moves elsewhere says nothing of a contact.
  class ConnectedBodies
  {
  public:
    /// With the constraints where they are now. @p connects: those by their numbers that do; empty:
    /// all of them. Called by all ranks together.
    ConnectedBodies(const Structure &structure, const Constraints &constraints,
                    const std::function<bool(std::size_t)> &connects = {});

    /// Number of groups of all ranks, the same on all of them.
    std::size_t n_groups() const { return n; }

    /// Group of body @p k of this rank.
    std::size_t of_body(const std::size_t k) const { return body[k]; }

    /// Group of constraint @p i.
    std::size_t of_constraint(const std::size_t i) const { return constraint[i]; }

  private:
    std::size_t n = 0;
    std::vector<std::size_t> body, constraint;
  };
} // namespace taut

#endif
