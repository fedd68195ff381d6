// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_step_equations_h
#define taut_step_equations_h

#include <taut/complementarity/solver.h>
#include <taut/interface/schur_complement.h>
#include <taut/time/certificate.h>
#include <taut/time/integrator.h>
#include <taut/time/solver_parameters.h>
#include <taut/time/step_check.h>

#include <functional>
#include <memory>
#include <vector>

namespace taut
{
  /**
   * What bodies and constraints have to satisfy in one step, in time or at rest:
   *
   *     A_k dU_k = P^_k + B_k N,    A = m M + c C + K,    dU = A_f^-1 (P^ + B N) + R alpha,
   *
   * with N from the conditions of the constraints. m = c = 0 is a static equilibrium. A_f is A, or
   * A with springs on the DoFs that fix the rigid body modes R of a body that nothing but
   * constraints holds, or whose inertia is lost in the rounding of its stiffness; their amplitudes
   * alpha are then unknowns of the complementarity problem. All functions but lift() are called by
   * all ranks together.
   */
  class StepEquations
  {
  public:
    /// The arguments are kept by reference.
    StepEquations(const Structure &structure, const Constraints &constraints,
                  const SolverParameters &parameters);

    /// The tangent of a body that is not linear, see NonlinearBodies::tangent().
    using Tangent = std::function<std::unique_ptr<SymmetricMatrix>(std::size_t k, int attempt)>;

    /// The bodies of this rank that are not linear.
    void set_nonlinear(const std::vector<std::size_t> &bodies, const Tangent &tangent);

    /// True if the tangents of this rank are exact.
    bool has_own_tangents() const { return tangents_are_exact; }

    /// Their tangents anew: only they are factored again. F is set up anew.
    void linearise();

    /// Factors A for steps with these coefficients, and sets F up with the compliances @p S of the
    /// constraints [m/N, rad/(N m)].
    void prepare(const StepCoefficients &coefficients, const std::vector<double> &S);

    /// F with other compliances: only its diagonal changes.
    void set_compliance(const std::vector<double> &S);

    const FactoredStructure &bodies() const { return solvers; }
    SchurComplement &interface() { return *schur; }
    const SchurComplement &interface() const { return *schur; }

    /// Whether a body of some rank has amplitudes of rigid body modes as unknowns.
    bool has_modes() const { return n_modes > 0; }

    /// Body of this rank whose mode has this amplitude; Structure::elsewhere: of another one.
    std::size_t body_of_mode(std::size_t amplitude) const;

    /// P -= A_k L for increments @p L of a body that its supports prescribe.
    void lift(std::size_t k, const std::vector<double> &L, std::vector<double> &P) const;

    /// The rows of the amplitudes: G_ki = R_k . B_i, e_k = R_k . P, and their inertia.
    void set_modes(const BodyVectors &P, MixedComplementarityProblem &problem) const;

    /// Solves for multipliers and amplitudes; errors are those of @p check, iterations go into @p
    /// certificate. The result is kept until the next call.
    const MixedComplementaritySolution &find_multipliers(const MixedComplementarityProblem &problem,
                                                         const StepCheck &check,
                                                         Certificate &certificate);

    /// P^ becomes dU. @p N are the multipliers and @p alpha the amplitudes.
    void find_increments(const std::vector<double> &N, const std::vector<double> &alpha,
                         BodyVectors &P) const;

    /**
     * One pass of iterative refinement: the changes of multipliers and amplitudes that answer to @p
     * remainder, whose free_gap are the gaps of the @p applied solution and what the forces that
     * the bodies lack make of them, and whose null_space_load is what the modes lack. First on the
     * closed constraints, where all numbers are as small as the remainder; if that makes a
     * multiplier or a gap negative, in a new search. False if no answer is found.
     */
    bool correct(const MixedComplementarityProblem &remainder,
                 const MixedComplementaritySolution &applied,
                 MixedComplementaritySolution &correction);

  private:
    bool correct_on_closed_set(const MixedComplementarityProblem &remainder,
                               const MixedComplementaritySolution &applied,
                               MixedComplementaritySolution &correction);
    void number_modes();
    void factor(int attempt);
    void factor_nonlinear();

    const Structure &structure;
    const Constraints &constraints;
    const SolverParameters &parameters;
    StepCoefficients c;
    FactoredStructure solvers;
    std::unique_ptr<SchurComplement> schur;
    ComplementaritySolver complementarity;
    std::vector<std::size_t> nonlinear; ///< bodies
    Tangent tangent;
    bool tangents_are_exact = true;
    std::vector<double> compliance;
    std::size_t n_modes = 0;                ///< of all ranks
    std::vector<std::size_t> first_of_body; ///< amplitude of each body here, and the end
  };
} // namespace taut

#endif
