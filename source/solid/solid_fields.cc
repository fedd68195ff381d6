// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/solid/elastic_solid.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/symmetric_tensor.h>

#include <deal.II/fe/fe_dgq.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_values.h>

#include <cmath>
#include <map>

namespace taut
{
  namespace
  {
    using Stress = dealii::SymmetricTensor<2, 3>;

    double von_mises(const Stress &s)
    {
      const Stress d = dealii::deviator(s);
      return std::sqrt(1.5 * (d * d));
    }

    /// A discontinuous element with nodes at the nodes of the displacements.
    template <int dim>
    std::unique_ptr<dealii::FiniteElement<dim>> discontinuous(const SolidMesh<dim> &mesh)
    {
      if (mesh.is_simplicial())
        return std::make_unique<dealii::FE_SimplexDGP<dim>>(mesh.degree());
      return std::make_unique<dealii::FE_DGQ<dim>>(mesh.degree());
    }
  } // namespace

  /// The stresses at the nodes of each cell, averaged over the cells of one material at a node.
  template <int dim>
  class ElasticSolid<dim>::StressField
  {
  public:
    using DrawnCell = typename FEBody<dim>::DrawnCell;

    StressField(const ElasticSolid<dim> &solid, const std::vector<DrawnCell> &cells);

    /// The tensor, principal values and von Mises' stress, at these points of the cells.
    typename FEBody<dim>::CellFields at(const std::vector<dealii::Point<dim>> &points) const;

  private:
    Stress stress(const dealii::Tensor<2, dim> &gradient, const ElasticMaterial &material) const;
    void find();
    std::vector<double> components(const Stress &s) const;

    const ElasticSolid<dim> &solid;
    const std::vector<DrawnCell> &cells;
    const SolidMesh<dim> &mesh;
    const std::unique_ptr<dealii::FiniteElement<dim>> node_element;
    std::vector<unsigned int> node_of_displacement; ///< of each node, the first DoF of a cell there
    std::vector<std::vector<Stress>> stresses;      ///< of each cell and node
  };

  template <int dim>
  ElasticSolid<dim>::StressField::StressField(const ElasticSolid<dim> &solid,
                                              const std::vector<DrawnCell> &cells)
      : solid(solid), cells(cells), mesh(*solid.mesh), node_element(discontinuous(mesh))
  {
    const dealii::FiniteElement<dim> &element = mesh.dof_handler().get_fe();
    constexpr double same = 1e-10; // of the size of the unit cell
    for (const dealii::Point<dim> &node : node_element->get_unit_support_points())
      for (unsigned int i = 0; i < element.n_dofs_per_cell(); ++i)
        if (element.system_to_component_index(i).first == 0 &&
            node.distance(element.unit_support_point(i)) < same)
          node_of_displacement.push_back(i);
    find();
  }

  template <int dim>
  Stress ElasticSolid<dim>::StressField::stress(const dealii::Tensor<2, dim> &gradient,
                                                const ElasticMaterial &m) const
  {
    const double nu = m.poissons_ratio, mu = m.youngs_modulus / (2. * (1. + nu));
    dealii::SymmetricTensor<2, 3> strain;
    for (unsigned int a = 0; a < dim; ++a)
      for (unsigned int b = a; b < dim; ++b)
        strain[a][b] = .5 * (gradient[a][b] + gradient[b][a]);
    if (dim == 2 && solid.options.plane_state == PlaneState::stress)
      strain[2][2] = -nu / (1. - nu) * (strain[0][0] + strain[1][1]);
    return 2. * mu *
           (strain +
            nu / (1. - 2. * nu) * dealii::trace(strain) * dealii::unit_symmetric_tensor<3>());
  }

  template <int dim>
  void ElasticSolid<dim>::StressField::find()
  {
    const dealii::FiniteElement<dim> &element = mesh.dof_handler().get_fe();
    const std::vector<dealii::Point<dim>> &nodes = node_element->get_unit_support_points();
    // Points at which stresses are taken, and their extrapolation to the nodes.
    const dealii::Quadrature<dim> points =
        mesh.is_simplicial() ? dealii::Quadrature<dim>(nodes) : mesh.quadrature(mesh.degree());
    std::vector<std::vector<double>> weight(nodes.size(), std::vector<double>(points.size(), 0.));
    if (mesh.is_simplicial())
      for (std::size_t n = 0; n < nodes.size(); ++n)
        weight[n][n] = 1.;
    else
    {
      const dealii::FE_DGQArbitraryNodes<dim> through(dealii::QGauss<1>(mesh.degree()));
      for (std::size_t n = 0; n < nodes.size(); ++n)
        for (unsigned int q = 0; q < points.size(); ++q)
          weight[n][q] = through.shape_value(q, nodes[n]);
    }
    dealii::FEValues<dim> at_points(mesh.mapping(), element, points, dealii::update_gradients);
    std::vector<dealii::Tensor<2, dim>> gradients(points.size());
    struct Sum
    {
      Stress total;
      unsigned int n = 0;
    };
    std::map<std::pair<dealii::types::global_dof_index, dealii::types::material_id>, Sum> at_node;
    const auto key = [&](const DrawnCell &drawn, const std::size_t n)
    { return std::make_pair(drawn.dofs[node_of_displacement[n]], drawn.cell->material_id()); };
    for (const DrawnCell &cell : cells)
    {
      at_points.reinit(cell.cell);
      at_points[dealii::FEValuesExtractors::Vector(0)].get_function_gradients_from_local_dof_values(
          cell.U, gradients);
      const ElasticMaterial &material = solid.options.material(cell.cell->material_id());
      for (std::size_t n = 0; n < nodes.size(); ++n)
      {
        Sum &sum = at_node[key(cell, n)];
        for (unsigned int q = 0; q < points.size(); ++q)
          if (weight[n][q] != 0.)
            sum.total += weight[n][q] * stress(gradients[q], material);
        ++sum.n;
      }
    }
    for (const DrawnCell &cell : cells)
    {
      stresses.emplace_back();
      for (std::size_t n = 0; n < nodes.size(); ++n)
      {
        const Sum &sum = at_node[key(cell, n)];
        stresses.back().push_back(sum.total / sum.n);
      }
    }
  }

  template <int dim>
  std::vector<double> ElasticSolid<dim>::StressField::components(const Stress &s) const
  {
    std::vector<double> result;
    for (unsigned int a = 0; a < dim; ++a)
      for (unsigned int b = 0; b < dim; ++b)
        result.push_back(s[a][b]);
    if (dim == 2)
      result.push_back(s[2][2]);
    for (const double principal : dealii::eigenvalues(s))
      result.push_back(principal);
    result.push_back(von_mises(s));
    return result;
  }

  template <int dim>
  typename FEBody<dim>::CellFields
  ElasticSolid<dim>::StressField::at(const std::vector<dealii::Point<dim>> &points) const
  {
    using namespace dealii::DataComponentInterpretation;
    typename FEBody<dim>::CellFields result;
    // Without its zz component, invariants of a tensor in the plane would not be those of the
    // stress.
    result.names.assign(dim * dim, dim == 2 ? "stress_in_plane" : "stress");
    result.kinds.assign(dim * dim, component_is_part_of_tensor);
    if (dim == 2)
      result.names.emplace_back("stress_zz");
    result.names.insert(result.names.end(), {"principal_stress_1", "principal_stress_2",
                                             "principal_stress_3", "von_mises_stress"});
    result.kinds.resize(result.names.size(), component_is_scalar);
    result.units.assign(result.names.size(), "Pa");
    for (const std::vector<Stress> &of_cell : stresses)
    {
      dealii::FullMatrix<double> &values =
          result.values.emplace_back(result.names.size(), points.size());
      for (std::size_t n = 0; n < of_cell.size(); ++n)
      {
        const std::vector<double> found = components(of_cell[n]);
        for (unsigned int q = 0; q < points.size(); ++q)
        {
          const double weight = node_element->shape_value(n, points[q]);
          for (std::size_t c = 0; weight != 0. && c < found.size(); ++c)
            values(c, q) += weight * found[c];
        }
      }
    }
    return result;
  }

  template <int dim>
  typename FEBody<dim>::CellFields
  ElasticSolid<dim>::fields(const std::vector<DrawnCell> &cells,
                            const std::vector<dealii::Point<dim>> &points) const
  {
    return StressField(*this, cells).at(points);
  }

  template FEBody<2>::CellFields
  ElasticSolid<2>::fields(const std::vector<FEBody<2>::DrawnCell> &,
                          const std::vector<dealii::Point<2>> &) const;
  template FEBody<3>::CellFields
  ElasticSolid<3>::fields(const std::vector<FEBody<3>::DrawnCell> &,
                          const std::vector<dealii::Point<3>> &) const;
} // namespace taut
