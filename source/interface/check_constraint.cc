// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/base/text.h>
#include <taut/interface/check_constraint.h>

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

    bool is_finite(const Coordinates &place)
    {
      return std::isfinite(place.x) && std::isfinite(place.y) && std::isfinite(place.z);
    }

    void check_spring(const ConstraintData &constraint)
    {
      const double stiffness = constraint.stiffness, damping = constraint.damping;
      if (!(stiffness > 0.))
        refuse(constraint, "its stiffness is " + to_text(stiffness) +
                               " N/m; take a positive one, or none for a rigid constraint");
      if (constraint.law && stiffness != constraint.law->largest_stiffness())
        refuse(constraint, "it has a law and a stiffness, " + to_text(stiffness) +
                               " N/m; the law is that of the spring, so leave the stiffness out");
      if (constraint.law && std::isinf(stiffness))
        refuse(constraint, "the largest stiffness of its law is infinite; take a finite one");
      if (!(damping >= 0.) || std::isinf(damping))
        refuse(constraint, "its damping is " + to_text(damping) +
                               " N s/m; take a finite one that is not negative");
      if (damping > 0. && std::isinf(stiffness))
        refuse(constraint, "its damping, " + to_text(damping) +
                               " N s/m, is beside a spring, and it is rigid; give it a stiffness, "
                               "or no damping");
    }

    template <typename Visitor>
    bool visit_forms(const ConstraintData &constraint, const Visitor &visitor)
    {
      if (!constraint.direction)
        return visitor(constraint.terms);
      const auto &motion = constraint.direction->motion;
      return std::any_of(motion.begin(), motion.end(), visitor);
    }
  } // namespace

  namespace
  {
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
    check_spring(constraint);
    if (!std::isfinite(constraint.gap))
      refuse(constraint, "its gap is " + to_text(constraint.gap) + " m; take a finite one");
    if (const TurningDirection *const turning = constraint.direction.get())
    {
      if (!std::isfinite(turning->length))
        refuse(constraint, "its length is " + to_text(turning->length) + " m; take a finite one");
      if (!is_finite(turning->first.position) || !is_finite(turning->start))
        refuse(constraint, "an end is at no finite place; give its position at U = 0");
    }
    visit_forms(constraint,
                [&](const std::vector<Term> &terms)
                {
                  const std::string fault = fault_of(terms, structure);
                  if (!fault.empty())
                    refuse(constraint, "its linear form " + fault);
                  return false;
                });
  }

  bool acts_here(const ConstraintData &constraint)
  {
    const auto is_not_zero = [](const Term &term)
    {
      return std::any_of(term.form.value.begin(), term.form.value.end(),
                         [](const double value) { return value != 0.; });
    };
    return constraint.place ||
           visit_forms(constraint, [&](const std::vector<Term> &terms)
                       { return std::any_of(terms.begin(), terms.end(), is_not_zero); });
  }
} // namespace taut
