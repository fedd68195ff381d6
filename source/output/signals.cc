// SPDX-License-Identifier: LGPL-2.1-or-later

#include "output/signals.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
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

  namespace
  {
    /// y_n = sum_k b_k x_{n-k} - sum_{k>0} a_k y_{n-k}, of second order, with x = x_0 before.
    struct Section
    {
      double b[3], a[3];

      void run(std::vector<double> &x) const
      {
        // Gain is one at frequency zero, so that a constant is its own response.
        double x1 = x[0], x2 = x[0], y1 = x[0], y2 = x[0];
        for (double &value : x)
        {
          const double x0 = value;
          value = b[0] * x0 + b[1] * x1 + b[2] * x2 - a[1] * y1 - a[2] * y2;
          x2 = x1;
          x1 = x0;
          y2 = y1;
          y1 = value;
        }
      }
    };
  } // namespace

  std::vector<double> low_pass(const std::vector<double> &record, const double step,
                               const double frequency)
  {
    if (record.size() < 2)
      return {record.begin(), record.end()};
    const double pi = std::acos(-1.);
    // Forwards and backwards: |H|^2 = 1 / (1 + (f/f_c)^6), -3 dB at f.
    const double cutoff = frequency / std::pow(std::sqrt(2.) - 1., 1. / 6.);
    const double w = std::tan(std::min(pi * cutoff * step, .499 * pi));

    // H(s) = 1 / (s + 1) * 1 / (s^2 + s + 1), s = (1 - z^-1) / (w (1 + z^-1))
    const double first = 1. / (1. + w), second = 1. / (1. + w + w * w);
    const Section one = {{w * first, w * first, 0.}, {1., (w - 1.) * first, 0.}};
    const Section two = {{w * w * second, 2. * w * w * second, w * w * second},
                         {1., 2. * (w * w - 1.) * second, (1. - w + w * w) * second}};

    const std::size_t n = record.size(),
                      pad = std::min<double>(n - 1, std::ceil(3. / (frequency * step)));
    std::vector<double> x;
    x.reserve(n + 2 * pad);
    for (std::size_t k = pad; k > 0; --k)
      x.push_back(2. * record[0] - record[k]);
    x.insert(x.end(), record.begin(), record.end());
    for (std::size_t k = 1; k <= pad; ++k)
      x.push_back(2. * record[n - 1] - record[n - 1 - k]);

    for (int direction = 0; direction < 2; ++direction)
    {
      one.run(x);
      two.run(x);
      std::reverse(x.begin(), x.end());
    }
    return {x.begin() + pad, x.begin() + pad + n};
  }

  void add_reversal(std::vector<double> &all, const double value)
  {
    const std::size_t n = all.size();
    if (n > 0 && value == all[n - 1])
      return;
    if (n > 1 && (value > all[n - 1]) == (all[n - 1] > all[n - 2]))
      all[n - 1] = value; // goes on in the same direction
    else
      all.push_back(value);
  }

  std::vector<double> reversals(const std::vector<double> &record)
  {
    std::vector<double> result;
    for (const double x : record)
      add_reversal(result, x);
    return result;
  }

  std::vector<LoadCycle> rainflow(const std::vector<double> &record)
  {
    std::vector<LoadCycle> cycles;
    const auto add = [&](const double from, const double to, const double count) {
      cycles.push_back({std::fabs(to - from), .5 * (from + to), count});
    };
    std::vector<double> open; // reversals whose cycles are not closed
    for (const double reversal : reversals(record))
    {
      open.push_back(reversal);
      while (open.size() >= 3)
      {
        const std::size_t n = open.size();
        const double before = open[n - 3], begin = open[n - 2], end = open[n - 1];
        if (std::fabs(end - begin) < std::fabs(begin - before))
          break;
        // With the first reversal in it, the earlier range is half a cycle.
        add(before, begin, n == 3 ? .5 : 1.);
        if (n == 3)
          open = {begin, end};
        else
          open.erase(open.end() - 3, open.end() - 1);
      }
    }
    for (std::size_t i = 1; i < open.size(); ++i)
      add(open[i - 1], open[i], .5);
    return cycles;
  }
} // namespace taut
