// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_complementarity_reference_h
#define taut_complementarity_reference_h

#include "common.h"
#include "complementarity/problem.h"

/// G row by row from its entries, row-major, zeros left out.
inline std::vector<taut::LinearForm> mode_equations(std::size_t n_rows,
                                                    const std::vector<double> &entries)
{
  std::vector<taut::LinearForm> result(entries.size() / n_rows);
  for (std::size_t e = 0; e < entries.size(); ++e)
    if (entries[e] != 0.)
      result[e / n_rows].add(e % n_rows, entries[e]);
  return result;
}

/// Lemke's method with lexicographic pivots, in long double and scaled to a unit diagonal.
namespace reference
{
  using Real = long double;
  using Vector = std::vector<Real>;

  /// y = T x + q, where rows and columns can change sides.
  struct Tableau
  {
    std::size_t n;
    Vector T, q;

    Real &at(std::size_t i, std::size_t j) { return T[i * n + j]; }

    /// Principal pivot: y_k and x_k change sides.
    void pivot(std::size_t k)
    {
      const Real p = at(k, k);
      for (std::size_t j = 0; j < n; ++j)
        if (j != k)
          at(k, j) /= -p;
      q[k] /= -p;
      for (std::size_t i = 0; i < n; ++i)
        if (i != k)
        {
          const Real f = at(i, k);
          for (std::size_t j = 0; j < n; ++j)
            if (j != k)
              at(i, j) += f * at(k, j);
          q[i] += f * q[k];
          at(i, k) = f / p;
        }
      at(k, k) = 1 / p;
    }
  };

  struct Solution
  {
    Vector N, D;
    bool found = false;
  };

  /// Lemke's method for w = M z + q, w, z >= 0, w^T z = 0 with positive semidefinite M. Columns of
  /// the table: w, z, the artificial variable, q. Gives the z_i that are basic, or false on a ray.
  inline bool lemke(const Vector &M, const Vector &q, std::size_t m, std::vector<char> &basic_z)
  {
    const std::size_t width = 2 * m + 2;
    std::vector<Vector> table(m, Vector(width, 0));
    std::vector<std::size_t> basis(m);
    for (std::size_t i = 0; i < m; ++i)
    {
      table[i][i] = 1;
      for (std::size_t j = 0; j < m; ++j)
        table[i][m + j] = -M[i * m + j];
      table[i][2 * m] = -1;
      table[i][2 * m + 1] = q[i];
      basis[i] = i;
    }
    const auto pivot = [&](std::size_t row, std::size_t column)
    {
      const Real p = table[row][column];
      for (Real &entry : table[row])
        entry /= p;
      for (std::size_t i = 0; i < m; ++i)
        if (i != row && table[i][column] != 0)
        {
          const Real f = table[i][column];
          for (std::size_t j = 0; j < width; ++j)
            table[i][j] -= f * table[row][j];
        }
      basis[row] = column;
    };
    // Row a before row b in the lexicographic order of (q, w columns) / entry.
    const auto is_before = [&](std::size_t a, std::size_t b, Real f_a, Real f_b)
    {
      const auto less = [&](std::size_t j) { return table[a][j] / f_a - table[b][j] / f_b; };
      if (std::abs(less(2 * m + 1)) > 1e-15L)
        return less(2 * m + 1) < 0;
      for (std::size_t j = 0; j < m; ++j)
        if (std::abs(less(j)) > 1e-15L)
          return less(j) < 0;
      return a < b;
    };
    basic_z.assign(m, 0);
    if (std::all_of(q.begin(), q.end(), [](Real value) { return value >= -1e-12L; }))
      return true;
    std::size_t row = 0;
    for (std::size_t i = 1; i < m; ++i)
      if (is_before(i, row, 1, 1))
        row = i;
    std::size_t leaving = basis[row];
    pivot(row, 2 * m);
    for (std::size_t step = 0; step < 50 * m + 100; ++step)
    {
      const std::size_t entering = leaving < m ? leaving + m : leaving - m;
      row = m;
      for (std::size_t i = 0; i < m; ++i)
        if (table[i][entering] > 1e-13L)
          if (row == m || is_before(i, row, table[i][entering], table[row][entering]))
            row = i;
      if (row == m)
        return false;
      for (std::size_t i = 0; i < m; ++i) // the artificial variable wins ties
        if (basis[i] == 2 * m && table[i][entering] > 1e-13L &&
            table[i][2 * m + 1] / table[i][entering] <=
                table[row][2 * m + 1] / table[row][entering] + 1e-15L)
          row = i;
      leaving = basis[row];
      pivot(row, entering);
      if (leaving == 2 * m)
      {
        for (const std::size_t variable : basis)
          if (variable >= m && variable < 2 * m)
            basic_z[variable - m] = 1;
        return true;
      }
    }
    return false;
  }

  /// Pivots on rows, largest first, as long as they are independent; returns those that are.
  /// @p smallest becomes the least of the pivots if it is larger.
  inline std::vector<std::size_t> pivot_all(Tableau &tableau, std::vector<std::size_t> rows,
                                            Real *smallest = nullptr)
  {
    std::vector<std::size_t> done;
    while (!rows.empty())
    {
      const auto largest = std::max_element(rows.begin(), rows.end(),
                                            [&](std::size_t a, std::size_t b)
                                            { return tableau.at(a, a) < tableau.at(b, b); });
      if (tableau.at(*largest, *largest) < 1e-14L)
        break;
      if (smallest)
        *smallest = std::min(*smallest, tableau.at(*largest, *largest));
      tableau.pivot(*largest);
      done.push_back(*largest);
      rows.erase(largest);
    }
    return done;
  }

  /// F in units of the root of its diagonal, @p scale, or of 1 where that is 0. Without load.
  inline Tableau scaled(const std::vector<double> &F, std::size_t n, Vector &scale)
  {
    Tableau result{n, Vector(n * n), Vector(n, 0)};
    scale.assign(n, 1);
    for (std::size_t i = 0; i < n; ++i)
      if (F[i * n + i] > 0)
        scale[i] = std::sqrt(Real(F[i * n + i]));
    for (std::size_t e = 0; e < n * n; ++e)
      result.T[e] = F[e] / (scale[e / n] * scale[e % n]);
    return result;
  }

  /// Solves a problem without null space; F is n x n.
  inline Solution solve(const taut::MixedComplementarityProblem &problem,
                        const std::vector<double> &F)
  {
    const std::size_t n = problem.size();
    Vector scale;
    Tableau final = scaled(F, n, scale);
    std::vector<std::size_t> bilateral, unilateral;
    for (std::size_t i = 0; i < n; ++i)
    {
      final.q[i] = problem.free_gap[i] / scale[i];
      if (F[i * n + i] > 0)
        (problem.cones[i].may_open() ? unilateral : bilateral).push_back(i);
    }
    Tableau reduced = final;
    std::vector<std::size_t> closed = pivot_all(reduced, bilateral);

    Solution solution;
    const std::size_t m = unilateral.size();
    Vector M(m * m), q(m);
    for (std::size_t i = 0; i < m; ++i)
    {
      q[i] = reduced.q[unilateral[i]];
      for (std::size_t j = 0; j < m; ++j)
        M[i * m + j] = reduced.at(unilateral[i], unilateral[j]);
    }
    std::vector<char> basic;
    solution.found = lemke(M, q, m, basic);
    for (std::size_t i = 0; i < m; ++i)
      if (basic[i])
        closed.push_back(unilateral[i]);
    solution.N.assign(n, 0);
    for (const std::size_t i : pivot_all(final, closed))
      solution.N[i] = final.q[i] / scale[i];
    solution.D.assign(problem.free_gap.begin(), problem.free_gap.end());
    for (std::size_t e = 0; e < n * n; ++e)
      solution.D[e / n] += F[e] * solution.N[e % n];
    return solution;
  }

  /// Smallest pivot of F on the given rows, with a unit diagonal: how unique their multipliers are.
  inline Real smallest_pivot(const std::vector<double> &F, std::size_t n,
                             const std::vector<std::size_t> &rows)
  {
    Vector scale;
    Tableau tableau = scaled(F, n, scale);
    Real smallest = 1;
    return pivot_all(tableau, rows, &smallest).size() == rows.size() ? smallest : 0;
  }
} // namespace reference

#endif
