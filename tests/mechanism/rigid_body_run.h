// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_mechanism_rigid_body_run_h
#define taut_mechanism_rigid_body_run_h

#include "one_body.h"

#include <taut/mechanism/rigid_body.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace mechanism
{
  const double pi = std::acos(-1.);

  /// A rigid body alone in a system, to which constraints may be added.
  struct OneBody : verification::OneBody<taut::RigidBody>
  {
    explicit OneBody(const taut::RigidBodyData &data)
        : verification::OneBody<taut::RigidBody>(data.name, data)
    {
    }

    /// Holds a place along x, y and z.
    void hold(const taut::Coordinates &place)
    {
      for (const taut::Coordinates &axis :
           {taut::Coordinates{1., 0., 0.}, {0., 1., 0.}, {0., 0., 1.}})
        system.add(taut::Constraint::bilateral("joint", system.displacement(0, place, axis)));
    }

    /// Kinetic energy, without or with that of the weight [J].
    double energy(const taut::Stepper &stepper) const
    {
      const std::vector<double> U = stepper.displacement(0), &V = stepper.state().V[0];
      std::vector<double> P, MV(V.size(), 0.);
      body->external_force(0., P);
      body->mass().vmult_add(.5, V.data(), MV.data());
      double sum = 0.;
      for (std::size_t i = 0; i < U.size(); ++i)
        sum += V[i] * MV[i] - P[i] * U[i];
      return sum;
    }
  };

  inline taut::StepperOptions given(const double step, const std::string &scheme = "automatic")
  {
    return verification::steps_of(step, taut::Start::given, scheme);
  }

  /// R x for a rotation by |turn| about it (Rodrigues).
  inline taut::Coordinates turned(const taut::Coordinates &turn, const taut::Coordinates &x)
  {
    const double angle = norm(turn);
    if (angle == 0.)
      return x;
    const taut::Coordinates e = taut::add_scaled({}, 1. / angle, turn);
    return taut::add_scaled(
        taut::add_scaled(taut::add_scaled({}, std::cos(angle), x), std::sin(angle), cross(e, x)),
        (1. - std::cos(angle)) * dot(e, x), e);
  }

  /// Complete elliptic integral of the first kind, by the arithmetic-geometric mean.
  inline double elliptic_K(const double k)
  {
    double a = 1., b = std::sqrt(1. - k * k);
    for (int i = 0; i < 60; ++i)
    {
      const double mean = .5 * (a + b);
      b = std::sqrt(a * b);
      a = mean;
    }
    return pi / (2. * a);
  }
} // namespace mechanism

#endif
