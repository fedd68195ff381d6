// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/unlike_weights.h"
#include <taut/solid/elastic_solid.h>

#include <deal.II/base/quadrature.h>

#include <deal.II/fe/fe_values.h>

#include <utility>

namespace taut
{
  /// Tractions and pressures. Constant loads are integrated once.
  template <int dim>
  void ElasticSolid<dim>::add_boundary_loads()
  {
    using Kind = BoundaryCondition::Kind;
    for (const BoundaryCondition &condition : options.conditions)
    {
      if ((condition.kind != Kind::traction && condition.kind != Kind::pressure) ||
          !condition.value)
        continue;
      std::vector<std::pair<Cell, unsigned int>> faces;
      for (const Cell &cell : this->cells())
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->at_boundary() &&
              condition.boundaries.count(cell->face(f)->boundary_id()) > 0)
            faces.emplace_back(cell, f);
      const auto add = [this, &condition, faces](const double t, dealii::Vector<double> &P)
      {
        const dealii::FiniteElement<dim> &element = mesh->dof_handler().get_fe();
        dealii::FEFaceValues<dim> values(
            mesh->mapping(), element, mesh->face_quadrature(mesh->degree() + 1),
            dealii::update_values | dealii::update_JxW_values | dealii::update_normal_vectors |
                dealii::update_quadrature_points);
        const double thickness = dim == 2 ? options.thickness : 1.;
        std::vector<dealii::types::global_dof_index> index(element.n_dofs_per_cell());
        for (const auto &[cell, f] : faces)
        {
          values.reinit(cell, f);
          cell->get_dof_indices(index);
          for (const unsigned int q : values.quadrature_point_indices())
          {
            const Coordinates given =
                condition.value(coordinates<dim>(values.quadrature_point(q)), t);
            for (unsigned int i = 0; i < index.size(); ++i)
            {
              const unsigned int c = element.system_to_component_index(i).first;
              const double traction = condition.kind == Kind::pressure
                                          ? -given[0] * values.normal_vector(q)[c]
                                          : given[c];
              P[this->index(index[i])] +=
                  thickness * traction * values.shape_value(i, q) * values.JxW(q);
            }
          }
        }
      };
      const auto sample = [&condition, faces](const double t)
      {
        constexpr std::size_t most_places = 4;
        constexpr double off_centre = .55; // where a load with a symmetry is not zero
        double sum = 0.;
        UnlikeWeights weights;
        for (std::size_t f = 0; f < faces.size(); f += faces.size() / most_places + 1)
        {
          const auto &[cell, face] = faces[f];
          const dealii::Point<dim> centre = cell->face(face)->center();
          const Coordinates value = condition.value(
              coordinates<dim>(centre + off_centre * (cell->face(face)->vertex(0) - centre)), t);
          for (const double force : {value.x, value.y, value.z})
            sum += weights.next() * force;
        }
        return sum;
      };
      if (condition.varies)
        this->add_load(add, sample);
      else
      {
        dealii::Vector<double> P(this->n_dofs());
        add(0., P);
        this->add_constant_load(P);
      }
    }
  }

  template void ElasticSolid<2>::add_boundary_loads();
  template void ElasticSolid<3>::add_boundary_loads();
} // namespace taut
