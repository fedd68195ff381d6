// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_divisible_fe_body_h
#define taut_divisible_fe_body_h

#include <taut/scene/divisible_body.h>

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/fe/mapping.h>

#include <deal.II/lac/affine_constraints.h>

#include <vector>

namespace taut
{
  /**
   * How an FEBody is cut along the faces of the active cells of its triangulation. What is left to
   * do is make_part(): assemble over these cells only, rows and columns by FEBody::part_dofs().
   */
  template <int dim>
  class DivisibleFEBody : public DivisibleBody
  {
  public:
    using Cell = typename dealii::DoFHandler<dim>::active_cell_iterator;

    /// @p dof_handler and @p mapping are kept by reference; @p constraints are those of the body.
    DivisibleFEBody(const dealii::DoFHandler<dim> &dof_handler, const dealii::Mapping<dim> &mapping,
                    const dealii::AffineConstraints<double> &constraints);

    const BodyCells &cells() const override { return body_cells; }
    std::size_t cell_at(const Coordinates &place) const override;

    /// Throws UserError: a body without a surface for contacts has no such nodes.
    std::size_t cell_at_node(unsigned int node) const override;

    /// The active cells with these numbers.
    std::vector<Cell> cells(const std::vector<unsigned int> &numbers) const;

  private:
    const dealii::DoFHandler<dim> &handler;
    const dealii::Mapping<dim> &mapping;
    std::vector<Cell> active_cells;
    BodyCells body_cells;
  };
} // namespace taut

#endif
