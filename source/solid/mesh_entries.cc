// SPDX-License-Identifier: LGPL-2.1-or-later
#include "solid/mesh_arguments.h"
#include "solid/solid_entries.h"

#include "base/data_files.h"
#include "base/text.h"
#include "substructure/distributed_mesh.h"
#include <taut/base/exceptions.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/patterns.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_in.h>
#include <deal.II/grid/grid_tools.h>

#include <boost/functional/hash.hpp>

#ifdef DEAL_II_WITH_P4EST
#include <p4est.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <regex>
#include <sstream>
#include <unordered_map>

namespace taut
{
  namespace
  {
    namespace Patterns = dealii::Patterns;

    /// The message of an error of deal.II, without the place in the source.
    std::string reason(const std::exception &e)
    {
      const std::string all = e.what();
      const std::string mark = "Additional information:";
      const std::size_t begin = all.find(mark);
      std::string text = begin == std::string::npos ? all : all.substr(begin + mark.size());
      text.erase(std::min(text.find("Stacktrace"), text.size()));
      text = std::regex_replace(text, std::regex("[-\\s]*\\n[-\\s]*"), " ");
      return std::regex_replace(text, std::regex("^\\s+|\\s+$"), "");
    }

    /// The remedy for a mesh of gmsh that deal.II refuses; empty if the message of deal.II is
    /// enough. Element types of gmsh up to 7, and 15, are of first order.
    std::string remedy(const std::string &reason)
    {
      std::smatch found;
      if (!std::regex_search(reason, found, std::regex("Element Identifier <(\\d{1,3})>")))
        return "";
      const int type = std::stoi(found[1]);
      if (type <= 7 || type == 15)
        return "";
      return "it has elements of second or higher order, gmsh's type " + std::to_string(type) +
             ", and deal.II reads those of first order. Export it with Mesh.ElementOrder = 1; "
             "Degree = 2 adds nodes on its sides, and on the curves that Mesh/Curved boundaries "
             "names for quadrilaterals and hexahedra";
    }

    /// Sine of the angle between the edges of a corner, or its like in space, below which a cell is
    /// flat there.
    constexpr double flat_corner = 1e-8;

    /// The smallest determinant of the edges at a corner of a cell, over their lengths: 1 for a
    /// box, 0 for a flat corner, negative for a corner that is turned inside out.
    template <typename Cell, int dim = Cell::AccessorType::dimension>
    double smallest_corner(const Cell &cell)
    {
      const bool is_box = cell->reference_cell().is_hyper_cube();
      double smallest = 1.;
      for (unsigned int v = 0; v < (is_box ? cell->n_vertices() : 1u); ++v)
      {
        dealii::Tensor<2, dim> edges;
        double lengths = 1.;
        for (unsigned int d = 0; d < dim; ++d)
        {
          edges[d] = is_box ? cell->vertex(v | (1u << d)) - cell->vertex(v & ~(1u << d))
                            : cell->vertex(d + 1) - cell->vertex(0);
          lengths *= edges[d].norm();
        }
        smallest = std::min(smallest, lengths > 0. ? dealii::determinant(edges) / lengths : 0.);
      }
      return smallest;
    }

    /// Coordinates of the corners of a cell, the same for each order of the corners.
    template <typename Cell, int dim = Cell::AccessorType::dimension>
    std::vector<double> corners(const Cell &cell)
    {
      std::vector<std::array<double, dim>> points(cell->n_vertices());
      for (const unsigned int v : cell->vertex_indices())
        for (unsigned int d = 0; d < dim; ++d)
          points[v][d] = cell->vertex(v)[d];
      std::sort(points.begin(), points.end());
      std::vector<double> result;
      for (const auto &x : points)
        result.insert(result.end(), x.begin(), x.end());
      return result;
    }

    template <int dim>
    void check_cells(const dealii::Triangulation<dim> &cells, const std::string &entry)
    {
      std::unordered_map<std::size_t, decltype(cells.begin_active())> by_corners;
      for (const auto &cell : cells.active_cell_iterators())
      {
        const std::vector<double> places = corners(cell);
        const auto [known, is_new] =
            by_corners.emplace(boost::hash_range(places.begin(), places.end()), cell);
        const char *const what =
            !(smallest_corner(cell) > flat_corner) ? "is flat or turned inside out at a corner"
            : !is_new && corners(known->second) == places
                ? "is given twice, and would be twice as stiff (gmsh writes a cell for each "
                  "physical group that it is in)"
                : nullptr;
        if (what)
          throw EntryError(entry, to_text("the cell about (", cell->center(), ") ", what,
                                          "; mend the mesh where it is made"));
      }
    }
  } // namespace

  namespace
  {
    std::string section_of(const std::string &origin)
    {
      return origin.empty() ? "Mesh/" : origin + "/Mesh/";
    }

#ifdef DEAL_II_WITH_P4EST
    /// Cells of a mesh that need some GB on each rank while it is made whole.
    constexpr double least_cells_for_p4est = 1e6;

    /// Once it is initialised, p4est tells what it does on the standard output no more.
    void start_p4est()
    {
      if (sc_package_id >= 0)
        return;
      sc_init(MPI_COMM_WORLD, 0, 0, nullptr, SC_LP_SILENT);
      p4est_init(nullptr, SC_LP_SILENT);
    }
#endif
  } // namespace

  void MeshEntries::declare(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Mesh");
    prm.add_parameter(
        "File", file,
        "Of a mesh in a format that deal.II reads, e.g. .msh of gmsh, relative to the "
        "parameter file; empty: Generator makes it");
    prm.add_parameter("Generator", generator,
                      "Function of deal.II's GridGenerator. Its arguments: "
                      "subdivided_hyper_rectangle, 'numbers of cells : corner : opposite corner'; "
                      "hyper_ball, half_hyper_ball (x above that of the centre), "
                      "quarter_hyper_ball (a quarter, in space an eighth), 'centre : radius'; "
                      "cylinder along x, 'radius : half length'; plate_with_a_hole, 'radius of "
                      "the hole : half side of a square around it : widths below, above, left and "
                      "right of this square : centre', in space also ': thickness : layers of "
                      "nodes along z'",
                      Patterns::Selection("subdivided_hyper_rectangle|hyper_ball|half_hyper_ball|"
                                          "quarter_hyper_ball|cylinder|plate_with_a_hole"));
    prm.add_parameter(
        "Arguments", arguments,
        "Of the generator, in m, with colons between them: e.g. '4, 2 : 0, 0 : 2, 1'. "
        "A rectangle has the boundary ids 2d (left or lower) and 2d + 1 across axis d; so has a "
        "plate, with 4 for its hole, and 5 and 6 across z");
    prm.add_parameter(
        "Curved boundaries", curved,
        "Of a mesh from a file, which is straight between its nodes: shapes by ids of the boundary "
        "that new nodes and those of degree 2 lie on. 'id: sphere, x, y, z; id: cylinder, x, y, z, "
        "dx, dy, dz' with the centre, or a point and the direction of the axis; in the plane 'id: "
        "circle, x, y' [m]");
    prm.add_parameter("Refinements", refinements, "Each halves all cells in each direction",
                      Patterns::Integer(0, 12));
    prm.add_parameter("Local refinements", local_refinements,
                      "Times that the cells are halved whose centre Refine where is positive at",
                      Patterns::Integer(0, 30));
    prm.add_parameter("Refine where", where,
                      "Formula of x, y, z at the centre of a cell, positive where it is refined; t "
                      "is the number of local refinements so far, e.g. '0.1/2^t-sqrt(x^2+y^2)'");
    prm.add_parameter(
        "Distribution", distribution,
        "On several ranks, of a solid that is cut into a part for each of them. METIS: every rank "
        "makes the mesh, and keeps its parts, which are those of one process. p4est: ranks refine "
        "their own cells, and part them. automatic: p4est from a million cells on",
        Patterns::Selection("automatic|METIS|p4est"));
    prm.add_parameter("Shift", shift, "Added to all points, x, y or x, y, z [m]");
    prm.leave_subsection();
  }

  template <int dim>
  void MeshEntries::make_coarse(dealii::Triangulation<dim> &cells, const std::string &origin) const
  {
    const std::string section = section_of(origin);
    if (file.empty())
      generate(cells, section);
    else
      read(cells, section);
    if (!shift.empty())
    {
      if (shift.size() != dim)
        throw EntryError(section + "Shift", "it has " + std::to_string(shift.size()) +
                                                " components where the solid has " +
                                                std::to_string(dim));
      dealii::Tensor<1, dim> by;
      for (unsigned int d = 0; d < dim; ++d)
        by[d] = shift[d];
      dealii::GridTools::shift(by, cells);
    }
    curve(cells, section);
  }

  template <int dim>
  std::unique_ptr<dealii::Triangulation<dim>> MeshEntries::make(const std::string &origin) const
  {
    // As p4est does, so that the mesh is the same on any number of ranks, and nodes on which
    // hanging nodes depend do not hang.
    auto cells = std::make_unique<dealii::Triangulation<dim>>(
        dealii::Triangulation<dim>::limit_level_difference_at_vertices);
    make_coarse(*cells, origin);
    refine(*cells, section_of(origin));
    return cells;
  }

  template <int dim>
  std::unique_ptr<dealii::Triangulation<dim>>
  MeshEntries::make_distributed(const std::string &origin, const Communicator &processes,
                                const unsigned int degree, const double least_dofs) const
  {
    if (distribution == "METIS")
      return nullptr;
#ifdef DEAL_II_WITH_P4EST
    const bool is_asked_for = distribution == "p4est";
    if (!is_asked_for && refinements == 0)
      return nullptr;
    const auto n = static_cast<double>(refinements);
    dealii::Triangulation<dim> coarse;
    make_coarse(coarse, origin);
    if (!coarse.all_reference_cells_are_hyper_cube())
    {
      if (is_asked_for)
        throw EntryError(section_of(origin) + "Distribution",
                         "p4est takes quadrilaterals and hexahedra; take METIS");
      return nullptr;
    }
    const double n_cells = coarse.n_active_cells() * std::pow(2., dim * n),
                 n_nodes = coarse.n_active_cells() *
                           std::pow(std::pow(2., n) * static_cast<double>(degree), dim);
    if (dim * n_nodes < least_dofs || (!is_asked_for && n_cells < least_cells_for_p4est))
      return nullptr;
    start_p4est();
    auto cells =
        std::make_unique<dealii::parallel::distributed::Triangulation<dim>>(processes.of_mpi());
    make_coarse(*cells, origin);
    refine(*cells, section_of(origin));
    if (processes.any(cells->n_locally_owned_active_cells() == 0))
      return nullptr;
    return cells;
#else
    if (distribution == "p4est")
      throw EntryError(section_of(origin) + "Distribution",
                       "this deal.II was built without p4est; take METIS");
    return nullptr;
#endif
  }

  template <int dim>
  void MeshEntries::generate(dealii::Triangulation<dim> &cells, const std::string &section) const
  {
    namespace Generator = dealii::GridGenerator;
    MeshArguments<dim> given(arguments, section + "Arguments");
    if (generator == "subdivided_hyper_rectangle")
    {
      const std::vector<unsigned int> n = given.cells();
      const dealii::Point<dim> from = given.point("first corner"),
                               to = given.point("second corner");
      for (unsigned int d = 0; d < dim; ++d)
        if (!(to[d] > from[d]))
          throw given.error("the second corner must be beyond the first along each axis");
      given.finish();
      Generator::subdivided_hyper_rectangle(cells, n, from, to, true);
    }
    else if (generator == "cylinder")
    {
      const double radius = given.positive("radius"), half_length = given.positive("half length");
      given.finish();
      if constexpr (dim == 3)
        Generator::cylinder(cells, radius, half_length);
      else
        throw EntryError(section + "Generator",
                         "a cylinder is in space; in the plane take hyper_ball");
    }
    else if (generator == "plate_with_a_hole")
      plate(cells, given);
    else
    {
      const dealii::Point<dim> centre = given.point("centre");
      const double radius = given.positive("radius");
      given.finish();
      if (generator == "quarter_hyper_ball")
        Generator::quarter_hyper_ball(cells, centre, radius);
      else if (generator == "half_hyper_ball")
        Generator::half_hyper_ball(cells, centre, radius);
      else
        Generator::hyper_ball(cells, centre, radius);
    }
  }

  template <int dim>
  void MeshEntries::plate(dealii::Triangulation<dim> &cells, MeshArguments<dim> &given)
  {
    const double radius = given.positive("radius of the hole"),
                 half_side = given.positive("half side of the square around it");
    if (!(half_side > radius))
      throw given.error("the half side of the square must be more than the radius of the hole");
    const std::vector<double> beside = given.numbers(4, "widths below, above, left and right");
    if (std::any_of(beside.begin(), beside.end(), [](const double w) { return w < 0.; }))
      throw given.error("the widths beside the square must not be negative");
    const double longest = *std::max_element(beside.begin(), beside.end()) / half_side;
    if (longest * longest > most_cells)
      throw given.error("these are more than 1e7 cells; make the square larger");
    const dealii::Point<dim> centre = given.point("centre");
    double thickness = 1., layers = 2.;
    if (dim == 3)
    {
      thickness = given.positive("thickness");
      layers = given.positive("layers of nodes");
      if (!(layers >= 2. && layers <= most_cells && layers == std::floor(layers)))
        throw given.error("layers of nodes are a whole number of at least 2");
    }
    given.finish();
    dealii::GridGenerator::plate_with_a_hole(cells, radius, half_side, beside[0], beside[1],
                                             beside[2], beside[3], centre, 0, 1, thickness,
                                             static_cast<unsigned int>(layers), true);
  }

  template <int dim>
  void MeshEntries::read(dealii::Triangulation<dim> &cells, const std::string &section) const
  {
    const std::shared_ptr<const std::string> text = read_data_file(file, section + "File");
    try
    {
      std::istringstream in(*text);
      const std::string extension = std::filesystem::path(file).extension().string();
      dealii::GridIn<dim> reader(cells);
      reader.read(in,
                  extension.empty() ? reader.Default : reader.parse_format(extension.substr(1)));
    }
    catch (const std::exception &e)
    {
      const std::string why = reason(e), what_to_do = remedy(why);
      throw EntryError(section + "File", "deal.II reads no mesh of dimension " +
                                             std::to_string(dim) + " from '" + file +
                                             "': " + (what_to_do.empty() ? why : what_to_do));
    }
    check_cells(cells, section + "File");
  }

  template <int dim>
  void MeshEntries::refine(dealii::Triangulation<dim> &cells, const std::string &section) const
  {
    const bool can_be_refined = cells.all_reference_cells_are_hyper_cube();
    if (!can_be_refined && local_refinements > 0)
      throw EntryError(section + "Local refinements",
                       "triangles and tetrahedra are not refined locally; refine where the mesh is "
                       "made, or use quadrilaterals or hexahedra");
    const auto check_number = [&](const double n, const char *const entry)
    {
      if (n > most_cells)
        throw EntryError(section + entry, "the mesh would have more than 1e7 cells; refine less");
    };
    check_number(cells.n_active_cells() * std::pow(2., dim * static_cast<double>(refinements)),
                 "Refinements");
    if (refinements > 0 && !can_be_refined)
      throw EntryError(section + "Refinements", "triangles and tetrahedra are not refined here; "
                                                "refine where the mesh is made");
    cells.refine_global(static_cast<int>(refinements));
    if (local_refinements == 0)
      return;
    if (where.empty())
      throw EntryError(section + "Refine where", "Local refinements needs a formula here");
    const Communicator processes = processes_of(cells);
    const Expression chosen(where, section + "Refine where", Expression::Variables::space);
    for (unsigned int r = 0; r < local_refinements; ++r)
    {
      bool any = false;
      for (const auto &cell : cells.active_cell_iterators())
      {
        const dealii::Point<dim> x = cell->center();
        if (cell->is_locally_owned() && chosen({x[0], x[1], dim == 3 ? x[dim - 1] : 0.}, r) > 0.)
        {
          cell->set_refine_flag();
          any = true;
        }
      }
      if (!processes.any(any))
        throw EntryError(section + "Refine where", "'" + where +
                                                       "' is positive at the centre of no "
                                                       "cell in refinement " +
                                                       std::to_string(r + 1));
      check_number(cells.n_global_active_cells() * std::pow(2., dim), "Local refinements");
      cells.execute_coarsening_and_refinement();
    }
  }

  template std::unique_ptr<dealii::Triangulation<2>>
  MeshEntries::make<2>(const std::string &) const;
  template std::unique_ptr<dealii::Triangulation<3>>
  MeshEntries::make<3>(const std::string &) const;
  template std::unique_ptr<dealii::Triangulation<2>>
  MeshEntries::make_distributed<2>(const std::string &, const Communicator &, unsigned int,
                                   double) const;
  template std::unique_ptr<dealii::Triangulation<3>>
  MeshEntries::make_distributed<3>(const std::string &, const Communicator &, unsigned int,
                                   double) const;
} // namespace taut
