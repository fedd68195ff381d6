// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/substructure/fe_hermite.h>
#include <taut/substructure/hermite_shape.h>
#include <taut/substructure/wire_component.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <cmath>

namespace taut
{
  namespace
  {
    /// A += factor (f g^T + g f^T), or factor f f^T if f and g are the same object.
    void add_product(const double factor, const SparseVector &f, const SparseVector &g,
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
  } // namespace

  struct WireComponent::Discretisation
  {
    dealii::Triangulation<1, 3> triangulation;
    std::unique_ptr<dealii::FiniteElement<1, 3>> element;
    dealii::DoFHandler<1, 3> dof_handler;
    dealii::QGauss<1> quadrature{1};

    Discretisation(const Wire &wire, const std::vector<double> &nodes, bool beam,
                   unsigned int degree);
  };

  WireComponent::Discretisation::Discretisation(const Wire &wire, const std::vector<double> &nodes,
                                                const bool beam, const unsigned int degree)
      : dof_handler(triangulation), quadrature(beam ? 4 : degree + 1)
  {
    std::vector<dealii::Point<3>> vertices;
    std::vector<dealii::CellData<1>> cells(nodes.size() - 1);
    for (const double s : nodes)
      vertices.emplace_back(wire.at(s).x, 0., wire.at(s).y);
    for (unsigned int i = 0; i < cells.size(); ++i)
      cells[i].vertices = {i, i + 1};
    triangulation.create_triangulation(vertices, cells, dealii::SubCellData());

    if (beam)
      element = std::make_unique<FE_Hermite<1, 3>>();
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
    axis = motion == WireMotion::axial ? wire.tangent() : wire.normal();
    beam = motion == WireMotion::transverse && wire.transverse == TransverseKind::beam;
    if (beam)
      kinds = {0, 1};
    bends_freely = beam && wire.tension == 0.;
    degree = beam ? 3 : wire.degree;
    dofs_per_node = beam ? 2 : degree;
    start = motion == WireMotion::axial ? wire.axial_start : wire.transverse_start;
    discretisation = std::make_unique<Discretisation>(wire, nodes, beam, degree);

    const unsigned int n = dofs_per_node * nodes.size();
    M = make_block_tridiagonal(dofs_per_node, n);
    C = make_block_tridiagonal(dofs_per_node, n);
    K = make_block_tridiagonal(dofs_per_node, n);
    constant_force.assign(n, 0.);
    const double gravity = scene.gravity.x * axis.x + scene.gravity.y * axis.y;
    find_massless_dofs(scene, wire_index);
    assemble(wire);
    add_supports(scene, wire_index);
    add_point_masses(scene, wire_index, gravity);
    add_loads(scene, wire_index, gravity);

    // The block of the last node has no element after it: its inner DoFs do not exist.
    for (unsigned int i = discretisation->dof_handler.n_dofs(); i < n; ++i)
      constrained.push_back({i, Expression()});
    finish_constraints();
  }

  WireComponent::~WireComponent() = default;

  std::string WireComponent::name_of(const Scene &scene, const std::size_t wire,
                                     const WireMotion motion)
  {
    return scene.wires[wire].name + (motion == WireMotion::axial ? " (axial)" : " (transverse)");
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
      if (!link.massless || !link.unilateral() || !link.rigid() || link.moving())
        continue;
      if (link.rotational ? !beam : component(link.direction) == 0.)
        continue;
      for (const Attachment &end : {link.from, link.to})
      {
        if (end.kind != Attachment::Kind::wire || end.index != wire)
          continue;
        // Where two pieces meet, both have a share of the mass.
        for (std::size_t i = 0; i < nodes.size(); ++i)
          if (std::fabs(nodes[i] - end.position) <= 1e-12 * wire_length)
            massless_dofs[dofs_per_node * i + (link.rotational ? 1 : 0)] = link.origin;
      }
    }
  }

  /**
   * The DoFs of an element as the kinetic energy sees them: a DoF without mass is extrapolated from
   * its neighbours on the element's side. A linear motion is extrapolated exactly, so that the
   * total mass, its centre and its moment of inertia stay (H. B. Khenous, P. Laborde, Y. Renard,
   * European Journal of Mechanics A 27 (2008), 918-932, state these conditions), and T^T M T is
   * definite on the other DoFs whatever the element.
   */
  std::vector<SparseVector> WireComponent::inertial_forms(const std::size_t e) const
  {
    const unsigned int n = beam ? 4 : degree + 1;
    const double h = nodes[e + 1] - nodes[e];
    std::vector<unsigned int> dofs(n), with_mass;
    std::vector<double> places(n);
    for (unsigned int i = 0; i < n; ++i)
    {
      // Hermite: value and slope at both vertices; otherwise both vertices, then the inner points.
      dofs[i] = beam     ? 2 * e + i
                : i == 0 ? degree * e
                : i == 1 ? degree * (e + 1)
                         : degree * e + i - 1;
      if (!beam)
        places[i] = nodes[e] + h * discretisation->element->unit_support_point(i)[0];
      if (massless_dofs.count(dofs[i]) == 0)
        with_mass.push_back(i);
    }
    std::vector<SparseVector> forms(n);
    for (const unsigned int i : with_mass)
      forms[i].add(dofs[i], 1.);
    if (with_mass.size() == n)
      return forms;

    const auto fail = [&]()
    {
      throw EntryError(massless_dofs.lower_bound(dofs[0])->second,
                       "'Massless contact' needs an element between two contacts whose nodes can "
                       "take their mass; take a smaller Element size");
    };
    if (beam)
    {
      if (with_mass.size() + 1 < n)
        fail();
      for (unsigned int i = 0; i < n; ++i)
        if (massless_dofs.count(dofs[i]) > 0)
        {
          // The parabola through the other three: w_1 - w_0 = h (slope_0 + slope_1) / 2.
          const unsigned int other = i % 2 == 0 ? 2 - i : 4 - i;
          const double sign = i == 0 ? -.5 * h : .5 * h;
          if (i % 2 == 0)
          {
            forms[i].add(dofs[other], 1.);
            forms[i].add(dofs[1], sign);
            forms[i].add(dofs[3], sign);
          }
          else
          {
            forms[i].add(dofs[other], -1.);
            forms[i].add(dofs[0], -2. / h);
            forms[i].add(dofs[2], 2. / h);
          }
        }
      return forms;
    }

    // Lagrange's polynomial through the DoFs with mass; of a linear element these are its other
    // node and the one behind it.
    std::vector<std::pair<unsigned int, double>> support;
    for (const unsigned int i : with_mass)
      support.emplace_back(dofs[i], places[i]);
    if (degree == 1 && with_mass.size() == 1)
    {
      const bool left = massless_dofs.count(dofs[0]) > 0;
      const std::size_t behind = left ? e + 2 : e - 1;
      if (behind < nodes.size() && massless_dofs.count(behind) == 0)
        support.emplace_back(behind, nodes[behind]);
    }
    if (support.empty())
      fail();
    for (unsigned int i = 0; i < n; ++i)
      if (massless_dofs.count(dofs[i]) > 0)
        for (const auto &[dof, s] : support)
        {
          double value = 1.;
          for (const auto &[other, place] : support)
            if (other != dof)
              value *= (places[i] - place) / (s - place);
          forms[i].add(dof, value);
        }
    return forms;
  }

  void WireComponent::assemble(const Wire &wire)
  {
    const bool axial = motion == WireMotion::axial;
    const double stretch = axial ? wire.axial_stiffness : wire.tension;
    dealii::FEValues<1, 3> values(*discretisation->element, discretisation->quadrature,
                                  dealii::update_values | dealii::update_gradients |
                                      (beam ? dealii::update_hessians : dealii::update_default) |
                                      dealii::update_JxW_values);
    const unsigned int n = discretisation->element->n_dofs_per_cell();
    std::vector<dealii::types::global_dof_index> dofs(n);
    std::vector<SparseVector> inertial;
    std::size_t e = 0;
    for (const auto &cell : discretisation->dof_handler.active_cell_iterators())
    {
      values.reinit(cell);
      cell->get_dof_indices(dofs);
      if (!massless_dofs.empty())
        inertial = inertial_forms(e++);
      const dealii::Tensor<1, 3> t = (cell->vertex(1) - cell->vertex(0)) / cell->diameter();
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j <= i; ++j)
        {
          double m = 0., k = 0.;
          for (const unsigned int q : values.quadrature_point_indices())
          {
            const double JxW = values.JxW(q);
            m += values.shape_value(i, q) * values.shape_value(j, q) * JxW;
            k += stretch * (values.shape_grad(i, q) * t) * (values.shape_grad(j, q) * t) * JxW;
            if (beam)
              k += wire.bending_stiffness * (t * values.shape_hessian(i, q) * t) *
                   (t * values.shape_hessian(j, q) * t) * JxW;
          }
          if (massless_dofs.empty())
            M->add(dofs[i], dofs[j], wire.mass_per_length * m);
          else
            add_product(wire.mass_per_length * m, inertial[i], inertial[j], *M);
          K->add(dofs[i], dofs[j], k);
        }
    }
    C->add(wire.damping.mass, *M);
    C->add(wire.damping.stiffness, *K);
  }

  void WireComponent::add_supports(const Scene &scene, const std::size_t wire)
  {
    SparseVector row;
    for (const Support &support : scene.supports)
    {
      const bool mine = motion == WireMotion::axial ? support.motion == WireMotion::axial
                                                    : support.motion != WireMotion::axial;
      if (support.wire != wire || !mine)
        continue;
      const unsigned int offset = support.motion == WireMotion::slope ? 1 : 0;
      for (const double s : support.positions)
      {
        if (!owns(s))
          continue;
        const auto node = std::min_element(nodes.begin(), nodes.end(),
                                           [s](const double p, const double q)
                                           { return std::fabs(p - s) < std::fabs(q - s); });
        const unsigned int dof = dofs_per_node * (node - nodes.begin()) + offset;
        if (support.fixed)
          constrained.push_back({dof, support.prescribed});
        else
        {
          K->add(dof, dof, support.stiffness);
          C->add(dof, dof, support.damping);
          if (support.stiffness > 0.)
            sprung_dofs.push_back(dof);
        }
      }
    }
  }

  void WireComponent::add_point_masses(const Scene &scene, const std::size_t wire,
                                       const double gravity)
  {
    SparseVector row;
    for (const PointMass &mass : scene.point_masses)
      if (mass.wire == wire)
        for (const double s : mass.positions)
        {
          if (!owns(s))
            continue;
          value_at(s, row);
          for (std::size_t i = 0; i < row.index.size(); ++i)
            for (std::size_t j = 0; j <= i; ++j)
              M->add(row.index[i], row.index[j], mass.mass * row.value[i] * row.value[j]);
          if (mass.weight)
            row.add_to(mass.mass * gravity, constant_force);
        }
  }

  double WireComponent::component(const Point &direction) const
  {
    return direction.x * axis.x + direction.y * axis.y;
  }

  /// A force per length f(s, t), integrated with the rule of the element at each call.
  class WireComponent::DistributedLoad : public TimeLoad
  {
  public:
    struct QuadraturePoint
    {
      double s;
      SparseVector shape; ///< weighted
    };

    DistributedLoad(const WireComponent &wire, const double factor, const Expression &magnitude)
        : magnitude(magnitude)
    {
      const dealii::QGauss<1> rule(4);
      for (std::size_t e = 0; e + 1 < wire.nodes.size(); ++e)
        for (unsigned int q = 0; q < rule.size(); ++q)
        {
          const double h = wire.nodes[e + 1] - wire.nodes[e];
          QuadraturePoint point;
          point.s = wire.nodes[e] + h * rule.point(q)[0];
          wire.value_at(point.s, point.shape);
          for (double &v : point.shape.value)
            v *= factor * h * rule.weight(q);
          points.push_back(std::move(point));
        }
    }

    void add(const double t, std::vector<double> &P) const override
    {
      for (const QuadraturePoint &point : points)
        point.shape.add_to(magnitude(point.s, t), P);
    }

  private:
    Expression magnitude;
    std::vector<QuadraturePoint> points;
  };

  /// A point force that travels; it acts while it is on the wire.
  class WireComponent::MovingLoad : public TimeLoad
  {
  public:
    MovingLoad(const WireComponent &wire, const Load &load, const double factor)
        : wire(wire), load(load), factor(factor)
    {
    }

    void add(const double t, std::vector<double> &P) const override
    {
      const double s = load.target.position + load.speed * t;
      if (s < 0. || s > wire.wire_length || !wire.owns(s))
        return;
      SparseVector shape;
      if (load.rotational)
        wire.slope_at(s, shape);
      else
        wire.value_at(s, shape);
      shape.add_to(factor * load.magnitude(s, t), P);
    }

  private:
    const WireComponent &wire;
    Load load;
    double factor;
  };

  void WireComponent::add_loads(const Scene &scene, const std::size_t wire, const double gravity)
  {
    if (scene.wires[wire].weight && gravity != 0.)
      DistributedLoad(*this, scene.wires[wire].mass_per_length * gravity, Expression(1.))
          .add(0., constant_force);

    for (const Load &load : scene.loads)
    {
      if (load.target.kind != Attachment::Kind::wire || load.target.index != wire)
        continue;
      if (load.rotational && motion == WireMotion::axial)
        continue;
      if (load.kind == Load::Kind::point && !owns(load.target.position))
        continue;
      const double factor = load.rotational ? 1. : component(load.direction);
      if (factor == 0.)
        continue;
      if (load.kind == Load::Kind::moving)
        time_loads.push_back(std::make_unique<MovingLoad>(*this, load, factor));
      else
      {
        std::unique_ptr<TimeLoad> force;
        if (load.kind == Load::Kind::distributed)
          force = std::make_unique<DistributedLoad>(*this, factor, load.magnitude);
        else
        {
          SparseVector shape;
          evaluate(load.target.position, load.rotational, shape);
          for (double &v : shape.value)
            v *= factor;
          force = std::make_unique<PointLoad>(shape, load.magnitude, load.target.position);
        }
        if (load.magnitude.depends_on_time())
          time_loads.push_back(std::move(force));
        else
          force->add(0., constant_force);
      }
    }
  }

  void WireComponent::evaluate(const double s, const bool slope, SparseVector &result) const
  {
    const auto after = std::upper_bound(nodes.begin(), nodes.end(), s);
    const auto e = std::min<std::ptrdiff_t>(std::max<std::ptrdiff_t>(after - nodes.begin() - 1, 0),
                                            nodes.size() - 2);
    const double h = nodes[e + 1] - nodes[e], xi = (s - nodes[e]) / h;
    result.index.clear();
    result.value.clear();
    if (beam)
    {
      const HermiteShape shape = hermite_shape(h, xi);
      for (unsigned int i = 0; i < 4; ++i)
        result.add(2 * e + i, slope ? shape.slope[i] : shape.value[i]);
      return;
    }
    // Element order of deal.II: both vertices, then the inner points.
    const auto &element = *discretisation->element;
    for (unsigned int i = 0; i <= degree; ++i)
    {
      const unsigned int dof = i == 0 ? degree * e : i == 1 ? degree * (e + 1) : degree * e + i - 1;
      const dealii::Point<1> x(xi);
      result.add(dof, slope ? element.shape_grad(i, x)[0] / h : element.shape_value(i, x));
    }
  }

  void WireComponent::value_at(const double s, SparseVector &result) const
  {
    evaluate(s, false, result);
  }

  void WireComponent::slope_at(const double s, SparseVector &result) const
  {
    evaluate(s, true, result);
  }

  void WireComponent::interpolate(const Expression &f, std::vector<double> &U) const
  {
    U.assign(n_dofs(), 0.);
    if (f.is_zero())
      return;
    const double delta = 1e-5 * wire_length;
    for (std::size_t i = 0; i < nodes.size(); ++i)
    {
      const double s = nodes[i];
      U[dofs_per_node * i] = f(s, 0.);
      if (beam)
      {
        // The slope from a central difference inside the wire: second order in 1e-5 of the length.
        const double left = std::max(0., s - delta), right = std::min(wire_length, s + delta);
        U[2 * i + 1] = (f(right, 0.) - f(left, 0.)) / (right - left);
        if (left == 0. && s == 0.)
          U[2 * i + 1] = (-3. * f(0., 0.) + 4. * f(delta, 0.) - f(2. * delta, 0.)) / (2. * delta);
        if (right == wire_length && s == wire_length)
          U[2 * i + 1] =
              (3. * f(s, 0.) - 4. * f(s - delta, 0.) + f(s - 2. * delta, 0.)) / (2. * delta);
      }
      else if (i + 1 < nodes.size())
        for (unsigned int k = 1; k < degree; ++k)
        {
          const double xi = discretisation->element->unit_support_point(k + 1)[0];
          U[degree * i + k] = f(s + xi * (nodes[i + 1] - s), 0.);
        }
    }
  }

  void WireComponent::initial_state(std::vector<double> &U, std::vector<double> &V) const
  {
    interpolate(start.displacement, U);
    interpolate(start.velocity, V);
  }

  Substructure::Kernel WireComponent::kernel() const
  {
    // Rigid motions q0 + q1 (s - middle)/(L/2) that cost nothing: q1 only for a beam without
    // tension. Each held DoF of the supports is one condition on (q0, q1).
    const double half = .5 * (nodes.back() - nodes.front()), middle = nodes.front() + half;
    const unsigned int n_rigid = bends_freely ? 2 : 1;
    std::vector<std::pair<double, double>> conditions;
    const auto hold = [&](const unsigned int dof)
    {
      const double s = nodes[dof / dofs_per_node];
      if (beam && dof % 2 == 1)
        conditions.emplace_back(0., 1.);
      else
        conditions.emplace_back(1., (s - middle) / half);
    };
    for (const ConstrainedDof &constraint : constrained)
      if (constraint.dof < discretisation->dof_handler.n_dofs())
        hold(constraint.dof);
    for (const unsigned int dof : sprung_dofs)
      hold(dof);

    Kernel kernel;
    const unsigned int last = dofs_per_node * (nodes.size() - 1);
    const auto add = [&](const double q0, const double q1, const unsigned int dof)
    {
      std::vector<double> R(n_dofs(), 0.);
      for (std::size_t i = 0; i < nodes.size(); ++i)
      {
        R[dofs_per_node * i] = q0 + q1 * (nodes[i] - middle) / half;
        if (beam)
          R[2 * i + 1] = q1 / half;
        else if (i + 1 < nodes.size())
          for (unsigned int k = 1; k < degree; ++k)
            R[degree * i + k] = q0;
      }
      kernel.vectors.push_back(std::move(R));
      kernel.fixing_dofs.push_back(dof);
    };

    if (n_rigid == 1)
    {
      const bool held = std::any_of(conditions.begin(), conditions.end(),
                                    [](const auto &c) { return c.first != 0.; });
      if (!held)
        add(1., 0., 0);
      return kernel;
    }
    if (conditions.empty())
    {
      add(.5, -.5, 0);
      add(.5, .5, last);
      return kernel;
    }
    // One independent condition leaves the motion orthogonal to it; a second one leaves none.
    const auto [c0, c1] = conditions.front();
    const bool held =
        std::any_of(conditions.begin(), conditions.end(),
                    [&](const auto &c) { return std::fabs(c0 * c.second - c1 * c.first) > 1e-12; });
    if (!held)
      add(-c1, c0, std::fabs(-c1 - c0) > std::fabs(-c1 + c0) ? 0 : last);
    return kernel;
  }
} // namespace taut
