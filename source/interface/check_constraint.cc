// SPDX-License-Identifier: LGPL-2.1-or-later
#include "interface/check_constraint.h"
#include "base/text.h"
#include <taut/base/exceptions.h>

#include <algorithm>
#include <cmath>

namespace taut
{
  namespace
  {
    [[noreturn]] void refuse(const ConstraintData &constraint, const std::string &message)
    {
      throw EntryError(constraint.origin, "constraint '" + constraint.name + "': " + message);
    }

    std::string fault_of_size(const std::vector<Term> &terms, const Structure &structure)
    {
      for (const auto &[k, form, of] : terms)
      {
        if (k >= structure.size())
          return "acts on body number " + std::to_string(k) + " of this rank, which has " +
                 std::to_string(structure.size()) + ", counted from 0";
        const std::string fault = form.fault(structure[k].n_dofs());
        if (!fault.empty())
          return fault + ", of body '" + structure[k].name() + "'";
      }
      return "";
    }
  } // namespace

  std::string fault_of(const std::vector<Term> &terms, const Structure &structure)
  {
    for (const auto &[k, form, of] : terms)
      if (k < structure.size() && of && of != &structure[k])
        return "is one on another system, not on its body '" + structure[k].name() +
               "'; take the displacement() of this system";
    return fault_of_size(terms, structure);
  }

  void check_terms(const ConstraintData &constraint, const std::vector<Term> &terms,
                   const Structure &structure)
  {
    const std::string fault = fault_of_size(terms, structure);
    if (!fault.empty())
      refuse(constraint, "its linear form " + fault);
  }

  void check_constraint(const ConstraintData &constraint, const Structure &structure)
  {
    if (const std::string fault = constraint.spring.fault(); !fault.empty())
      refuse(constraint, fault);
    if (!std::isfinite(constraint.gap))
      refuse(constraint, "its gap is " + to_text(constraint.gap) + " m; take a finite one");
    if (const std::string fault = constraint.geometry ? constraint.geometry->fault() : "";
        !fault.empty())
      refuse(constraint, fault);
    for (const std::vector<Term> *const terms : constraint.forms())
      if (const std::string fault = fault_of(*terms, structure); !fault.empty())
        refuse(constraint, "its linear form " + fault);
  }

  bool acts_here(const ConstraintData &constraint)
  {
    const auto is_not_zero = [](const Term &term)
    {
      return std::any_of(term.form.value.begin(), term.form.value.end(),
                         [](const double value) { return value != 0.; });
    };
    if (constraint.kind() == Geometry::Kind::sliding)
      return true;
    for (const std::vector<Term> *const form : constraint.forms())
      if (std::any_of(form->begin(), form->end(), is_not_zero))
        return true;
    return false;
  }
} // namespace taut
