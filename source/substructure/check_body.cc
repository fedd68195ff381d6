// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/text.h"
#include <taut/base/exceptions.h>
#include <taut/substructure/body_traits.h>
#include <taut/substructure/check_body.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

namespace taut
{
  namespace
  {
    using Vector = std::vector<double>;

    constexpr double epsilon = std::numeric_limits<double>::epsilon();

    /// Step of differences over the length: their error, the fourth power of the step, is then
    /// about the rounding error over the step.
    constexpr double part_of_length = 1e-3;

    /// Smallest discrepancy over the largest value: mistakes are larger, and differences of sound
    /// bodies are a thousand times smaller.
    constexpr double discrepancy = 1e-6;

    /// Number of rounding operations in a sum of energies or forces.
    constexpr double operations = 1e3;

    /// A difference quotient at zero, its error against the derivative, and the size of the
    /// function.
    struct Slope
    {
      Vector value;
      double error = 0.;
    };

    Vector quotient(const std::function<Vector(double)> &function, const double h, double &size)
    {
      const Vector a = function(-2. * h), b = function(-h), c = function(h), d = function(2. * h);
      Vector result(a.size());
      for (std::size_t i = 0; i < a.size(); ++i)
      {
        result[i] = (8. * (c[i] - b[i]) - (d[i] - a[i])) / (12. * h);
        size = std::max({size, std::fabs(a[i]), std::fabs(b[i]), std::fabs(c[i]), std::fabs(d[i])});
      }
      return result;
    }

    /// Central differences of fourth order over two distances, which give their error.
    Slope slope(const std::function<Vector(double)> &function, const double length)
    {
      const double h = part_of_length * length;
      double size = 0.;
      const Vector coarse = quotient(function, h, size);
      Slope result{quotient(function, .5 * h, size)};
      for (std::size_t i = 0; i < coarse.size(); ++i)
        result.error = std::max(result.error, std::fabs(coarse[i] - result.value[i]));
      result.error += operations * epsilon * size / h;
      return result;
    }

    double largest(const Vector &x)
    {
      double result = 0.;
      for (const double v : x)
        result = std::isnan(v) ? v : std::max(result, std::fabs(v));
      return result;
    }

    class BodyCheck
    {
    public:
      BodyCheck(const Substructure &body, const Vector &U, const double length)
          : body(body), U(U), length(length),
            works(dynamic_cast<const ConstrainedBody *>(&body) == nullptr)
      {
      }

      std::vector<std::string> run()
      {
        if (works)
          check_energy();
        const auto force = [&](const Vector &x, const Vector &v) { return internal_force(x, v); };
        compare_columns("tangent()", *tangent(body.tangent(U, {}, rate, false), "tangent()"),
                        "internal_force()", 1., force);
        check_damping();
        check_mean_force();
        compare_columns("mean_tangent()",
                        *tangent(body.mean_tangent(U, U, 0., false), "mean_tangent()"),
                        "mean_internal_force()", 2.,
                        [&](const Vector &x, const Vector &) { return mean_force(x); });
        if (body.is_linear())
          check_null_space();
        return found;
      }

    private:
      static constexpr double rate = 1.; ///< dV/dU [1/s]

      /// Steps so long that the damping of the material has no force [s].
      static constexpr double long_step = 1e30;

      Vector moved(const std::size_t i, const double by) const
      {
        Vector x = U;
        x[i] += by;
        return x;
      }

      Vector sized(Vector f, const char *function) const
      {
        if (f.size() != U.size())
          throw UserError("body '" + body.name() + "': " + function + " gives " +
                          std::to_string(f.size()) + " entries for " + std::to_string(U.size()) +
                          " DoFs");
        return f;
      }

      Vector internal_force(const Vector &x, const Vector &v) const
      {
        Vector f;
        body.internal_force(x, v, f);
        return sized(std::move(f), "internal_force()");
      }

      Vector mean_force(const Vector &x) const
      {
        Vector f;
        body.mean_internal_force(U, x, long_step, f);
        return sized(std::move(f), "mean_internal_force()");
      }

      std::unique_ptr<SymmetricMatrix> tangent(std::unique_ptr<SymmetricMatrix> A,
                                               const char *function) const
      {
        if (!A || A->size() != U.size())
          throw UserError(
              "body '" + body.name() + "': " + function + " gives " +
              (A ? std::to_string(A->size()) + " rows for " + std::to_string(U.size()) + " DoFs"
                 : std::string("nullptr")));
        return A;
      }

      void note(const std::string &what, const double said, const double expected)
      {
        found.push_back(to_text(std::setprecision(10), "body '", body.name(), "': ", what, ": ",
                                said, ", and by differences ", expected));
      }

      /// The worst entry, if it is a discrepancy.
      void compare(const Vector &said, const Slope &expected, const double scale,
                   const std::function<std::string(std::size_t)> &what)
      {
        std::size_t worst = 0;
        double difference = 0.;
        for (std::size_t i = 0; i < said.size(); ++i)
          if (const double d = std::fabs(said[i] - expected.value[i]); !(d <= difference))
          {
            difference = d;
            worst = i;
          }
        if (!(difference <= discrepancy * scale + expected.error))
          note(what(worst), said[worst], expected.value[worst]);
      }

      void check_energy()
      {
        Slope expected;
        for (std::size_t i = 0; i < U.size(); ++i)
        {
          const Slope one = slope(
              [&](const double h) { return Vector{body.strain_energy(moved(i, h))}; }, length);
          expected.value.push_back(one.value[0]);
          expected.error = std::max(expected.error, one.error);
        }
        const Vector f = internal_force(U, {});
        compare(f, expected, largest(f),
                [](const std::size_t i) {
                  return "internal_force() at DoF " + std::to_string(i) + ", of strain_energy()";
                });
      }

      /// The part of the tangent with the rate, at a velocity.
      void check_damping()
      {
        Vector V(U.size());
        for (std::size_t i = 0; i < V.size(); ++i)
          V[i] = length * std::cos(1.3 * (i + 1.));
        // A rate of 0 is a search at rest.
        const auto A = tangent(body.tangent(U, V, 2. * rate, false), "tangent()"),
                   before = tangent(body.tangent(U, V, rate, false), "tangent()");
        const double rounding = operations * epsilon * largest_entry(*A);
        A->add(-1., *before);
        compare_columns(
            "tangent(), part with the rate,", *A, "internal_force()", 1.,
            [&](const Vector &, Vector v)
            {
              for (std::size_t i = 0; i < v.size(); ++i)
                v[i] += V[i];
              return internal_force(U, v);
            },
            rounding);
      }

      static double largest_entry(const SymmetricMatrix &A)
      {
        double result = 0.;
        A.visit([&](unsigned int, unsigned int, const double value)
                { result = std::max(result, std::fabs(value)); });
        return result;
      }

      /// Compares columns of a matrix with @p factor times differences of a force; notes the worst
      /// column.
      void compare_columns(const std::string &name, const SymmetricMatrix &A,
                           const std::string &function, const double factor,
                           const std::function<Vector(const Vector &, const Vector &)> &force,
                           const double rounding = 0.)
      {
        const std::size_t n = U.size();
        const double scale = largest_entry(A);
        const std::size_t before = found.size();
        for (std::size_t j = 0; j < n && found.size() == before; ++j)
        {
          Vector e(n, 0.), column(n, 0.), V(n, 0.);
          e[j] = 1.;
          A.vmult_add(1., e.data(), column.data());
          Slope expected = slope(
              [&](const double h)
              {
                V[j] = rate * h;
                return force(moved(j, h), V);
              },
              length);
          for (double &value : expected.value)
            value *= factor;
          expected.error = factor * expected.error + rounding;
          compare(column, expected, std::max(scale, largest(expected.value)),
                  [&](const std::size_t i) {
                    return name + " at DoFs " + std::to_string(i) + ", " + std::to_string(j) +
                           ", of " + function;
                  });
        }
      }

      void check_mean_force()
      {
        const Vector f = internal_force(U, {}), mean = mean_force(U);
        Slope same{f};
        same.error = operations * epsilon * largest(f);
        compare(mean, same, largest(f),
                [](const std::size_t i)
                {
                  return "mean_internal_force() from U to U at DoF " + std::to_string(i) +
                         ", of internal_force() there";
                });
        for (const double size : {.01, .1, 1.})
          if (works && found.empty())
            check_work(.1 * size * length);
      }

      /// Checks a step that moves all DoFs, each by a different amount of about @p size.
      void check_work(const double size)
      {
        Vector x = U, d(U.size());
        for (std::size_t i = 0; i < U.size(); ++i)
        {
          d[i] = size * std::sin(1. + 2.4 * i);
          x[i] += d[i];
        }
        const Vector f = mean_force(x);
        double work = 0., work_size = 0.;
        for (std::size_t i = 0; i < U.size(); ++i)
        {
          work += f[i] * (x[i] - U[i]);
          work_size += std::fabs(f[i] * (x[i] - U[i]));
        }
        const double before = body.strain_energy(U), after = body.strain_energy(x),
                     rounding =
                         operations * epsilon * (work_size + std::fabs(before) + std::fabs(after));
        if (!(std::fabs(work - (after - before)) <= discrepancy * work_size + rounding))
          note("work of mean_internal_force() over a step of " + std::to_string(size) +
                   " m, of strain_energy()",
               work, after - before);
      }

      void check_null_space()
      {
        for (const Vector &R : body.null_space().vectors)
        {
          Slope none{Vector(U.size(), 0.)};
          Vector force(U.size(), 0.);
          body.stiffness().vmult_add(1., R.data(), force.data());
          double scale = 0.;
          body.stiffness().visit([&](unsigned int, unsigned int, const double value)
                                 { scale = std::max(scale, std::fabs(value)); });
          for (const ConstrainedDof &constraint : body.constraints())
            force[constraint.dof] = R[constraint.dof] * scale;
          compare(force, none, scale * largest(R),
                  [](const std::size_t i) {
                    return "force of a vector of null_space() at DoF " + std::to_string(i) +
                           ", of the stiffness";
                  });
        }
      }

      const Substructure &body;
      const Vector &U;
      const double length;
      const bool works;
      std::vector<std::string> found;
    };
  } // namespace

  std::vector<std::string> check_body(const Substructure &body, const std::vector<double> &U,
                                      const double length)
  {
    body.check_consistency();
    if (U.size() != body.n_dofs())
      throw UserError("body '" + body.name() + "': check_body() is given " +
                      std::to_string(U.size()) + " displacements for " +
                      std::to_string(body.n_dofs()) + " DoFs");
    if (!(length > 0.) || std::isinf(length))
      throw UserError("body '" + body.name() + "': check_body() needs a positive length");
    return BodyCheck(body, U, length).run();
  }
} // namespace taut
