// SPDX-License-Identifier: LGPL-2.1-or-later
#include "wire/smooth_load.h"

#include "base/instruction_set.h"
#include <taut/base/exceptions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace taut
{
  namespace
  {
    constexpr std::size_t most_elements = 96, least_elements = 4;

    /// Chebyshev points of a panel, and places where its polynomial is compared with the formula in
    /// each step.
    constexpr unsigned int n_chebyshev = 12, n_compared = 4;

    /// Times of a window at which the load is looked at in each element.
    constexpr unsigned int n_looks = 8;
    constexpr int no_window = std::numeric_limits<int>::min();

    using Weights = std::array<double, n_chebyshev>;

    /// The Chebyshev points of the first kind on (0, 1), and their barycentric weights: Berrut and
    /// Trefethen, SIAM Review 46 (2004), p. 501.
    struct ChebyshevPoints
    {
      ChebyshevPoints()
      {
        for (unsigned int k = 0; k < n_chebyshev; ++k)
        {
          const double angle = M_PI * (k + .5) / n_chebyshev;
          points[k] = .5 - .5 * std::cos(angle);
          weights[k] = k % 2 ? -std::sin(angle) : std::sin(angle);
        }
      }
      Weights points, weights;
    };

    const ChebyshevPoints &chebyshev()
    {
      static const ChebyshevPoints result;
      return result;
    }

    /// Of the values at the Chebyshev points in the value at u.
    Weights weights_at(const double u)
    {
      const ChebyshevPoints &of = chebyshev();
      Weights result;
      double sum = 0.;
      for (unsigned int k = 0; k < n_chebyshev; ++k)
      {
        const double from_point = u - of.points[k];
        if (from_point == 0.)
        {
          result.fill(0.);
          result[k] = 1.;
          return result;
        }
        result[k] = of.weights[k] / from_point;
        sum += result[k];
      }
      for (double &weight : result)
        weight /= sum;
      return result;
    }

    double value_of(const Weights &weights, const double *const values)
    {
      double result = 0.;
      for (unsigned int k = 0; k < n_chebyshev; ++k)
        result += weights[k] * values[k];
      return result;
    }

    double largest_of(const double *const values, const std::size_t n)
    {
      double result = 0.;
      for (std::size_t k = 0; k < n; ++k)
        result = std::max(result, std::fabs(values[k]));
      return result;
    }

    int window_of(const double t)
    {
      return t == 0. ? no_window + 1 : std::ilogb(t);
    }
  } // namespace

  /// The load in all elements, at one time.
  class SmoothLoad::Look
  {
  public:
    /// At one Gauss point of each, which changes from element to element.
    Look(const SmoothLoad &load, const double t, const unsigned int first_point)
        : load(load), t(t), first_point(first_point), values(load.elements.size())
    {
      std::vector<double> places(values.size());
      for (std::size_t e = 0; e < places.size(); ++e)
        places[e] = load.elements[e].places[point_of(e)];
      load.magnitude.evaluate(places, t, values);
      largest = largest_of(values.data(), values.size());
    }

    /// By a polynomial, with the @p weights of its values at all Gauss points of the panel.
    bool resolves(const Panel &panel, const std::vector<Weights> &weights) const
    {
      std::vector<double> places, at_points(n_chebyshev);
      for (const double u : chebyshev().points)
        places.push_back(panel.begin + panel.length * u);
      load.magnitude.evaluate(places, t, at_points);
      const double accepted =
          LoadIntegral::of_polynomial *
          std::max({largest_of(&values[panel.first], panel.last - panel.first),
                    largest_of(at_points.data(), n_chebyshev), LoadIntegral::least_part * largest});
      for (std::size_t e = panel.first; e < panel.last; ++e)
      {
        const Weights &own = weights[(e - panel.first) * LoadedElement::n_points + point_of(e)];
        if (!(std::fabs(value_of(own, at_points.data()) - values[e]) <= accepted))
          return false;
      }
      return true;
    }

  private:
    unsigned int point_of(const std::size_t element) const
    {
      return (element + first_point) % LoadedElement::n_points;
    }

    const SmoothLoad &load;
    double t, largest;
    unsigned int first_point;
    std::vector<double> values;
  };

  SmoothLoad::SmoothLoad(const Expression &magnitude, const Elements &elements,
                         const std::vector<double> &forces, const unsigned int n_dofs,
                         const unsigned int dofs_between)
      : magnitude(magnitude), elements(elements), forces(forces), n_dofs(n_dofs),
        dofs_between(dofs_between), window(no_window)
  {
  }

  bool SmoothLoad::covers(const double t) const
  {
    if (const int own = window_of(t); own != window)
    {
      window = own;
      choose(t);
    }
    return is_smooth;
  }

  /// Panels for the window of this time.
  void SmoothLoad::choose(const double t) const
  {
    panels.clear();
    is_smooth = false;
    std::vector<Look> looks;
    const double begin = t == 0. ? 0. : std::copysign(std::ldexp(1., window), t);
    for (unsigned int k = 0; k < n_looks; ++k)
      try
      {
        looks.emplace_back(*this, begin * (1. + (k + .5) / n_looks), k);
      }
      catch (const UserError &)
      {
        // The run may never come to a time at which the formula has no value.
      }
    if (looks.empty())
      return;
    const std::size_t n = elements.size(), n_panels = (n + most_elements - 1) / most_elements;
    for (std::size_t p = 0; p < n_panels; ++p)
      if (!split(p * n / n_panels, (p + 1) * n / n_panels, looks))
        return;
    places.resize(panels.size() * (n_chebyshev + n_compared));
    values.resize(places.size());
    auto place = places.begin();
    for (const Panel &panel : panels)
      for (const double u : chebyshev().points)
        *place++ = panel.begin + panel.length * u;
    is_smooth = true;
  }

  bool SmoothLoad::split(const std::size_t first, const std::size_t last,
                         const std::vector<Look> &looks) const
  {
    if (last - first < least_elements)
      return false;
    Panel panel{first, last, elements[first].begin, 0., {}};
    panel.length = elements[last - 1].begin + elements[last - 1].length - panel.begin;
    std::vector<Weights> weights;
    weights.reserve((last - first) * LoadedElement::n_points);
    for (std::size_t e = first; e < last; ++e)
      for (const double s : elements[e].places)
        weights.push_back(weights_at((s - panel.begin) / panel.length));
    if (!std::all_of(looks.begin(), looks.end(),
                     [&](const Look &look) { return look.resolves(panel, weights); }))
    {
      const std::size_t middle = (first + last) / 2;
      return split(first, middle, looks) && split(middle, last, looks);
    }
    panel.matrix.assign(((last - first - 1) * dofs_between + n_dofs) * n_chebyshev, 0.);
    const double *force = &forces[first * LoadedElement::n_points * n_dofs];
    for (std::size_t i = 0; i < weights.size(); ++i)
    {
      double *row = &panel.matrix[i / LoadedElement::n_points * dofs_between * n_chebyshev];
      for (unsigned int j = 0; j < n_dofs; ++j, ++force, row += n_chebyshev)
        for (unsigned int k = 0; k < n_chebyshev; ++k)
          row[k] += *force * weights[i][k];
    }
    panels.push_back(std::move(panel));
    return true;
  }

  void SmoothLoad::add(const double t, std::vector<double> &P,
                       const std::function<void(std::size_t)> &other) const
  {
    // The fraction of a multiple of the time, and from place to place by the golden ratio.
    constexpr double multiple = 15485863.618, golden = 0.61803398874989485;
    const double start = std::fmod(std::fabs(t) * multiple, 1.);
    std::array<Weights, n_compared> weights;
    auto place = places.begin() + panels.size() * n_chebyshev;
    for (unsigned int j = 0; j < n_compared; ++j)
    {
      const double u = std::fmod(start + j * golden, 1.);
      weights[j] = weights_at(u);
      for (const Panel &panel : panels)
        *place++ = panel.begin + panel.length * u;
    }
    magnitude.evaluate(places, t, values);
    const double negligible = LoadIntegral::least_part * largest_of(values.data(), values.size());
    for (std::size_t p = 0; p < panels.size(); ++p)
    {
      const Panel &panel = panels[p];
      const double *const at_nodes = &values[p * n_chebyshev];
      const double *const at_places = &values[panels.size() * n_chebyshev + p];
      double largest = largest_of(at_nodes, n_chebyshev), error = 0.;
      for (unsigned int j = 0; j < n_compared; ++j)
      {
        const double value = at_places[j * panels.size()];
        largest = std::max(largest, std::fabs(value));
        error = std::max(error, std::fabs(value_of(weights[j], at_nodes) - value));
      }
      if (largest <= LoadIntegral::of_polynomial * negligible)
        continue;
      if (error <= LoadIntegral::of_polynomial * std::max(largest, negligible))
        vectorised(
            [&P, &panel, at_nodes, first = panel.first * dofs_between]
            {
              const double *row = panel.matrix.data();
              const std::size_t n_rows = panel.matrix.size() / n_chebyshev;
              double *const sum = &P[first];
              for (std::size_t i = 0; i < n_rows; ++i, row += n_chebyshev)
              {
                double force = 0.;
                for (unsigned int k = 0; k < n_chebyshev; ++k)
                  force += row[k] * at_nodes[k];
                sum[i] += force;
              }
            });
      else
        for (std::size_t e = panel.first; e < panel.last; ++e)
          other(e);
    }
  }
} // namespace taut
