// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_distributed_mesh_h
#define taut_distributed_mesh_h

#include <taut/base/communicator.h>

#include <deal.II/base/index_set.h>
#include <deal.II/base/point.h>

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/fe/mapping.h>

#include <deal.II/lac/affine_constraints.h>

#include <memory>
#include <utility>
#include <vector>

namespace taut
{
  /// The ranks over which a triangulation is distributed; one process if it is not.
  template <int dim>
  Communicator processes_of(const dealii::Triangulation<dim> &triangulation);

  /**
   * The active cells of @p whole that @p rank_of_cell, for each of them, gives this rank, with
   * those beside them, as a `parallel::fullydistributed::Triangulation`; null for a mesh with a
   * TransfiniteInterpolationManifold, which needs all coarse cells. @p whole, the same on all
   * ranks, gets the ranks as subdomains. @p numbers: of the cells of this rank among those of @p
   * whole.
   */
  template <int dim>
  std::unique_ptr<dealii::Triangulation<dim>>
  mesh_of_rank(dealii::Triangulation<dim> &whole, const Communicator &processes,
               const std::vector<unsigned int> &rank_of_cell, std::vector<unsigned int> &numbers);

  /// The locally owned active cells of a DoFHandler: all of a serial triangulation.
  template <int dim>
  std::vector<typename dealii::DoFHandler<dim>::active_cell_iterator>
  own_cells_of(const dealii::DoFHandler<dim> &handler);

  /// DoFs on cells of this rank and beside it.
  template <int dim>
  dealii::IndexSet relevant_dofs(const dealii::DoFHandler<dim> &handler);

  /// Lets constraints know the relevant_dofs() alone, if the triangulation is distributed.
  template <int dim>
  void restrict_to_rank(dealii::AffineConstraints<double> &constraints,
                        const dealii::DoFHandler<dim> &handler);

  /// The constraints of hanging nodes on cells of this rank, closed.
  template <int dim>
  dealii::AffineConstraints<double> hanging_nodes(const dealii::DoFHandler<dim> &handler);

  /// The locally owned cell with a point and the place of the point in the unit cell;
  /// handler.end(): the point is on none.
  template <int dim>
  std::pair<typename dealii::DoFHandler<dim>::active_cell_iterator, dealii::Point<dim>>
  cell_around(const dealii::DoFHandler<dim> &handler, const dealii::Mapping<dim> &mapping,
              const dealii::Point<dim> &point);
} // namespace taut

#endif
