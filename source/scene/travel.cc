// SPDX-License-Identifier: LGPL-2.1-or-later
#include "scene/travel.h"
#include "base/text.h"
#include <taut/base/exceptions.h>
#include <taut/scene/scene.h>

#include <boost/math/quadrature/gauss.hpp>

#include <algorithm>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace taut
{
  namespace
  {
    /// The speed is a formula of t. Its way is stored at the ends of cells in which seven points of
    /// Gauss integrate the speed exactly but for rounding.
    class FormulaTravel : public Travel, public std::enable_shared_from_this<FormulaTravel>
    {
    public:
      /// Prepared up to @p end [s]; 0: nothing is stored.
      FormulaTravel(Expression speeds, const double units, const double end = 0.)
          : speeds(std::move(speeds)), units(units)
      {
        cells.push_back({0., 0.});
        if (!(end > 0.))
          return;
        double size = 0.;
        for (std::size_t i = 0; i < n_begin; ++i)
          size += std::fabs(integral(end * i / n_begin, end * (i + 1) / n_begin));
        const double tolerance = exactness * size;
        for (std::size_t i = 0; i < n_begin; ++i)
        {
          const double a = end * i / n_begin, b = end * (i + 1) / n_begin;
          add_cells(a, b, integral(a, b), tolerance, most_halvings, has_details(a, b, tolerance));
        }
        find_range();
      }

      double way(const double t) const override
      {
        // Behind the last cell, and before t = 0, the integral is made of halves again.
        const Cell &cell = cell_of(t);
        const bool is_stored = t >= 0. && t <= cells.back().time;
        return cell.way + (is_stored ? integral(cell.time, t) : outside(cell.time, t));
      }

      double speed(const double t) const override { return speeds(0., t) / units; }

      std::string text() const override { return in_metres_per_second(speeds.content()); }
      std::string formula() const override { return in_metres_per_second(speeds.formula()); }

      std::shared_ptr<const Travel> until(const double end) const override
      {
        if (end == cells.back().time)
          return shared_from_this();
        return std::make_shared<FormulaTravel>(speeds, units, end);
      }

      TravelRange range() const override { return reached; }

    private:
      static constexpr std::size_t n_begin = 256; ///< of the first, equal cells
      static constexpr unsigned int most_halvings = 40;
      static constexpr std::size_t n_looks = 16; ///< parts in which each is looked at
      static constexpr double exactness = 1e-14; ///< of a cell, over the whole way
      static constexpr int n_samples = 8;        ///< of the speed in a cell

      /// From its time on, up to the next one.
      struct Cell
      {
        double time, way; ///< [s, m]
      };

      std::string in_metres_per_second(const std::string &speed) const
      {
        return units == 1. ? speed : to_text("(", speed, ")/", units);
      }

      double integral(const double a, const double b) const
      {
        if (a == b)
          return 0.;
        return boost::math::quadrature::gauss<double, 7>::integrate(
            [this](const double t) { return speed(t); }, a, b);
      }

      /// Whether the parts of a cell show more than the whole: a pulse down to a ten-thousandth of
      /// the way's time meets a point of one of them.
      bool has_details(const double a, const double b, const double tolerance) const
      {
        double sum = 0.;
        for (std::size_t i = 0; i < n_looks; ++i)
          sum += integral(a + (b - a) * i / n_looks, a + (b - a) * (i + 1) / n_looks);
        return std::fabs(sum - integral(a, b)) > tolerance;
      }

      /// Whether the speed jumps between an end and the first point of Gauss: its change there is
      /// more than that up to the second point, which is four times as far away.
      bool jumps_at(const double end, const double length) const
      {
        constexpr double first = .0254, second = .1292, same = 1e-9;
        const double there = speed(end), near = speed(end + first * length),
                     far = speed(end + second * length);
        return std::fabs(there - near) > 3. * std::fabs(far - near) + same * std::fabs(near);
      }

      /// @p has_details: the parts that are looked at become cells, at least.
      void add_cells(const double a, const double b, const double whole, const double tolerance,
                     const unsigned int halvings, const bool has_details)
      {
        const double middle = .5 * (a + b), first = integral(a, middle), last = integral(middle, b);
        const bool is_large =
            has_details && ((std::size_t(1) << (most_halvings - halvings)) < n_looks ||
                            jumps_at(a, b - a) || jumps_at(b, a - b));
        if ((!is_large && std::fabs(first + last - whole) <= tolerance) || halvings == 0)
        {
          cells.push_back({b, cells.back().way + (first + last)});
          return;
        }
        add_cells(a, middle, first, tolerance, halvings - 1, has_details);
        add_cells(middle, b, last, tolerance, halvings - 1, has_details);
      }

      double outside(const double a, const double b) const
      {
        const double whole = integral(a, b);
        return refined(a, b, whole, exactness * (std::fabs(whole) + std::fabs(cells.back().way)),
                       most_halvings);
      }

      double refined(const double a, const double b, const double whole, const double tolerance,
                     const unsigned int halvings) const
      {
        const double middle = .5 * (a + b), first = integral(a, middle), last = integral(middle, b);
        if (std::fabs(first + last - whole) <= tolerance || halvings == 0)
          return first + last;
        return refined(a, middle, first, tolerance, halvings - 1) +
               refined(middle, b, last, tolerance, halvings - 1);
      }

      /// The first cells are equally long, those inside of one differ little in number: the search
      /// is a few steps.
      const Cell &cell_of(const double t) const
      {
        const auto next =
            std::upper_bound(cells.begin(), cells.end(), t,
                             [](const double at, const Cell &c) { return at < c.time; });
        return next == cells.begin() ? *next : *(next - 1);
      }

      void find_range()
      {
        for (std::size_t i = 0; i + 1 < cells.size(); ++i)
        {
          const double a = cells[i].time, step = (cells[i + 1].time - a) / n_samples;
          double before = speed(a);
          for (int j = 1; j <= n_samples; ++j)
          {
            const double t = j < n_samples ? a + j * step : cells[i + 1].time, now = speed(t);
            reached.fastest = std::max({reached.fastest, std::fabs(before), std::fabs(now)});
            if (before * now < 0.)
              take(way(turn(t - step, t)));
            before = now;
          }
          take(cells[i + 1].way);
        }
      }

      void take(const double value)
      {
        reached.least = std::min(reached.least, value);
        reached.greatest = std::max(reached.greatest, value);
      }

      /// Where the speed changes its sign.
      double turn(double a, double b) const
      {
        const double sign = speed(a);
        for (unsigned int i = 0; i < 60; ++i)
        {
          const double middle = .5 * (a + b);
          (speed(middle) * sign > 0. ? a : b) = middle;
        }
        return a;
      }

      const Expression speeds;
      const double units; ///< that are 1 m/s
      std::vector<Cell> cells;
      TravelRange reached;
    };

    /// Between two times, of which only the second is behind the way.
    double cross(const Travel &travel, double before, double behind, const double way,
                 const double sign)
    {
      for (int i = 0; i < 80; ++i)
      {
        const double middle = .5 * (before + behind);
        (sign * (travel.way(middle) - way) < 0. ? before : behind) = middle;
      }
      return behind;
    }
  } // namespace

  namespace
  {
    bool has_speed(const Travel &travel, const double t)
    {
      try
      {
        travel.speed(t);
        return true;
      }
      catch (const EntryError &)
      {
        return false;
      }
    }

    /// The last time up to which there is a speed, between one with and one without.
    double last_speed(const Travel &travel, double with, double without)
    {
      for (int i = 0; i < 60; ++i)
      {
        const double middle = .5 * (with + without);
        (has_speed(travel, middle) ? with : without) = middle;
      }
      return with;
    }
  } // namespace

  Speed parse_speed(const std::string &text, const std::string &entry, const double units)
  {
    const Expression formula(text, entry, Expression::Variables::time);
    if (formula.depends_on_time())
      return {0., std::make_shared<FormulaTravel>(formula, units)};
    return {formula(0., 0.) / units, nullptr};
  }

  void prepare_travels(Scene &scene, const double end)
  {
    std::map<std::shared_ptr<const Travel>, std::shared_ptr<const Travel>> prepared;
    const auto prepare = [&](std::shared_ptr<const Travel> &travel)
    {
      if (!travel)
        return;
      std::shared_ptr<const Travel> &known = prepared[travel];
      if (!known)
        known = travel->until(end);
      travel = known;
    };
    for (Link &link : scene.links)
      prepare(link.travel);
    for (Load &load : scene.loads)
      prepare(load.travel);
    for (Mass &mass : scene.masses)
      prepare(mass.travel);
  }

  double time_of_way(const Speed &speed, const double way, const double latest)
  {
    constexpr double never = std::numeric_limits<double>::infinity();
    if (way == 0.)
      return 0.;
    if (!speed.travel)
      return way / speed.constant > 0. && way / speed.constant <= latest ? way / speed.constant
                                                                         : never;
    const double sign = way > 0. ? 1. : -1.;
    constexpr int n_parts = 1024;
    double end = 0.;
    for (double next = std::min(1., latest); end < latest; next = std::min(2. * next, latest))
    {
      const bool is_last = !has_speed(*speed.travel, next);
      if (is_last)
        next = last_speed(*speed.travel, end, next);
      const auto travel = speed.travel->until(next);
      for (int i = 1; i <= n_parts; ++i)
      {
        const double t = end + (next - end) * i / n_parts;
        if (sign * (travel->way(t) - way) >= 0.)
          return cross(*travel, end + (next - end) * (i - 1) / n_parts, t, way, sign);
      }
      end = next;
      if (is_last)
        speed.travel->speed(2. * end + 1.); // says what ends there
    }
    return never;
  }
} // namespace taut
