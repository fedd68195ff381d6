// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/dealt_numbers.h"
#include "base/text.h"
#include "substructure/distributed_mesh.h"
#include <taut/base/exceptions.h>
#include <taut/solid/solid_conditions.h>
#include <taut/substructure/fe_body.h>

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

    /// A condition that holds a DoF, and the boundary on which it does.
    struct Holder
    {
      const BoundaryCondition *condition;
      dealii::types::boundary_id boundary;
    };

    /// Throws UserError if two conditions give a DoF different displacements. Times at which a
    /// table has no row are left out.
    template <int dim>
    void compare(const SolidMesh<dim> &mesh, const dealii::types::global_dof_index dof,
                 const Holder &first_holder, const Holder &second_holder)
    {
      const BoundaryCondition &a = *first_holder.condition, &b = *second_holder.condition;
      if (&a == &b || !(a.value || b.value))
        return;
      const Coordinates x = coordinates<dim>(mesh.point(dof));
      const double rounding = no_motion * mesh.size();
      const bool varies = a.varies || b.varies;
      const auto displacement = [&](const BoundaryCondition &condition, const double t)
      { return condition.value ? condition.value(x, t)[mesh.component(dof)] : 0.; };
      for (double t = 0.; t <= (varies ? last_time : 0.); t = std::max(first_time, time_ratio * t))
      {
        double first = 0., second = 0.;
        try
        {
          first = displacement(a, t);
          second = displacement(b, t);
        }
        catch (const UserError &)
        {
          continue;
        }
        if (std::fabs(first - second) >
            rounding + same_motion * std::max(std::fabs(first), std::fabs(second)))
          throw UserError(to_text("at (", x, ") boundary ", second_holder.boundary, " moves by ",
                                  second, " m along ", "xyz"[mesh.component(dof)],
                                  ", and boundary ", first_holder.boundary, " by ", first, " m ('",
                                  a.origin, "', t = ", t,
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
      for (const auto &cell : mesh.cells())
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
    template <typename Work>
    void about_condition(const BoundaryCondition &condition, const Work &work)
    {
      try
      {
        work();
      }
      catch (const UserError &e)
      {
        throw EntryError(condition.origin, e.what());
      }
    }
  } // namespace

  /// Of the DoFs on this rank: numbers of the conditions that hold each of them, ascending, and the
  /// boundary of each. A DoF may be held on the cells of other ranks alone: the rank to which its
  /// number leads collects what all found, and tells those that have the DoF.
  template <int dim>
  void SolidConditions<dim>::share(const SolidMesh<dim> &mesh, Held &held) const
  {
    const DealtNumbers dealt(mesh.processes(), mesh.dof_handler().n_dofs());
    const auto append = [](std::vector<unsigned int> &list, const unsigned int dof,
                           const std::pair<const unsigned int, unsigned int> &by) {
      list.insert(list.end(), {dof, by.first, by.second});
    };

    DealtNumbers::Messages found, wanted;
    for (const auto &[dof, conditions] : held)
      for (const auto &by : conditions)
        append(found[dealt.rank_of(dof)], dof, by);
    for (const auto dof : FEBody<dim>::part_dofs(mesh.cells(), all))
      wanted[dealt.rank_of(dof)].push_back(dof);
    std::map<dealii::types::global_dof_index, std::map<unsigned int, unsigned int>> collected;
    for (const auto &[rank, list] : dealt.exchange(found))
      for (std::size_t e = 0; e < list.size(); e += 3)
        collected[list[e]].emplace(list[e + 1], list[e + 2]);
    DealtNumbers::Messages answers;
    for (const auto &[rank, dofs] : dealt.exchange(wanted))
      for (const unsigned int dof : dofs)
        if (const auto known = collected.find(dof); known != collected.end())
          for (const auto &by : known->second)
            append(answers[rank], dof, by);
    held.clear();
    for (const auto &[rank, list] : dealt.exchange(answers))
      for (std::size_t e = 0; e < list.size(); e += 3)
        held[list[e]].emplace(list[e + 1], list[e + 2]);
  }

  template <int dim>
  SolidConditions<dim>::SolidConditions(const SolidMesh<dim> &mesh,
                                        const std::vector<BoundaryCondition> &conditions)
  {
    restrict_to_rank(all, mesh.dof_handler());
    const dealii::AffineConstraints<double> hanging = hanging_nodes(mesh.dof_handler());
    for (const auto &line : hanging.get_lines())
    {
      all.add_line(line.index);
      all.add_entries(line.index, line.entries);
    }
    Held held;
    mesh.processes().agree([&] { held = find_held(mesh, conditions); });
    if (mesh.processes().size() > 1)
      share(mesh, held);
    mesh.processes().agree([&] { constrain(mesh, conditions, held); });
  }

  template <int dim>
  typename SolidConditions<dim>::Held
  SolidConditions<dim>::find_held(const SolidMesh<dim> &mesh,
                                  const std::vector<BoundaryCondition> &conditions)
  {
    std::map<std::pair<dealii::types::boundary_id, unsigned int>, const BoundaryCondition *>
        holders; // of a boundary along an axis
    Held held;
    for (unsigned int number = 0; number < conditions.size(); ++number)
    {
      const BoundaryCondition &condition = conditions[number];
      const auto note = [&](const auto dof, const auto id)
      {
        const unsigned int c = mesh.component(dof);
        const BoundaryCondition &other = *holders.try_emplace({id, c}, &condition).first->second;
        if (&other != &condition && (condition.value || other.value))
          throw UserError("boundary " + std::to_string(id) + " is held along " +
                          std::string(1, "xyz"[c]) + " by '" + other.origin +
                          "' as well; leave it to one of them");
        held[dof].emplace(number, id);
      };
      about_condition(condition,
                      [&]
                      {
                        for (const auto id : condition.boundaries)
                          if (mesh.boundary_ids().count(id) == 0)
                            throw UserError(mesh.no_boundary(id));
                        visit_held(mesh, condition, note);
                      });
    }
    return held;
  }

  /// Where two boundaries meet, the first written condition counts; so do hanging nodes.
  template <int dim>
  void SolidConditions<dim>::constrain(const SolidMesh<dim> &mesh,
                                       const std::vector<BoundaryCondition> &conditions,
                                       const Held &held)
  {
    for (const auto &[dof, by] : held)
    {
      const BoundaryCondition &first = conditions[by.begin()->first];
      for (const auto &[number, id] : by)
        about_condition(
            conditions[number],
            [&, number = number, id = id, dof = dof] {
              compare(mesh, dof, {&first, by.begin()->second}, {&conditions[number], id});
            });
      if (all.is_constrained(dof))
        continue;
      all.add_line(dof);
      if (first.value)
        given.push_back({dof, &first});
    }
  }

  template class SolidConditions<2>;
  template class SolidConditions<3>;
} // namespace taut
