// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_constrained_body_h
#define taut_constrained_body_h

#include <taut/substructure/symmetric_matrix.h>

#include <memory>
#include <vector>

namespace taut
{
  /// What a Substructure is, too, if it has constraints inside that move with it: impulses then do
  /// not meet its mass matrix alone.
  class ConstrainedBody
  {
  public:
    virtual ~ConstrainedBody() = default;

    /// M [kg, kg m^2] and the conditions that velocities have to meet at the displacement U [m,
    /// rad] from the undeformed body, with the pattern of K: for the local solver of the body.
    virtual std::unique_ptr<SymmetricMatrix> mass_at(const std::vector<double> &U) const = 0;
  };
} // namespace taut

#endif
