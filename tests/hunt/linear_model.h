// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_hunt_linear_model_h
#define taut_hunt_linear_model_h

#include "history.h"
#include "scenes.h"

#include "base/dot.h"
#include <taut/output/observer.h>

#include <deal.II/lac/full_matrix.h>

namespace hunt
{
  using taut::dot;
  using Vector = std::vector<double>;

  /// A scene of linear bodies in dense matrices, free DoFs only:
  ///
  ///     M u" + C u' + K u = P0 + Pc cos(w t) + Ps sin(w t) + Pp p(t) + B N.
  ///
  /// A pulse p(t) rises from 0 to 1 and falls to 0. Prescribed places are sines of w, too; what
  /// they do to the free DoFs is part of the loads.
  ///
  /// The discretisation in space is the program's, so that what differs is the integration in time.
  struct LinearModel
  {
    /// From the start of a run. @p frequency is that of its loads, 0 if they are constant [rad/s];
    /// only these may have a pulse. Throws std::runtime_error if a load has another course, or if a
    /// body is not linear.
    LinearModel(const taut::StepView &start, double frequency, const Pulse &pulse);

    /// A constraint, D = terms . u + gap, see taut::ConstraintData.
    struct Row
    {
      Vector terms;
      double gap;
      bool unilateral;
      double stiffness, damping;
      std::shared_ptr<const taut::ForceLaw> law;

      bool rigid() const { return std::isinf(stiffness); }
    };

    std::size_t size() const { return free.size(); }

    /// The free DoFs of a vector of the bodies, displacements counted from the undeformed ones.
    Vector displacement(const taut::StepView &view) const;
    Vector velocity(const taut::StepView &view) const { return gather(view.state.V); }

    /// Kinetic energy, and strain energy less the work of the constant loads; no links [J].
    double kinetic(const Vector &v) const;
    double potential(const Vector &u) const;

    /// Those of @p u that are lengths, or rotations of masses.
    Vector places(const Vector &u) const;

    dealii::FullMatrix<double> mass, damping, stiffness;
    Vector constant_load, cosine_load, sine_load, pulse_load;
    double frequency;
    Pulse pulse;
    std::vector<Row> rows; ///< the fixed ones; empty if a constraint moves
    bool has_moving = false;
    Vector start, start_velocity;

  private:
    struct Dof
    {
      std::size_t body;
      unsigned int index;
    };
    Vector gather(const taut::BodyVectors &values) const;
    Vector load(const taut::StepView &view, double t) const;
    void add_prescribed(const taut::StepView &view, double t, Vector &loads) const;
    void find_loads(const taut::StepView &view);
    void add_matrices(const taut::StepView &view);
    void add_rows(const taut::StepView &view);

    std::vector<Dof> free;
    std::vector<std::vector<int>> number; ///< of each DoF of a body among the free ones, or -1
    std::vector<char> is_place;
  };
} // namespace hunt

#endif
