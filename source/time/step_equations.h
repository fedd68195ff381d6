// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_step_equations_h
#define taut_step_equations_h

#include "complementarity/solver.h"
#include "interface/schur_complement.h"
#include "time/step_check.h"
#include <taut/time/integrator.h>
#include <taut/time/residuals.h>
#include <taut/time/step_parameters.h>

#include <functional>
#include <memory>
#include <vector>

namespace taut
{
  /**
   * The equations of bodies and constraints in one step, in time or at rest:
   *
   *     A_k dU_k = P^_k + B_k N,    A = m M + c C + K,    dU = A_f^-1 (P^ + B N) + R alpha,
   *
   * with N from the conditions of the constraints. m = c = 0 is a static equilibrium. A_f is A,
   * plus springs on the DoFs that fix the rigid body modes R of a body that only constraints hold,
   * or whose inertia is lost in the rounding of its stiffness. The amplitudes alpha of R then are
   * unknowns of the complementarity problem. All functions but lift() are called by all ranks
   * together.
   */
  class StepEquations
  {
  public:
    /// The arguments are kept by reference.
    StepEquations(const Structure &structure, const Constraints &constraints,
                  const SolverParameters &parameters);

    /// The tangent of a nonlinear body, see NonlinearBodies::tangent().
    using Tangent = std::function<std::unique_ptr<SymmetricMatrix>(std::size_t k, int attempt)>;

    /// Sets the nonlinear bodies of this rank.
    void set_nonlinear(const std::vector<std::size_t> &bodies, const Tangent &tangent);

    /// True if the tangents of this rank are exact.
    bool has_own_tangents() const { return tangents_are_exact; }

    /// Factors the tangents of the nonlinear bodies and sets F up again.
    void linearise();

    /// Factors A for steps with these coefficients and sets F up with the compliances @p S of the
    /// constraints [m/N, rad/(N m)].
    void prepare(const StepCoefficients &coefficients, const std::vector<double> &S);

    /// Sets other compliances, which change only the diagonal of F.
    void set_compliance(const std::vector<double> &S);

    /// Starts the next search for multipliers from these closed rows.
    void start_from(const std::vector<char> &closed) { complementarity.start_from(closed); }

    /// Before the first search of a step of nonlinear bodies or turning constraints.
    void begin_search() { complementarity.begin_search(); }

    /// Rigid joints that repeat others. Set: those of an earlier search.
    const RepeatedRows &repeated_rows() const { return complementarity.repeated_rows(); }
    void set_repeated_rows(const RepeatedRows &rows) { complementarity.set_repeated_rows(rows); }

    const FactoredStructure &bodies() const { return solvers; }
    SchurComplement &interface() { return *schur; }
    const SchurComplement &interface() const { return *schur; }

    /// Whether a body of any rank has amplitudes of rigid body modes as unknowns.
    bool has_modes() const { return n_modes > 0; }

    /// Body of this rank with this amplitude; Structure::elsewhere: on another rank.
    std::size_t body_of_mode(std::size_t amplitude) const;

    /// P -= A_k L for increments @p L of prescribed DoFs of a body.
    void lift(std::size_t k, const std::vector<double> &L, std::vector<double> &P) const;

    /// Sets the rows of the amplitudes, G_ki = R_k . B_i, and their inertia; and their loads, e_k =
    /// R_k . P.
    void set_modes(MixedComplementarityProblem &problem) const;
    void set_mode_loads(const BodyVectors &P, MixedComplementarityProblem &problem) const;

    /// Solves for multipliers and amplitudes. Errors come from @p check, iterations go into
    /// @p residuals. The result is valid until the next call.
    const MixedComplementaritySolution &find_multipliers(const MixedComplementarityProblem &problem,
                                                         const StepCheck &check,
                                                         Residuals &residuals);

    /// Replaces P^ by dU, with multipliers @p N and amplitudes @p alpha.
    void find_increments(const std::vector<double> &N, const std::vector<double> &alpha,
                         BodyVectors &P) const;

    /**
     * One pass of iterative refinement: finds corrections of multipliers and amplitudes for
     * @p remainder. Its free_gap are the gaps of the @p applied solution plus the response to the
     * residual forces of the bodies; its null_space_load is the residual of the modes. The first
     * solve keeps the closed set, so that all numbers are as small as the remainder. If a
     * multiplier or gap becomes negative, a second solve searches the set. False: no solution.
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
    std::vector<std::size_t> nonlinear; ///< indices of bodies
    Tangent tangent;
    bool tangents_are_exact = true;
    std::vector<double> compliance;
    std::size_t n_modes = 0;                ///< on all ranks
    std::vector<std::size_t> first_of_body; ///< first amplitude of each body here, and the end
    std::vector<std::size_t> n_of_ranks;    ///< amplitudes of each rank
  };
} // namespace taut

#endif
