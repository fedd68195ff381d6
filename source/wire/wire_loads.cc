// SPDX-License-Identifier: LGPL-2.1-or-later Supports, point masses and loads of a wire.
#include "wire/distributed_load.h"

#include "scene/travel.h"

#include <algorithm>
#include <cmath>

namespace taut
{
  void WireComponent::add_supports(const Scene &scene, const std::size_t wire)
  {
    LinearForm row;
    for (const Support &support : scene.supports)
    {
      if (support.wire != wire || component_of(support.motion) != motion)
        continue;
      const unsigned int offset = is_slope(support.motion) ? 1 : 0;
      for (const double s : support.positions)
      {
        if (!owns(s))
          continue;
        auto node = std::lower_bound(nodes.begin(), nodes.end(), s); // the nearest one
        if (node == nodes.end() || (node != nodes.begin() && s - node[-1] <= *node - s))
          --node;
        const unsigned int dof = dofs_per_node * (node - nodes.begin()) + offset;
        if (support.fixed)
        {
          constrained.push_back({dof});
          if (!support.prescribed.depends_on_time())
            constrained.back().displacement = support.prescribed(0., 0.);
          else
            constrained.back().motion = [u = support.prescribed](const double t)
            { return u(0., t); };
        }
        else
        {
          K->add(dof, dof, support.stiffness);
          C->add(dof, dof, support.damping);
          constant_force[dof] += support.stiffness * support.prescribed(0., 0.);
          if (support.stiffness > 0.)
            sprung_dofs.push_back(dof);
        }
      }
    }
  }

  void WireComponent::add_point_masses(const Scene &scene, const std::size_t wire,
                                       const double gravity)
  {
    LinearForm row;
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

  double WireComponent::component(const Coordinates &direction, const bool rotational) const
  {
    return dot(direction, rotational ? rotation_axis : axis);
  }

  /// A moving point force; it acts while it is on the wire.
  class WireComponent::MovingLoad : public TimeLoad
  {
  public:
    MovingLoad(const WireComponent &wire, const Load &load, const double factor)
        : wire(wire), load(load), factor(factor)
    {
    }

    void add(const double t, std::vector<double> &P) const override
    {
      const double s = load.target.position + way(load, t);
      if (s < 0. || s > wire.wire_length || !wire.owns(s))
        return;
      if (load.rotational)
        wire.slope_at(s, shape);
      else
        wire.value_at(s, shape);
      shape.add_to(factor * load.magnitude(s, t), P);
    }

    double sample(const double t) const override
    {
      const double s = load.target.position + way(load, t);
      return s < 0. || s > wire.wire_length ? 0. : load.magnitude(s, t);
    }

  private:
    const WireComponent &wire;
    Load load;
    double factor;
    mutable LinearForm shape; ///< kept for its memory
  };

  void WireComponent::add_loads(const Scene &scene, const std::size_t wire, const double gravity)
  {
    if (scene.wires[wire].weight && gravity != 0.)
    {
      Load load;
      load.name = "weight";
      load.origin = scene.wires[wire].origin;
      load.magnitude = Expression(1.);
      if (!scene.wires[wire].remaining.mass.is_zero())
        load.magnitude = scene.wires[wire].remaining.mass;
      DistributedLoad(*this, scene.wires[wire].mass_per_length * gravity, load)
          .add(0., constant_force);
    }

    for (const Load &load : scene.loads)
    {
      if (load.target.kind != Attachment::Kind::wire || load.target.index != wire)
        continue;
      if (load.kind == Load::Kind::point && !owns(load.target.position))
        continue;
      const double factor = component(load.direction, load.rotational);
      if (factor == 0.)
        continue;
      if (load.kind == Load::Kind::moving)
        time_loads.push_back(std::make_unique<MovingLoad>(*this, load, factor));
      else if (load.kind == Load::Kind::distributed)
        add_distributed_load(load, factor);
      else
      {
        LinearForm shape;
        evaluate(load.target.position, load.rotational, shape);
        for (double &v : shape.value)
          v *= factor;
        auto force = std::make_unique<PointLoad>(
            shape,
            [f = load.magnitude, s = load.target.position](const double t) { return f(s, t); });
        if (load.magnitude.depends_on_time())
          time_loads.push_back(std::move(force));
        else
          force->add(0., constant_force);
      }
    }
  }

  namespace
  {
    /// A sum of forces, each times a function of t.
    class ProductLoad : public TimeLoad
    {
    public:
      void add_product(const std::vector<double> &forces, const Expression &of_time)
      {
        Product product{{}, of_time};
        double sum = 0., size = 0.;
        for (unsigned int i = 0; i < forces.size(); ++i)
          if (forces[i] != 0.)
          {
            product.shape.add(i, forces[i]);
            sum += forces[i];
            size += std::fabs(forces[i]);
          }
        product.size = std::copysign(size, sum);
        if (size > 0.)
          products.push_back(std::move(product));
      }

      bool empty() const { return products.empty(); }

      void add(const double t, std::vector<double> &P) const override
      {
        for (const Product &product : products)
          product.shape.add_to(product.of_time(0., t), P);
      }

      double sample(const double t) const override
      {
        double sum = 0.;
        for (const Product &product : products)
          sum += product.size * product.of_time(0., t);
        return sum;
      }

    private:
      struct Product
      {
        LinearForm shape;
        Expression of_time;
        double size = 0.; ///< of the force, with the sign of its sum [N, N m]
      };
      std::vector<Product> products;
    };
  } // namespace

  /// Products of a function of s and one of t are integrated here, once; those that travel by their
  /// shapes.
  void WireComponent::add_distributed_load(const Load &load, const double factor)
  {
    const auto part = [&](const Expression &magnitude,
                          const Expression::Separated::Travelling *const travelling = nullptr)
    {
      Load own = load;
      own.magnitude = magnitude;
      return std::make_unique<DistributedLoad>(*this, factor, own, travelling);
    };
    const auto add_standing = [&](const Expression &magnitude)
    { part(magnitude)->add(0., constant_force); };
    if (!load.magnitude.depends_on_time())
    {
      add_standing(load.magnitude);
      return;
    }
    const Expression::Separated separated = load.magnitude.separated();
    auto products = std::make_unique<ProductLoad>();
    for (const Expression::Separated::Product &product : separated.products)
      if (product.of_time.depends_on_time())
      {
        std::vector<double> forces(constant_force.size(), 0.);
        part(product.of_place)->add(0., forces);
        products->add_product(forces, product.of_time);
      }
      else
        add_standing(product.of_place);
    if (!products->empty())
      time_loads.push_back(std::move(products));
    for (const Expression::Separated::Travelling &product : separated.travelling)
      time_loads.push_back(part(product.whole, &product));
    if (separated.rest.depends_on_time())
      time_loads.push_back(part(separated.rest));
    else if (!separated.rest.is_zero())
      add_standing(separated.rest);
  }
} // namespace taut
