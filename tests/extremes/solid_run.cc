// SPDX-License-Identifier: LGPL-2.1-or-later
// A case of solids goes through the program as a parameter file with meshes written here.
#include "solid_case.h"

#include "common.h"
#include "verification/run.h"

#include <taut/model/surface_constraints.h>

#include <unistd.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>

namespace extremes
{
  namespace
  {
    /// Ids of the boundary: 10 + 2 axis at the lower end of an axis, 11 + 2 axis at the upper one.
    constexpr int first_boundary = 10;

    /// Of turns and sliding: the arithmetic is tested here, not what the model is good for.
    constexpr double no_limit = 1e300;

    /// A mesh in the format 2.2 of gmsh; materials 1 and 2 are left and right.
    class MeshFile
    {
    public:
      MeshFile(const Box &box, const unsigned int dim, const std::string &path) : dim(dim), n(box.n)
      {
        if (dim == 2)
          n[2] = 0;
        std::ofstream out(path);
        out.precision(std::numeric_limits<double>::max_digits10);
        out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n"
            << (n[0] + 1) * (n[1] + 1) * (n[2] + 1) << '\n';
        const std::vector<double> x = box.nodes(0), y = box.nodes(1), z = box.nodes(2);
        for (unsigned int k = 0; k <= n[2]; ++k)
          for (unsigned int j = 0; j <= n[1]; ++j)
            for (unsigned int i = 0; i <= n[0]; ++i)
              out << node(i, j, k) << ' ' << x[i] << ' ' << y[j] << ' ' << (dim == 3 ? z[k] : 0.)
                  << '\n';
        add_elements();
        out << "$EndNodes\n$Elements\n" << lines.size() << '\n';
        for (std::size_t e = 0; e < lines.size(); ++e)
          out << e + 1 << ' ' << lines[e] << '\n';
        out << "$EndElements\n";
      }

    private:
      unsigned int node(const unsigned int i, const unsigned int j, const unsigned int k) const
      {
        return 1 + i + (n[0] + 1) * (j + (n[1] + 1) * k);
      }

      /// Corners of the unit cell of some axes, in the order of gmsh.
      void add(const int type, const int id, std::array<unsigned int, 3> at,
               const std::vector<unsigned int> &axes)
      {
        const int ring[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
        std::ostringstream line;
        line << type << " 2 " << id << ' ' << id;
        for (unsigned int layer = 0; layer < (axes.size() == 3 ? 2 : 1); ++layer)
          for (unsigned int c = 0; c < (axes.size() == 1 ? 2 : 4); ++c)
          {
            std::array<unsigned int, 3> corner = at;
            corner[axes[0]] += ring[c][0];
            if (axes.size() > 1)
              corner[axes[1]] += ring[c][1];
            if (axes.size() > 2)
              corner[axes[2]] += layer;
            line << ' ' << node(corner[0], corner[1], corner[2]);
          }
        lines.push_back(line.str());
      }

      void add_elements()
      {
        constexpr int line = 1, quadrilateral = 3, hexahedron = 5;
        std::vector<unsigned int> all;
        for (unsigned int d = 0; d < dim; ++d)
          all.push_back(d);
        for (unsigned int axis = 0; axis < dim; ++axis)
          for (const int end : {0, 1})
          {
            std::vector<unsigned int> axes;
            for (const unsigned int d : all)
              if (d != axis)
                axes.push_back(d);
            for (unsigned int a = 0; a < n[axes[0]]; ++a)
              for (unsigned int b = 0; b < (dim == 3 ? n[axes[1]] : 1); ++b)
              {
                std::array<unsigned int, 3> at = {0, 0, 0};
                at[axis] = end == 1 ? n[axis] : 0;
                at[axes[0]] = a;
                if (dim == 3)
                  at[axes[1]] = b;
                add(dim == 2 ? line : quadrilateral, first_boundary + 2 * axis + end, at, axes);
              }
          }
        for (unsigned int k = 0; k < (dim == 3 ? n[2] : 1); ++k)
          for (unsigned int j = 0; j < n[1]; ++j)
            for (unsigned int i = 0; i < n[0]; ++i)
              add(dim == 2 ? quadrilateral : hexahedron, 2 * i < n[0] ? 1 : 2, {i, j, k}, all);
      }

      const unsigned int dim;
      std::array<unsigned int, 3> n;
      std::vector<std::string> lines;
    };

    /// A folder for the meshes of one run.
    class Scratch
    {
    public:
      Scratch()
          : path(std::filesystem::temp_directory_path() /
                 ("taut_solids_" + std::to_string(getpid())))
      {
        std::filesystem::create_directories(path);
      }
      ~Scratch() { std::filesystem::remove_all(path); }
      const std::filesystem::path path;
    };

    std::string body(const SolidCase &c, const bool is_upper, const Scratch &scratch)
    {
      const std::string name = is_upper ? "upper" : "lower",
                        mesh = (scratch.path / (name + ".msh")).string();
      const MeshFile file(is_upper ? c.upper : c.lower, c.dim, mesh);
      std::ostringstream out;
      out.precision(std::numeric_limits<double>::max_digits10);
      out << "subsection Body " << name << "\nset Type = solid\nset Dimension = " << c.dim
          << "\nset Largest turn = " << no_limit << "\nset Materials = 1: " << c.E[0] << ", "
          << c.nu[0] << ", " << c.density[0] << "; 2: " << c.E[1] << ", " << c.nu[1] << ", "
          << c.density[1] << "\nset Plane state = " << (c.plane_stress ? "stress" : "strain")
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
      out << "subsection Mesh\nset File = " << mesh << "\nend\nend\n";
      return out.str();
    }

    std::string scene(const SolidCase &c, const Scratch &scratch)
    {
      std::ostringstream out;
      out.precision(std::numeric_limits<double>::max_digits10);
      const bool on_plane = c.touching == Touching::plane;
      const std::string zero = c.dim == 3 ? ", 0" : "";
      out << "set Generator = network\nset Gravity = 0, 0\nset Start = " << c.start
          << "\nset Bodies = upper" << (on_plane ? "" : ", lower") << "\nset Contacts = joint\n"
          << body(c, true, scratch);
      if (!on_plane)
        out << body(c, false, scratch);
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
        o[gap].push_back(view.state.geometric_gap[k]);
      }
      return o;
    }

    /// What `automatic` takes, as the copy names it.
    std::string scheme_of(const taut::StepCoefficients &c)
    {
      return !c.mean_force           ? "generalised-alpha"
             : c.velocity_projection ? "Moreau-Jean"
                                     : "Moreau-Jean of gaps";
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
    visit_numbers(
        result, [&](double &x, const int l, const int m, const int t)
        { x *= std::pow(units.length, l) * std::pow(units.mass, m) * std::pow(units.time, t); });
    return result;
  }

  SolidCase in_last_digits(const SolidCase &c, const unsigned int seed)
  {
    SolidCase result = c;
    visit_numbers(result,
                  [seed](double &x, int, int, int)
                  {
                    std::uint64_t z;
                    std::memcpy(&z, &x, sizeof z);
                    z = (z ^ (seed * 0x9e3779b97f4a7c15u)) * 0xbf58476d1ce4e5b9u;
                    z = (z ^ (z >> 29)) * 0x94d049bb133111ebu;
                    x *= 1. + 0x1p-52 * (static_cast<double>((z >> 32) % 5) - 2.);
                  });
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
      answer.scheme = scheme_of(view.scheme);
      answer.conserving.clear();
      for (std::size_t k = 0; k < view.constraints.size(); ++k)
        answer.conserving.push_back(view.constraints[k].spring.conserving);
      answer.certificate = std::max(answer.certificate, view.certificate.max());
      answer.iterations = std::max(answer.iterations, view.certificate.iterations);
      answer.n_fallbacks += view.certificate.fallback;
    };
    const Scratch scratch;
    answer.error =
        verification::error_of([&] { verification::Session(scene(c, scratch)).run(record); });
    return answer;
  }
} // namespace extremes
