// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_velocity_projection_h
#define taut_velocity_projection_h

#include "complementarity/solver.h"
#include "time/contact_step.h"
#include "time/mass_equations.h"
#include <taut/interface/connected_bodies.h>
#include <taut/time/state.h>
#include <taut/time/step_parameters.h>

#include <memory>
#include <vector>

namespace taut
{
  /**
   * The velocity projection at the end of a step, after the solution with conditions on gaps and
   * impulses p. New impulses P keep the gaps from closing further,
   *
   *     V = V* + M^-1 B (P - p),    0 <= P _|_ D' >= 0 on the unilateral constraints with p > 0,
   *                                 D' = 0 on all rigid bilateral constraints.
   *
   * U stays. An elastic constraint with p > 0 is softened, so that it fades from rigid to absent
   * with its compliance S: 0 <= P _|_ D' + f_ii (theta S / (alpha F_ii))^2 (P - p) >= 0 with
   * F = B^T A^-1 B and f = B^T M^-1 B. S of a law is its value at the end of the step.
   *
   * With Newton's restitution e the condition is D' + e min(0, D'_0). P then departs from the
   * solution without restitution only so far that the contacts of connected bodies give no energy.
   * DoFs without mass and damping have no independent velocity and take the mean over the step.
   */
  class VelocityProjection
  {
  public:
    /// The arguments but @p parameters are kept by reference.
    VelocityProjection(const Structure &structure, const Constraints &constraints,
                       const SolverParameters &parameters, const Reference &reference);

    /// For steps with these coefficients. @p F is the matrix of their first part, including S, see
    /// MassEquations::prepare().
    void prepare(const StepCoefficients &c, double step, const std::vector<double> &S,
                 ComplementarityOperator &F, bool is_linear);

    /// Largest residual of a rate after a step, from the velocities, and its constraint.
    struct Residual
    {
      double largest = 0.;
      std::size_t worst = 0;
    };

    /**
     * Changes V, D' and multipliers of a state after the first part of a step, and subtracts C
     * times the change of V from its balance. @p F is the matrix
     * of prepare() with the sliding constraints in their places. Throws the errors of
     * ComplementaritySolver. Called by all ranks together.
     */
    Residual project(ContactStep &contacts, State &state, ComplementarityOperator &F);

    /// DoFs without mass and damping of each body, which end the step in equilibrium.
    const std::vector<std::vector<unsigned int>> &quasi_static_dofs() const { return quasi_static; }

    /// Largest size of each rate so far, the rounding scale of constraints at rest; set from
    /// another projection of the same constraints [m/s, rad/s].
    const std::vector<double> &largest_rates() const { return largest_scale; }
    void set_largest_rates(const std::vector<double> &sizes) { largest_scale = sizes; }

    /// Work of the impulses P - p of each constraint on the bodies in the last step [J].
    const std::vector<double> &work() const { return work_of_rows; }

  private:
    bool has_to_act(const ContactStep &contacts, const State &state);
    void set_problem(const State &state);
    double kinetic_energy(const State &state);
    void solve(const ContactStep &contacts, const State &state);
    void add_largest_parts(const ContactStep &contacts, const State &state,
                           const std::vector<double> &rebounding);
    Residual set_velocities(ContactStep &contacts, State &state);
    void move_quasi_static(State &state);
    void change_velocities(State &state);

    const Structure &structure;
    const Constraints &constraints;
    MassEquations masses;
    ComplementaritySolver complementarity;
    StepCoefficients c;
    double step = 0.;
    std::vector<std::vector<unsigned int>> quasi_static; ///< DoFs of each body
    bool some_quasi_static;                              ///< on any rank
    bool is_linear = true;                               ///< bodies and directions
    std::vector<char> takes_part, has_no_mass; ///< constraints; has_no_mass: on DoFs without mass
    MixedComplementarityProblem problem;
    std::vector<double> p, q, change; ///< impulses, P - p, f (P - p)
    std::vector<double> rate, work_of_rows, work_vector;
    std::vector<double> largest_scale; ///< largest scale of each rate so far
    BodyVectors dV;
    std::unique_ptr<const ConnectedBodies> connected; ///< with restitution only
  };
} // namespace taut

#endif
