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
    constexpr std::size_t most_elements = 64, least_elements = 8;

    /// Chebyshev points of a panel, and places where its polynomial is compared with the formula in
    /// each step.
    constexpr unsigned int n_chebyshev = 12, n_compared = 8;

    /// Times of a window at which the load is looked at in each element.
    constexpr unsigned int n_looks = 4;
    constexpr int no_window = std::numeric_limits<int>::min();

    using Weights = std::array<double, n_chebyshev>;

    /// The Chebyshev points of the first kind on (0, 1).
    const Weights &chebyshev_points()
    {
      static const Weights result = []
      {
        Weights points;
        for (unsigned int k = 0; k < n_chebyshev; ++k)
          points[k] = .5 - .5 * std::cos(M_PI * (k + .5) / n_chebyshev);
        return points;
      }();
      return result;
    }

    /// Of the values at the nodes in the value at u, by the barycentric formula: Berrut and
    /// Trefethen, SIAM Review 46 (2004), p. 501.
    Weights weights_at(const double u)
    {
      Weights result;
      double sum = 0.;
      for (unsigned int k = 0; k < n_chebyshev; ++k)
      {
        const double from_node = u - chebyshev_points()[k];
        if (from_node == 0.)
        {
          result.fill(0.);
          result[k] = 1.;
          return result;
        }
        result[k] = (k % 2 ? -1. : 1.) * std::sin(M_PI * (k + .5) / n_chebyshev) / from_node;
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
      return t == 0. ? no_window + 1 : std::ilogb(t) >> 1;
    }
  } // namespace

  /// The load at the Gauss points of all elements, at one time.
  class SmoothLoad::Look
  {
  public:
    static constexpr unsigned int n_points = LoadedElement::n_points;

    Look(const SmoothLoad &load, const double t)
        : load(load), t(t), values(load.elements.size() * n_points)
    {
      std::vector<double> places;
      places.reserve(values.size());
      for (const LoadedElement &element : load.elements)
        places.insert(places.end(), element.places.begin(), element.places.end());
      load.magnitude.evaluate(places, t, values);
      largest = largest_of(values.data(), values.size());
    }

    bool resolves(const Panel &panel) const
    {
      std::vector<double> places, at_nodes(n_chebyshev);
      for (const double u : chebyshev_points())
        places.push_back(panel.begin + panel.length * u);
      load.magnitude.evaluate(places, t, at_nodes);
      const double *const own = &values[panel.first * n_points];
      const std::size_t n = (panel.last - panel.first) * n_points;
      const double accepted =
          LoadIntegral::of_polynomial *
          std::max({largest_of(own, n), largest_of(at_nodes.data(), n_chebyshev),
                    LoadIntegral::least_part * largest});
      for (std::size_t e = panel.first; e < panel.last; ++e)
        for (unsigned int q = 0; q < n_points; ++q)
        {
          const double s = load.elements[e].places[q],
                       error =
                           value_of(weights_at((s - panel.begin) / panel.length), at_nodes.data()) -
                           values[e * n_points + q];
          if (!(std::fabs(error) <= accepted))
            return false;
        }
      return true;
    }

  private:
    const SmoothLoad &load;
    double t, largest;
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
    const double begin = t == 0. ? 0. : std::copysign(std::ldexp(1., 2 * window), t);
    for (unsigned int k = 0; k < n_looks; ++k)
      try
      {
        looks.emplace_back(*this, begin * (1. + 3. * (k + .5) / n_looks));
      }
      catch (const UserError &)
      {
        // The run may never come to a time at which the formula has no value.
      }
    const std::size_t n = elements.size(), n_panels = (n + most_elements - 1) / most_elements;
    for (std::size_t p = 0; p < n_panels; ++p)
      if (!split(p * n / n_panels, (p + 1) * n / n_panels, looks))
        return;
    places.resize(panels.size() * (n_chebyshev + n_compared));
    values.resize(places.size());
    auto place = places.begin();
    for (const Panel &panel : panels)
      for (const double u : chebyshev_points())
        *place++ = panel.begin + panel.length * u;
    is_smooth = true;
  }

  bool SmoothLoad::split(const std::size_t first, const std::size_t last,
                         const std::vector<Look> &looks) const
  {
    if (last - first < least_elements)
      return false;
    Panel own = panel(first, last);
    if (std::all_of(looks.begin(), looks.end(),
                    [&](const Look &look) { return look.resolves(own); }))
    {
      panels.push_back(std::move(own));
      return true;
    }
    const std::size_t middle = (first + last) / 2;
    return split(first, middle, looks) && split(middle, last, looks);
  }

  SmoothLoad::Panel SmoothLoad::panel(const std::size_t first, const std::size_t last) const
  {
    constexpr unsigned int n_points = LoadedElement::n_points;
    Panel result{first, last, elements[first].begin, 0., {}};
    result.length = elements[last - 1].begin + elements[last - 1].length - result.begin;
    const std::size_t n_own = (last - first - 1) * dofs_between + n_dofs;
    result.matrix.assign(n_own * n_chebyshev, 0.);
    for (std::size_t e = first; e < last; ++e)
      for (unsigned int q = 0; q < n_points; ++q)
      {
        const Weights weights = weights_at((elements[e].places[q] - result.begin) / result.length);
        for (unsigned int i = 0; i < n_dofs; ++i)
          for (unsigned int k = 0; k < n_chebyshev; ++k)
            result.matrix[((e - first) * dofs_between + i) * n_chebyshev + k] +=
                forces[(e * n_points + q) * n_dofs + i] * weights[k];
      }
    return result;
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
