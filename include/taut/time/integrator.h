// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_integrator_h
#define taut_integrator_h

#include <taut/base/registry.h>

#include <limits>
#include <map>
#include <memory>
#include <string>

namespace dealii
{
  class ParameterHandler;
}

namespace taut
{
  /**
   * An implicit scheme as numbers. With dU the increment of the step, an index 0 for the last step
   * and -1 for the one before,
   *
   *     V = velocity dU + v_V V0 + v_A A0 + v_dU dU0
   *     A = acceleration dU + a_V V0 + a_A A0 + a_dU dU0 + a_V_old V_{-1}
   *
   * and with the force balance r = P + B N - C V - K U, the equation of motion of the step is
   *
   *     M [(1 - alpha_m) A + alpha_m A0] = (1 - alpha_f) r + alpha_f r0.
   *
   * The contact force so enters old and new with its own B, and gaps hold at the end of the step.
   * With mean forces, those of rigid constraints are impulses over the step instead, without a
   * past, and their conditions may be on velocities after the step: see ContactConditions. With a
   * velocity projection, those of elastic unilateral constraints are means, too, and the velocities
   * that a step ends with are corrected by impulses: see VelocityProjection.
   */
  struct StepCoefficients
  {
    double velocity = 0.;                               ///< [1/s]
    double acceleration = 0.;                           ///< [1/s^2]
    double v_V = 0., v_A = 0., v_dU = 0.;               ///< [1, s, 1/s]
    double a_V = 0., a_A = 0., a_dU = 0., a_V_old = 0.; ///< [1/s, 1, 1/s^2, 1/s]
    double alpha_m = 0., alpha_f = 0.;                  ///< weights of the old step [1]
    bool mean_force = false; ///< of rigid constraints; bilateral ones then are at velocity level
    bool velocity_level = false;      ///< for rigid unilateral constraints; needs mean_force
    bool velocity_projection = false; ///< after conditions on gaps; needs mean_force
    double restitution = 0.;          ///< Newton's, of unilateral constraints [1]

    /// Weights of M A, M A0 and r0 in the equation of motion after division by 1 - alpha_f [1].
    double new_inertia() const { return (1. - alpha_m) / (1. - alpha_f); }
    double old_inertia() const { return alpha_m / (1. - alpha_f); }
    double old_balance() const { return alpha_f / (1. - alpha_f); }

    /// Factor of M in A, after that division [1/s^2]; C has `velocity`, K has 1.
    double mass_factor() const { return new_inertia() * acceleration; }

    /// True if A = K: the step is a static equilibrium.
    bool is_at_rest() const { return acceleration == 0. && velocity == 0.; }

    /// Velocities and accelerations are differences of one step.
    bool is_backward_euler() const
    {
      return v_V == 0. && v_A == 0. && a_A == 0. && alpha_m == 0. && alpha_f == 0. &&
             !looks_back() && !mean_force && !is_at_rest();
    }

    /// True if velocity or acceleration need more of the past than V0 and A0.
    bool looks_back() const { return v_dU != 0. || a_dU != 0. || a_V_old != 0.; }

    /// True if the first step needs no acceleration and no step before it.
    bool starts_itself() const
    {
      return v_A == 0. && v_dU == 0. && a_A == 0. && a_dU == 0. && a_V_old == 0. && alpha_m == 0.;
    }

    /// Part of itself that an error of the force of a rigid constraint keeps from step to step
    /// without mean forces, where U is held: the spectral radius of what is left of the scheme [1].
    double ringing() const;

    /// True if such an error is still felt after ten steps: more than half of it is kept a step.
    bool rings() const { return ringing() > .5; }

    template <typename Archive>
    void serialize(Archive &archive, unsigned int)
    {
      archive &velocity &acceleration &v_V &v_A &v_dU &a_V &a_A &a_dU &a_V_old;
      archive &alpha_m &alpha_f &mean_force &velocity_level &velocity_projection &restitution;
    }

    bool operator==(const StepCoefficients &other) const;
    bool operator!=(const StepCoefficients &other) const { return !(*this == other); }
  };

  /// A time integration scheme, chosen by name.
  class TimeIntegrator
  {
  public:
    virtual ~TimeIntegrator() = default;

    /// Declares the scheme's own entries in the current subsection of the handler.
    virtual void declare_parameters(dealii::ParameterHandler &) {}

    /// Coefficients for a step [s]. Throws UserError if the scheme's parameters make no method.
    virtual StepCoefficients coefficients(double step) const = 0;

    /**
     * For the first step [s] after one of another length. The same as coefficients() unless the
     * scheme looks back further than one step.
     */
    virtual StepCoefficients after_change(double step, double last_step) const
    {
      (void)last_step;
      return coefficients(step);
    }

    /// Frequency of free undamped vibrations beyond which steps of this length [s] are unstable
    /// [rad/s]; infinite where all are stable.
    virtual double largest_stable_frequency(double step) const
    {
      (void)step;
      return std::numeric_limits<double>::infinity();
    }

    /// Newton's restitution that its entries ask for, whether they make a method or not [1].
    virtual double restitution() const { return 0.; }

    /// Name with parameters, for the log.
    virtual std::string description() const = 0;
  };

  /**
   * The registered scheme of this name with values of its entries by path, for example
   * "Moreau-Jean/Theta"; entries that it does not have are passed over. Throws UserError for an
   * unknown name, and what deal.II's ParameterHandler throws for a value that does not fit.
   */
  std::unique_ptr<TimeIntegrator>
  make_integrator(const std::string &name, const std::map<std::string, std::string> &entries = {});

  // Of all functions below, a step is in s, and parameters that make no method are a UserError.

  /// Backward Euler for the velocity and for the acceleration; first order.
  StepCoefficients backward_euler(double step);

  /// The second-order backward difference formula for the velocity and for the acceleration.
  StepCoefficients bdf2(double step);

  /// The same where the step before had another length [s].
  StepCoefficients bdf2(double step, double last_step);

  /// Newmark's beta > 0 and gamma >= 1/2 in the averaged balance of the generalised-alpha method.
  StepCoefficients newmark(double step, double beta, double gamma, double alpha_m = 0.,
                           double alpha_f = 0.);

  /// Chung and Hulbert (1993), optimal dissipation with spectral radius rho in [0, 1] at infinite
  /// frequency.
  StepCoefficients generalised_alpha(double step, double rho);

  /**
   * Hilber, Hughes and Taylor (1977): Newmark with gamma = 1/2 + alpha and beta = (1 + alpha)^2/4,
   * and the balance of forces taken at t_i - alpha step. @p alpha in [0, 1/3] is minus theirs; 0 is
   * the trapezoidal rule, 1/3 dissipates most.
   */
  StepCoefficients hht(double step, double alpha);

  /**
   * The theta method of Moreau and Jean: M (V - V0) = step [theta r + (1 - theta) r0] + B p and
   * U = U0 + step [theta V + (1 - theta) V0] with the impulses p of rigid constraints, whose
   * complementarity is at velocity level with Newton's restitution e in [0, 1]. @p theta in [1/2,
   * 1]. M. Jean, Comput. Methods Appl. Mech. Engrg. 177 (1999).
   */
  StepCoefficients moreau_jean(double step, double theta, double restitution);

  /**
   * The same with conditions on the gaps of unilateral constraints at the end of the step. A mean
   * force N does the work N (D - D_0) = -N D_0 <= 0 there: it never gives energy.
   */
  StepCoefficients moreau_jean_of_gaps(double step, double theta);

  /**
   * The same at theta = 1/2, followed by a projection of the velocities: constraints hold for gaps
   * and for velocities at the end of each step, as in the nonsmooth schemes with both levels
   * (C. W. Gear, B. Leimkuhler, G. K. Gupta, J. Comput. Appl. Math. 12-13 (1985); O. Brüls, V.
   * Acary, A. Cardona, Comput. Methods Appl. Mech. Engrg. 281 (2014)). Second order where the
   * motion is smooth; fixed rigid constraints never give energy. @p restitution is Newton's [1].
   */
  StepCoefficients gaps_then_velocities(double step, double restitution);
} // namespace taut

#endif
