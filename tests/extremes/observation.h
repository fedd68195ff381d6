// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_extremes_observation_h
#define taut_extremes_observation_h

#include "common.h"

#include <taut/scene/scene.h>

namespace verification
{
  class Session;
}

namespace extremes
{
  /// A scene with what its run needs; small enough for the extended model, or not.
  struct Case
  {
    std::string family, name;
    taut::Scene scene;
    std::string scheme = "backward Euler";
    double step = 1e-3;
    unsigned int n_steps = 4; ///< at least 1
    unsigned int n_parts = 1;
    std::string local_solver = "block tridiagonal";
    std::string interface_operator = "assembled dense";
    std::string complementarity = "semismooth Newton";

    /// Of each link, for the extended run: its mean force keeps the energy of its spring, see
    /// taut::ConstraintData::conserving. The program decides it; empty: of none.
    std::vector<char> conserving;
  };

  /// What is compared of a step, by unit: no metre is ever compared with a newton or a radian.
  enum Quantity
  {
    displacement,
    rotation,
    force,
    moment,
    gap,
    angular_gap,
    n_quantities
  };
  using Observation = std::array<std::vector<double>, n_quantities>;

  /// Steps of a run, the start first; or why there are none.
  struct Answer
  {
    std::vector<Observation> steps;
    std::string error;            ///< empty if there is an answer
    std::string scheme;           ///< of the last step, if `automatic` chose it
    std::vector<char> conserving; ///< of each link, or constraint of a contact, in the program
    double certificate = 0.;      ///< largest of the run

    /// Of the extended run: largest |K||U|, and motion of a constraint under its own force.
    double elastic_force = 0., elastic_moment = 0., row_motion = 0., row_turn = 0.;
    unsigned int iterations = 0, n_fallbacks = 0;
  };

  /// A case, ready to run through the whole program, which keeps a reference to it.
  verification::Session session_of(const Case &c);

  /// Runs a case through the whole program, from parameters to certificates. A UserError is an
  /// answer's error; anything else that is thrown is a failure of the test.
  Answer program_answer(const Case &c);

  /// What each quantity of a run is measured by: its largest value; of forces the largest load or
  /// elastic force if that is larger, of gaps the largest displacement, or what a contact force
  /// alone would move, because these are sums.
  std::array<double, n_quantities> scales(const Case &c, const Answer &answer);

  /// Displacements and slopes that are observed: of all masses, of up to nine nodes a wire.
  struct ObservedPoint
  {
    taut::Attachment at;
    bool rotational = false;
    taut::Coordinates direction;
  };
  std::vector<ObservedPoint> observed_points(const taut::Scene &scene);

  /// Of each link the first one that acts alike: only the sum of their forces is unique.
  std::vector<std::size_t> groups_of_links(const taut::Scene &scene);

  struct Deviation
  {
    double excess = 0.; ///< over what is allowed; more than 1 is a failure
    std::string where;
  };

  /// Compares two runs. An entry may deviate by @p relative of its own largest value in the run, by
  /// @p absolute of the scale of its quantity, and by a thousand times what it changes from b to
  /// one of @p neighbours, the same scene with all its numbers changed in their last digit.
  Deviation compare(const std::vector<Observation> &a, const std::vector<Observation> &b,
                    const std::array<double, n_quantities> &scales,
                    const std::vector<std::vector<Observation>> &neighbours, double relative,
                    double absolute);
} // namespace extremes

#endif
