// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_extremes_extended_projection_h
#define taut_extremes_extended_projection_h

#include "extended_model.h"

namespace extremes
{
  /// A contact that had an impulse p in the first part of a step.
  struct ProjectedContact
  {
    Vector form;         ///< B, of all DoFs
    Number rate = 0;     ///< D' with the velocities of the first part
    Number impulse = 0;  ///< p, and P afterwards
    Number softness = 0; ///< the square of S over part of the flexibility of the bodies in a step
  };

  /// Conditions on velocities after those on gaps: of contacts with impulses p in the first part,
  ///
  ///     V = V* + M^-1 B (P - p),    0 <= P _|_ D' + f_ii softness (P - p) >= 0,    f = B^T M^-1 B.
  ///
  /// DoFs that are held or have no mass keep their velocities.
  class ExtendedProjection
  {
  public:
    ExtendedProjection(const ExtendedModel &model, const Matrix &M, bool as_double);

    /// Throws std::logic_error if the mass matrix is singular.
    void project(std::vector<ProjectedContact> &contacts, Vector &V) const;

  private:
    bool as_double;
    std::vector<std::size_t> dofs;
    Cholesky factor_of_M;
    bool is_definite;
  };
} // namespace extremes

#endif
