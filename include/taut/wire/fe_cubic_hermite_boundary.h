// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_fe_cubic_hermite_boundary_h
#define taut_fe_cubic_hermite_boundary_h

// The headers that the second one includes use it without including it.
#include <deal.II/base/polynomial.h>

#include <deal.II/numerics/vector_tools_boundary.h>

#include <map>

namespace taut
{
  /**
   * Throws dealii::ExcMessage, in every build type, if a selected component of @p dof_handler is
   * one of FE_CubicHermite: VectorTools::interpolate_boundary_values() would set its slopes to the
   * value of the function, and asks the element nothing that could tell it.
   */
  template <int spacedim>
  void refuse_boundary_values(const dealii::DoFHandler<1, spacedim> &dof_handler,
                              const dealii::ComponentMask &component_mask);
} // namespace taut

/*
 * The functions of deal.II for lines in one to three dimensions, which are taken instead of the
 * general ones where this file is included: the same, after refuse_boundary_values().
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
      taut::refuse_boundary_values(dof_handler, component_mask);
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
      taut::refuse_boundary_values(dof_handler, component_mask);
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
      taut::refuse_boundary_values(dof_handler, component_mask);
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
      taut::refuse_boundary_values(dof_handler, component_mask);
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
      taut::refuse_boundary_values(dof_handler, component_mask);
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
      taut::refuse_boundary_values(dof_handler, component_mask);
      interpolate_boundary_values<1, spacedim, number>(dof_handler, boundary, function, values,
                                                       component_mask);
    }

    template <int spacedim, typename number>
    void interpolate_boundary_values(
        const Mapping<1, spacedim> &mapping, const DoFHandler<1, spacedim> &dof_handler,
        const std::map<types::boundary_id, const Function<spacedim, number> *> &functions,
        AffineConstraints<number> &values, const ComponentMask &component_mask = ComponentMask())
    {
      taut::refuse_boundary_values(dof_handler, component_mask);
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
      taut::refuse_boundary_values(dof_handler, component_mask);
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
      taut::refuse_boundary_values(dof_handler, component_mask);
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
      taut::refuse_boundary_values(dof_handler, component_mask);
      interpolate_boundary_values<1, spacedim, number>(mapping, dof_handler, boundary, function,
                                                       values, component_mask);
    }

    template <int spacedim, typename number>
    void interpolate_boundary_values(
        const DoFHandler<1, spacedim> &dof_handler,
        const std::map<types::boundary_id, const Function<spacedim, number> *> &functions,
        AffineConstraints<number> &values, const ComponentMask &component_mask = ComponentMask())
    {
      taut::refuse_boundary_values(dof_handler, component_mask);
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
      taut::refuse_boundary_values(dof_handler, component_mask);
      interpolate_boundary_values<1, spacedim, number>(dof_handler, boundary, function, values,
                                                       component_mask);
    }

  } // namespace VectorTools
} // namespace dealii

#endif
