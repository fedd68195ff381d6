// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/unlike_weights.h"
#include <taut/solid/elastic_solid.h>

#include <deal.II/base/quadrature.h>

#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <utility>

namespace taut
{
  namespace
  {
    /// Quadrature points of some of the faces, at which the search for pulses looks at a load.
    template <int dim, typename Faces>
    std::vector<Coordinates> sampled_places(const SolidMesh<dim> &mesh,
                                            const dealii::Quadrature<dim - 1> &quadrature,
                                            const Faces &faces)
    {
      constexpr std::size_t most_faces = 100;
      dealii::FEFaceValues<dim> values(mesh.mapping(), mesh.dof_handler().get_fe(), quadrature,
                                       dealii::update_quadrature_points);
      std::vector<Coordinates> places;
      const std::size_t n = std::min(most_faces, faces.size());
      for (std::size_t k = 0; k < n; ++k)
      {
        const auto &[cell, face] = faces[(2 * k + 1) * faces.size() / (2 * n)];
        values.reinit(cell, face);
        for (const dealii::Point<dim> &point : values.get_quadrature_points())
          places.push_back(coordinates<dim>(point));
      }
      return places;
    }
  } // namespace

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
      const dealii::Quadrature<dim - 1> quadrature = mesh->face_quadrature(mesh->degree() + 1);
      const auto add =
          [this, &condition, faces, quadrature](const double t, dealii::Vector<double> &P)
      {
        const dealii::FiniteElement<dim> &element = mesh->dof_handler().get_fe();
        dealii::FEFaceValues<dim> values(mesh->mapping(), element, quadrature,
                                         dealii::update_values | dealii::update_JxW_values |
                                             dealii::update_normal_vectors |
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
      if (!condition.varies)
      {
        dealii::Vector<double> P(this->n_dofs());
        add(0., P);
        this->add_constant_load(P);
        continue;
      }
      const std::vector<Coordinates> places = sampled_places<dim>(*mesh, quadrature, faces);
      const auto sample = [&condition, places](const double t, const std::size_t n_places)
      {
        double sum = 0.;
        UnlikeWeights weights;
        const std::size_t n = std::min(n_places, places.size());
        for (std::size_t k = 0; k < n; ++k)
        {
          const Coordinates value =
              condition.value(places[(2 * k + 1) * places.size() / (2 * n)], t);
          for (const double force : {value.x, value.y, value.z})
            sum += weights.next() * force;
        }
        return sum;
      };
      constexpr std::size_t few_places = 8;
      this->add_load(
          add, [=](const double t) { return sample(t, few_places); }, sample);
    }
  }

  template void ElasticSolid<2>::add_boundary_loads();
  template void ElasticSolid<3>::add_boundary_loads();
} // namespace taut
