// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/text.h"
#include "substructure/distributed_mesh.h"
#include <taut/base/exceptions.h>
#include <taut/substructure/fe_body.h>

#include <deal.II/fe/fe.h>
#include <deal.II/fe/mapping_q1.h>

#include <algorithm>
#include <cmath>

namespace taut
{
  namespace
  {
    /// Refuses constraints that were closed before: hanging nodes then do not follow the DoFs in
    /// @p moved.
    template <int dim, typename Value>
    void check_hanging_nodes(const FEBody<dim> &body,
                             const std::map<dealii::types::global_dof_index, Value> &moved)
    {
      // Of the cells of this rank: that of a distributed triangulation asks the others.
      if (moved.empty() || !body.dof_handler()
                                .get_triangulation()
                                .dealii::template Triangulation<dim>::has_hanging_nodes())
        return;
      const dealii::AffineConstraints<double> whole = hanging_nodes(body.dof_handler());
      for (const auto &line : whole.get_lines())
      {
        if (!body.has_dof(line.index) || moved.count(line.index) != 0)
          continue;
        const auto known = body.displacement_of_dof(line.index).index;
        for (const auto &[dof, weight] : line.entries)
          if (moved.count(dof) != 0 &&
              std::find(known.begin(), known.end(), body.index(dof)) == known.end())
            throw UserError("body '" + body.name() + "': DoF " + std::to_string(dof) +
                            " is prescribed, and the constraint of hanging DoF " +
                            std::to_string(line.index) +
                            " has forgotten it; hand over AffineConstraints that are not closed, "
                            "or prescribe that DoF, too");
      }
    }
  } // namespace

  /// A time-dependent load on the kept DoFs.
  template <int dim>
  class FEBody<dim>::Load : public TimeLoad
  {
  public:
    Load(const FEBody<dim> &body, std::function<void(double, dealii::Vector<double> &)> add,
         std::function<double(double)> sample,
         std::function<double(double, std::size_t)> sample_at_places)
        : body(body), add_load(std::move(add)), sample_load(std::move(sample)),
          sample_places(std::move(sample_at_places))
    {
    }
    void add(const double t, std::vector<double> &P) const override
    {
      dealii::Vector<double> own(P.size());
      add_load(t, own);
      body.check_size(own.size(), "load in time");
      body.condense(own, P);
    }
    double sample(const double t) const override
    {
      return sample_load ? sample_load(t) : TimeLoad::sample(t);
    }
    double sample_at_places(const double t, const std::size_t n_places) const override
    {
      return sample_places ? sample_places(t, n_places) : TimeLoad::sample_at_places(t, n_places);
    }

  private:
    const FEBody<dim> &body;
    const std::function<void(double, dealii::Vector<double> &)> add_load;
    const std::function<double(double)> sample_load;
    const std::function<double(double, std::size_t)> sample_places;
  };

  template <int dim>
  FEBody<dim>::FEBody(const std::string &name, const Lasting<dealii::DoFHandler<dim>> dof_handler,
                      const dealii::SparseMatrix<double> &mass,
                      const dealii::SparseMatrix<double> &damping,
                      const dealii::SparseMatrix<double> &stiffness,
                      const dealii::AffineConstraints<double> &constraints,
                      const dealii::Vector<double> &load, const Options &options)
      : Substructure(name, options.origin), handler(dof_handler),
        mapping(options.mapping ? *options.mapping : dealii::StaticMappingQ1<dim>::mapping),
        scalar_direction(options.direction)
  {
    own_cells = options.cells.empty() ? own_cells_of(handler) : options.cells;
    std::sort(own_cells.begin(), own_cells.end());
    if (!options.cells.empty() || processes_of(handler.get_triangulation()).size() > 1)
      own_dofs = part_dofs(own_cells, constraints);
    const unsigned int n = n_rows = own_dofs.empty() ? handler.n_dofs() : own_dofs.size();
    check_matrix(mass, "mass matrix");
    check_matrix(stiffness, "stiffness matrix");
    if (!damping.empty())
      check_matrix(damping, "damping matrix");
    if (load.size() != 0)
      check_size(load.size(), "load");
    if (!options.kinds.empty())
    {
      check_size(options.kinds.size(), "list of kinds");
      kinds = options.kinds;
    }

    for (unsigned int i = 0; i < n; ++i)
    {
      const dealii::types::global_dof_index dof = own_dofs.empty() ? i : own_dofs[i];
      const auto *entries =
          constraints.is_constrained(dof) ? constraints.get_constraint_entries(dof) : nullptr;
      if (entries)
        for (const auto &[j, weight] : *entries)
          dependences[i].add(index(j), weight);
      if (!constraints.is_constrained(dof))
        continue;
      const double value = constraints.get_inhomogeneity(dof);
      if (value != 0. && entries && !entries->empty())
        throw UserError("body '" + name + "': DoF " + std::to_string(dof) +
                        " depends on others and has an inhomogeneity; prescribe those others");
      constrained.push_back({i});
      constrained.back().displacement = value;
    }

    M = std::make_unique<CompressedMatrix>(n);
    C = std::make_unique<CompressedMatrix>(n);
    K = std::make_unique<CompressedMatrix>(n);
    set_matrix(mass, *M);
    set_matrix(stiffness, *K);
    if (!damping.empty())
      set_matrix(damping, *C);
    constant_force.assign(n, 0.);
    if (load.size() != 0)
      condense(load, constant_force);
    finish();
    find_null_space(options);
  }

  template <int dim>
  void FEBody<dim>::check_size(const std::size_t size, const std::string &what) const
  {
    if (size != n_rows)
      throw UserError("body '" + name() + "': its " + what + " has size " + std::to_string(size) +
                      ", and " +
                      (own_dofs.empty() ? "its DoFHandler " : "the part of its DoFHandler ") +
                      std::to_string(n_rows) + " DoFs");
  }

  /// Checks that a matrix has the right size and is symmetric: y . A x = x . A y for two vectors
  /// that do not depend on the matrix.
  template <int dim>
  void FEBody<dim>::check_matrix(const dealii::SparseMatrix<double> &A,
                                 const std::string &what) const
  {
    check_size(A.empty() ? 0 : A.m(), what);
    check_size(A.n(), what);
    constexpr double rounding = 1e-8; // asymmetry of an assembly by rounding, far below any effect
    dealii::Vector<double> x(A.m()), y(A.m()), Ax(A.m()), Ay(A.m());
    for (std::size_t i = 0; i < x.size(); ++i)
    {
      x[i] = std::sin(1. + i);
      y[i] = std::cos(2. * i);
    }
    A.vmult(Ax, x);
    A.vmult(Ay, y);
    const double difference = std::fabs(y * Ax - x * Ay),
                 size = y.l2_norm() * Ax.l2_norm() + x.l2_norm() * Ay.l2_norm();
    if (difference > rounding * size)
      throw UserError("body '" + name() + "': its " + what +
                      " is not symmetric; a body has symmetric ones");
  }

  template <int dim>
  std::vector<dealii::types::global_dof_index>
  FEBody<dim>::part_dofs(const std::vector<Cell> &cells,
                         const dealii::AffineConstraints<double> &constraints)
  {
    std::vector<dealii::types::global_dof_index> result, on_cell;
    for (const Cell &cell : cells)
    {
      on_cell.resize(cell->get_fe().n_dofs_per_cell());
      cell->get_dof_indices(on_cell);
      for (const auto dof : on_cell)
      {
        result.push_back(dof);
        if (constraints.is_constrained(dof))
          for (const auto &[other, weight] : *constraints.get_constraint_entries(dof))
            result.push_back(other);
      }
    }
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }

  template <int dim>
  bool FEBody<dim>::has_cell(const Cell &cell) const
  {
    return own_dofs.empty() || std::binary_search(own_cells.begin(), own_cells.end(), cell);
  }

  template <int dim>
  bool FEBody<dim>::has_dof(const dealii::types::global_dof_index dof) const
  {
    return own_dofs.empty() ? dof < n_rows
                            : std::binary_search(own_dofs.begin(), own_dofs.end(), dof);
  }

  template <int dim>
  unsigned int FEBody<dim>::index(const dealii::types::global_dof_index dof) const
  {
    if (own_dofs.empty())
      return dof;
    return std::lower_bound(own_dofs.begin(), own_dofs.end(), dof) - own_dofs.begin();
  }

  /// T^T A T with the rows of T in `dependences`, lower triangle.
  template <int dim>
  void FEBody<dim>::set_matrix(const dealii::SparseMatrix<double> &source,
                               SymmetricMatrix &target) const
  {
    for (unsigned int i = 0; i < source.m(); ++i)
      for (auto entry = source.begin(i); entry != source.end(i); ++entry)
      {
        for_each_kept(i,
                      [&](const unsigned int row, const double by_row)
                      {
                        for_each_kept(entry->column(),
                                      [&](const unsigned int column, const double by_column)
                                      {
                                        if (row >= column)
                                          target.add(row, column,
                                                     by_row * by_column * entry->value());
                                      });
                      });
      }
  }

  /// result += T^T P.
  template <int dim>
  void FEBody<dim>::condense(const dealii::Vector<double> &P, std::vector<double> &result) const
  {
    for (unsigned int i = 0; i < n_rows; ++i)
      if (P[i] != 0.)
        for_each_kept(i, [&](const unsigned int kept, const double weight)
                      { result[kept] += weight * P[i]; });
  }

  template <int dim>
  void FEBody<dim>::add_load(std::function<void(double, dealii::Vector<double> &)> add,
                             std::function<double(double)> sample,
                             std::function<double(double, std::size_t)> sample_at_places)
  {
    if (!add)
      throw UserError("body '" + name() + "': a load in time has no function; hand one over");
    time_loads.push_back(std::make_unique<Load>(*this, std::move(add), std::move(sample),
                                                std::move(sample_at_places)));
  }

  template <int dim>
  void FEBody<dim>::add_constant_load(const dealii::Vector<double> &P)
  {
    check_size(P.size(), "load");
    for (const double force : P)
      if (!std::isfinite(force))
        throw UserError("body '" + name() + "': its load is not finite");
    condense(P, constant_force);
  }

  template <int dim>
  ConstrainedDof &FEBody<dim>::prescribed(const dealii::types::global_dof_index dof)
  {
    const unsigned int own = has_dof(dof) ? index(dof) : n_rows;
    const auto found =
        std::lower_bound(constrained.begin(), constrained.end(), own,
                         [](const ConstrainedDof &c, const unsigned int i) { return c.dof < i; });
    if (!has_dof(dof) || found == constrained.end() || found->dof != own ||
        dependences.count(own) != 0)
      throw UserError("body '" + name() + "': no constraint prescribes DoF " + std::to_string(dof));
    return *found;
  }

  template <int dim>
  void FEBody<dim>::prescribe(
      const std::map<dealii::types::global_dof_index, std::function<double(double)>> &motions)
  {
    for (const auto &[dof, motion] : motions)
      prescribed(dof).motion = motion;
    check_hanging_nodes(*this, motions);
    finish();
  }

  template <int dim>
  void FEBody<dim>::prescribe_displacements(
      const std::map<dealii::types::global_dof_index, double> &displacements)
  {
    for (const auto &[dof, displacement] : displacements)
      prescribed(dof).displacement = displacement;
    check_hanging_nodes(*this, displacements);
    finish();
  }

  template <int dim>
  void FEBody<dim>::set_initial_state(const dealii::Vector<double> &displacement,
                                      const dealii::Vector<double> &velocity)
  {
    check_size(displacement.size(), "initial displacement");
    check_size(velocity.size(), "initial velocity");
    U0 = displacement;
    V0 = velocity;
  }

  template <int dim>
  void FEBody<dim>::initial_state(std::vector<double> &U, std::vector<double> &V) const
  {
    Substructure::initial_state(U, V);
    if (U0.size() == 0)
      return;
    std::copy(U0.begin(), U0.end(), U.begin());
    std::copy(V0.begin(), V0.end(), V.begin());
    for (const ConstrainedDof &constraint : constrained)
      U[constraint.dof] = V[constraint.dof] = 0.;
  }

  template <int dim>
  LinearForm FEBody<dim>::displacement(const Coordinates &place, const Coordinates &direction) const
  {
    const dealii::FiniteElement<dim> &element = handler.get_fe();
    if (element.n_components() != 1 && element.n_components() != dim)
      throw UserError("body '" + name() + "': an element of " +
                      std::to_string(element.n_components()) +
                      " components says of no place how it is displaced; override displacement()");
    dealii::Point<dim> point;
    for (unsigned int d = 0; d < dim; ++d)
      point[d] = place[d];
    const auto [cell, unit] = cell_around(handler, mapping, point);
    if (cell == handler.end() || !has_cell(cell))
      throw UserError(to_text("body '", name(), "': the point ", point, " is not on it"));
    std::vector<dealii::types::global_dof_index> dofs(element.n_dofs_per_cell());
    cell->get_dof_indices(dofs);
    double along = 0.;
    for (int d = 0; d < 3; ++d)
      along += direction[d] * scalar_direction[d];
    LinearForm result;
    for (unsigned int i = 0; i < dofs.size(); ++i)
      for (unsigned int c = 0; c < element.n_components(); ++c)
      {
        const double value = element.shape_value_component(i, unit, c) *
                             (element.n_components() == 1 ? along : direction[c]);
        if (value != 0.)
          for_each_kept(index(dofs[i]), [&](const unsigned int kept, const double weight)
                        { result.add(kept, value * weight); });
      }
    return result;
  }

  template <int dim>
  LinearForm FEBody<dim>::displacement_of_dof(const dealii::types::global_dof_index dof) const
  {
    if (!has_dof(dof))
      throw UserError("body '" + name() + "' has no DoF " + std::to_string(dof));
    LinearForm result;
    for_each_kept(index(dof),
                  [&](const unsigned int kept, const double weight) { result.add(kept, weight); });
    return result;
  }

  template <int dim>
  dealii::Vector<double> FEBody<dim>::all_dofs(const std::vector<double> &U) const
  {
    dealii::Vector<double> result(handler.n_dofs());
    for (std::size_t i = 0; i < U.size(); ++i)
      result[own_dofs.empty() ? i : own_dofs[i]] = value(i, U);
    return result;
  }

  template class FEBody<1>;
  template class FEBody<2>;
  template class FEBody<3>;
} // namespace taut
