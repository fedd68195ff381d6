// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_reactions_h
#define taut_reactions_h

#include <taut/interface/constraints.h>
#include <taut/model/scene_bodies.h>
#include <taut/time/state.h>
#include <taut/time/step_report.h>

#include <string>
#include <vector>

namespace taut
{
  /// One position of a support in the scene.
  struct SupportPoint
  {
    std::string name;        ///< of the support, numbered from 1 if it has several positions
    std::size_t support = 0; ///< index in the scene
    double position = 0.;    ///< on its wire [m]
    bool is_moment = false;  ///< it holds a slope
  };

  /// All positions of all supports, in the order of the scene.
  std::vector<SupportPoint> support_points(const Scene &scene);

  /**
   * The forces [N] or moments [N m] of supports on their wires. Axial forces are positive from the
   * wire's first end to its second. Transverse forces are positive along its normal, to the left of
   * that way, lateral forces along its binormal, moments as the slope. At a prescribed motion u the
   * force is the residual M u" + C u' + K u - P - B N of the equation of motion at the time of the
   * state. At an elastic support it is -(k u + c u').
   */
  class Reactions
  {
  public:
    /// @p scene and @p structure are kept by reference.
    Reactions(const Scene &scene, const SceneBodies &structure);

    /// Updates forces for a state with a known balance: an accepted step, and what it told. Called
    /// by all ranks together.
    void update(const Reference &reference, const State &state, const Constraints &constraints,
                const StepReport &report);

    /// Updates forces for the start, without a known balance. Called by all ranks together.
    void update_start(const Reference &reference, State state, const Constraints &constraints);

    /// A force for each of the support_points() [N, N m].
    const std::vector<double> &forces() const { return values; }

  private:
    /// Place of a support.
    struct Place
    {
      bool is_here = false; ///< on this rank
      std::size_t body = 0;
      LinearForm form; ///< of the supported displacement
      LinearForm mass; ///< form . M, for a prescribed motion
      double stiffness = 0., damping = 0.;
      double free_of_force = 0.; ///< displacement where the spring is [m, rad]
      bool fixed = false;
    };

    void set_forces(const Reference &reference, const State &state);
    void subtract(const ConstraintData &constraint, double N);

    const SceneBodies &structure;
    std::vector<Place> places;
    std::vector<std::vector<char>> is_held; ///< of each body and DoF: prescribed by a support
    std::vector<double> values;             ///< on this rank, then over all ranks
  };
} // namespace taut

#endif
