// SPDX-License-Identifier: LGPL-2.1-or-later
#include "solid/solid_entries.h"

#include "base/about_entry.h"
#include <taut/base/exceptions.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>

namespace taut
{
  namespace
  {
    namespace Patterns = dealii::Patterns;

    /// "id: text; id: text" as pairs.
    std::vector<std::pair<unsigned int, std::string>> by_id(const std::string &text,
                                                            const std::string &entry)
    {
      std::vector<std::pair<unsigned int, std::string>> result;
      for (const std::string &part : dealii::Utilities::split_string_list(text, ';'))
      {
        const std::size_t colon = part.find(':');
        int id = 0;
        try
        {
          if (colon == std::string::npos)
            throw std::invalid_argument("no colon");
          id = dealii::Utilities::string_to_int(dealii::Utilities::trim(part.substr(0, colon)));
          if (id < 0)
            throw std::invalid_argument("no id");
        }
        catch (const std::exception &)
        {
          throw EntryError(entry, "'" + part +
                                      "' does not begin with the number of an id and a colon, as "
                                      "in '2: 0, -1e5'");
        }
        result.emplace_back(id, dealii::Utilities::trim(part.substr(colon + 1)));
      }
      return result;
    }

    /// Splits a text at commas outside of brackets; empty parts are kept.
    std::vector<std::string> split(const std::string &text)
    {
      std::vector<std::string> parts(1);
      int depth = 0;
      for (const char c : text)
      {
        depth += c == '(' ? 1 : c == ')' ? -1 : 0;
        if (c == ',' && depth == 0)
          parts.emplace_back();
        else
          parts.back() += c;
      }
      for (std::string &part : parts)
        part = dealii::Utilities::trim(part);
      return parts;
    }

    double number(const std::string &text, const std::string &entry)
    {
      try
      {
        return dealii::Utilities::string_to_double(text);
      }
      catch (const std::exception &)
      {
        throw EntryError(entry, "'" + text + "' is not a number");
      }
    }

    /// Formulas of the components; a component without a formula is not held.
    BoundaryCondition vector_condition(const BoundaryCondition::Kind kind, const unsigned int id,
                                       const std::string &formulas, const unsigned int dimension,
                                       const std::string &entry)
    {
      const std::vector<std::string> parts = split(formulas);
      if (parts.size() != dimension)
        throw EntryError(entry, "'" + formulas + "' has " + std::to_string(parts.size()) +
                                    " components where the solid has " + std::to_string(dimension));
      BoundaryCondition condition;
      condition.kind = kind;
      condition.boundaries = {id};
      condition.origin = entry;
      std::array<Expression, 3> value;
      bool is_zero = true;
      for (unsigned int c = 0; c < dimension; ++c)
      {
        condition.held[c] = !parts[c].empty();
        if (parts[c].empty())
          continue;
        value[c] = Expression(parts[c], entry, Expression::Variables::space);
        condition.varies = condition.varies || value[c].depends_on_time();
        is_zero = is_zero && value[c].is_zero();
      }
      if (!is_zero)
        condition.value = [value](const Coordinates &x, const double t) {
          return Coordinates{value[0](x, t), value[1](x, t), value[2](x, t)};
        };
      return condition;
    }
  } // namespace

  void BoundaryEntries::declare(dealii::ParameterHandler &prm)
  {
    prm.add_parameter("Fixed boundaries", fixed, "Ids of parts of the boundary that do not move");
    prm.add_parameter("Symmetry boundaries", symmetric,
                      "Ids of parts of the boundary whose faces are across the axes, and do not "
                      "move along their normals");
    prm.add_parameter("Displacement", displacement,
                      "Given motion of parts of the boundary: 'id: formula, formula; id: ...', one "
                      "formula of x, y, z, t a component [m]; a component without one is free, as "
                      "in '3: , -1e-3*t'");
    prm.add_parameter("Traction", traction,
                      "Force per area on parts of the boundary: 'id: formula, formula; id: ...' "
                      "[Pa]");
    prm.add_parameter("Pressure", pressure,
                      "On parts of the boundary, against their normal: 'id: formula; id: ...' "
                      "[Pa]");
  }

  std::vector<BoundaryCondition> BoundaryEntries::conditions(const unsigned int dimension,
                                                             const std::string &origin) const
  {
    using Kind = BoundaryCondition::Kind;
    std::vector<BoundaryCondition> result;
    const auto add =
        [&](const Kind kind, const std::vector<unsigned int> &ids, const std::string &entry)
    {
      if (ids.empty())
        return;
      result.emplace_back();
      result.back().kind = kind;
      result.back().boundaries = {ids.begin(), ids.end()};
      result.back().origin = origin + entry;
    };
    add(Kind::displacement, fixed, "Fixed boundaries");
    for (const auto &[id, text] : by_id(displacement, origin + "Displacement"))
      result.push_back(
          vector_condition(Kind::displacement, id, text, dimension, origin + "Displacement"));
    add(Kind::symmetry, symmetric, "Symmetry boundaries");
    for (const auto &[id, text] : by_id(traction, origin + "Traction"))
      result.push_back(vector_condition(Kind::traction, id, text, dimension, origin + "Traction"));
    for (const auto &[id, text] : by_id(pressure, origin + "Pressure"))
      result.push_back(vector_condition(Kind::pressure, id, text, 1, origin + "Pressure"));
    return result;
  }

  void SolidEntries::declare(dealii::ParameterHandler &prm)
  {
    prm.add_parameter("Dimension", dimension, "2: in the plane, 3: in space",
                      Patterns::Integer(2, 3));
    prm.add_parameter("Degree", degree, "Polynomial degree of the elements",
                      Patterns::Integer(1, 2));
    mesh.declare(prm);
    prm.add_parameter("Young's modulus", youngs_modulus, "E [Pa]");
    prm.add_parameter("Poisson's ratio", poissons_ratio, "nu, more than -1 and less than 0.5 [1]");
    prm.add_parameter("Density", density, "[kg/m^3]", Patterns::Double(0.));
    prm.add_parameter(
        "Materials", materials,
        "Materials by the ids of the mesh, instead of the three entries above: 'id: E, "
        "nu, density; id: E, nu, density'");
    prm.add_parameter("Plane state", plane_state,
                      "Of a solid in the plane: strain, it cannot expand across the plane; stress, "
                      "it is free to",
                      Patterns::Selection("strain|stress"));
    prm.add_parameter("Thickness", thickness, "Of a solid in the plane [m]",
                      Patterns::Double(std::numeric_limits<double>::min()));
    prm.add_parameter("Mass matrix", mass_matrix,
                      "consistent: integrated exactly; lumped: at the nodes; reduced: with one "
                      "Gauss point less in each direction",
                      Patterns::Selection("consistent|lumped|reduced"));
    prm.add_parameter("Boundaries without mass", without_mass,
                      "Ids of parts of the boundary, of a contact say, whose nodes have no mass: "
                      "the nodes next to them take it. Forces of an impact then do not depend on "
                      "the step");
    prm.add_parameter("Redistributed mass", mass_kept,
                      "Of boundaries without mass: total goes to the next nodes, so that the total "
                      "mass stays; inertia to those of four layers of cells, so that also its "
                      "centre and moments of inertia do",
                      Patterns::Selection("total|inertia"));
    prm.add_parameter("Mass damping", mass_damping, "a in C = a M + b K [1/s]",
                      Patterns::Double(0.));
    prm.add_parameter("Stiffness damping", stiffness_damping, "b in C = a M + b K [s]",
                      Patterns::Double(0.));
    boundaries.declare(prm);
    prm.add_parameter("Largest turn", largest_turn,
                      "A run ends when a part of the boundary turns by more: the equations are "
                      "those of small turns. It is warned of from 0.1 rad on [rad]",
                      Patterns::Double(std::numeric_limits<double>::min()));
    prm.add_parameter("Initial velocity", initial_velocity,
                      "Of all points, with Start = given: 'x, y' or 'x, y, z' [m/s]");
  }

  template <int dim>
  void SolidEntries::check_materials(const typename ElasticSolid<dim>::Options &options,
                                     const SolidMesh<dim> &mesh)
  {
    for (const auto &cell : mesh.cells())
      options.material(cell->material_id());
  }

  template <int dim>
  typename ElasticSolid<dim>::Options SolidEntries::options(const BodySetting &setting,
                                                            const SolidMesh<dim> &cells) const
  {
    const std::string origin = setting.origin.empty() ? "" : setting.origin + "/";
    typename ElasticSolid<dim>::Options o;
    o.origin = setting.origin;
    if (materials.empty())
    {
      if (!(youngs_modulus > 0.))
        throw EntryError(origin + "Young's modulus", "a solid needs a positive one [Pa]");
      if (!(poissons_ratio > -1. && poissons_ratio < .5))
        throw EntryError(origin + "Poisson's ratio", "it must be more than -1 and less than 0.5");
      o.materials[ElasticSolid<dim>::other_materials] = {youngs_modulus, poissons_ratio, density};
    }
    for (const auto &[id, text] : by_id(materials, origin + "Materials"))
    {
      const std::vector<std::string> parts = split(text);
      if (parts.size() != 3)
        throw EntryError(origin + "Materials", "'" + text +
                                                   "' is not Young's modulus, Poisson's ratio and "
                                                   "density, as in '1: 210e9, 0.3, 7850'");
      const ElasticMaterial material = {number(parts[0], origin + "Materials"),
                                        number(parts[1], origin + "Materials"),
                                        number(parts[2], origin + "Materials")};
      if (!o.materials.emplace(id, material).second)
        throw EntryError(origin + "Materials",
                         "material " + std::to_string(id) + " is given twice; remove one");
    }
    if (!materials.empty())
      about_entry(origin + "Materials", [&] { check_materials<dim>(o, cells); });
    o.plane_state = plane_state == "stress" ? PlaneState::stress : PlaneState::strain;
    o.thickness = thickness;
    o.mass = mass_matrix == "lumped"    ? SolidMass::lumped
             : mass_matrix == "reduced" ? SolidMass::reduced
                                        : SolidMass::consistent;
    o.without_mass = {without_mass.begin(), without_mass.end()};
    o.keeps_inertia = mass_kept == "inertia";
    o.mass_damping = mass_damping;
    o.stiffness_damping = stiffness_damping;
    o.gravity = setting.gravity;
    o.conditions = boundaries.conditions(dimension, origin);
    if (!initial_velocity.empty() && initial_velocity.size() != dim)
      throw EntryError(origin + "Initial velocity",
                       "it has " + std::to_string(initial_velocity.size()) +
                           " components where the solid has " + std::to_string(dim));
    if (!initial_velocity.empty())
      o.initial_velocity = {initial_velocity[0], initial_velocity[1],
                            dim == 3 ? initial_velocity[dim - 1] : 0.};
    return o;
  }

  template ElasticSolid<2>::Options SolidEntries::options<2>(const BodySetting &,
                                                             const SolidMesh<2> &) const;
  template ElasticSolid<3>::Options SolidEntries::options<3>(const BodySetting &,
                                                             const SolidMesh<3> &) const;
} // namespace taut
