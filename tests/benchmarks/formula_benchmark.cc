// SPDX-License-Identifier: LGPL-2.1-or-later
// Formulas of parameter files: the time of one evaluation, beside that of sin alone.
#include "base/data_files.h"
#include <taut/scene/expression.h>

#include <benchmark/benchmark.h>

#include <cmath>
#include <filesystem>
#include <fstream>

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

  /// Of a table with so many rows that is read along its way, alone and inside of a formula.
  void evaluate_table(benchmark::State &state, const char *text)
  {
    const auto folder = std::filesystem::temp_directory_path();
    const int n = static_cast<int>(state.range(0));
    taut::set_data_folder(folder.string());
    {
      std::ofstream file(folder / "formula_benchmark.csv");
      file << "s,height\n";
      for (int i = 0; i < n; ++i)
        file << 101. * i / (n - 1) << ',' << i % 7 << '\n';
    }
    const Expression formula(text, "formula", Expression::Variables::position);
    double s = 0., sum = 0.;
    for (auto _ : state)
    {
      s = s > 100. ? 0. : s + .01;
      sum += formula(s, s);
    }
    benchmark::DoNotOptimize(sum);
    std::filesystem::remove(folder / "formula_benchmark.csv");
  }

  BENCHMARK_CAPTURE(evaluate_table, linear, "table(formula_benchmark.csv, height)")
      ->Arg(100)
      ->Arg(100000);
  BENCHMARK_CAPTURE(evaluate_table, cubic, "table(formula_benchmark.csv, height, cubic)")
      ->Arg(100)
      ->Arg(100000);
  BENCHMARK_CAPTURE(evaluate_table, inside, "0.001*table(formula_benchmark.csv, height)")
      ->Arg(100)
      ->Arg(100000);
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
