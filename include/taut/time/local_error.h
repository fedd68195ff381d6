// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_local_error_h
#define taut_local_error_h

#include <taut/interface/connected_bodies.h>
#include <taut/time/integrator.h>
#include <taut/time/matrix_norms.h>
#include <taut/time/state.h>

#include <vector>

namespace taut
{
  /**
   * Largest local error of a step over the largest displacement so far, from the third derivative
   * that the accelerations before and after show: dU - step V0 - step^2 (A0/3 + A/6)
   * (O. C. Zienkiewicz, Y. M. Xie, Earthquake Engineering and Structural Dynamics 20 (1991)).
   *
   * The accelerations of schemes with mean forces are means, and dU = step V0 + step^2 A/2: its
   * error is step^3/12 of that derivative, step^2 (A - A0) / (6 (1 + last step / step)). What
   * impulses change of the velocities besides, dV, counts as step dV. Of a body of elements the
   * error is the root of its mean square by mass, sqrt(e . M e / m), whether it is cut in parts or
   * not. Of masses and rigid bodies the largest counts, displacements and slopes each for
   * themselves.
   */
  class LocalError
  {
  public:
    /// The arguments are kept by reference.
    LocalError(const Structure &structure, const Constraints &constraints,
               const Reference &reference);

    /// Of the step with coefficients @p c that ended with @p state, after one of length
    /// @p step_before [s] that ended with accelerations @p old_A. Called by all ranks together.
    double measure(const State &state, const StepCoefficients &c, double step_before,
                   const BodyVectors &old_A);

    /// Largest displacements so far: what is kept from step to step [m, rad].
    PerKind largest_motions = {0., 0.};

  private:
    struct OfStep
    {
      const State &state;
      const StepCoefficients &c;
      double step_before;
      const BodyVectors &old_A;
    };
    void set_error(const OfStep &step, std::size_t k);
    PerKind largest_of(std::size_t k, std::vector<double> &x) const;
    double square(std::size_t k, const std::vector<double> &x);

    const Structure &structure;
    const Reference &reference;
    const ConnectedBodies wholes;      ///< what cuts have parted
    std::vector<double> mass_of_whole; ///< of the elements of each of them [kg]
    std::vector<double> motion, impulse, product;
  };
} // namespace taut

#endif
