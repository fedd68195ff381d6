// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/text.h"
#include <taut/output/statistics.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <ostream>

namespace taut
{
  namespace
  {
    bool is_inside(const double value, const std::vector<double> &range)
    {
      return value >= range[0] && value <= range[1];
    }

    std::string fixed(const double value)
    {
      return to_text(std::fixed, std::setprecision(2), value);
    }

    /// With two decimals, or with three digits in a table of small numbers, which are at most
    /// @p largest. A table of rounding errors has two decimals, too.
    std::string shown(const double value, const double largest)
    {
      constexpr double least_fixed = .1, rounding = 1e-9;
      return largest > rounding && largest < least_fixed ? to_text(std::setprecision(3), value)
                                                         : fixed(value);
    }

    /// A time with four decimals, or with three digits if it is short.
    std::string duration(const double seconds)
    {
      constexpr double least_fixed = 1e-3;
      return seconds < least_fixed ? to_text(std::setprecision(3), seconds)
                                   : to_text(std::fixed, std::setprecision(4), seconds);
    }

    double size_of(const std::vector<double> &numbers)
    {
      double size = 0.;
      for (const double number : numbers)
        size = std::max(size, std::fabs(number));
      return size;
    }

    /// Of the forces of a table.
    double size_of(const ContactQuantities &f)
    {
      return size_of(std::vector<double>{f.raw.maximum, f.raw.minimum});
    }

    /// "   expected 1.00 to 2.00   inside"; empty without a range.
    std::string comparison(const double value, const std::vector<double> &range, const bool judged,
                           const double largest)
    {
      if (range.empty())
        return "";
      const std::string low = shown(range[0], largest), high = shown(range[1], largest),
                        bounds = !std::isfinite(range[0])   ? "at most " + high
                                 : !std::isfinite(range[1]) ? "at least " + low
                                                            : low + " to " + high;
      return "   expected " + bounds + "   " +
             (!judged                   ? "not judged"
              : is_inside(value, range) ? "inside"
                                        : "OUTSIDE");
    }
  } // namespace

  Statistics::Verdict Statistics::verdict() const
  {
    Verdict result;
    const auto judge = [&](const std::vector<Figure> &figures)
    {
      for (const Figure &figure : figures)
        if (!figure.expected.empty())
          ++(is_inside(figure.shown(), figure.expected) ? result.n_inside : result.n_outside);
    };
    for (const Contact &contact : contacts)
    {
      const ContactQuantities f = measure(contact);
      const std::vector<Figure> rows = figures_of(f, true);
      const bool expected = std::any_of(rows.begin(), rows.end(),
                                        [](const Figure &r) { return !r.expected.empty(); });
      if (f.are_judged())
        judge(rows);
      if (expected && !(f.are_judged() && f.is_complete))
        result.is_complete = false;
    }
    for (const ProbeQuantities &probe : probes)
      judge(figures_of(probe));
    return result;
  }

  std::string Statistics::Verdict::text() const
  {
    return n_outside > 0  ? "outside"
           : !is_complete ? "incomplete"
           : n_inside > 0 ? "inside"
                          : "none";
  }

  std::string Statistics::window_text(const ContactQuantities &f) const
  {
    if (parameters.window.size() < 2)
      return "";
    const double size = size_of(parameters.window);
    const auto from_to = [&](const double from, const double to)
    { return shown(from, size) + " to " + shown(to, size) + " m"; };
    const std::string whole = from_to(parameters.window[0], parameters.window[1]);
    if (f.is_complete)
      return ", " + whole;
    if (f.n_samples == 0)
      return ", nothing of the window " + whole;
    return ", " + from_to(f.begin, f.end) + " of the window " + whole;
  }

  void Statistics::print_head(const std::string &of, const ContactQuantities &f,
                              std::ostream &out) const
  {
    out << "Contact force of " << of << window_text(f) << " (" << f.n_samples << " samples, ";
    if (f.is_filtered)
      out << "low-passed; unfiltered beside it)\n";
    else if (f.longest_step == 0.)
      out << "not filtered)\n";
    else
      out << "not filtered, and not judged: a filter at " << to_text(parameters.filter_frequency)
          << " Hz needs steps shorter than " << to_text(f.longest_step) << " s)\n";
    if (f.n_samples == 0)
      out << "  no sample in the window\n";
  }

  void Statistics::print_rows(const std::vector<Figure> &rows, const double size, const bool judged,
                              std::ostream &out)
  {
    for (const Figure &row : rows)
    {
      if (std::isnan(row.value) || (row.value == 0. && !row.shown_if_zero))
        continue;
      const double own_size = row.unit == "N" ? size : row.unit == "m" ? row.shown() : 1.;
      out << "  " << std::left << std::setw(36) << capitalised(row.name) << std::right
          << std::setw(10) << shown(row.shown(), own_size) << ' ' << std::left << std::setw(3)
          << (row.unit == "1" ? "" : row.unit_shown()) << std::right << std::setw(12)
          << (std::isnan(row.raw) ? "" : shown(row.raw, own_size))
          << comparison(row.shown(), row.expected, judged, own_size) << '\n';
    }
  }

  void Statistics::print_contact(const Contact &contact, std::ostream &out) const
  {
    const ContactQuantities f = measure(contact);
    print_head("'" + contact.of.name + "'", f, out);
    if (f.n_samples == 0)
      return;
    print_rows(figures_of(f, true), size_of(f), f.are_judged(), out);
    if (const std::string source = parameters.source_of_largest_mean(); !source.empty())
      out << "  Largest mean at this speed, " << parameters.supply << ": " << source << '\n';
    print_rows(details_of(contact), size_of(f), false, out);
    if (contact.of.is_strip)
      print_shares(contact, size_of(f), out);
  }

  void Statistics::print_shares(const Contact &contact, const double size, std::ostream &out) const
  {
    out << "  Sum over its wires, unfiltered: mean, maximum, time without this wire\n";
    for (std::size_t i = 0; i < contact.wires.size(); ++i)
    {
      const ContactQuantities f = measure(contact, contact.wires[i]);
      out << "    " << std::left << std::setw(34) << contact.of.names[i] << std::right
          << std::setw(10) << shown(f.raw.mean, size) << std::setw(10) << shown(f.raw.maximum, size)
          << " N  " << std::setw(8) << 100. * f.loss << " %\n";
    }
  }

  void Statistics::print_sum(const ContactSum &sum, std::ostream &out) const
  {
    const ContactQuantities f = measure(sum);
    std::string of = "'" + sum.name + "', the sum of";
    for (std::size_t i = 0; i < sum.of.size(); ++i)
      of += (i > 0 ? " + '" : " '") + sum.of[i] + "'";
    print_head(of, f, out);
    if (f.n_samples > 0)
      print_rows(figures_of(f, false), size_of(f), false, out);
  }

  void Statistics::print_links(std::ostream &out) const
  {
    std::size_t n_unilateral = 0, n_opened = 0;
    const LinkQuantities *longest = nullptr;
    for (const LinkQuantities &link : links)
    {
      n_unilateral += link.unilateral;
      if (!link.unilateral || !(link.open_time > 0.))
        continue;
      ++n_opened;
      if (!longest || link.open_time > longest->open_time)
        longest = &link;
    }
    if (n_unilateral == 0)
      return;
    out << "Unilateral links that opened: " << n_opened << " of " << n_unilateral;
    if (longest)
      out << "; longest '" << longest->name << "', " << duration(longest->open_time) << " s";
    out << '\n';
  }

  void Statistics::report(std::ostream &out, bool) const
  {
    const auto flags = out.flags();
    out << std::fixed << std::setprecision(2);
    for (const Contact &contact : contacts)
      print_contact(contact, out);
    for (const ContactSum &sum : sums)
      print_sum(sum, out);
    const bool has_rates =
        std::any_of(probes.begin(), probes.end(),
                    [](const ProbeQuantities &p) { return p.unit.find('/') != std::string::npos; });
    if (!probes.empty())
      out << (has_rates ? "Probes" : "Displacement of the probes")
          << " along their directions: largest, smallest\n";
    for (const ProbeQuantities &probe : probes)
    {
      const std::vector<Figure> rows = figures_of(probe);
      double size = 0.;
      for (const ProbeQuantities &other : probes)
        for (const Figure &row : figures_of(other))
          if (row.unit == rows[0].unit)
            size = std::max(size, std::fabs(row.shown()));
      out << "  " << std::left << std::setw(36) << probe.name << std::right << std::setw(10)
          << shown(rows[0].shown(), size) << std::setw(10) << shown(rows[1].shown(), size) << ' '
          << std::left << std::setw(4) << rows[0].unit_shown() << std::right;
      if (!rows[0].expected.empty())
        out << "    " << comparison(rows[0].shown(), rows[0].expected, true, size);
      out << '\n';
    }
    print_links(out);
    const Verdict all = verdict();
    if (all.text() != "none")
      out << "Expected ranges: " << all.n_inside << " quantities inside, " << all.n_outside
          << " outside" << (all.is_complete ? "" : "; not all of what they are for was evaluated")
          << '\n';
    if (n_steps > 0)
    {
      out << std::scientific << std::setprecision(1) << "Certificate: complementarity "
          << worst.complementarity << ", balance " << worst.balance << std::fixed
          << std::setprecision(3) << "; " << static_cast<double>(n_iterations) / n_steps
          << " active-set iterations a step, " << n_fallbacks << " fallbacks in " << n_steps
          << " steps\n";
    }
    out.flags(flags);
  }
} // namespace taut
