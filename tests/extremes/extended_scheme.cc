// SPDX-License-Identifier: LGPL-2.1-or-later
#include "extended_scheme.h"

#include <stdexcept>

namespace extremes
{
  ExtendedScheme::ExtendedScheme(const std::string &name, const Number &step)
      : name(name), tau(step)
  {
    const Number half = Number(1) / 2;
    if (name == "backward Euler")
    {
      velocity = 1 / tau;
      acceleration = 1 / (tau * tau);
    }
    else if (name == "BDF2")
    {
      velocity = 3 / (2 * tau);
      acceleration = 9 / (4 * tau * tau);
    }
    else if (name == "generalised-alpha")
    {
      // Chung and Hulbert with the default spectral radius, the double 0.8.
      const Number rho = .8;
      alpha_m = (2 * rho - 1) / (rho + 1);
      alpha_f = rho / (rho + 1);
      const Number root = 1 - alpha_m + alpha_f;
      gamma = half - alpha_m + alpha_f;
      beta = root * root / 4;
      acceleration = 1 / (beta * tau * tau);
      velocity = gamma / (beta * tau);
    }
    else if (name == "Moreau-Jean" || name == "Moreau-Jean of gaps")
    {
      // U - U_0 = tau (V + V_0) / 2, A = (V - V_0) / tau, and the mean of both balances.
      alpha_f = half;
      velocity = 2 / tau;
      acceleration = 2 / (tau * tau);
      has_mean_forces = true;
      projects = name == "Moreau-Jean";
    }
    else
      throw std::logic_error("the extended run has no scheme " + name);
  }

  void ExtendedScheme::look_back(const ExtendedMotion &m, Vector &v, Vector &a) const
  {
    v.resize(m.U.size());
    a.resize(m.U.size());
    for (std::size_t k = 0; k < m.U.size(); ++k)
      if (name == "BDF2")
      {
        v[k] = (m.U_old[k] - 4 * m.U[k]) / (2 * tau);
        a[k] = (3 * v[k] - 4 * m.V[k] + m.V_old[k]) / (2 * tau);
      }
      else if (name == "backward Euler")
      {
        v[k] = -m.U[k] / tau;
        a[k] = (v[k] - m.V[k]) / tau;
      }
      else if (has_mean_forces)
      {
        v[k] = -2 * m.U[k] / tau - m.V[k];
        a[k] = (v[k] - m.V[k]) / tau;
      }
      else
      {
        a[k] = -acceleration * (m.U[k] + tau * m.V[k]) - (1 / (2 * beta) - 1) * m.A[k];
        v[k] = m.V[k] + tau * ((1 - gamma) * m.A[k] + gamma * a[k]);
      }
  }
} // namespace extremes
