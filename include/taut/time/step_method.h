// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_step_method_h
#define taut_step_method_h

#include <taut/interface/constraints.h>
#include <taut/time/integrator.h>

#include <algorithm>
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
} // namespace taut

#endif
