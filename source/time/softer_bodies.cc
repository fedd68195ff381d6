// SPDX-License-Identifier: LGPL-2.1-or-later
#include "softer_bodies.h"

#include <taut/base/exceptions.h>
#include <taut/substructure/local_solver.h>
#include <taut/substructure/slender_body.h>

#include <algorithm>
#include <cmath>

namespace taut
{
  namespace
  {
    /// Part of the largest stiffness over mass that is added as mass where a tangent is not
    /// definite, and by how much it grows from attempt to attempt.
    constexpr double first_shift = 1e-10, growth_of_shift = 30.;

    /// The same part below which it is rounding of a tangent that is definite or has no stiffness:
    /// of a cable with a compression of about as small a part of its axial stiffness.
    constexpr double indifferent = 1e-8;

    double largest_on_diagonal(const SymmetricMatrix &matrix)
    {
      double largest = 0.;
      matrix.visit(
          [&](const unsigned int i, const unsigned int j, const double value)
          {
            if (i == j)
              largest = std::max(largest, value);
          });
      return largest;
    }
  } // namespace

  void add_some_mass(const int attempt, const SymmetricMatrix &M, SymmetricMatrix &K)
  {
    if (attempt < 2)
      return;
    K.add(first_shift * std::pow(growth_of_shift, attempt - 2) * largest_on_diagonal(K) /
              largest_on_diagonal(M),
          M);
  }

  SofterBodies::SofterBodies(const Structure &structure)
      : structure(structure), softer(structure.size())
  {
    for (std::size_t k = 0; k < structure.size(); ++k)
      if (!structure[k].is_linear())
        nonlinear.push_back(k);
  }

  double SofterBodies::largest_axial_stiffness() const
  {
    double largest = 0.;
    for (const std::size_t k : nonlinear)
      if (const auto *const slender = dynamic_cast<const SlenderBody *>(&structure[k]))
        largest = std::max(largest, slender->axial_stiffness());
    return largest;
  }

  void SofterBodies::limit_axial_stiffness(const double EA)
  {
    for (const std::size_t k : nonlinear)
    {
      softer[k] = nullptr;
      if (const auto *const slender = dynamic_cast<const SlenderBody *>(&structure[k]))
        if (slender->axial_stiffness() > EA)
          softer[k] = slender->with_axial_stiffness(EA);
    }
  }

  double SofterBodies::energy(const std::size_t k, const std::vector<double> &U) const
  {
    return body(k).strain_energy(U);
  }

  void SofterBodies::force(const std::size_t k, const std::vector<double> &U,
                           std::vector<double> &f) const
  {
    body(k).internal_force(U, {}, f);
  }

  bool SofterBodies::are_indifferent(const BodyVectors &U) const
  {
    for (const std::size_t k : nonlinear)
    {
      const Substructure &own = structure[k];
      const double mass = largest_on_diagonal(own.mass());
      if (dynamic_cast<const SlenderBody *>(&own) == nullptr || !(mass > 0.))
        return false;
      const std::unique_ptr<SymmetricMatrix> K = own.tangent(U[k], 0., false);
      try
      {
        make_local_solver("block tridiagonal", *K)
            ->factor({{1., K.get()}, {indifferent * largest_on_diagonal(*K) / mass, &own.mass()}},
                     own.constrained_dofs());
      }
      catch (const BodyNotHeld &)
      {
        return false;
      }
    }
    return true;
  }

  bool SofterBodies::are_in_tension(const BodyVectors &U) const
  {
    return std::all_of(nonlinear.begin(), nonlinear.end(),
                       [&](const std::size_t k)
                       {
                         const auto *const slender =
                             dynamic_cast<const SlenderBody *>(&structure[k]);
                         return slender && slender->is_in_tension(U[k]);
                       });
  }

  std::unique_ptr<SymmetricMatrix>
  SofterBodies::tangent(const std::size_t k, const std::vector<double> &U, const int attempt) const
  {
    std::unique_ptr<SymmetricMatrix> K = body(k).tangent(U, 0., attempt > 0);
    add_some_mass(attempt, body(k).mass(), *K);
    return K;
  }
} // namespace taut
