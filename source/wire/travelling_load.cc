// SPDX-License-Identifier: LGPL-2.1-or-later
#include "wire/travelling_load.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace taut
{
  TravellingLoad::TravellingLoad(const Expression::Separated::Travelling &product,
                                 const double wire_length, const double begin, const double end,
                                 const double element_length)
      : of_time(product.of_time)
  {
    for (const Expression::Separated::Shape &shape : product.factors)
      shapes.emplace_back(shape, wire_length, begin, end, element_length);
  }

  TravellingLoad::Walk::Walk(const TravellingLoad &load, const double t)
      : amplitude(load.of_time(0., t))
  {
    walks.reserve(load.shapes.size());
    for (const TravellingShape &shape : load.shapes)
      walks.emplace_back(shape, t);
    if (amplitude == 0.)
      end_of_zero = std::numeric_limits<double>::infinity();
  }

  /// On the pieces of all shapes.
  double TravellingLoad::Walk::value(const double s) const
  {
    double result = amplitude;
    for (const TravellingShape::Walk &walk : walks)
      result *= walk(s);
    return result;
  }

  bool TravellingLoad::Walk::on_pieces(const LoadedElement &element, ElementLoad &load)
  {
    const double s0 = element.begin, s1 = element.begin + element.length;
    bool is_covered = true;
    for (TravellingShape::Walk &walk : walks)
    {
      if (!(s0 >= walk.begin() && s0 < walk.end()) && !walk.go_to(s0))
        return false;
      if (walk.is_zero() && walk.covers(s0, s1) && !walk.is_narrow(s0, s1))
      {
        end_of_zero = walk.end();
        load.is_resolved = true;
        return true;
      }
      load.is_resolved = load.is_resolved && !walk.is_narrow(s0, s1);
      for (; !walk.covers(s0, s1) && walk.end() < s1; is_covered = false)
      {
        if (!walk.advance())
          return false;
        load.is_resolved = load.is_resolved && !walk.is_narrow(s0, s1);
      }
    }
    if (is_covered)
      evaluate(element, load);
    else
      integrate(element, load);
    return true;
  }

  /// Over more than one piece of a shape.
  void TravellingLoad::Walk::integrate(const LoadedElement &element, ElementLoad &load)
  {
    // Exact for moments up to the third of a product of two shapes.
    static const dealii::QGauss<1> rule(TravellingShape::degree + 2);
    const double s0 = element.begin, s1 = element.begin + element.length;
    ElementLoad::Moments moments = {};
    for (TravellingShape::Walk &walk : walks)
      walk.go_to(s0);
    for (double from = s0, to; from < s1; from = to)
    {
      to = s1;
      bool is_zero = false;
      for (TravellingShape::Walk &walk : walks)
      {
        while (walk.end() <= from)
          walk.advance();
        to = std::min(to, walk.end());
        is_zero |= walk.is_zero();
      }
      for (unsigned int q = 0; q < rule.size() && !is_zero; ++q)
      {
        const double s = from + (to - from) * rule.point(q)[0],
                     force = (to - from) / element.length * rule.weight(q) * value(s);
        const ElementLoad::Moments P = ElementLoad::legendre(2. * (s - s0) / element.length - 1.);
        for (unsigned int j = 0; j < P.size(); ++j)
          moments[j] += force * P[j];
        load.size += std::fabs(force);
      }
    }
    if (load.size == 0.)
      return;
    for (unsigned int q = 0; q < ElementLoad::n_points; ++q)
    {
      for (TravellingShape::Walk &walk : walks)
        walk.go_to(element.places[q]);
      load.values[q] = value(element.places[q]);
    }
    load.take_cubic(moments, LoadIntegral::kept * load.size);
  }
} // namespace taut
