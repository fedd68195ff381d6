// SPDX-License-Identifier: LGPL-2.1-or-later
#include "wire/fe_cubic_hermite.h"
#include "wire/hermite_shape.h"
#include <taut/base/exceptions.h>

#include <deal.II/base/function.h>
#include <deal.II/base/polynomial.h>
#include <deal.II/base/tensor_product_polynomials.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <cmath>
#include <sstream>
#include <vector>

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

    /// In every build type: an assertion of deal.II is gone in Release, and wrong numbers remain.
    [[noreturn]] void refuse(const std::string &what, const std::string &remedy)
    {
      AssertThrow(false, dealii::ExcMessage("FE_CubicHermite: " + what + "; " + remedy));
    }

    [[noreturn]] void refuse_reference_shape()
    {
      refuse("its shape functions depend on the length of the cell, so that those of the reference "
             "cell are not the ones of other cells",
             "use FEValues, or hermite_shape()");
    }

    [[noreturn]] void refuse_transfer()
    {
      refuse("there are no matrices between a cell and its children",
             "evaluate value and slope at the vertices of the new mesh, and interpolate()");
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

    /// Scales slope DoFs of the reference cell, d/dxi = h d/ds, to DoFs of this element. Quantities
    /// that were not asked for have empty tables.
    template <typename Output>
    void scale_slope_derivatives(const double h, Output &output_data)
    {
      scale_slope_rows(h, output_data.shape_gradients);
      scale_slope_rows(h, output_data.shape_hessians);
      scale_slope_rows(h, output_data.shape_3rd_derivatives);
    }

    /// True if the mapped vertices and midpoint are those of a straight cell.
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
  FE_CubicHermite<dim, spacedim>::FE_CubicHermite(const unsigned int degree)
      : dealii::FE_Poly<dim, spacedim>(
            reference_polynomials(),
            dealii::FiniteElementData<dim>({2, 0}, 1, 3, dealii::FiniteElementData<dim>::H2),
            std::vector<bool>(4, false),
            std::vector<dealii::ComponentMask>(4, dealii::ComponentMask(1, true)))
  {
    AssertThrow(degree == 3, dealii::ExcMessage("FE_CubicHermite exists for degree 3 only."));
  }

  template <int dim, int spacedim>
  std::string FE_CubicHermite<dim, spacedim>::get_name() const
  {
    return "FE_CubicHermite<" + dealii::Utilities::dim_string(dim, spacedim) + ">(3)";
  }

  template <int dim, int spacedim>
  std::unique_ptr<dealii::FiniteElement<dim, spacedim>>
  FE_CubicHermite<dim, spacedim>::clone() const
  {
    return std::make_unique<FE_CubicHermite<dim, spacedim>>(*this);
  }

  template <int dim, int spacedim>
  double FE_CubicHermite<dim, spacedim>::signed_length(const CellIterator &cell)
  {
    const auto first = cell->get_triangulation().begin(0);
    const dealii::Tensor<1, spacedim> along = cell->vertex(1) - cell->vertex(0);
    const dealii::Tensor<1, spacedim> wire = first->vertex(1) - first->vertex(0);

    const double h = along.norm();
    const double cosine = along * wire / (h * wire.norm());
    if (!(std::abs(cosine) > 0.5) || (spacedim == 1 && !(along[0] > 0)))
    {
      std::ostringstream message;
      message << "FE_CubicHermite: the cell from (" << cell->vertex(0) << ") to ("
              << cell->vertex(1) << ") ";
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
  void
  FE_CubicHermite<dim, spacedim>::interpolate(const dealii::DoFHandler<dim, spacedim> &dof_handler,
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
  void FE_CubicHermite<dim, spacedim>::get_interpolation_matrix(
      const dealii::FiniteElement<dim, spacedim> &source, dealii::FullMatrix<double> &matrix) const
  {
    if (dynamic_cast<const FE_CubicHermite *>(&source) == nullptr)
      refuse("the slopes of " + source.get_name() + " depend on the length of the cell",
             "use FE_CubicHermite::interpolate()");
    matrix = dealii::IdentityMatrix(this->n_dofs_per_cell());
  }

  template <int dim, int spacedim>
  double FE_CubicHermite<dim, spacedim>::shape_value(unsigned int, const dealii::Point<dim> &) const
  {
    refuse_reference_shape();
  }

  template <int dim, int spacedim>
  double FE_CubicHermite<dim, spacedim>::shape_value_component(unsigned int,
                                                               const dealii::Point<dim> &,
                                                               unsigned int) const
  {
    refuse_reference_shape();
  }

  template <int dim, int spacedim>
  dealii::Tensor<1, dim>
  FE_CubicHermite<dim, spacedim>::shape_grad(unsigned int, const dealii::Point<dim> &) const
  {
    refuse_reference_shape();
  }

  template <int dim, int spacedim>
  dealii::Tensor<1, dim>
  FE_CubicHermite<dim, spacedim>::shape_grad_component(unsigned int, const dealii::Point<dim> &,
                                                       unsigned int) const
  {
    refuse_reference_shape();
  }

  template <int dim, int spacedim>
  dealii::Tensor<2, dim>
  FE_CubicHermite<dim, spacedim>::shape_grad_grad(unsigned int, const dealii::Point<dim> &) const
  {
    refuse_reference_shape();
  }

  template <int dim, int spacedim>
  dealii::Tensor<2, dim> FE_CubicHermite<dim, spacedim>::shape_grad_grad_component(
      unsigned int, const dealii::Point<dim> &, unsigned int) const
  {
    refuse_reference_shape();
  }

  template <int dim, int spacedim>
  const dealii::FullMatrix<double> &
  FE_CubicHermite<dim, spacedim>::get_prolongation_matrix(unsigned int,
                                                          const dealii::RefinementCase<dim> &) const
  {
    refuse_transfer();
  }

  template <int dim, int spacedim>
  const dealii::FullMatrix<double> &
  FE_CubicHermite<dim, spacedim>::get_restriction_matrix(unsigned int,
                                                         const dealii::RefinementCase<dim> &) const
  {
    refuse_transfer();
  }

  template <int dim, int spacedim>
  void FE_CubicHermite<dim, spacedim>::convert_generalized_support_point_values_to_dof_values(
      const std::vector<dealii::Vector<double>> &, std::vector<double> &) const
  {
    refuse("values at points do not tell the slopes", "use FE_CubicHermite::interpolate()");
  }

  template <int dim, int spacedim>
  std::vector<std::pair<unsigned int, unsigned int>>
  FE_CubicHermite<dim, spacedim>::hp_vertex_dof_identities(
      const dealii::FiniteElement<dim, spacedim> &other) const
  {
    if (dynamic_cast<const FE_CubicHermite *>(&other) != nullptr)
      return {{0, 0}, {1, 1}};
    if (other.n_dofs_per_vertex() > 0)
      unknown_neighbour = other.get_name();
    return {};
  }

  template <int dim, int spacedim>
  dealii::FiniteElementDomination::Domination
  FE_CubicHermite<dim, spacedim>::compare_for_domination(
      const dealii::FiniteElement<dim, spacedim> &other, const unsigned int codim) const
  {
    using namespace dealii::FiniteElementDomination;
    if (dynamic_cast<const FE_CubicHermite *>(&other) != nullptr)
      return either_element_can_dominate;
    if (codim > 0 && other.n_dofs_per_vertex() > 0)
      unknown_neighbour = other.get_name();
    return codim > 0 && other.n_dofs_per_vertex() == 0 ? no_requirements
                                                       : neither_element_dominates;
  }

  template <int dim, int spacedim>
  void FE_CubicHermite<dim, spacedim>::check_neighbours() const
  {
    if (!unknown_neighbour.empty())
      refuse("in hp mode it shares no value with " + unknown_neighbour,
             "use it on all cells that touch, or join them by constraints of your own");
  }

  template <int dim, int spacedim>
  void FE_CubicHermite<dim, spacedim>::fill_fe_values(
      const CellIterator &cell, const dealii::CellSimilarity::Similarity,
      const dealii::Quadrature<dim> &quadrature, const dealii::Mapping<dim, spacedim> &mapping,
      const MappingInternal &mapping_internal, const MappingOutput &mapping_data,
      const ElementInternal &fe_internal, ElementOutput &output_data) const
  {
    check_neighbours();
    const double h = signed_length(cell);
    Assert(is_affine(mapping, cell, 1e-6 * std::abs(h)),
           dealii::ExcMessage(
               "FE_CubicHermite needs a mapping that is affine on each cell and keeps the "
               "vertices of the triangulation."));

    // For similar cells the base class would keep the derivatives that it wrote last. These have
    // been scaled since, and would be scaled twice: all derivatives have to be new.
    dealii::FE_Poly<dim, spacedim>::fill_fe_values(cell, dealii::CellSimilarity::none, quadrature,
                                                   mapping, mapping_internal, mapping_data,
                                                   fe_internal, output_data);
    scale_slope_derivatives(h, output_data);

    // The base class wrote the values only once, before it saw a cell: values are set here, not
    // scaled.
    for (unsigned int q = 0; q < output_data.shape_values.size(1); ++q)
    {
      const auto value = hermite_shape(h, quadrature.point(q)[0]).value;
      for (unsigned int i = 0; i < value.size(); ++i)
        output_data.shape_values(i, q) = value[i];
    }
  }

  template <int dim, int spacedim>
  void FE_CubicHermite<dim, spacedim>::fill_fe_face_values(
      const CellIterator &cell, const unsigned int face_no,
      const dealii::hp::QCollection<dim - 1> &quadrature,
      const dealii::Mapping<dim, spacedim> &mapping, const MappingInternal &mapping_internal,
      const MappingOutput &mapping_data, const ElementInternal &fe_internal,
      ElementOutput &output_data) const
  {
    check_neighbours();
    // On faces (vertices, without subfaces) the base class writes everything anew for each cell;
    // the values of the slope functions are zero there.
    dealii::FE_Poly<dim, spacedim>::fill_fe_face_values(cell, face_no, quadrature, mapping,
                                                        mapping_internal, mapping_data, fe_internal,
                                                        output_data);
    scale_slope_derivatives(signed_length(cell), output_data);
  }

  template <int spacedim>
  void refuse_values_of_functions(const dealii::DoFHandler<1, spacedim> &dof_handler,
                                  const dealii::ComponentMask &component_mask)
  {
    const dealii::hp::FECollection<1, spacedim> &collection = dof_handler.get_fe_collection();
    for (unsigned int f = 0; f < collection.size(); ++f)
    {
      unsigned int component = 0;
      for (unsigned int b = 0; b < collection[f].n_base_elements(); ++b)
      {
        const dealii::FiniteElement<1, spacedim> &base = collection[f].base_element(b);
        const bool is_hermite =
            dynamic_cast<const FE_CubicHermite<1, spacedim> *>(&base) != nullptr;
        const unsigned int end =
            component + collection[f].element_multiplicity(b) * base.n_components();
        for (; component < end; ++component)
          if (is_hermite && component_mask[component])
            refuse("values of a function do not tell the slopes",
                   "set value and slope, DoFs 0 and 1 of the vertex: cell->vertex_dof_index(), or "
                   "use FE_CubicHermite::interpolate(); a component mask selects the others");
      }
    }
  }

  template void refuse_values_of_functions(const dealii::DoFHandler<1, 1> &,
                                           const dealii::ComponentMask &);
  template void refuse_values_of_functions(const dealii::DoFHandler<1, 2> &,
                                           const dealii::ComponentMask &);
  template void refuse_values_of_functions(const dealii::DoFHandler<1, 3> &,
                                           const dealii::ComponentMask &);

  template class FE_CubicHermite<1, 1>;
  template class FE_CubicHermite<1, 2>;
  template class FE_CubicHermite<1, 3>;
} // namespace taut
