// SPDX-License-Identifier: LGPL-2.1-or-later Energies and forces of cables, several elements at a
// time. Where integration points are at the ends of elements (ANCF), r' is a DoF of the node, and
// both elements have the same value: a node counts once.
#include "cable/element_vectors.h"

#include "base/instruction_set.h"
#include <taut/cable/cable_elements.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace taut
{
  namespace
  {
    /// |r'|, for finite arguments.
    double stretch_of(const Coordinates &u)
    {
      return std::sqrt(dot(u, u));
    }

    double curvature_squared(const Coordinates &u, const Coordinates &v)
    {
      const Coordinates w = cross_product(u, v);
      const double a = dot(u, u);
      return dot(w, w) / (a * a);
    }
  } // namespace

  /// Elements from @p first on, with positions scaled to elements of mean length, whose r' is
  /// theirs. The first node is their origin and left out. Behind the last node the batch goes to
  /// and fro, so that no element lacks a length.
  inline ElementBatch CableElements::batch(const std::vector<double> &q,
                                           const unsigned int first) const
  {
    double copies[dofs_per_node * (ElementBatch::size + 1)];
    const double *own = q.data() + dofs_per_node * first;
    if (first + ElementBatch::size > n)
    {
      for (unsigned int l = 0; l <= ElementBatch::size; ++l)
      {
        const unsigned int k = first + l;
        std::copy_n(q.begin() + dofs_per_node * (k <= n ? k : n - (k - n) % 2), dofs_per_node,
                    copies + dofs_per_node * l);
      }
      own = copies;
    }
    // Strided reads: vector instructions would wait for values that are stored one by one.
    ElementBatch x;
    const double relative = kind == CableElement::bar ? 1. : 0.;
    const double *const of_position = ratios.of_position.data() + first,
                        *const of_middle = ratios.of_middle.data() + first;
    for (unsigned int c = 0; c < 3; ++c)
#pragma omp simd
      for (unsigned int l = 0; l < ElementBatch::size; ++l)
      {
        const double *const element = own + dofs_per_node * l;
        x.dof[3 + c][l] = of_middle[l] * (element[3 + c] - relative * element[c]);
        x.dof[6 + c][l] = of_position[l] * (element[6 + c] - element[c]);
        x.dof[9 + c][l] = element[9 + c];
      }
    return x;
  }

  /// Weights of the nodes from @p first on in an axial integral, by their points [m].
  inline std::array<double, ElementBatch::size>
  CableElements::end_weights(const unsigned int first) const
  {
    std::array<double, ElementBatch::size> weight;
    for (unsigned int l = 0; l < ElementBatch::size; ++l)
      weight[l] = end_weight * ((first + l > 0 ? ratios.length[first + l - 1] : 0.) +
                                (first + l != n ? ratios.length[first + l] : 0.));
    return weight;
  }

  double CableElements::strain_energy(const std::vector<double> &q) const
  {
    double energy = 0.;
    vectorised(
        [this, &q, &energy]
        {
          double all = 0.;
          for (unsigned int first = 0; first <= n; first += ElementBatch::size)
          {
            const ElementBatch x = batch(q, first);
            const double *const length = ratios.length.data() + first,
                                *const shorter = ratios.of_position.data() + first;
            const auto axial = [EA = material.axial_stiffness](const Coordinates &u)
            {
              const double strain = stretch_of(u) - 1.;
              return .5 * EA * strain * strain;
            };
            std::array<double, ElementBatch::size> sum{}, of_nodes = end_weights(first);
#pragma omp simd
            for (unsigned int l = 0; l < ElementBatch::size; ++l)
              of_nodes[l] *= axial(x.derivative(l));
            for (const Point &p : inner_axial_points)
#pragma omp simd
              for (unsigned int l = 0; l < ElementBatch::size; ++l)
                sum[l] += length[l] * p.weight * axial(combine(p.slope, x, l));
            for (const Point &p : bending_points)
#pragma omp simd
              for (unsigned int l = 0; l < ElementBatch::size; ++l)
                sum[l] += .5 * p.weight * material.bending_stiffness * shorter[l] *
                          curvature_squared(combine(p.slope, x, l), combine(p.curvature, x, l));
            for (unsigned int l = 0; l < std::min(n - first, ElementBatch::size); ++l)
              all += sum[l];
            for (unsigned int l = 0; l < std::min(n + 1 - first, ElementBatch::size); ++l)
              all += of_nodes[l];
          }
          energy = all;
        });
    return energy;
  }

  /// Sets the axial forces of a batch, axial(weight, r' of @p x, r' of @p y) at each point; later
  /// points add to them.
  template <typename Force>
  inline void CableElements::set_axial_forces(const unsigned int first, const ElementBatch &x,
                                              const ElementBatch &y, const Force &axial,
                                              ElementBatch &sum, NodeBatch &of_nodes) const
  {
    if (end_weight != 0.)
    {
      const std::array<double, ElementBatch::size> weight = end_weights(first);
#pragma omp simd
      for (unsigned int l = 0; l < ElementBatch::size; ++l)
        of_nodes.set(l, axial(weight[l], x.derivative(l), y.derivative(l)));
    }
    const auto put = [&](const Point &p, const auto adds)
    {
#pragma omp simd
      for (unsigned int l = 0; l < ElementBatch::size; ++l)
        distribute<adds>(p.slope, axial(p.weight, combine(p.slope, x, l), combine(p.slope, y, l)),
                         sum, l);
    };
    put(inner_axial_points.front(), std::false_type());
    for (std::size_t k = 1; k < inner_axial_points.size(); ++k)
      put(inner_axial_points[k], std::true_type());
  }

  /// f = the sum of the forces that @p integrand sets (arguments: first element of a batch, forces
  /// of elements, forces of nodes).
  template <typename Integrand>
  void CableElements::integrate_force(std::vector<double> &f, const Integrand &integrand) const
  {
    f.resize(n_dofs());
    vectorised(
        [this, &integrand, all = f.data()]
        {
          std::array<double, dofs_per_node>
              of_element_before{}; // forces of the element before on its second node
          for (unsigned int first = 0; first <= n; first += ElementBatch::size)
          {
            ElementBatch sum;
            NodeBatch of_nodes;
            integrand(first, sum, of_nodes);
            for (unsigned int c = 0; c < 3; ++c)
              for (unsigned int l = 0; l < ElementBatch::size; ++l)
                sum.dof[c][l] = kind == CableElement::bar ? -(sum.dof[3 + c][l] + sum.dof[6 + c][l])
                                                          : -sum.dof[6 + c][l];
            if (kind == CableElement::ancf)
              for (unsigned int c = 0; c < 3; ++c)
                for (unsigned int l = 0; l < ElementBatch::size; ++l)
                {
                  sum.dof[3 + c][l] *= ratios.length[first + l];
                  sum.dof[9 + c][l] *= ratios.length[first + l];
                }
            if (n - first < ElementBatch::size) // no element begins at the last node
              for (unsigned int i = 0; i < dofs_per_node; ++i)
                sum.dof[i][n - first] = 0.;
            for (unsigned int l = 0; l < std::min(n + 1 - first, ElementBatch::size); ++l)
            {
              double *const node = all + dofs_per_node * (first + l);
              for (unsigned int i = 0; i < dofs_per_node; ++i)
                node[i] = sum.dof[i][l] +
                          (l == 0 ? of_element_before[i] : sum.dof[dofs_per_node + i][l - 1]);
              if (end_weight != 0.)
                for (unsigned int c = 0; c < 3; ++c)
                  node[3 + c] += of_nodes.dof[c][l];
            }
            for (unsigned int i = 0; i < dofs_per_node; ++i)
              of_element_before[i] = sum.dof[dofs_per_node + i][ElementBatch::size - 1];
          }
        });
  }

  void CableElements::internal_force(const std::vector<double> &q,
                                     const std::vector<double> &velocity,
                                     std::vector<double> &f) const
  {
    const bool damped = !velocity.empty() && material.axial_damping != 0.;
    const auto axial =
        [EA = material.axial_stiffness, damping = damped ? material.axial_damping : 0.](
            const double weight, const Coordinates &u, const Coordinates &rate)
    {
      const double stretch = stretch_of(u);
      const double force = EA * (stretch - 1.) + damping * dot(u, rate) / stretch;
      return (weight * force / stretch) * u;
    };
    const auto integrand = [&](const unsigned int first, ElementBatch &sum, NodeBatch &of_nodes)
    {
      const ElementBatch x = batch(q, first);
      ElementBatch of_velocity;
      if (damped)
        of_velocity = batch(velocity, first);
      const ElementBatch &rate = damped ? of_velocity : x;
      const double *const shorter = ratios.of_position.data() + first;
      set_axial_forces(first, x, rate, axial, sum, of_nodes);
      for (const Point &p : bending_points)
#pragma omp simd
        for (unsigned int l = 0; l < ElementBatch::size; ++l)
        {
          // kappa^2 = |w|^2 / a^2 with w = u x v and a = u . u
          const Coordinates u = combine(p.slope, x, l), v = shorter[l] * combine(p.curvature, x, l),
                            w = cross_product(u, v);
          const double a = dot(u, u), factor = p.weight * material.bending_stiffness / (a * a);
          distribute(p.slope, factor * (cross_product(v, w) + (-2. * dot(w, w) / a) * u), sum, l);
          distribute(p.curvature, (shorter[l] * factor) * cross_product(w, u), sum, l);
        }
    };
    integrate_force(f, integrand);
  }

  void CableElements::mean_force(const std::vector<double> &q0, const std::vector<double> &q1,
                                 const double step, std::vector<double> &f) const
  {
    const auto axial =
        [EA = material.axial_stiffness,
         damping = material.axial_damping == 0. ? 0. : material.axial_damping / step](
            const double weight, const Coordinates &u0, const Coordinates &u1)
    {
      const double stretch0 = stretch_of(u0), stretch1 = stretch_of(u1),
                   twice = stretch0 + stretch1;
      const double force = EA * (.5 * twice - 1.) + damping * (stretch1 - stretch0);
      return (weight * force / twice) * (u0 + u1);
    };
    const auto integrand = [&](const unsigned int first, ElementBatch &sum, NodeBatch &of_nodes)
    {
      const ElementBatch x0 = batch(q0, first), x1 = batch(q1, first);
      const double *const shorter = ratios.of_position.data() + first;
      set_axial_forces(first, x0, x1, axial, sum, of_nodes);
      for (const Point &p : bending_points)
#pragma omp simd
        for (unsigned int l = 0; l < ElementBatch::size; ++l)
        {
          // kappa^2 = c A - (b A)^2 with a = u . u, b = u . v, c = v . v and A = 1 / a:
          // differences of products, with means of the factors.
          const Coordinates u0 = combine(p.slope, x0, l), u1 = combine(p.slope, x1, l),
                            v0 = shorter[l] * combine(p.curvature, x0, l),
                            v1 = shorter[l] * combine(p.curvature, x1, l);
          const Coordinates u = .5 * (u0 + u1), v = .5 * (v0 + v1);
          const double A0 = 1. / dot(u0, u0), A1 = 1. / dot(u1, u1), b0 = dot(u0, v0),
                       b1 = dot(u1, v1), A = .5 * (A0 + A1), b = .5 * (b0 + b1),
                       c = .5 * (dot(v0, v0) + dot(v1, v1)), bA = .5 * (b0 * A0 + b1 * A1);
          const double by_a = (2. * b * bA - c) * A0 * A1, by_b = -2. * bA * A, by_c = A;
          const double factor = .5 * p.weight * material.bending_stiffness;
          distribute(p.slope, factor * ((2. * by_a) * u + by_b * v), sum, l);
          distribute(p.curvature, (shorter[l] * factor) * (by_b * u + (2. * by_c) * v), sum, l);
        }
    };
    integrate_force(f, integrand);
  }

  double CableElements::smallest_strain(const std::vector<double> &q, double *const place) const
  {
    double least = std::numeric_limits<double>::max(), found = 0.;
    vectorised(
        [this, &q, all_least = &least, all_found = &found]
        {
          double smallest = *all_least, where = 0.;
          const auto compare =
              [&](const double *stretch, const unsigned int size, const double count)
          {
            const double *const shortest = std::min_element(stretch, stretch + size);
            if (size == 0 || !(*shortest < smallest))
              return;
            smallest = *shortest;
            where = this->place(count + (shortest - stretch));
          };
          for (unsigned int first = 0; first <= n; first += ElementBatch::size)
          {
            const ElementBatch x = batch(q, first);
            double stretch[ElementBatch::size];
            if (end_weight != 0.)
            {
#pragma omp simd
              for (unsigned int l = 0; l < ElementBatch::size; ++l)
                stretch[l] = stretch_of(x.derivative(l));
              compare(stretch, std::min(n + 1 - first, ElementBatch::size), first);
            }
            for (const Point &p : inner_axial_points)
            {
#pragma omp simd
              for (unsigned int l = 0; l < ElementBatch::size; ++l)
                stretch[l] = stretch_of(combine(p.slope, x, l));
              compare(stretch, std::min(n - first, ElementBatch::size), first + p.xi);
            }
          }
          *all_least = smallest;
          *all_found = where;
        });
    if (place)
      *place = found;
    return least - 1.;
  }
} // namespace taut
