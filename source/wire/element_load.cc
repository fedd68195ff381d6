// SPDX-License-Identifier: LGPL-2.1-or-later
#include "wire/element_load.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace taut
{
  namespace
  {
    constexpr unsigned int n_points = 9, n_moments = std::tuple_size<ElementLoad::Moments>::value;

    /// Places on (-1, 1): the Gauss points, the middle, and points that leave no gap wider than
    /// 0.34. The outer points are not at the ends, where a formula need not have a value.
    constexpr double end = 1. - 2e-9, inner = 0.33998104358485626, outer = 0.86113631159405258;
    constexpr double places[n_points] = {-end, -outer, -.6, -inner, 0., inner, .6, outer, end};
    constexpr unsigned int gauss_points[ElementLoad::n_points] = {1, 3, 5, 7};

    /// Weights of the rule that is exact for polynomials of degree 9, and of the Gauss rule of
    /// degree 7, on a length of 1.
    constexpr double weights[n_points] = {
        0.019841269841269840, 0.11051853672144542, 0.13508489815679358,
        0.14049297899595179,  0.18812463256908450, 0.14049297899595179,
        0.13508489815679358,  0.11051853672144542, 0.019841269841269840};
    constexpr double gauss_weights[n_points] = {0., 0.17392742256872693, 0., 0.32607257743127307,
                                                0., 0.32607257743127307, 0., 0.17392742256872693,
                                                0.};

    /// Weights of errors of moments. The first moment is that about the middle over half of the
    /// length; higher moments change neither the sum of forces nor the sum of moments.
    constexpr double parts_of_moments[] = {1., .25, 1e-3, 1e-3};

    /// Accepted errors over the tolerance: of a piece over its part of the element, and of a piece
    /// with a jump.
    constexpr double smooth = .2 * LoadIntegral::tolerance, jump = 4e-3 * LoadIntegral::tolerance;
    constexpr double narrowest_piece = 1e-13;

    /// A load below this is nothing: numbers about it have no digits to integrate.
    constexpr double least_load = std::numeric_limits<double>::min();
    constexpr unsigned int most_pieces = 1 << 15;

    using Moments = ElementLoad::Moments;

    /// Difference of the weights of the two rules at each point.
    constexpr std::array<Moments, n_points> weighted_differences()
    {
      std::array<Moments, n_points> result = {};
      for (unsigned int k = 0; k < n_points; ++k)
        for (unsigned int j = 0; j < n_moments; ++j)
          result[k][j] = (weights[k] - gauss_weights[k]) * ElementLoad::legendre(places[k])[j];
      return result;
    }

    double largest_difference(const Moments &a, const Moments &b)
    {
      double result = 0.;
      for (unsigned int j = 0; j < n_moments; ++j)
        result = std::max(result, parts_of_moments[j] * std::fabs(a[j] - b[j]));
      return result;
    }
  } // namespace

  double TypicalLoad::operator()()
  {
    constexpr std::size_t n_values = 64, n_smaller = 48;
    constexpr double golden = 0.61803398874989485;
    if (value >= 0.)
      return value;
    std::array<double, n_values> values;
    for (std::size_t k = 0; k < n_values; ++k)
      values[k] = std::fabs(magnitude(wire_length * std::fmod((k + 1) * golden, 1.), t));
    std::nth_element(values.begin(), values.begin() + n_smaller, values.end());
    value = values[n_smaller] * (n_values - n_smaller) / n_values;
    return value;
  }

  /// From begin to begin + width of an element of length 1.
  struct LoadIntegral::Piece
  {
    double begin, width;
    double values[n_points];
    double error = 0., size = 0.;
  };

  /// The sums of the accepted pieces.
  struct LoadIntegral::Sums
  {
    ElementLoad load;
    Moments moments = {};
    unsigned int n_pieces = 0;
    double error = 0., scale = 0.; ///< of the accepted pieces, and the scale of this error

    void add(const Piece &piece)
    {
      error += piece.error;
      load.size += piece.size;
      for (unsigned int k = 0; k < n_points; ++k)
      {
        if (piece.values[k] == 0.)
          continue;
        const double x = 2. * (piece.begin + .5 * piece.width * (1. + places[k])) - 1.;
        const Moments P = ElementLoad::legendre(x);
        for (unsigned int j = 0; j < n_moments; ++j)
          moments[j] += piece.width * weights[k] * piece.values[k] * P[j];
      }
    }
  };

  void LoadIntegral::look(const double begin, const double h, const double t, Piece &piece) const
  {
    for (unsigned int k = 0; k < n_points; ++k)
      piece.values[k] =
          magnitude(begin + h * (piece.begin + .5 * piece.width * (1. + places[k])), t);
  }

  namespace
  {
    /// Both rules on the values of a piece.
    template <typename Piece>
    void compare(Piece &piece)
    {
      static constexpr std::array<Moments, n_points> difference = weighted_differences();
      Moments sum = {};
      piece.size = 0.;
      for (unsigned int k = 0; k < n_points; ++k)
      {
        for (unsigned int j = 0; j < n_moments; ++j)
          sum[j] += difference[k][j] * piece.values[k];
        piece.size += piece.width * weights[k] * std::fabs(piece.values[k]);
      }
      piece.error = piece.width * largest_difference(sum, {});
    }
  } // namespace

  void LoadIntegral::refine(const double begin, const double h, const double t, const Piece &piece,
                            Sums &sums) const
  {
    if (piece.error <= std::max(jump, smooth * piece.width) * sums.scale ||
        piece.width < narrowest_piece || sums.n_pieces >= most_pieces)
    {
      sums.add(piece);
      return;
    }
    Piece half;
    half.width = .5 * piece.width;
    if (half.width < sums.load.narrowest)
    {
      sums.load.narrowest = half.width;
      sums.load.narrowest_at = piece.begin + half.width;
    }
    for (const double from : {piece.begin, piece.begin + half.width})
    {
      ++sums.n_pieces;
      half.begin = from;
      look(begin, h, t, half);
      compare(half);
      for (const double value : half.values)
        sums.load.largest = std::max(sums.load.largest, std::fabs(value));
      refine(begin, h, t, half, sums);
    }
  }

  void ElementLoad::take_cubic(const Moments &moments, const double difference)
  {
    Moments by_values = {};
    for (unsigned int k = 0; k < n_points; ++k)
    {
      const Moments P = legendre(places[gauss_points[k]]);
      for (unsigned int j = 0; j < n_moments; ++j)
        by_values[j] += gauss_weights[gauss_points[k]] * values[k] * P[j];
    }
    if (largest_difference(moments, by_values) <= difference)
      return;
    is_cubic = true;
    for (unsigned int k = 0; k < n_points; ++k)
    {
      const Moments P = legendre(places[gauss_points[k]]);
      values[k] = 0.;
      for (unsigned int j = 0; j < n_moments; ++j)
        values[k] += (2. * j + 1.) * moments[j] * P[j];
    }
  }

  ElementLoad LoadIntegral::over(const double begin, const double h,
                                 const std::array<double, 4> &gauss_places, const double t,
                                 const unsigned int n_pieces, TypicalLoad &typical) const
  {
    Sums sums;
    ElementLoad &load = sums.load;
    for (unsigned int k = 0; k < ElementLoad::n_points; ++k)
      load.values[k] = magnitude(gauss_places[k], t);
    std::array<Piece, fine_pieces> pieces;
    double size = 0., error = 0.;
    for (unsigned int p = 0; p < n_pieces; ++p)
    {
      Piece &piece = pieces[p];
      piece.begin = double(p) / n_pieces;
      piece.width = 1. / n_pieces;
      if (n_pieces > 1)
        look(begin, h, t, piece);
      else
        for (unsigned int k = 0, q = 0; k < n_points; ++k)
          piece.values[k] = q < ElementLoad::n_points && gauss_points[q] == k
                                ? load.values[q++]
                                : magnitude(begin + .5 * h * (1. + places[k]), t);
      compare(piece);
      size += piece.size;
      error += piece.error;
      for (const double value : piece.values)
        load.largest = std::max(load.largest, std::fabs(value));
    }
    load.begins = pieces[0].values[0] != 0.;
    load.ends = pieces[n_pieces - 1].values[n_points - 1] != 0.;
    sums.scale = std::max({size, seen_by_fine_pieces * load.largest, least_load});
    load.size = size;
    if (n_pieces == 1 && error <= kept * sums.scale)
      return load;
    sums.scale = std::max(sums.scale, typical());
    if (n_pieces == 1 && error <= kept * sums.scale)
      return load;

    load.size = 0.;
    for (unsigned int p = 0; p < n_pieces; ++p)
      refine(begin, h, t, pieces[p], sums);
    const double scale =
        std::max({load.size, seen_by_fine_pieces * load.largest, typical(), least_load});
    load.is_resolved = sums.error <= tolerance * scale;
    load.take_cubic(sums.moments, kept * scale);
    return load;
  }
} // namespace taut
