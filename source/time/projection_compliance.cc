// SPDX-License-Identifier: LGPL-2.1-or-later
// How elastic constraints take part in the projection of velocities.
#include <taut/time/contact_resolution.h>
#include <taut/time/velocity_projection.h>

#include <cmath>
#include <limits>

namespace taut
{
  namespace
  {
    /// Fades the projection of elastic constraints out where S exceeds this part of F_ii.
    constexpr double fading = .3;
  } // namespace

  void VelocityProjection::prepare(const StepCoefficients &coefficients, const double tau,
                                   const std::vector<double> &S, ComplementarityOperator &F)
  {
    c = coefficients;
    step = tau;
    std::vector<std::size_t> elastic;
    moving_elastic.clear();
    for (std::size_t i = 0; i < constraints.size(); ++i)
      if (constraints[i].cone.may_open() && S[i] > 0.)
      {
        elastic.push_back(i);
        has_laws = has_laws || constraints[i].spring.law;
        if (constraints.slides(i))
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
    const std::vector<double> diagonal = flexibilities_of_whole_bodies(constraints, elastic, F);
    for (const std::size_t i : elastic)
      flexibility[i] = (diagonal[i] - S[i]) / (1. - c.alpha_f);
  }

  void VelocityProjection::set_relative_softening(const std::vector<double> &S)
  {
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      relative_softening[i] = 0.;
      if (!constraints[i].cone.may_open() || S[i] == 0.)
        continue;
      const double ratio = S[i] / (fading * flexibility[i]);
      relative_softening[i] = constraints[i].spring.conserving
                                  ? std::numeric_limits<double>::infinity()
                                  : ratio * ratio;
    }
  }

  /// f has no softening on the diagonals of what is wanted.
  void VelocityProjection::find_mass_flexibilities(const std::vector<std::size_t> &elastic)
  {
    const std::vector<double> diagonal =
        flexibilities_of_whole_bodies(constraints, elastic, schur->matrix());
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
