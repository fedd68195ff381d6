// SPDX-License-Identifier: LGPL-2.1-or-later
#include "extended_laws.h"

#include "extended_complementarity.h"

namespace extremes
{
  namespace
  {
    /// Of the terms of a gap, what a law may lack; and of its stiffness, its least slope.
    const Number converged("1e-50"), least_slope("1e-60");
    constexpr unsigned int most_iterations = 2000, n_bisections = 60;

    using Laws = std::vector<std::optional<ConservingLaw>>;

    /// Multipliers, and the gaps F N + d.
    struct Point
    {
      Vector N, D;
    };

    /// Derivative of the energy at the part s of the way.
    Number slope_of_energy(const Laws &laws, const Point &from, const Point &to, const Number &s)
    {
      Number sum = 0;
      for (std::size_t k = 0; k < laws.size(); ++k)
      {
        const Number change = to.D[k] - from.D[k], D = from.D[k] + s * change,
                     N = from.N[k] + s * (to.N[k] - from.N[k]);
        sum += change * (laws[k] ? N - laws[k]->force(-D) : N);
      }
      return sum;
    }

    void shorten(const Laws &laws, const Point &from, Point &to)
    {
      const Number half = Number(1) / 2;
      if (slope_of_energy(laws, from, to, half) + slope_of_energy(laws, from, to, Number(1)) <= 0)
        return;
      Number low = 0, high = 1;
      for (unsigned int i = 0; i < n_bisections; ++i)
      {
        const Number s = half * (low + high);
        (slope_of_energy(laws, from, to, s) > 0 ? high : low) = s;
      }
      to.N = from.N + high * (to.N - from.N);
      to.D = from.D + high * (to.D - from.D);
    }

    /// The solution with laws that are linear, tangents at u.
    Point solve_tangents(const Matrix &F, const Vector &d, const std::vector<char> &unilateral,
                         const std::vector<char> &closed, const Laws &laws, const Vector &u)
    {
      Matrix softened = F;
      Vector shifted = d;
      for (std::size_t k = 0; k < laws.size(); ++k)
        if (laws[k])
        {
          const Number S = 1 / laws[k]->slope(u[k]);
          softened(k, k) += S;
          shifted[k] += u[k] - S * laws[k]->force(u[k]);
        }
      Point result;
      result.N = principal_pivoting(softened, shifted, unilateral, closed);
      result.D = F.times(result.N) + d;
      return result;
    }

    /// The largest that a law lacks as a gap, over the terms of its gap.
    Number error(const Matrix &F, const Vector &d, const Laws &laws, const Point &at)
    {
      Number largest = 0;
      for (std::size_t k = 0; k < laws.size(); ++k)
        if (laws[k])
        {
          const Number u = laws[k]->least_compression(-at.D[k]),
                       lacks = abs(at.N[k] - laws[k]->force(u)) / laws[k]->slope(u);
          if (lacks > 0)
            largest = std::max(largest, Number(lacks / (abs(d[k]) + F(k, k) * abs(at.N[k]))));
        }
      return largest;
    }
  } // namespace

  Number ConservingLaw::force(const Number &u) const
  {
    if (u >= 0 && before >= 0)
      return stiffness * (u + before);
    if (u <= 0 && before <= 0)
      return 0;
    const Number largest = std::max(u, before);
    return stiffness * largest * largest / abs(u - before);
  }

  Number ConservingLaw::slope(const Number &u) const
  {
    const Number difference = u - before, least = least_slope * stiffness;
    if (u >= 0 && before >= 0)
      return stiffness;
    if (u <= 0 && before <= 0)
      return least;
    const Number part = before > 0 ? before * before : u * (u - 2 * before);
    return std::max(least, Number(stiffness * part / (difference * difference)));
  }

  Number ConservingLaw::least_compression(const Number &u) const
  {
    return before > 0 || u > 0 ? u : Number(0);
  }

  Vector solve_with_laws(const Matrix &F, const Vector &d, const std::vector<char> &unilateral,
                         std::vector<char> closed, const Laws &laws)
  {
    if (std::none_of(laws.begin(), laws.end(), [](const auto &law) { return law.has_value(); }))
      return principal_pivoting(F, d, unilateral, closed);
    Vector u(Number(0), d.size());
    for (std::size_t k = 0; k < d.size(); ++k)
      if (laws[k])
        u[k] = laws[k]->least_compression(-d[k]);
    Point last;
    for (unsigned int iteration = 0; iteration < most_iterations; ++iteration)
    {
      Point now = solve_tangents(F, d, unilateral, closed, laws, u);
      if (error(F, d, laws, now) <= converged)
        return now.N;
      for (std::size_t k = 0; k < d.size(); ++k)
        closed[k] = !unilateral[k] || now.N[k] > 0;
      if (iteration > 0)
        shorten(laws, last, now);
      for (std::size_t k = 0; k < d.size(); ++k)
        if (laws[k])
          u[k] = laws[k]->least_compression(-now.D[k]);
      last = std::move(now);
    }
    throw std::logic_error("Newton's method on laws does not end");
  }
} // namespace extremes
