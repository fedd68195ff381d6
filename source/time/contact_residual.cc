// SPDX-License-Identifier: LGPL-2.1-or-later
#include "time/contact_residual.h"
#include "time/matrix_norms.h"
#include <taut/substructure/body_traits.h>

#include <algorithm>
#include <cmath>

namespace taut
{
  namespace
  {
    /// Residuals up to this bound need no second measurement: above the rounding of normal steps,
    /// 1e-11, and a hundredth of the default Contact tolerance.
    constexpr double conspicuous = 1e-10;

    /// Columns of A^-1 end where they have decayed to 1e-18. A motion below this part of the
    /// largest one is hence not known from its own terms: they would be off by more than 1e-12, to
    /// which gaps are solved.
    constexpr double decayed = 1e-6;

    /// Part of the motion of whole bodies that counts in the scale of a constraint. An error of
    /// 1e-11 of that motion still exceeds the default Contact tolerance, 1e-8.
    constexpr double part_of_whole_motion = 1e-3;
  } // namespace

  void ContactResidual::add_decayed_columns(const std::vector<double> &increments,
                                            const std::vector<double> &N,
                                            const ComplementarityOperator &F,
                                            std::vector<double> &scale) const
  {
    ByKind most = {0., 0.};
    for (std::size_t i = 0; i < constraints.size(); ++i)
      most[constraints[i].rotational] =
          std::max(most[constraints[i].rotational],
                   std::fabs(increments[i]) + F.diagonal(i) * std::fabs(N[i]));
    for (double &of_kind : most)
      of_kind = constraints.max(of_kind);
    for (std::size_t i = 0; i < constraints.size(); ++i)
      scale[i] += decayed * most[constraints[i].rotational];
  }

  /// Adds motions of whole bodies to the scale of a constraint: slopes of a beam that falls without
  /// bending are only rounding. |b . dU|^2 <= (b . A^-1 b) (dU . A dU).
  void ContactResidual::add_inertial_terms(const StepCoefficients &c, const std::vector<double> &S,
                                           const State &state, const ComplementarityOperator &F,
                                           std::vector<double> &scale) const
  {
    double sum = 0.;
    std::vector<double> product;
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      product.assign(state.dU[k].size(), 0.);
      structure[k].mass().vmult_add(c.mass_factor(), state.dU[k].data(), product.data());
      for (std::size_t i = 0; i < product.size(); ++i)
        sum += state.dU[k][i] * product[i];
    }
    structure.communicator().sum(&sum, 1);
    for (std::size_t i = 0; i < constraints.size(); ++i)
      scale[i] += part_of_whole_motion * std::sqrt(std::max(0., sum * (F.diagonal(i) - S[i])));
  }

  /// Adds, at rest, motions of what each DoF is tied to, sum_j |K_ij| |U_j| / K_ii: slopes of a
  /// beam that moves without bending are only rounding. An entry of F is a sum over the bodies,
  /// whose terms may cancel, as slopes on both sides of a cut in a straight wire do.
  void ContactResidual::add_elastic_terms(const State &state, const FactoredStructure &bodies,
                                          std::vector<double> &scale) const
  {
    BodyVectors terms = structure.zero();
    std::vector<double> diagonal;
    for (std::size_t k = 0; k < terms.size(); ++k)
    {
      const std::vector<double> &U = state.U[k];
      diagonal.assign(U.size(), 0.);
      bodies.stiffness(k).visit(
          [&](const unsigned int i, const unsigned int j, const double value)
          {
            terms[k][i] += std::fabs(value * U[j]);
            if (i == j)
              diagonal[i] = value;
            else
              terms[k][j] += std::fabs(value * U[i]);
          });
      double largest = 0.;
      for (std::size_t i = 0; i < U.size(); ++i)
      {
        terms[k][i] = diagonal[i] > 0. ? terms[k][i] / diagonal[i] : std::fabs(U[i]);
        largest = std::max(largest, std::fabs(U[i]));
      }
      // Conditions inside of a body tie its directions to each other.
      if (dynamic_cast<const ConstrainedBody *>(&structure[k]))
        for (double &term : terms[k])
          term += part_of_whole_motion * largest;
    }
    std::vector<double> size(constraints.size());
    for (std::size_t i = 0; i < constraints.size(); ++i)
      size[i] = magnitude(constraints[i].terms, terms);
    constraints.sum(size);
    for (std::size_t i = 0; i < constraints.size(); ++i)
      scale[i] += size[i];
  }

  void ContactResidual::find(const MixedComplementarityProblem &problem,
                             const MixedComplementaritySolution &at,
                             const ComplementarityOperator &F)
  {
    gap_terms(problem, F, at.multiplier, at.mode_amplitude, terms);
    multiplier_weights(problem, F, at.multiplier, terms, weights);
    residual(problem, at, terms, weights, found);
  }

  double ContactResidual::measure(const StepCoefficients &c, MixedComplementarityProblem &problem,
                                  const MixedComplementaritySolution &at,
                                  const std::vector<double> &increments,
                                  const std::vector<double> &S, const State &state,
                                  StepEquations &system, std::size_t &worst)
  {
    const ComplementarityOperator &F = system.interface().matrix();
    if (!c.is_at_rest())
      add_decayed_columns(increments, at.multiplier, F, problem.gap_scale);
    find(problem, at, F);
    if (!(found.max <= conspicuous))
    {
      if (c.is_at_rest())
        add_elastic_terms(state, system.bodies(), problem.gap_scale);
      else
        add_inertial_terms(c, S, state, F, problem.gap_scale);
      find(problem, at, F);
    }
    const auto largest = std::max_element(found.rows.begin(), found.rows.end());
    worst = largest == found.rows.end() || *largest < found.max ? no_link
                                                                : largest - found.rows.begin();
    return found.max;
  }
} // namespace taut
