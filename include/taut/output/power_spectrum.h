// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_power_spectrum_h
#define taut_power_spectrum_h

#include <vector>

namespace taut
{
  /// One-sided power spectral density of a record. Its sum times the interval of the frequencies is
  /// the variance of the record.
  struct PowerSpectrum
  {
    std::vector<double> frequency; ///< [Hz]
    std::vector<double> density;   ///< [unit of the record squared / Hz]
  };

  /**
   * Welch's method: the mean over segments of the periodograms with a Hann window. Segments overlap
   * by half; their length is the largest power of two up to half of the record, or up to the
   * record if that is shorter than 64 values. The mean of the record is taken away before. @p step
   * is the uniform sampling interval [s]. Fewer than four values have no spectrum.
   */
  PowerSpectrum power_spectrum(const std::vector<double> &record, double step);
} // namespace taut

#endif
