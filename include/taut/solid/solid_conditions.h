// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_solid_conditions_h
#define taut_solid_conditions_h

#include <taut/solid/solid_mesh.h>

#include <deal.II/lac/affine_constraints.h>

#include <array>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace taut
{
  /// What is given on a part of the boundary.
  struct BoundaryCondition
  {
    enum class Kind
    {
      displacement, ///< of the components that are held [m]
      symmetry,     ///< no motion along the normal of faces across the axes
      traction,     ///< force per area, along x, y, z [Pa]
      pressure      ///< against the outward normal, the x of the value [Pa]
    };
    Kind kind = Kind::displacement;
    std::set<dealii::types::boundary_id> boundaries;
    std::array<bool, 3> held = {true, true, true};

    /// The value at a point x [m] and t [s]; none: zero.
    std::function<Coordinates(const Coordinates &x, double t)> value = {};
    bool varies = false; ///< in time

    std::string origin = {}; ///< path of its section in the parameter file, for messages
  };

  /// The DoFs of a mesh that hang between others or whose displacement is given.
  template <int dim>
  class SolidConditions
  {
  public:
    /// @p conditions are kept by reference. Throws EntryError about one with a boundary that the
    /// mesh does not have, and about two that give one boundary's displacement along one axis.
    SolidConditions(const SolidMesh<dim> &mesh, const std::vector<BoundaryCondition> &conditions);

    /// Homogeneous (see prescribed() for what is not zero) and not closed, so that hanging nodes go
    /// on to depend on nodes whose displacement is given.
    const dealii::AffineConstraints<double> &constraints() const { return all; }

    /// A DoF whose displacement is not zero, and what gives it.
    struct Prescribed
    {
      dealii::types::global_dof_index dof;
      const BoundaryCondition *by;
    };
    const std::vector<Prescribed> &prescribed() const { return given; }

  private:
    /// The condition that holds a boundary along an axis.
    using Holders =
        std::map<std::pair<dealii::types::boundary_id, unsigned int>, const BoundaryCondition *>;

    void constrain(const SolidMesh<dim> &mesh, const BoundaryCondition &condition,
                   Holders &holders);

    dealii::AffineConstraints<double> all;
    std::vector<Prescribed> given;
  };
} // namespace taut

#endif
