// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_solid_entries_h
#define taut_solid_entries_h

#include <taut/base/communicator.h>
#include <taut/scene/body_type.h>
#include <taut/scene/expression.h>
#include <taut/solid/elastic_solid.h>

#include <memory>
#include <set>
#include <string>
#include <vector>

namespace taut
{
  template <int dim>
  class MeshArguments;

  /// The mesh of a solid in a parameter file.
  struct MeshEntries
  {
    void declare(dealii::ParameterHandler &prm);

    /// Throws EntryError for entries that make no mesh, below @p origin, the section of the body.
    template <int dim>
    std::unique_ptr<dealii::Triangulation<dim>> make(const std::string &origin) const;

    /// The same mesh, refined by p4est on the rank of each cell. Null if that neither pays nor is
    /// asked for, if a rank would get no cell, or if it has fewer than @p least_dofs DoFs for
    /// elements of this degree, for which a number below the true one is taken. Throws EntryError
    /// for a mesh that p4est does not take. Called by all ranks together.
    template <int dim>
    std::unique_ptr<dealii::Triangulation<dim>>
    make_distributed(const std::string &origin, const Communicator &processes, unsigned int degree,
                     double least_dofs) const;

  private:
    template <int dim>
    void make_coarse(dealii::Triangulation<dim> &cells, const std::string &origin) const;
    template <int dim>
    void generate(dealii::Triangulation<dim> &cells, const std::string &section) const;
    template <int dim>
    static void plate(dealii::Triangulation<dim> &cells, MeshArguments<dim> &given);
    template <int dim>
    void read(dealii::Triangulation<dim> &cells, const std::string &section) const;
    template <int dim>
    void curve(dealii::Triangulation<dim> &cells, const std::string &section) const;
    template <int dim>
    void refine(dealii::Triangulation<dim> &cells, const std::string &section) const;

    std::string file, generator = "subdivided_hyper_rectangle", arguments = "4, 4 : 0, 0 : 1, 1",
                      where, curved;
    unsigned int refinements = 0, local_refinements = 0;
    std::string distribution = "automatic";
    std::vector<double> shift;
  };

  /// What acts on the boundary of a solid in a parameter file, and what holds it.
  class BoundaryEntries
  {
  public:
    void declare(dealii::ParameterHandler &prm);

    /// Of a solid in so many dimensions. Throws EntryError for entries that are no conditions,
    /// below @p origin.
    std::vector<BoundaryCondition> conditions(unsigned int dimension,
                                              const std::string &origin) const;

  private:
    std::vector<unsigned int> fixed, symmetric;
    std::string displacement, traction, pressure;
  };

  /// A solid in a parameter file.
  struct SolidEntries
  {
    void declare(dealii::ParameterHandler &prm);

    /// Throws EntryError for entries that are impossible on this mesh.
    template <int dim>
    typename ElasticSolid<dim>::Options options(const BodySetting &setting,
                                                const SolidMesh<dim> &cells) const;

    unsigned int dimension = 2, degree = 1;
    double thickness = 1., largest_turn = .5;
    MeshEntries mesh;

    /// Boundaries without mass, whose neighbours take it, are found on the whole mesh.
    bool can_be_distributed() const { return without_mass.empty(); }

  private:
    /// Throws UserError for cells without a material.
    template <int dim>
    static void check_materials(const typename ElasticSolid<dim>::Options &options,
                                const SolidMesh<dim> &mesh);

    double youngs_modulus = 0., poissons_ratio = .3, density = 0., mass_damping = 0.,
           stiffness_damping = 0.;
    std::string materials, plane_state = "strain", mass_matrix = "consistent", mass_kept = "total";
    std::vector<unsigned int> without_mass;
    BoundaryEntries boundaries;
    std::vector<double> initial_velocity;
  };
} // namespace taut

#endif
