// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/text.h>
#include <taut/interface/constraint_spring.h>

namespace taut
{
  double ConstraintSpring::force(const double u) const
  {
    return law ? law->force(u) : u * stiffness;
  }

  double ConstraintSpring::compression(const double N) const
  {
    return law ? law->elongation(N) : N / stiffness;
  }

  double ConstraintSpring::energy(const double u) const
  {
    return law ? law->energy(u) : is_rigid() ? 0. : .5 * stiffness * u * u;
  }

  std::string ConstraintSpring::fault() const
  {
    if (!(stiffness > 0.))
      return "its stiffness is " + to_text(stiffness) +
             " N/m; take a positive one, or none for a rigid constraint";
    if (law && stiffness != law->largest_stiffness())
      return "it has a law and a stiffness, " + to_text(stiffness) +
             " N/m; the law is that of the spring, so leave the stiffness out";
    if (law && is_rigid())
      return "the largest stiffness of its law is infinite; take a finite one";
    if (!(damping >= 0.) || std::isinf(damping))
      return "its damping is " + to_text(damping) +
             " N s/m; take a finite one that is not negative";
    if (damping > 0. && is_rigid())
      return "its damping, " + to_text(damping) +
             " N s/m, is beside a spring, and it is rigid; give it a stiffness, or no damping";
    return "";
  }
} // namespace taut
