// SPDX-License-Identifier: LGPL-2.1-or-later
#include "output/low_pass.h"

#include <algorithm>
#include <cmath>

namespace taut
{
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
} // namespace taut
