// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_box_in_parts_h
#define taut_box_in_parts_h

#include "verification/interface_problem.h"

#include "solid/divisible_solid.h"

#include <deal.II/grid/grid_generator.h>

namespace box_in_parts
{
  /// A square or cube of elements of size 1, E = 1, nu = 0.3, density 1, in equal boxes.
  struct Box
  {
    unsigned int n = 4;           ///< boxes in each direction
    unsigned int elements = 8;    ///< in each direction of a box: H / h
    double stiffness_jump = 1.;   ///< E of every other box
    unsigned int metis_parts = 0; ///< cut by METIS into as many; 0: into the boxes
  };

  /// It is fixed at x = 0 and hangs there by its weight, a unit of gravity along y.
  template <int dim>
  class BoxType : public taut::BodyType
  {
  public:
    explicit BoxType(const Box &box) : box(box)
    {
      std::vector<unsigned int> cells(dim, box.n * box.elements);
      dealii::Point<dim> corner;
      for (unsigned int d = 0; d < dim; ++d)
        corner[d] = box.n * box.elements;
      auto grid = std::make_unique<dealii::Triangulation<dim>>();
      dealii::GridGenerator::subdivided_hyper_rectangle(*grid, cells, dealii::Point<dim>(), corner,
                                                        true);
      for (const auto &cell : grid->active_cell_iterators())
      {
        unsigned int number = 0, sum = 0;
        for (unsigned int d = 0; d < dim; ++d)
        {
          const auto at = static_cast<unsigned int>(cell->center()[d] / box.elements);
          number = number * box.n + at;
          sum += at;
        }
        boxes.push_back(number);
        cell->set_material_id(sum % 2);
      }
      mesh = std::make_shared<const taut::SolidMesh<dim>>(std::move(grid), 1);
      options.materials = {{0, {1., .3, 1.}}, {1, {box.stiffness_jump, .3, 1.}}};
      options.gravity = {.3, 1., .5};
      options.conditions = {{taut::BoundaryCondition::Kind::displacement, {0}}};
    }

    std::unique_ptr<taut::Substructure> make(const taut::BodySetting &) const override
    {
      return std::make_unique<taut::ElasticSolid<dim>>("box", mesh, options);
    }
    std::shared_ptr<const taut::DivisibleBody> division(const taut::BodySetting &) const override
    {
      return std::make_shared<taut::DivisibleSolid<dim>>(mesh, options);
    }
    taut::ContactSurface surface(const taut::BodySetting &,
                                 const std::vector<unsigned int> &boundaries) const override
    {
      return mesh->surface({boundaries.begin(), boundaries.end()}).surface;
    }

    const Box box;
    std::vector<unsigned int> boxes; ///< of each cell
    std::shared_ptr<const taut::SolidMesh<dim>> mesh;

  private:
    typename taut::ElasticSolid<dim>::Options options;
  };

  template <int dim>
  taut::Scene scene(const std::shared_ptr<const BoxType<dim>> &type)
  {
    taut::Scene result;
    result.bodies = {{"box", "", "box", type}};
    return result;
  }

  template <int dim>
  std::unique_ptr<verification::InterfaceProblem> problem(const Box &box)
  {
    const auto type = std::make_shared<const BoxType<dim>>(box);
    if (box.metis_parts > 0)
      return std::make_unique<verification::InterfaceProblem>(scene<dim>(type), box.metis_parts);
    taut::Partition partition;
    partition.n_parts = dim == 2 ? box.n * box.n : box.n * box.n * box.n;
    partition.bodies = {{type->division({}), type->boxes}};
    return std::make_unique<verification::InterfaceProblem>(scene<dim>(type), partition);
  }
} // namespace box_in_parts

#endif
