// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_projection_compliance_h
#define taut_projection_compliance_h

#include <taut/interface/schur_complement.h>

#include <vector>

namespace taut
{
  /**
   * How elastic unilateral constraints take part in a projection of velocities: with a compliance
   * f_ii (S / (alpha F_ii))^2 on the diagonal of f = B^T M^-1 B, which fades from rigid to none
   * with the compliance S of the spring over the flexibility F_ii of the bodies in a step.
   * Conserving springs take no part. All functions but access are called by all ranks together.
   */
  class ProjectionCompliance
  {
  public:
    /// Kept by reference.
    explicit ProjectionCompliance(const Constraints &constraints);

    /// For steps whose forces count @p theta in their balance. @p S are the compliances of the
    /// springs in a step, @p F has them on its diagonal.
    void prepare(double theta, const std::vector<double> &S, ComplementarityOperator &F);

    /// Before a projection: springs that follow a law, and sliding constraints in their places.
    /// @p f, if it is set up, gets the compliances.
    void follow(const std::vector<double> &S, ComplementarityOperator &F, SchurComplement *f);

    /// Sets f up with the compliances.
    void setup(SchurComplement &f);

    /// f with the sliding constraints in their places.
    void update_moving(SchurComplement &f);

    /// False of a constraint that is too soft to take part, or conserving.
    bool takes_part(std::size_t i) const;

    /// The compliance of a constraint [1/kg, 1/(kg m^2)]; 0 of a rigid one.
    double operator[](const std::size_t i) const { return softening[i]; }

  private:
    void find_flexibilities(const std::vector<std::size_t> &rows, const std::vector<double> &S,
                            ComplementarityOperator &F);
    void find_mass_flexibilities(const std::vector<std::size_t> &rows, SchurComplement &f);
    void set_relative(const std::vector<double> &S);
    void set(SchurComplement &f);

    const Constraints &constraints;
    double theta = 1.;
    std::vector<std::size_t> elastic, moving_elastic; ///< unilateral constraints
    bool has_laws = false;
    std::vector<double> flexibility, of_mass; ///< F_ii and f_ii of the elastic constraints
    std::vector<double> relative;             ///< (S / (alpha F_ii))^2 of each constraint
    std::vector<double> softening;            ///< f_ii times that
  };
} // namespace taut

#endif
