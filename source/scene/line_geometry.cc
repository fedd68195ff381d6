// SPDX-License-Identifier: LGPL-2.1-or-later
#include "scene/line_geometry.h"

#include "base/csv_table.h"
#include "base/data_files.h"
#include "base/nearest_name.h"
#include "base/patterns.h"
#include "base/text.h"
#include "scene/entries.h"
#include <taut/base/exceptions.h>

#include <math.h> // isnan, which pchip.hpp of Boost 1.74 takes from the global namespace

#include <boost/math/interpolators/pchip.hpp>

#include <deal.II/base/parameter_handler.h>

#include <algorithm>
#include <set>

namespace taut
{
  using namespace dealii::Patterns;

  namespace
  {
    /// Rows of numbers, "5, 10; 5, 10, 15".
    std::vector<std::vector<double>> parse_rows(const std::string &text, const std::string &entry)
    {
      std::vector<std::vector<double>> rows;
      for (const std::string &row : split(text, ';'))
        rows.push_back(parse_positions(row, entry));
      return rows;
    }

    /// Whether lengths are a folder, not lists of numbers. Its name may be a number, too.
    bool is_folder(const std::string &lengths)
    {
      return lengths.find_first_of(",;") == std::string::npos &&
             (lengths.find_first_not_of("0123456789.:+-eE ") != std::string::npos ||
              (!lengths.empty() && has_data_file(lengths + "/droppers.csv")));
    }

    /// One value for all masts, or one for each.
    std::vector<double> at_masts(const std::vector<double> &list, const std::size_t n_masts,
                                 const std::string &entry)
    {
      if (list.size() == n_masts)
        return list;
      if (list.size() == 1)
        return std::vector<double>(n_masts, list[0]);
      throw EntryError(entry, std::to_string(list.size()) + " values for " +
                                  std::to_string(n_masts) +
                                  " masts, of which two are the ends; give one for all, or one for "
                                  "each");
    }

    /// One stagger changes its side from mast to mast.
    std::vector<double> staggers(const std::vector<double> &list, const std::size_t n_masts,
                                 const std::string &entry)
    {
      std::vector<double> result = at_masts(list, n_masts, entry);
      if (list.size() == 1)
        for (std::size_t i = 1; i < n_masts; i += 2)
          result[i] = -result[i];
      return result;
    }

    /// The droppers of a span from begin to end.
    std::vector<LineDropper> droppers_of(const std::vector<double> &positions,
                                         const std::vector<double> &pre_sag,
                                         const std::vector<double> &lengths, const double begin,
                                         const double scale)
    {
      std::vector<LineDropper> droppers;
      for (std::size_t i = 0; i < positions.size(); ++i)
        droppers.push_back({begin + scale * positions[i], pre_sag.empty() ? 0. : pre_sag[i],
                            lengths.empty() ? 0. : lengths[i]});
      return droppers;
    }

    void check_count(const std::vector<double> &list, const std::vector<double> &positions,
                     const std::string &entry, const std::string &where)
    {
      if (!list.empty() && list.size() != positions.size())
        throw EntryError(entry, std::to_string(list.size()) + " values for " +
                                    std::to_string(positions.size()) + " Positions" + where);
    }

    /// A row of a list for each span: the only row, or its own; none, if the list is empty.
    const std::vector<double> &row_of_span(const std::vector<std::vector<double>> &rows,
                                           const std::size_t span)
    {
      static const std::vector<double> none;
      return rows.empty() ? none : rows[rows.size() == 1 ? 0 : span];
    }
  } // namespace

  std::vector<double> LineLayout::heights(const std::vector<double> &x) const
  {
    std::vector<double> at, height;
    for (const LineMast &mast : masts)
    {
      at.push_back(mast.x);
      height.push_back(mast.height);
    }
    std::vector<double> result;
    const bool is_level = std::all_of(height.begin(), height.end(),
                                      [&](const double h) { return h == height.front(); });
    if (is_level)
      return std::vector<double>(x.size(), height.front());
    // The interpolation has four points and more: the line goes on level before and after it.
    for (int i = 0; i < 2; ++i)
    {
      at.insert(at.begin(), at.front() - masts[1].x);
      height.insert(height.begin(), height.front());
    }
    const boost::math::interpolators::pchip<std::vector<double>> curve(std::move(at),
                                                                       std::move(height));
    for (const double place : x)
      result.push_back(curve(place));
    return result;
  }

  void LineGeometry::declare_wires(dealii::ParameterHandler &prm)
  {
    const std::string help =
        "z at the masts, where the wire is held aside. One value: at the first mast; from mast to "
        "mast it changes its sign [m]";
    prm.enter_subsection("Contact wire");
    prm.add_parameter("Stagger", contact_stagger, help, List(Double(), 1));
    prm.leave_subsection();
    prm.enter_subsection("Messenger wire");
    prm.add_parameter("Stagger", messenger_stagger, help, List(Double(), 1));
    prm.leave_subsection();
  }

  void LineGeometry::declare_droppers(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Droppers");
    prm.add_parameter(
        "Positions", positions,
        "In each span, from its first mast: a list for all spans, or one for each with "
        "';' between them [m]",
        Anything());
    prm.add_parameter("Positions are", positions_are,
                      "'absolute': in m; 'relative': parts of the length of their span, 0 to 1",
                      Selection("absolute|relative"));
    prm.add_parameter(
        "Pre-sag", pre_sag,
        "Depth of the contact wire at each dropper below the heights at the masts, in the "
        "static state; a list as Positions; empty: none [m]",
        Anything());
    prm.add_parameter("Lengths", lengths,
                      "Unstressed length of each dropper; a list as Positions; empty: found from "
                      "heights and pre-sag. Of a line as it was built: the folder of the results "
                      "of an earlier run, relative to the parameter file, whose lengths are kept "
                      "[m]",
                      Anything());
    prm.leave_subsection();
  }

  void LineGeometry::declare(dealii::ParameterHandler &prm)
  {
    prm.add_parameter(
        "Line", table,
        "CSV file, relative to the parameter file, with a row for each mast in place of the "
        "entries "
        "of this geometry. Columns: 'span', the length to the next mast (the last has none); and, "
        "if "
        "wanted, 'height', 'encumbrance', 'stagger', 'messenger stagger', 'stitch length', "
        "'mid-point', and of "
        "the droppers of the span, with spaces between them, 'droppers' (positions), 'pre-sag', "
        "'lengths'. Lengths in m",
        Anything());
    prm.add_parameter("Begin", begin, "x of the first mast [m]", Double());
    prm.add_parameter(
        "Offset", offset,
        "z of the wires: those of tension lengths that overlap are beside each other, "
        "and pass [m]",
        Double());
    prm.add_parameter("Number of spans", n_spans, "[1]", Integer(1, 100000));
    prm.add_parameter("Span length", span_length, "[m]", not_negative());
    prm.add_parameter("Span lengths", span_lengths,
                      "Of each span, in place of number and length [m]", List(not_negative(), 0));
    prm.add_parameter("Encumbrance", encumbrances,
                      "Height of the messenger wire over the contact wire at the supports; one for "
                      "all, or at each mast with both ends [m]",
                      List(not_negative(), 1));
    prm.add_parameter(
        "Heights", heights,
        "Of the contact wire; one for all, or at each mast with both ends. Droppers hold "
        "it at a monotone cubic through them [m]",
        List(Double(), 1));
    prm.add_parameter(
        "Stitch lengths", stitch_lengths,
        "Length of the stitch wire; one for all inner masts, or at each mast with both "
        "ends; 0: none [m]",
        List(not_negative(), 1));
    prm.add_parameter(
        "Mid-points", mid_points,
        "Where the line is anchored in its middle: at each mast with both ends, the distance "
        "between the clamps of the two ropes on the contact wire; 0: no mid-point [m]",
        List(not_negative(), 1));
    declare_wires(prm);
    declare_droppers(prm);
  }

  LineLayout LineGeometry::layout(const std::string &section) const
  {
    LineLayout result = table.empty() ? from_lists(section) : from_table(section);
    result.begin = begin;
    result.offset = offset;
    if (is_folder(lengths))
      result.built_in = lengths;
    for (const std::vector<LineDropper> &span : result.spans)
      for (const LineDropper &dropper : span)
        if (!result.built_in.empty() && dropper.length > 0.)
          throw EntryError(section + "/Droppers/Lengths",
                           "'" + table + "' has lengths, too; leave one of both out");
    constexpr double longest = 1e9;
    const std::string entry = section + (!table.empty()         ? "/Line"
                                         : span_lengths.empty() ? "/Span length"
                                                                : "/Span lengths");
    for (std::size_t i = 0; i < result.spans.size(); ++i)
      if (!(result.masts[i + 1].x > result.masts[i].x))
        throw EntryError(entry, "it must be positive");
    if (!(result.length() <= longest))
      throw EntryError(entry, "the line would be " + to_text(result.length()) +
                                  " m long; at most 1e9 m are possible");
    // One value is for the inner masts.
    const auto clear_ends =
        [&](double LineMast::*const value, const std::vector<double> &list, const std::string &name)
    {
      for (LineMast *const end : {&result.masts.front(), &result.masts.back()})
      {
        if (end->*value > 0. && (!table.empty() || list.size() > 1))
          throw EntryError(section + (table.empty() ? name : "/Line"),
                           to_text(end->*value, " m at the end of the line at x = ", begin + end->x,
                                   " m, where there is none; give 0 there"));
        end->*value = 0.;
      }
    };
    clear_ends(&LineMast::stitch_length, stitch_lengths, "/Stitch lengths");
    clear_ends(&LineMast::mid_point, mid_points, "/Mid-points");
    return result;
  }

  LineLayout LineGeometry::from_lists(const std::string &section) const
  {
    LineLayout result;
    const std::size_t n = span_lengths.empty() ? n_spans : span_lengths.size();
    const std::vector<double> encumbrance = at_masts(encumbrances, n + 1, section + "/Encumbrance"),
                              height = at_masts(heights, n + 1, section + "/Heights"),
                              stitch = at_masts(stitch_lengths, n + 1, section + "/Stitch lengths"),
                              mid_point = at_masts(mid_points, n + 1, section + "/Mid-points"),
                              contact = staggers(contact_stagger, n + 1,
                                                 section + "/Contact wire/Stagger"),
                              messenger = staggers(messenger_stagger, n + 1,
                                                   section + "/Messenger wire/Stagger");
    double x = 0.;
    for (std::size_t i = 0; i <= n; ++i)
    {
      result.masts.push_back({span_lengths.empty() ? i * span_length : x, height[i], encumbrance[i],
                              contact[i], messenger[i], stitch[i], mid_point[i]});
      if (i < span_lengths.size())
        x += span_lengths[i];
    }
    const auto rows = [&](const std::string &text, const std::string &name)
    {
      const std::string entry = section + "/Droppers/" + name;
      auto result = parse_rows(text, entry);
      if (result.size() > 1 && result.size() != n)
        throw EntryError(entry, std::to_string(result.size()) + " lists for " + std::to_string(n) +
                                    " spans; give one for all, or one for each");
      return result;
    };
    const auto places = rows(positions, "Positions"), sags = rows(pre_sag, "Pre-sag"),
               given = rows(is_folder(lengths) ? "" : lengths, "Lengths");
    for (std::size_t i = 0; i < n; ++i)
    {
      const std::vector<double> &own = row_of_span(places, i), &sag = row_of_span(sags, i),
                                &length = row_of_span(given, i);
      const std::string where = places.size() > 1 ? " of span " + std::to_string(i + 1) : "";
      check_count(sag, own, section + "/Droppers/Pre-sag", where);
      check_count(length, own, section + "/Droppers/Lengths", where);
      const double begin = result.masts[i].x, end = result.masts[i + 1].x;
      result.spans.push_back(
          droppers_of(own, sag, length, begin, positions_are == "relative" ? end - begin : 1.));
    }
    return result;
  }

  LineLayout LineGeometry::from_table(const std::string &section) const
  {
    const std::string entry = section + "/Line";
    const CsvTable file(table, entry);
    const std::set<std::string> known = {
        "span",          "height",    "encumbrance", "stagger", "messenger stagger",
        "stitch length", "mid-point", "droppers",    "pre-sag", "lengths"};
    for (const std::string &column : file.heads())
      if (known.count(column) == 0)
        throw EntryError(entry, "file '" + table + "': there is no column '" + column + "'" +
                                    suggestion(column, {known.begin(), known.end()}));
    for (const char *const needed : {"span", "droppers"})
      if (!file.has(needed))
        throw EntryError(entry, "file '" + table + "' has no column '" + needed + "'");
    // The last mast may have nothing of its own.
    const bool ends_empty = file.has_empty_end() && !file.text(file.n_rows() - 1, "span").empty();
    const std::size_t n_masts = file.n_rows() + (ends_empty ? 1 : 0);
    if (n_masts < 2)
      throw EntryError(entry, "file '" + table + "' has one mast; a line has two and more");
    LineLayout result;
    double x = 0.;
    for (std::size_t i = 0; i < n_masts; ++i)
    {
      const auto value = [&](const std::string &column, const double otherwise)
      { return file.text(i, column).empty() ? otherwise : file.number(i, column); };
      result.masts.push_back({x, value("height", 0.), value("encumbrance", encumbrances.front()),
                              value("stagger", 0.), value("messenger stagger", 0.),
                              value("stitch length", 0.), value("mid-point", 0.)});
      const std::vector<double> places = file.numbers(i, "droppers"),
                                sags = file.numbers(i, "pre-sag"),
                                given = file.numbers(i, "lengths");
      if (i + 1 == n_masts)
      {
        if (!file.text(i, "span").empty() || !places.empty())
          file.fail(i, "the last mast has no span after it; leave 'span' and 'droppers' empty");
        break;
      }
      for (const auto &[list, name] : {std::pair(&sags, "pre-sag"), {&given, "lengths"}})
        if (!list->empty() && list->size() != places.size())
          file.fail(i, std::to_string(list->size()) + " values in '" + name + "' for " +
                           std::to_string(places.size()) + " droppers");
      const double span = file.number(i, "span");
      result.spans.push_back(
          droppers_of(places, sags, given, x, positions_are == "relative" ? span : 1.));
      x += span;
    }
    return result;
  }
} // namespace taut
