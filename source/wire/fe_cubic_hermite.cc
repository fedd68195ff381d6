// SPDX-License-Identifier: LGPL-2.1-or-later
#include "wire/fe_cubic_hermite.h"
#include "wire/hermite_shape.h"

#include <deal.II/base/polynomial.h>
#include <deal.II/base/tensor_product_polynomials.h>

namespace taut
{
  namespace
  {
    /// Basis functions of deal.II (both values, then both slopes) in the order of the DoFs of this
    /// element.
    dealii::TensorProductPolynomials<1> reference_polynomials()
    {
      using dealii::Polynomials::HermiteInterpolation;
      const std::vector<dealii::Polynomials::Polynomial<double>> basis = {
          HermiteInterpolation(0), HermiteInterpolation(2), HermiteInterpolation(1),
          HermiteInterpolation(3)};
      return dealii::TensorProductPolynomials<1>(basis);
    }

    /// Scales slope DoFs of the reference cell, d/dxi = h d/ds, to DoFs of this element. Quantities
    /// that were not asked for have empty tables.
    template <typename Entry>
    void scale_slope_rows(const double h, dealii::Table<2, Entry> &table)
    {
      for (unsigned int q = 0; q < table.size(1); ++q)
      {
        table(1, q) *= h;
        table(3, q) *= h;
      }
    }
  } // namespace

  FE_CubicHermite::FE_CubicHermite()
      : dealii::FE_Poly<1, 3>(
            reference_polynomials(),
            dealii::FiniteElementData<1>({2, 0}, 1, 3, dealii::FiniteElementData<1>::H2),
            std::vector<bool>(4, false),
            std::vector<dealii::ComponentMask>(4, dealii::ComponentMask(1, true)))
  {
  }

  void FE_CubicHermite::fill_fe_values(
      const dealii::Triangulation<1, 3>::cell_iterator &cell, dealii::CellSimilarity::Similarity,
      const dealii::Quadrature<1> &quadrature, const dealii::Mapping<1, 3> &mapping,
      const dealii::Mapping<1, 3>::InternalDataBase &mapping_internal,
      const MappingData &mapping_data, const FiniteElement::InternalDataBase &fe_internal,
      Output &output) const
  {
    // For similar cells the base class would keep the derivatives that it wrote last. These have
    // been scaled since, and would be scaled twice: all derivatives have to be new.
    dealii::FE_Poly<1, 3>::fill_fe_values(cell, dealii::CellSimilarity::none, quadrature, mapping,
                                          mapping_internal, mapping_data, fe_internal, output);
    const double h = (cell->vertex(1) - cell->vertex(0)).norm();
    scale_slope_rows(h, output.shape_gradients);
    scale_slope_rows(h, output.shape_hessians);
    scale_slope_rows(h, output.shape_3rd_derivatives);

    // The base class wrote the values only once, before it saw a cell: values are set here, not
    // scaled.
    for (unsigned int q = 0; q < output.shape_values.size(1); ++q)
    {
      const auto value = hermite_shape(h, quadrature.point(q)[0]).value;
      for (unsigned int i = 0; i < value.size(); ++i)
        output.shape_values(i, q) = value[i];
    }
  }
} // namespace taut
