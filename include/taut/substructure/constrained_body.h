// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_constrained_body_h
#define taut_constrained_body_h

#include <taut/substructure/symmetric_matrix.h>

#include <memory>
#include <vector>

namespace taut
{
  /// A second base of a Substructure with inner constraints that move with it, such as a rigid
  /// body. Impulses then meet the mass matrix together with these constraints.
  class ConstrainedBody
  {
  public:
    virtual ~ConstrainedBody() = default;

    /// M [kg, kg m^2] and the conditions on velocities at the displacement U [m, rad] from the
    /// undeformed body, with the pattern of K. The local solver of the body factors this matrix.
    virtual std::unique_ptr<SymmetricMatrix> mass_at(const std::vector<double> &U) const = 0;
  };
} // namespace taut

#endif
