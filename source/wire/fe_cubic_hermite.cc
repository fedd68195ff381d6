// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/wire/fe_cubic_hermite.h>
#include <taut/wire/hermite_shape.h>

#include <deal.II/base/function.h>
#include <deal.II/base/polynomial.h>
#include <deal.II/base/tensor_product_polynomials.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/lac/vector.h>

#include <cmath>
#include <sstream>
#include <vector>

namespace taut
{
  namespace
  {
    /// deal.II's basis (both values, then both slopes) in the order of our DoFs.
    dealii::TensorProductPolynomials<1> reference_polynomials()
    {
      using dealii::Polynomials::HermiteInterpolation;
      const std::vector<dealii::Polynomials::Polynomial<double>> basis = {
          HermiteInterpolation(0), HermiteInterpolation(2), HermiteInterpolation(1),
          HermiteInterpolation(3)};
      return dealii::TensorProductPolynomials<1>(basis);
    }

    template <typename Entry>
    void scale_slope_rows(const double factor, dealii::Table<2, Entry> &table)
    {
      for (unsigned int q = 0; q < table.size(1); ++q)
      {
        table(1, q) *= factor;
        table(3, q) *= factor;
      }
    }

    /// From the slope DoFs of the reference cell, d/dxi = h d/ds, to ours. What was not asked for
    /// has an empty table.
    template <typename Output>
    void scale_slope_derivatives(const double h, Output &output_data)
    {
      scale_slope_rows(h, output_data.shape_gradients);
      scale_slope_rows(h, output_data.shape_hessians);
      scale_slope_rows(h, output_data.shape_3rd_derivatives);
    }

    /// Whether vertices and midpoint of the mapped cell are those of a straight line at its place.
    template <int dim, int spacedim>
    [[maybe_unused]] bool
    is_affine(const dealii::Mapping<dim, spacedim> &mapping,
              const typename dealii::Triangulation<dim, spacedim>::cell_iterator &cell,
              const double tolerance)
    {
      const dealii::Point<spacedim> middle =
          cell->vertex(0) + (cell->vertex(1) - cell->vertex(0)) / 2;
      const auto mapped = mapping.transform_unit_to_real_cell(cell, dealii::Point<dim>(0.5));
      return mapping.preserves_vertex_locations() && mapped.distance(middle) < tolerance;
    }
  } // namespace

  template <int dim, int spacedim>
  FE_Hermite<dim, spacedim>::FE_Hermite(const unsigned int degree)
      : dealii::FE_Poly<dim, spacedim>(
            reference_polynomials(),
            dealii::FiniteElementData<dim>({2, 0}, 1, 3, dealii::FiniteElementData<dim>::H2),
            std::vector<bool>(4, false),
            std::vector<dealii::ComponentMask>(4, dealii::ComponentMask(1, true)))
  {
    AssertThrow(degree == 3, dealii::ExcMessage("FE_Hermite exists for degree 3 only."));
  }

  template <int dim, int spacedim>
  std::string FE_Hermite<dim, spacedim>::get_name() const
  {
    return "FE_Hermite<" + dealii::Utilities::dim_string(dim, spacedim) + ">(3)";
  }

  template <int dim, int spacedim>
  std::unique_ptr<dealii::FiniteElement<dim, spacedim>> FE_Hermite<dim, spacedim>::clone() const
  {
    return std::make_unique<FE_Hermite<dim, spacedim>>(*this);
  }

  template <int dim, int spacedim>
  double FE_Hermite<dim, spacedim>::signed_length(const CellIterator &cell)
  {
    const auto first = cell->get_triangulation().begin(0);
    const dealii::Tensor<1, spacedim> along = cell->vertex(1) - cell->vertex(0);
    const dealii::Tensor<1, spacedim> wire = first->vertex(1) - first->vertex(0);

    const double h = along.norm();
    const double cosine = along * wire / (h * wire.norm());
    if (!(std::abs(cosine) > 0.5) || (spacedim == 1 && !(along[0] > 0)))
    {
      std::ostringstream message;
      message << "FE_Hermite: the cell from (" << cell->vertex(0) << ") to (" << cell->vertex(1)
              << ") ";
      if (spacedim == 1)
        message << "runs against x; swap its vertices";
      else
        message << "turns more than 60 degrees away from the first cell of its mesh, so that the "
                   "sign of its slopes is not clear; give each straight wire a mesh of its own";
      throw UserError(message.str());
    }
    return cosine > 0 ? h : -h;
  }

  template <int dim, int spacedim>
  void FE_Hermite<dim, spacedim>::interpolate(const dealii::DoFHandler<dim, spacedim> &dof_handler,
                                              const dealii::Function<spacedim, double> &function,
                                              dealii::Vector<double> &dof_values)
  {
    AssertDimension(dof_values.size(), dof_handler.n_dofs());
    for (const auto &cell : dof_handler.active_cell_iterators())
    {
      const auto tangent = (cell->vertex(1) - cell->vertex(0)) / signed_length(cell);
      for (unsigned int v = 0; v < 2; ++v)
      {
        dof_values(cell->vertex_dof_index(v, 0)) = function.value(cell->vertex(v));
        dof_values(cell->vertex_dof_index(v, 1)) = function.gradient(cell->vertex(v)) * tangent;
      }
    }
  }

  template <int dim, int spacedim>
  void FE_Hermite<dim, spacedim>::fill_fe_values(
      const CellIterator &cell, const dealii::CellSimilarity::Similarity,
      const dealii::Quadrature<dim> &quadrature, const dealii::Mapping<dim, spacedim> &mapping,
      const MappingInternal &mapping_internal, const MappingOutput &mapping_data,
      const ElementInternal &fe_internal, ElementOutput &output_data) const
  {
    const double h = signed_length(cell);
    Assert(
        is_affine(mapping, cell, 1e-6 * std::abs(h)),
        dealii::ExcMessage("FE_Hermite needs a mapping that is affine on each cell and keeps the "
                           "vertices of the triangulation."));

    // For similar cells the base class would keep what it wrote last, which has been scaled since
    // and would be scaled twice: all derivatives have to be new.
    dealii::FE_Poly<dim, spacedim>::fill_fe_values(cell, dealii::CellSimilarity::none, quadrature,
                                                   mapping, mapping_internal, mapping_data,
                                                   fe_internal, output_data);
    scale_slope_derivatives(h, output_data);

    // The base class wrote the values only once, before it saw a cell: these are set, not scaled.
    for (unsigned int q = 0; q < output_data.shape_values.size(1); ++q)
    {
      const auto value = hermite_shape(h, quadrature.point(q)[0]).value;
      for (unsigned int i = 0; i < value.size(); ++i)
        output_data.shape_values(i, q) = value[i];
    }
  }

  template <int dim, int spacedim>
  void FE_Hermite<dim, spacedim>::fill_fe_face_values(
      const CellIterator &cell, const unsigned int face_no,
      const dealii::hp::QCollection<dim - 1> &quadrature,
      const dealii::Mapping<dim, spacedim> &mapping, const MappingInternal &mapping_internal,
      const MappingOutput &mapping_data, const ElementInternal &fe_internal,
      ElementOutput &output_data) const
  {
    // On faces (vertices, without subfaces) the base class writes everything anew for each cell;
    // the values of the slope functions are zero there.
    dealii::FE_Poly<dim, spacedim>::fill_fe_face_values(cell, face_no, quadrature, mapping,
                                                        mapping_internal, mapping_data, fe_internal,
                                                        output_data);
    scale_slope_derivatives(signed_length(cell), output_data);
  }

  template class FE_Hermite<1, 1>;
  template class FE_Hermite<1, 2>;
  template class FE_Hermite<1, 3>;
} // namespace taut
