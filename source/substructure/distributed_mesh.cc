// SPDX-License-Identifier: LGPL-2.1-or-later
#include "substructure/distributed_mesh.h"

#include <deal.II/base/config.h>

#include <deal.II/distributed/fully_distributed_tria.h>
#include <deal.II/distributed/tria_base.h>

#include <deal.II/dofs/dof_tools.h>

#include <deal.II/grid/cell_id.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/manifold_lib.h>
#include <deal.II/grid/tria_description.h>

#include <algorithm>
#include <map>

namespace taut
{
  template <int dim>
  Communicator processes_of(const dealii::Triangulation<dim> &triangulation)
  {
    if (dynamic_cast<const dealii::parallel::TriangulationBase<dim> *>(&triangulation))
      return Communicator(triangulation.get_communicator());
    return {};
  }

  template <int dim>
  std::unique_ptr<dealii::Triangulation<dim>>
  mesh_of_rank(dealii::Triangulation<dim> &whole, const Communicator &processes,
               const std::vector<unsigned int> &rank_of_cell, std::vector<unsigned int> &numbers)
  {
    auto result = std::make_unique<dealii::parallel::fullydistributed::Triangulation<dim>>(
        processes.of_mpi());
    for (const auto id : whole.get_manifold_ids())
    {
      if (id == dealii::numbers::flat_manifold_id)
        continue;
      const dealii::Manifold<dim> &manifold = whole.get_manifold(id);
      if (dynamic_cast<const dealii::TransfiniteInterpolationManifold<dim> *>(&manifold))
        return nullptr;
      result->set_manifold(id, manifold);
    }
    std::map<dealii::CellId, unsigned int> number_of;
    for (const auto &cell : whole.active_cell_iterators())
    {
      const unsigned int number = cell->active_cell_index();
      cell->set_subdomain_id(rank_of_cell[number]);
      if (rank_of_cell[number] == processes.rank())
        number_of[cell->id()] = number;
    }
    result->create_triangulation(
        dealii::TriangulationDescription::Utilities::create_description_from_triangulation(
            whole, processes.of_mpi()));
    numbers.clear();
    for (const auto &cell : result->active_cell_iterators())
      if (cell->is_locally_owned())
        numbers.push_back(number_of.at(cell->id()));
    return result;
  }

  template <int dim>
  std::vector<typename dealii::DoFHandler<dim>::active_cell_iterator>
  own_cells_of(const dealii::DoFHandler<dim> &handler)
  {
    std::vector<typename dealii::DoFHandler<dim>::active_cell_iterator> result;
    for (const auto &cell : handler.active_cell_iterators())
      if (cell->is_locally_owned())
        result.push_back(cell);
    return result;
  }

  template <int dim>
  dealii::IndexSet relevant_dofs(const dealii::DoFHandler<dim> &handler)
  {
    std::vector<dealii::types::global_dof_index> dofs, on_cell(handler.get_fe().n_dofs_per_cell());
    for (const auto &cell : handler.active_cell_iterators())
      if (!cell->is_artificial())
      {
        cell->get_dof_indices(on_cell);
        dofs.insert(dofs.end(), on_cell.begin(), on_cell.end());
      }
    std::sort(dofs.begin(), dofs.end());
    dofs.erase(std::unique(dofs.begin(), dofs.end()), dofs.end());
    dealii::IndexSet result(handler.n_dofs());
    result.add_indices(dofs.begin(), dofs.end());
    result.compress();
    return result;
  }

  template <int dim>
  void restrict_to_rank(dealii::AffineConstraints<double> &constraints,
                        const dealii::DoFHandler<dim> &handler)
  {
    if (processes_of(handler.get_triangulation()).size() == 1)
      return;
#if DEAL_II_VERSION_GTE(9, 6, 0)
    constraints.reinit(handler.locally_owned_dofs(), relevant_dofs(handler));
#else
    constraints.reinit(relevant_dofs(handler));
#endif
  }

  template <int dim>
  dealii::AffineConstraints<double> hanging_nodes(const dealii::DoFHandler<dim> &handler)
  {
    dealii::AffineConstraints<double> result;
    restrict_to_rank(result, handler);
    dealii::DoFTools::make_hanging_node_constraints(handler, result);
    result.close();
    return result;
  }

  namespace
  {
    /// A point this far from the unit cell is still on it, as in deal.II's search.
    constexpr double on_cell = 1e-10;

    /// The search of deal.II may end in the cell of another rank where a point is on two cells.
    template <int dim>
    std::pair<typename dealii::DoFHandler<dim>::active_cell_iterator, dealii::Point<dim>>
    own_cell_around(const dealii::DoFHandler<dim> &handler, const dealii::Mapping<dim> &mapping,
                    const dealii::Point<dim> &point)
    {
      for (const auto &cell : handler.active_cell_iterators())
      {
        // Curved cells reach beyond their corners, by less than their size.
        if (!cell->is_locally_owned() || !(cell->center().distance(point) <= 2. * cell->diameter()))
          continue;
        try
        {
          const dealii::Point<dim> unit = mapping.transform_real_to_unit_cell(cell, point);
          if (cell->reference_cell().contains_point(unit, on_cell))
            return {cell, unit};
        }
        catch (const dealii::ExceptionBase &) // far from the cell
        {
        }
      }
      return {handler.end(), {}};
    }
  } // namespace

  template <int dim>
  std::pair<typename dealii::DoFHandler<dim>::active_cell_iterator, dealii::Point<dim>>
  cell_around(const dealii::DoFHandler<dim> &handler, const dealii::Mapping<dim> &mapping,
              const dealii::Point<dim> &point)
  {
    if (processes_of(handler.get_triangulation()).size() > 1)
      return own_cell_around(handler, mapping, point);
    try
    {
      return dealii::GridTools::find_active_cell_around_point(mapping, handler, point);
    }
    catch (const dealii::ExceptionBase &)
    {
      return {handler.end(), {}};
    }
  }

  template Communicator processes_of(const dealii::Triangulation<1> &);
  template std::vector<dealii::DoFHandler<1>::active_cell_iterator>
  own_cells_of(const dealii::DoFHandler<1> &);
  template dealii::AffineConstraints<double> hanging_nodes(const dealii::DoFHandler<1> &);
  template dealii::IndexSet relevant_dofs(const dealii::DoFHandler<1> &);
  template void restrict_to_rank(dealii::AffineConstraints<double> &,
                                 const dealii::DoFHandler<1> &);
  template std::pair<dealii::DoFHandler<1>::active_cell_iterator, dealii::Point<1>>
  cell_around(const dealii::DoFHandler<1> &, const dealii::Mapping<1> &, const dealii::Point<1> &);
  template Communicator processes_of(const dealii::Triangulation<2> &);
  template std::unique_ptr<dealii::Triangulation<2>> mesh_of_rank(dealii::Triangulation<2> &,
                                                                  const Communicator &,
                                                                  const std::vector<unsigned int> &,
                                                                  std::vector<unsigned int> &);
  template std::vector<dealii::DoFHandler<2>::active_cell_iterator>
  own_cells_of(const dealii::DoFHandler<2> &);
  template dealii::AffineConstraints<double> hanging_nodes(const dealii::DoFHandler<2> &);
  template dealii::IndexSet relevant_dofs(const dealii::DoFHandler<2> &);
  template void restrict_to_rank(dealii::AffineConstraints<double> &,
                                 const dealii::DoFHandler<2> &);
  template std::pair<dealii::DoFHandler<2>::active_cell_iterator, dealii::Point<2>>
  cell_around(const dealii::DoFHandler<2> &, const dealii::Mapping<2> &, const dealii::Point<2> &);
  template Communicator processes_of(const dealii::Triangulation<3> &);
  template std::unique_ptr<dealii::Triangulation<3>> mesh_of_rank(dealii::Triangulation<3> &,
                                                                  const Communicator &,
                                                                  const std::vector<unsigned int> &,
                                                                  std::vector<unsigned int> &);
  template std::vector<dealii::DoFHandler<3>::active_cell_iterator>
  own_cells_of(const dealii::DoFHandler<3> &);
  template dealii::AffineConstraints<double> hanging_nodes(const dealii::DoFHandler<3> &);
  template dealii::IndexSet relevant_dofs(const dealii::DoFHandler<3> &);
  template void restrict_to_rank(dealii::AffineConstraints<double> &,
                                 const dealii::DoFHandler<3> &);
  template std::pair<dealii::DoFHandler<3>::active_cell_iterator, dealii::Point<3>>
  cell_around(const dealii::DoFHandler<3> &, const dealii::Mapping<3> &, const dealii::Point<3> &);
} // namespace taut
