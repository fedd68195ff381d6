// SPDX-License-Identifier: LGPL-2.1-or-later
// A case of solids goes through the program as a parameter file with meshes written here.
#include "solid_case.h"

#include "common.h"
#include "solid/mesh_file.h"
#include "verification/run.h"

#include "model/surface_constraints.h"

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>

namespace extremes
{
  namespace
  {
    /// Ids of the boundary: 10 + 2 axis at the lower end of an axis, 11 + 2 axis at the upper one.
    constexpr int first_boundary = 10;
    /// Of turns and sliding: the arithmetic is tested here, not what the model is good for.
    constexpr double no_limit = 1e300;

    /// Materials 1 and 2 are left and right.
    template <int dim>
    verification::MeshFile mesh_of(const Box &box)
    {
      const std::vector<double> x[] = {box.nodes(0), box.nodes(1), box.nodes(2)};
      const std::vector<unsigned int> n(box.n.begin(), box.n.begin() + dim);
      dealii::Point<dim> end;
      for (unsigned int d = 0; d < dim; ++d)
        end[d] = n[d];
      dealii::Triangulation<dim> cells;
      dealii::GridGenerator::subdivided_hyper_rectangle(cells, n, dealii::Point<dim>(), end, true);
      for (const auto &cell : cells.active_cell_iterators())
        cell->set_material_id(2. * cell->vertex(0)[0] < n[0] ? 1 : 2);
      const auto place = [&](dealii::Point<dim> p)
      {
        for (unsigned int d = 0; d < dim; ++d)
          p[d] = x[d][std::lround(p[d])];
        return p;
      };
      dealii::GridTools::transform(place, cells);
      return verification::MeshFile(cells, first_boundary);
    }

    std::string body(const SolidCase &c, const bool is_upper, const verification::MeshFile &mesh)
    {
      std::ostringstream out;
      out.precision(std::numeric_limits<double>::max_digits10);
      out << "subsection Body " << (is_upper ? "upper" : "lower")
          << "\nset Type = solid\nset Dimension = " << c.dim << "\nset Largest turn = " << no_limit
          << "\nset Materials = 1: " << c.E[0] << ", " << c.nu[0] << ", " << c.density[0]
          << "; 2: " << c.E[1] << ", " << c.nu[1] << ", " << c.density[1]
          << "\nset Plane state = " << (c.plane_stress ? "stress" : "strain")
          << "\nset Thickness = " << c.thickness << "\nset Mass matrix = " << c.mass << '\n';
      const std::string zero = c.dim == 3 ? ", 0" : "";
      if (!is_upper)
        out << "set Fixed boundaries = 12\n";
      else
      {
        if (c.held)
          out << "set Fixed boundaries = 10\n";
        else
          out << "set Symmetry boundaries = 10" << (c.dim == 3 ? ", 14" : "") << '\n';
        out << "set Traction = 13: 0, -(" << c.load << ")*(1-(" << c.slope << ")*(x-("
            << c.upper.from[0] << "))/(" << c.upper.size[0] << "))*(1+(" << c.growth << ")*t)"
            << zero << "; 11: " << c.pull << ", 0" << zero << '\n';
        out << "set Initial velocity = 0, " << -c.velocity << zero << '\n';
      }
      out << "subsection Mesh\nset File = " << mesh.path() << "\nend\nend\n";
      return out.str();
    }

    std::string scene(const SolidCase &c, const verification::MeshFile &upper,
                      const verification::MeshFile &lower)
    {
      std::ostringstream out;
      out.precision(std::numeric_limits<double>::max_digits10);
      const bool on_plane = c.touching == Touching::plane;
      const std::string zero = c.dim == 3 ? ", 0" : "";
      out << "set Generator = network\nset Gravity = 0, 0\nset Start = " << c.start
          << "\nset Bodies = upper" << (on_plane ? "" : ", lower") << "\nset Contacts = joint\n"
          << body(c, true, upper);
      if (!on_plane)
        out << body(c, false, lower);
      out << "subsection Contact joint\nset Slave = upper: 12\n";
      if (on_plane)
        out << "set Obstacle = plane\nset Point = " << c.upper.from[0] << ", " << c.upper.from[1]
            << zero << "\nset Direction = 0, 1" << zero << '\n';
      else
        out << "set Master = lower: 13\nset Method = "
            << (c.touching == Touching::mortar ? "mortar" : "nodes to faces") << '\n';
      out << "set Largest sliding = " << no_limit << "\nset Gap = " << c.gap
          << "\nset Compliance = " << c.compliance
          << "\nend\nsubsection Time\nset Scheme = " << c.scheme
          << "\nset Allow unsuitable scheme = true\nset Allow energy gain = true\nset Step = "
          << c.step << "\nset End = " << c.n_steps * c.step
          << "\nend\nsubsection Output\nset Interval = 1e30\nset Link interval = 1e30\n"
             "set Field interval = 0\nend\nsubsection Solver\nset Interface operator = "
          << c.interface_operator << "\nset Complementarity = " << c.complementarity << "\nend\n";
      return out.str();
    }

    std::vector<taut::Coordinates> boundary(const taut::Scene &scene, const std::size_t b)
    {
      const taut::CustomBody &body = scene.bodies[b];
      return body.type->surface({body.name, body.origin, scene.gravity}, {}).points;
    }

    Observation observe(const taut::StepView &view, const unsigned int dim,
                        const std::vector<std::size_t> &n_nodes)
    {
      const taut::Coordinates axes[3] = {{1., 0., 0.}, {0., 1., 0.}, {0., 0., 1.}};
      Observation o;
      for (std::size_t b = 0; b < n_nodes.size(); ++b)
        for (unsigned int node = 0; node < n_nodes[b]; ++node)
          for (unsigned int d = 0; d < dim; ++d)
            o[displacement].push_back(verification::displacement(
                view, {{b, view.structure[b].node_displacement(node, axes[d])}}));
      for (std::size_t k = 0; k < view.constraints.size(); ++k)
      {
        o[force].push_back(view.state.multiplier[k]);
        o[gap].push_back(view.state.distance[k]);
      }
      return o;
    }

    /// A number and its powers of length, mass and time.
    using Visitor = std::function<void(double &, int, int, int)>;

    void visit_numbers(SolidCase &c, const Visitor &visit)
    {
      for (int i = 0; i < 2; ++i)
      {
        visit(c.E[i], -1, 1, -2);
        visit(c.nu[i], 0, 0, 0);
        visit(c.density[i], -3, 1, 0);
      }
      visit(c.thickness, 1, 0, 0);
      visit(c.load, -1, 1, -2);
      visit(c.slope, 0, 0, 0);
      visit(c.growth, 0, 0, -1);
      visit(c.pull, -1, 1, -2);
      visit(c.gap, 1, 0, 0);
      visit(c.compliance, 2, -1, 2);
      visit(c.velocity, 1, 0, -1);
      visit(c.step, 0, 0, 1);
    }
  } // namespace

  std::vector<double> Box::nodes(const unsigned int axis) const
  {
    std::vector<double> x;
    const bool is_graded = first[axis] > 0. && n[axis] > 1;
    for (unsigned int i = 0; i <= n[axis]; ++i)
      x.push_back(from[axis] +
                  size[axis] * (is_graded && i > 0
                                    ? first[axis] + (1. - first[axis]) * (i - 1.) / (n[axis] - 1.)
                                    : static_cast<double>(i) / n[axis]));
    return x;
  }

  SolidCase in_units(const SolidCase &c, const Units &units)
  {
    SolidCase result = c;
    for (Box *box : {&result.upper, &result.lower})
      for (unsigned int d = 0; d < 3; ++d)
      {
        box->from[d] *= units.length;
        box->size[d] *= units.length;
      }
    visit_numbers(result, [&](double &x, int l, int m, int t) { x *= units.of(l, m, t); });
    return result;
  }

  SolidCase in_last_digits(const SolidCase &c, const unsigned int seed)
  {
    SolidCase result = c;
    visit_numbers(result, [seed](double &x, int, int, int) { change_last_digit(x, seed); });
    return result;
  }

  Answer program_answer(const SolidCase &c, ContactRows &rows)
  {
    Answer answer;
    std::vector<std::size_t> n_nodes;
    const auto record = [&](const taut::StepView &view)
    {
      if (answer.steps.empty())
      {
        rows.slave_points = boundary(view.scene, 0);
        n_nodes = {rows.slave_points.size()};
        if (c.touching != Touching::plane)
        {
          rows.master_points = boundary(view.scene, 1);
          n_nodes.push_back(rows.master_points.size());
        }
        rows.rows = taut::contact_geometry(view.scene, 0).constraints;
      }
      answer.steps.push_back(observe(view, c.dim, n_nodes));
      // What `automatic` takes, as the copy names it.
      answer.scheme = !view.report.method.has_means()          ? "generalised-alpha"
                      : view.report.method.corrects_velocities ? "Moreau-Jean"
                                                               : "Moreau-Jean of gaps";
      answer.conserving.clear();
      for (std::size_t k = 0; k < view.constraints.size(); ++k)
        answer.conserving.push_back(view.constraints[k].spring.conserving);
      answer.certificate = std::max(answer.certificate, view.residuals.max());
      answer.iterations = std::max(answer.iterations, view.residuals.iterations);
      answer.n_fallbacks += view.residuals.fallback;
    };
    const auto mesh = [&](const Box &box)
    { return c.dim == 2 ? mesh_of<2>(box) : mesh_of<3>(box); };
    const verification::MeshFile upper = mesh(c.upper), lower = mesh(c.lower);
    answer.error =
        verification::error_of([&] { verification::Session(scene(c, upper, lower)).run(record); });
    return answer;
  }
} // namespace extremes
