// SPDX-License-Identifier: LGPL-2.1-or-later
#include "wire/distributed_load.h"

#include "base/instruction_set.h"
#include "base/text.h"
#include "scene/formula_terms.h"
#include <taut/base/exceptions.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

namespace taut
{
  /// Throws EntryError for stretches of a load that are narrower than the width that the
  /// integration sees anywhere. Stretches at the ends of the piece of the wire may enter or leave,
  /// and are not checked.
  class WireComponent::DistributedLoad::WidthCheck
  {
  public:
    WidthCheck(const DistributedLoad &load, const double t) : load(load), t(t) {}

    void add(const Element &element, const ElementLoad &on)
    {
      if (!on.begins && !was_on)
        finish();
      if (size == 0.)
      {
        first = element.begin;
        is_at_end = on.begins && &element == &load.elements.front();
      }
      size += on.size * element.length;
      largest = std::max(largest, on.largest);
      if (on.is_cubic)
        shortest = std::min(shortest, element.length);
      is_fine |= element.n_pieces > 1;
      last = element.begin + element.length;
      was_on = on.ends;
    }

    /// A stretch ends.
    void finish()
    {
      const double width = largest > 0. ? size / largest : 0.,
                   least = LoadIntegral::seen_at_once * shortest;
      if (!is_at_end && !is_fine && size > 0. && shortest < no_element && width < least)
      {
        throw EntryError(load.origin,
                         to_text(std::setprecision(4), "load '", load.name, "' is ", width,
                                 " m wide between s = ", first, " and ", last, " m at t = ", t,
                                 " s. One that changes with time has to be ", least,
                                 " m wide, a fifth of an element: take a smaller Element size, a "
                                 "wider load, or a load of type 'moving', which acts at a point"));
      }
      size = largest = 0.;
      shortest = no_element;
      is_fine = false;
    }

    /// The piece of the wire ends.
    void end()
    {
      if (!was_on)
        finish();
    }

  private:
    static constexpr double no_element = std::numeric_limits<double>::infinity();

    const DistributedLoad &load;
    double t, size = 0., largest = 0., shortest = no_element, first = 0., last = 0.;
    bool is_at_end = false, is_fine = false, was_on = false;
  };

  WireComponent::DistributedLoad::DistributedLoad(
      const WireComponent &wire, const double factor, const Load &load,
      const Expression::Separated::Travelling *const product)
      : magnitude(load.magnitude), integral(magnitude), name(load.name), origin(load.origin),
        wire_length(wire.wire_length), elements(wire.nodes.size() - 1),
        n_dofs(wire.beam ? 4 : wire.degree + 1), dofs_between(wire.beam ? 2 : wire.degree),
        forces(elements.size() * ElementLoad::n_points * n_dofs)
  {
    const dealii::QGauss<1> rule(ElementLoad::n_points);
    const bool stands = !magnitude.depends_on_time();
    LinearForm shape;
    for (std::size_t e = 0; e < elements.size(); ++e)
    {
      Element &element = elements[e];
      const double h = wire.nodes[e + 1] - wire.nodes[e];
      element.begin = wire.nodes[e];
      element.length = h;
      element.n_pieces = stands && !magnitude.is_constant() ? LoadIntegral::fine_pieces : 1;
      for (unsigned int q = 0; q < rule.size(); ++q)
      {
        element.places[q] = wire.nodes[e] + h * rule.point(q)[0];
        wire.evaluate(element.places[q], load.rotational, shape);
        double *const own = &forces[(e * rule.size() + q) * n_dofs];
        for (std::size_t i = 0; i < shape.index.size(); ++i)
          own[shape.index[i] - e * dofs_between] += shape.value[i] * (factor * h * rule.weight(q));
      }
    }
    if (product)
    {
      const double begin = elements.front().begin,
                   end = elements.back().begin + elements.back().length;
      travelling.emplace(*product, wire_length, begin, end, (end - begin) / elements.size());
    }
    else if (!stands)
    {
      find_standing_details();
      if (is_smooth(magnitude.formula()))
        smooth.emplace(magnitude, elements, forces, n_dofs, dofs_between);
    }
  }

  void WireComponent::DistributedLoad::find_standing_details()
  {
    for (const double t : {0., .0137, .173, 1.31})
      try
      {
        TypicalLoad typical(magnitude, wire_length, t);
        for (Element &element : elements)
        {
          if (element.n_pieces > 1)
            continue;
          const ElementLoad fine = integral.over(element.begin, element.length, element.places, t,
                                                 LoadIntegral::fine_pieces, typical);
          if (!fine.is_resolved)
            break; // the run reports this error if it comes to this time
          if (!fine.is_cubic)
            continue;
          const ElementLoad at_once =
              integral.over(element.begin, element.length, element.places, t, 1, typical);
          if (!at_once.is_cubic || fine.width() < LoadIntegral::seen_at_once)
            element.n_pieces = LoadIntegral::fine_pieces;
        }
      }
      catch (const UserError &)
      {
        // The run may never come to a time at which the formula has no value.
      }
  }

  ElementLoad WireComponent::DistributedLoad::over(const Element &element, const double t,
                                                   TypicalLoad &typical) const
  {
    const ElementLoad result =
        integral.over(element.begin, element.length, element.places, t, element.n_pieces, typical);
    if (result.is_resolved)
      return result;
    throw EntryError(origin,
                     to_text(std::setprecision(4), "load '", name, "' cannot be integrated to ",
                             LoadIntegral::tolerance, " at t = ", t,
                             " s: near s = ", element.begin + element.length * result.narrowest_at,
                             " m it jumps or oscillates within ", element.length * result.narrowest,
                             " m, over and over. Give a load that is smooth between jumps"));
  }

  namespace
  {
    /// With @p n entries for each value.
    inline void add_products(const ElementLoad::Values &values, const double *forces,
                             const unsigned int n, double *const sum)
    {
      for (const double value : values)
        for (unsigned int i = 0; i < n; ++i)
          sum[i] += value * *forces++;
    }
  } // namespace

  void WireComponent::DistributedLoad::add_to(std::vector<double> &P, const std::size_t element,
                                              const ElementLoad::Values &values) const
  {
    const double *const own = &forces[element * ElementLoad::n_points * n_dofs];
    double *const sum = &P[element * dofs_between];
    constexpr unsigned int of_beams = 4; // known to the compiler
    if (n_dofs == of_beams)
      add_products(values, own, of_beams, sum);
    else
      add_products(values, own, n_dofs, sum);
  }

  void WireComponent::DistributedLoad::add_shapes(const double t, std::vector<double> &P) const
  {
    TravellingLoad::Walk walk(*travelling, t);
    TypicalLoad typical(magnitude, wire_length, t);
    vectorised(
        [&]
        {
          ElementLoad on;
          for (std::size_t e = 0; e < elements.size(); ++e)
          {
            if (!walk.on(elements[e], on))
              on = over(elements[e], t, typical);
            if (!on.is_resolved)
              throw EntryError(origin,
                               to_text(std::setprecision(4), "load '", name,
                                       "' is narrower than a hundredth of an element near s = ",
                                       elements[e].begin, " m at t = ", t,
                                       " s: take a smaller Element size, a wider load, or a load "
                                       "of type 'moving', which acts at a point"));
            if (on.size > 0.)
              add_to(P, e, on.values);
          }
        });
  }

  void WireComponent::DistributedLoad::add(const double t, std::vector<double> &P) const
  {
    if (travelling)
      add_shapes(t, P);
    else if (smooth && smooth->covers(t))
    {
      TypicalLoad typical(magnitude, wire_length, t);
      smooth->add(t, P,
                  [&](const std::size_t e) { add_to(P, e, over(elements[e], t, typical).values); });
    }
    else
      add_elements(t, P);
  }

  void WireComponent::DistributedLoad::add_elements(const double t, std::vector<double> &P) const
  {
    WidthCheck check(*this, t);
    TypicalLoad typical(magnitude, wire_length, t);
    for (std::size_t e = 0; e < elements.size(); ++e)
    {
      const ElementLoad on = over(elements[e], t, typical);
      add_to(P, e, on.values);
      if (magnitude.depends_on_time())
        check.add(elements[e], on);
    }
    check.end();
  }

  /// The sum at so many Gauss points, with weights that grow along the wire: the sum of a load that
  /// moves would not change.
  double WireComponent::DistributedLoad::sample_at_places(const double t,
                                                          const std::size_t n_places) const
  {
    constexpr std::size_t n_points = ElementLoad::n_points;
    const std::size_t n_all = n_points * elements.size(), n = std::min(n_places, n_all);
    double sum = 0.;
    for (std::size_t k = 0; k < n; ++k)
    {
      const std::size_t p = (2 * k + 1) * n_all / (2 * n);
      sum += (.4 + static_cast<double>(p) / static_cast<double>(n_all)) *
             magnitude(elements[p / n_points].places[p % n_points], t);
    }
    return sum;
  }
} // namespace taut
