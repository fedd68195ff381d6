// SPDX-License-Identifier: LGPL-2.1-or-later
// What the tests of a single cable share: its data, a system of it alone, and a floor below it.
#ifndef taut_tests_one_cable_h
#define taut_tests_one_cable_h

#include "one_body.h"

#include <taut/cable/cable.h>

namespace verification
{
  /// A cable that begins at the origin, under gravity along -y.
  inline taut::CableData cable_to(const taut::Coordinates &to, const double length,
                                  const taut::CableSection &section, const unsigned int n_elements)
  {
    taut::CableData data;
    data.name = "cable";
    data.origin = "Body cable";
    data.to = to;
    data.length = length;
    data.section = section;
    data.gravity = {0., -9.81, 0.};
    data.n_elements = n_elements;
    return data;
  }

  /// A system of one cable, or of a kind of it, that is made from some arguments.
  template <typename Made = taut::Cable>
  struct OneCable : OneBody<Made>
  {
    template <typename... Arguments>
    explicit OneCable(const Arguments &...arguments)
        : OneBody<Made>("cable", arguments...), cable(this->body)
    {
    }

    /// A floor that its inner nodes may touch, so far below the origin.
    void add_floor(const double depth, const double length, const unsigned int n_elements)
    {
      for (unsigned int k = 1; k < n_elements; ++k)
      {
        const double s = length * k / n_elements;
        this->system.add(
            taut::Constraint::unilateral("floor " + std::to_string(k),
                                         this->system.displacement(0, {s, 0., 0.}, {0., 1., 0.}))
                .gap(depth + cable->elements().position(cable->shape().positions, s).y));
      }
    }

    Made *const cable;
  };
} // namespace verification

#endif
