// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_total_displacement_h
#define taut_total_displacement_h

#include <taut/output/observer.h>

#include <vector>

namespace taut
{
  /// Sets @p U to the displacement of body k of this rank with that of the reference, as
  /// displacement() does. Use it in each step: U keeps its memory.
  inline void set_total_displacement(const StepView &step, const std::size_t k,
                                     std::vector<double> &U)
  {
    U = step.reference.displacement[k];
    for (std::size_t i = 0; i < U.size(); ++i)
      U[i] += step.state.U[k][i];
  }
} // namespace taut

#endif
