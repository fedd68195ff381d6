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
    constexpr std::size_t most_elements = 192, least_elements = 4;

    /// Numbers of Chebyshev points of a panel; the least that suffices is taken. A wave takes pi
    /// points a length, and some twelve for the digits of a panel: the more lengths a panel has,
    /// the fewer points each of them takes.
    constexpr unsigned int least_points = 12, n_counts = 5, most_points = n_counts * least_points;

    /// Difference between the matrices of panels that count as one, over the largest entry: above
    /// the rounding of places, and far below the errors of polynomials.
    constexpr double same = 1e-10;

    /// Elements to one point at most, so that a pulse between the looks is seen. Points to an
    /// element at most: more would resolve waves that its four Gauss points do not integrate.
    constexpr double most_to_point = 8., most_in_element = 1.5;

    /// Places where the polynomial of a panel is compared with the formula in each step.
    constexpr unsigned int n_compared = 8;

    /// Times of a window at which the load is looked at in each element.
    constexpr unsigned int n_looks = 8;

    /// Places in an element, nearer to each other than the width of the narrowest load that an
    /// element sees at once; and looks from one of these to the next that has them.
    constexpr unsigned int n_places = 6, looks_to_details = 4;
    static_assert(n_places * LoadIntegral::seen_at_once > 1.);
    constexpr int no_window = std::numeric_limits<int>::min();

    using Weights = std::array<double, most_points>;

    /// The Chebyshev points of the first kind on (0, 1), and their barycentric weights: Berrut and
    /// Trefethen, SIAM Review 46 (2004), p. 501.
    struct ChebyshevPoints
    {
      explicit ChebyshevPoints(const unsigned int n) : n(n)
      {
        for (unsigned int k = 0; k < n; ++k)
        {
          const double angle = M_PI * (k + .5) / n;
          points[k] = .5 - .5 * std::cos(angle);
          weights[k] = k % 2 ? -std::sin(angle) : std::sin(angle);
        }
      }
      unsigned int n;
      Weights points, weights;
    };

    const ChebyshevPoints &chebyshev(const unsigned int n)
    {
      static const std::vector<ChebyshevPoints> all = []
      {
        std::vector<ChebyshevPoints> result;
        for (unsigned int n = least_points; n <= most_points; n += least_points)
          result.emplace_back(n);
        return result;
      }();
      return all[n / least_points - 1];
    }

    /// Of the values at @p n Chebyshev points in the value at u.
    Weights weights_at(const double u, const unsigned int n)
    {
      const ChebyshevPoints &of = chebyshev(n);
      Weights result;
      double sum = 0.;
      for (unsigned int k = 0; k < n; ++k)
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
      for (unsigned int k = 0; k < n; ++k)
        result[k] /= sum;
      return result;
    }

    double value_of(const Weights &weights, const double *const values, const unsigned int n)
    {
      double result = 0.;
      for (unsigned int k = 0; k < n; ++k)
        result += weights[k] * values[k];
      return result;
    }

    /// The polynomial with these values at n Chebyshev points, at u.
    double value_at(const double u, const double *const values, const unsigned int n)
    {
      const ChebyshevPoints &of = chebyshev(n);
      double sum = 0., of_values = 0.;
      for (unsigned int k = 0; k < n; ++k)
      {
        const double from_point = u - of.points[k];
        if (from_point == 0.)
          return values[k];
        const double weight = of.weights[k] / from_point;
        sum += weight;
        of_values += weight * values[k];
      }
      return of_values / sum;
    }

    /// Adds the product of a matrix, column by column, with as many values as it has columns.
    void add_product(const std::vector<double> &matrix, const double *const values,
                     const unsigned int n_columns, double *const sum)
    {
      constexpr unsigned int at_once = 4;
      static_assert(least_points % at_once == 0);
      vectorised(
          [&matrix, values, n_columns, sum]
          {
            const std::size_t n_rows = matrix.size() / n_columns;
            const double *column = matrix.data();
            for (unsigned int k = 0; k < n_columns; k += at_once, column += at_once * n_rows)
              for (std::size_t i = 0; i < n_rows; ++i)
                sum[i] += column[i] * values[k] + column[i + n_rows] * values[k + 1] +
                          column[i + 2 * n_rows] * values[k + 2] +
                          column[i + 3 * n_rows] * values[k + 3];
          });
    }

    double largest_of(const double *const values, const std::size_t n)
    {
      double result = 0.;
      for (std::size_t k = 0; k < n; ++k)
        result = std::max(result, std::fabs(values[k]));
      return result;
    }

    /// The first window begins at 0 and ends at 2^-6 s, so that a run does not have many of them.
    constexpr int first_window = -7;

    int window_of(const double t)
    {
      return std::max(first_window, t == 0. ? first_window : std::ilogb(t));
    }
  } // namespace

  /// The load in all elements, at one time.
  class SmoothLoad::Look
  {
  public:
    /// At one Gauss point of each, which changes from element to element.
    Look(const SmoothLoad &load, const double t, const unsigned int number)
        : load(load), t(t), first_point(number), first_place((number + .5) / n_looks),
          values(load.elements.size())
    {
      std::vector<double> places(values.size());
      for (std::size_t e = 0; e < places.size(); ++e)
        places[e] = load.elements[e].places[point_of(e)];
      load.magnitude.evaluate(places, t, values);
      if (number % looks_to_details == 0)
      {
        places.clear();
        for (const LoadedElement &element : load.elements)
          for (unsigned int k = 0; k < n_places; ++k)
            places.push_back(element.begin + element.length * (k + first_place) / n_places);
        load.magnitude.evaluate(places, t, fine);
      }
      largest =
          std::max(largest_of(values.data(), values.size()), largest_of(fine.data(), fine.size()));
    }

    /// By a polynomial, with the @p weights of its values at all Gauss points of the panel.
    bool resolves(const Panel &panel, const std::vector<Weights> &weights) const
    {
      std::vector<double> at_points;
      if (!evaluate(panel, at_points))
        return false;
      const double accepted = accepted_on(panel, at_points);
      for (std::size_t e = panel.first; e < panel.last; ++e)
      {
        const Weights &own = weights[(e - panel.first) * LoadedElement::n_points + point_of(e)];
        if (!(std::fabs(value_of(own, at_points.data(), panel.n_points) - values[e]) <= accepted))
          return false;
      }
      return true;
    }

    /// Whether the polynomial misses nothing inside of an element.
    bool resolves_details(const Panel &panel) const
    {
      if (fine.empty())
        return true;
      std::vector<double> at_points;
      if (!evaluate(panel, at_points))
        return false;
      const double accepted = accepted_on(panel, at_points);
      for (std::size_t e = panel.first; e < panel.last; ++e)
        for (unsigned int k = 0; k < n_places; ++k)
        {
          const LoadedElement &element = load.elements[e];
          const double s = element.begin + element.length * (k + first_place) / n_places;
          const double value =
              value_at((s - panel.begin) / panel.length, at_points.data(), panel.n_points);
          if (!(std::fabs(value - fine[e * n_places + k]) <= accepted))
            return false;
        }
      return true;
    }

  private:
    /// Values at the points of the panel; false if the formula has none: the elements may need no
    /// such place.
    bool evaluate(const Panel &panel, std::vector<double> &at_points) const
    {
      std::vector<double> places;
      at_points.resize(panel.n_points);
      for (unsigned int k = 0; k < panel.n_points; ++k)
        places.push_back(panel.begin + panel.length * chebyshev(panel.n_points).points[k]);
      try
      {
        load.magnitude.evaluate(places, t, at_points);
      }
      catch (const UserError &)
      {
        return false;
      }
      return true;
    }

    double accepted_on(const Panel &panel, const std::vector<double> &at_points) const
    {
      return LoadIntegral::of_polynomial *
             std::max({largest_of(&values[panel.first], panel.last - panel.first),
                       largest_of(at_points.data(), panel.n_points),
                       LoadIntegral::least_part * largest});
    }

    unsigned int point_of(const std::size_t element) const
    {
      return (element + first_point) % LoadedElement::n_points;
    }

    const SmoothLoad &load;
    double t, largest;
    unsigned int first_point;         ///< the Gauss point of the first element
    double first_place;               ///< of n_places in an element, as a part of their distance
    std::vector<double> values, fine; ///< the latter at some looks
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
    const double end = std::copysign(std::ldexp(1., window + 1), t),
                 begin = window == first_window ? 0. : .5 * end;
    for (unsigned int k = 0; k < n_looks; ++k)
      try
      {
        looks.emplace_back(*this, begin + (end - begin) * (k + .5) / n_looks, k);
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
    places.clear();
    for (const Panel &panel : panels)
      for (unsigned int k = 0; k < panel.n_points; ++k)
        places.push_back(panel.begin + panel.length * chebyshev(panel.n_points).points[k]);
    n_nodes = places.size();
    places.resize(n_nodes + panels.size() * n_compared);
    values.resize(places.size());
    is_smooth = true;
  }

  bool SmoothLoad::split(const std::size_t first, const std::size_t last,
                         const std::vector<Look> &looks) const
  {
    if (last - first < least_elements)
      return false;
    const double n_elements = static_cast<double>(last - first);
    for (unsigned int n = least_points; n <= most_points; n += least_points)
      if (n * most_to_point >= n_elements &&
          (n == least_points || n <= most_in_element * n_elements) &&
          add_panel(first, last, n, looks))
        return true;
    const std::size_t middle = (first + last) / 2;
    return split(first, middle, looks) && split(middle, last, looks);
  }

  /// False if so many points do not resolve the load at all looks.
  bool SmoothLoad::add_panel(const std::size_t first, const std::size_t last,
                             const unsigned int n_points, const std::vector<Look> &looks) const
  {
    if (std::any_of(elements.begin() + first, elements.begin() + last,
                    [](const LoadedElement &element) { return element.n_pieces > 1; }))
      return false;
    Panel panel{first, last, n_points, elements[first].begin, 0., nullptr};
    panel.length = elements[last - 1].begin + elements[last - 1].length - panel.begin;
    std::vector<Weights> weights;
    weights.reserve((last - first) * LoadedElement::n_points);
    for (std::size_t e = first; e < last; ++e)
      for (const double s : elements[e].places)
        weights.push_back(weights_at((s - panel.begin) / panel.length, n_points));
    if (!std::all_of(looks.begin(), looks.end(),
                     [&](const Look &look) { return look.resolves(panel, weights); }) ||
        !std::all_of(looks.begin(), looks.end(),
                     [&](const Look &look) { return look.resolves_details(panel); }))
      return false;
    const std::size_t n_rows = (last - first - 1) * dofs_between + n_dofs;
    std::vector<double> matrix(n_rows * n_points);
    const double *force = &forces[first * LoadedElement::n_points * n_dofs];
    for (std::size_t i = 0; i < weights.size(); ++i)
      for (unsigned int j = 0; j < n_dofs; ++j, ++force)
        for (unsigned int k = 0; k < n_points; ++k)
          matrix[k * n_rows + i / LoadedElement::n_points * dofs_between + j] +=
              *force * weights[i][k];
    panel.matrix = shared(std::move(matrix), n_points);
    panels.push_back(std::move(panel));
    return true;
  }

  /// The matrix, or that of a panel before which is the same: where elements are alike. Then it
  /// stays in the cache.
  std::shared_ptr<const std::vector<double>> SmoothLoad::shared(std::vector<double> &&matrix,
                                                                const unsigned int n_points) const
  {
    const double accepted = same * largest_of(matrix.data(), matrix.size());
    for (const Panel &panel : panels)
      if (panel.n_points == n_points && panel.matrix->size() == matrix.size() &&
          std::equal(matrix.begin(), matrix.end(), panel.matrix->begin(),
                     [accepted](const double a, const double b)
                     { return std::fabs(a - b) <= accepted; }))
        return panel.matrix;
    return std::make_shared<const std::vector<double>>(std::move(matrix));
  }

  void SmoothLoad::add(const double t, std::vector<double> &P,
                       const std::function<void(std::size_t)> &other) const
  {
    // The fraction of a multiple of the time, and from place to place by the golden ratio.
    constexpr double multiple = 15485863.618, golden = 0.61803398874989485;
    const double start = std::fmod(std::fabs(t) * multiple, 1.);
    std::array<bool, n_counts> is_used = {};
    for (const Panel &panel : panels)
      is_used[panel.n_points / least_points - 1] = true;
    std::array<std::array<Weights, n_counts>, n_compared> weights;
    auto place = places.begin() + n_nodes;
    for (unsigned int j = 0; j < n_compared; ++j)
    {
      const double u = std::fmod(start + j * golden, 1.);
      for (unsigned int k = 0; k < n_counts; ++k)
        if (is_used[k])
          weights[j][k] = weights_at(u, (k + 1) * least_points);
      for (const Panel &panel : panels)
        *place++ = panel.begin + panel.length * u;
    }
    magnitude.evaluate(places, t, values);
    const double negligible = LoadIntegral::least_part * largest_of(values.data(), values.size());
    const double *at_nodes = values.data(), *at_places = values.data() + n_nodes;
    for (const Panel &panel : panels)
    {
      const unsigned int count = panel.n_points / least_points - 1;
      double largest = largest_of(at_nodes, panel.n_points), error = 0.;
      for (unsigned int j = 0; j < n_compared; ++j)
      {
        const double value = at_places[j * panels.size()];
        largest = std::max(largest, std::fabs(value));
        error = std::max(error,
                         std::fabs(value_of(weights[j][count], at_nodes, panel.n_points) - value));
      }
      double *const sum = &P[panel.first * dofs_between];
      if (largest > LoadIntegral::of_polynomial * negligible)
      {
        if (error > LoadIntegral::of_polynomial * std::max(largest, negligible))
          for (std::size_t e = panel.first; e < panel.last; ++e)
            other(e);
        else
          add_product(*panel.matrix, at_nodes, panel.n_points, sum);
      }
      at_nodes += panel.n_points;
      ++at_places;
    }
  }
} // namespace taut
