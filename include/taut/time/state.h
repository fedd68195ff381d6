// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_state_h
#define taut_state_h

#include <taut/substructure/structure.h>

#include <array>
#include <vector>

namespace taut
{
  /// The reference of motions: a static equilibrium, or the undeformed structure. It keeps small
  /// motions from drowning in large coordinates.
  struct Reference
  {
    BodyVectors displacement;       ///< U_ref [m, rad]
    BodyVectors force;              ///< K U_ref [N, N m]
    std::vector<double> multiplier; ///< N [N, N m]

    /// Gap of each constraint, exact for closed constraints and without the rounding of B^T U_ref;
    /// empty: gaps come from the displacements [m, rad].
    std::vector<double> gap;
  };

  /// What the rows of the constraints have at one time, the same on all ranks that have a row.
  struct RowStates
  {
    std::vector<double> multiplier;          ///< N, or its mean over the step [N, N m]
    std::vector<double> complementarity_gap; ///< D of the complementarity conditions [m, rad]
    std::vector<double> distance; ///< B^T (U_ref + U) + gap at U = 0; negative: the spring is
                                  ///< compressed [m, rad]
    std::vector<double> rate;     ///< D', only with mean forces [m/s, rad/s]

    /// Compression of each row's spring and its rates, integrated in time as a body [m, rad].
    struct Spring
    {
      double u = 0., v = 0., a = 0., du = 0.;

      template <typename Archive>
      void serialize(Archive &archive, unsigned int)
      {
        archive &u &v &a &du;
      }
    };
    std::vector<Spring> springs;

    template <typename Archive>
    void serialize(Archive &archive, unsigned int)
    {
      archive &multiplier &complementarity_gap &distance &rate &springs;
    }
  };

  /// Motion of the bodies and the rows at one time.
  struct State : RowStates
  {
    double time = 0.;      ///< [s]
    double last_step = 0.; ///< length of the step that ended here; 0: none [s]

    BodyVectors U;     ///< displacement from the reference [m, rad]
    BodyVectors V;     ///< velocity [m/s, rad/s]
    BodyVectors A;     ///< acceleration [m/s^2, rad/s^2]
    BodyVectors dU;    ///< increment of the last step [m, rad]
    BodyVectors V_old; ///< velocity before the last step [m/s, rad/s]
    BodyVectors KU;    ///< K U [N, N m]
    /// P + B N - C V - K (U_ref + U), without mean forces [N, N m].
    BodyVectors balance;

    /// For Boost's archives: what is equal on all ranks.
    template <typename Archive>
    void serialize(Archive &archive, const unsigned int version)
    {
      archive &time &last_step;
      RowStates::serialize(archive, version);
    }

    /// The vectors of the bodies of this rank.
    std::array<BodyVectors *, 7> of_bodies() { return {&U, &V, &A, &dU, &V_old, &KU, &balance}; }
  };

  /// The bodies of this rank at U = 0 and at rest at t = 0, with @p n_constraints constraints
  /// without forces.
  inline State state_at_rest(const Structure &structure, const std::size_t n_constraints)
  {
    State state;
    for (BodyVectors *v : state.of_bodies())
      *v = structure.zero();
    for (std::vector<double> *v : {&state.multiplier, &state.complementarity_gap, &state.distance})
      v->assign(n_constraints, 0.);
    state.springs.resize(n_constraints);
    return state;
  }

  /// U = U_ref + U of body k, its displacement from the undeformed body [m, rad].
  inline void copy_displacement(const Reference &reference, const State &state, const std::size_t k,
                                std::vector<double> &U)
  {
    U = reference.displacement[k];
    for (std::size_t i = 0; i < U.size(); ++i)
      U[i] += state.U[k][i];
  }

  /// The same as a new vector.
  inline std::vector<double> displacement(const Reference &reference, const State &state,
                                          const std::size_t k)
  {
    std::vector<double> U;
    copy_displacement(reference, state, k, U);
    return U;
  }
} // namespace taut

#endif
