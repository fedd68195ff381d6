// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/memory.h"
#include "base/write_file.h"
#include <taut/substructure/fe_body.h>

#include <deal.II/base/data_out_base.h>
#include <deal.II/base/quadrature_lib.h>

#include <deal.II/fe/fe.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <iterator>
#include <sstream>
#include <tuple>

namespace taut
{
  namespace
  {
    /// Points of a cell in a picture: corners, and what lies between them for elements of degree 2.
    template <int dim>
    std::vector<dealii::Point<dim>> points_of_picture(const dealii::FiniteElement<dim> &element)
    {
      const unsigned int degree = std::max(1u, element.degree);
      if (element.reference_cell().is_simplex())
        return dealii::FE_SimplexP<dim>(degree).get_unit_support_points();
      return dealii::QIterated<dim>(dealii::QTrapezoid<1>(), degree).get_points();
    }
  } // namespace

  /// Cells in the form that deal.II writes: values at points of each cell alone, so that no vector
  /// has all DoFs of the body.
  template <int dim>
  class FEBody<dim>::Picture : public dealii::DataOutInterface<dim>
  {
  public:
    Picture(const FEBody &body, const std::vector<Drawn> &parts);

  protected:
    using Kind = dealii::DataComponentInterpretation::DataComponentInterpretation;

    const std::vector<dealii::DataOutBase::Patch<dim>> &get_patches() const override
    {
      return patches;
    }

    std::vector<std::string> get_dataset_names() const override { return names; }

    std::vector<std::tuple<unsigned int, unsigned int, std::string, Kind>>
    get_nonscalar_data_ranges() const override;

  private:
    void find_cells(const std::vector<Drawn> &parts);
    void name_fields(const CellFields &more);

    const FEBody &body;
    const unsigned int n_components;
    std::vector<DrawnCell> cells;
    std::vector<std::string> names;
    std::vector<Kind> kinds;
    std::vector<dealii::DataOutBase::Patch<dim>> patches;
  };

  template <int dim>
  FEBody<dim>::Picture::Picture(const FEBody &body, const std::vector<Drawn> &parts)
      : body(body), n_components(body.handler.get_fe().n_components())
  {
    const dealii::FiniteElement<dim> &element = body.handler.get_fe();
    const dealii::Quadrature<dim> points(points_of_picture(element));
    find_cells(parts);
    const CellFields more = body.fields(cells, points.get_points());
    name_fields(more);
    dealii::FEValues<dim> values(body.mapping, element, points,
                                 dealii::update_values | dealii::update_quadrature_points);
    patches.resize(cells.size());
    for (std::size_t c = 0; c < cells.size(); ++c)
    {
      const auto &[cell, dofs, U] = cells[c];
      values.reinit(cell);
      dealii::DataOutBase::Patch<dim> &patch = patches[c];
      patch.reference_cell = cell->reference_cell();
      patch.patch_index = c;
      patch.n_subdivisions = std::max(1u, element.degree);
      const auto corners = body.mapping.get_vertices(cell);
      std::copy(corners.begin(), corners.end(), std::begin(patch.vertices));
      // The places of the points follow the values.
      patch.points_are_available = true;
      patch.data.reinit(names.size() + dim, points.size());
      for (unsigned int q = 0; q < points.size(); ++q)
      {
        for (unsigned int i = 0; i < dofs.size(); ++i)
          for (unsigned int k = 0; k < n_components; ++k)
            patch.data(k, q) += U[i] * values.shape_value_component(i, q, k);
        for (std::size_t k = n_components; k < names.size(); ++k)
          patch.data(k, q) = more.values[c](k - n_components, q);
        for (unsigned int d = 0; d < dim; ++d)
          patch.data(names.size() + d, q) = values.quadrature_point(q)[d];
      }
    }
  }

  template <int dim>
  void FEBody<dim>::Picture::find_cells(const std::vector<Drawn> &parts)
  {
    for (const Drawn &drawn : parts)
    {
      const auto &part = static_cast<const FEBody &>(*drawn.part);
      for (const Cell &cell : part.own_cells)
      {
        cells.push_back(
            {cell,
             std::vector<dealii::types::global_dof_index>(cell->get_fe().n_dofs_per_cell()),
             {}});
        cell->get_dof_indices(cells.back().dofs);
        for (const auto dof : cells.back().dofs)
          cells.back().U.push_back(part.value_of_dof(dof, *drawn.U));
      }
    }
    std::sort(cells.begin(), cells.end(),
              [](const DrawnCell &a, const DrawnCell &b) { return a.cell < b.cell; });
  }

  template <int dim>
  void FEBody<dim>::Picture::name_fields(const CellFields &more)
  {
    using namespace dealii::DataComponentInterpretation;
    names.assign(n_components, "displacement");
    kinds.assign(n_components, n_components == dim && dim > 1 ? component_is_part_of_vector
                                                              : component_is_scalar);
    dealii::DataOutBase::VtkFlags flags;
    flags.print_date_and_time = false; // the same bytes from run to run
    flags.physical_units["displacement"] = "m";
    for (std::size_t k = 0; k < more.names.size(); ++k)
      flags.physical_units[more.names[k]] = more.units[k];
    names.insert(names.end(), more.names.begin(), more.names.end());
    kinds.insert(kinds.end(), more.kinds.begin(), more.kinds.end());
    this->set_flags(flags);
  }

  template <int dim>
  std::vector<std::tuple<unsigned int, unsigned int, std::string,
                         dealii::DataComponentInterpretation::DataComponentInterpretation>>
  FEBody<dim>::Picture::get_nonscalar_data_ranges() const
  {
    using namespace dealii::DataComponentInterpretation;
    std::vector<std::tuple<unsigned int, unsigned int, std::string, Kind>> ranges;
    for (unsigned int k = 0; k < kinds.size();)
    {
      const unsigned int n = kinds[k] == component_is_part_of_vector   ? dim
                             : kinds[k] == component_is_part_of_tensor ? dim * dim
                                                                       : 1;
      if (n > 1)
        ranges.emplace_back(k, k + n - 1, names[k], kinds[k]);
      k += n;
    }
    return ranges;
  }

  template <int dim>
  void FEBody<dim>::write_vtu(const std::string &path, const std::vector<double> &U) const
  {
    write_vtu(Files{path}, {{this, &U}});
  }

  template <int dim>
  bool FEBody<dim>::is_drawn_with(const PartOfBody &other) const
  {
    const auto *const part = dynamic_cast<const FEBody *>(&other);
    return part && &part->handler == &handler;
  }

  template <int dim>
  void FEBody<dim>::write_vtu(const Files &files, const std::vector<Drawn> &parts) const
  {
    const Picture picture(*this, parts);
    std::ostringstream file, joined;
    picture.write_vtu(file);
    write_file(files.own, whole_text(file));
    if (files.joined.empty())
      return;
    picture.write_pvtu_record(joined, files.pieces);
    std::string text = whole_text(joined);
    const std::size_t begin = text.find("<!--"), end = text.find("-->"); // around the date
    if (begin < end && end != std::string::npos)
      text.erase(begin, end + 4 - begin);
    write_file(files.joined, text);
  }

  template void FEBody<1>::write_vtu(const std::string &, const std::vector<double> &) const;
  template bool FEBody<1>::is_drawn_with(const PartOfBody &) const;
  template void FEBody<1>::write_vtu(const Files &, const std::vector<Drawn> &) const;
  template void FEBody<2>::write_vtu(const std::string &, const std::vector<double> &) const;
  template bool FEBody<2>::is_drawn_with(const PartOfBody &) const;
  template void FEBody<2>::write_vtu(const Files &, const std::vector<Drawn> &) const;
  template void FEBody<3>::write_vtu(const std::string &, const std::vector<double> &) const;
  template bool FEBody<3>::is_drawn_with(const PartOfBody &) const;
  template void FEBody<3>::write_vtu(const Files &, const std::vector<Drawn> &) const;
} // namespace taut
