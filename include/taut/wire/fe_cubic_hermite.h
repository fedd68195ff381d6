// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_fe_hermite_h
#define taut_fe_hermite_h

#include <deal.II/fe/fe_poly.h>

#include <memory>
#include <string>

namespace dealii
{
  template <int dim, int spacedim>
  class DoFHandler;
  template <int dim, typename RangeNumberType>
  class Function;
  template <typename Number>
  class Vector;
} // namespace dealii

namespace taut
{
  /**
   * The cubic Hermite element of beams: value w and slope dw/ds at each vertex, C1 across cells of
   * any length.
   *
   * s is the arc length along the wire, in the direction of the first coarse cell of the
   * triangulation. Cells may run either way (a mesh file knows no order): on a backward cell the
   * slope DoFs keep the wire's sign. A cell that turns more than 60 degrees away from that
   * direction has no clear sense and is a UserError; so is a cell against x for spacedim = 1, where
   * deal.II would give it a negative JxW.
   *
   * Through FEValues the gradient of a shape function is t dw/ds and its hessian t (x) t d2w/ds2, t
   * the unit tangent. The mapping must be affine on each cell and keep the vertices of the
   * triangulation, e.g. MappingQ1 (checked in debug mode).
   *
   * What follows from the slopes: shape functions depend on the length of their cell, so
   * shape_value() and the like are those of a cell of length 1; there are no support points (use
   * interpolate()) and no prolongation matrices.
   *
   * DoFs on a cell: (w, dw/ds) at vertex 0, (w, dw/ds) at vertex 1, the order of the element of the
   * same name in newer deal.II. The slopes there are scaled by 1/4.
   */
  template <int dim, int spacedim = dim>
  class FE_Hermite : public dealii::FE_Poly<dim, spacedim>
  {
    static_assert(dim == 1, "FE_Hermite is an element of wires: dim must be 1");

    using CellIterator = typename dealii::Triangulation<dim, spacedim>::cell_iterator;
    using MappingInternal = typename dealii::Mapping<dim, spacedim>::InternalDataBase;
    using ElementInternal = typename dealii::FiniteElement<dim, spacedim>::InternalDataBase;
    using MappingOutput =
        dealii::internal::FEValuesImplementation::MappingRelatedData<dim, spacedim>;
    using ElementOutput =
        dealii::internal::FEValuesImplementation::FiniteElementRelatedData<dim, spacedim>;

  public:
    /// @p degree must be 3; it is an argument only to match deal.II.
    explicit FE_Hermite(const unsigned int degree = 3);

    /// "FE_Hermite<1>(3)" or, as deal.II writes it where the dimensions differ,
    /// "FE_Hermite<1,3>(3)".
    std::string get_name() const override;

    std::unique_ptr<dealii::FiniteElement<dim, spacedim>> clone() const override;

    /// Length of the cell [m], negative if it runs against the wire: what hermite_shape() asks for.
    static double signed_length(const CellIterator &cell);

    /**
     * Sets value and slope in every vertex from @p function and its gradient, which it must
     * implement. @p dof_handler uses this element; @p dof_values has its size.
     */
    static void interpolate(const dealii::DoFHandler<dim, spacedim> &dof_handler,
                            const dealii::Function<spacedim, double> &function,
                            dealii::Vector<double> &dof_values);

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
  };
} // namespace taut

#endif
