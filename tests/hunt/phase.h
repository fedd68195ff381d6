// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_hunt_phase_h
#define taut_hunt_phase_h

#include "linear_model.h"

namespace hunt
{
  /// The spring of a constraint in straight pieces: from u[j] on, the force is f[j] + k[j] (d -
  /// u[j]) at the compression d. A linear one has a single piece.
  struct Pieces
  {
    Vector u, f, k;
  };

  /// Pieces of a law up to @p reach [m], with an error far below the bounds of the hunt.
  Pieces pieces_of(const taut::ForceLaw &law, double reach);

  /// Of each constraint: 0 open, otherwise 1 + its piece; a rigid one that is closed is 1.
  using Modes = std::vector<int>;

  /// What does not change in a motion: DoFs with and without mass, and the former in coordinates q
  /// in which their mass matrix is the identity, u = T q.
  struct ModelParts
  {
    ModelParts(const LinearModel &model, double reach);

    std::size_t n_q() const { return with_mass.size(); }
    std::size_t n_state() const { return 2 * n_q() + model.rows.size() + 5; }
    std::size_t one() const { return n_state() - 3; }
    std::size_t pulse() const { return n_state() - 5; }

    const LinearModel &model;
    std::vector<std::size_t> with_mass, without_mass;
    dealii::FullMatrix<double> T;   ///< of the DoFs with mass
    dealii::FullMatrix<double> B;   ///< terms of the rows in q, one column a row
    std::vector<char> acts_on_mass; ///< of the rows
    std::vector<Pieces> springs;    ///< of the rows that are not rigid
  };

  /// The motion while no constraint changes its mode: z' = A z for the state
  ///
  ///     z = q, q', impulses of the rows, p(t), p'(t), 1, cos(w t), sin(w t).
  ///
  /// DoFs without mass are in equilibrium and follow from it.
  class Phase
  {
  public:
    Phase(const ModelParts &parts, const Modes &modes);

    /// z after a time [s] that is at most step(), times a number near one.
    Vector propagate(const Vector &z, double time);

    /// Within which a sum of a dozen powers of A is its exponential [s].
    double step() const { return longest; }

    /// Linear forms of z: gap of a row, its rate, its force, all displacements.
    Vector gap(std::size_t row) const;
    Vector rate(std::size_t row) const;
    const Vector &force(std::size_t row) const { return forces[row]; }
    Vector displacement(const Vector &z) const;

    /// Acceleration q'' as a form of z, one row a DoF.
    const std::vector<Vector> &acceleration() const { return inertia; }

  private:
    void add_closed_springs(const Modes &modes, dealii::FullMatrix<double> &K,
                            Vector &constant) const;
    void find_displacements(const Modes &modes);
    void find_forces(const Modes &modes);
    void hold_rigid(const Modes &modes);
    void assemble();
    Vector series(const Vector &z, double time) const;
    void make_exponential(double time);

    const ModelParts &parts;
    std::vector<Vector> u;       ///< of each DoF
    std::vector<Vector> forces;  ///< of each row
    std::vector<Vector> inertia; ///< q''
    Vector A;                    ///< row by row
    double longest = 0.;

    double exponential_time = -1., last_time = -1.;
    unsigned int n_repeated = 0;
    Vector exponential; ///< row by row
  };
} // namespace hunt

#endif
