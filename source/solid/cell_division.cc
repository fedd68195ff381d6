// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/text.h"
#include <taut/base/exceptions.h>
#include <taut/solid/cell_division.h>
#include <taut/substructure/fe_body.h>

#include <deal.II/grid/grid_tools.h>

namespace taut
{
  template <int dim>
  CellDivision<dim>::CellDivision(const Lasting<dealii::DoFHandler<dim>> dof_handler,
                                  const Lasting<dealii::Mapping<dim>> map,
                                  const dealii::AffineConstraints<double> &constraints)
      : handler(dof_handler), mapping(map)
  {
    body_cells.dim = dim;
    for (const auto &cell : handler.active_cell_iterators())
    {
      const unsigned int number = cell->active_cell_index();
      for (const auto dof : FEBody<dim>::part_dofs({cell}, constraints))
        body_cells.dofs.push_back(dof);
      body_cells.begin.push_back(body_cells.dofs.size());
      // A face between cells of different size is the face of the smaller cell.
      for (const unsigned int f : cell->face_indices())
        if (!cell->at_boundary(f) && cell->neighbor(f)->is_active() &&
            (cell->neighbor_is_coarser(f) || cell->neighbor(f)->active_cell_index() < number))
          body_cells.faces.emplace_back(number, cell->neighbor(f)->active_cell_index());
    }
    body_cells.is_determined.resize(handler.n_dofs());
    for (dealii::types::global_dof_index dof = 0; dof < handler.n_dofs(); ++dof)
      body_cells.is_determined[dof] = constraints.is_constrained(dof);
  }

  template <int dim>
  std::size_t CellDivision<dim>::cell_at(const Coordinates &place) const
  {
    dealii::Point<dim> point;
    for (unsigned int d = 0; d < dim; ++d)
      point[d] = place[d];
    try
    {
      const auto [cell, unit] =
          dealii::GridTools::find_active_cell_around_point(mapping, handler, point);
      if (cell != handler.end())
        return cell->active_cell_index();
    }
    catch (const dealii::ExceptionBase &)
    {
    }
    throw UserError(to_text("the point ", point, " is not on the body"));
  }

  template class CellDivision<1>;
  template class CellDivision<2>;
  template class CellDivision<3>;
} // namespace taut
