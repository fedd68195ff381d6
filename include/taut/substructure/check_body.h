// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_check_body_h
#define taut_check_body_h

#include <taut/substructure/substructure.h>

#include <string>
#include <vector>

namespace taut
{
  /**
   * Call it in the tests of a body of your own. It compares the functions of the body with
   * differences, about the displacement @p U from the undeformed body, one entry a DoF [m, rad].
   * Each discrepancy is a line with the functions, the DoF and both values; a body without lines is
   * consistent at U.
   *
   * - internal_force() with the change of strain_energy(),
   * - tangent() at rest, and its part with the rate at a velocity of up to @p length a second, with
   *   the change of internal_force(),
   * - mean_internal_force() times U1 - U with the change of strain_energy() from U to U1,
   * - mean_internal_force() from U to U with internal_force(),
   * - mean_tangent() from U to U with twice the change of mean_internal_force(),
   * - the vectors of null_space() with the stiffness, if the body is linear.
   *
   * @p length is a displacement over which the body is far from linear, such as its smallest size
   * [m, rad]. Differences are taken over small parts of it. A discrepancy is a difference of more
   * than a millionth of the largest number, beyond rounding and the error of the differences. The
   * energy of a ConstrainedBody is not compared: its forces do no work only on motions that its
   * conditions allow. The cost is some forces and energies for each DoF. Throws UserError if U or a
   * result has a wrong size.
   */
  std::vector<std::string> check_body(const Substructure &body, const std::vector<double> &U,
                                      double length = 1.);
} // namespace taut

#endif
