// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_kernel_rows_h
#define taut_kernel_rows_h

#include <taut/complementarity/problem.h>
#include <taut/interface/contact_rows.h>

#include <vector>

namespace taut
{
  /// Of each body of this rank the motions whose amplitudes are unknowns.
  using KernelVectors = std::vector<const std::vector<std::vector<double>> *>;

  /**
   * G_ki = R_k . B_i and e_k = R_k . P of the free motions R of all bodies, rank after rank.
   * Returns the number of the first one of this rank. Called by all ranks together.
   */
  std::size_t set_kernel_rows(const KernelVectors &vectors, const Communicator &processes,
                              const ContactRows &rows, const BlockVector &P,
                              MixedComplementarityProblem &problem);
} // namespace taut

#endif
