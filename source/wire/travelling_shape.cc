// SPDX-License-Identifier: LGPL-2.1-or-later
#include "wire/travelling_shape.h"

#include "wire/element_load.h"
#include <taut/base/exceptions.h>

#include <deal.II/base/polynomial.h>

#include <algorithm>
#include <limits>

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

    /// A polynomial may be good over an element beyond its piece: such elements take it, too.
    constexpr double most_reach = 1. / elements_in_bin;

    /// Length of a piece with a jump, over an element: what it lacks of a load of a hundredth of an
    /// element is 4e-7 of it.
    constexpr double piece_of_jump = 4e-9;

    /// Pieces in a bin, and parts of it at which a piece is no longer halved; a jump takes some
    /// forty. With more, the formula oscillates.
    constexpr std::size_t most_in_bin = 4096;
    constexpr double shortest_piece = 1e-13;

    /// A load below this is zero: errors of it have no digits [N/m].
    constexpr double no_load = 1e-290;

    /// Error of a polynomial over the largest value in its bin. A piece below this error is zero.
    constexpr double tolerance = LoadIntegral::of_polynomial;

    /// Farther off, the number of a bin has no digits for a place in it.
    constexpr double most_bins = 1e9;

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

  TravellingShape::TravellingShape(const Expression::Separated::Shape &shape,
                                   const double wire_length, const double begin, const double end,
                                   const double element_length)
      : shape(shape), a(shape.a(0., 0.)), b(shape.b(0., 0.)),
        width(elements_in_bin * element_length),
        first(wire_length - width * std::floor((wire_length - end) / width)),
        samples(n_samples + 2 * samples_in_element)
  {
    for (unsigned int k = 0; k < samples.size(); ++k)
      samples[k] = (k + .5) / n_samples - most_reach;
    const double n_bins = std::ceil((first - begin) / width);
    points.resize(static_cast<std::size_t>(3. * n_bins * elements_in_bin * samples_of_size));
    for (std::size_t k = 0; k < points.size(); ++k)
      points[k] = 3. * n_bins * (k + .5) / points.size() - n_bins;
    try
    {
      evaluate(0., points, values);
      largest = largest_of(values);
    }
    catch (const UserError &)
    {
      // Places off the wire may never come onto it. Nothing is negligible then.
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
    shape.form.evaluate(places, 0., result);
  }

  const TravellingShape::Bin &TravellingShape::bin(const long number) const
  {
    auto found = bins.find(number);
    if (found == bins.end())
      found = bins.emplace(number, look(number)).first;
    return found->second;
  }

  TravellingShape::Bin TravellingShape::look(const long bin) const
  {
    Bin result;
    try
    {
      evaluate(bin, samples, sampled);
      const double most = std::max(largest_of(sampled), LoadIntegral::least_part * largest);
      if (most < no_load)
        result.pieces.push_back({0., 1., 0., true, {}});
      result.is_known = most < no_load || resolve(bin, 0., 1., most, result);
      for (unsigned int k = samples_in_element; k < samples_in_element + n_samples; ++k)
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

  bool TravellingShape::resolve(const long bin, const double begin, const double end,
                                const double most, Bin &result) const
  {
    if (result.pieces.size() == most_in_bin || end - begin < shortest_piece)
      return false;
    Piece piece{begin, end, 0., true, {}};
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
    bool is_resolved = is_good(piece, begin, end, accepted);
    for (unsigned int k = 0; k < n_checks && is_resolved; ++k)
      is_resolved = std::fabs(piece(points[n_nodes + k]) - values[n_nodes + k]) <= accepted;
    if (is_resolved)
    {
      if (!piece.is_zero && length >= most_reach &&
          is_good(piece, begin - most_reach, begin, accepted) &&
          is_good(piece, end, end + most_reach, accepted))
        piece.reach = most_reach;
      result.pieces.push_back(piece);
      return true;
    }
    const double middle = .5 * (begin + end);
    return resolve(bin, begin, middle, most, result) && resolve(bin, middle, end, most, result);
  }

  /// At the samples from one place of the bin to another one.
  bool TravellingShape::is_good(const Piece &piece, const double begin, const double end,
                                const double accepted) const
  {
    for (std::size_t k = std::ceil((begin + most_reach) * n_samples - .5);
         k < samples.size() && samples[k] < end; ++k)
      if (!(std::fabs(piece(samples[k]) - sampled[k]) <= accepted))
        return false;
    return true;
  }

  TravellingShape::Walk::Walk(const TravellingShape &shape, const double t) : shape(shape)
  {
    try
    {
      const double a = shape.shape.a(0., t), stretch = shape.a / a;
      start = stretch * shape.first + (shape.b - shape.shape.b(0., t)) / a;
      width = stretch * shape.width;
      per_length = 1. / width;
    }
    catch (const UserError &)
    {
      // The whole formula may have a value where the way of the shape has none.
      start = width = per_length = 0.;
    }
  }

  bool TravellingShape::Walk::go_to(const double s)
  {
    const double place = (start - s) * per_length, own = std::ceil(place) - 1.;
    if (!(std::fabs(own) < most_bins && width > 0.) || !enter(static_cast<long>(own)))
      return false;
    const double u = place - own;
    while (piece->begin >= u && piece != &bin->pieces.front())
      --piece;
    while (piece->end < u && piece != &bin->pieces.back())
      ++piece;
    set_ends();
    return true;
  }

  bool TravellingShape::Walk::advance()
  {
    if (piece != &bin->pieces.front())
      --piece;
    else if (!enter(number - 1))
      return false;
    set_ends();
    return true;
  }

  /// At the last piece of a bin if it is another one.
  bool TravellingShape::Walk::enter(const long own)
  {
    if (!bin || number != own)
    {
      number = own;
      bin = &shape.bin(number);
      piece = bin->is_known ? &bin->pieces.back() : nullptr;
      narrow = bin->narrow < 0. ? std::numeric_limits<double>::quiet_NaN()
                                : start - (number + bin->narrow) * width;
    }
    return piece;
  }

  void TravellingShape::Walk::set_ends()
  {
    from = start - (number + piece->end) * width;
    to = start - (number + piece->begin) * width;
    const double reach = piece->reach * width;
    low = from - reach;
    high = to + reach;
    per_piece = per_length / (piece->end - piece->begin);
  }
} // namespace taut
