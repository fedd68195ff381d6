// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_local_error_h
#define taut_local_error_h

#include "time/matrix_norms.h"
#include <taut/interface/connected_bodies.h>
#include <taut/time/state.h>
#include <taut/time/step_report.h>

#include <vector>

namespace taut
{
  /**
   * Largest local error of a step over the largest displacement so far. The third derivative comes
   * from the accelerations before and after the step: dU - step V0 - step^2 (A0/3 + A/6) (O. C.
   * Zienkiewicz, Y. M. Xie, Earthquake Engineering and Structural Dynamics 20 (1991)).
   *
   * Schemes with mean forces have mean accelerations and dU = step V0 + step^2 A/2. Their error is
   * step^3/12 of that derivative, step^2 (A - A0) / (6 (1 + last step / step)). Further changes dV
   * of velocities by impulses count as step dV. A body of elements, cut or not, has the root mean
   * square error by mass, sqrt(e . M e / m). Masses and rigid bodies have the largest error, for
   * displacements and slopes separately.
   */
  class LocalError
  {
  public:
    /// The arguments are kept by reference.
    LocalError(const Structure &structure, const Constraints &constraints,
               const Reference &reference);

    /// Local error of a step to @p state, after a step of @p step_before [s] with final
    /// accelerations
    /// @p old_A. Called by all ranks together.
    double measure(const State &state, const StepMethod &method, double step_before,
                   const BodyVectors &old_A);

    /// Largest displacements so far, which persist between steps [m, rad].
    ByKind largest_motions = {0., 0.};

  private:
    struct OfStep
    {
      const State &state;
      const StepMethod &method;
      double step_before;
      const BodyVectors &old_A;
    };
    void set_error(const OfStep &step, std::size_t k);
    ByKind largest_of(std::size_t k, std::vector<double> &x) const;
    double square(std::size_t k, const std::vector<double> &x);

    const Structure &structure;
    const Reference &reference;
    const ConnectedBodies wholes;      ///< groups of parts of one body
    std::vector<double> mass_of_whole; ///< mass of the elements of each group [kg]
    std::vector<double> motion, impulse, product;
  };
} // namespace taut

#endif
