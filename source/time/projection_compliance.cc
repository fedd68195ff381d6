// SPDX-License-Identifier: LGPL-2.1-or-later
#include "time/projection_compliance.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace taut
{
  namespace
  {
    /// Part of F_ii above which S fades the projection of elastic constraints out.
    constexpr double fading = .3;

    /// Most coefficients whose flexibilities are kept: more than there are lengths of adaptive
    /// steps.
    constexpr std::size_t most_known = 16;
  } // namespace

  ProjectionCompliance::ProjectionCompliance(const Constraints &constraints)
      : constraints(constraints), bodies(constraints)
  {
    for (std::vector<double> *v : {&flexibility, &of_mass, &relative, &softening})
      v->assign(constraints.size(), 0.);
  }

  void ProjectionCompliance::prepare(const StepCoefficients &c, const std::vector<double> &S,
                                     ComplementarityOperator &F, const bool is_linear)
  {
    theta = 1. - c.alpha_f;
    if (!is_linear || known.size() == most_known)
      known.clear();
    elastic.clear();
    moving_elastic.clear();
    for (std::size_t i = 0; i < constraints.size(); ++i)
      if (constraints[i].cone.may_open() && S[i] > 0.)
      {
        elastic.push_back(i);
        has_laws = has_laws || constraints[i].spring.law;
        if (constraints.slides(i))
          moving_elastic.push_back(i);
      }
    const auto before =
        std::find_if(known.begin(), known.end(), [&](const Known &one) { return one.c == c; });
    if (before != known.end())
      flexibility = before->flexibility;
    else
    {
      find_flexibilities(elastic, S, F);
      known.push_back({c, flexibility});
    }
    set_relative(S);
  }

  void ProjectionCompliance::find_flexibilities(const std::vector<std::size_t> &rows,
                                                const std::vector<double> &S,
                                                ComplementarityOperator &F)
  {
    const std::vector<double> &diagonal = bodies.flexibilities(rows, F);
    for (const std::size_t i : rows)
      flexibility[i] = (diagonal[i] - S[i]) / theta;
  }

  void ProjectionCompliance::set_relative(const std::vector<double> &S)
  {
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      relative[i] = 0.;
      if (!constraints[i].cone.may_open() || S[i] == 0.)
        continue;
      const double ratio = S[i] / (fading * flexibility[i]);
      relative[i] = constraints[i].spring.conserving ? std::numeric_limits<double>::infinity()
                                                     : ratio * ratio;
    }
  }

  void ProjectionCompliance::follow(const std::vector<double> &S, ComplementarityOperator &F,
                                    SchurComplement *const f)
  {
    if (!moving_elastic.empty())
      find_flexibilities(moving_elastic, S, F);
    if (!has_laws && moving_elastic.empty())
      return;
    set_relative(S);
    if (f)
      set(*f);
  }

  bool ProjectionCompliance::takes_part(const std::size_t i) const
  {
    return std::isfinite(relative[i]);
  }

  /// f must have no softening on the diagonals of @p rows.
  void ProjectionCompliance::find_mass_flexibilities(const std::vector<std::size_t> &rows,
                                                     SchurComplement &f)
  {
    const std::vector<double> &diagonal = bodies.flexibilities(rows, f.matrix());
    for (const std::size_t i : rows)
      of_mass[i] = diagonal[i];
  }

  void ProjectionCompliance::set(SchurComplement &f)
  {
    // Infinite for a constraint without flexibility, which takes no part.
    for (std::size_t i = 0; i < constraints.size(); ++i)
      softening[i] = of_mass[i] > 0. && takes_part(i) ? of_mass[i] * relative[i] : 0.;
    f.set_compliance(softening);
  }

  void ProjectionCompliance::setup(SchurComplement &f, const bool masses_changed)
  {
    std::fill(softening.begin(), softening.end(), 0.);
    if (masses_changed)
    {
      f.setup(softening);
      std::fill(of_mass.begin(), of_mass.end(), 0.);
    }
    else
    {
      f.set_compliance(softening);
      f.update_moving();
    }
    if (elastic.empty())
      return;
    softened.clear();
    for (std::size_t i = 0; i < constraints.size(); ++i)
      if (relative[i] > 0. && (constraints.slides(i) || of_mass[i] == 0.))
        softened.push_back(i);
    find_mass_flexibilities(softened, f);
    set(f);
  }

  void ProjectionCompliance::update_moving(SchurComplement &f)
  {
    if (moving_elastic.empty())
    {
      f.update_moving();
      return;
    }
    for (const std::size_t i : moving_elastic)
      softening[i] = 0.;
    f.set_compliance(softening);
    f.update_moving();
    find_mass_flexibilities(moving_elastic, f);
    set(f);
  }
} // namespace taut
