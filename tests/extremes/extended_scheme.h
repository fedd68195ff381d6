// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_extremes_extended_scheme_h
#define taut_extremes_extended_scheme_h

#include "extended_model.h"

namespace extremes
{
  /// Of all bodies at the end of a step, and what schemes look back at.
  struct ExtendedMotion
  {
    Vector U, V, A, U_old, V_old;
  };

  /// A scheme for steps of one length by its name in parameter files, with the defaults of its
  /// entries: "Moreau-Jean" has conditions on gaps, then velocities. "Moreau-Jean of gaps" has them
  /// on gaps only. V = velocity U + v and A = acceleration U + a at the end of a step with known v
  /// and a, and old inertia and balance have the weights alpha_m and alpha_f.
  struct ExtendedScheme
  {
    ExtendedScheme() = default;
    ExtendedScheme(const std::string &name, const Number &step);

    void look_back(const ExtendedMotion &before, Vector &v, Vector &a) const;

    std::string name;
    Number alpha_m = 0, alpha_f = 0, velocity = 0, acceleration = 0;
    bool has_mean_forces = false; ///< of contacts, over a step
    bool projects = false;        ///< velocities at the ends of steps

    /// True if a first step needs nothing that backward Euler would have to find.
    bool starts_itself() const { return has_mean_forces; }

  private:
    Number tau = 0, beta = 0, gamma = 0;
  };
} // namespace extremes

#endif
