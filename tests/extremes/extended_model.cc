// SPDX-License-Identifier: LGPL-2.1-or-later
// The matrices of a small scene in extended precision, independent of those of the library.
#include "extended_model.h"

namespace extremes
{
  namespace
  {
    using Polynomial = std::vector<Number>; ///< coefficients of 1, xi, xi^2, ...

    Polynomial derivative(const Polynomial &p)
    {
      Polynomial d;
      for (std::size_t k = 1; k < p.size(); ++k)
        d.push_back(Number(k) * p[k]);
      return d;
    }

    Number value(const Polynomial &p, const Number &xi)
    {
      Number sum = 0;
      for (std::size_t k = p.size(); k-- > 0;)
        sum = sum * xi + p[k];
      return sum;
    }

    Number integral(const Polynomial &p, const Polynomial &q)
    {
      Number sum = 0;
      for (std::size_t i = 0; i < p.size(); ++i)
        for (std::size_t j = 0; j < q.size(); ++j)
          sum += p[i] * q[j] / Number(i + j + 1);
      return sum;
    }

    /// On a cell of length h: degree 1 and 2 in the order along the wire, 3 is Hermite's.
    std::vector<Polynomial> shapes(const unsigned int degree, const Number &h)
    {
      if (degree == 1)
        return {{1, -1}, {0, 1}};
      if (degree == 2)
        return {{1, -3, 2}, {0, 4, -4}, {0, -1, 2}};
      if (degree == 3)
        return {{1, 0, -3, 2}, {0, h, -2 * h, h}, {0, 0, 3, -2}, {0, 0, -h, h}};
      throw std::logic_error("the extended model has elements of degree 1, 2 and Hermite's");
    }

    /// Of the plane.
    Number product(const taut::Coordinates &a, const taut::Coordinates &b)
    {
      return Number(a.x) * Number(b.x) + Number(a.y) * Number(b.y);
    }

    void scale(Form &form, const Number &factor)
    {
      for (auto &entry : form)
        entry.second *= factor;
    }

    double constant_value(const taut::Expression &f)
    {
      if (f.depends_on_time())
        throw std::logic_error("expressions of the extended model are constants");
      return f(0., 0.);
    }
  } // namespace

  Vector Matrix::times(const Vector &x) const
  {
    Vector y(Number(0), n);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        if (entries[i * n + j] != 0)
          y[i] += entries[i * n + j] * x[j];
    return y;
  }

  bool Cholesky::factor(const Matrix &A)
  {
    n = A.size();
    L = Matrix(n);
    inverse_pivot.resize(n);
    const Number smallest("1e-80");
    for (std::size_t j = 0; j < n; ++j)
    {
      for (std::size_t k = 0; k < j; ++k)
      {
        Number sum = A(j, k);
        for (std::size_t l = 0; l < k; ++l)
          if (L(j, l) != 0 && L(k, l) != 0)
            sum -= L(j, l) * L(k, l);
        L(j, k) = sum * inverse_pivot[k];
      }
      Number pivot = A(j, j);
      for (std::size_t l = 0; l < j; ++l)
        pivot -= L(j, l) * L(j, l);
      if (!(pivot > smallest * A(j, j)))
        return false;
      L(j, j) = sqrt(pivot);
      inverse_pivot[j] = 1 / L(j, j);
    }
    return true;
  }

  Vector Cholesky::solve(Vector b) const
  {
    for (std::size_t i = 0; i < n; ++i)
    {
      for (std::size_t k = 0; k < i; ++k)
        if (L(i, k) != 0)
          b[i] -= L(i, k) * b[k];
      b[i] *= inverse_pivot[i];
    }
    for (std::size_t i = n; i-- > 0;)
    {
      b[i] *= inverse_pivot[i];
      for (std::size_t k = 0; k < i; ++k)
        if (L(i, k) != 0)
          b[k] -= L(i, k) * b[i];
    }
    return b;
  }

  Number dot(const Form &form, const Vector &x)
  {
    Number sum = 0;
    for (const auto &[i, v] : form)
      sum += v * x[i];
    return sum;
  }

  Number dot(const Vector &x, const Vector &y)
  {
    return std::inner_product(begin(x), end(x), begin(y), Number(0));
  }

  void ExtendedModel::resize(const std::size_t n_dofs)
  {
    M = C = K = Matrix(n_dofs);
    held.assign(n_dofs, 0);
    is_rotation.assign(n_dofs, 0);
    given = initial_U = initial_V = Vector(Number(0), n_dofs);
  }

  bool ExtendedModel::is_zero_row(const Matrix &matrix, const std::size_t i)
  {
    for (std::size_t j = 0; j < matrix.size(); ++j)
      if (matrix(i, j) != 0)
        return false;
    return true;
  }

  ExtendedWires::ExtendedWires(const taut::Scene &scene)
      : scene(scene), axial(scene.wires.size()), transverse(scene.wires.size())
  {
    for (std::size_t w = 0; w < scene.wires.size(); ++w)
    {
      nodes.push_back(grid(scene, w));
      const std::size_t n_elements = nodes[w].size() - 1;
      const taut::Wire &wire = scene.wires[w];
      axial[w].axial = true;
      axial[w].exists = wire.has_axial;
      axial[w].degree = wire.degree;
      transverse[w].exists = wire.transverse != taut::TransverseKind::none;
      transverse[w].degree = wire.transverse == taut::TransverseKind::beam ? 3 : wire.degree;
      for (Component *c : {&axial[w], &transverse[w]})
        if (c->exists)
        {
          c->first = n;
          n += c->degree == 3 ? 2 * (n_elements + 1) : c->degree * n_elements + 1;
        }
    }
    for (const taut::Mass &mass : scene.masses)
    {
      first_of_mass.push_back(n);
      for (const bool moves : mass.moves)
        n += moves;
    }
    resize(n);
    constant = Vector(Number(0), n);
    for (std::size_t w = 0; w < scene.wires.size(); ++w)
      for (Component *c : {&axial[w], &transverse[w]})
        if (c->exists)
          add_component(w, *c);
    add_masses();
  }

  Form ExtendedWires::shape(const std::size_t wire, const Component &component, const Number &s,
                            const bool slope) const
  {
    const std::vector<double> &x = nodes[wire];
    std::size_t e = 0;
    while (e + 2 < x.size() && Number(x[e + 1]) <= s)
      ++e;
    const Number h = Number(x[e + 1]) - Number(x[e]), xi = (s - Number(x[e])) / h;
    const std::vector<Polynomial> all = shapes(component.degree, h);
    Form form;
    for (unsigned int i = 0; i < all.size(); ++i)
      form.emplace_back(component.dof(e, i),
                        slope ? value(derivative(all[i]), xi) / h : value(all[i], xi));
    return form;
  }

  void ExtendedWires::add_component(const std::size_t w, Component &component)
  {
    const taut::Wire &wire = scene.wires[w];
    const taut::Coordinates axis = component.axial ? wire.tangent() : wire.normal();
    const Number gravity = product(scene.gravity, axis),
                 stretch = component.axial ? wire.axial_stiffness : wire.tension;
    const bool beam = component.degree == 3;
    const taut::InitialMotion &start = component.axial ? wire.axial_start : wire.transverse_start;
    const double u0 = constant_value(start.displacement), v0 = constant_value(start.velocity);
    for (std::size_t e = 0; e + 1 < nodes[w].size(); ++e)
    {
      const Number h = Number(nodes[w][e + 1]) - Number(nodes[w][e]);
      const std::vector<Polynomial> all = shapes(component.degree, h);
      for (unsigned int i = 0; i < all.size(); ++i)
      {
        const std::size_t r = component.dof(e, i);
        is_rotation[r] = beam && i % 2 == 1;
        initial_U[r] = is_rotation[r] ? 0. : u0;
        initial_V[r] = is_rotation[r] ? 0. : v0;
        if (wire.weight)
          constant[r] += Number(wire.mass_per_length) * gravity * h * integral(all[i], {1});
        for (const taut::Load &load : scene.loads)
          if (load.kind == taut::Load::Kind::distributed && load.target.index == w)
            constant[r] += Number(constant_value(load.magnitude)) * product(load.direction, axis) *
                           h * integral(all[i], {1});
        for (unsigned int j = 0; j < all.size(); ++j)
        {
          const std::size_t c = component.dof(e, j);
          const Polynomial di = derivative(all[i]), dj = derivative(all[j]);
          const Number m = Number(wire.mass_per_length) * h * integral(all[i], all[j]);
          Number k = stretch / h * integral(di, dj);
          if (beam)
            k += Number(wire.bending_stiffness) / (h * h * h) *
                 integral(derivative(di), derivative(dj));
          M(r, c) += m;
          K(r, c) += k;
          C(r, c) += Number(wire.damping.mass) * m + Number(wire.damping.stiffness) * k;
        }
      }
    }
    for (const taut::Support &support : scene.supports)
    {
      if (support.wire != w || (support.motion == taut::WireMotion::axial) != component.axial)
        continue;
      for (const double s : support.positions)
      {
        // A node: the shape function that is one there.
        const Form form = shape(w, component, s, support.motion == taut::WireMotion::slope);
        const auto less = [](const auto &p, const auto &q) { return p.second < q.second; };
        const std::size_t dof = std::max_element(form.begin(), form.end(), less)->first;
        held[dof] = held[dof] || support.fixed;
        if (support.fixed)
          given[dof] = constant_value(support.prescribed);
        else
        {
          K(dof, dof) += support.stiffness;
          C(dof, dof) += support.damping;
        }
      }
    }
    for (const taut::PointMass &mass : scene.point_masses)
      if (mass.wire == w)
        for (const double s : mass.positions)
        {
          const Form form = shape(w, component, s, false);
          for (const auto &[i, vi] : form)
          {
            for (const auto &[j, vj] : form)
              M(i, j) += Number(mass.mass) * vi * vj;
            if (mass.weight)
              constant[i] += Number(mass.mass) * gravity * vi;
          }
        }
  }

  void ExtendedWires::add_masses()
  {
    for (std::size_t m = 0; m < scene.masses.size(); ++m)
    {
      const taut::Mass &mass = scene.masses[m];
      std::size_t i = first_of_mass[m];
      for (unsigned int motion = 0; motion < 3; ++motion)
        if (mass.moves[motion])
        {
          is_rotation[i] = motion == 2;
          M(i, i) += motion == 2 ? mass.inertia : mass.mass;
          if (mass.weight && motion < 2)
            constant[i] +=
                Number(mass.mass) * Number(motion == 0 ? scene.gravity.x : scene.gravity.y);
          initial_U[i] = mass.displacement[motion];
          initial_V[i] = mass.velocity[motion];
          ++i;
        }
    }
    for (const taut::Spring &spring : scene.springs)
    {
      Form form;
      for (const std::size_t end : {spring.from, spring.to})
        if (end != taut::ground)
          for (const auto &[i, v] :
               motion({taut::Attachment::Kind::mass, end, 0.}, spring.rotational, spring.direction))
            form.emplace_back(i, end == spring.to ? v : -v);
      for (const auto &[i, vi] : form)
        for (const auto &[j, vj] : form)
        {
          K(i, j) += Number(spring.stiffness) * vi * vj;
          C(i, j) += Number(spring.damping) * vi * vj;
        }
    }
  }

  Form ExtendedWires::motion(const taut::Attachment &point, const bool rotational,
                             const taut::Coordinates &direction) const
  {
    Form form;
    if (point.kind == taut::Attachment::Kind::mass)
    {
      std::size_t i = first_of_mass[point.index];
      const double factor[3] = {rotational ? 0. : direction.x, rotational ? 0. : direction.y,
                                rotational ? 1. : 0.};
      for (unsigned int m = 0; m < 3; ++m)
        if (scene.masses[point.index].moves[m])
          form.emplace_back(i++, Number(factor[m]));
    }
    else if (point.kind == taut::Attachment::Kind::wire)
      for (const Component *c : {&axial[point.index], &transverse[point.index]})
      {
        if (!c->exists || (rotational && c->axial))
          continue;
        const taut::Wire &wire = scene.wires[point.index];
        const taut::Coordinates axis = c->axial ? wire.tangent() : wire.normal();
        const Number factor = rotational ? Number(1) : product(direction, axis);
        for (const auto &[i, v] : shape(point.index, *c, Number(point.position), rotational))
          form.emplace_back(i, factor * v);
      }
    return form;
  }

  /// The place of a moving link, or the slope there, along its direction.
  Form ExtendedWires::sliding(const taut::Link &link, const Number &t, const bool slope) const
  {
    const taut::Coordinates axis = scene.wires[link.to.index].normal();
    Form form = shape(link.to.index, transverse[link.to.index],
                      Number(link.to.position) + Number(link.speed) * t, slope);
    scale(form, product(link.direction, axis));
    return form;
  }

  Form ExtendedWires::convection(const taut::Link &link, const Number &t) const
  {
    Form form;
    if (link.moving())
      form = sliding(link, t, true);
    scale(form, Number(link.speed));
    return form;
  }

  Form ExtendedWires::constraint(const taut::Link &link, const Number &t) const
  {
    const Number sign = link.kind == taut::LinkKind::dropper ? -1 : 1;
    Form form =
        link.moving() ? sliding(link, t, false) : motion(link.to, link.rotational, link.direction);
    scale(form, sign);
    for (const auto &[i, v] : motion(link.from, link.rotational, link.direction))
      form.emplace_back(i, -sign * v);
    return form;
  }

  Vector ExtendedWires::load(const Number &t) const
  {
    Vector P = constant;
    for (const taut::Load &load : scene.loads)
    {
      if (load.kind == taut::Load::Kind::distributed)
        continue;
      taut::Attachment at = load.target;
      if (load.kind == taut::Load::Kind::moving)
        at.position = static_cast<double>(Number(at.position) + Number(load.speed) * t);
      for (const auto &[i, v] : motion(at, load.rotational, load.direction))
        P[i] += Number(constant_value(load.magnitude)) * v;
    }
    return P;
  }
} // namespace extremes
