// SPDX-License-Identifier: LGPL-2.1-or-later
#include "wire/element_matrices.h"
#include "wire/wire_discretisation.h"

#include "scene/shared_places.h"
#include "wire/fe_cubic_hermite.h"
#include <taut/base/exceptions.h>

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace taut
{
  namespace
  {
    /// A += factor (f g^T + g f^T), or factor f f^T if f and g are the same object.
    void add_product(const double factor, const LinearForm &f, const LinearForm &g,
                     SymmetricMatrix &A)
    {
      for (std::size_t i = 0; i < f.index.size(); ++i)
        for (std::size_t j = 0; j < g.index.size(); ++j)
        {
          const double value = factor * f.value[i] * g.value[j];
          if (&f != &g)
            A.add(f.index[i], g.index[j], f.index[i] == g.index[j] ? 2. * value : value);
          else if (j <= i)
            A.add(f.index[i], f.index[j], value);
        }
    }

    /// DoFs with their places on the wire [m].
    using PlacedDofs = std::vector<std::pair<unsigned int, double>>;

    /// The i-th DoF of a Hermite element of length h, which has no mass, from the other three.
    void extrapolate_hermite(const PlacedDofs &dofs, const unsigned int i, const double h,
                             const bool keeps_inertia, LinearForm &form)
    {
      if (!keeps_inertia)
      {
        form.add(dofs[(i + 2) % 4].first, 1.);
        return;
      }
      // The parabola through the other three DoFs: w_1 - w_0 = h (slope_0 + slope_1) / 2.
      if (i % 2 == 0)
      {
        form.add(dofs[2 - i].first, 1.);
        form.add(dofs[1].first, i == 0 ? -.5 * h : .5 * h);
        form.add(dofs[3].first, i == 0 ? -.5 * h : .5 * h);
      }
      else
      {
        form.add(dofs[4 - i].first, -1.);
        form.add(dofs[0].first, -2. / h);
        form.add(dofs[2].first, 2. / h);
      }
    }

    /// The displacement at a place from the next DoF with mass, or by Lagrange's polynomial through
    /// all DoFs with mass.
    void extrapolate_lagrange(const PlacedDofs &with_mass, const double at,
                              const bool keeps_inertia, LinearForm &form)
    {
      if (!keeps_inertia)
      {
        const auto is_nearer = [&](const auto &p, const auto &q)
        { return std::fabs(p.second - at) < std::fabs(q.second - at); };
        form.add(std::min_element(with_mass.begin(), with_mass.end(), is_nearer)->first, 1.);
        return;
      }
      for (const auto &[dof, s] : with_mass)
      {
        double value = 1.;
        for (const auto &[other, place] : with_mass)
          if (other != dof)
            value *= (at - place) / (s - place);
        form.add(dof, value);
      }
    }
  } // namespace

  WireComponent::Discretisation::Discretisation(const Wire &wire, const std::vector<double> &nodes,
                                                const bool beam, const unsigned int degree)
      : dof_handler(triangulation), quadrature(beam ? 4 : degree + 1)
  {
    std::vector<dealii::Point<3>> vertices;
    std::vector<dealii::CellData<1>> cells(nodes.size() - 1);
    for (const double s : nodes)
      vertices.emplace_back(wire.at(s).x, wire.at(s).z, wire.at(s).y);
    for (unsigned int i = 0; i < cells.size(); ++i)
      cells[i].vertices = {i, i + 1};
    triangulation.create_triangulation(vertices, cells, dealii::SubCellData());

    if (beam)
      element = std::make_unique<FE_CubicHermite>();
    else
      element = std::make_unique<dealii::FE_Q<1, 3>>(degree);
    dof_handler.distribute_dofs(*element);

    // Number the DoFs along the wire.
    std::vector<dealii::types::global_dof_index> renumbering(dof_handler.n_dofs()),
        dofs(element->n_dofs_per_cell());
    const unsigned int step = beam ? 2 : degree, vertex_dofs = beam ? 2 : 1;
    unsigned int i = 0;
    for (const auto &cell : dof_handler.active_cell_iterators())
    {
      cell->get_dof_indices(dofs);
      for (unsigned int k = 0; k < vertex_dofs; ++k)
      {
        renumbering[dofs[k]] = step * i + k;
        renumbering[dofs[vertex_dofs + k]] = step * (i + 1) + k;
      }
      for (unsigned int k = 2 * vertex_dofs; k < dofs.size(); ++k)
        renumbering[dofs[k]] = step * i + 1 + (k - 2 * vertex_dofs);
      ++i;
    }
    dof_handler.renumber_dofs(renumbering);
  }

  WireComponent::WireComponent(const Scene &scene, const std::size_t wire, const WireMotion motion)
      : WireComponent(scene, wire, motion, grid(scene, wire), 0, grid(scene, wire).size() - 1)
  {
  }

  WireComponent::WireComponent(const Scene &scene, const std::size_t wire_index,
                               const WireMotion motion, const std::vector<double> &grid,
                               const std::size_t first_node, const std::size_t last_node)
      : Substructure(name_of(scene, wire_index, motion), scene.wires[wire_index].origin),
        motion(motion)
  {
    const Wire &wire = scene.wires[wire_index];
    wire_length = grid.back();
    is_last = last_node + 1 == grid.size();
    nodes = {grid.begin() + first_node, grid.begin() + last_node + 1};
    axis = wire.axis(motion);
    beam = motion != WireMotion::axial && wire.transverse == TransverseKind::beam;
    if (beam)
    {
      kinds = {0, 1};
      rotation_axis = wire.rotation_axis(motion);
    }
    bends_freely = beam && wire.tension == 0.;
    is_bedded = motion != WireMotion::axial && wire.foundation_stiffness > 0.;
    degree = beam ? 3 : wire.degree;
    dofs_per_node = beam ? 2 : degree;
    mass_matrix = wire.mass_matrix;
    start = motion == WireMotion::axial        ? wire.axial_start
            : motion == WireMotion::transverse ? wire.transverse_start
                                               : wire.lateral_start;
    discretisation = std::make_unique<Discretisation>(wire, nodes, beam, degree);

    const unsigned int n = dofs_per_node * nodes.size();
    M = make_block_tridiagonal(dofs_per_node, n);
    C = make_block_tridiagonal(dofs_per_node, n);
    K = make_block_tridiagonal(dofs_per_node, n);
    constant_force.assign(n, 0.);
    const double gravity = dot(scene.gravity, axis);
    find_massless_dofs(scene, wire_index);
    assemble(wire);
    add_supports(scene, wire_index);
    add_point_masses(scene, wire_index, gravity);
    add_loads(scene, wire_index, gravity);

    // The block of the last node has no element after it: its inner DoFs do not exist.
    for (unsigned int i = discretisation->dof_handler.n_dofs(); i < n; ++i)
      constrained.push_back({i});
    finish();
  }

  WireComponent::~WireComponent() = default;

  std::unique_ptr<Substructure> make_wire(const Wire &wire, const WireMotion motion,
                                          std::vector<Support> supports,
                                          std::vector<PointMass> point_masses,
                                          std::vector<Load> loads, const Coordinates &gravity)
  {
    Scene scene;
    scene.gravity = gravity;
    scene.wires = {wire};
    scene.supports = std::move(supports);
    scene.point_masses = std::move(point_masses);
    scene.loads = std::move(loads);
    for (Support &support : scene.supports)
      support.wire = 0;
    for (PointMass &mass : scene.point_masses)
      mass.wire = 0;
    for (Load &load : scene.loads)
      load.target = {Attachment::Kind::wire, 0, load.target.position};
    check_values(scene);
    share_places(scene);
    check_wires(scene);
    if (!wire.has(motion))
      throw EntryError(wire.origin, "wire '" + wire.name + "' lacks the motion that is asked for");
    return std::make_unique<WireComponent>(scene, 0, motion);
  }

  std::string WireComponent::name_of(const Scene &scene, const std::size_t wire,
                                     const WireMotion motion)
  {
    return scene.wires[wire].name + " (" + component_name(motion) + ")";
  }

  bool WireComponent::owns(const double s) const
  {
    // Positions closer than rounding are one node, as in the grid.
    const double same = 1e-12 * wire_length;
    return s >= nodes.front() - same && (is_last || s < nodes.back() - same);
  }

  void WireComponent::find_massless_dofs(const Scene &scene, const std::size_t wire)
  {
    for (const Link &link : scene.links)
    {
      if (link.contact_mass == ContactMass::stays || !link.rigid())
        continue;
      if (component(link.direction, link.rotational) == 0.)
        continue;
      for (const Attachment &end : {link.from, link.to})
      {
        if (end.kind != Attachment::Kind::wire || end.index != wire)
          continue;
        // At a node where two pieces meet, each piece has a share of the mass.
        for (std::size_t i = 0; i < nodes.size(); ++i)
          if (std::fabs(nodes[i] - end.position) <= 1e-12 * wire_length)
            massless_dofs[dofs_per_node * i + (link.rotational ? 1 : 0)] = link.origin;
        keeps_inertia = link.contact_mass == ContactMass::keeps_inertia;
      }
    }
  }

  /**
   * Mass redistribution: the DoFs of an element in its kinetic energy. A DoF without mass is
   * extrapolated from its neighbours on the side of the element. If a constant motion is
   * extrapolated exactly, the total mass is kept; if a linear motion is, the centre of mass and the
   * moment of inertia are kept, too (the conditions of H. B. Khenous, P. Laborde, Y. Renard,
   * European Journal of Mechanics A 27 (2008), 918-932). T^T M T is definite on the other DoFs if M
   * is.
   */
  std::vector<LinearForm> WireComponent::inertial_forms(const std::size_t e) const
  {
    const unsigned int n = beam ? 4 : degree + 1;
    const double h = nodes[e + 1] - nodes[e];
    std::vector<LinearForm> forms(n);
    PlacedDofs dofs, with_mass;
    for (unsigned int i = 0; i < n; ++i)
    {
      // Hermite: value and slope at both vertices; otherwise both vertices, then the inner points.
      if (beam)
        dofs.emplace_back(2 * e + i, nodes[e + i / 2]);
      else
        dofs.emplace_back(i == 0   ? degree * e
                          : i == 1 ? degree * (e + 1)
                                   : degree * e + i - 1,
                          nodes[e] + h * discretisation->element->unit_support_point(i)[0]);
      if (massless_dofs.count(dofs[i].first) > 0)
        continue;
      with_mass.push_back(dofs[i]);
      forms[i].add(dofs[i].first, 1.);
    }
    if (with_mass.size() == n)
      return forms;
    if (!beam && keeps_inertia && degree == 1 && with_mass.size() == 1)
    {
      // A line takes two nodes: the other node of the element and the node behind it.
      const bool left = massless_dofs.count(dofs[0].first) > 0;
      const std::size_t behind = left ? e + 2 : e - 1;
      if (behind < nodes.size() && massless_dofs.count(behind) == 0)
        with_mass.emplace_back(behind, nodes[behind]);
    }
    if (beam ? with_mass.size() + 1 < n : with_mass.empty())
      throw EntryError(
          massless_dofs.lower_bound(dofs[0].first)->second,
          "'Mass redistribution' needs an element between two contacts whose nodes can "
          "take their mass; take a smaller Element size");
    for (unsigned int i = 0; i < n; ++i)
      if (massless_dofs.count(dofs[i].first) == 0)
        continue;
      else if (beam)
        extrapolate_hermite(dofs, i, h, keeps_inertia, forms[i]);
      else
        extrapolate_lagrange(with_mass, dofs[i].second, keeps_inertia, forms[i]);
    return forms;
  }

  void WireComponent::assemble(const Wire &wire)
  {
    const bool is_axial = motion == WireMotion::axial;
    ElementMatrices element(wire, beam, degree, *discretisation->element,
                            discretisation->quadrature);
    const unsigned int n = discretisation->element->n_dofs_per_cell();
    std::vector<dealii::types::global_dof_index> dofs(n);
    std::vector<LinearForm> inertial;
    // Elements whose lengths differ by the rounding of their positions alone share their matrices.
    const double rounding = 4. * std::numeric_limits<double>::epsilon() * wire_length;
    const bool is_worn = !wire.remaining.mass.is_zero() ||
                         !wire.remaining.bending_stiffness.is_zero() ||
                         (is_axial && !wire.remaining.axial_stiffness.is_zero());
    double length = -1., stretch = 0.;
    std::size_t e = 0;
    for (const auto &cell : discretisation->dof_handler.active_cell_iterators())
    {
      const double own_length = nodes[e + 1] - nodes[e];
      const double own_stretch =
          is_axial ? wire.axial_stiffness : tension_at(wire, .5 * (nodes[e] + nodes[e + 1]));
      if (is_worn || std::fabs(own_length - length) > rounding || own_stretch != stretch)
      {
        stretch = own_stretch;
        element.compute(cell, nodes[e], stretch,
                        is_axial ? wire.remaining.axial_stiffness : Expression());
        length = own_length;
      }
      cell->get_dof_indices(dofs);
      if (!massless_dofs.empty())
        inertial = inertial_forms(e);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j <= i; ++j)
        {
          if (massless_dofs.empty())
            M->add(dofs[i], dofs[j], element.m(i, j));
          else
            add_product(element.m(i, j), inertial[i], inertial[j], *M);
          K->add(dofs[i], dofs[j], element.k(i, j));
        }
      ++e;
    }
    C->add(wire.damping.mass, *M);
    C->add(wire.damping.stiffness, *K);
    if (!is_axial && (wire.foundation_stiffness != 0. || wire.foundation_damping != 0.))
      add_bedding(wire);
  }

  /// After the damping of the wire itself: that of its bedding is given apart.
  void WireComponent::add_bedding(const Wire &wire)
  {
    ElementMatrices element(wire, beam, degree, *discretisation->element,
                            discretisation->quadrature);
    const unsigned int n = discretisation->element->n_dofs_per_cell();
    std::vector<dealii::types::global_dof_index> dofs(n);
    for (const auto &cell : discretisation->dof_handler.active_cell_iterators())
    {
      element.compute(cell, 0., 0.);
      cell->get_dof_indices(dofs);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j <= i; ++j)
        {
          K->add(dofs[i], dofs[j], wire.foundation_stiffness * element.bedding(i, j));
          C->add(dofs[i], dofs[j], wire.foundation_damping * element.bedding(i, j));
        }
    }
  }
} // namespace taut
