// SPDX-License-Identifier: LGPL-2.1-or-later
// All numbers of a case with their dimensions: to change units, or last digits.
#include "scene_numbers.h"

namespace extremes
{
  namespace
  {
    /// A number, its powers of length, mass and time, and whether it is a place.
    using Visitor = std::function<void(double &, int, int, int, bool)>;

    class Numbers
    {
    public:
      Numbers(Case &c, const Visitor &visit) : c(c), scene(c.scene), visit(visit) {}

      void all()
      {
        number(c.step, 0, 0, 1);
        point(scene.gravity, 1, 0, -2, false);
        for (taut::Wire &wire : scene.wires)
          of(wire);
        for (taut::Support &s : scene.supports)
        {
          const int angle = s.motion == taut::WireMotion::slope;
          for (double &x : s.positions)
            place(x);
          constant(s.prescribed, 1 - angle, 0, 0);
          number(s.stiffness, 2 * angle, 1, -2);
          number(s.damping, 2 * angle, 1, -1);
        }
        for (taut::PointMass &m : scene.point_masses)
        {
          for (double &x : m.positions)
            place(x);
          number(m.mass, 0, 1, 0);
        }
        for (taut::Mass &m : scene.masses)
        {
          point(m.position, 1, 0, 0, true);
          number(m.mass, 0, 1, 0);
          number(m.inertia, 2, 1, 0);
          for (int i = 0; i < 3; ++i)
          {
            number(m.displacement[i], i < 2 ? 1 : 0, 0, 0);
            number(m.velocity[i], i < 2 ? 1 : 0, 0, -1);
          }
        }
        for (taut::Spring &s : scene.springs)
        {
          number(s.stiffness, s.rotational ? 2 : 0, 1, -2);
          number(s.damping, s.rotational ? 2 : 0, 1, -1);
        }
        for (taut::Link &link : scene.links)
        {
          place(link.from.position);
          place(link.to.position);
          if (!link.rigid())
            number(link.stiffness, link.rotational ? 2 : 0, 1, -2);
          number(link.gap, link.rotational ? 0 : 1, 0, 0);
          number(link.speed, 1, 0, -1);
        }
        for (taut::Load &load : scene.loads)
        {
          place(load.target.position);
          number(load.speed, 1, 0, -1);
          constant(load.magnitude,
                   load.kind == taut::Load::Kind::distributed ? 0
                   : load.rotational                          ? 2
                                                              : 1,
                   1, -2);
        }
      }

    private:
      void of(taut::Wire &wire)
      {
        point(wire.a, 1, 0, 0, true);
        point(wire.b, 1, 0, 0, true);
        number(wire.mass_per_length, -1, 1, 0);
        number(wire.axial_stiffness, 1, 1, -2);
        number(wire.tension, 1, 1, -2);
        number(wire.bending_stiffness, 3, 1, -2);
        place(wire.element_size);
        number(wire.damping.mass, 0, 0, -1);
        number(wire.damping.stiffness, 0, 0, 1);
        for (taut::InitialMotion *start : {&wire.axial_start, &wire.transverse_start})
        {
          constant(start->displacement, 1, 0, 0);
          constant(start->velocity, 1, 0, -1);
        }
      }
      void number(double &x, int l, int m, int t) { visit(x, l, m, t, false); }
      void place(double &x) { visit(x, 1, 0, 0, true); }
      void point(taut::Coordinates &p, int l, int m, int t, bool is_place)
      {
        visit(p.x, l, m, t, is_place);
        visit(p.y, l, m, t, is_place);
        visit(p.z, l, m, t, is_place);
      }
      void constant(taut::Expression &f, int l, int m, int t)
      {
        double value = f(0., 0.);
        visit(value, l, m, t, false);
        f = taut::Expression(value);
      }

      Case &c;
      taut::Scene &scene;
      const Visitor &visit;
    };
  } // namespace

  Case in_units(const Case &c, const Units &units)
  {
    Case result = c;
    Numbers(result, [&](double &x, int l, int m, int t, bool) { x *= units.of(l, m, t); }).all();
    return result;
  }

  void to_units_of_origin(std::vector<Observation> &steps, const Units &units)
  {
    const double factor[n_quantities] = {units.length,       1.,           units.of(1, 1, -2),
                                         units.of(2, 1, -2), units.length, 1.};
    for (Observation &o : steps)
      for (int q = 0; q < n_quantities; ++q)
        for (double &x : o[q])
          x /= factor[q];
  }

  double Units::of(const int l, const int m, const int t) const
  {
    return std::pow(length, l) * std::pow(mass, m) * std::pow(time, t);
  }

  void change_last_digit(double &x, const unsigned int seed)
  {
    std::uint64_t z;
    std::memcpy(&z, &x, sizeof z);
    z = (z ^ (seed * 0x9e3779b97f4a7c15u)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 29)) * 0x94d049bb133111ebu;
    x *= 1. + 0x1p-52 * (static_cast<double>((z >> 32) % 5) - 2.);
  }

  Case in_last_digits(const Case &c, const unsigned int seed)
  {
    Case result = c;
    const auto visit = [seed](double &x, int, int, int, bool is_place)
    {
      if (!is_place)
        change_last_digit(x, seed);
    };
    Numbers(result, visit).all();
    return result;
  }
} // namespace extremes
