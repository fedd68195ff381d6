// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_tests_joined_catenaries_h
#define taut_tests_joined_catenaries_h

#include "cable/elastic_catenary.h"

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

/// The equilibrium of elastic catenaries that meet at nodes, in closed form but for the places of
/// the nodes: Newton's method on the forces there, with differences as derivatives.
class JoinedCatenaries
{
public:
  struct Cable
  {
    std::size_t from = 0, to = 0; ///< nodes
    double length = 0.;           ///< unstressed [m]
    double EA = 0.;               ///< [N]
    taut::Coordinates load = {};  ///< per unstressed length [N/m]
  };

  std::vector<taut::Coordinates> places; ///< of all nodes [m]
  std::vector<taut::Coordinates> loads;  ///< on them [N]
  std::size_t n_free = 0;                ///< the first ones; the others are held
  std::vector<Cable> cables;

  /// From `places` on. Returns what remains unbalanced [N].
  double solve()
  {
    const std::size_t n = 3 * n_free;
    for (int iteration = 0; iteration < 60; ++iteration)
    {
      const std::vector<double> r = unbalanced();
      if (largest(r) < 1e-9)
        break;
      dealii::FullMatrix<double> A(n);
      for (const Cable &cable : cables)
        add_tangent(cable, A);
      A.gauss_jordan();
      dealii::Vector<double> step(n);
      A.vmult(step, dealii::Vector<double>(r.begin(), r.end()));
      const std::vector<taut::Coordinates> start = places;
      for (double part = 1.; part > 1e-6; part *= .5)
      {
        for (std::size_t i = 0; i < n_free; ++i)
          places[i] = add_scaled(start[i], part, {step[3 * i], step[3 * i + 1], step[3 * i + 2]});
        if (largest(unbalanced()) < largest(r))
          break;
      }
    }
    return largest(unbalanced());
  }

  /// With which a cable pulls at its first node [N].
  taut::Coordinates pull(const Cable &cable) const
  {
    return catenary(cable, places[cable.to] - places[cable.from]).pull();
  }

private:
  static ElasticCatenary catenary(const Cable &cable, const taut::Coordinates &chord)
  {
    return {{}, chord, cable.load, cable.EA, cable.length};
  }

  std::vector<double> unbalanced() const
  {
    std::vector<double> r(3 * n_free);
    for (std::size_t i = 0; i < n_free; ++i)
      add(i, loads[i], r);
    for (const Cable &cable : cables)
    {
      add(cable.from, pull(cable), r);
      add(cable.to, catenary(cable, places[cable.from] - places[cable.to]).pull(), r);
    }
    return r;
  }

  void add(const std::size_t node, const taut::Coordinates &force, std::vector<double> &r) const
  {
    for (std::size_t c = 0; node < n_free && c < 3; ++c)
      r[3 * node + c] += force[c];
  }

  /// Minus the derivatives of the forces.
  void add_tangent(const Cable &cable, dealii::FullMatrix<double> &A) const
  {
    for (std::size_t c = 0; c < 3; ++c)
    {
      taut::Coordinates d;
      const double h = 1e-5;
      (c == 0 ? d.x : c == 1 ? d.y : d.z) = h;
      const taut::Coordinates chord = places[cable.to] - places[cable.from];
      const taut::Coordinates change =
          add_scaled({}, .5 / h,
                     catenary(cable, add_scaled(chord, 1., d)).pull() -
                         catenary(cable, add_scaled(chord, -1., d)).pull());
      for (const std::size_t row : {cable.from, cable.to})
        for (const std::size_t column : {cable.from, cable.to})
          for (std::size_t k = 0; row < n_free && column < n_free && k < 3; ++k)
            A(3 * row + k, 3 * column + c) += (row == column ? 1. : -1.) * change[k];
    }
  }

  static double largest(const std::vector<double> &r)
  {
    double size = 0.;
    for (const double value : r)
      size = std::max(size, std::isfinite(value) ? std::fabs(value) : 1e300);
    return size;
  }
};

#endif
