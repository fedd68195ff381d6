// SPDX-License-Identifier: LGPL-2.1-or-later
#include "solid_entries.h"

#include <taut/base/exceptions.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/patterns.h>

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_in.h>
#include <deal.II/grid/grid_tools.h>

#include <fstream>
#include <regex>

namespace taut
{
  namespace
  {
    namespace Patterns = dealii::Patterns;

    /// What an error of deal.II says, without where it was raised.
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
  } // namespace

  void MeshEntries::declare(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Mesh");
    prm.add_parameter("File", file,
                      "Of a mesh in a format that deal.II reads, e.g. .msh of gmsh; empty: "
                      "Generator makes it");
    prm.add_parameter(
        "Generator", generator,
        "Function of deal.II's GridGenerator: hyper_cube, subdivided_hyper_rectangle, "
        "hyper_ball, quarter_hyper_ball, cylinder, plate_with_a_hole, ...");
    prm.add_parameter(
        "Arguments", arguments,
        "Those of the function after the mesh, with colons between them, numbers in "
        "m: e.g. '4, 2 : 0, 0 : 2, 1 : true' for cells, two corners, and boundary ids "
        "2d (left or lower) and 2d + 1 across axis d");
    prm.add_parameter("Refinements", refinements, "Each halves all cells in each direction");
    prm.add_parameter("Local refinements", local_refinements,
                      "Times that the cells are halved whose centre Refine where is positive at");
    prm.add_parameter("Refine where", where,
                      "Formula of x, y, z at the centre of a cell, positive where it is refined; t "
                      "is the number of local refinements so far, e.g. '0.1/2^t-sqrt(x^2+y^2)'");
    prm.add_parameter("Shift", shift, "Added to all points, x, y or x, y, z [m]");
    prm.leave_subsection();
  }

  template <int dim>
  std::unique_ptr<dealii::Triangulation<dim>> MeshEntries::make(const std::string &origin) const
  {
    const std::string section = origin.empty() ? "Mesh/" : origin + "/Mesh/";
    auto cells = std::make_unique<dealii::Triangulation<dim>>();
    if (file.empty())
      generate(*cells, section);
    else
      read(*cells, section);
    if (!shift.empty())
    {
      if (shift.size() != dim)
        throw EntryError(section + "Shift", "it has " + std::to_string(shift.size()) +
                                                " components where the solid has " +
                                                std::to_string(dim));
      dealii::Tensor<1, dim> by;
      for (unsigned int d = 0; d < dim; ++d)
        by[d] = shift[d];
      dealii::GridTools::shift(by, *cells);
    }
    refine(*cells, section);
    return cells;
  }

  template <int dim>
  void MeshEntries::generate(dealii::Triangulation<dim> &cells, const std::string &section) const
  {
    try
    {
      dealii::GridGenerator::generate_from_name_and_arguments(cells, generator, arguments);
    }
    catch (const std::exception &e)
    {
      throw EntryError(section + "Arguments", "deal.II makes no mesh by " + generator + "(" +
                                                  arguments + "): " + reason(e));
    }
    for (const auto &cell : cells.active_cell_iterators())
      if (!(cell->measure() > 0.))
        throw EntryError(section + "Arguments",
                         generator + "(" + arguments +
                             ") makes cells that are empty or turned inside "
                             "out; check sizes and the order of the corners");
  }

  template <int dim>
  void MeshEntries::read(dealii::Triangulation<dim> &cells, const std::string &section) const
  {
    if (!std::ifstream(file))
      throw EntryError(section + "File", "cannot read '" + file + "'");
    try
    {
      dealii::GridIn<dim> reader(cells);
      reader.read(file);
    }
    catch (const std::exception &e)
    {
      throw EntryError(section + "File", "deal.II reads no mesh of dimension " +
                                             std::to_string(dim) + " from '" + file +
                                             "': " + reason(e));
    }
  }

  template <int dim>
  void MeshEntries::refine(dealii::Triangulation<dim> &cells, const std::string &section) const
  {
    const bool can_be_refined = cells.all_reference_cells_are_hyper_cube();
    if (!can_be_refined && local_refinements > 0)
      throw EntryError(section + "Local refinements",
                       "triangles and tetrahedra are not refined locally; refine where the mesh is "
                       "made, or use quadrilaterals or hexahedra");
    cells.refine_global(static_cast<int>(refinements));
    if (local_refinements == 0)
      return;
    if (where.empty())
      throw EntryError(section + "Refine where", "Local refinements needs a formula here");
    const Expression chosen(where, section + "Refine where", Expression::Variables::space);
    for (unsigned int r = 0; r < local_refinements; ++r)
    {
      bool any = false;
      for (const auto &cell : cells.active_cell_iterators())
      {
        const dealii::Point<dim> x = cell->center();
        if (chosen({x[0], x[1], dim == 3 ? x[dim - 1] : 0.}, r) > 0.)
        {
          cell->set_refine_flag();
          any = true;
        }
      }
      if (!any)
        throw EntryError(section + "Refine where", "'" + where +
                                                       "' is positive at the centre of no "
                                                       "cell in refinement " +
                                                       std::to_string(r + 1));
      cells.execute_coarsening_and_refinement();
    }
  }

  template std::unique_ptr<dealii::Triangulation<2>>
  MeshEntries::make<2>(const std::string &) const;
  template std::unique_ptr<dealii::Triangulation<3>>
  MeshEntries::make<3>(const std::string &) const;
} // namespace taut
