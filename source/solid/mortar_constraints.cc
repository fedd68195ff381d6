// SPDX-License-Identifier: LGPL-2.1-or-later
#include "solid/mortar_rows.h"
#include "solid/mortar_segments.h"
#include <taut/base/exceptions.h>
#include <taut/solid/contact_constraints.h>

#include <deal.II/lac/full_matrix.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace taut
{
  namespace
  {
    /// Multipliers become linear, because of holes, if the integral of a polynomial of degree 2
    /// over the hull, over the covered length, is below this. The integral is 1/6 on a straight
    /// edge without holes.
    constexpr double small_integral = .02;

    /// Below this, an uncovered part of an edge is none, and so is a covered part: the pressure
    /// changes by as much.
    constexpr double covered = 1e-4;

    using Small = std::array<double, 3>;

    /// A quadrature point of the covered part of a slave edge.
    struct CoverPoint
    {
      FacePoint slave, master;
      std::size_t master_face = 0;
      double weight = 0.; ///< with the measure, of lengths [m]
      double place = 0.;  ///< in the hull of the covered part, 0 to 1
    };

    struct Cover
    {
      std::vector<CoverPoint> points;
      double uncovered = 1.;       ///< part of the reference edge
      double begin = 0., end = 1.; ///< hull on the reference edge
    };

    Cover cover(const SurfaceGeometry &slave, const SurfaceGeometry &master,
                const MortarSegments &finder, const std::size_t face)
    {
      Cover result;
      const std::vector<MortarSegment> segments = finder.segments(face);
      if (segments.empty())
        return result;
      result.begin = segments.front().begin;
      result.end = segments.back().end;
      for (const MortarSegment &s : segments)
      {
        result.uncovered -= s.end - s.begin;
        for (const auto &[t, weight] : gauss_points())
        {
          const double at = s.begin + t * (s.end - s.begin);
          CoverPoint p;
          p.slave = slave.at(face, {at, 0.});
          p.master = master.at(s.master, {finder.project(face, at, s.master), 0.});
          p.master_face = s.master;
          p.weight = weight * (s.end - s.begin) * p.slave.measure();
          p.place = (at - result.begin) / (result.end - result.begin);
          result.points.push_back(p);
        }
      }
      return result;
    }

    /// Functions psi_i on the covered part of an edge, biorthogonal to the Lagrange polynomials L_i
    /// of its hull: int psi_i L_j = delta_ij int L_i. The sum of the psi_i is 1.
    class DualBasis
    {
    public:
      DualBasis(const Cover &cover, const unsigned int wanted_degree) : degree(wanted_degree)
      {
        if (!build(cover))
        {
          degree = 1;
          build(cover);
        }
      }

      unsigned int size() const { return degree + 1; }

      /// psi_i in the order of the nodes of an edge.
      Small values(const double place) const
      {
        const FaceShapes l = face_shapes(FaceForm::line, degree, {place, 0.});
        Small psi{};
        for (unsigned int i = 0; i < size(); ++i)
          for (unsigned int j = 0; j < size(); ++j)
            psi[i] += coefficients[i][j] * l.value[j];
        return psi;
      }

    private:
      /// Returns false if the degree is too high.
      bool build(const Cover &cover)
      {
        dealii::FullMatrix<double> mass(size());
        Small integral{};
        double length = 0.;
        for (const CoverPoint &p : cover.points)
        {
          const FaceShapes l = face_shapes(FaceForm::line, degree, {p.place, 0.});
          length += p.weight;
          for (unsigned int i = 0; i < size(); ++i)
          {
            integral[i] += p.weight * l.value[i];
            for (unsigned int j = 0; j < size(); ++j)
              mass(i, j) += p.weight * l.value[i] * l.value[j];
          }
        }
        for (unsigned int i = 0; i < size(); ++i)
          if (degree == 2 && integral[i] < small_integral * length)
            return false;
        mass.gauss_jordan();
        for (unsigned int i = 0; i < size(); ++i)
          for (unsigned int j = 0; j < size(); ++j)
            coefficients[i][j] = integral[i] * mass(i, j);
        return true;
      }

      unsigned int degree;
      std::array<Small, 3> coefficients{}; ///< of psi_i in the polynomials
    };

    void add_cover(const Cover &cover, const SurfaceGeometry &slave, const SurfaceGeometry &master,
                   const std::size_t face, MortarRows &rows)
    {
      if (cover.points.empty())
        return;
      const DualBasis basis(cover, slave.surface().degree);
      const std::vector<unsigned int> &nodes = slave.nodes(face);
      for (const CoverPoint &p : cover.points)
      {
        const Small psi = basis.values(p.place);
        const Coordinates normal = p.slave.normal();
        for (unsigned int i = 0; i < basis.size(); ++i)
        {
          const double weight = p.weight * psi[i];
          MortarRow &row = rows[nodes[i]];
          if (cover.uncovered > covered && cover.uncovered < 1. - covered)
            row.uncovered = std::max(row.uncovered, cover.uncovered);
          row.area += weight;
          row.gap += weight * dot(p.master.position - p.slave.position, normal);
          row.point = add_scaled(row.point, weight, p.slave.position);
          row.normal = add_scaled(row.normal, weight, normal);
          for (unsigned int j = 0; j < p.slave.shapes.n; ++j)
            row.slave.add(nodes[j], -weight * p.slave.shapes.value[j], normal);
          for (unsigned int j = 0; j < p.master.shapes.n; ++j)
            row.master.add(master.nodes(p.master_face)[j], weight * p.master.shapes.value[j],
                           normal);
        }
      }
      if (cover.end - cover.begin < MortarRows::sliver)
        rows.add_sliver({nodes.begin(), nodes.begin() + basis.size()});
    }
  } // namespace

  std::vector<SurfaceConstraint> mortar_constraints(const ContactSurface &slave,
                                                    const ContactSurface &master,
                                                    const double thickness,
                                                    const double wanted_distance,
                                                    const WholeBoundaries &boundaries)
  {
    const SurfaceGeometry slaves(slave), masters(master);
    check_dimensions(slave, master);
    if (slave.dim != 2)
      throw UserError("contact surfaces '" + slave.name + "' and '" + master.name +
                      "': mortar constraints are for the plane; in space take node-to-face");
    check_thickness(thickness);
    const double distance = search_distance(slaves, masters, wanted_distance);
    const MortarSegments finder(slaves, masters, distance, boundaries);
    MortarRows rows(slave.points.size());
    for (std::size_t face = 0; face < slaves.n_faces(); ++face)
      add_cover(cover(slaves, masters, finder, face), slaves, masters, face, rows);
    rows.merge_slivers();
    std::vector<SurfaceConstraint> constraints = rows.constraints(thickness);
    for (std::size_t face = 0; constraints.empty() && face < slaves.n_faces(); ++face)
      finder.check_overlap(face, .5, true);
    if (constraints.empty())
      complain_about_search(slaves, masters, distance);
    return constraints;
  }
} // namespace taut
