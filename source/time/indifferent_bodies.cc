// SPDX-License-Identifier: LGPL-2.1-or-later
#include "time/indifferent_bodies.h"

#include "time/matrix_norms.h"
#include <taut/base/exceptions.h>
#include <taut/substructure/body_traits.h>
#include <taut/substructure/local_solver.h>

namespace taut
{
  namespace
  {
    /// Part of the largest stiffness over mass below which a tangent that is not definite is
    /// definite but for rounding: of a cable with a compression of about as small a part of its
    /// axial stiffness.
    constexpr double indifferent = 1e-8;

    bool is_indifferent(const Substructure &body, const std::vector<double> &U)
    {
      const double mass = largest_on_diagonal(body.mass());
      if (dynamic_cast<const SlenderBody *>(&body) == nullptr || !(mass > 0.))
        return false;
      const std::unique_ptr<SymmetricMatrix> K = body.tangent(U, {}, 0., false);
      try
      {
        make_local_solver("block tridiagonal", *K)
            ->factor({{1., K.get()}, {indifferent * largest_on_diagonal(*K) / mass, &body.mass()}},
                     body.constrained_dofs());
      }
      catch (const BodyNotHeld &)
      {
        return false;
      }
      return true;
    }
  } // namespace

  bool are_indifferent(const Structure &structure, const BodyVectors &U)
  {
    for (std::size_t k = 0; k < structure.size(); ++k)
      if (!structure[k].is_linear() && !is_indifferent(structure[k], U[k]))
        return false;
    return true;
  }

  bool are_in_tension(const Structure &structure, const BodyVectors &U)
  {
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      const auto *const slender = dynamic_cast<const SlenderBody *>(&structure[k]);
      if (!structure[k].is_linear() && !(slender && slender->is_in_tension(U[k])))
        return false;
    }
    return true;
  }
} // namespace taut
