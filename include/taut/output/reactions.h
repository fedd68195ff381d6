// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_reactions_h
#define taut_reactions_h

#include <taut/interface/constraints.h>
#include <taut/model/scene_bodies.h>
#include <taut/time/integrator.h>
#include <taut/time/state.h>

#include <string>
#include <vector>

namespace taut
{
  /// One position of a support of the scene.
  struct SupportPoint
  {
    std::string name;        ///< of the support, with a number from 1 if it has several positions
    std::size_t support = 0; ///< index in the scene
    double position = 0.;    ///< on its wire [m]
    bool is_moment = false;  ///< it holds a slope
  };

  /// All positions of all supports, in the order of the scene.
  std::vector<SupportPoint> support_points(const Scene &scene);

  /**
   * The forces with which supports act on their wires [N], or moments [N m]: positive from the
   * wire's first end to its second (axial), along its normal, to the left of that way (transverse),
   * or its binormal (lateral), and as the slope of these. Of a support that prescribes the motion u
   * it is what the equation of motion lacks along it, M u" + C u' + K u - P - B N with the state at
   * the time in question; of an elastic one -(k u + c u').
   */
  class Reactions
  {
  public:
    /// @p scene and @p structure are kept by reference.
    Reactions(const Scene &scene, const SceneBodies &structure);

    /// In a state whose balance is known: an accepted step of @p scheme. Called by all ranks
    /// together.
    void update(const Reference &reference, const State &state, const Constraints &constraints,
                const StepCoefficients &scheme);

    /// In a state whose balance is not known: the start. Called by all ranks together.
    void update_start(const Reference &reference, State state, const Constraints &constraints);

    /// One for each of the support_points() [N, N m].
    const std::vector<double> &forces() const { return values; }

  private:
    /// Where a support acts.
    struct Place
    {
      bool is_here = false; ///< on this rank
      std::size_t body = 0;
      LinearForm form; ///< of the displacement that it holds
      LinearForm mass; ///< form . M, of a support that prescribes the motion
      double stiffness = 0., damping = 0.;
      bool fixed = false;
    };

    void set_forces(const Reference &reference, const State &state);
    void subtract(const ConstraintData &constraint, double N);

    const SceneBodies &structure;
    std::vector<Place> places;
    std::vector<std::vector<char>> is_held; ///< of each body and DoF: a place prescribes its motion
    std::vector<double> values;             ///< on this rank, then of all
  };
} // namespace taut

#endif
