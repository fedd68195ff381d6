// SPDX-License-Identifier: LGPL-2.1-or-later
#include "wire/smooth_load.h"
#include "wire/travelling_shape.h"
#include <taut/base/exceptions.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace taut
{
  namespace
  {
    /// Elements of a panel, from the most to the fewest that are worth it.
    constexpr std::size_t most_elements = 64, fewest_elements = 4;

    /// Times at which the length of panels is found: 0, then the first one doubled again and again
    /// [s].
    constexpr double first_time = .0137;
    constexpr int n_times = 16;

    /// Part of the largest value below which a value is rounding.
    constexpr double negligible = 1e-18;

    /// A load below this part of its size at set-up counts as if it had that much: the tail of a
    /// gust that has passed.
    constexpr double little = 1e-3;

    /// Times of a look at all elements [1/s].
    constexpr double looks_per_second = 4.;

    /// A value that differs from its polynomial by more has a detail that the panel does not see;
    /// over the largest value.
    constexpr double detail = 100. * SmoothLoad::tolerance;

    constexpr unsigned int n = 9;

    /// Gauss points on (-1, 1), their barycentric weights, and the rows that give the coefficients
    /// of degree 7 and 8 of the Legendre series.
    struct Points
    {
      std::array<double, n> x, barycentric;
      std::array<std::array<double, n>, 2> last;

      Points()
      {
        const dealii::QGauss<1> rule(n);
        for (unsigned int k = 0; k < n; ++k)
          x[k] = 2. * rule.point(k)[0] - 1.;
        for (unsigned int k = 0; k < n; ++k)
        {
          barycentric[k] = 1.;
          for (unsigned int j = 0; j < n; ++j)
            if (j != k)
              barycentric[k] /= x[k] - x[j];
          for (unsigned int d : {7u, 8u})
            last[d - 7][k] = (2. * d + 1.) * rule.weight(k) * std::legendre(d, x[k]);
        }
      }

      /// The values at y of the polynomials that are 1 at one of the points.
      std::array<double, n> shapes(const double y) const
      {
        std::array<double, n> result{};
        double sum = 0.;
        for (unsigned int k = 0; k < n; ++k)
        {
          if (y == x[k])
          {
            result.fill(0.);
            result[k] = 1.;
            return result;
          }
          sum += result[k] = barycentric[k] / (y - x[k]);
        }
        for (double &value : result)
          value /= sum;
        return result;
      }
    };

    const Points &points()
    {
      static const Points known;
      return known;
    }

    double largest_of(const std::vector<double> &values)
    {
      double largest = 0.;
      for (const double value : values)
        largest = std::max(largest, std::fabs(value));
      return largest;
    }
  } // namespace

  SmoothLoad::SmoothLoad(const Expression &magnitude, const std::vector<LoadedElement> &elements)
      : magnitude(magnitude)
  {
    // What is on the wire between two looks is on it at one of them.
    const double length = elements.back().begin + elements.back().length - elements.front().begin,
                 speed = speed_of_shape(magnitude.formula());
    if (!magnitude.is_analytic() || !(speed > 0.) || 2. * speed > looks_per_second * length)
      return;
    const std::size_t fewest = std::min(fewest_elements, elements.size());
    std::vector<double> times(1, 0.);
    for (int k = 0; k < n_times; ++k)
      times.push_back(std::ldexp(first_time, k));
    const auto at_all_times = [&](const auto &is_fine)
    {
      return std::all_of(times.begin(), times.end(),
                         [&](const double t)
                         {
                           try
                           {
                             return is_fine(t);
                           }
                           catch (const UserError &)
                           {
                             return true; // the run may never come to this time
                           }
                         });
    };
    make_panels(elements, fewest);
    at_all_times(
        [&](const double t)
        {
          set_values(t);
          size = std::max(size, largest_of(values));
          return true;
        });
    for (std::size_t m = most_elements; m >= fewest && m > 1; m /= 2)
    {
      make_panels(elements, m);
      if (!at_all_times([&](const double t) { return look(t); }))
        continue;
      for (Panel &panel : panels)
        add_forces(elements, panel);
      return;
    }
    panels.clear();
  }

  void SmoothLoad::make_panels(const std::vector<LoadedElement> &elements, const std::size_t m)
  {
    panels.clear();
    check_places.clear();
    const std::size_t n_panels = (elements.size() + m - 1) / m;
    for (std::size_t p = 0; p < n_panels; ++p)
    {
      Panel panel;
      panel.begin = p * elements.size() / n_panels;
      panel.end = (p + 1) * elements.size() / n_panels;
      const double begin = elements[panel.begin].begin,
                   end = elements[panel.end - 1].begin + elements[panel.end - 1].length;
      for (unsigned int k = 0; k < n_points; ++k)
        panel.places[k] = begin + .5 * (end - begin) * (1. + points().x[k]);
      for (std::size_t e = panel.begin; e < panel.end; ++e)
        for (unsigned int c = 0; c < n_checks; ++c)
          check_places.push_back(elements[e].begin + (c + .5) / n_checks * elements[e].length);
      panels.push_back(std::move(panel));
    }
  }

  void SmoothLoad::add_forces(const std::vector<LoadedElement> &elements, Panel &panel) const
  {
    unsigned int last_dof = 0;
    panel.first_dof = std::numeric_limits<unsigned int>::max();
    for (std::size_t e = panel.begin; e < panel.end; ++e)
      for (const LinearForm &shape : elements[e].shapes)
        for (const unsigned int dof : shape.index)
        {
          panel.first_dof = std::min(panel.first_dof, dof);
          last_dof = std::max(last_dof, dof);
        }
    const std::size_t n_dofs = last_dof + 1 - panel.first_dof;
    panel.forces.assign(n_points * n_dofs, 0.);
    const double begin = elements[panel.begin].begin,
                 length = elements[panel.end - 1].begin + elements[panel.end - 1].length - begin;
    for (std::size_t e = panel.begin; e < panel.end; ++e)
      for (unsigned int q = 0; q < LoadedElement::n_points; ++q)
      {
        const LinearForm &shape = elements[e].shapes[q];
        const std::array<double, n> at =
            points().shapes(2. * (elements[e].places[q] - begin) / length - 1.);
        for (unsigned int k = 0; k < n_points; ++k)
          for (std::size_t i = 0; i < shape.index.size(); ++i)
            panel.forces[k * n_dofs + shape.index[i] - panel.first_dof] += at[k] * shape.value[i];
      }
  }

  /// What errors are relative to, at a time with this largest value.
  double SmoothLoad::scale(const double largest) const
  {
    return std::max(largest, little * size);
  }

  /// Sets the values at t, zero in panels where they are rounding at both ends and in the middle,
  /// and there in both neighbours.
  void SmoothLoad::set_values(const double t) const
  {
    constexpr unsigned int n_probes = 3, stride = (n_points - 1) / (n_probes - 1);
    some_places.clear();
    for (const Panel &panel : panels)
      for (unsigned int k = 0; k < n_points; k += stride)
        some_places.push_back(panel.places[k]);
    magnitude.evaluate(some_places, t, some_values);
    const double rounding = negligible * largest_of(some_values);
    values.assign(n_points * panels.size(), 0.);
    is_active.assign(panels.size(), 0);
    for (std::size_t p = 0; p < panels.size(); ++p)
      for (unsigned int k = 0; k < n_probes; ++k)
      {
        const double value = some_values[n_probes * p + k];
        values[n_points * p + stride * k] = value;
        for (std::size_t q = p - (p > 0);
             std::fabs(value) > rounding && q < panels.size() && q <= p + 1; ++q)
          is_active[q] = 1;
      }
    some_places.clear();
    for (std::size_t p = 0; p < panels.size(); ++p)
      for (unsigned int k = 0; k < n_points; ++k)
        if (!is_active[p])
          values[n_points * p + k] = 0.;
        else if (k % stride != 0)
          some_places.push_back(panels[p].places[k]);
    magnitude.evaluate(some_places, t, some_values);
    std::size_t next = 0;
    for (std::size_t p = 0; p < panels.size(); ++p)
      for (unsigned int k = 0; k < n_points && is_active[p]; ++k)
        if (k % stride != 0)
          values[n_points * p + k] = some_values[next++];
  }

  /// Sets the values at t; whether the series of all panels end.
  bool SmoothLoad::look(const double t) const
  {
    set_values(t);
    const double bound = tolerance * scale(largest_of(values));
    for (std::size_t p = 0; p < panels.size(); ++p)
    {
      double last = 0.;
      for (const std::array<double, n> &row : points().last)
      {
        double coefficient = 0.;
        for (unsigned int k = 0; k < n_points; ++k)
          coefficient += row[k] * values[n_points * p + k];
        last += std::fabs(coefficient);
      }
      if (!(last <= bound))
        return false;
    }
    return true;
  }

  /// Whether nothing at t is narrower than the panels see.
  bool SmoothLoad::is_seen(const double t) const
  {
    try
    {
      look(t);
      magnitude.evaluate(check_places, t, checks);
    }
    catch (const UserError &)
    {
      return true; // no run comes to this time, or it says so
    }
    const double bound = detail * scale(std::max(largest_of(values), largest_of(checks)));
    std::size_t c = 0;
    for (std::size_t p = 0; p < panels.size(); ++p)
    {
      const Panel &panel = panels[p];
      const double middle = .5 * (panel.places.front() + panel.places.back()),
                   half = (panel.places.back() - middle) / points().x.back();
      for (std::size_t e = 0; e < n_checks * (panel.end - panel.begin); ++e, ++c)
      {
        const std::array<double, n> at = points().shapes((check_places[c] - middle) / half);
        double value = 0.;
        for (unsigned int k = 0; k < n_points; ++k)
          value += at[k] * values[n_points * p + k];
        if (!(std::fabs(value - checks[c]) <= bound))
          return false;
      }
    }
    return true;
  }

  bool SmoothLoad::apply(const double t, std::vector<double> &P) const
  {
    if (panels.empty())
      return false;
    const long now = static_cast<long>(std::floor(t * looks_per_second));
    if (now != quarter)
    {
      const bool follows = now == quarter + 1 && next_is_seen.has_value();
      quarter_is_seen = follows ? *next_is_seen : is_seen(now / looks_per_second);
      next_is_seen = is_seen((now + 1.) / looks_per_second);
      quarter_is_seen = quarter_is_seen && *next_is_seen;
      quarter = now;
    }
    if (!quarter_is_seen || !look(t))
      return false;
    for (std::size_t p = 0; p < panels.size(); ++p)
    {
      if (!is_active[p])
        continue;
      const double *const q = values.data() + n_points * p;
      const std::size_t n_dofs = panels[p].forces.size() / n_points;
      double *const to = P.data() + panels[p].first_dof;
      const double *from = panels[p].forces.data();
      for (unsigned int k = 0; k < n_points; ++k, from += n_dofs)
        for (std::size_t i = 0; i < n_dofs; ++i)
          to[i] += q[k] * from[i];
    }
    return true;
  }
} // namespace taut
