// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: the low-pass filter has the amplitude 1/(1 + (f/f_c)^6) of a third-order Butterworth
// filter run forwards and backwards, f_c = 20/(sqrt(2) - 1)^(1/6) Hz for -3 dB at 20 Hz, and no
// phase.
#include "scene_tests.h"

#include "output/signals.h"

#include <complex>

using namespace verification;

namespace
{

  /// Complex gain for a sine of frequency f [Hz], from whole periods in the middle of a record.
  std::complex<double> gain(const double f, const double step, const double frequency)
  {
    const int n = std::lround(8. / step), first = n / 4,
              count = std::lround(std::floor(2. * f) / f / step);
    std::vector<double> record(n);
    for (int i = 0; i < n; ++i)
      record[i] = std::sin(2. * pi * f * i * step);
    const std::vector<double> filtered = taut::low_pass(record, step, frequency);
    std::complex<double> in = 0., out = 0.;
    for (int i = first; i < first + count; ++i)
    {
      const std::complex<double> wave = std::exp(std::complex<double>(0., -2. * pi * f * i * step));
      in += record[i] * wave;
      out += filtered[i] * wave;
    }
    return out / in;
  }
} // namespace

TEST(LowPass, amplitude_is_that_of_two_third_order_butterworth_filters)
{
  const double cutoff = 20. / std::pow(std::sqrt(2.) - 1., 1. / 6.);
  for (const double f : {5., 20., 40.})
  {
    const std::complex<double> G = gain(f, 1e-4, 20.);
    const double exact = 1. / (1. + std::pow(f / cutoff, 6));
    figure("low-pass at 20 Hz, amplitude at " + std::to_string(int(f)) + " Hz, step 0.1 ms",
           std::abs(G));
    figure("low-pass at 20 Hz, exact amplitude at " + std::to_string(int(f)) + " Hz", exact);
    EXPECT_NEAR(std::abs(G), exact, 5e-4 * exact) << f;
    EXPECT_NEAR(std::arg(G), 0., 1e-6) << f;
  }
  EXPECT_NEAR(std::abs(gain(20., 1e-4, 20.)), std::sqrt(.5), 2e-5);
  EXPECT_NEAR(std::abs(gain(20., 1e-4, 20.)), std::pow(10., -3. / 20.), 1.5e-3)
      << "-3 dB is 0.7079, the half power that is meant 0.7071";
}

// At the sampling of a run (1 ms) the bilinear transform bends the frequency axis: tan(pi f step)
// over tan(pi f_c step).
TEST(LowPass, amplitude_at_a_step_of_1_ms)
{
  const double cutoff = 20. / std::pow(std::sqrt(2.) - 1., 1. / 6.), step = 1e-3;
  for (const double f : {5., 20., 40.})
  {
    const double warped = std::tan(pi * f * step) / std::tan(pi * cutoff * step),
                 exact = 1. / (1. + std::pow(warped, 6));
    const std::complex<double> G = gain(f, step, 20.);
    figure("low-pass at 20 Hz, amplitude at " + std::to_string(int(f)) + " Hz, step 1 ms",
           std::abs(G));
    EXPECT_NEAR(std::abs(G), exact, 1e-6) << f;
    EXPECT_NEAR(std::arg(G), 0., 1e-6) << f;
  }
}

TEST(LowPass, constants_and_ramps_pass_unchanged_and_a_pulse_stays_where_it_is)
{
  std::vector<double> ramp(2000), pulse(2001, 0.);
  for (int i = 0; i < 2000; ++i)
    ramp[i] = 3. + .01 * i;
  const std::vector<double> filtered = taut::low_pass(ramp, 1e-3, 20.);
  double error = 0.;
  for (int i = 0; i < 2000; ++i)
    raise(error, filtered[i] - ramp[i]);
  EXPECT_LT(figure("low-pass, largest change of a ramp from 3 to 23", error), 1e-3);

  pulse[1000] = 1.;
  const std::vector<double> answer = taut::low_pass(pulse, 1e-3, 20.);
  double sum = 0., asymmetry = 0.;
  for (int i = 0; i <= 2000; ++i)
  {
    sum += answer[i];
    raise(asymmetry, answer[i] - answer[2000 - i]);
  }
  EXPECT_NEAR(sum, 1., 1e-9);
  EXPECT_LT(asymmetry, 1e-15);
}
