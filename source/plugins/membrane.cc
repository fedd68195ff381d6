// SPDX-License-Identifier: LGPL-2.1-or-later
// A body of a plugin: a square membrane under tension, -1 m to 1 m in x and y, held at its sides,
// that moves along z. An example of a body of deal.II that a parameter file names.
#include <taut/scene/body_type.h>
#include <taut/scene/contact_surface.h>
#include <taut/substructure/fe_body.h>

#include <deal.II/base/function.h>
#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/patterns.h>
#include <deal.II/base/quadrature_lib.h>

#include <deal.II/dofs/dof_tools.h>

#include <deal.II/fe/fe_q.h>

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <deal.II/numerics/matrix_tools.h>
#include <deal.II/numerics/vector_tools.h>

#include <limits>

namespace
{
  /// Mesh and matrices for a tension and a mass of 1.
  struct Model
  {
    explicit Model(const int refinements) : element(1)
    {
      dealii::GridGenerator::hyper_cube(cells, -1., 1.);
      cells.refine_global(refinements);
      dofs.reinit(cells);
      dofs.distribute_dofs(element);
      dealii::VectorTools::interpolate_boundary_values(
          dofs, 0, dealii::Functions::ZeroFunction<2>(), constraints);
      constraints.close();
      dealii::DynamicSparsityPattern all(dofs.n_dofs());
      dealii::DoFTools::make_sparsity_pattern(dofs, all);
      pattern.copy_from(all);
      M.reinit(pattern);
      K.reinit(pattern);
      dealii::MatrixCreator::create_mass_matrix(dofs, dealii::QGauss<2>(2), M);
      dealii::MatrixCreator::create_laplace_matrix(dofs, dealii::QGauss<2>(2), K);
      load.reinit(dofs.n_dofs());
      dealii::VectorTools::create_right_hand_side(dofs, dealii::QGauss<2>(2),
                                                  dealii::Functions::ConstantFunction<2>(1.), load);
    }

    dealii::Triangulation<2> cells;
    dealii::FE_Q<2> element;
    dealii::DoFHandler<2> dofs;
    dealii::AffineConstraints<double> constraints;
    dealii::SparsityPattern pattern;
    dealii::SparseMatrix<double> M, K;
    dealii::Vector<double> load;
  };

  /// Nodes of its surface are its DoFs.
  class MembraneBody : public taut::FEBody<2>
  {
  public:
    using taut::FEBody<2>::FEBody;
    taut::LinearForm node_displacement(const unsigned int node,
                                       const taut::Coordinates &direction) const override
    {
      taut::LinearForm form;
      if (direction.z != 0.)
        form.add(node, direction.z);
      return form;
    }
  };

  class Membrane : public taut::BodyType
  {
  public:
    void declare_parameters(dealii::ParameterHandler &prm) override
    {
      namespace Patterns = dealii::Patterns;
      constexpr double positive = std::numeric_limits<double>::min();
      prm.add_parameter("Refinements", refinements, "It has 4^Refinements cells",
                        Patterns::Integer(1, 10));
      prm.add_parameter("Tension", tension, "[N/m]", Patterns::Double(positive));
      prm.add_parameter("Mass per area", mass, "[kg/m^2]", Patterns::Double(positive));
      prm.add_parameter("Pressure", pressure, "Downwards, against z [Pa]");
    }

    std::unique_ptr<taut::Substructure> make(const taut::BodySetting &setting) const override
    {
      const Model &m = model();
      dealii::SparseMatrix<double> M(m.pattern), K(m.pattern);
      M.add(mass, m.M);
      K.add(tension, m.K);
      dealii::Vector<double> load = m.load;
      load *= mass * setting.gravity.z - pressure;
      taut::FEBody<2>::Options options;
      options.origin = setting.origin;
      return std::make_unique<MembraneBody>(setting.name, m.dofs, M, dealii::SparseMatrix<double>(),
                                            K, m.constraints, load, options);
    }

    /// Its lower side.
    taut::ContactSurface surface(const taut::BodySetting &,
                                 const std::vector<unsigned int> &) const override
    {
      const Model &m = model();
      taut::ContactSurface result;
      result.dim = 3;
      std::vector<dealii::Point<2>> points(m.dofs.n_dofs());
      dealii::DoFTools::map_dofs_to_support_points(dealii::MappingQ1<2>(), m.dofs, points);
      for (const auto &x : points)
        result.points.push_back({x[0], x[1], 0.});
      std::vector<dealii::types::global_dof_index> nodes(m.element.n_dofs_per_cell());
      for (const auto &cell : m.dofs.active_cell_iterators())
      {
        cell->get_dof_indices(nodes);
        result.faces.emplace_back(nodes.begin(), nodes.end());
        result.outward.push_back({0., 0., -1.});
      }
      return result;
    }

  private:
    const Model &model() const
    {
      if (!made)
        made = std::make_unique<Model>(refinements);
      return *made;
    }

    int refinements = 5;
    double tension = 1., mass = 1., pressure = 0.;
    mutable std::unique_ptr<const Model> made;
  };

  const taut::Register<taut::BodyType, Membrane>
      membrane("membrane", "a square membrane of 2 m x 2 m, held at its sides, that moves along z");
} // namespace
