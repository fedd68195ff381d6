// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/base/text.h>
#include <taut/solid/solid_conditions.h>

#include <deal.II/dofs/dof_tools.h>

#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace taut
{
  namespace
  {
    /// Largest deviation of a normal from an axis on a symmetry boundary.
    constexpr double along_axis = 1e-8;

    /// The axis along the normal of a face.
    template <int dim>
    unsigned int axis_of(const std::vector<dealii::Tensor<1, dim>> &normals)
    {
      for (unsigned int axis = 0; axis < dim; ++axis)
        if (std::all_of(normals.begin(), normals.end(),
                        [axis](const dealii::Tensor<1, dim> &n)
                        { return std::fabs(n[axis]) > 1. - along_axis; }))
          return axis;
      throw UserError("symmetry needs faces across an axis; the normal of one is (" +
                      std::to_string(normals[0][0]) + ", " + std::to_string(normals[0][1]) +
                      (dim == 3 ? ", " + std::to_string(normals[0][dim - 1]) : "") + ")");
    }

    /// Difference of two displacements that is rounding, over them, and over the size of the body.
    constexpr double same_motion = 1e-9, no_motion = 1e-12;

    /// Times at which motions are compared: 0, and from the first to the last with this ratio [s].
    constexpr double first_time = 1e-4, last_time = 100., time_ratio = 1.25;

    /// Displacement of a DoF; none where a table of a condition ends.
    std::optional<double> displacement(const BoundaryCondition &condition, const Coordinates &x,
                                       const unsigned int axis, const double t)
    {
      try
      {
        return condition.value ? condition.value(x, t)[axis] : 0.;
      }
      catch (const UserError &)
      {
        return std::nullopt;
      }
    }

    using Holder = std::pair<const BoundaryCondition *, dealii::types::boundary_id>;

    /// Throws UserError if two conditions give a DoF different displacements.
    template <int dim>
    void compare(const SolidMesh<dim> &mesh, const dealii::types::global_dof_index dof,
                 const Holder &a, const Holder &b)
    {
      if (a.first == b.first || !(a.first->value || b.first->value))
        return;
      const Coordinates x = coordinates<dim>(mesh.points()[dof]);
      const unsigned int axis = mesh.component(dof);
      const bool varies = a.first->varies || b.first->varies;
      for (double t = 0.; t <= (varies ? last_time : 0.); t = t > 0. ? time_ratio * t : first_time)
      {
        const auto first = displacement(*a.first, x, axis, t),
                   second = displacement(*b.first, x, axis, t);
        if (first && second &&
            std::fabs(*first - *second) >
                same_motion * std::max(std::fabs(*first), std::fabs(*second)) +
                    no_motion *
                        norm(coordinates<dim>(mesh.points().back() - mesh.points().front())))
          throw UserError(to_text("boundary ", b.second, " moves by ", *second, " m along ",
                                  "xyz"[axis], " at (", x, "), t = ", t, " s, where boundary ",
                                  a.second, " moves by ", *first, " m ('", a.first->origin,
                                  "'). Let them move alike where they meet, or leave this "
                                  "component of one of them empty"));
      }
    }
  } // namespace

  template <int dim>
  SolidConditions<dim>::SolidConditions(const SolidMesh<dim> &mesh,
                                        const std::vector<BoundaryCondition> &conditions)
  {
    dealii::AffineConstraints<double> hanging;
    dealii::DoFTools::make_hanging_node_constraints(mesh.dof_handler(), hanging);
    hanging.close();
    for (const auto &line : hanging.get_lines())
    {
      all.add_line(line.index);
      all.add_entries(line.index, line.entries);
    }
    const auto ids = mesh.boundary_ids();
    Holders holders;
    for (const BoundaryCondition &condition : conditions)
    {
      try
      {
        for (const auto id : condition.boundaries)
          if (ids.count(id) == 0)
            throw UserError(mesh.no_boundary(id));
        constrain(mesh, condition, holders);
      }
      catch (const UserError &e)
      {
        throw EntryError(condition.origin, e.what());
      }
    }
  }

  template <int dim>
  void SolidConditions<dim>::constrain(const SolidMesh<dim> &mesh,
                                       const BoundaryCondition &condition, Holders &holders)
  {
    using Kind = BoundaryCondition::Kind;
    if (condition.kind != Kind::displacement && condition.kind != Kind::symmetry)
      return;
    const dealii::FiniteElement<dim> &element = mesh.dof_handler().get_fe();
    dealii::FEFaceValues<dim> values(mesh.mapping(), element, mesh.face_quadrature(2),
                                     dealii::update_normal_vectors);
    std::vector<dealii::types::global_dof_index> dofs(element.n_dofs_per_face(0));
    for (const auto &cell : mesh.dof_handler().active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
      {
        if (!cell->face(f)->at_boundary() ||
            condition.boundaries.count(cell->face(f)->boundary_id()) == 0)
          continue;
        std::array<bool, 3> held = condition.held;
        if (condition.kind == Kind::symmetry)
        {
          values.reinit(cell, f);
          held = {false, false, false};
          held[axis_of<dim>(values.get_normal_vectors())] = true;
        }
        const auto id = cell->face(f)->boundary_id();
        for (unsigned int c = 0; c < dim; ++c)
          if (held[c])
          {
            const BoundaryCondition &other =
                *holders.of_boundary.try_emplace({id, c}, &condition).first->second;
            if (&other != &condition && (condition.value || other.value))
              throw UserError("boundary " + std::to_string(id) + " is held along " +
                              std::string(1, "xyz"[c]) + " by '" + other.origin +
                              "' as well; leave it to one of them");
          }
        cell->face(f)->get_dof_indices(dofs);
        for (const auto dof : dofs)
        {
          if (!held[mesh.component(dof)])
            continue;
          if (const auto known = holders.of_dof.find(dof); known != holders.of_dof.end())
            compare(mesh, dof, known->second, {&condition, id});
          if (all.is_constrained(dof)) // by another condition, or as hanging
            continue;
          all.add_line(dof);
          holders.of_dof[dof] = {&condition, id};
          if (condition.value)
            given.push_back({dof, &condition});
        }
      }
  }

  template class SolidConditions<2>;
  template class SolidConditions<3>;
} // namespace taut
