// SPDX-License-Identifier: LGPL-2.1-or-later What makes straight pieces of a cable give way.
#include "cable/end_frames.h"

#include <taut/cable/cable.h>

#include <algorithm>
#include <cmath>

namespace taut
{
  namespace
  {
    /// Places in an element at which directions are compared [1].
    constexpr double samples[] = {.25, .75};

    /// Angle of directions that count as the same, above rounding and below what a disturbance
    /// leaves after some steps [rad].
    constexpr double parallel = 1e-6;

    /// The part of the compression that a disturbance takes away at most, as crooked elements are
    /// longer than straight ones.
    constexpr double part_of_compression = .1;

    /// Direction across a line: in the plane of x and y, unless the line is along z.
    Coordinates across(const Coordinates &line)
    {
      constexpr double along_z = 1e-6;
      const double in_plane = std::hypot(line.x, line.y);
      return in_plane > along_z * norm(line) ? Coordinates{-line.y / in_plane, line.x / in_plane}
                                             : Coordinates{1.};
    }
  } // namespace

  void Cable::find_pieces()
  {
    const double same = 1e-6 * element.shortest_element();
    for (unsigned int i = 0; i <= element.n_elements(); ++i)
      if (i == 0 || i == element.n_elements() ||
          std::any_of(data.places.begin(), data.places.end(),
                      [&](const double s) { return std::fabs(s - element.place(i)) <= same; }))
        piece_ends.push_back(i);
  }

  /// True if an element of the piece is under more than the least Euler load of the cable, that
  /// with one end clamped.
  bool Cable::pushes(const std::vector<double> &q, const unsigned int piece) const
  {
    const double euler = data.section.bending_stiffness * std::pow(.5 * M_PI / data.length, 2),
                 borne = std::max(euler, rounding_of_force(0));
    for (unsigned int e = piece_ends[piece]; e < piece_ends[piece + 1]; ++e)
      if (element.tension(q, element.place(e + .5)) < -borne)
        return true;
    return false;
  }

  /// True if all directions are the same.
  bool Cable::is_straight(const std::vector<double> &q, const unsigned int piece) const
  {
    const Coordinates first = element.tangent(q, element.place(piece_ends[piece] + samples[0]));
    for (unsigned int e = piece_ends[piece]; e < piece_ends[piece + 1]; ++e)
      for (const double at : samples)
      {
        const Coordinates r = element.tangent(q, element.place(e + at));
        const Coordinates twist = {first.y * r.z - first.z * r.y, first.z * r.x - first.x * r.z,
                                   first.x * r.y - first.y * r.x};
        if (!(norm(twist) <= parallel * norm(first) * norm(r)))
          return false;
      }
    return true;
  }

  void Cable::disturb(std::vector<double> &U) const
  {
    if (is_linear() || data.disturbance == 0.)
      return;
    set_positions(U, work);
    const double strain = element.smallest_strain(work);
    if (!(strain * data.section.axial_stiffness < -rounding_of_force(0)))
      return;
    const double size =
        std::min(data.disturbance * data.length,
                 .5 * element.shortest_element() * std::sqrt(-2. * part_of_compression * strain));
    constexpr unsigned int irregular = 7, range = 13, dofs_per_node = CableElements::dofs_per_node;
    std::vector<double> &aside = work_0;
    aside.assign(U.size(), 0.);
    for (unsigned int piece = 0; piece + 1 < piece_ends.size(); ++piece)
    {
      if (!pushes(work, piece) || !is_straight(work, piece))
        continue;
      const unsigned int first = piece_ends[piece], last = piece_ends[piece + 1];
      const Coordinates line = element.tangent(work, element.place(first + samples[0])),
                        way = add_scaled({}, size, across(line));
      const auto move = [&](const unsigned int dof, const double part)
      {
        const double to_and_fro = 2. * (irregular * dof * dof % range) / (range - 1.) - 1.;
        for (unsigned int c = 0; c < 3; ++c)
          aside[dof + c] = part * to_and_fro * way[c];
      };
      for (unsigned int i = first; i <= last; ++i)
      {
        if (i > first && i < last)
          move(dofs_per_node * i, 1.);
        if (data.element == CableElement::ancf)
          move(dofs_per_node * i + 3, 1. / element.element_length());
        else if (i < last)
          move(dofs_per_node * i + 3, 1.);
      }
    }
    frames->turn(aside);
    for (std::size_t i = 0; i < U.size(); ++i)
      U[i] += aside[i];
  }
} // namespace taut
