// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_travelling_load_h
#define taut_travelling_load_h

#include "wire/element_load.h"
#include "wire/travelling_shape.h"

#include <cmath>
#include <vector>

namespace taut
{
  /// A force per length that is a product of shapes, which travel each on a way of its own, and of
  /// a function of time. An element takes its integrals from the polynomials of the shapes.
  class TravellingLoad
  {
  public:
    /// As TravellingShape.
    TravellingLoad(const Expression::Separated::Travelling &product, double wire_length,
                   double begin, double end, double element_length);

    /// The load of elements one after the other along the wire, at one time.
    class Walk;

  private:
    std::vector<TravellingShape> shapes;
    Expression of_time;
  };

  class TravellingLoad::Walk
  {
  public:
    /// At the time t [s].
    Walk(const TravellingLoad &load, double t);

    /// The load of the next element, with its values; its size is 0 where these are. False if a
    /// shape is not known there. A load that one place alone sees is not resolved.
    bool on(const LoadedElement &element, ElementLoad &load)
    {
      const double s0 = element.begin, s1 = s0 + element.length;
      load.size = 0.;
      load.is_resolved = true;
      if (s1 <= end_of_zero)
        return true;
      for (const TravellingShape::Walk &walk : walks)
        if (!walk.covers(s0, s1) || walk.is_zero() || walk.is_narrow(s0, s1))
          return on_pieces(element, load);
      evaluate(element, load);
      return true;
    }

  private:
    void evaluate(const LoadedElement &element, ElementLoad &load) const
    {
      load.values.fill(amplitude);
      for (const TravellingShape::Walk &walk : walks)
        for (unsigned int q = 0; q < ElementLoad::n_points; ++q)
          load.values[q] *= walk(element.places[q]);
      for (const double value : load.values)
        load.size += std::fabs(value) / ElementLoad::n_points;
    }

    bool on_pieces(const LoadedElement &element, ElementLoad &load);
    double value(double s) const;
    void integrate(const LoadedElement &element, ElementLoad &load);

    std::vector<TravellingShape::Walk> walks;
    double amplitude,
        end_of_zero = 0.; ///< up to where the load is zero from the last element on [m]
  };
} // namespace taut

#endif
