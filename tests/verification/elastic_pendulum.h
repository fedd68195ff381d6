// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_verification_elastic_pendulum_h
#define taut_verification_elastic_pendulum_h

#include "common.h"

#include <taut/substructure/substructure.h>

#include <deal.II/base/tensor.h>

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
      auto make = [] { return std::make_unique<taut::CompressedMatrix>(3); };
      auto m = make();
      for (unsigned int i = 0; i < 3; ++i)
        m->add(i, i, bob);
      M = std::move(m);
      C = make();
      K = make();
      K->add(1., *tangent(std::vector<double>(3, 0.), {}, 0., false));
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
      set_force(EA * (1. - 1. / stretch(U)), place(U, U), f);
    }
    void mean_internal_force(const std::vector<double> &U0, const std::vector<double> &U1,
                             const double step, std::vector<double> &f) const override
    {
      set_force(EA * (1. - 2. / (stretch(U0) + stretch(U1))), place(U0, U1), f);
      if (change_force)
        change_force(U0, U1, step, f);
    }
    std::unique_ptr<taut::SymmetricMatrix> tangent(const std::vector<double> &U,
                                                   const std::vector<double> &, double,
                                                   const bool definite) const override
    {
      const double l = stretch(U), geometric = bounded(EA * (1. - 1. / l) / length, definite);
      return matrix((EA / length - geometric) / (l * l * length * length), place(U, U), geometric);
    }
    std::unique_ptr<taut::SymmetricMatrix> mean_tangent(const std::vector<double> &U0,
                                                        const std::vector<double> &U1,
                                                        const double rate,
                                                        const bool definite) const override
    {
      const double sum = stretch(U0) + stretch(U1);
      auto K = matrix(4. * EA / (sum * sum * stretch(U1) * length * length * length), place(U0, U1),
                      bounded(EA * (1. - 2. / sum) / length, definite));
      if (change_tangent)
        change_tangent(U0, rate, *K);
      return K;
    }
    taut::LinearForm displacement(const taut::Coordinates &,
                                  const taut::Coordinates &direction) const override
    {
      taut::LinearForm form;
      for (unsigned int i = 0; i < 3; ++i)
        form.add(i, direction[i]);
      return form;
    }

    /// Change the mean force and its tangent, for pendulums that are not as they should be.
    std::function<void(const std::vector<double> &U0, const std::vector<double> &U1, double step,
                       std::vector<double> &f)>
        change_force;
    std::function<void(const std::vector<double> &U0, double rate, taut::SymmetricMatrix &K)>
        change_tangent;

    double energy(const std::vector<double> &U, const std::vector<double> &V) const
    {
      return strain_energy(U) + bob * gravity * (at[2] + U[2]) +
             .5 * bob * (V[0] * V[0] + V[1] * V[1] + V[2] * V[2]);
    }
    double x(const std::vector<double> &U) const { return at[0] + U[0]; }

  private:
    using Place = dealii::Tensor<1, 3>;

    /// Mean place of two times.
    Place place(const std::vector<double> &U0, const std::vector<double> &U1) const
    {
      Place result;
      for (unsigned int i = 0; i < 3; ++i)
        result[i] = at[i] + .5 * (U0[i] + U1[i]);
      return result;
    }
    double stretch(const std::vector<double> &U) const { return place(U, U).norm() / length; }
    static double bounded(const double geometric, const bool definite)
    {
      return definite ? std::max(0., geometric) : geometric;
    }
    static void set_force(const double stress, const Place &x, std::vector<double> &f)
    {
      f.resize(3);
      for (unsigned int i = 0; i < 3; ++i)
        f[i] = stress * x[i] / length;
    }
    /// @p axial x x^T and @p geometric times the identity.
    static std::unique_ptr<taut::SymmetricMatrix> matrix(const double axial, const Place &x,
                                                         const double geometric)
    {
      auto result = std::make_unique<taut::CompressedMatrix>(3);
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j <= i; ++j)
          result->add(i, j, axial * x[i] * x[j] + (i == j ? geometric : 0.));
      return result;
    }
    double at[3], EA;
  };
} // namespace verification

#endif
