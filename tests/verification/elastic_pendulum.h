// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_verification_elastic_pendulum_h
#define taut_verification_elastic_pendulum_h

#include <taut/substructure/substructure.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace verification
{
  constexpr double length = 1., bob = 2., gravity = 9.81; // [m], [kg], [m/s^2]

  /// A mass on a massless elastic rod from the origin, in the plane of x and z.
  class ElasticPendulum : public taut::Substructure
  {
  public:
    ElasticPendulum(const double angle, const double EA)
        : Substructure("pendulum"), at{length * std::sin(angle), 0., -length * std::cos(angle)},
          EA(EA)
    {
      auto make = [] { return std::make_unique<taut::CoordinateMatrix>(3); };
      auto m = make();
      for (unsigned int i = 0; i < 3; ++i)
        m->add(i, i, bob);
      M = std::move(m);
      C = make();
      K = make();
      K->add(1., *tangent(std::vector<double>(3, 0.), 0., false));
      constant_force = {0., 0., -bob * gravity};
      finish();
    }
    bool is_linear() const override { return false; }
    bool is_lumped() const override { return true; }
    double strain_energy(const std::vector<double> &U) const override
    {
      const double strain = stretch(U) - 1.;
      return .5 * EA * length * strain * strain;
    }
    void internal_force(const std::vector<double> &U, const std::vector<double> &,
                        std::vector<double> &f) const override
    {
      f.resize(3);
      const double l = stretch(U);
      for (unsigned int i = 0; i < 3; ++i)
        f[i] = EA * (1. - 1. / l) * (at[i] + U[i]) / length;
    }
    void mean_internal_force(const std::vector<double> &U0, const std::vector<double> &U1, double,
                             std::vector<double> &f) const override
    {
      f.resize(3);
      const double stress = EA * (1. - 2. / (stretch(U0) + stretch(U1)));
      for (unsigned int i = 0; i < 3; ++i)
        f[i] = stress * (at[i] + .5 * (U0[i] + U1[i])) / length;
    }
    std::unique_ptr<taut::SymmetricMatrix> tangent(const std::vector<double> &U, double,
                                                   const bool definite) const override
    {
      auto result = std::make_unique<taut::CoordinateMatrix>(3);
      const double l = stretch(U);
      double geometric = EA * (1. - 1. / l) / length;
      if (definite)
        geometric = std::max(0., geometric);
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j <= i; ++j)
        {
          const double t = (at[i] + U[i]) * (at[j] + U[j]) / (l * l * length * length) *
                           (EA / length - geometric);
          result->add(i, j, t + (i == j ? geometric : 0.));
        }
      return result;
    }
    std::unique_ptr<taut::SymmetricMatrix> mean_tangent(const std::vector<double> &U0,
                                                        const std::vector<double> &U1, double,
                                                        const bool definite) const override
    {
      auto result = std::make_unique<taut::CoordinateMatrix>(3);
      const double sum = stretch(U0) + stretch(U1);
      double geometric = EA * (1. - 2. / sum) / length;
      if (definite)
        geometric = std::max(0., geometric);
      const double axial = 4. * EA / (sum * sum * stretch(U1) * length * length * length);
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j <= i; ++j)
        {
          const double mi = at[i] + .5 * (U0[i] + U1[i]), mj = at[j] + .5 * (U0[j] + U1[j]),
                       t = axial * mi * mj;
          result->add(i, j, t + (i == j ? geometric : 0.));
        }
      return result;
    }
    taut::LinearForm displacement(const taut::Coordinates &,
                                  const taut::Coordinates &direction) const override
    {
      taut::LinearForm form;
      for (unsigned int i = 0; i < 3; ++i)
        form.add(i, direction[i]);
      return form;
    }

    double energy(const std::vector<double> &U, const std::vector<double> &V) const
    {
      return strain_energy(U) + bob * gravity * (at[2] + U[2]) +
             .5 * bob * (V[0] * V[0] + V[1] * V[1] + V[2] * V[2]);
    }
    double x(const std::vector<double> &U) const { return at[0] + U[0]; }

  private:
    double stretch(const std::vector<double> &U) const
    {
      double sum = 0.;
      for (unsigned int i = 0; i < 3; ++i)
        sum += (at[i] + U[i]) * (at[i] + U[i]);
      return std::sqrt(sum) / length;
    }
    double at[3], EA;
  };
} // namespace verification

#endif
