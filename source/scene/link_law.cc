// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/text.h"
#include "scene/entries.h"
#include <taut/base/exceptions.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace taut
{
  namespace
  {
    /// A formula up to an elongation, and a straight line with its last slope beyond.
    class FormulaLaw : public ForceLaw
    {
    public:
      FormulaLaw(const std::string &text, const double range, const std::string &entry)
          : formula(text, entry, Expression::Variables::elongation), range(range)
      {
        constexpr double near = 1e-6;
        const double start = formula(0., 0.), end = formula(range, 0.);
        if (!(std::fabs(start) <= rounding * std::fabs(end)))
          fail(entry, "is " + number(start) + " at d = 0, where a spring has no force");
        double last = 0., force = start;
        for (const double part : parts())
        {
          const double u = part * range, next = formula(u, 0.);
          if (!(next > force))
            fail(entry, "does not increase from d = " + number(last) + " to " + number(u) +
                            ", from " + number(force) + " to " + number(next));
          last = u;
          force = next;
        }
        slope_at_end = (end - formula((1. - near) * range, 0.)) / (near * range);
        for (const double part : parts())
          largest_slope = std::max(largest_slope, slope(part * range));
        if (!(slope_at_end > 0.) || !std::isfinite(largest_slope))
          fail(entry, "has no slope at d = " + number(range));
      }

      double largest_stiffness() const override { return largest_slope; }

      std::string description() const override
      {
        return "formula " + formula.content() + " up to " + number(range);
      }

      std::vector<std::pair<std::string, std::string>> entries() const override
      {
        return {{"Law", "formula"},
                {"Law formula", formula.formula()},
                {"Law range", to_text(std::setprecision(17), range)}};
      }

    private:
      static constexpr double rounding = 1e-12;

      static std::string number(const double value)
      {
        return to_text(std::setprecision(15), value);
      }

      [[noreturn]] void fail(const std::string &entry, const std::string &what) const
      {
        throw EntryError(entry, "'" + formula.formula() + "' " + what +
                                    ". Write a formula that is 0 at d = 0 and increases up to Law "
                                    "range; a dead zone is a Gap");
      }

      /// Points of the range at which the formula is checked.
      static std::vector<double> parts()
      {
        constexpr int n_equal = 1000;
        std::vector<double> result;
        for (double part = 1. / n_equal; part > 1e-7; part *= .8)
          result.insert(result.begin(), part);
        for (int i = 2; i <= n_equal; ++i)
          result.push_back(static_cast<double>(i) / n_equal);
        return result;
      }

      double value(const double u) const override
      {
        return u <= range ? formula(u, 0.) : formula(range, 0.) + slope_at_end * (u - range);
      }

      double slope(const double u) const override
      {
        constexpr double part = 1e-5, least = 1e-12;
        const double h = std::max(part * u, least * range), low = std::max(0., u - h);
        return (value(u + h) - value(low)) / (u + h - low);
      }

      double mean(const double a, const double b) const override
      {
        if (a >= range)
          return .5 * (value(a) + value(b));
        constexpr unsigned int most_halvings = 15;
        // Below the rounding of the formula, a part of its force at the range, no halving helps.
        constexpr double exactness = 1e-13, rounding_of_range = 1e-14;
        const double end = std::min(b, range),
                     tolerance = std::max(exactness, rounding_of_range * value(range) / value(end));
        const double inside = boost::math::quadrature::gauss_kronrod<double, 15>::integrate(
            [&](const double part) { return value(a + part * (end - a)); }, 0., 1., most_halvings,
            tolerance);
        return end == b ? inside
                        : (inside * (end - a) + .5 * (value(end) + value(b)) * (b - end)) / (b - a);
      }

      const Expression formula;
      const double range;
      double slope_at_end = 0., largest_slope = 0.;
    };

    double parse_part(const std::string &text, const std::string &entry, const std::string &all)
    {
      std::istringstream in(text);
      double value = 0.;
      if (!(in >> value) || !(in >> std::ws).eof() || !std::isfinite(value))
        throw EntryError(entry, "'" + all + "' is not a point 'elongation: force' of two numbers");
      return value;
    }

    std::vector<std::pair<double, double>> parse_points(const std::string &text,
                                                        const std::string &entry)
    {
      std::vector<std::pair<double, double>> result;
      double elongation = 0., force = 0.;
      std::istringstream in(text);
      for (std::string point; std::getline(in >> std::ws, point, ',');)
      {
        const std::size_t colon = point.find(':');
        if (colon == std::string::npos)
          throw EntryError(entry, "'" + point + "' is not a point 'elongation: force'");
        const double u = parse_part(point.substr(0, colon), entry, point),
                     f = parse_part(point.substr(colon + 1), entry, point);
        if (u == 0. && f == 0. && result.empty())
          continue;
        if (!(u > elongation) || !(f > force))
          throw EntryError(entry, "the point '" + point +
                                      "' is not beyond the one before it, or beyond 0:0: "
                                      "elongations and forces both increase; a dead zone is a Gap");
        result.emplace_back(elongation = u, force = f);
      }
      if (result.empty())
        throw EntryError(entry, "a table has a point beyond 0:0; give 'elongation: force, ...'");
      return result;
    }
  } // namespace

  std::shared_ptr<const ForceLaw> parse_table_law(const std::string &points,
                                                  const std::string &entry)
  {
    return std::make_shared<TableLaw>(parse_points(points, entry));
  }

  std::shared_ptr<const ForceLaw> parse_law(const std::string &kind, const std::string &points,
                                            const std::string &formula, const double range,
                                            const std::string &title)
  {
    if (kind != "table" && !points.empty())
      throw EntryError(title + "/Law points", "they are for 'Law = table'; set it, or remove them");
    if (kind != "formula" && (!formula.empty() || range != 0.))
      throw EntryError(title + (formula.empty() ? "/Law range" : "/Law formula"),
                       "it is for 'Law = formula'; set it, or remove this");
    if (kind == "table")
      return parse_table_law(points, title + "/Law points");
    if (kind != "formula")
      return nullptr;
    if (!(range > 0.))
      throw EntryError(title + "/Law formula",
                       "'" + formula +
                           "' has no range; give Law range, the largest elongation that it is "
                           "meant for");
    return std::make_shared<FormulaLaw>(formula, range, title + "/Law formula");
  }
} // namespace taut
