// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_low_pass_h
#define taut_low_pass_h

#include <vector>

namespace taut
{
  /**
   * A third-order Butterworth low-pass filter run forwards and backwards: no phase shift, amplitude
   * 1 / (1 + (f/f_c)^6), and f_c such that @p frequency [Hz] is damped by 3 dB in total (bilinear
   * transform, prewarped at f_c). Point reflection extends the record at both ends, so that a
   * constant or a ramp passes unchanged. @p step is the uniform sampling interval [s]; the
   * frequency must be below half the sampling rate.
   */
  std::vector<double> low_pass(const std::vector<double> &record, double step, double frequency);
} // namespace taut

#endif
