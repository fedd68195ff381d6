// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_mechanism_rigid_body_run_h
#define taut_mechanism_rigid_body_run_h

#include "common.h"
#include "one_body.h"

#include "base/dot.h"
#include <taut/mechanism/rigid_body.h>

namespace mechanism
{

  struct OneBody : verification::OneBody<taut::RigidBody>
  {
    explicit OneBody(const taut::RigidBodyData &data)
        : verification::OneBody<taut::RigidBody>(data.name, data)
    {
    }

    void hold(const taut::Coordinates &place)
    {
      for (const taut::Coordinates &axis :
           {taut::Coordinates{1., 0., 0.}, {0., 1., 0.}, {0., 0., 1.}})
        system.add(taut::Constraint::bilateral("joint", system.displacement(0, place, axis)));
    }

    /// Kinetic energy, without or with that of the weight [J].
    double energy(const taut::Stepper &stepper) const
    {
      const std::vector<double> &V = stepper.state().V[0];
      std::vector<double> P;
      body->external_force(0., P);
      return .5 * taut::dot(V, verification::matrix_times(body->mass(), V)) -
             taut::dot(P, stepper.displacement(0));
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
} // namespace mechanism

#endif
