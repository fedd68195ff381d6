// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_cell_division_h
#define taut_cell_division_h

#include <taut/base/lasting.h>
#include <taut/scene/partition.h>

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/fe/mapping.h>

#include <deal.II/lac/affine_constraints.h>

namespace taut
{
  /// The cells of an FEBody for a DivisibleBody: active cells of the triangulation that are locally
  /// owned, in their order. The triangulation may be distributed. Use it in BodyType::division() of
  /// a body of deal.II.
  template <int dim>
  class CellDivision
  {
  public:
    /// @p dof_handler and @p mapping are kept by reference; @p constraints are the constraints of
    /// the body.
    CellDivision(Lasting<dealii::DoFHandler<dim>> dof_handler,
                 Lasting<dealii::Mapping<dim>> mapping,
                 const dealii::AffineConstraints<double> &constraints);

    const BodyCells &cells() const { return body_cells; }

    /// The cell of each number.
    using Cell = typename dealii::DoFHandler<dim>::active_cell_iterator;
    const std::vector<Cell> &cell_iterators() const { return own_cells; }

    /// As DivisibleBody::processes(): those of the triangulation.
    const Communicator &processes() const { return ranks; }

    /// As DivisibleBody::cell_at().
    std::size_t cell_at(const Coordinates &place) const;

  private:
    const dealii::DoFHandler<dim> &handler;
    const dealii::Mapping<dim> &mapping;
    const Communicator ranks;
    std::vector<Cell> own_cells;
    BodyCells body_cells;
  };
} // namespace taut

#endif
