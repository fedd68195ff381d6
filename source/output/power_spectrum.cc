// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/output/power_spectrum.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numeric>

namespace taut
{
  namespace
  {
    using Values = std::vector<std::complex<double>>;

    const double pi = std::acos(-1.);

    /// Fourier transform of a power of two of values, by halves.
    Values transform(const Values &x)
    {
      const std::size_t n = x.size();
      if (n == 1)
        return x;
      Values even(n / 2), odd(n / 2), result(n);
      for (std::size_t i = 0; i < n / 2; ++i)
      {
        even[i] = x[2 * i];
        odd[i] = x[2 * i + 1];
      }
      even = transform(even);
      odd = transform(odd);
      for (std::size_t k = 0; k < n / 2; ++k)
      {
        const std::complex<double> turned = std::polar(1., -2. * pi * k / n) * odd[k];
        result[k] = even[k] + turned;
        result[k + n / 2] = even[k] - turned;
      }
      return result;
    }

    std::size_t length_of_segments(const std::size_t n)
    {
      constexpr std::size_t least_to_divide = 64;
      const std::size_t most = n < least_to_divide ? n : n / 2;
      std::size_t length = 1;
      while (2 * length <= most)
        length *= 2;
      return length;
    }
  } // namespace

  PowerSpectrum power_spectrum(const std::vector<double> &record, const double step)
  {
    PowerSpectrum result;
    if (record.size() < 4)
      return result;
    const std::size_t n = length_of_segments(record.size());
    const double mean = std::accumulate(record.begin(), record.end(), 0.) / record.size();
    std::vector<double> window(n), sum(n / 2 + 1, 0.);
    double square = 0.;
    for (std::size_t i = 0; i < n; ++i)
    {
      window[i] = .5 * (1. - std::cos(2. * pi * i / n));
      square += window[i] * window[i];
    }
    std::size_t n_segments = 0;
    for (std::size_t first = 0; first + n <= record.size(); first += n / 2, ++n_segments)
    {
      Values x(n);
      for (std::size_t i = 0; i < n; ++i)
        x[i] = window[i] * (record[first + i] - mean);
      x = transform(x);
      for (std::size_t k = 0; k <= n / 2; ++k)
        sum[k] += (k == 0 || k == n / 2 ? 1. : 2.) * std::norm(x[k]);
    }
    for (std::size_t k = 0; k <= n / 2; ++k)
    {
      result.frequency.push_back(k / (n * step));
      result.density.push_back(sum[k] * step / (square * n_segments));
    }
    return result;
  }
} // namespace taut
