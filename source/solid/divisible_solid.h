// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_divisible_solid_h
#define taut_divisible_solid_h

#include <taut/solid/cell_division.h>
#include <taut/solid/elastic_solid.h>

#include <map>
#include <memory>
#include <vector>

namespace taut
{
  /// Cuts an ElasticSolid along the faces of its cells.
  template <int dim>
  class DivisibleSolid : public DivisibleBody
  {
  public:
    using Options = typename ElasticSolid<dim>::Options;

    /// Throws EntryError as SolidConditions does, and UserError for a distributed mesh with a
    /// boundary without mass. Called by all ranks of a distributed mesh together.
    DivisibleSolid(std::shared_ptr<const SolidMesh<dim>> mesh, const Options &options);

    const BodyCells &cells() const override { return division.cells(); }
    Communicator processes() const override { return division.processes(); }
    std::size_t cell_at(const Coordinates &place) const override { return division.cell_at(place); }

    /// A cell at a node of SolidMesh::whole_surface().
    std::size_t cell_at_node(unsigned int node) const override;

    std::unique_ptr<Substructure> make_part(const BodySetting &setting,
                                            const std::vector<unsigned int> &part) const override;

  private:
    const std::shared_ptr<const SolidMesh<dim>> mesh;
    const Options options;
    const SolidConditions<dim> conditions;
    const CellDivision<dim> division;
    const std::vector<double> mass_factors;
    std::map<unsigned int, std::size_t> cell_of_dof; ///< of the nodes of the boundary, along x
  };
} // namespace taut

#endif
