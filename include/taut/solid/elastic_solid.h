// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_elastic_solid_h
#define taut_elastic_solid_h

#include <taut/solid/solid_conditions.h>
#include <taut/solid/solid_mesh.h>
#include <taut/substructure/body_traits.h>
#include <taut/substructure/fe_body.h>

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace taut
{
  /// An isotropic, linear elastic material.
  struct ElasticMaterial
  {
    double youngs_modulus = 0.; ///< E [Pa]
    double poissons_ratio = 0.; ///< nu in (-1, 1/2)
    double density = 0.;        ///< [kg/m^3]
  };

  /// Plane strain: a body in the plane cannot expand out of the plane. Plane stress: it is free to
  /// expand.
  enum class PlaneState
  {
    strain,
    stress
  };

  /// How the mass of an element is integrated, see MassMatrix: exactly; at the nodes; with one
  /// Gauss point less in each direction than the element has nodes.
  enum class SolidMass
  {
    consistent,
    lumped,
    reduced
  };

  /**
   * A solid of linear elasticity that moves by small amounts, discretised by deal.II. Take it for a
   * part whose stresses or contact surfaces matter:
   *
   *     stress = lambda tr(strain) 1 + 2 mu strain,
   *     lambda = E nu / ((1 + nu) (1 - 2 nu)),    mu = E / (2 (1 + nu)),
   *
   * in the plane (a body with a thickness) or in space. In plane stress 2 lambda mu / (lambda + 2
   * mu) takes the place of lambda. Tension is positive. DoFs are those of SolidMesh::dof_handler()
   * [m].
   */
  template <int dim>
  class ElasticSolid : public FEBody<dim>, public StrainedBody
  {
  public:
    /// A material id without cells, see Options::materials.
    static constexpr dealii::types::material_id other_materials =
        dealii::numbers::invalid_material_id;

    struct Options
    {
      std::string origin = {}; ///< path of its section in the parameter file, for messages

      /// Materials by material id of the cells. The material of other_materials is that of all
      /// missing ids.
      std::map<dealii::types::material_id, ElasticMaterial> materials;

      /// Material of the cells with this id; throws UserError if the material is missing.
      const ElasticMaterial &material(dealii::types::material_id id) const;

      /// lambda and mu of this material [Pa]; plane stress is plane strain with another lambda.
      std::pair<double, double> lame(dealii::types::material_id id) const;

      PlaneState plane_state = PlaneState::strain; ///< if dim = 2
      double thickness = 1.;                       ///< if dim = 2 [m]
      SolidMass mass = SolidMass::consistent;

      /// Mass redistribution: parts of the boundary whose nodes have no mass. The nodes next to
      /// them take the mass. The total mass is kept, and with keeps_inertia also the centre of mass
      /// and the moments of inertia.
      std::set<dealii::types::boundary_id> without_mass = {};
      bool keeps_inertia = false;
      double mass_damping = 0.;      ///< C = mass_damping M + stiffness_damping K [1/s]
      double stiffness_damping = 0.; ///< [s]
      Coordinates gravity = {};      ///< [m/s^2]
      std::vector<BoundaryCondition> conditions;

      /// Velocity of all points at t = 0, for Start::given; displacements are zero then [m/s].
      Coordinates initial_velocity = {};
    };

    /// Throws UserError for a missing or impossible material, for a boundary that the mesh does not
    /// have, and for lumped masses of degree 2 on simplices, whose corners would have no mass.
    ElasticSolid(const std::string &name, std::shared_ptr<const SolidMesh<dim>> mesh,
                 const Options &options);

    /// The part of a solid with these cells; @p conditions and mass_factors() are those of the
    /// uncut solid.
    using typename FEBody<dim>::Cell;
    ElasticSolid(const std::string &name, std::shared_ptr<const SolidMesh<dim>> mesh,
                 const Options &options, const SolidConditions<dim> &conditions,
                 const std::vector<Cell> &part, const std::vector<double> &mass_factors);

    /// Factors of the rows and columns of M that take the mass from Options::without_mass; empty
    /// without them.
    static std::vector<double> mass_factors(const SolidMesh<dim> &mesh, const Options &options,
                                            const SolidConditions<dim> &conditions);

    /// Displacement of a node of SolidMesh::surface().
    LinearForm node_displacement(unsigned int node, const Coordinates &direction) const override;

    bool has_definite_mass() const override { return options.mass != SolidMass::reduced; }

    Straining straining(const std::vector<double> &U) const override;

  protected:
    /// Stresses [Pa], principal stresses, the largest first, and von Mises' stress. Stresses are
    /// from the Gauss points of least error (J. Barlow, Int. J. Numer. Meth. Engng 10 (1976)),
    /// averaged at the nodes among cells of one material.
    using typename FEBody<dim>::CellFields;
    using typename FEBody<dim>::DrawnCell;
    CellFields fields(const std::vector<DrawnCell> &cells,
                      const std::vector<dealii::Point<dim>> &points) const override;

  private:
    struct Assembled;
    class StressField;

    /// Shape functions of the nodes, and their gradients, at a point of the unit cell.
    struct NodeShapes
    {
      std::vector<double> values;
      std::vector<dealii::Tensor<1, dim>> gradients;
    };

    /// A cell whose strains are measured. Measuring allocates nothing.
    struct StrainedCell
    {
      explicit StrainedCell(const SolidMesh<dim> &mesh);
      void reinit(const ElasticSolid &solid, const Cell &cell, const std::vector<double> &U);

      /// dx / d(unit cell) [m], and the gradient of the displacement.
      dealii::Tensor<2, dim> jacobian(const NodeShapes &at) const;
      dealii::SymmetricTensor<2, dim> strain(const NodeShapes &at,
                                             const dealii::Tensor<2, dim> &inverse) const;
      Coordinates place(const NodeShapes &at) const;

      dealii::Quadrature<dim> quadrature;
      std::vector<NodeShapes> points; ///< of the quadrature
      NodeShapes middle;
      std::vector<dealii::types::global_dof_index> dofs;
      std::vector<dealii::Tensor<1, dim>> places, displacements; ///< of the nodes [m]
    };
    ElasticSolid(const std::string &name, std::shared_ptr<const SolidMesh<dim>> mesh,
                 const Options &options, const SolidConditions<dim> &conditions);
    ElasticSolid(const std::string &name, std::shared_ptr<const SolidMesh<dim>> mesh,
                 const Options &options, const SolidConditions<dim> &conditions,
                 const std::vector<Cell> &part, const Assembled &assembled);
    void add_boundary_loads();
    double energy_that_simplices_lack(const std::vector<double> &U) const; ///< of degree 1 [J]

    const std::shared_ptr<const SolidMesh<dim>> mesh;
    const Options options;
    mutable StrainedCell strained;
  };
} // namespace taut

#endif
