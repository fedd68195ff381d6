// SPDX-License-Identifier: LGPL-2.1-or-later
// The matrices of boxes of linear elasticity in extended precision: products of exact integrals.
#include "extended_model.h"
#include "extended_run.h"
#include "solid_case.h"

namespace extremes
{
  namespace
  {
    /// On a cell of length h: integrals of N_i N_j, N_i' N_j and N_i' N_j'.
    struct Integrals
    {
      Number mass[2][2], gradient[2][2], stiffness[2][2], length;
      explicit Integrals(const Number &h) : length(h)
      {
        for (int i = 0; i < 2; ++i)
          for (int j = 0; j < 2; ++j)
          {
            mass[i][j] = h * (i == j ? 2 : 1) / 6;
            gradient[i][j] = Number(i == 0 ? -1 : 1) / 2;
            stiffness[i][j] = Number(i == j ? 1 : -1) / h;
          }
      }
    };

    class ExtendedSolid : public ExtendedModel
    {
    public:
      ExtendedSolid(const SolidCase &c, const ContactRows &rows);

      Form motion(const taut::Attachment &point, bool, const taut::Coordinates &) const override
      {
        return {{point.index, Number(1)}};
      }
      Form constraint(const taut::Link &link, const Number &) const override
      {
        return forms[link.to.index];
      }
      Form convection(const taut::Link &, const Number &) const override { return {}; }
      Vector load(const Number &t) const override
      {
        return steady + (1 + Number(c.growth) * t) * growing;
      }

      std::size_t dof(std::size_t body, const taut::Coordinates &place, unsigned int d) const;

    private:
      struct Body
      {
        const Box *box;
        std::array<std::vector<double>, 3> x;
        std::size_t first;
      };
      std::size_t node(const Body &body, const std::array<unsigned int, 3> &at) const
      {
        return at[0] + body.x[0].size() * (at[1] + body.x[1].size() * at[2]);
      }
      void add_cells(const Body &body);
      void add_cell(const Body &body, const std::array<unsigned int, 3> &cell);
      void add_loads(const Body &body);
      void hold(const Body &body, unsigned int axis, unsigned int component);

      const SolidCase c;
      std::vector<Body> bodies;
      std::vector<Form> forms;
      Vector steady, growing;
    };

    ExtendedSolid::ExtendedSolid(const SolidCase &given, const ContactRows &rows) : c(given)
    {
      std::size_t n = 0;
      for (const Box *box : {&c.upper, &c.lower})
      {
        if (box == &c.lower && c.touching == Touching::plane)
          continue;
        Body body{box, {}, n};
        std::size_t n_nodes = 1;
        for (unsigned int d = 0; d < 3; ++d)
        {
          body.x[d] = d < c.dim ? box->nodes(d) : std::vector<double>{0.};
          n_nodes *= body.x[d].size();
        }
        n += c.dim * n_nodes;
        bodies.push_back(std::move(body));
      }
      resize(n);
      steady = growing = Vector(Number(0), n);
      for (const Body &body : bodies)
        add_cells(body);
      add_loads(bodies[0]);
      for (std::size_t i = 1; i < initial_V.size(); i += c.dim)
        if (bodies.size() == 1 || i < bodies[1].first)
          initial_V[i] = -Number(c.velocity);
      for (unsigned int d = 0; d < c.dim; ++d)
      {
        if (bodies.size() > 1)
          hold(bodies[1], 1, d);
        if (c.held || d == 0)
          hold(bodies[0], 0, d);
      }
      if (!c.held && c.dim == 3)
        hold(bodies[0], 2, 2);
      for (std::size_t i = 0; i < n; ++i)
        if (held[i])
          initial_V[i] = 0;
      for (const taut::SurfaceConstraint &row : rows.rows)
      {
        forms.emplace_back();
        for (const std::size_t b : {0, 1})
          for (const taut::NodeWeight &w : b == 0 ? row.slave : row.master)
            for (unsigned int d = 0; d < c.dim; ++d)
              forms.back().emplace_back(
                  dof(b, (b == 0 ? rows.slave_points : rows.master_points)[w.node], d),
                  Number(w.weight[d]));
      }
    }

    std::size_t ExtendedSolid::dof(const std::size_t body, const taut::Coordinates &place,
                                   const unsigned int d) const
    {
      std::array<unsigned int, 3> at = {0, 0, 0};
      for (unsigned int axis = 0; axis < c.dim; ++axis)
      {
        const std::vector<double> &x = bodies[body].x[axis];
        at[axis] = std::find(x.begin(), x.end(), place[axis]) - x.begin();
        if (at[axis] == x.size())
          throw std::logic_error("a node of the library is not one of the copy");
      }
      return bodies[body].first + c.dim * node(bodies[body], at) + d;
    }

    void ExtendedSolid::hold(const Body &body, const unsigned int axis,
                             const unsigned int component)
    {
      std::array<unsigned int, 3> at;
      for (at[2] = 0; at[2] < body.x[2].size(); ++at[2])
        for (at[1] = 0; at[1] < body.x[1].size(); ++at[1])
          for (at[0] = 0; at[0] < body.x[0].size(); ++at[0])
            if (at[axis] == 0)
              held[body.first + c.dim * node(body, at) + component] = 1;
    }

    void ExtendedSolid::add_cells(const Body &body)
    {
      std::array<unsigned int, 3> cell = {0, 0, 0};
      for (cell[2] = 0; cell[2] < (c.dim == 3 ? body.box->n[2] : 1); ++cell[2])
        for (cell[1] = 0; cell[1] < body.box->n[1]; ++cell[1])
          for (cell[0] = 0; cell[0] < body.box->n[0]; ++cell[0])
            add_cell(body, cell);
    }

    void ExtendedSolid::add_cell(const Body &body, const std::array<unsigned int, 3> &cell)
    {
      const int material = 2 * cell[0] < body.box->n[0] ? 0 : 1;
      const Number nu = c.nu[material], mu = Number(c.E[material]) / (2 * (1 + nu)),
                   strain = 2 * mu * nu / (1 - 2 * nu),
                   lambda =
                       c.dim == 2 && c.plane_stress ? 2 * strain * mu / (strain + 2 * mu) : strain,
                   thickness = c.dim == 2 ? Number(c.thickness) : Number(1);
      std::vector<Integrals> along;
      Number volume = thickness;
      for (unsigned int d = 0; d < c.dim; ++d)
      {
        along.emplace_back(Number(body.x[d][cell[d] + 1]) - Number(body.x[d][cell[d]]));
        volume *= along[d].length;
      }
      const unsigned int n = 1u << c.dim;
      const auto end = [](const unsigned int i, const unsigned int d) { return (i >> d) & 1u; };
      /// Integral of the derivatives of N_i along a and of N_j along b.
      const auto product = [&](const unsigned int i, const unsigned int j, const unsigned int a,
                               const unsigned int b)
      {
        Number p = thickness;
        for (unsigned int d = 0; d < c.dim; ++d)
          p *= d == a && d == b ? along[d].stiffness[end(i, d)][end(j, d)]
               : d == a         ? along[d].gradient[end(i, d)][end(j, d)]
               : d == b         ? along[d].gradient[end(j, d)][end(i, d)]
                                : along[d].mass[end(i, d)][end(j, d)];
        return p;
      };
      std::vector<std::size_t> first(n);
      for (unsigned int i = 0; i < n; ++i)
        first[i] = body.first + c.dim * node(body, {cell[0] + end(i, 0), cell[1] + end(i, 1),
                                                    cell[2] + end(i, 2)});
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
        {
          Number gradients = 0, m = Number(c.density[material]);
          for (unsigned int d = 0; d < c.dim; ++d)
            gradients += product(i, j, d, d);
          if (c.mass == "consistent")
            m *= product(i, j, c.dim, c.dim);
          else if (c.mass == "lumped")
            m *= i == j ? volume / n : Number(0);
          else
            m *= volume / (n * n);
          for (unsigned int a = 0; a < c.dim; ++a)
          {
            M(first[i] + a, first[j] + a) += m;
            K(first[i] + a, first[j] + a) += mu * gradients;
            for (unsigned int b = 0; b < c.dim; ++b)
              K(first[i] + a, first[j] + b) +=
                  lambda * product(i, j, a, b) + mu * product(i, j, b, a);
          }
        }
    }

    /// The traction of the top and of the right side of the upper body.
    void ExtendedSolid::add_loads(const Body &body)
    {
      const std::array<std::vector<double>, 3> &x = body.x;
      const Number thickness = c.dim == 2 ? Number(c.thickness) : Number(1);
      /// Integrals along an axis of the shape function of node i, and of it times the distance from
      /// the first node: sums of those of the cell before node i and the one after it.
      const auto share = [&](const unsigned int d, const std::size_t i) -> std::pair<Number, Number>
      {
        if (d >= c.dim)
          return {1, 0};
        std::pair<Number, Number> sum = {0, 0};
        const Number at = Number(x[d][i]) - Number(x[d][0]);
        for (std::size_t k = std::max<std::size_t>(i, 1); k <= i + 1 && k < x[d].size(); ++k)
        {
          const Number h = Number(x[d][k]) - Number(x[d][k - 1]);
          sum.first += h / 2;
          sum.second += h * (at / 2 + Number(k == i ? -1 : 1) * h / 6);
        }
        return sum;
      };
      std::array<unsigned int, 3> at;
      for (at[2] = 0; at[2] < x[2].size(); ++at[2])
        for (at[1] = 0; at[1] < x[1].size(); ++at[1])
          for (at[0] = 0; at[0] < x[0].size(); ++at[0])
          {
            const std::size_t first = body.first + c.dim * node(body, at);
            if (at[1] + 1 == x[1].size())
              growing[first + 1] -=
                  Number(c.load) * thickness * share(2, at[2]).first *
                  (share(0, at[0]).first -
                   Number(c.slope) / Number(body.box->size[0]) * share(0, at[0]).second);
            if (at[0] + 1 == x[0].size())
              steady[first] +=
                  Number(c.pull) * thickness * share(1, at[1]).first * share(2, at[2]).first;
          }
    }
  } // namespace

  Answer extended_answer(const SolidCase &c, const ContactRows &rows, const bool as_double)
  {
    const ExtendedSolid model(c, rows);
    Case steps;
    steps.scheme = c.scheme;
    steps.step = c.step;
    steps.n_steps = c.n_steps;
    steps.conserving = c.conserving;
    steps.scene.start = c.start == "equilibrium"  ? taut::Start::equilibrium
                        : c.start == "undeformed" ? taut::Start::undeformed
                                                  : taut::Start::given;
    for (std::size_t k = 0; k < rows.rows.size(); ++k)
    {
      taut::Link link;
      link.name = std::to_string(k);
      link.kind = taut::LinkKind::stop;
      link.to = {taut::Attachment::Kind::body, k};
      link.gap = rows.rows[k].gap;
      if (c.compliance > 0.)
        link.stiffness = rows.rows[k].area / c.compliance;
      steps.scene.links.push_back(link);
    }
    std::vector<ObservedPoint> points;
    for (const std::size_t b : {0, 1})
      for (const taut::Coordinates &place : b == 0 ? rows.slave_points : rows.master_points)
        for (unsigned int d = 0; d < c.dim; ++d)
          points.push_back({{taut::Attachment::Kind::body, model.dof(b, place, d)}, false, {}});
    return extended_answer(steps, model, points, as_double);
  }
} // namespace extremes
