// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_elastic_solid_h
#define taut_elastic_solid_h

#include <taut/solid/solid_conditions.h>
#include <taut/solid/solid_mesh.h>
#include <taut/substructure/fe_body.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace taut
{
  /// Isotropic, linear elastic.
  struct ElasticMaterial
  {
    double youngs_modulus = 0.; ///< E [Pa]
    double poissons_ratio = 0.; ///< nu in (-1, 1/2)
    double density = 0.;        ///< [kg/m^3]
  };

  /// How a body in the plane is thick: strain, it cannot expand out of the plane; stress, it is
  /// free to.
  enum class PlaneState
  {
    strain,
    stress
  };

  /// How the mass of an element is integrated, see MassMatrix: exactly; at the nodes; by one Gauss
  /// point less in each direction than the element has nodes.
  enum class SolidMass
  {
    consistent,
    lumped,
    reduced
  };

  /**
   * A solid that moves by small amounts: linear elasticity, discretised by deal.II,
   *
   *     stress = lambda tr(strain) 1 + 2 mu strain,
   *     lambda = E nu / ((1 + nu) (1 - 2 nu)),    mu = E / (2 (1 + nu)),
   *
   * in the plane (a body of some thickness) or in space, where it is. In plane stress 2 lambda mu /
   * (lambda + 2 mu) takes the place of lambda. Tension is positive. DoFs are those of
   * SolidMesh::dof_handler() [m].
   */
  template <int dim>
  class ElasticSolid : public FEBody<dim>
  {
  public:
    /// An id that no cell has, see Options::materials.
    static constexpr dealii::types::material_id other_materials =
        dealii::numbers::invalid_material_id;

    struct Options
    {
      std::string origin = {}; ///< path of its section in the parameter file, for messages

      /// By material id of the cells; that of other_materials is for all ids without one.
      std::map<dealii::types::material_id, ElasticMaterial> materials;

      /// Of cells of this id; throws UserError if none is given.
      const ElasticMaterial &material(dealii::types::material_id id) const;

      PlaneState plane_state = PlaneState::strain; ///< if dim = 2
      double thickness = 1.;                       ///< if dim = 2 [m]
      SolidMass mass = SolidMass::consistent;

      /// Parts of the boundary whose nodes have no mass: those next to them have it instead,
      /// such that the total mass stays, or also its centre and its moments of inertia.
      std::set<dealii::types::boundary_id> without_mass = {};
      bool keeps_inertia = false;
      double mass_damping = 0.;      ///< C = mass_damping M + stiffness_damping K [1/s]
      double stiffness_damping = 0.; ///< [s]
      Coordinates gravity = {};      ///< [m/s^2]
      std::vector<BoundaryCondition> conditions;

      /// Of all points at t = 0, for Start::given; displacements are zero then [m/s].
      Coordinates initial_velocity = {};
    };

    /// Throws UserError for a material that is missing or is none, for a boundary that the mesh
    /// does not have, and for lumped masses of degree 2 on simplices, which have none at corners.
    ElasticSolid(const std::string &name, std::shared_ptr<const SolidMesh<dim>> mesh,
                 const Options &options);

    /// A part of a solid, of these cells; @p conditions and mass_factors() are those of the whole.
    using typename FEBody<dim>::Cell;
    ElasticSolid(const std::string &name, std::shared_ptr<const SolidMesh<dim>> mesh,
                 const Options &options, const SolidConditions<dim> &conditions,
                 const std::vector<Cell> &part, const std::vector<double> &mass_factors);

    /// Factors of the rows and columns of M that take the mass from Options::without_mass; empty
    /// without them.
    static std::vector<double> mass_factors(const SolidMesh<dim> &mesh, const Options &options,
                                            const SolidConditions<dim> &conditions);

    /// Of a node of SolidMesh::surface().
    LinearForm node_displacement(unsigned int node, const Coordinates &direction) const override;

    bool has_definite_mass() const override { return options.mass != SolidMass::reduced; }

    /// Displacements; stresses [Pa], from the Gauss points of least error (J. Barlow, Int. J.
    /// Numer. Meth. Engng 10 (1976)) and averaged at the nodes among cells of one material; their
    /// principal values, the largest first, and von Mises' stress.
    void write_vtu(const std::string &path, const std::vector<double> &U) const override;

  private:
    struct Assembled;
    class StressField;
    ElasticSolid(const std::string &name, std::shared_ptr<const SolidMesh<dim>> mesh,
                 const Options &options, const SolidConditions<dim> &conditions);
    ElasticSolid(const std::string &name, std::shared_ptr<const SolidMesh<dim>> mesh,
                 const Options &options, const SolidConditions<dim> &conditions,
                 const std::vector<Cell> &part, const Assembled &assembled);
    void add_boundary_loads();

    const std::shared_ptr<const SolidMesh<dim>> mesh;
    const Options options;
  };
} // namespace taut

#endif
