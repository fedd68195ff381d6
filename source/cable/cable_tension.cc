// SPDX-License-Identifier: LGPL-2.1-or-later
#include "text_of.h"

#include <taut/base/exceptions.h>
#include <taut/cable/cable.h>
#include <taut/substructure/line_fields.h>

#include <algorithm>
#include <cmath>

namespace taut
{
  namespace
  {
    /// Strain of the differences that make the linear tension, whose relative error is its square.
    constexpr double small_strain = 1e-4;

    constexpr unsigned int pieces = 4; ///< of an element, in pictures and of a linear tension
  }                                    // namespace

  /// Over the unstressed arc length. Of a cable that is linear T0 + EA t . u', t the tangent of
  /// the positions of its K and u from where the tension is T0: linear in U as its forces are, by
  /// differences so that it is taken at the points of the integral, too. @p q is kept by reference.
  std::function<double(double)> Cable::tension_at(const std::vector<double> &q) const
  {
    const std::vector<double> &from = linear_from();
    double largest = 0.;
    for (std::size_t i = 0; i < q.size(); ++i)
      largest = std::max(largest, std::fabs(q[i] - from[i]));
    if (!is_linear() || largest == 0.)
      return [&](const double s) { return element.tension(q, s); };
    const double part = small_strain * std::min(1., element.element_length()) / largest;
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

  void Cable::check_strain(const std::vector<double> &U) const
  {
    const std::vector<double> q = positions(U);
    double strain = 0.;
    if (is_linear())
    {
      const auto tension = tension_at(q);
      const double piece = element.element_length() / pieces;
      for (unsigned int k = 0; k <= pieces * element.n_elements(); ++k)
        strain = std::max(strain, tension(std::min(k * piece, data.length)));
      strain /= data.section.axial_stiffness;
    }
    else
      strain = element.largest_strain(q);
    if (!(strain <= data.largest_strain))
      throw EntryError(origin().empty() ? "Largest strain" : origin() + "/Largest strain",
                       "at rest the cable is stretched by " + text_of(strain) + ", more than " +
                           text_of(data.largest_strain) +
                           "; make it longer or stiffer, or allow more");
  }

  void Cable::write_vtu(const std::string &path, const std::vector<double> &U) const
  {
    const std::vector<double> q = positions(U);
    const auto tension = tension_at(q);
    std::vector<std::vector<LinePoint>> lines(element.n_elements());
    for (unsigned int e = 0; e < lines.size(); ++e)
      for (unsigned int k = 0; k <= pieces; ++k)
      {
        const double s = std::min(element.element_length() * (e + double(k) / pieces), data.length);
        const Coordinates r = element.position(q, s);
        lines[e].push_back({add_scaled(data.from, 1., r),
                            r - element.position(found.positions, s),
                            {s, tension(s)}});
      }
    write_lines(path, lines, {"unstressed_arc_length", "tension"});
  }
} // namespace taut
