// SPDX-License-Identifier: LGPL-2.1-or-later
#include "solid/boundary_mass.h"

#include <taut/base/exceptions.h>
#include <taut/solid/elastic_solid.h>

#include <deal.II/base/quadrature_lib.h>

#include <deal.II/fe/fe_values.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/full_matrix.h>

#include <deal.II/numerics/vector_tools.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace taut
{
  namespace
  {
    void check_material(const ElasticMaterial &m)
    {
      if (!(m.youngs_modulus > 0.) || !std::isfinite(m.youngs_modulus))
        throw UserError("Young's modulus must be positive, and it is " +
                        std::to_string(m.youngs_modulus));
      if (!(m.poissons_ratio > -1. && m.poissons_ratio < .5))
        throw UserError("Poisson's ratio must be between -1 and 0.5, and it is " +
                        std::to_string(m.poissons_ratio));
      if (!(m.density >= 0.) || !std::isfinite(m.density))
        throw UserError("the density must not be negative, and it is " + std::to_string(m.density));
    }
  } // namespace

  template <int dim>
  const ElasticMaterial &
  ElasticSolid<dim>::Options::material(const dealii::types::material_id id) const
  {
    auto found = materials.find(id);
    if (found == materials.end())
      found = materials.find(other_materials);
    if (found == materials.end())
      throw UserError("the mesh has cells of material " + std::to_string(id) +
                      ", of which no material is given");
    return found->second;
  }

  template <int dim>
  std::pair<double, double>
  ElasticSolid<dim>::Options::lame(const dealii::types::material_id id) const
  {
    const ElasticMaterial &m = material(id);
    const double mu = m.youngs_modulus / (2. * (1. + m.poissons_ratio)),
                 lambda = 2. * mu * m.poissons_ratio / (1. - 2. * m.poissons_ratio);
    return {dim == 2 && plane_state == PlaneState::stress ? 2. * lambda * mu / (lambda + 2. * mu)
                                                          : lambda,
            mu};
  }

  template <int dim>
  struct ElasticSolid<dim>::Assembled
  {
    /// Assembles these cells only, with mass_factors() of the uncut solid; without cells it
    /// assembles all cells.
    Assembled(const SolidMesh<dim> &mesh, const Options &options,
              const dealii::AffineConstraints<double> &constraints, std::vector<Cell> part,
              const std::vector<double> *part_factors);

    dealii::SparsityPattern pattern;
    dealii::SparseMatrix<double> M, C, K;
    dealii::Vector<double> load;
    std::vector<double> factors; ///< of M, rows and columns; empty: none

  private:
    void add_stiffness(const SolidMesh<dim> &mesh, const Options &options);
    void add_mass(const SolidMesh<dim> &mesh, const Options &options);

    std::vector<Cell> cells;
    std::vector<std::vector<dealii::types::global_dof_index>> index; ///< rows of each cell
  };

  template <int dim>
  ElasticSolid<dim>::Assembled::Assembled(const SolidMesh<dim> &mesh, const Options &options,
                                          const dealii::AffineConstraints<double> &constraints,
                                          std::vector<Cell> part,
                                          const std::vector<double> *const part_factors)
      : cells(part.empty() ? mesh.cells() : std::move(part))
  {
    if (options.materials.empty())
      throw UserError("no material is given");
    for (const auto &[id, m] : options.materials)
      check_material(m);
    const auto dofs = FEBody<dim>::part_dofs(cells, constraints);
    dealii::DynamicSparsityPattern all(dofs.size());
    for (const Cell &cell : cells)
    {
      index.emplace_back(mesh.dof_handler().get_fe().n_dofs_per_cell());
      cell->get_dof_indices(index.back());
      for (auto &dof : index.back())
        dof = std::lower_bound(dofs.begin(), dofs.end(), dof) - dofs.begin();
      for (const auto row : index.back())
        all.add_entries(row, index.back().begin(), index.back().end());
    }
    pattern.copy_from(all);
    for (auto *matrix : {&M, &K})
      matrix->reinit(pattern);
    load.reinit(dofs.size());
    add_stiffness(mesh, options);
    add_mass(mesh, options);
    if (part_factors)
      factors = *part_factors;
    else if (!options.without_mass.empty())
    {
      const auto &ids = mesh.boundary_ids();
      for (const auto id : options.without_mass)
        if (ids.count(id) == 0)
          throw UserError(mesh.no_boundary(id));
      factors =
          factors_without_mass(mesh, options.without_mass, constraints, options.keeps_inertia, M);
    }
    for (unsigned int i = 0; !factors.empty() && i < M.m(); ++i)
      for (auto entry = M.begin(i); entry != M.end(i); ++entry)
        entry->value() *= factors[dofs[i]] * factors[dofs[entry->column()]];
    if (options.mass_damping != 0. || options.stiffness_damping != 0.)
    {
      C.reinit(pattern);
      C.add(options.mass_damping, M);
      C.add(options.stiffness_damping, K);
    }
  }

  template <int dim>
  void ElasticSolid<dim>::Assembled::add_stiffness(const SolidMesh<dim> &mesh,
                                                   const Options &options)
  {
    const dealii::FiniteElement<dim> &element = mesh.dof_handler().get_fe();
    dealii::FEValues<dim> values(mesh.mapping(), element, mesh.quadrature(mesh.degree() + 1),
                                 dealii::update_gradients | dealii::update_JxW_values);
    const unsigned int n = element.n_dofs_per_cell();
    const double thickness = dim == 2 ? options.thickness : 1.;
    dealii::FullMatrix<double> k(n, n);
    for (std::size_t number = 0; number < cells.size(); ++number)
    {
      const Cell &cell = cells[number];
      values.reinit(cell);
      const auto [lambda, mu] = options.lame(cell->material_id());
      k = 0.;
      for (const unsigned int q : values.quadrature_point_indices())
      {
        const double dx = thickness * values.JxW(q);
        for (unsigned int i = 0; i < n; ++i)
        {
          const unsigned int a = element.system_to_component_index(i).first;
          const auto &gi = values.shape_grad(i, q);
          for (unsigned int j = 0; j <= i; ++j)
          {
            const unsigned int b = element.system_to_component_index(j).first;
            const auto &gj = values.shape_grad(j, q);
            k(i, j) +=
                (lambda * gi[a] * gj[b] + mu * gi[b] * gj[a] + (a == b ? mu * (gi * gj) : 0.)) * dx;
          }
        }
      }
      const auto &rows = index[number];
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j <= i; ++j)
        {
          K.add(rows[i], rows[j], k(i, j));
          if (i != j)
            K.add(rows[j], rows[i], k(i, j));
        }
    }
  }

  /// The mass, and the weight, which is consistent for every kind of mass matrix.
  template <int dim>
  void ElasticSolid<dim>::Assembled::add_mass(const SolidMesh<dim> &mesh, const Options &options)
  {
    const dealii::FiniteElement<dim> &element = mesh.dof_handler().get_fe();
    const bool lumped = options.mass == SolidMass::lumped;
    if (lumped && mesh.is_simplicial() && mesh.degree() == 2)
      throw UserError("lumped masses of degree 2 on triangles or tetrahedra are none at their "
                      "corners; take Mass matrix = consistent, or degree 1");
    const unsigned int n_points = mesh.degree() + (options.mass == SolidMass::reduced ? 0 : 1);
    const dealii::Quadrature<dim> exact = mesh.quadrature(n_points),
                                  weighing = mesh.quadrature(mesh.degree() + 1);
    dealii::FEValues<dim> values(mesh.mapping(), element, exact,
                                 dealii::update_values | dealii::update_JxW_values),
        weights(mesh.mapping(), element, weighing,
                dealii::update_values | dealii::update_JxW_values);
    const unsigned int n = element.n_dofs_per_cell();
    const double thickness = dim == 2 ? options.thickness : 1.;
    std::vector<double> row(n);
    for (std::size_t number = 0; number < cells.size(); ++number)
    {
      const Cell &cell = cells[number];
      const auto &rows = index[number];
      values.reinit(cell);
      weights.reinit(cell);
      const double density = options.material(cell->material_id()).density * thickness;
      double cell_mass = 0., diagonal_mass = 0.;
      std::vector<double> diagonal(n, 0.);
      for (unsigned int i = 0; i < n; ++i)
      {
        const unsigned int c = element.system_to_component_index(i).first;
        std::fill(row.begin(), row.end(), 0.);
        for (unsigned int j = 0; j < n; ++j)
          if (element.system_to_component_index(j).first == c)
            for (const unsigned int q : values.quadrature_point_indices())
              row[j] +=
                  density * values.shape_value(i, q) * values.shape_value(j, q) * values.JxW(q);
        if (!lumped)
          for (unsigned int j = 0; j < n; ++j)
            if (element.system_to_component_index(j).first == c)
              M.add(rows[i], rows[j], row[j]);
        diagonal[i] = row[i];
        if (c == 0)
        {
          diagonal_mass += row[i];
          for (const double m : row)
            cell_mass += m;
        }
        double share = 0.;
        for (const unsigned int q : weights.quadrature_point_indices())
          share += density * weights.shape_value(i, q) * weights.JxW(q);
        load[rows[i]] += options.gravity[c] * share;
      }
      // The diagonal of the mass matrix, scaled so that the cell keeps its mass (E. Hinton, T.
      // Rock, O. C. Zienkiewicz, Earthquake Engineering and Structural Dynamics 4 (1976)).
      if (lumped && diagonal_mass > 0.)
        for (unsigned int i = 0; i < n; ++i)
          M.add(rows[i], rows[i], diagonal[i] * cell_mass / diagonal_mass);
    }
  }

  template <int dim>
  ElasticSolid<dim>::ElasticSolid(const std::string &name,
                                  std::shared_ptr<const SolidMesh<dim>> mesh,
                                  const Options &options)
      : ElasticSolid(name, mesh, options, SolidConditions<dim>(*mesh, options.conditions))
  {
  }

  template <int dim>
  ElasticSolid<dim>::ElasticSolid(const std::string &name,
                                  std::shared_ptr<const SolidMesh<dim>> mesh,
                                  const Options &options, const SolidConditions<dim> &conditions)
      : ElasticSolid(name, mesh, options, conditions, {},
                     Assembled(*mesh, options, conditions.constraints(), {}, nullptr))
  {
  }

  template <int dim>
  ElasticSolid<dim>::ElasticSolid(const std::string &name,
                                  std::shared_ptr<const SolidMesh<dim>> mesh,
                                  const Options &options, const SolidConditions<dim> &conditions,
                                  const std::vector<Cell> &part,
                                  const std::vector<double> &mass_factors)
      : ElasticSolid(name, mesh, options, conditions, part,
                     Assembled(*mesh, options, conditions.constraints(), part, &mass_factors))
  {
  }

  template <int dim>
  std::vector<double> ElasticSolid<dim>::mass_factors(const SolidMesh<dim> &mesh,
                                                      const Options &options,
                                                      const SolidConditions<dim> &conditions)
  {
    if (options.without_mass.empty())
      return {};
    if (mesh.processes().size() > 1)
      throw UserError("boundaries without mass need the mesh on one rank: do not distribute it");
    return Assembled(mesh, options, conditions.constraints(), {}, nullptr).factors;
  }

  template <int dim>
  ElasticSolid<dim>::ElasticSolid(const std::string &name,
                                  std::shared_ptr<const SolidMesh<dim>> given,
                                  const Options &chosen, const SolidConditions<dim> &conditions,
                                  const std::vector<Cell> &part, const Assembled &assembled)
      : FEBody<dim>(name, given->dof_handler(), assembled.M, assembled.C, assembled.K,
                    conditions.constraints(), assembled.load,
                    [&]
                    {
                      typename FEBody<dim>::Options o;
                      o.origin = chosen.origin;
                      o.mapping = &given->mapping();
                      o.cells = part;
                      return o;
                    }()),
        mesh(std::move(given)), options(chosen), strained(*mesh)
  {
    std::map<dealii::types::global_dof_index, std::function<double(double)>> motions;
    std::map<dealii::types::global_dof_index, double> displacements;
    for (const auto &[dof, by] : conditions.prescribed())
    {
      if (!this->has_dof(dof))
        continue;
      const Coordinates x = coordinates<dim>(mesh->point(dof));
      const unsigned int c = mesh->component(dof);
      if (by->varies)
        motions[dof] = [value = by->value, x, c](const double t) { return value(x, t)[c]; };
      else
        displacements[dof] = by->value(x, 0.)[c];
    }
    this->prescribe(motions);
    this->prescribe_displacements(displacements);
    add_boundary_loads();
    if (norm(options.initial_velocity) > 0.)
    {
      dealii::Vector<double> U(this->n_dofs()), V(this->n_dofs());
      for (dealii::types::global_dof_index dof = 0; dof < mesh->dof_handler().n_dofs(); ++dof)
        if (this->has_dof(dof))
          V[this->index(dof)] = options.initial_velocity[mesh->component(dof)];
      this->set_initial_state(U, V);
    }
  }

  template <int dim>
  LinearForm ElasticSolid<dim>::node_displacement(const unsigned int node,
                                                  const Coordinates &direction) const
  {
    LinearForm result;
    for (unsigned int c = 0; c < dim; ++c)
      if (direction[c] != 0.)
      {
        const LinearForm form = this->displacement_of_dof(mesh->whole_surface().dofs[node][c]);
        for (std::size_t i = 0; i < form.index.size(); ++i)
          result.add(form.index[i], direction[c] * form.value[i]);
      }
    return result;
  }

  template class ElasticSolid<2>;
  template class ElasticSolid<3>;
} // namespace taut
