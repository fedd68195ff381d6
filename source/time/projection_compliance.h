// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_projection_compliance_h
#define taut_projection_compliance_h

#include "interface/schur_complement.h"
#include "time/contact_resolution.h"
#include <taut/time/integrator.h>

#include <vector>

namespace taut
{
  /**
   * The compliance of elastic unilateral constraints in a velocity projection: f_ii (S / (alpha
   * F_ii))^2 on the diagonal of f = B^T M^-1 B. It fades the constraint out from rigid to absent as
   * the compliance S of the spring grows over the flexibility F_ii of the bodies in a step.
   * Conserving springs take no part. All functions but access are called by all ranks together.
   */
  class ProjectionCompliance
  {
  public:
    /// The argument is kept by reference.
    explicit ProjectionCompliance(const Constraints &constraints);

    /// For steps with these coefficients. @p S are the compliances of the springs in a step, which
    /// @p F has on its diagonal. @p is_linear: F is the same whenever these coefficients return.
    void prepare(const StepCoefficients &c, const std::vector<double> &S,
                 ComplementarityOperator &F, bool is_linear);

    /// Before a projection: updates springs with laws and sliding constraints, and the compliances
    /// in @p f if given.
    void follow(const std::vector<double> &S, ComplementarityOperator &F, SchurComplement *f);

    /// Sets f up with the compliances. With the masses of the call before, unless @p
    /// masses_changed, its fixed rows stay.
    void setup(SchurComplement &f, bool masses_changed);

    /// Updates f to the places of the sliding constraints.
    void update_moving(SchurComplement &f);

    /// False for a constraint that is conserving or too soft.
    bool takes_part(std::size_t i) const;

    /// Compliance of a constraint [1/kg, 1/(kg m^2)]; 0 for a rigid one.
    double operator[](const std::size_t i) const { return softening[i]; }

  private:
    void find_flexibilities(const std::vector<std::size_t> &rows, const std::vector<double> &S,
                            ComplementarityOperator &F);
    void find_mass_flexibilities(const std::vector<std::size_t> &rows, SchurComplement &f);
    void set_relative(const std::vector<double> &S);
    void set(SchurComplement &f);

    const Constraints &constraints;
    WholeBodies bodies;
    double theta = 1.; ///< weight of forces in the balance

    /// F_ii of constraints that do not slide, for coefficients of an earlier call.
    struct Known
    {
      StepCoefficients c;
      std::vector<double> flexibility;
    };
    std::vector<Known> known;
    std::vector<std::size_t> elastic, moving_elastic; ///< unilateral constraints
    std::vector<std::size_t> softened;                ///< in setup()
    bool has_laws = false;
    std::vector<double> flexibility, of_mass; ///< F_ii and f_ii of elastic constraints
    std::vector<double> relative;             ///< (S / (alpha F_ii))^2 of each constraint
    std::vector<double> softening;            ///< f_ii times relative
  };
} // namespace taut

#endif
