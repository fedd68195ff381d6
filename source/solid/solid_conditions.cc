// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/text.h"
#include <taut/base/exceptions.h>
#include <taut/solid/solid_conditions.h>

#include <deal.II/dofs/dof_tools.h>

#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>

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

    using Holder = std::pair<const BoundaryCondition *, dealii::types::boundary_id>;

    /// Throws UserError if two conditions give a DoF different displacements. Times at which a
    /// table has no row are left out.
    template <int dim>
    void compare(const SolidMesh<dim> &mesh, const dealii::types::global_dof_index dof,
                 const Holder &a, const Holder &b)
    {
      if (a.first == b.first || !(a.first->value || b.first->value))
        return;
      const Coordinates x = coordinates<dim>(mesh.points()[dof]);
      const double rounding =
          no_motion * norm(coordinates<dim>(mesh.points().back() - mesh.points().front()));
      const bool varies = a.first->varies || b.first->varies;
      const auto displacement = [&](const BoundaryCondition &condition, const double t)
      { return condition.value ? condition.value(x, t)[mesh.component(dof)] : 0.; };
      for (double t = 0.; t <= (varies ? last_time : 0.); t = std::max(first_time, time_ratio * t))
      {
        double first = 0., second = 0.;
        try
        {
          first = displacement(*a.first, t);
          second = displacement(*b.first, t);
        }
        catch (const UserError &)
        {
          continue;
        }
        if (std::fabs(first - second) >
            rounding + same_motion * std::max(std::fabs(first), std::fabs(second)))
          throw UserError(to_text("at (", x, ") boundary ", b.second, " moves by ", second,
                                  " m along ", "xyz"[mesh.component(dof)], ", and boundary ",
                                  a.second, " by ", first, " m ('", a.first->origin, "', t = ", t,
                                  " s). Let them move alike where they meet, or "
                                  "leave this component of one of them empty"));
      }
    }

    /// Calls @p visit with the DoFs that a condition holds, and the boundary of each.
    template <int dim, typename Visit>
    void visit_held(const SolidMesh<dim> &mesh, const BoundaryCondition &condition,
                    const Visit &visit)
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
          cell->face(f)->get_dof_indices(dofs);
          for (const auto dof : dofs)
            if (held[mesh.component(dof)])
              visit(dof, cell->face(f)->boundary_id());
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
    std::map<dealii::types::global_dof_index, Holder> of_dof;
    for (const BoundaryCondition &condition : conditions)
    {
      try
      {
        for (const auto id : condition.boundaries)
          if (ids.count(id) == 0)
            throw UserError(mesh.no_boundary(id));
        constrain(mesh, condition, holders);
        visit_held(mesh, condition,
                   [&](const auto dof, const auto id)
                   {
                     const Holder holder{&condition, id};
                     compare(mesh, dof, of_dof.try_emplace(dof, holder).first->second, holder);
                   });
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
    visit_held(
        mesh, condition,
        [&](const auto dof, const auto id)
        {
          const unsigned int c = mesh.component(dof);
          const BoundaryCondition &other = *holders.try_emplace({id, c}, &condition).first->second;
          if (&other != &condition && (condition.value || other.value))
            throw UserError("boundary " + std::to_string(id) + " is held along " +
                            std::string(1, "xyz"[c]) + " by '" + other.origin +
                            "' as well; leave it to one of them");
          // Where two boundaries meet, the first written condition counts; so do hanging
          // nodes.
          if (all.is_constrained(dof))
            return;
          all.add_line(dof);
          if (condition.value)
            given.push_back({dof, &condition});
        });
  }

  template class SolidConditions<2>;
  template class SolidConditions<3>;
} // namespace taut
