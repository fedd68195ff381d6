// SPDX-License-Identifier: LGPL-2.1-or-later
#include "extended_scheme.h"

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
    const Number two = 2, three = 3, four = 4;
    if (name == "BDF2")
    {
      v = (m.U_old - four * m.U) / (two * tau);
      a = (three * v - four * m.V + m.V_old) / (two * tau);
    }
    else if (name == "backward Euler" || has_mean_forces)
    {
      v = has_mean_forces ? Vector(-two / tau * m.U - m.V) : Vector(-m.U / tau);
      a = (v - m.V) / tau;
    }
    else
    {
      a = -acceleration * (m.U + tau * m.V) - (1 / (2 * beta) - 1) * m.A;
      v = m.V + tau * ((1 - gamma) * m.A + gamma * a);
    }
  }
} // namespace extremes
