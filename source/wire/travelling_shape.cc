// SPDX-License-Identifier: LGPL-2.1-or-later
#include "wire/travelling_shape.h"
#include <taut/base/exceptions.h>

#include <deal.II/base/polynomial.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <regex>
#include <set>

namespace taut
{
  namespace
  {
    /// Elements in a bin: most pieces of a load that is wider than some elements then are, too, and
    /// most elements lie in one of them.
    constexpr unsigned int elements_in_bin = 16;

    /// Places in an element at which the shape is looked at, and at which each polynomial is
    /// compared with it. A choice: more see narrower details, and cost as much at the set-up.
    constexpr unsigned int samples_in_element = 250;
    constexpr unsigned int n_samples = elements_in_bin * samples_in_element;

    /// Length of a piece with a jump, over an element: what it lacks of a load of a hundredth of an
    /// element is 4e-7 of it.
    constexpr double piece_of_jump = 4e-9;

    /// Pieces in a bin, and parts of it at which a piece is no longer halved; a jump takes some
    /// forty. With more, the formula oscillates.
    constexpr std::size_t most_in_bin = 4096;
    constexpr double shortest_piece = 1e-13;

    /// A load below this is zero: errors of it have no digits [N/m].
    constexpr double no_load = 1e-290;

    /// Error of a polynomial over the largest value in its bin, or a thousandth of the largest at
    /// the start: a tenth of what LoadIntegral promises. A piece below this error is zero.
    constexpr double tolerance = .1 * LoadIntegral::tolerance, least_part = 1e-3;

    /// Places for each element from which the size of a load is known: what is a thousandth of it.
    constexpr double samples_of_size = 4.;

    /// The Chebyshev points of degree 5 on (0, 1), and places between them.
    constexpr double nodes[] = {0.017037086855465856, 0.14644660940672624, 0.37059047744873963,
                                0.62940952255126037,  0.85355339059327376, 0.98296291314453414};
    constexpr double checks[] = {0.004, 0.075, 0.25, 0.5, 0.75, 0.925, 0.996};
    constexpr unsigned int n_nodes = std::size(nodes), n_checks = std::size(checks);

    /// The powers of the polynomials that are 1 at one node and 0 at the others.
    const std::vector<std::vector<double>> &lagrange_basis()
    {
      static const std::vector<std::vector<double>> result = []
      {
        std::vector<dealii::Point<1>> points;
        for (const double x : nodes)
          points.emplace_back(x);
        std::vector<std::vector<double>> basis(n_nodes, std::vector<double>(n_nodes));
        const auto polynomials = dealii::Polynomials::generate_complete_Lagrange_basis(points);
        for (unsigned int k = 0; k < n_nodes; ++k)
        {
          // The coefficients are those of the Taylor series at 0.
          std::vector<double> derivatives(n_nodes);
          polynomials[k].value(0., derivatives);
          double factorial = 1.;
          for (unsigned int j = 0; j < n_nodes; factorial *= ++j)
            basis[k][j] = derivatives[j] / factorial;
        }
        return basis;
      }();
      return result;
    }
  } // namespace

  double speed_of_shape(const std::string &formula)
  {
    static const std::regex moving("\\( *(?:([0-9.]+) *\\* *)?s *(?:/ *([0-9.]+) *)?- *"
                                   "(?:([0-9.]+) *\\* *)?t *(?:/ *([0-9.]+) *)?(?=[-+)])"),
        word("\\b[st]\\b");
    const auto number = [](const std::string &text) { return text.empty() ? 1. : std::stod(text); };
    std::set<double> speeds;
    for (std::sregex_iterator at(formula.begin(), formula.end(), moving), end; at != end; ++at)
      speeds.insert(number(at->str(3)) / number(at->str(4)) / number(at->str(1)) *
                    number(at->str(2)));
    const double least = speeds.empty() ? 0. : *speeds.begin(),
                 largest = speeds.empty() ? 0. : *speeds.rbegin();
    // The same speed may be written in several ways.
    if (!(largest > 0.) || !std::isfinite(largest) ||
        largest - least > 4. * std::numeric_limits<double>::epsilon() * largest ||
        std::regex_search(std::regex_replace(formula, moving, "( "), word))
      return 0.;
    return largest;
  }

  TravellingShape::TravellingShape(const Expression &formula, const double speed,
                                   const double wire_length, const double begin, const double end,
                                   const double element_length)
      : formula(formula), speed(speed), width(elements_in_bin * element_length),
        first(wire_length - width * std::floor((wire_length - end) / width)), samples(n_samples)
  {
    for (unsigned int k = 0; k < n_samples; ++k)
      samples[k] = (k + .5) / n_samples;
    const double n_bins = std::ceil((first - begin) / width);
    points.resize(static_cast<std::size_t>(2. * n_bins * elements_in_bin * samples_of_size));
    for (std::size_t k = 0; k < points.size(); ++k)
      points[k] = 2. * n_bins * (k + .5) / points.size();
    try
    {
      evaluate(0., points, values);
      largest = largest_of(values);
    }
    catch (const UserError &)
    {
      // Places behind the wire may never come onto it. Nothing is negligible then.
    }
  }

  double TravellingShape::largest_of(const std::vector<double> &values) const
  {
    double result = 0.;
    for (const double q : values)
      result = std::max(result, std::fabs(q));
    return result;
  }

  void TravellingShape::evaluate(const double bin, const std::vector<double> &u,
                                 std::vector<double> &result) const
  {
    places.resize(u.size());
    for (std::size_t k = 0; k < u.size(); ++k)
      places[k] = first - width * (bin + u[k]);
    formula.evaluate(places, 0., result);
  }

  TravellingShape::Bin TravellingShape::look(const std::size_t bin) const
  {
    Bin result;
    result.is_looked_at = true;
    try
    {
      evaluate(bin, samples, sampled);
      const double most = std::max(largest_of(sampled), least_part * largest);
      if (most < no_load)
        result.pieces.push_back({0., 1., true, {}});
      result.is_known = most < no_load || resolve(bin, 0., 1., most, result);
      for (unsigned int k = 1; k + 1 < n_samples; ++k)
        if (sampled[k] != 0. && sampled[k - 1] == 0. && sampled[k + 1] == 0.)
          result.narrow = samples[k];
    }
    catch (const UserError &)
    {
      // An error of the run, if the place without a value comes onto the wire.
    }
    if (!result.is_known)
      result.pieces.clear();
    return result;
  }

  bool TravellingShape::resolve(const std::size_t bin, const double begin, const double end,
                                const double most, Bin &result) const
  {
    if (result.pieces.size() == most_in_bin || end - begin < shortest_piece)
      return false;
    Piece piece{begin, end, true, {}};
    const double length = end - begin;
    points.clear();
    for (const double x : nodes)
      points.push_back(begin + length * x);
    for (const double x : checks)
      points.push_back(begin + length * x);
    evaluate(bin, points, values);
    const double accepted = std::max(tolerance, piece_of_jump / (elements_in_bin * length)) * most;
    const bool may_be_zero = largest_of(values) <= tolerance * most;
    const std::vector<std::vector<double>> &basis = lagrange_basis();
    for (unsigned int k = 0; k < n_nodes && !may_be_zero; ++k)
      for (unsigned int j = 0; j < n_nodes; ++j)
        piece.coefficients[j] += values[k] * basis[k][j];
    piece.is_zero = may_be_zero;
    const auto fits = [&](const double u, const double q)
    { return std::fabs(piece(u) - q) <= accepted; };
    bool is_resolved = true;
    for (unsigned int k = 0; k < n_checks && is_resolved; ++k)
      is_resolved = fits(points[n_nodes + k], values[n_nodes + k]);
    for (std::size_t k = std::ceil(begin * n_samples - .5);
         is_resolved && k < n_samples && samples[k] < end; ++k)
      is_resolved = fits(samples[k], sampled[k]);
    if (is_resolved)
    {
      result.pieces.push_back(piece);
      return true;
    }
    const double middle = .5 * (begin + end);
    return resolve(bin, begin, middle, most, result) && resolve(bin, middle, end, most, result);
  }

  TravellingShape::Walk::Walk(const TravellingShape &shape, const double t)
      : shape(shape), start((shape.first + shape.speed * t) / shape.width),
        per_length(1. / shape.width), is_before(t < 0.)
  {
  }

  /// False if the shape is not known there.
  bool TravellingShape::Walk::move_to(const double u)
  {
    const std::size_t k = static_cast<std::size_t>(u);
    if (shape.bins.size() <= k)
      shape.bins.resize(k + 1);
    if (!shape.bins[k].is_looked_at)
      shape.bins[k] = shape.look(k);
    if (!shape.bins[k].is_known)
      return false;
    const std::vector<Piece> &pieces = shape.bins[k].pieces;
    if (bin != k)
      piece = pieces.size() - 1;
    bin = k;
    while (pieces[piece].begin + k > u && piece > 0)
      --piece;
    while (pieces[piece].end + k <= u && piece + 1 < pieces.size())
      ++piece;
    from = pieces[piece].begin + k;
    to = pieces[piece].end + k;
    return true;
  }

  bool TravellingShape::Walk::on(const LoadedElement &element, ElementLoad &load)
  {
    load.size = 0.;
    load.is_resolved = true;
    const double u0 = place(element.begin + element.length), u1 = place(element.begin);
    if (!(u0 >= from && u1 <= to))
    {
      if (is_before || !move_to(u1) || !move_to(u0))
        return false;
      for (std::size_t k = bin; k < u1; ++k)
        if (!shape.bins[k].is_known)
          return false;
    }
    if (const double narrow = shape.bins[bin].narrow + bin; narrow >= u0 && narrow <= u1)
      load.is_resolved = false;
    if (u1 > to)
    {
      integrate(element, u0, u1, load);
      return true;
    }
    const Piece &own = shape.bins[bin].pieces[piece];
    if (own.is_zero)
      return true;
    for (unsigned int q = 0; q < ElementLoad::n_points; ++q)
    {
      load.values[q] = own(place(element.places[q]) - bin);
      load.size += std::fabs(load.values[q]) / ElementLoad::n_points;
    }
    return true;
  }

  /// Over more than one piece.
  void TravellingShape::Walk::integrate(const LoadedElement &element, const double u0,
                                        const double u1, ElementLoad &load)
  {
    static const dealii::QGauss<1> rule(n_coefficients - 1); // exact for moments up to the third
    ElementLoad::Moments moments = {};
    for (std::size_t k = bin, p = piece; k < u1; ++k, p = 0)
      for (; p < shape.bins[k].pieces.size() && shape.bins[k].pieces[p].begin + k < u1; ++p)
      {
        const Piece &part = shape.bins[k].pieces[p];
        const double from = std::max(u0, part.begin + k), to = std::min(u1, part.end + k);
        if (part.is_zero || to <= from)
          continue;
        for (unsigned int q = 0; q < rule.size(); ++q)
        {
          const double u = from + (to - from) * rule.point(q)[0],
                       force = (to - from) / (u1 - u0) * rule.weight(q) * part(u - k);
          const ElementLoad::Moments P = ElementLoad::legendre(1. - 2. * (u - u0) / (u1 - u0));
          for (unsigned int j = 0; j < P.size(); ++j)
            moments[j] += force * P[j];
          load.size += std::fabs(force);
        }
      }
    if (load.size == 0.)
      return;
    for (unsigned int q = 0; q < ElementLoad::n_points; ++q)
    {
      const double u = place(element.places[q]);
      move_to(u);
      load.values[q] = shape.bins[bin].pieces[piece](u - bin);
    }
    load.take_cubic(moments, LoadIntegral::kept * load.size);
    move_to(u0);
  }
} // namespace taut
