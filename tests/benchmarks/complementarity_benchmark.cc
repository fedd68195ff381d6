// SPDX-License-Identifier: LGPL-2.1-or-later
// The contact problem of one step of a catenary line: 90 droppers and joints whose rows of F stay,
// and one moving contact, ordered last, whose row is new in each step. Starts from the set of the
// step before.
#include "complementarity/solver.h"

#include <benchmark/benchmark.h>

#include <cmath>

namespace
{
  using namespace taut;

  constexpr std::size_t n = 91;

  /// exp(-|distance| / decay) at unit spacing, cut off at 1e-12: how compliance decays along a wire
  /// within a step.
  double compliance(double distance, double decay)
  {
    const double value = std::exp(-std::abs(distance) / decay);
    return value > 1e-12 ? value : 0.;
  }

  void move_contact(DenseOperator &F, double place, double decay)
  {
    for (std::size_t i = 0; i + 1 < n; ++i)
      F.set(n - 1, i, .5 * compliance(i - place, decay));
  }

  /// Microseconds of 'move the contact, then solve'; the argument is ten times the decay length in
  /// rows.
  void warm_step(benchmark::State &state)
  {
    const double decay = state.range(0) / 10.;
    DenseOperator F(n);
    MixedComplementarityProblem problem;
    for (std::size_t i = 0; i < n; ++i)
    {
      for (std::size_t j = 0; j < i; ++j)
        F.set(i, j, compliance(double(i) - double(j), decay));
      F.set(i, i, 1.1);
      problem.cones.push_back(taut::Cone::unilateral_if(1));
      problem.free_gap.push_back(std::sin(.4 * i) - .9);
    }
    ComplementaritySolver solver;
    double place = 20.;
    unsigned int n_iterations = 0;
    for (auto _ : state)
    {
      place = place > 60. ? 20. : place + .01;
      move_contact(F, place, decay);
      n_iterations += solver.solve(problem, F).iterations;
    }
    state.counters["iterations"] =
        benchmark::Counter(n_iterations, benchmark::Counter::kAvgIterations);
  }
  BENCHMARK(warm_step)->Arg(3)->Arg(20)->Arg(1000)->Unit(benchmark::kMicrosecond);

  /// The same motion without solving.
  void move_only(benchmark::State &state)
  {
    const double decay = state.range(0) / 10.;
    DenseOperator F(n);
    double place = 20.;
    for (auto _ : state)
    {
      place = place > 60. ? 20. : place + .01;
      move_contact(F, place, decay);
      benchmark::DoNotOptimize(F(n - 1, 40));
    }
  }
  BENCHMARK(move_only)->Arg(3)->Arg(20)->Arg(1000)->Unit(benchmark::kMicrosecond);
} // namespace

BENCHMARK_MAIN();
