// SPDX-License-Identifier: LGPL-2.1-or-later
#include "wire/travelling_shape.h"
#include <taut/base/exceptions.h>

#include <deal.II/base/polynomial.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
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
    /// compared with it.
    constexpr unsigned int samples_in_element = 1000;
    constexpr unsigned int n_samples = elements_in_bin * samples_in_element;

    /// Length of a piece with a jump, over an element: what it lacks of a load of a hundredth of an
    /// element is 4e-7 of it.
    constexpr double piece_of_jump = 4e-9;

    /// Pieces in a bin; a jump takes some forty. With more, the formula oscillates.
    constexpr std::size_t most_in_bin = 4096;

    /// Part of the largest value so far below which a piece is zero: far below rounding.
    constexpr double negligible = 1e-18;

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
    static const std::regex moving("\\( *s *- *([0-9.]+) *\\* *t *(?=[-+)])"), word("\\b[st]\\b");
    std::set<std::string> speeds;
    for (std::sregex_iterator at(formula.begin(), formula.end(), moving), end; at != end; ++at)
      speeds.insert(at->str(1));
    if (speeds.size() != 1 || std::regex_search(std::regex_replace(formula, moving, "( "), word))
      return 0.;
    return std::stod(*speeds.begin());
  }

  double TravellingShape::Piece::operator()(const double u) const
  {
    const double x = (u - begin) / (end - begin);
    double result = coefficients.back();
    for (unsigned int j = n_coefficients - 1; j-- > 0;)
      result = result * x + coefficients[j];
    return result;
  }

  const TravellingShape::Piece &TravellingShape::Bin::at(const double u) const
  {
    return *std::prev(std::upper_bound(std::next(pieces.begin()), pieces.end(), u,
                                       [](const double x, const Piece &p) { return x < p.begin; }));
  }

  TravellingShape::TravellingShape(const Expression &formula, const double speed,
                                   const double wire_length, const double begin, const double end,
                                   const double element_length)
      : formula(formula), speed(speed), width(elements_in_bin * element_length),
        first(wire_length - width * std::floor((wire_length - end) / width)), samples(n_samples)
  {
    for (unsigned int k = 0; k < n_samples; ++k)
      samples[k] = (k + .5) / n_samples;
    // What is on the wire at the start, and as much behind it, says what is negligible.
    const std::size_t n_bins = 2 * static_cast<std::size_t>((first - begin) / width + 1.);
    know(n_bins - 1);
    for (Bin &bin : bins)
      for (Piece &piece : bin.pieces)
        piece.is_zero =
            piece.is_zero ||
            std::all_of(std::begin(nodes), std::end(nodes),
                        [&](const double x) {
                          return std::fabs(piece(piece.begin + x * (piece.end - piece.begin))) <=
                                 negligible * largest;
                        });
  }

  void TravellingShape::know(const std::size_t bin) const
  {
    while (bins.size() <= bin)
      bins.push_back(look(bins.size()));
  }

  void TravellingShape::evaluate(const std::size_t bin, const std::vector<double> &u,
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
    try
    {
      evaluate(bin, samples, sampled);
      double most = 0.;
      for (const double q : sampled)
        most = std::max(most, std::fabs(q));
      largest = std::max(largest, most);
      result.is_known = resolve(bin, 0., 1., most, result);
    }
    catch (const UserError &)
    {
      // An error of the run, if the place without a value comes onto the wire.
    }
    return result;
  }

  bool TravellingShape::resolve(const std::size_t bin, const double begin, const double end,
                                const double most, Bin &result) const
  {
    if (result.pieces.size() == most_in_bin)
      return false;
    Piece piece{begin, end, true, {}};
    const double length = end - begin;
    points.clear();
    for (const double x : nodes)
      points.push_back(begin + length * x);
    for (const double x : checks)
      points.push_back(begin + length * x);
    evaluate(bin, points, values);
    const std::vector<std::vector<double>> &basis = lagrange_basis();
    for (unsigned int k = 0; k < n_nodes; ++k)
    {
      piece.is_zero = piece.is_zero && std::fabs(values[k]) <= negligible * largest;
      for (unsigned int j = 0; j < n_nodes; ++j)
        piece.coefficients[j] += values[k] * basis[k][j];
    }
    const double accepted = std::max(tolerance, piece_of_jump / (elements_in_bin * length)) * most;
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

  std::optional<ElementLoad> TravellingShape::on(const LoadedElement &element, const double t) const
  {
    if (t < 0.)
      return {};
    const auto place = [&](const double s)
    { return std::max(0., (first + speed * t - s) / width); };
    const double u0 = place(element.begin + element.length), u1 = place(element.begin);
    const std::size_t k0 = static_cast<std::size_t>(u0), k1 = static_cast<std::size_t>(u1);
    know(k1);
    for (std::size_t k = k0; k <= k1; ++k)
      if (!bins[k].is_known)
        return {};
    ElementLoad result;
    if (const Piece &piece = bins[k0].at(u0 - k0); u1 - k0 <= piece.end)
    {
      for (unsigned int q = 0; q < ElementLoad::n_points && !piece.is_zero; ++q)
        result.values[q] = piece(place(element.places[q]) - k0);
      result.size = piece.is_zero ? 0. : 1.;
      return result;
    }

    static const dealii::QGauss<1> rule(n_coefficients - 1); // exact for moments up to the third
    ElementLoad::Moments moments = {};
    for (std::size_t k = k0; k <= k1; ++k)
      for (const Piece *piece = &bins[k].at(k == k0 ? u0 - k : 0.);
           piece != bins[k].pieces.data() + bins[k].pieces.size() && piece->begin + k < u1; ++piece)
      {
        const double from = std::max(u0, piece->begin + k), to = std::min(u1, piece->end + k);
        if (piece->is_zero || to <= from)
          continue;
        for (unsigned int q = 0; q < rule.size(); ++q)
        {
          const double u = from + (to - from) * rule.point(q)[0],
                       force = (to - from) / (u1 - u0) * rule.weight(q) * (*piece)(u - k);
          const ElementLoad::Moments P = ElementLoad::legendre(1. - 2. * (u - u0) / (u1 - u0));
          for (unsigned int j = 0; j < P.size(); ++j)
            moments[j] += force * P[j];
          result.size += std::fabs(force);
        }
      }
    for (unsigned int q = 0; q < ElementLoad::n_points && result.size > 0.; ++q)
    {
      const double u = place(element.places[q]);
      const std::size_t k = static_cast<std::size_t>(u);
      result.values[q] = bins[k].at(u - k)(u - k);
    }
    result.take_cubic(moments, LoadIntegral::kept * result.size);
    return result;
  }
} // namespace taut
