// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_link_springs_h
#define taut_link_springs_h

#include <taut/time/constraint_laws.h>
#include <taut/time/integrator.h>
#include <taut/time/state.h>

#include <cstddef>
#include <vector>

namespace taut
{
  /**
   * Springs and dampers of the elastic constraints through the steps. In a step the compression at
   * its end is u = S N + h (Kelvin-Voigt): with forces at the end
   *
   *     S = 1 / (k + c v),    h = S c (v u_0 - known rate),    v = dV/dU of the scheme.
   *
   * Where a unilateral constraint has a mean force N over the step,
   *
   *     S = 1 / (k + c / (theta step)),    h = -((1 - theta) k - c / step) / (theta k + c / step)
   *                                            u_0,
   *
   * and u = max(0, S N + h). Springs that follow a law, and conserving ones, have the S and h of
   * its linearisation, see ConstraintLaws.
   */
  class LinkSprings
  {
  public:
    /// Kept by reference.
    explicit LinkSprings(const Constraints &constraints);

    /// For steps with these coefficients from now on [s]; @p mean is not 0 where a force is a mean.
    void prepare(const StepCoefficients &c, double step, const std::vector<char> &mean);

    /// S with the dampers; 0 of a rigid constraint [m/N, rad/(N m)].
    const std::vector<double> &compliance() const { return S; }

    /// h [m, rad].
    const std::vector<double> &histories() const { return history; }

    /// Begins a step of a constraint; returns h, 0 with a law, which solve() finds.
    double begin(std::size_t i, const State &before);

    /// Solves the problem of a step, with the springs that follow a law; see
    /// ConstraintLaws::solve().
    const MixedComplementaritySolution &solve(MixedComplementarityProblem &problem,
                                              StepEquations &system, const StepCheck &check,
                                              Certificate &certificate);

    /// S N + h, and what it lacks of a law, as a gap.
    double compression(std::size_t i, double N) const { return S[i] * N + history[i]; }
    double lack(const std::size_t i, const double u, const double N) const
    {
      return laws.lack(i, u, N);
    }

    /// True of elastic constraints whose force is a mean.
    bool is_mean(const std::size_t i) const { return mean[i] && S[i] > 0.; }

    /**
     * After a step that ends with @p gap and multiplier @p N: the spring of the state. @p scale is
     * what the gap is a sum of. Returns D, the gap with the spring.
     */
    double accept(std::size_t i, double gap, double N, double scale, State &state) const;

    /// A change of the multiplier by @p dN, with forces at the ends of steps.
    void correct(std::size_t i, double dN, State &state) const;

  private:
    double conserving_compression(std::size_t i, double gap, double N, double scale) const;

    const Constraints &constraints;
    StepCoefficients c;
    double step = 0.;
    ConstraintLaws laws;
    std::vector<char> mean;
    std::vector<double> S, history;
  };
} // namespace taut

#endif
