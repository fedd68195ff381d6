// SPDX-License-Identifier: LGPL-2.1-or-later
#include "complementarity/semismooth_newton.h"

#include <algorithm>

namespace taut
{
  namespace
  {
    /// The sum of a number of each rank, modulo 2^64: sums of doubles are exact for pieces of 16
    /// bits.
    std::uint64_t sum_of_ranks(const SharedRows &rows, const std::uint64_t value)
    {
      constexpr unsigned int n_bits = 16;
      std::vector<double> pieces;
      for (unsigned int shift = 0; shift < 64; shift += n_bits)
        pieces.push_back(static_cast<double>((value >> shift) & 0xffffu));
      rows.sum(pieces);
      std::uint64_t result = 0;
      for (std::size_t p = 0; p < pieces.size(); ++p)
        result += static_cast<std::uint64_t>(pieces[p]) << (n_bits * p);
      return result;
    }

    /// A 64-bit hash of an active set: the sum of a well-mixed number (splitmix64) for each row.
    std::uint64_t hash(const std::vector<std::size_t> &set, const SharedRows *const rows)
    {
      std::uint64_t sum = 0;
      for (const std::size_t row : set)
      {
        if (rows && !rows->is_own(row))
          continue;
        std::uint64_t z = ((rows ? rows->number(row) : row) + 1) * 0x9e3779b97f4a7c15u;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        sum += z ^ (z >> 31);
      }
      return 1 + (rows ? sum_of_ranks(*rows, sum) : sum);
    }
  } // namespace

  SemismoothNewton::Outcome SemismoothNewton::solve(const MixedComplementarityProblem &problem,
                                                    ComplementarityOperator &matrix,
                                                    MixedComplementaritySolution &solution)
  {
    solution.closed.resize(problem.size());
    const bool is_inexact = matrix.is_iterative() && !stayed;
    double tolerance = is_inexact ? options.inexact_tolerance : options.linear_tolerance;
    bool is_settled = false;
    // What came back of sets that were solved roughly is no cycle.
    const auto solve_exactly = [&]
    {
      tolerance = options.linear_tolerance;
      history.fill(0);
      history[iterations % history.size()] = current;
    };
    for (iterations = 0; iterations < options.max_iterations;)
    {
      if (!is_settled)
      {
        ++iterations;
        collect_set(problem, matrix, solution);
        if (options.detect_cycles && comes_back(problem.shared))
        {
          if (tolerance <= options.linear_tolerance)
            return Outcome::cycle;
          solve_exactly();
        }
      }

      const auto outcome = system.solve(problem, matrix, set, tolerance, solution, terms);
      if (outcome == ActiveSetSystem::Outcome::inadmissible)
        return Outcome::unsettled;
      multiplier_weights(problem, matrix, solution.multiplier, terms, weights);
      is_settled = !problem.any(flip_rows(
          problem, tolerance > options.linear_tolerance ? tolerance : options.dead_band, solution));
      stayed = is_settled && iterations == 1;
      if (!is_settled)
        continue;
      if (tolerance > options.linear_tolerance)
      {
        solve_exactly();
        continue;
      }

      taut::residual(problem, solution, terms, weights, final_residual);
      return outcome == ActiveSetSystem::Outcome::solved ? Outcome::solved : Outcome::unsettled;
    }
    return Outcome::max_iterations;
  }

  void SemismoothNewton::collect_set(const MixedComplementarityProblem &problem,
                                     const ComplementarityOperator &matrix,
                                     MixedComplementaritySolution &solution)
  {
    set.clear();
    const std::vector<char> in_null_space = problem.rows_in_null_space();
    for (std::size_t i = 0; i < problem.size(); ++i)
    {
      const bool inert = matrix.diagonal(i) == 0. && (in_null_space.empty() || !in_null_space[i]);
      solution.closed[i] =
          !inert && (problem.cones[i].may_open() ? solution.closed[i] : problem.cones[i].is_free());
      if (solution.closed[i])
        set.push_back(i);
    }
  }

  bool SemismoothNewton::flip_rows(const MixedComplementarityProblem &problem,
                                   const double dead_band,
                                   MixedComplementaritySolution &solution) const
  {
    bool flipped = false;
    for (std::size_t i = 0; i < problem.size(); ++i)
    {
      if (!problem.cones[i].may_open() || weights[i] == 0.)
        continue;
      const double band = dead_band * terms[i];
      const bool flips = solution.closed[i] ? weights[i] * solution.multiplier[i] < -band
                                            : solution.gap[i] < -band;
      if (flips)
        solution.closed[i] = !solution.closed[i];
      flipped |= flips;
    }
    return flipped;
  }

  bool SemismoothNewton::comes_back(const SharedRows *const rows)
  {
    current = hash(set, rows);
    if (iterations == 1)
      history.fill(0);
    const bool known = std::find(history.begin(), history.end(), current) != history.end();
    history[iterations % history.size()] = current;
    return known;
  }
} // namespace taut
