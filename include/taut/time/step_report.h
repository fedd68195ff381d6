// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_step_report_h
#define taut_step_report_h

#include <taut/interface/constraints.h>
#include <taut/time/integrator.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace taut
{
  /// The method of the steps to come, which all parts of a step read: the numbers of a scheme, and
  /// what it asks of each row. Motion sets it for each length of steps; statics leave it at rest.
  struct StepMethod
  {
    StepCoefficients c; ///< zero: an equilibrium at rest
    double length = 0.; ///< of a step [s]
    ForceTime internal_forces = ForceTime::end;
    bool corrects_velocities = false; ///< a VelocityProjection follows each step
    std::vector<RowRule> rules;       ///< of each row

    /// For steps of a scheme with these coefficients and this length [s]. @p quasi_static is that
    /// of the constraints.
    void set(const TimeIntegrator &scheme, const StepCoefficients &coefficients, const double step,
             const Constraints &constraints, const std::vector<char> &quasi_static)
    {
      c = coefficients;
      length = step;
      internal_forces = scheme.internal_forces();
      corrects_velocities = scheme.rule(RowTraits()).corrected;
      rules.resize(constraints.size());
      for (std::size_t i = 0; i < rules.size(); ++i)
        rules[i] = scheme.rule({constraints[i].spring.is_rigid(), constraints[i].cone.may_open(),
                                constraints.turns(i), quasi_static[i] != 0});
    }

    /// Whether forces of rows, and internal forces, may be means over the step.
    bool has_means() const { return internal_forces == ForceTime::mean; }

    bool has_velocity_conditions() const
    {
      return std::any_of(rules.begin(), rules.end(),
                         [](const RowRule &rule) { return rule.is_on_velocity(); });
    }

    /// For Boost's archives.
    template <typename Archive>
    void serialize(Archive &archive, unsigned int)
    {
      archive &c &length &internal_forces &corrects_velocities &rules;
    }
  };
  /// The method of an equilibrium with @p n rows.
  inline StepMethod method_at_rest(const std::size_t n)
  {
    StepMethod method;
    method.rules.resize(n);
    return method;
  }

  /// What a step says to those who watch it, beside the motion and its residuals. Before the first
  /// step, lists are empty.
  struct StepReport
  {
    StepMethod method; ///< whether multipliers are means over the step, among others

    /// Work of the mean force of each row on the bodies, without the force of a sliding row in its
    /// old place [J]; 0 for a force at the end of the step.
    std::vector<double> work;

    /// Work of the impulses of a velocity projection, a part of that work [J].
    double impulse_work = 0.;

    /// Energy that each group of connected bodies gained beyond the work of loads and moving rows;
    /// empty: not known [J].
    std::vector<double> gains;

    /// Whether the multiplier of a row is a mean over the step.
    bool is_mean(const std::size_t i) const
    {
      return !method.rules.empty() && method.rules[i].is_mean();
    }

    /// Of all groups; 0 if it is not known [J].
    double gain() const { return std::accumulate(gains.begin(), gains.end(), 0.); }

    /// For Boost's archives.
    template <typename Archive>
    void serialize(Archive &archive, unsigned int)
    {
      archive &method &work &impulse_work &gains;
    }
  };
} // namespace taut

#endif
