// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_prescribed_motions_h
#define taut_prescribed_motions_h

#include <taut/substructure/structure.h>
#include <taut/time/state.h>
#include <taut/time/step_report.h>

#include <algorithm>
#include <vector>

namespace taut
{
  /**
   * The prescribed DoFs in a step of a scheme. Their place and velocity at the end of the step are
   * those of their motions u(t), whatever the scheme. A scheme of second order that differentiates
   * increments itself would alternate about the velocity for ever after a kink.
   *
   * In the equation of motion of the step act
   *
   *     V = du / step + (v - v0) / 2,
   *     A = (v - v0) / step + (1/2 + alpha_m - alpha_f) change
   *
   * with v = u' and the change of (v - v0) / step since the last step. Both agree with u' and u''
   * to second order, and their sums over steps are those of du and v: dampers and inertia transmit
   * the whole impulse of a kink or a jump inside of a step. Accelerations of a scheme with averaged
   * balances are those of the time t + (alpha_m - alpha_f) step (J. Chung, G. M. Hulbert, J. Appl.
   * Mech. 60 (1993)); with the theta method at 1/2 that is the mean over the step.
   */
  class PrescribedMotions
  {
  public:
    /// The arguments are kept by reference.
    PrescribedMotions(const Structure &structure, const Reference &reference,
                      const StepMethod &method);

    /// Before the time of the state changes: length of the step that ended there [s]; 0: none.
    void begin_step(const double step_before) { before = step_before; }

    /// Sets increments, velocities and accelerations for a step from the displacements of @p state
    /// to its time, of its length. At rest, increments alone.
    void set(const State &state);

    /// Increments of body k; zero for other DoFs [m, rad].
    const std::vector<double> &increments(const std::size_t k) const { return dU[k]; }

    /// Increments of all bodies; null: all are zero.
    const BodyVectors *lift() const { return lifts ? &dU : nullptr; }

    /// Whether the last set() moved body k.
    bool lifts_body(const std::size_t k) const { return body_lifts[k]; }

    /// For conditions on velocities of a theta method: what B^T dU lacks to be theta step V + (1 -
    /// theta) step V0 of the DoFs that move; null: nothing [m, rad].
    const BodyVectors *lift_of_velocities() const { return has_rates ? &rate_lift : nullptr; }

    /// Sets the prescribed entries of all bodies.
    void impose_increments(BodyVectors &U) const;

    /// Calls visit(dof, V, A) for each DoF of body k from begin to end - 1 that moves in time, with
    /// V and A of the equation of motion.
    template <typename Visitor>
    void visit(const std::size_t k, const Visitor &visitor) const
    {
      for (const Moving &one : moving[k])
        visitor(one.dof, one.mean_v, one.a);
    }

    /// Sets the velocities of the state to those of the motions, or to those of the equation of
    /// motion.
    void impose_velocities(State &state) const;
    void impose_velocities_of_step(State &state) const;

  private:
    struct Moving
    {
      std::size_t constraint = 0;
      unsigned int dof = 0;
      double mean_v = 0., v = 0., a = 0.;
    };
    void set_rates(std::size_t k, Moving &one, const State &state);

    const Structure &structure;
    const Reference &reference;
    const StepMethod &method;
    std::vector<std::vector<Moving>> moving; ///< of each body, sorted
    BodyVectors dU, rate_lift;
    std::vector<char> body_lifts;
    double before = 0.;
    bool lifts = false, has_rates = false;
    bool some_move = false; ///< on any rank
  };

  /// Sets the velocities of DoFs that move in time, at the time of @p state. A step has the length
  /// @p step [s].
  void set_prescribed_velocities(const Structure &structure, double step, State &state);
} // namespace taut

#endif
