// SPDX-License-Identifier: LGPL-2.1-or-later
// How elastic constraints take part in the projection of velocities.
#include <taut/time/velocity_projection.h>

#include <cmath>
#include <limits>

namespace taut
{
  namespace
  {
    /// Fades the projection of elastic constraints out where S exceeds this part of F_ii.
    constexpr double fading = .3;

    /// Part of the diagonal that makes a system with dependent constraints definite.
    constexpr double shift_of_dependent_rows = 1e-9;
  } // namespace

  void VelocityProjection::prepare(const StepCoefficients &coefficients, const double tau,
                                   const std::vector<double> &S, ComplementarityOperator &F)
  {
    c = coefficients;
    step = tau;
    std::vector<std::size_t> elastic;
    moving_elastic.clear();
    for (std::size_t i = 0; i < constraints.size(); ++i)
      if (constraints[i].unilateral && S[i] > 0.)
      {
        elastic.push_back(i);
        has_laws = has_laws || constraints[i].law;
        if (constraints[i].moving)
          moving_elastic.push_back(i);
      }
    has_softening = !elastic.empty();
    find_flexibilities(elastic, S, F);
    set_relative_softening(S);
    if (is_set_up)
      setup();
  }

  void VelocityProjection::find_flexibilities(const std::vector<std::size_t> &elastic,
                                              const std::vector<double> &S,
                                              ComplementarityOperator &F)
  {
    const std::vector<double> diagonal = flexibilities(elastic, F);
    for (const std::size_t i : elastic)
      flexibility[i] = (diagonal[i] - S[i]) / (1. - c.alpha_f);
  }

  void VelocityProjection::set_relative_softening(const std::vector<double> &S)
  {
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      relative_softening[i] = 0.;
      if (!constraints[i].unilateral || S[i] == 0.)
        continue;
      const double ratio = S[i] / (fading * flexibility[i]);
      relative_softening[i] =
          constraints[i].conserving ? std::numeric_limits<double>::infinity() : ratio * ratio;
    }
  }

  /**
   * The diagonal of a matrix of the constraints as the bodies have it with their rigid bilateral
   * constraints closed, F_ii - F_ib F_bb^-1 F_bi, of the constraints listed: bodies that are cut in
   * pieces answer as if they were whole.
   */
  std::vector<double> VelocityProjection::flexibilities(const std::vector<std::size_t> &wanted,
                                                        ComplementarityOperator &F) const
  {
    std::vector<std::size_t> bilateral;
    for (std::size_t i = 0; i < constraints.size(); ++i)
      if (!constraints[i].unilateral && std::isinf(constraints[i].stiffness) && F.diagonal(i) > 0.)
        bilateral.push_back(i);
    std::vector<double> result(constraints.size(), 0.), unit(constraints.size(), 0.), column, x;
    for (const std::size_t i : wanted)
    {
      result[i] = F.diagonal(i);
      if (bilateral.empty())
        continue;
      unit[i] = 1.;
      F.apply(unit, column);
      unit[i] = 0.;
      if (!F.solve(bilateral, column, 0., x))
        F.solve(bilateral, column, shift_of_dependent_rows, x);
      for (const std::size_t b : bilateral)
        result[i] -= column[b] * x[b];
    }
    return result;
  }

  /// f has no softening on the diagonals of what is wanted.
  void VelocityProjection::find_mass_flexibilities(const std::vector<std::size_t> &elastic)
  {
    const std::vector<double> diagonal = flexibilities(elastic, schur->matrix());
    for (const std::size_t i : elastic)
      of_mass[i] = diagonal[i];
  }

  void VelocityProjection::set_softening()
  {
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      const double f = of_mass[i];
      // Infinite: a constraint without flexibility of its own takes no part.
      softening[i] =
          f > 0. && std::isfinite(relative_softening[i]) ? f * relative_softening[i] : 0.;
    }
    schur->set_compliance(softening);
  }

  /// Softening follows the places, too.
  void VelocityProjection::update_moving()
  {
    if (moving_elastic.empty())
    {
      schur->update_moving();
      return;
    }
    for (const std::size_t i : moving_elastic)
      softening[i] = 0.;
    schur->set_compliance(softening);
    schur->update_moving();
    find_mass_flexibilities(moving_elastic);
    set_softening();
  }
} // namespace taut
