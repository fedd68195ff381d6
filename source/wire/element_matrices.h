// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_element_matrices_h
#define taut_element_matrices_h

#include "base/text.h"
#include <taut/base/exceptions.h>
#include <taut/scene/scene.h>

#include <deal.II/base/quadrature_lib.h>

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/fe/fe_values.h>

#include <deal.II/lac/full_matrix.h>

#include <vector>

namespace taut
{
  /// Tension at a place of a wire.
  inline double tension_at(const Wire &wire, const double s)
  {
    double tension = wire.tension;
    for (const TensionChange &c : wire.tension_changes)
      if (s > c.from && s < c.to)
        tension += c.change;
    return tension;
  }

  /// M and K of one element after the other, and the matrix of a bedding of stiffness 1.
  class ElementMatrices
  {
  public:
    ElementMatrices(const Wire &wire, const bool beam, const unsigned int degree,
                    const dealii::FiniteElement<1, 3> &element,
                    const dealii::Quadrature<1> &quadrature)
        : m(element.n_dofs_per_cell()), k(element.n_dofs_per_cell()),
          bedding(element.n_dofs_per_cell()), wire(wire), beam(beam),
          exact_mass(beam || wire.mass_matrix == MassMatrix::consistent),
          values(element, quadrature,
                 dealii::update_values | dealii::update_gradients |
                     (beam ? dealii::update_hessians : dealii::update_default) |
                     dealii::update_JxW_values),
          own_mass_values(element,
                          wire.mass_matrix == MassMatrix::lumped
                              ? dealii::Quadrature<1>(dealii::QGaussLobatto<1>(degree + 1))
                              : dealii::Quadrature<1>(dealii::QGauss<1>(degree)),
                          dealii::update_values | dealii::update_JxW_values)
    {
    }

    /// Of an element that begins at s = @p begin [m], with a tension or axial stiffness of which
    /// there is the share @p remaining.
    void compute(const dealii::DoFHandler<1, 3>::active_cell_iterator &cell, const double begin,
                 const double tension, const Expression &remaining = Expression())
    {
      values.reinit(cell);
      if (!exact_mass)
        own_mass_values.reinit(cell);
      const dealii::FEValues<1, 3> &mass_values = exact_mass ? values : own_mass_values;
      const dealii::Tensor<1, 3> t = (cell->vertex(1) - cell->vertex(0)) / cell->diameter();
      m = k = bedding = 0.;
      const auto at = [&](const dealii::FEValues<1, 3> &of, const unsigned int q)
      { return begin + cell->diameter() * of.get_quadrature().point(q)[0]; };
      mass.clear();
      for (const unsigned int q : mass_values.quadrature_point_indices())
        mass.push_back(wire.mass_per_length *
                       share(wire.remaining.mass, at(mass_values, q), "mass"));
      stretch.clear();
      bending.clear();
      for (const unsigned int q : values.quadrature_point_indices())
      {
        stretch.push_back(tension * share(remaining, at(values, q), "axial stiffness"));
        bending.push_back(wire.bending_stiffness * share(wire.remaining.bending_stiffness,
                                                         at(values, q), "bending stiffness"));
      }
      for (unsigned int i = 0; i < m.m(); ++i)
        for (unsigned int j = 0; j <= i; ++j)
        {
          for (const unsigned int q : mass_values.quadrature_point_indices())
            m(i, j) += mass[q] * mass_values.shape_value(i, q) * mass_values.shape_value(j, q) *
                       mass_values.JxW(q);
          for (const unsigned int q : values.quadrature_point_indices())
          {
            const double JxW = values.JxW(q);
            bedding(i, j) += values.shape_value(i, q) * values.shape_value(j, q) * JxW;
            k(i, j) +=
                stretch[q] * (values.shape_grad(i, q) * t) * (values.shape_grad(j, q) * t) * JxW;
            if (beam)
              k(i, j) += bending[q] * (t * values.shape_hessian(i, q) * t) *
                         (t * values.shape_hessian(j, q) * t) * JxW;
          }
        }
    }

    dealii::FullMatrix<double> m, k, bedding;

  private:
    double share(const Expression &of, const double s, const char *const what) const
    {
      const double result = Wire::Remaining::share(of, s);
      if (!(result > 0.))
        throw EntryError(wire.origin.empty() ? "" : wire.origin + "/Remaining " + what,
                         to_text("wire '", wire.name, "' has the share ", result, " of its ", what,
                                 " left at s = ", s,
                                 " m; give a positive share, of 1 for a wire as "
                                 "new"));
      return result;
    }

    const Wire &wire;
    const bool beam, exact_mass;
    dealii::FEValues<1, 3> values, own_mass_values;
    std::vector<double> mass, stretch, bending; ///< at the points
  };
} // namespace taut

#endif
