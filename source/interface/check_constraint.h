// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_check_constraint_h
#define taut_check_constraint_h

#include <taut/interface/constraints.h>

#include <string>
#include <vector>

namespace taut
{
  /// Checks stiffness > 0, damping >= 0, finite gap and length, and forms on bodies of
  /// @p structure. Throws EntryError with the name of the constraint. Each rank checks its own
  /// terms, for a moving place the last ones.
  void check_constraint(const ConstraintData &constraint, const Structure &structure);

  /// Checks bodies and DoFs in @p terms of a moving place, as bodies may have been linearised.
  void check_terms(const ConstraintData &constraint, const std::vector<Term> &terms,
                   const Structure &structure);

  /// True if the constraint slides, or if a form on this rank is not zero.
  bool acts_here(const ConstraintData &constraint);

  /// Why @p terms are no displacement of bodies of @p structure, for a message; empty: they are.
  std::string fault_of(const std::vector<Term> &terms, const Structure &structure);
} // namespace taut

#endif
