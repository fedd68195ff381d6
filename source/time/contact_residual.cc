// SPDX-License-Identifier: LGPL-2.1-or-later
// Residuals of the conditions on the constraints, for the certificate.
#include <taut/substructure/constrained_body.h>
#include <taut/time/contact_conditions.h>
#include <taut/time/matrix_norms.h>

#include <algorithm>
#include <cmath>

namespace taut
{
  namespace
  {
    /// Residuals up to this bound need no second measurement.
    constexpr double conspicuous = 1e-10;

    /// Columns of A^-1 end where they have decayed to 1e-18. A motion below this part of the
    /// largest one is hence not known from its own terms.
    constexpr double decayed = 1e-6;

    /// Part of the motion of whole bodies that counts in the scale of a constraint.
    constexpr double part_of_whole_motion = 1e-3;
  } // namespace

  /// Sets gaps from increments of the displacements, not from F N + d.
  void ContactConditions::set_recomputed_gaps(const State &state)
  {
    recomputed.at.multiplier = solved.multiplier;
    recomputed.at.mode_amplitude = solved.mode_amplitude;
    recomputed.at.gap = state.gap;
    for (std::size_t i = 0; i < constraints.size(); ++i)
      if (link_springs.is_mean(i))
      {
        const double N = solved.multiplier[i], u = link_springs.compression(i, N);
        recomputed.at.gap[i] = state.geometric_gap[i] + u + link_springs.lack(i, u, N);
      }
      else if (on_velocities(i))
      {
        const double rebound =
            constraints[i].cone.restitution(c.restitution) * gap_rates.before_step()[i];
        recomputed.at.gap[i] = (1. - c.alpha_f) * step * (state.gap_rate[i] + rebound);
      }
  }

  void ContactConditions::add_decayed_columns(const ComplementarityOperator &F)
  {
    PerKind most = {0., 0.};
    for (std::size_t i = 0; i < constraints.size(); ++i)
      most[constraints[i].rotational] = std::max(
          most[constraints[i].rotational],
          std::fabs(gap_tracker.increments()[i]) + F.diagonal(i) * std::fabs(solved.multiplier[i]));
    for (std::size_t i = 0; i < constraints.size(); ++i)
      problem.gap_scale[i] += decayed * most[constraints[i].rotational];
  }

  /// Adds motions of whole bodies to the scale of a constraint: slopes of a beam that falls without
  /// bending are only rounding. |b . dU|^2 <= (b . A^-1 b) (dU . A dU).
  void ContactConditions::add_inertial_terms(const State &state, const ComplementarityOperator &F)
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
      problem.gap_scale[i] +=
          part_of_whole_motion *
          std::sqrt(std::max(0., sum * (F.diagonal(i) - link_springs.compliance()[i])));
  }

  /// Adds, at rest, motions of what each DoF is tied to, sum_j |K_ij| |U_j| / K_ii: slopes of a
  /// beam that moves without bending are only rounding. An entry of F is a sum over the bodies,
  /// whose terms may cancel, as slopes on both sides of a cut in a straight wire do.
  void ContactConditions::add_elastic_terms(const State &state, const FactoredStructure &bodies)
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
    structure.communicator().sum(size);
    for (std::size_t i = 0; i < constraints.size(); ++i)
      problem.gap_scale[i] += size[i];
  }

  void ContactConditions::measure_residual(const ComplementarityOperator &F)
  {
    gap_terms(problem, F, solved.multiplier, recomputed.at.mode_amplitude, recomputed.terms);
    multiplier_weights(problem, F, solved.multiplier, recomputed.terms, recomputed.weights);
    taut::residual(problem, recomputed.at, recomputed.terms, recomputed.weights, recomputed.found);
  }

  double ContactConditions::residual(const State &state, StepEquations &system, std::size_t &worst)
  {
    if (constraints.size() == 0)
      return 0.;
    const ComplementarityOperator &F = system.interface().matrix();
    set_recomputed_gaps(state);
    if (!c.is_at_rest())
      add_decayed_columns(F);
    measure_residual(F);
    if (!(recomputed.found.max <= conspicuous))
    {
      if (c.is_at_rest())
        add_elastic_terms(state, system.bodies());
      else
        add_inertial_terms(state, F);
      measure_residual(F);
    }
    double max = recomputed.found.max;
    const std::vector<double> &rows = recomputed.found.rows;
    worst = std::max_element(rows.begin(), rows.end()) - rows.begin();
    // Tracked gaps must not drift away from the displacements.
    std::size_t strayed = 0;
    const double stray = gap_tracker.largest_stray(state, strayed);
    if (!(stray <= max) && !std::isnan(max))
    {
      max = stray;
      worst = strayed;
    }
    return max;
  }
} // namespace taut
