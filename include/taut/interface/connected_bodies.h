// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_connected_bodies_h
#define taut_connected_bodies_h

#include <taut/interface/constraints.h>

#include <functional>
#include <vector>

namespace taut
{
  /// Groups of bodies connected by constraints, open or closed. Energies are compared within a
  /// group, as other motions say nothing of a contact.
  class ConnectedBodies
  {
  public:
    /// Uses the constraints in their present places. @p connects selects constraints by number;
    /// empty: all. Called by all ranks together.
    ConnectedBodies(const Structure &structure, const Constraints &constraints,
                    const std::function<bool(std::size_t)> &connects = {});

    /// Number of groups over all ranks; the same on each rank.
    std::size_t n_groups() const { return n; }

    std::size_t of_body(const std::size_t k) const { return body[k]; }

    std::size_t of_constraint(const std::size_t i) const { return constraint[i]; }

  private:
    std::size_t n = 0;
    std::vector<std::size_t> body, constraint;
  };
} // namespace taut

#endif
