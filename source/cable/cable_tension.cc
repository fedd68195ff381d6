// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/text.h"
#include "substructure/line_fields.h"
#include <taut/base/exceptions.h>
#include <taut/cable/cable.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace taut
{
  namespace
  {
    /// Strain of the differences that make the linear tension, whose relative error is its square.
    constexpr double least_strain = 1e-4;

    /// Angle [rad] between the middle of the last element and a free end above which the end is a
    /// kink. Tension of the end over the tension of the middle below which the end has no tension.
    /// A cable that hangs from one end is straight at the other end.
    constexpr double kink = .1, no_tension = 1e-3;

    constexpr unsigned int pieces = 4; ///< of an element, in pictures and of a linear tension

    std::string entry_of(const std::string &origin, const std::string &name)
    {
      return origin.empty() ? name : origin + "/" + name;
    }
  } // namespace

  /// The tension over the unstressed arc length. A linear cable has T0 + EA t . u', with the
  /// tangent t of the positions of its K, and the displacement u from the state with tension T0.
  /// This is linear in U like the forces of the cable. It is computed by differences, so that it is
  /// taken at the integration points, too. @p q is kept by reference.
  std::function<double(double)> Cable::tension_at(const std::vector<double> &q) const
  {
    const std::vector<double> &from = linear_from();
    double largest = 0.;
    for (std::size_t i = 0; i < q.size(); ++i)
      largest = std::max(largest, std::fabs(q[i] - from[i]));
    if (!is_linear() || largest == 0.)
      return [&](const double s) { return element.tension(q, s); };
    const double part = least_strain * std::min(1., element.shortest_element()) / largest;
    std::vector<double> before = tangent_at, after = tangent_at;
    for (std::size_t i = 0; i < q.size(); ++i)
    {
      before[i] -= part * (q[i] - from[i]);
      after[i] += part * (q[i] - from[i]);
    }
    return [this, part, before, after, &from](const double s)
    {
      const double change = element.tension(after, s) - element.tension(before, s);
      return element.tension(from, s) + change / (2. * part);
    };
  }

  bool Cable::is_in_tension(const std::vector<double> &U) const
  {
    const std::vector<double> q = positions(U);
    const double rounding = rounding_of_force(0);
    for (unsigned int e = 0; e < element.n_elements(); ++e)
      if (!(element.tension(q, element.place(e + .5)) > rounding))
        return false;
    return element.smallest_strain(q) * data.section.axial_stiffness >= -rounding;
  }

  std::vector<Cable::Section> Cable::sections(const std::vector<double> &U) const
  {
    const std::vector<double> q = positions(U);
    const auto tension = tension_at(q);
    std::vector<Section> result;
    for (std::size_t i = 0; i < n_sections(); ++i)
    {
      const double s = std::min(element.place(.5 * i), data.length);
      result.push_back({add_scaled(data.from, 1., element.position(q, s)), tension(s),
                        data.section.bending_stiffness * element.curvature(q, s)});
    }
    return result;
  }

  void Cable::check_at_rest(const std::vector<double> &U) const
  {
    const std::vector<double> q = positions(U);
    double strain = 0.;
    if (is_linear())
    {
      const auto tension = tension_at(q);
      for (unsigned int k = 0; k <= pieces * element.n_elements(); ++k)
        strain =
            std::max(strain, tension(std::min(element.place(double(k) / pieces), data.length)));
      strain /= data.section.axial_stiffness;
    }
    else
      strain = element.largest_strain(q);
    if (!(strain <= data.largest_strain))
      throw EntryError(entry_of(origin(), "Largest strain"),
                       "at rest the cable is stretched by " + to_text(strain) + ", more than " +
                           to_text(data.largest_strain) +
                           "; make it longer or stiffer, or allow more");
    if (!is_linear() && data.element == CableElement::ancf)
      for (const bool last : {false, true})
        if (!(last ? data.holds_to : data.holds_from))
          check_free_end(q, last);
  }

  /// Without tension and bending stiffness nothing determines the direction of an ANCF element,
  /// nor, by a part of its length, the place of the end.
  void Cable::check_free_end(const std::vector<double> &q, const bool last) const
  {
    const double end = last ? data.length : 0.,
                 middle = element.place(last ? element.n_elements() - .5 : .5),
                 N = element.tension(q, middle);
    const Coordinates a = element.tangent(q, middle), b = element.tangent(q, end);
    if (dot(a, b) >= std::cos(kink) * norm(a) * norm(b) ||
        std::fabs(element.tension(q, end)) > no_tension * N)
      return;
    throw EntryError(entry_of(origin(), "Bending stiffness"),
                     std::string("at rest the free end at ") + (last ? "To" : "From") +
                         " has neither tension nor enough bending stiffness, so that its last "
                         "element bends anyhow; take a little more of it, Element = bar, or a To "
                         "straight below From along weight and wind");
  }

  void Cable::write_vtu(const std::string &path, const std::vector<double> &U) const
  {
    const std::vector<double> q = positions(U);
    const auto tension = tension_at(q);
    std::vector<std::vector<LinePoint>> lines(element.n_elements());
    for (unsigned int e = 0; e < lines.size(); ++e)
      for (unsigned int k = 0; k <= pieces; ++k)
      {
        const double s = std::min(element.place(e + double(k) / pieces), data.length);
        const Coordinates at_rest = element.position(found.positions, s);
        lines[e].push_back({add_scaled(data.from, 1., at_rest),
                            element.position(q, s) - at_rest,
                            {s, tension(s)}});
      }
    write_lines(path, lines, {{"unstressed_arc_length", "m"}, {"tension", "N"}});
  }
} // namespace taut
