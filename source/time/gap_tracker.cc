// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/sum_together.h>
#include <taut/time/gap_tracker.h>
#include <taut/time/matrix_norms.h>

#include <algorithm>
#include <cmath>

namespace taut
{
  namespace
  {
    /// Part of the largest terms of a gap so far below which terms count as rest: motion that
    /// contacts stopped leaves rounding, which contradicts itself between constraints.
    constexpr double part_of_largest = 1e-3;

    /// What the gap of a constraint rounds with. Gaps of surfaces are differences of coordinates
    /// that are far larger, but exact.
    double size_of_gap(const ConstraintData &constraint)
    {
      return std::fabs(constraint.gap) +
             (constraint.contact == no_contact ? constraint.gap_size : 0.);
    }
  } // namespace

  GapTracker::GapTracker(const Structure &structure, const Constraints &constraints,
                         const TurningConstraints &turning, const Reference &reference,
                         const State &start)
      : structure(structure), constraints(constraints), turning(turning), reference(reference)
  {
    const std::size_t n = constraints.size();
    for (auto *v : {&gap_terms, &gap_correction, &motion, &motion_size, &position, &terms_size,
                    &scale_of_step, &largest_scale})
      v->assign(n, 0.);
    reference_gap = constraints.motions(reference.displacement);
    const std::vector<double> motions = constraints.motions(start.U);
    for (std::size_t i = 0; i < n; ++i)
    {
      reference_gap[i] += constraints[i].gap;
      if (constraints.slides(i))
        gap_correction[i] = start.geometric_gap[i] - reference_gap[i] - motions[i];
      else if (!reference.gap.empty())
        reference_gap[i] = reference.gap[i];
    }
    add_body_terms(reference.displacement);
  }

  void GapTracker::predict(const State &before, const StepEquations &system, const BodyVectors &P,
                           const BodyVectors *const lift)
  {
    system.interface().contact_free_predictor(P, motion, motion_size);
    if (lift)
      for (std::size_t i = 0; i < constraints.size(); ++i)
        motion[i] += evaluate(constraints[i].terms, *lift);
    for (const std::size_t i : constraints.sliding_rows())
    {
      const std::vector<Term> &terms = constraints[i].terms;
      position[i] = evaluate(terms, reference.displacement) + evaluate(terms, before.U);
      terms_size[i] = magnitude(terms, reference.displacement) + magnitude(terms, before.U);
    }
    sum_together(structure.communicator(), {&motion, &motion_size, &position, &terms_size});
  }

  double GapTracker::gap_of_place(const std::size_t i) const
  {
    return constraints[i].gap + gap_correction[i] + position[i];
  }

  double GapTracker::free_gap(const std::size_t i, const State &before) const
  {
    if (constraints.slides(i))
      return gap_of_place(i);
    return constraints.turns(i) ? before.geometric_gap[i] + turning.offset(i)
                                : before.geometric_gap[i];
  }

  double GapTracker::set_scale(const std::size_t i, const State &before, const double other)
  {
    double scale = constraints.slides(i) ? std::fabs(constraints[i].gap) + terms_size[i]
                                         : std::fabs(before.geometric_gap[i]);
    if (constraints.turns(i))
      scale += turning.distance(i);
    scale += motion_size[i];
    scale += std::fabs(motion[i]) + other;
    scale_of_step[i] = scale;
    return std::max(scale, part_of_largest * largest_scale[i]);
  }

  void GapTracker::measure(const State &state)
  {
    constraints.share_of_motions(state.dU, motion);
    constraints.share_of_motions(state.U, position, terms_size);
    for (const std::size_t i : constraints.sliding_rows())
      position[i] += evaluate(constraints[i].terms, reference.displacement);
    sum_together(structure.communicator(), {&motion, &position, &terms_size});
  }

  double GapTracker::new_gap(const std::size_t i, const State &state)
  {
    largest_scale[i] = std::max(largest_scale[i], scale_of_step[i]);
    if (constraints.slides(i))
      return gap_of_place(i);
    return state.geometric_gap[i] + (constraints.turns(i) ? turning.increment(i) : motion[i]);
  }

  void GapTracker::correct(const BodyVectors &dU, State &state)
  {
    const std::vector<double> moved = constraints.motions(dU);
    for (std::size_t i = 0; i < constraints.size(); ++i)
      for (double *const x : {&motion[i], &position[i], &state.geometric_gap[i]})
        *x += moved[i];
  }

  double GapTracker::largest_stray(const State &state, std::size_t &worst)
  {
    // At a support, a constraint moves only by the rounding of its body.
    constexpr double suspicious = 1e-12;
    const double found = stray(state, worst);
    if (found <= suspicious)
      return found;
    add_body_terms(state.U);
    return stray(state, worst);
  }

  double GapTracker::stray(const State &state, std::size_t &worst)
  {
    double max = 0.;
    for (const std::size_t i : constraints.fixed_rows())
    {
      gap_terms[i] = std::max(gap_terms[i], std::fabs(reference_gap[i]) + terms_size[i]);
      const double error = std::fabs(reference_gap[i] + position[i] - state.geometric_gap[i]),
                   relative = error == 0. ? 0. : error / gap_terms[i];
      if (!(relative <= max) && !std::isnan(max))
      {
        max = relative;
        worst = i;
      }
    }
    return max;
  }

  /// Sizes of the terms of B^T U, if a displacement rounds with the largest one of its body.
  std::vector<double> GapTracker::body_terms(const BodyVectors &U) const
  {
    std::vector<PerKind> size;
    for (std::size_t k = 0; k < structure.size(); ++k)
      size.push_back(largest(structure[k], U[k]));
    std::vector<double> terms(constraints.size(), 0.);
    for (std::size_t i = 0; i < constraints.size(); ++i)
      for (const auto &[k, form, of] : constraints[i].terms)
        for (std::size_t j = 0; j < form.index.size(); ++j)
          terms[i] += std::fabs(form.value[j]) * size[k][structure[k].kind(form.index[j])];
    structure.communicator().sum(terms);
    return terms;
  }

  void GapTracker::add_body_terms(const BodyVectors &U)
  {
    const std::vector<double> terms = body_terms(U);
    for (std::size_t i = 0; i < constraints.size(); ++i)
      gap_terms[i] = std::max(gap_terms[i], size_of_gap(constraints[i]) + terms[i]);
  }

  void GapTracker::count_motions(const BodyVectors &U)
  {
    const std::vector<double> terms = body_terms(U), moved = constraints.motions(U);
    for (std::size_t i = 0; i < constraints.size(); ++i)
      largest_scale[i] = std::max(largest_scale[i],
                                  terms[i] + (size_of_gap(constraints[i]) + std::fabs(moved[i])) /
                                                 part_of_largest);
  }
} // namespace taut
