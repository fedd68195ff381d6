// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/substructure/substructure.h>

#include <algorithm>

namespace taut
{
  std::vector<unsigned int> Substructure::constrained_dofs() const
  {
    std::vector<unsigned int> dofs;
    for (const ConstrainedDof &constraint : constrained)
      dofs.push_back(constraint.dof);
    return dofs;
  }

  void Substructure::external_force(const double t, std::vector<double> &P) const
  {
    P = constant_force;
    for (const auto &load : time_loads)
      load->add(t, P);
  }

  void Substructure::finish_constraints()
  {
    std::sort(constrained.begin(), constrained.end(),
              [](const auto &p, const auto &q) { return p.dof < q.dof; });
    for (std::size_t i = 0; i < constrained.size(); ++i)
    {
      if (i > 0 && constrained[i].dof == constrained[i - 1].dof)
        throw UserError(name() +
                        ": two supports hold the same motion of the same point; remove one");
      moving_constraints = moving_constraints || !constrained[i].motion.is_zero();
    }
  }
} // namespace taut
