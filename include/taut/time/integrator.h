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
   * The coefficients of an implicit scheme. With the increment dU of the step, index 0 for the last
   * step and -1 for the step before it,
   *
   *     V = velocity dU + v_V V0 + v_A A0 + v_dU dU0
   *     A = acceleration dU + a_V V0 + a_A A0 + a_dU dU0 + a_V_old V_{-1}
   *
   * and with the force balance r = P + B N - C V - K U, the equation of motion of the step is
   *
   *     M [(1 - alpha_m) A + alpha_m A0] = (1 - alpha_f) r + alpha_f r0.
   *
   * Old and new contact forces thus act with their own B, unless a RowRule asks for a mean force.
   */
  struct StepCoefficients
  {
    double velocity = 0.;                               ///< [1/s]
    double acceleration = 0.;                           ///< [1/s^2]
    double v_V = 0., v_A = 0., v_dU = 0.;               ///< [1, s, 1/s]
    double a_V = 0., a_A = 0., a_dU = 0., a_V_old = 0.; ///< [1/s, 1, 1/s^2, 1/s]
    double alpha_m = 0., alpha_f = 0.;                  ///< weights of the old step [1]
    double restitution = 0.; ///< Newton's coefficient, for unilateral constraints [1]

    /// Weights of M A, M A0 and r0 in the equation of motion after division by 1 - alpha_f [1].
    double new_inertia() const { return (1. - alpha_m) / (1. - alpha_f); }
    double old_inertia() const { return alpha_m / (1. - alpha_f); }
    double old_balance() const { return alpha_f / (1. - alpha_f); }

    /// Factor of M in A after that division [1/s^2]; C has the factor `velocity`, K the factor 1.
    double mass_factor() const { return new_inertia() * acceleration; }

    /// True if A = K: the step is a static equilibrium.
    bool is_at_rest() const { return acceleration == 0. && velocity == 0.; }

    /// True if velocities and accelerations are differences over one step.
    bool is_backward_euler() const
    {
      return v_V == 0. && v_A == 0. && a_A == 0. && alpha_m == 0. && alpha_f == 0. &&
             !looks_back() && !is_at_rest();
    }

    /// True if velocity or acceleration need more of the past than V0 and A0.
    bool looks_back() const { return v_dU != 0. || a_dU != 0. || a_V_old != 0.; }

    /// True if the first step needs neither an initial acceleration nor a step before it.
    bool starts_itself() const
    {
      return v_A == 0. && v_dU == 0. && a_A == 0. && a_dU == 0. && a_V_old == 0. && alpha_m == 0.;
    }

    /// Amplification per step of an error of the force of a rigid constraint, where U is held and
    /// without mean forces: the spectral radius of the remaining scheme [1].
    double ringing() const;

    /// True if more than half of such an error remains after a step: it is visible after ten steps.
    bool rings() const { return ringing() > .5; }

    template <typename Archive>
    void serialize(Archive &archive, unsigned int)
    {
      archive &velocity &acceleration &v_V &v_A &v_dU &a_V &a_A &a_dU &a_V_old;
      archive &alpha_m &alpha_f &restitution;
    }

    bool operator==(const StepCoefficients &other) const;
    bool operator!=(const StepCoefficients &other) const { return !(*this == other); }
  };

  /// When a force of a step acts: at the end of the step, or as a mean over it.
  enum class ForceTime : char
  {
    end,
    mean
  };

  /// What a scheme asks of one constraint in a step. Rows stand for constraints, see
  /// ContactStep for the equations.
  struct RowRule
  {
    enum class Condition : char
    {
      gap,     ///< 0 <= D at the end of the step
      velocity ///< 0 <= D' + e D'_0 of a constraint that touches
    };
    Condition condition = Condition::gap;

    /// A mean force has no past: it is an impulse that acts in this step alone.
    ForceTime force = ForceTime::end;

    /// Impulses correct the velocity after the step, see VelocityProjection; for mean forces and
    /// conditions on gaps only.
    bool corrected = false;

    /// For Boost's archives.
    template <typename Archive>
    void serialize(Archive &archive, unsigned int)
    {
      archive &condition &force &corrected;
    }

    bool is_mean() const { return force == ForceTime::mean; }
    bool is_on_velocity() const { return condition == Condition::velocity; }
  };

  /// What rules of rows depend on.
  struct RowTraits
  {
    bool is_rigid = true, may_open = true;
    bool turns = false;
    bool is_quasi_static = false; ///< acts on DoFs without mass and damping
  };

  /// A time integration scheme, chosen by name. Derive from it and register the class for a new
  /// scheme: its coefficients say how bodies move, its rules what it asks of constraints.
  class TimeIntegrator
  {
  public:
    virtual ~TimeIntegrator() = default;

    /// Declares the scheme's own entries in the current subsection of the handler.
    virtual void declare_parameters(dealii::ParameterHandler &) {}

    /// Coefficients for a step [s]. Throws UserError if the scheme's parameters make no method.
    virtual StepCoefficients coefficients(double step) const = 0;

    /// Coefficients for the first step [s] after a step of another length [s]: the same as
    /// coefficients() unless the scheme looks back more than one step.
    virtual StepCoefficients after_change(double step, double last_step) const
    {
      (void)last_step;
      return coefficients(step);
    }

    /// What the scheme asks of a row.
    virtual RowRule rule(const RowTraits &) const { return {}; }

    /// Internal forces of bodies that are not linear, and directions of constraints that turn:
    /// those at the end of the step, or the means of an energy-momentum scheme. A scheme with rules
    /// for mean forces asks for means.
    virtual ForceTime internal_forces() const { return ForceTime::end; }

    /// Frequency of free undamped vibrations above which a step of this length [s] is unstable
    /// [rad/s]; infinite for an unconditionally stable scheme.
    virtual double largest_stable_frequency(double step) const
    {
      (void)step;
      return std::numeric_limits<double>::infinity();
    }

    /// Newton's restitution in the entries of the scheme, even if they make no method [1].
    virtual double restitution() const { return 0.; }

    /// Name with parameters, for the log.
    virtual std::string description() const = 0;
  };

  /// Name of a time integration scheme, values of its entries by path, and why it was chosen.
  struct SchemeChoice
  {
    std::string name;
    std::map<std::string, std::string> entries;
    std::string reason;
  };

  /// The registered scheme of this name, with values of its entries by path, for example
  /// "Moreau-Jean/Theta"; unknown entries are ignored. Throws UserError for an unknown name, and
  /// the exceptions of deal.II's ParameterHandler for an unsuitable value.
  std::unique_ptr<TimeIntegrator>
  make_integrator(const std::string &name, const std::map<std::string, std::string> &entries = {});

  // In all functions below, steps are in s, and parameters that make no method are a UserError.

  /// Backward Euler for the velocity and for the acceleration; first order.
  StepCoefficients backward_euler(double step);

  /// The second-order backward difference formula for the velocity and for the acceleration.
  StepCoefficients bdf2(double step);

  /// BDF2 after a step of another length [s].
  StepCoefficients bdf2(double step, double last_step);

  /// Newmark's beta > 0 and gamma >= 1/2 in the averaged balance of the generalised-alpha method.
  StepCoefficients newmark(double step, double beta, double gamma, double alpha_m = 0.,
                           double alpha_f = 0.);

  /// Chung and Hulbert (1993), optimal dissipation with spectral radius rho in [0, 1] at infinite
  /// frequency.
  StepCoefficients generalised_alpha(double step, double rho);

  /// Hilber, Hughes and Taylor (1977): Newmark with gamma = 1/2 + alpha and beta = (1 + alpha)^2/4,
  /// and the force balance at t_i - alpha step. @p alpha in [0, 1/3] is minus their alpha; 0 is the
  /// trapezoidal rule, 1/3 has most dissipation.
  StepCoefficients hht(double step, double alpha);

  /**
   * The theta method of Moreau and Jean: M (V - V0) = step [theta r + (1 - theta) r0] + B p and
   * U = U0 + step [theta V + (1 - theta) V0], with impulses p of constraints with mean forces and
   * Newton's @p restitution in [0, 1]. @p theta in [1/2, 1]. M. Jean, Comput. Methods Appl. Mech.
   * Engrg. 177 (1999).
   */
  StepCoefficients moreau_jean(double step, double theta, double restitution);
} // namespace taut

#endif
