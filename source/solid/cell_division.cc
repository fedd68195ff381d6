// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/text.h"
#include "substructure/distributed_mesh.h"
#include <taut/base/exceptions.h>
#include <taut/solid/cell_division.h>
#include <taut/substructure/fe_body.h>

#include <algorithm>

namespace taut
{
  template <int dim>
  CellDivision<dim>::CellDivision(const Lasting<dealii::DoFHandler<dim>> dof_handler,
                                  const Lasting<dealii::Mapping<dim>> map,
                                  const dealii::AffineConstraints<double> &constraints)
      : handler(dof_handler), mapping(map), ranks(processes_of(handler.get_triangulation())),
        own_cells(own_cells_of(handler))
  {
    body_cells.dim = dim;
    constexpr unsigned int elsewhere = -1;
    std::vector<unsigned int> number_of(handler.get_triangulation().n_active_cells(), elsewhere);
    for (unsigned int number = 0; number < own_cells.size(); ++number)
      number_of[own_cells[number]->active_cell_index()] = number;
    for (unsigned int number = 0; number < own_cells.size(); ++number)
    {
      const Cell &cell = own_cells[number];
      for (const auto dof : FEBody<dim>::part_dofs({cell}, constraints))
        body_cells.dofs.push_back(dof);
      body_cells.begin.push_back(body_cells.dofs.size());
      // A face between cells of different size is the face of the smaller cell.
      for (const unsigned int f : cell->face_indices())
        if (!cell->at_boundary(f) && cell->neighbor(f)->is_active())
          if (const unsigned int other = number_of[cell->neighbor(f)->active_cell_index()];
              other != elsewhere && (cell->neighbor_is_coarser(f) || other < number))
            body_cells.faces.emplace_back(number, other);
    }
    std::vector<unsigned int> &numbers = body_cells.numbers;
    if (ranks.size() > 1)
    {
      numbers = body_cells.dofs;
      std::sort(numbers.begin(), numbers.end());
      numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
      for (unsigned int &dof : body_cells.dofs)
        dof = std::lower_bound(numbers.begin(), numbers.end(), dof) - numbers.begin();
      body_cells.n_dofs_of_all = handler.n_dofs();
      body_cells.n_cells_of_all = handler.get_triangulation().n_global_active_cells();
    }
    body_cells.is_determined.resize(numbers.empty() ? handler.n_dofs() : numbers.size());
    for (std::size_t dof = 0; dof < body_cells.is_determined.size(); ++dof)
      body_cells.is_determined[dof] =
          constraints.is_constrained(numbers.empty() ? dof : numbers[dof]);
  }

  template <int dim>
  std::size_t CellDivision<dim>::cell_at(const Coordinates &place) const
  {
    dealii::Point<dim> point;
    for (unsigned int d = 0; d < dim; ++d)
      point[d] = place[d];
    const Cell cell = cell_around(handler, mapping, point).first;
    const auto found = std::lower_bound(own_cells.begin(), own_cells.end(), cell);
    if (found == own_cells.end() || *found != cell)
      throw UserError(to_text("the point ", point, " is not on the body"));
    return found - own_cells.begin();
  }

  template class CellDivision<1>;
  template class CellDivision<2>;
  template class CellDivision<3>;
} // namespace taut
