// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_fe_cubic_hermite_vector_tools_h
#define taut_fe_cubic_hermite_vector_tools_h

// The headers below use polynomial.h without including it.
#include <deal.II/base/polynomial.h>

#include <deal.II/numerics/vector_tools_boundary.h>
#include <deal.II/numerics/vector_tools_interpolate.h>

#include <map>

namespace taut
{
  /**
   * Throws dealii::ExcMessage, in every build type, if a selected component of @p dof_handler is an
   * FE_CubicHermite. VectorTools::interpolate_boundary_values() would set the slopes to the value
   * of the function. VectorTools::interpolate() would set the DoFs in an FESystem to NaN. Neither
   * function calls the element, so the element cannot refuse.
   */
  template <int spacedim>
  void refuse_values_of_functions(const dealii::DoFHandler<1, spacedim> &dof_handler,
                                  const dealii::ComponentMask &component_mask);
} // namespace taut

/*
 * Functions of deal.II for lines in one to three dimensions, which overload resolution prefers to
 * the general functions if this file is included. They call refuse_values_of_functions(), then the
 * general function.
 */
namespace dealii
{
  namespace VectorTools
  {
    template <int spacedim, typename number>
    void interpolate_boundary_values(
        const Mapping<1, spacedim> &mapping, const DoFHandler<1, spacedim> &dof_handler,
        const std::map<types::boundary_id, const Function<spacedim, number> *> &functions,
        std::map<types::global_dof_index, number> &values,
        const ComponentMask &component_mask = ComponentMask())
    {
      taut::refuse_values_of_functions(dof_handler, component_mask);
      interpolate_boundary_values<1, spacedim, number>(mapping, dof_handler, functions, values,
                                                       component_mask);
    }

    template <int spacedim, typename number>
    void interpolate_boundary_values(const Mapping<1, spacedim> &mapping,
                                     const DoFHandler<1, spacedim> &dof_handler,
                                     const types::boundary_id boundary,
                                     const Function<spacedim, number> &function,
                                     std::map<types::global_dof_index, number> &values,
                                     const ComponentMask &component_mask = ComponentMask())
    {
      taut::refuse_values_of_functions(dof_handler, component_mask);
      interpolate_boundary_values<1, spacedim, number>(mapping, dof_handler, boundary, function,
                                                       values, component_mask);
    }

    template <int spacedim, typename number>
    void interpolate_boundary_values(
        const hp::MappingCollection<1, spacedim> &mapping,
        const DoFHandler<1, spacedim> &dof_handler,
        const std::map<types::boundary_id, const Function<spacedim, number> *> &functions,
        std::map<types::global_dof_index, number> &values,
        const ComponentMask &component_mask = ComponentMask())
    {
      taut::refuse_values_of_functions(dof_handler, component_mask);
      interpolate_boundary_values<1, spacedim, number>(mapping, dof_handler, functions, values,
                                                       component_mask);
    }

    template <int spacedim, typename number>
    void interpolate_boundary_values(const hp::MappingCollection<1, spacedim> &mapping,
                                     const DoFHandler<1, spacedim> &dof_handler,
                                     const types::boundary_id boundary,
                                     const Function<spacedim, number> &function,
                                     std::map<types::global_dof_index, number> &values,
                                     const ComponentMask &component_mask = ComponentMask())
    {
      taut::refuse_values_of_functions(dof_handler, component_mask);
      interpolate_boundary_values<1, spacedim, number>(mapping, dof_handler, boundary, function,
                                                       values, component_mask);
    }

    template <int spacedim, typename number>
    void interpolate_boundary_values(
        const DoFHandler<1, spacedim> &dof_handler,
        const std::map<types::boundary_id, const Function<spacedim, number> *> &functions,
        std::map<types::global_dof_index, number> &values,
        const ComponentMask &component_mask = ComponentMask())
    {
      taut::refuse_values_of_functions(dof_handler, component_mask);
      interpolate_boundary_values<1, spacedim, number>(dof_handler, functions, values,
                                                       component_mask);
    }

    template <int spacedim, typename number>
    void interpolate_boundary_values(const DoFHandler<1, spacedim> &dof_handler,
                                     const types::boundary_id boundary,
                                     const Function<spacedim, number> &function,
                                     std::map<types::global_dof_index, number> &values,
                                     const ComponentMask &component_mask = ComponentMask())
    {
      taut::refuse_values_of_functions(dof_handler, component_mask);
      interpolate_boundary_values<1, spacedim, number>(dof_handler, boundary, function, values,
                                                       component_mask);
    }

    template <int spacedim, typename number>
    void interpolate_boundary_values(
        const Mapping<1, spacedim> &mapping, const DoFHandler<1, spacedim> &dof_handler,
        const std::map<types::boundary_id, const Function<spacedim, number> *> &functions,
        AffineConstraints<number> &values, const ComponentMask &component_mask = ComponentMask())
    {
      taut::refuse_values_of_functions(dof_handler, component_mask);
      interpolate_boundary_values<1, spacedim, number>(mapping, dof_handler, functions, values,
                                                       component_mask);
    }

    template <int spacedim, typename number>
    void interpolate_boundary_values(const Mapping<1, spacedim> &mapping,
                                     const DoFHandler<1, spacedim> &dof_handler,
                                     const types::boundary_id boundary,
                                     const Function<spacedim, number> &function,
                                     AffineConstraints<number> &values,
                                     const ComponentMask &component_mask = ComponentMask())
    {
      taut::refuse_values_of_functions(dof_handler, component_mask);
      interpolate_boundary_values<1, spacedim, number>(mapping, dof_handler, boundary, function,
                                                       values, component_mask);
    }

    template <int spacedim, typename number>
    void interpolate_boundary_values(
        const hp::MappingCollection<1, spacedim> &mapping,
        const DoFHandler<1, spacedim> &dof_handler,
        const std::map<types::boundary_id, const Function<spacedim, number> *> &functions,
        AffineConstraints<number> &values, const ComponentMask &component_mask = ComponentMask())
    {
      taut::refuse_values_of_functions(dof_handler, component_mask);
      interpolate_boundary_values<1, spacedim, number>(mapping, dof_handler, functions, values,
                                                       component_mask);
    }

    template <int spacedim, typename number>
    void interpolate_boundary_values(const hp::MappingCollection<1, spacedim> &mapping,
                                     const DoFHandler<1, spacedim> &dof_handler,
                                     const types::boundary_id boundary,
                                     const Function<spacedim, number> &function,
                                     AffineConstraints<number> &values,
                                     const ComponentMask &component_mask = ComponentMask())
    {
      taut::refuse_values_of_functions(dof_handler, component_mask);
      interpolate_boundary_values<1, spacedim, number>(mapping, dof_handler, boundary, function,
                                                       values, component_mask);
    }

    template <int spacedim, typename number>
    void interpolate_boundary_values(
        const DoFHandler<1, spacedim> &dof_handler,
        const std::map<types::boundary_id, const Function<spacedim, number> *> &functions,
        AffineConstraints<number> &values, const ComponentMask &component_mask = ComponentMask())
    {
      taut::refuse_values_of_functions(dof_handler, component_mask);
      interpolate_boundary_values<1, spacedim, number>(dof_handler, functions, values,
                                                       component_mask);
    }

    template <int spacedim, typename number>
    void interpolate_boundary_values(const DoFHandler<1, spacedim> &dof_handler,
                                     const types::boundary_id boundary,
                                     const Function<spacedim, number> &function,
                                     AffineConstraints<number> &values,
                                     const ComponentMask &component_mask = ComponentMask())
    {
      taut::refuse_values_of_functions(dof_handler, component_mask);
      interpolate_boundary_values<1, spacedim, number>(dof_handler, boundary, function, values,
                                                       component_mask);
    }

    template <int spacedim, typename VectorType>
    void interpolate(const hp::MappingCollection<1, spacedim> &mapping,
                     const DoFHandler<1, spacedim> &dof_handler,
                     const Function<spacedim, typename VectorType::value_type> &function,
                     VectorType &dof_values, const ComponentMask &component_mask = ComponentMask())
    {
      taut::refuse_values_of_functions(dof_handler, component_mask);
      interpolate<1, spacedim, VectorType>(mapping, dof_handler, function, dof_values,
                                           component_mask);
    }

    template <int spacedim, typename VectorType>
    void interpolate(const Mapping<1, spacedim> &mapping,
                     const DoFHandler<1, spacedim> &dof_handler,
                     const Function<spacedim, typename VectorType::value_type> &function,
                     VectorType &dof_values, const ComponentMask &component_mask = ComponentMask())
    {
      taut::refuse_values_of_functions(dof_handler, component_mask);
      interpolate<1, spacedim, VectorType>(mapping, dof_handler, function, dof_values,
                                           component_mask);
    }

    template <int spacedim, typename VectorType>
    void interpolate(const DoFHandler<1, spacedim> &dof_handler,
                     const Function<spacedim, typename VectorType::value_type> &function,
                     VectorType &dof_values, const ComponentMask &component_mask = ComponentMask())
    {
      taut::refuse_values_of_functions(dof_handler, component_mask);
      interpolate<1, spacedim, VectorType>(dof_handler, function, dof_values, component_mask);
    }

    template <int spacedim, typename VectorType>
    void interpolate_based_on_material_id(
        const Mapping<1, spacedim> &mapping, const DoFHandler<1, spacedim> &dof_handler,
        const std::map<types::material_id,
                       const Function<spacedim, typename VectorType::value_type> *> &functions,
        VectorType &dof_values, const ComponentMask &component_mask = ComponentMask())
    {
      taut::refuse_values_of_functions(dof_handler, component_mask);
      interpolate_based_on_material_id<1, spacedim, VectorType>(mapping, dof_handler, functions,
                                                                dof_values, component_mask);
    }
  } // namespace VectorTools
} // namespace dealii

#endif
