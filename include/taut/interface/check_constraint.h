// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_check_constraint_h
#define taut_check_constraint_h

#include <taut/interface/constraints.h>

#include <string>
#include <vector>

namespace taut
{
  /**
   * Throws EntryError, which names the constraint, for a stiffness that is not positive, a negative
   * damping, a gap or a length that is not finite, or forms that do not fit the bodies of @p
   * structure or are on others. Each rank checks its own terms; the terms of a moving place are the
   * last ones that it gave.
   */
  void check_constraint(const ConstraintData &constraint, const Structure &structure);

  /// The part of it about bodies and DoFs that there are, of forms that the place of a constraint
  /// gives; bodies may have been linearised since then.
  void check_terms(const ConstraintData &constraint, const std::vector<Term> &terms,
                   const Structure &structure);

  /// True if one of the forms is not zero, on this rank.
  bool acts_here(const ConstraintData &constraint);

  /// What makes @p terms no displacement of bodies of @p structure, as a part of a message; empty:
  /// nothing.
  std::string fault_of(const std::vector<Term> &terms, const Structure &structure);
} // namespace taut

#endif
