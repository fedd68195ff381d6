// SPDX-License-Identifier: LGPL-2.1-or-later
// Formulas of parameter files: the time of one evaluation, beside that of sin alone.
#include <taut/scene/expression.h>

#include <benchmark/benchmark.h>

#include <cmath>

namespace
{
  using taut::Expression;

  /// Nanoseconds of one evaluation at a place and a time that change.
  void evaluate(benchmark::State &state, const char *text)
  {
    const Expression formula(text, "formula");
    double s = 0., sum = 0.;
    for (auto _ : state)
    {
      s = s > 100. ? 0. : s + .01;
      sum += formula(s, s);
    }
    benchmark::DoNotOptimize(sum);
  }

  /// The same of the function in C++.
  void sine(benchmark::State &state)
  {
    double s = 0., sum = 0.;
    for (auto _ : state)
    {
      s = s > 100. ? 0. : s + .01;
      sum += .001 * std::sin(2. * M_PI * s / 1.2);
    }
    benchmark::DoNotOptimize(sum);
  }

  BENCHMARK(sine);
  BENCHMARK_CAPTURE(evaluate, number, "120");
  BENCHMARK_CAPTURE(evaluate, sum_of_numbers, "120 + 22.2*9.81");
  BENCHMARK_CAPTURE(evaluate, sine, "0.001*sin(2*pi*s/1.2)");
  BENCHMARK_CAPTURE(evaluate, cubic, "5e4*s+1e8*s^3");
  BENCHMARK_CAPTURE(evaluate, window, "if(t < 1, 0, 100*sin(pi*(t-1))^2)");
  BENCHMARK_CAPTURE(evaluate, rough,
                    "if(s > 585, 0.0004*(s-585)^2, 0)+0.0004*sin(6.9813*s)+0.0003*sin(4.4880*s+1)"
                    "+0.0002*sin(11.424*s+2)");
} // namespace

BENCHMARK_MAIN();
