// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_mass_equations_h
#define taut_mass_equations_h

#include "interface/schur_complement.h"
#include "time/projection_compliance.h"
#include <taut/time/state.h>
#include <taut/time/step_parameters.h>

#include <memory>
#include <vector>

namespace taut
{
  /// The factored mass matrices M of the bodies, and f = B^T M^-1 B of the constraints: the change
  /// of velocities by impulses. All functions are called by all ranks together.
  class MassEquations
  {
  public:
    /// The arguments but @p parameters are kept by reference.
    MassEquations(const Structure &structure, const Constraints &constraints,
                  const SolverParameters &parameters, const Reference &reference);

    bool is_set_up() const { return set_up; }

    /// Sets f up with @p softening on its diagonal. The first call factors the mass matrices.
    void setup(ProjectionCompliance &softening);

    /// Updates f for a state: the mass of a body with internal constraints depends on the state,
    /// and sliding constraints are in their places.
    void update(const State &state, ProjectionCompliance &softening);

    /// Replaces impulses P by M^-1 P.
    void solve(BodyVectors &P) const { solvers.solve(P); }

    SchurComplement &interface() { return *schur; }

  private:
    void factor_at(const State &state);

    const Structure &structure;
    const Reference &reference;
    FactoredStructure solvers;
    std::vector<std::size_t> with_constraints; ///< bodies of this rank that are a ConstrainedBody
    std::vector<double> displacement;          ///< in factor_at()
    bool some_with_constraints;                ///< on any rank
    std::unique_ptr<SchurComplement> schur;
    bool set_up = false;
  };
} // namespace taut

#endif
