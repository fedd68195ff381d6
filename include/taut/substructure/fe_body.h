// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_fe_body_h
#define taut_fe_body_h

#include <taut/base/lasting.h>
#include <taut/substructure/body_traits.h>
#include <taut/substructure/substructure.h>

#include <deal.II/base/quadrature.h>

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/fe/mapping.h>

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/vector.h>

#include <deal.II/numerics/data_component_interpretation.h>

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace taut
{
  /**
   * A linear model of deal.II as a substructure: M U" + C U' + K U = P + B N on the DoFs of a
   * DoFHandler, in its numbering. Use it to couple a finite element model of your own with other
   * bodies by joints, stops and contacts.
   *
   * Assemble symmetric matrices without the constraints (not by distribute_local_to_global); this
   * class applies the constraints. A DoF that depends on others, at a hanging node, is condensed
   * onto them. A prescribed DoF keeps its equations, so that it may move in time. An element with
   * dim components is a displacement in the plane or in space. An element with a single component
   * is a displacement along Options::direction.
   */
  template <int dim>
  class FEBody : public Substructure, public PartOfBody
  {
  public:
    using Cell = typename dealii::DoFHandler<dim>::active_cell_iterator;

    struct Options
    {
      /// Path of the section of the body in a parameter file, for messages.
      std::string origin = {};

      /// Direction of the displacement of a scalar element.
      Coordinates direction = {0., 0., 1.};

      /// The null space without constraints: rigid body modes from the points of the mesh (a
      /// constant for a scalar element), or the vectors of null_space, one entry a DoF.
      bool rigid_body_modes = true;
      std::vector<dealii::Vector<double>> null_space = {};

      /// Kind of each DoF, 0 a displacement [m], 1 a slope or rotation [rad]; empty: displacements.
      std::vector<unsigned char> kinds = {};

      /// Places are found with this mapping; none: straight cells.
      const dealii::Mapping<dim> *mapping = nullptr;

      /// The active cells of the body, if it is a part of a larger body; empty: all cells, those
      /// of this rank if the triangulation is distributed. A part has the DoFs part_dofs() only,
      /// and its vectors, matrices and loads have an entry for each of these, as have those of a
      /// body on a distributed triangulation.
      std::vector<Cell> cells = {};
    };

    /// DoFs of these cells, and the DoFs that they depend on, in ascending order.
    static std::vector<dealii::types::global_dof_index>
    part_dofs(const std::vector<Cell> &cells, const dealii::AffineConstraints<double> &constraints);

    /**
     * @p dof_handler and the mapping are kept by reference; matrices, constraints and load [N] are
     * copied. Constraints are always those of the whole DoFHandler. An empty damping matrix means
     * no damping. Throws UserError for matrices or a load of another size, for a matrix that is not
     * symmetric, and for a constraint that both depends on DoFs and is inhomogeneous.
     */
    FEBody(const std::string &name, Lasting<dealii::DoFHandler<dim>> dof_handler,
           const dealii::SparseMatrix<double> &mass, const dealii::SparseMatrix<double> &damping,
           const dealii::SparseMatrix<double> &stiffness,
           const dealii::AffineConstraints<double> &constraints,
           const dealii::Vector<double> &load = {}, const Options &options = Options());

    /// Adds a load that changes in time: @p add adds it at t [s] to P [N], one entry a DoF. With a
    /// @p sample, see TimeLoad::sample(), runs look for pulses of the load between their steps;
    /// with
    /// @p sample_at_places also for those on a part of the body.
    void add_load(std::function<void(double t, dealii::Vector<double> &P)> add,
                  std::function<double(double)> sample = {},
                  std::function<double(double t, std::size_t n_places)> sample_at_places = {});

    /// Adds a constant load, one entry a DoF [N]. Throws UserError for a load of another size, or a
    /// load that is not finite.
    void add_constant_load(const dealii::Vector<double> &P);

    /// Gives motions u(t) [m] to DoFs that the constraints prescribe. AffineConstraints::close()
    /// lets hanging nodes forget DoFs that are zero: do not close the constraints if such a DoF
    /// moves. Throws UserError for a DoF that is not prescribed.
    void prescribe(
        const std::map<dealii::types::global_dof_index, std::function<double(double)>> &motions);

    /// Gives constant displacements [m] to DoFs that the constraints prescribe. Throws as
    /// prescribe().
    void
    prescribe_displacements(const std::map<dealii::types::global_dof_index, double> &displacements);

    /// Displacement and velocity at t = 0 for Start::given, one entry a DoF [m, m/s].
    void set_initial_state(const dealii::Vector<double> &displacement,
                           const dealii::Vector<double> &velocity);

    /// The displacement at a point of the mesh. A scalar element counts the part of @p direction
    /// along its own direction.
    LinearForm displacement(const Coordinates &place, const Coordinates &direction) const override;

    /// The displacement of DoF @p dof alone, condensed if it depends on others. Throws UserError
    /// for a DoF that the body does not have.
    LinearForm displacement_of_dof(dealii::types::global_dof_index dof) const;

    /// DoF @p dof of the DoFHandler, from the displacement in a State.
    double value_of_dof(dealii::types::global_dof_index dof, const std::vector<double> &U) const
    {
      return value(index(dof), U);
    }

    /// All DoFs of the DoFHandler, dependent DoFs included, from the displacement in a State; zero
    /// outside of a part.
    dealii::Vector<double> all_dofs(const std::vector<double> &U) const;

    /// Position of a DoF of the DoFHandler in the vectors of the body. The body must have the DoF.
    unsigned int index(dealii::types::global_dof_index dof) const;
    bool has_dof(dealii::types::global_dof_index dof) const;

    /// The active cells of the body.
    const std::vector<Cell> &cells() const { return own_cells; }
    bool has_cell(const Cell &cell) const;

    void initial_state(std::vector<double> &U, std::vector<double> &V) const override;
    NullSpace null_space() const override { return own_null_space; }

    bool has_fields() const override { return true; }
    void write_vtu(const std::string &path, const std::vector<double> &U) const final;

    /// Parts are drawn together if they have the same DoFHandler.
    bool is_drawn_with(const PartOfBody &other) const override;
    void write_vtu(const Files &files, const std::vector<Drawn> &parts) const override;

    const dealii::DoFHandler<dim> &dof_handler() const { return handler; }

  protected:
    /// A cell that write_vtu() draws, in ascending order.
    struct DrawnCell
    {
      Cell cell;
      std::vector<dealii::types::global_dof_index> dofs;
      std::vector<double> U; ///< displacements of these, dependent ones included
    };

    /// Fields beside the displacement, one entry for each component.
    struct CellFields
    {
      std::vector<std::string> names, units;
      std::vector<dealii::DataComponentInterpretation::DataComponentInterpretation> kinds;
      std::vector<dealii::FullMatrix<double>> values; ///< of each cell: components x points
    };

    /// More fields for write_vtu(), at these points of the unit cell.
    virtual CellFields fields(const std::vector<DrawnCell> &,
                              const std::vector<dealii::Point<dim>> &) const
    {
      return {};
    }

  private:
    class Load;
    class Picture;

    /// The kept DoFs on which DoF @p i depends, with weights.
    template <typename Function>
    void for_each_kept(unsigned int i, const Function &function) const
    {
      const auto found = dependences.find(i);
      if (found == dependences.end())
        return function(i, 1.);
      for (std::size_t p = 0; p < found->second.index.size(); ++p)
        function(found->second.index[p], found->second.value[p]);
    }
    double value(unsigned int i, const std::vector<double> &U) const
    {
      double sum = 0.;
      for_each_kept(i,
                    [&](const unsigned int kept, const double weight) { sum += weight * U[kept]; });
      return sum;
    }

    void set_matrix(const dealii::SparseMatrix<double> &source, SymmetricMatrix &target) const;
    void condense(const dealii::Vector<double> &P, std::vector<double> &result) const;
    std::vector<std::vector<double>> candidates(const Options &options) const;
    void find_null_space(const Options &options);
    ConstrainedDof &prescribed(dealii::types::global_dof_index dof);
    void check_size(std::size_t size, const std::string &what) const;
    void check_matrix(const dealii::SparseMatrix<double> &A, const std::string &what) const;

    const dealii::DoFHandler<dim> &handler;
    const dealii::Mapping<dim> &mapping;
    const Coordinates scalar_direction;
    std::vector<Cell> own_cells;                           ///< in ascending order
    std::vector<dealii::types::global_dof_index> own_dofs; ///< of a part; empty: all
    unsigned int n_rows = 0;                               ///< kept and dependent DoFs
    std::map<unsigned int, LinearForm>
        dependences; ///< on the kept DoFs, of those that are not kept
    dealii::Vector<double> U0, V0;
    NullSpace own_null_space;
  };
} // namespace taut

#endif
