// SPDX-License-Identifier: LGPL-2.1-or-later
#include "time/mass_equations.h"
#include <taut/substructure/body_traits.h>

namespace taut
{
  namespace
  {
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
      : structure(structure), reference(reference), solvers(structure, parameters.local_solver),
        schur(make_schur_complement(for_mass(parameters.interface), solvers, constraints))
  {
    for (std::size_t k = 0; k < structure.size(); ++k)
      if (dynamic_cast<const ConstrainedBody *>(&structure[k]))
        with_constraints.push_back(k);
    some_with_constraints = structure.communicator().any(!with_constraints.empty());
  }

  void MassEquations::setup(ProjectionCompliance &softening)
  {
    const bool masses_changed = !set_up || some_with_constraints;
    if (!set_up)
      structure.communicator().agree([&] { solvers.factor_mass(); });
    set_up = true;
    softening.setup(*schur, masses_changed);
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
          if (!set_up)
            solvers.factor_mass();
          else
            for (const std::size_t k : with_constraints)
              solvers.factor_again(k);
        });
    set_up = true;
  }

  void MassEquations::update(const State &state, ProjectionCompliance &softening)
  {
    if (some_with_constraints)
      factor_at(state);
    if (some_with_constraints || !set_up)
      setup(softening);
    else
      softening.update_moving(*schur);
  }
} // namespace taut
