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
    std::vector<double> frequency; ///< multiples of one interval, from 0 on [Hz]
    std::vector<double> density;   ///< [unit of the record squared / Hz]

    /// Standard deviation of the record between two frequencies [unit of the record]. Each value is
    /// the density of the frequencies that are nearest to its own, so that the squares of adjacent
    /// bands add up.
    double deviation(double from, double to) const;
  };

  /**
   * Welch's method: the mean over segments of the periodograms with a Hann window, scaled to the
   * variance of the record. The length of the segments is the largest power of two up to that of
   * the record. There are as few of them as overlap by half or more, from the first value to the
   * last. The mean of the record is taken away before. @p step is the uniform sampling interval
   * [s]. Fewer than four values have no spectrum.
   */
  PowerSpectrum power_spectrum(const std::vector<double> &record, double step);
} // namespace taut

#endif
