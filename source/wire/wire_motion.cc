// SPDX-License-Identifier: LGPL-2.1-or-later The motion of a wire: displacement at a point, initial
// state, rigid body modes.
#include "wire/wire_discretisation.h"

#include "base/text.h"
#include "wire/hermite_shape.h"
#include <taut/base/exceptions.h>

#include <algorithm>
#include <cmath>

namespace taut
{
  std::string WireComponent::uneven_elements() const
  {
    std::size_t shortest = 0;
    double longest = 0.;
    const auto length = [&](const std::size_t e) { return nodes[e + 1] - nodes[e]; };
    for (std::size_t e = 0; e + 1 < nodes.size(); ++e)
    {
      shortest = length(e) < length(shortest) ? e : shortest;
      longest = std::max(longest, length(e));
    }
    constexpr double uneven = 20.;
    if (!(longest > uneven * length(shortest)))
      return "";
    return to_text(std::setprecision(10), "its element from ", nodes[shortest], " to ",
                   nodes[shortest + 1], " m is ", std::setprecision(3), length(shortest),
                   " m long beside others of ", longest,
                   " m. Move what stands at its two ends to one place, or farther apart");
  }

  void WireComponent::evaluate(const double s, const bool slope, LinearForm &result) const
  {
    const auto after = std::upper_bound(nodes.begin(), nodes.end(), s);
    const auto e = std::min<std::ptrdiff_t>(std::max<std::ptrdiff_t>(after - nodes.begin() - 1, 0),
                                            nodes.size() - 2);
    const double h = nodes[e + 1] - nodes[e], xi = (s - nodes[e]) / h;
    const std::size_t n_entries = beam ? 4 : degree + 1;
    result.index.clear();
    result.value.clear();
    result.index.reserve(n_entries);
    result.value.reserve(n_entries);
    if (beam)
    {
      const HermiteShape shape = hermite_shape(h, xi);
      for (unsigned int i = 0; i < 4; ++i)
        result.add(2 * e + i, slope ? shape.slope[i] : shape.value[i]);
      return;
    }
    // Element order of deal.II: both vertices, then the inner points.
    const auto &element = *discretisation->element;
    for (unsigned int i = 0; i <= degree; ++i)
    {
      const unsigned int dof = i == 0 ? degree * e : i == 1 ? degree * (e + 1) : degree * e + i - 1;
      const dealii::Point<1> x(xi);
      result.add(dof, slope ? element.shape_grad(i, x)[0] / h : element.shape_value(i, x));
    }
  }

  void WireComponent::value_at(const double s, LinearForm &result) const
  {
    evaluate(s, false, result);
  }

  void WireComponent::slope_at(const double s, LinearForm &result) const
  {
    evaluate(s, true, result);
  }

  LinearForm WireComponent::displacement(const Coordinates &place,
                                         const Coordinates &direction) const
  {
    if (!(place[0] >= nodes.front()) || !(place[0] <= nodes.back()))
      throw UserError("body '" + name() + "' ends at " + std::to_string(nodes.back()) +
                      " m, and a constraint is to act at " + std::to_string(place[0]) + " m");
    LinearForm form;
    value_at(place[0], form);
    for (double &value : form.value)
      value *= component(direction, false);
    return form;
  }

  void WireComponent::interpolate(const Expression &f, std::vector<double> &U) const
  {
    U.assign(n_dofs(), 0.);
    if (f.is_zero())
      return;
    const double delta = 1e-5 * wire_length;
    for (std::size_t i = 0; i < nodes.size(); ++i)
    {
      const double s = nodes[i];
      U[dofs_per_node * i] = f(s, 0.);
      if (beam)
      {
        // The slope from a central difference inside the wire: second order in 1e-5 of the length.
        const double left = std::max(0., s - delta), right = std::min(wire_length, s + delta);
        U[2 * i + 1] = (f(right, 0.) - f(left, 0.)) / (right - left);
        if (left == 0. && s == 0.)
          U[2 * i + 1] = (-3. * f(0., 0.) + 4. * f(delta, 0.) - f(2. * delta, 0.)) / (2. * delta);
        if (right == wire_length && s == wire_length)
          U[2 * i + 1] =
              (3. * f(s, 0.) - 4. * f(s - delta, 0.) + f(s - 2. * delta, 0.)) / (2. * delta);
      }
      else if (i + 1 < nodes.size())
        for (unsigned int k = 1; k < degree; ++k)
        {
          const double xi = discretisation->element->unit_support_point(k + 1)[0];
          U[degree * i + k] = f(s + xi * (nodes[i + 1] - s), 0.);
        }
    }
  }

  void WireComponent::initial_state(std::vector<double> &U, std::vector<double> &V) const
  {
    interpolate(start.displacement, U);
    interpolate(start.velocity, V);
  }

  Substructure::NullSpace WireComponent::null_space() const
  {
    // Rigid body modes q0 + q1 (s - middle)/(L/2), with q1 only for a beam without tension. Each
    // DoF that supports hold is one condition on (q0, q1).
    if (is_bedded)
      return {};
    const double half = .5 * (nodes.back() - nodes.front()), middle = nodes.front() + half;
    const unsigned int n_rigid = bends_freely ? 2 : 1;
    std::vector<std::pair<double, double>> conditions;
    const auto hold = [&](const unsigned int dof)
    {
      const double s = nodes[dof / dofs_per_node];
      if (beam && dof % 2 == 1)
        conditions.emplace_back(0., 1.);
      else
        conditions.emplace_back(1., (s - middle) / half);
    };
    for (const ConstrainedDof &constraint : constrained)
      if (constraint.dof < discretisation->dof_handler.n_dofs())
        hold(constraint.dof);
    for (const unsigned int dof : sprung_dofs)
      hold(dof);

    NullSpace null_space;
    const unsigned int last = dofs_per_node * (nodes.size() - 1);
    const auto add = [&](const double q0, const double q1, const unsigned int dof)
    {
      std::vector<double> R(n_dofs(), 0.);
      for (std::size_t i = 0; i < nodes.size(); ++i)
      {
        R[dofs_per_node * i] = q0 + q1 * (nodes[i] - middle) / half;
        if (beam)
          R[2 * i + 1] = q1 / half;
        else if (i + 1 < nodes.size())
          for (unsigned int k = 1; k < degree; ++k)
            R[degree * i + k] = q0;
      }
      null_space.vectors.push_back(std::move(R));
      null_space.fixing_dofs.push_back(dof);
    };

    if (n_rigid == 1)
    {
      const bool held = std::any_of(conditions.begin(), conditions.end(),
                                    [](const auto &c) { return c.first != 0.; });
      if (!held)
        add(1., 0., 0);
      return null_space;
    }
    if (conditions.empty())
    {
      add(.5, -.5, 0);
      add(.5, .5, last);
      return null_space;
    }
    // One independent condition leaves the orthogonal motion; a second independent condition leaves
    // no motion.
    const auto [c0, c1] = conditions.front();
    const bool held =
        std::any_of(conditions.begin(), conditions.end(),
                    [&](const auto &c) { return std::fabs(c0 * c.second - c1 * c.first) > 1e-12; });
    if (!held)
      add(-c1, c0, std::fabs(-c1 - c0) > std::fabs(-c1 + c0) ? 0 : last);
    return null_space;
  }
} // namespace taut
