// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_mass_equations_h
#define taut_mass_equations_h

#include <taut/interface/schur_complement.h>
#include <taut/time/projection_compliance.h>
#include <taut/time/solver_parameters.h>
#include <taut/time/state.h>

#include <memory>
#include <vector>

namespace taut
{
  /// The mass matrices M of the bodies, factored, and f = B^T M^-1 B of the constraints: what
  /// impulses change velocities by. All functions are called by all ranks together.
  class MassEquations
  {
  public:
    /// The arguments but @p parameters are kept by reference.
    MassEquations(const Structure &structure, const Constraints &constraints,
                  const SolverParameters &parameters, const Reference &reference);

    /// Whether f was set up.
    bool is_set_up() const { return set_up; }

    /// Sets f up with @p softening on its diagonal; the matrices are factored at the first call.
    void setup(ProjectionCompliance &softening);

    /// The same at a state: masses of bodies with constraints inside depend on it, and sliding
    /// constraints are in their places.
    void update(const State &state, ProjectionCompliance &softening);

    /// Impulses P become M^-1 P.
    void solve(BodyVectors &P) const { solvers.solve(P); }

    SchurComplement &interface() { return *schur; }

  private:
    void factor_at(const State &state);

    const Structure &structure;
    const Reference &reference;
    FactoredStructure solvers;
    std::vector<std::size_t> with_constraints; ///< bodies of this rank, see ConstrainedBody
    bool some_with_constraints;                ///< of some rank
    std::unique_ptr<SchurComplement> schur;
    bool set_up = false;
  };
} // namespace taut

#endif
