// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_fe_cubic_hermite_h
#define taut_fe_cubic_hermite_h

#include "wire/fe_cubic_hermite_vector_tools.h"

#include <deal.II/fe/fe_poly.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace dealii
{
  template <int dim, int spacedim>
  class DoFHandler;
  template <int dim, typename RangeNumberType>
  class Function;
  template <typename Number>
  class FullMatrix;
  template <typename Number>
  class Vector;
} // namespace dealii

namespace taut
{
  /**
   * The cubic Hermite element of beams: value w and slope dw/ds at each vertex, C1 across cells of
   * any length. Use it for beams, and for wires under a sliding contact.
   *
   * s is the arc length along the wire, in the direction of the first coarse cell of the
   * triangulation. Cells may run either way (a mesh file knows no order): on a backward cell the
   * slope DoFs keep the wire's sign. A cell that turns more than 60 degrees away from this
   * direction has no clear sense and is a UserError. For spacedim = 1 a cell against x is a
   * UserError, too: deal.II would give it a negative JxW.
   *
   * Through FEValues, with the unit tangent t, the gradient of a shape function is t dw/ds and its
   * hessian t (x) t d2w/ds2. The mapping must be affine on each cell and keep the vertices of the
   * triangulation, e.g. MappingQ1 (checked in debug mode).
   *
   * Limits follow from the slopes: shape functions depend on the length of their cell, and a slope
   * is no value at a point. A function of deal.II throws an exception, in every build type, if it
   * takes the shape functions of the reference cell for those of all cells, or values for DoFs:
   *
   * - shape_value() and its like, and with them matrix-free evaluation, VectorTools::project() for
   *   spacedim = 1 and FETools::interpolate() to other elements;
   * - interpolation from other elements, prolongation and restriction (SolutionTransfer);
   * - VectorTools::interpolate() and VectorTools::interpolate_boundary_values(), in an FESystem,
   *   too, unless the component mask leaves this element out.
   *
   * Use interpolate() for functions whose gradient is known.
   *
   * In hp mode the neighbours may be this element and elements without DoFs at vertices. Beside
   * FE_Q and its like, which would share no value with this element, evaluation throws.
   *
   * DoFs on a cell: (w, dw/ds) at vertex 0, (w, dw/ds) at vertex 1. This is the order of deal.II's
   * FE_Hermite, a different element, whose slopes are scaled by the cell.
   */
  template <int dim, int spacedim = dim>
  class FE_CubicHermite : public dealii::FE_Poly<dim, spacedim>
  {
    static_assert(dim == 1, "FE_CubicHermite is an element of wires: dim must be 1");

    using CellIterator = typename dealii::Triangulation<dim, spacedim>::cell_iterator;
    using MappingInternal = typename dealii::Mapping<dim, spacedim>::InternalDataBase;
    using ElementInternal = typename dealii::FiniteElement<dim, spacedim>::InternalDataBase;
    using MappingOutput =
        dealii::internal::FEValuesImplementation::MappingRelatedData<dim, spacedim>;
    using ElementOutput =
        dealii::internal::FEValuesImplementation::FiniteElementRelatedData<dim, spacedim>;

  public:
    /// @p degree must be 3; it is an argument only to match deal.II.
    explicit FE_CubicHermite(const unsigned int degree = 3);

    /// "FE_CubicHermite<1>(3)" or, as deal.II writes it where the dimensions differ,
    /// "FE_CubicHermite<1,3>(3)".
    std::string get_name() const override;

    std::unique_ptr<dealii::FiniteElement<dim, spacedim>> clone() const override;

    /// Length of the cell [m], negative if the cell runs against the wire; an argument of
    /// hermite_shape().
    static double signed_length(const CellIterator &cell);

    /**
     * Sets value and slope in every vertex from @p function and its gradient, which @p function
     * must implement. @p dof_handler uses this element; @p dof_values has its size.
     */
    static void interpolate(const dealii::DoFHandler<dim, spacedim> &dof_handler,
                            const dealii::Function<spacedim, double> &function,
                            dealii::Vector<double> &dof_values);

    /// The identity from an element of this class; throws for other elements.
    void get_interpolation_matrix(const dealii::FiniteElement<dim, spacedim> &source,
                                  dealii::FullMatrix<double> &matrix) const override;

    /**
     * @name Refused: throws
     * @{
     */
    double shape_value(unsigned int i, const dealii::Point<dim> &p) const override;
    double shape_value_component(unsigned int i, const dealii::Point<dim> &p,
                                 unsigned int component) const override;
    dealii::Tensor<1, dim> shape_grad(unsigned int i, const dealii::Point<dim> &p) const override;
    dealii::Tensor<1, dim> shape_grad_component(unsigned int i, const dealii::Point<dim> &p,
                                                unsigned int component) const override;
    dealii::Tensor<2, dim> shape_grad_grad(unsigned int i,
                                           const dealii::Point<dim> &p) const override;
    dealii::Tensor<2, dim> shape_grad_grad_component(unsigned int i, const dealii::Point<dim> &p,
                                                     unsigned int component) const override;
    const dealii::FullMatrix<double> &
    get_prolongation_matrix(unsigned int child,
                            const dealii::RefinementCase<dim> &refinement_case =
                                dealii::RefinementCase<dim>::isotropic_refinement) const override;
    const dealii::FullMatrix<double> &
    get_restriction_matrix(unsigned int child,
                           const dealii::RefinementCase<dim> &refinement_case =
                               dealii::RefinementCase<dim>::isotropic_refinement) const override;
    void convert_generalized_support_point_values_to_dof_values(
        const std::vector<dealii::Vector<double>> &support_point_values,
        std::vector<double> &dof_values) const override;
    /// @}

    /**
     * Identifies value and slope with those of another element of this class, and nothing with an
     * element without DoFs at vertices. deal.II asks one of two elements, depending on their order,
     * and other elements do not know this class. Beside such elements FEValues therefore refuse
     * this element at its evaluation. An exception from here would be lost in a task of deal.II.
     */
    std::vector<std::pair<unsigned int, unsigned int>>
    hp_vertex_dof_identities(const dealii::FiniteElement<dim, spacedim> &other) const override;

    /// deal.II asks this first, whatever the order.
    dealii::FiniteElementDomination::Domination
    compare_for_domination(const dealii::FiniteElement<dim, spacedim> &other,
                           unsigned int codim = 0) const override;

  protected:
    void fill_fe_values(const CellIterator &cell,
                        const dealii::CellSimilarity::Similarity cell_similarity,
                        const dealii::Quadrature<dim> &quadrature,
                        const dealii::Mapping<dim, spacedim> &mapping,
                        const MappingInternal &mapping_internal, const MappingOutput &mapping_data,
                        const ElementInternal &fe_internal,
                        ElementOutput &output_data) const override;

    using dealii::FiniteElement<dim, spacedim>::fill_fe_face_values;

    void fill_fe_face_values(const CellIterator &cell, const unsigned int face_no,
                             const dealii::hp::QCollection<dim - 1> &quadrature,
                             const dealii::Mapping<dim, spacedim> &mapping,
                             const MappingInternal &mapping_internal,
                             const MappingOutput &mapping_data, const ElementInternal &fe_internal,
                             ElementOutput &output_data) const override;

  private:
    void check_neighbours() const;

    mutable std::string unknown_neighbour; ///< in hp mode, name of an element; empty: none
  };
} // namespace taut

#endif
