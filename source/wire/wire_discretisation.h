// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_wire_discretisation_h
#define taut_wire_discretisation_h

#include <taut/wire/wire_component.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe.h>
#include <deal.II/grid/tria.h>

namespace taut
{
  /// The deal.II objects of a wire; only sources of WireComponent include these headers.
  struct WireComponent::Discretisation
  {
    dealii::Triangulation<1, 3> triangulation;
    std::unique_ptr<dealii::FiniteElement<1, 3>> element;
    dealii::DoFHandler<1, 3> dof_handler;
    dealii::QGauss<1> quadrature{1};

    Discretisation(const Wire &wire, const std::vector<double> &nodes, bool beam,
                   unsigned int degree);
  };
} // namespace taut

#endif
