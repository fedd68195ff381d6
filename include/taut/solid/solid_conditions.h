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
#include <vector>

namespace taut
{
  /// A boundary condition of a solid: a prescribed displacement, a symmetry, or a load.
  struct BoundaryCondition
  {
    enum class Kind
    {
      displacement, ///< prescribed, of the held components [m]
      symmetry,     ///< no motion along the normal of faces across the axes
      traction,     ///< force per area, along x, y, z [Pa]
      pressure      ///< against the outward normal, x of the value [Pa]
    };
    Kind kind = Kind::displacement;
    std::set<dealii::types::boundary_id> boundaries;
    std::array<bool, 3> held = {true, true, true};

    /// The value at a point x [m] and t [s]; none: zero.
    std::function<Coordinates(const Coordinates &x, double t)> value = {};
    bool varies = false; ///< in time

    std::string origin = {}; ///< path of its section in the parameter file, for messages
  };

  /// The constraints of a solid: hanging nodes of the mesh, and DoFs whose displacement is
  /// prescribed.
  template <int dim>
  class SolidConditions
  {
  public:
    /// @p conditions are kept by reference. Throws EntryError about a condition on a boundary that
    /// the mesh does not have, and about two conditions for the displacement of one boundary along
    /// one axis. Called by all ranks of a distributed mesh together.
    SolidConditions(const SolidMesh<dim> &mesh, const std::vector<BoundaryCondition> &conditions);

    /// Homogeneous constraints (see prescribed() for values that are not zero). They are not
    /// closed, so that hanging nodes still depend on nodes whose displacement is prescribed.
    const dealii::AffineConstraints<double> &constraints() const { return all; }

    /// A DoF with a prescribed displacement that is not zero, and the condition that prescribes it.
    struct Prescribed
    {
      dealii::types::global_dof_index dof;
      const BoundaryCondition *by;
    };
    const std::vector<Prescribed> &prescribed() const { return given; }

  private:
    /// Of each DoF the numbers of the conditions that hold it, and the boundary of each.
    using Held = std::map<dealii::types::global_dof_index, std::map<unsigned int, unsigned int>>;

    static Held find_held(const SolidMesh<dim> &mesh,
                          const std::vector<BoundaryCondition> &conditions);
    void share(const SolidMesh<dim> &mesh, Held &held) const;
    void constrain(const SolidMesh<dim> &mesh, const std::vector<BoundaryCondition> &conditions,
                   const Held &held);

    dealii::AffineConstraints<double> all;
    std::vector<Prescribed> given;
  };
} // namespace taut

#endif
