// SPDX-License-Identifier: LGPL-2.1-or-later
#include "output/power_spectrum.h"

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

    /// Fourier transform of n values, a power of two, that are @p stride apart, by halves. @p roots
    /// has exp(-2 pi i k / (n stride)).
    Values transform(const std::complex<double> *x, const std::size_t n, const std::size_t stride,
                     const Values &roots)
    {
      if (n == 1)
        return {*x};
      const Values even = transform(x, n / 2, 2 * stride, roots),
                   odd = transform(x + stride, n / 2, 2 * stride, roots);
      Values result(n);
      for (std::size_t k = 0; k < n / 2; ++k)
      {
        const std::complex<double> turned = roots[k * stride] * odd[k];
        result[k] = even[k] + turned;
        result[k + n / 2] = even[k] - turned;
      }
      return result;
    }
  } // namespace

  double PowerSpectrum::deviation(const double from, const double to) const
  {
    double variance = 0.;
    for (std::size_t k = 0; k < density.size(); ++k)
    {
      const double half = .5 * frequency[1], begin = std::max(frequency[k] - half, 0.),
                   end = std::min(frequency[k] + half, frequency.back()),
                   inside = std::min(end, to) - std::max(begin, from);
      variance += std::max(inside, 0.) / (end - begin) * density[k] * frequency[1];
    }
    return std::sqrt(variance);
  }

  PowerSpectrum power_spectrum(const std::vector<double> &record, const double step)
  {
    PowerSpectrum result;
    if (record.size() < 4)
      return result;
    std::size_t n = 4;
    while (2 * n <= record.size())
      n *= 2;
    const std::size_t rest = record.size() - n, last = (2 * rest + n - 1) / n;
    const double mean = std::accumulate(record.begin(), record.end(), 0.) / record.size();
    Values roots(n), x(n);
    for (std::size_t i = 0; i < n; ++i)
      roots[i] = std::polar(1., -2. * pi * i / n);
    std::vector<double> sum(n / 2 + 1, 0.);
    for (std::size_t segment = 0; segment <= last; ++segment)
    {
      const std::size_t first = rest * segment / std::max<std::size_t>(1, last);
      for (std::size_t i = 0; i < n; ++i)
        x[i] = .5 * (1. - roots[i].real()) * (record[first + i] - mean);
      const Values transformed = transform(x.data(), n, 1, roots);
      for (std::size_t k = 0; k <= n / 2; ++k)
        sum[k] += (k == 0 || k == n / 2 ? 1. : 2.) * std::norm(transformed[k]);
    }
    double variance = 0.;
    for (const double value : record)
      variance += (value - mean) * (value - mean) / record.size();
    const double interval = 1. / (n * step),
                 total = std::accumulate(sum.begin(), sum.end(), 0.) * interval;
    for (std::size_t k = 0; k <= n / 2; ++k)
    {
      result.frequency.push_back(k * interval);
      result.density.push_back(total > 0. ? sum[k] * variance / total : 0.);
    }
    return result;
  }
} // namespace taut
