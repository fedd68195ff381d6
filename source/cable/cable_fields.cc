// SPDX-License-Identifier: LGPL-2.1-or-later
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
  } // namespace

  void Cable::write_vtu(const std::string &path, const std::vector<double> &U) const
  {
    constexpr unsigned int pieces = 4; ///< of an element
    const std::vector<double> q = positions(U);
    double largest = 0.;
    for (std::size_t i = 0; i < q.size(); ++i)
      largest = std::max(largest, std::fabs(q[i] - found.positions[i]));
    // Of a cable that is linear T0 + EA t . u', t the tangent of its K's positions: linear in U as
    // its forces are, by differences so that it is taken at the points of the integral, too.
    const double part = small_strain * std::min(1., element.element_length()) / largest;
    std::vector<double> before = tangent_at, after = tangent_at;
    if (is_linear() && largest > 0.)
      for (std::size_t i = 0; i < q.size(); ++i)
      {
        before[i] -= part * (q[i] - found.positions[i]);
        after[i] += part * (q[i] - found.positions[i]);
      }
    const auto tension = [&](const double s)
    {
      if (!is_linear())
        return element.tension(q, s);
      const double change = element.tension(after, s) - element.tension(before, s);
      return element.tension(found.positions, s) + (largest > 0. ? change / (2. * part) : 0.);
    };
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
