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
   * Springs and dampers of the elastic constraints through the steps. The compression at the end of
   * a step is u = S N + h (Kelvin-Voigt). With forces at the end of the step
   *
   *     S = 1 / (k + c v),    h = S c (v u_0 - known rate),    v = dV/dU of the scheme.
   *
   * If a unilateral constraint has a mean force N over the step,
   *
   *     S = 1 / (k + c / (theta step)),    h = -((1 - theta) k - c / step) / (theta k + c / step)
   *                                            u_0,
   *
   * and u = max(0, S N + h). Conserving springs, and springs with a law, have S and h of their
   * linearisation, see ConstraintLaws.
   */
  class LinkSprings
  {
  public:
    /// The argument is kept by reference.
    explicit LinkSprings(const Constraints &constraints);

    /// Sets coefficients and length [s] of the steps to come; @p mean is not 0 for mean forces.
    void prepare(const StepCoefficients &c, double step, const std::vector<char> &mean);

    /// S including the dampers; 0 for a rigid constraint [m/N, rad/(N m)].
    const std::vector<double> &compliance() const { return S; }

    /// h [m, rad].
    const std::vector<double> &histories() const { return history; }

    /// Begins a step of a constraint. Returns h, or 0 with a law: solve() finds its h.
    double begin(std::size_t i, const State &before);

    /// Solves the problem of a step for springs with and without laws, see ConstraintLaws::solve().
    const MixedComplementaritySolution &solve(MixedComplementarityProblem &problem,
                                              StepEquations &system, const StepCheck &check,
                                              Certificate &certificate);

    /// S N + h, and the residual of the law, as a gap.
    double compression(std::size_t i, double N) const { return S[i] * N + history[i]; }
    double lack(const std::size_t i, const double u, const double N) const
    {
      return laws.lack(i, u, N);
    }

    /// True for an elastic constraint with a mean force.
    bool is_mean(const std::size_t i) const { return mean[i] && S[i] > 0.; }

    /// After a step that ends with @p gap and multiplier @p N: updates the spring in the state.
    /// @p scale is the size of the terms of the gap. Returns D, the gap including the spring.
    double accept(std::size_t i, double gap, double N, double scale, State &state) const;

    /// Adds a change @p dN of the multiplier, with forces at the ends of steps.
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
