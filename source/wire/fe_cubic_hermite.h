// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_fe_cubic_hermite_h
#define taut_fe_cubic_hermite_h

#include <deal.II/fe/fe_poly.h>

#include <memory>
#include <string>

namespace taut
{
  /**
   * The cubic Hermite element of beams: value w and slope dw/ds at each vertex, C1 across cells of
   * any length. s is the arc length along a straight wire, whose cells run with it.
   *
   * Through FEValues, with the unit tangent t, the gradient of a shape function is t dw/ds and its
   * hessian t (x) t d2w/ds2. Shape functions depend on the length of their cell: take FEValues or
   * hermite_shape(), and not those of the reference cell.
   *
   * DoFs on a cell: (w, dw/ds) at vertex 0, (w, dw/ds) at vertex 1. This is the order of deal.II's
   * FE_Hermite, a different element, whose slopes are scaled by the cell.
   */
  class FE_CubicHermite : public dealii::FE_Poly<1, 3>
  {
    using FiniteElement = dealii::FiniteElement<1, 3>;
    using MappingData = dealii::internal::FEValuesImplementation::MappingRelatedData<1, 3>;
    using Output = dealii::internal::FEValuesImplementation::FiniteElementRelatedData<1, 3>;

  public:
    FE_CubicHermite();

    std::string get_name() const override { return "FE_CubicHermite<1,3>(3)"; }

    std::unique_ptr<FiniteElement> clone() const override
    {
      return std::make_unique<FE_CubicHermite>(*this);
    }

  protected:
    void fill_fe_values(const dealii::Triangulation<1, 3>::cell_iterator &cell,
                        dealii::CellSimilarity::Similarity, const dealii::Quadrature<1> &quadrature,
                        const dealii::Mapping<1, 3> &mapping,
                        const dealii::Mapping<1, 3>::InternalDataBase &mapping_internal,
                        const MappingData &mapping_data,
                        const FiniteElement::InternalDataBase &fe_internal,
                        Output &output) const override;
  };
} // namespace taut

#endif
