// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_check_body_h
#define taut_check_body_h

#include <taut/substructure/substructure.h>

#include <string>
#include <vector>

namespace taut
{
  /**
   * For authors of bodies: compares what a body says of itself with differences, about the
   * displacement @p U from the undeformed body, one entry a DoF [m, rad]. Each discrepancy is a
   * line with the functions, the DoF and both values; none: the body is consistent there.
   *
   * - internal_force() with the change of strain_energy(),
   * - tangent() with the change of internal_force(), at a rate of 1/s,
   * - mean_internal_force() times U1 - U with the change of strain_energy() from U to U1,
   * - mean_internal_force() from U to U with internal_force(),
   * - mean_tangent() from U to U with twice the change of mean_internal_force(),
   * - the vectors of null_space() with the stiffness, of a linear body.
   *
   * @p length is a displacement over which the body is far from linear, as its smallest size [m,
   * rad]: differences are taken over small parts of it. Numbers that differ by a millionth of the
   * largest, and not by rounding or by what the differences neglect, are a discrepancy. Of a
   * ConstrainedBody, whose forces do no work on motions that its conditions allow only, the energy
   * is not compared. The cost is some forces and energies for each DoF. Throws UserError if U or a
   * result has a wrong size.
   */
  std::vector<std::string> check_body(const Substructure &body, const std::vector<double> &U,
                                      double length = 1.);
} // namespace taut

#endif
