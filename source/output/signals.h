// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_signals_h
#define taut_signals_h

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

  /**
   * A third-order Butterworth low-pass filter run forwards and backwards: no phase shift, amplitude
   * 1 / (1 + (f/f_c)^6), and f_c such that @p frequency [Hz] is damped by 3 dB in total (bilinear
   * transform, prewarped at f_c). Point reflection extends the record at both ends, so that a
   * constant or a ramp passes unchanged. @p step is the uniform sampling interval [s]; the
   * frequency must be below half the sampling rate.
   */
  std::vector<double> low_pass(const std::vector<double> &record, double step, double frequency);

  /// Cycles of one range between reversals of a record.
  struct LoadCycle
  {
    double range; ///< largest minus smallest value, in the unit of the record
    double mean;
    double count; ///< 1, or 1/2 for one of the reversals that are left over
  };

  /// Adds a value of a record to its reversals so far.
  void add_reversal(std::vector<double> &reversals, double value);

  /// The reversals of a record: its first and last value, and the extremes in between.
  std::vector<double> reversals(const std::vector<double> &record);

  /// Cycles of a record by rainflow counting, as in ASTM E1049, in the order in which they close.
  std::vector<LoadCycle> rainflow(const std::vector<double> &record);
} // namespace taut

#endif
