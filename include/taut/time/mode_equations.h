// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_mode_equations_h
#define taut_mode_equations_h

#include <taut/complementarity/problem.h>
#include <taut/interface/constraints.h>

#include <vector>

namespace taut
{
  /// Of each body of this rank the motions whose amplitudes are unknowns.
  using ModeVectors = std::vector<const std::vector<std::vector<double>> *>;

  /**
   * G_ki = R_k . B_i and e_k = R_k . P of the rigid body modes R of all bodies, rank after rank.
   * Returns the number of the first one of this rank. Called by all ranks together.
   */
  std::size_t set_mode_equations(const ModeVectors &vectors, const Communicator &processes,
                                 const Constraints &constraints, const BodyVectors &P,
                                 MixedComplementarityProblem &problem);
} // namespace taut

#endif
