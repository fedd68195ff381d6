// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_mass_equations_h
#define taut_mass_equations_h

#include "interface/schur_complement.h"
#include "time/contact_resolution.h"
#include <taut/time/integrator.h>
#include <taut/time/state.h>
#include <taut/time/step_parameters.h>

#include <memory>
#include <vector>

namespace taut
{
  /**
   * The change of velocities by impulses: the factored mass matrices M of the bodies, and
   * f = B^T M^-1 B of the constraints with the compliance f_ii (S / (alpha F_ii))^2 of elastic
   * unilateral constraints on its diagonal. It fades such a constraint out from rigid to absent as
   * the compliance S of the spring grows over the flexibility F_ii of the bodies in a step.
   * Conserving springs take no part. All functions but access are called by all ranks together.
   */
  class MassEquations
  {
  public:
    /// The arguments but @p parameters are kept by reference.
    MassEquations(const Structure &structure, const Constraints &constraints,
                  const SolverParameters &parameters, const Reference &reference);

    /// For steps with these coefficients. @p S are the compliances of the springs in a step, which
    /// @p F has on its diagonal. @p is_linear: F is the same whenever these coefficients return.
    void prepare(const StepCoefficients &c, const std::vector<double> &S,
                 ComplementarityOperator &F, bool is_linear);

    /// Before a projection: springs with laws and sliding constraints.
    void follow(const std::vector<double> &S, ComplementarityOperator &F);

    /// Updates f for a state: the mass of a body with internal constraints depends on the state,
    /// and sliding constraints are in their places. The first call factors the mass matrices.
    void update(const State &state);

    /// Replaces impulses P by M^-1 P.
    void solve(BodyVectors &P) const { solvers.solve(P); }

    /// f with the compliances.
    ComplementarityOperator &f() { return schur->matrix(); }

    /// False for a constraint that is conserving or too soft.
    bool takes_part(std::size_t i) const;

    /// Compliance of a constraint in f [1/kg, 1/(kg m^2)]; 0 for a rigid one.
    double compliance(const std::size_t i) const { return compliances[i]; }

  private:
    void set_up();
    void factor_at(const State &state);
    void find_flexibilities(const std::vector<std::size_t> &rows, const std::vector<double> &S,
                            ComplementarityOperator &F);
    void find_mass_flexibilities(const std::vector<std::size_t> &rows);
    void set_relative(const std::vector<double> &S);
    void set_compliances();
    void update_moving();

    const Structure &structure;
    const Constraints &constraints;
    const Reference &reference;
    FactoredStructure solvers;
    std::vector<std::size_t> with_constraints; ///< bodies of this rank that are a ConstrainedBody
    std::vector<double> displacement;          ///< in factor_at()
    bool some_with_constraints;                ///< on any rank
    std::unique_ptr<SchurComplement> schur;
    bool is_set_up = false;

    WholeBodies bodies;
    double theta = 1.; ///< weight of forces in the balance

    /// F_ii of constraints that do not slide, for coefficients of an earlier call.
    struct Known
    {
      StepCoefficients c;
      std::vector<double> flexibility;
    };
    std::vector<Known> known;
    std::vector<std::size_t> elastic, moving_elastic; ///< unilateral constraints
    std::vector<std::size_t> softened;                ///< in set_up()
    bool has_laws = false, some_elastic = false;      ///< on any rank
    std::vector<double> flexibility, of_mass;         ///< F_ii and f_ii of elastic constraints
    std::vector<double> relative;                     ///< (S / (alpha F_ii))^2 of each constraint
    std::vector<double> compliances;                  ///< f_ii times relative
  };
} // namespace taut

#endif
