// SPDX-License-Identifier: LGPL-2.1-or-later
#include "time/mass_equations.h"
#include <taut/substructure/body_traits.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace taut
{
  namespace
  {
    /// Part of F_ii above which S fades the projection of elastic constraints out. There the
    /// contact of a mass with the spring lasts 0.9 steps: S / F_ii = 4 / (omega step)^2. Stiffer
    /// springs act like a rigid constraint, softer ones are resolved by steps.
    constexpr double fading = .3;

    /// Most coefficients whose flexibilities are kept: more than there are lengths of adaptive
    /// steps.
    constexpr std::size_t most_known = 16;

    /// Systems with M are well conditioned and need no better preconditioner.
    InterfaceParameters for_mass(InterfaceParameters parameters)
    {
      parameters.preconditioner = "diagonal";
      parameters.coarse_space = "none";
      return parameters;
    }
  } // namespace

  MassEquations::MassEquations(const Structure &structure, const Constraints &constraints,
                               const SolverParameters &parameters, const Reference &reference)
      : structure(structure), constraints(constraints), reference(reference),
        solvers(structure, parameters.local_solver),
        schur(make_schur_complement(for_mass(parameters.interface), solvers, constraints)),
        bodies(constraints)
  {
    for (std::vector<double> *v : {&flexibility, &of_mass, &relative, &compliances})
      v->assign(constraints.size(), 0.);
    for (std::size_t k = 0; k < structure.size(); ++k)
      if (dynamic_cast<const ConstrainedBody *>(&structure[k]))
        with_constraints.push_back(k);
    some_with_constraints = structure.communicator().any(!with_constraints.empty());
  }

  void MassEquations::prepare(const StepCoefficients &c, const std::vector<double> &S,
                              ComplementarityOperator &F, const bool is_linear)
  {
    theta = 1. - c.alpha_f;
    if (!is_linear || known.size() == most_known)
      known.clear();
    elastic.clear();
    moving_elastic.clear();
    for (std::size_t i = 0; i < constraints.size(); ++i)
      if (constraints[i].cone.may_open() && S[i] > 0.)
      {
        elastic.push_back(i);
        has_laws = has_laws || constraints[i].spring.law;
        if (constraints.slides(i))
          moving_elastic.push_back(i);
      }
    has_laws = constraints.any(has_laws);
    some_elastic = constraints.any(!elastic.empty());
    const auto before =
        std::find_if(known.begin(), known.end(), [&](const Known &one) { return one.c == c; });
    if (before != known.end())
      flexibility = before->flexibility;
    else
    {
      find_flexibilities(elastic, S, F);
      known.push_back({c, flexibility});
    }
    set_relative(S);
    if (is_set_up)
      set_up();
  }

  void MassEquations::find_flexibilities(const std::vector<std::size_t> &rows,
                                         const std::vector<double> &S, ComplementarityOperator &F)
  {
    const std::vector<double> &diagonal = bodies.flexibilities(rows, F);
    for (const std::size_t i : rows)
      flexibility[i] = (diagonal[i] - S[i]) / theta;
  }

  void MassEquations::set_relative(const std::vector<double> &S)
  {
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      relative[i] = 0.;
      if (!constraints[i].cone.may_open() || S[i] == 0.)
        continue;
      const double ratio = S[i] / (fading * flexibility[i]);
      relative[i] = constraints[i].spring.conserving ? std::numeric_limits<double>::infinity()
                                                     : ratio * ratio;
    }
  }

  void MassEquations::follow(const std::vector<double> &S, ComplementarityOperator &F)
  {
    if (!moving_elastic.empty())
      find_flexibilities(moving_elastic, S, F);
    if (!has_laws && moving_elastic.empty())
      return;
    set_relative(S);
    if (is_set_up)
      set_compliances();
  }

  bool MassEquations::takes_part(const std::size_t i) const
  {
    return std::isfinite(relative[i]);
  }

  /// f must have no compliances on the diagonals of @p rows.
  void MassEquations::find_mass_flexibilities(const std::vector<std::size_t> &rows)
  {
    const std::vector<double> &diagonal = bodies.flexibilities(rows, schur->matrix());
    for (const std::size_t i : rows)
      of_mass[i] = diagonal[i];
  }

  void MassEquations::set_compliances()
  {
    // Infinite for a constraint without flexibility, which takes no part.
    for (std::size_t i = 0; i < constraints.size(); ++i)
      compliances[i] = of_mass[i] > 0. && takes_part(i) ? of_mass[i] * relative[i] : 0.;
    schur->set_compliance(compliances);
  }

  /// With the same masses as before, the fixed rows of f stay.
  void MassEquations::set_up()
  {
    const bool masses_changed = !is_set_up || some_with_constraints;
    if (!is_set_up)
      structure.communicator().agree([&] { solvers.factor_mass(); });
    is_set_up = true;
    std::fill(compliances.begin(), compliances.end(), 0.);
    if (masses_changed)
    {
      schur->setup(compliances);
      std::fill(of_mass.begin(), of_mass.end(), 0.);
    }
    else
    {
      schur->set_compliance(compliances);
      schur->update_moving();
    }
    if (!some_elastic)
      return;
    softened.clear();
    for (std::size_t i = 0; i < constraints.size(); ++i)
      if (relative[i] > 0. && (constraints.slides(i) || of_mass[i] == 0.))
        softened.push_back(i);
    find_mass_flexibilities(softened);
    set_compliances();
  }

  /// Factors M of bodies with internal constraints at the displacements of the state.
  void MassEquations::factor_at(const State &state)
  {
    structure.communicator().agree(
        [&]
        {
          for (const std::size_t k : with_constraints)
          {
            copy_displacement(reference, state, k, displacement);
            solvers.set_tangent(
                k, dynamic_cast<const ConstrainedBody &>(structure[k]).mass_at(displacement));
          }
          if (!is_set_up)
            solvers.factor_mass();
          else
            for (const std::size_t k : with_constraints)
              solvers.factor_again(k);
        });
    is_set_up = true;
  }

  void MassEquations::update_moving()
  {
    for (const std::size_t i : moving_elastic)
      compliances[i] = 0.;
    if (!moving_elastic.empty())
      schur->set_compliance(compliances);
    schur->update_moving();
    if (moving_elastic.empty())
      return;
    find_mass_flexibilities(moving_elastic);
    set_compliances();
  }

  void MassEquations::update(const State &state)
  {
    if (some_with_constraints)
      factor_at(state);
    if (some_with_constraints || !is_set_up)
      set_up();
    else
      update_moving();
  }
} // namespace taut
