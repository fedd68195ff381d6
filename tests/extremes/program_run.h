// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_extremes_program_run_h
#define taut_extremes_program_run_h

#include "observation.h"

namespace extremes
{
  /**
   * Runs a case through the whole program, from parameters to certificates. A UserError is an
   * answer's error; anything else that is thrown is a failure of the test.
   */
  Answer program_answer(const Case &c);
} // namespace extremes

#endif
