// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/dot.h"
#include <taut/substructure/fe_body.h>

#include <deal.II/fe/fe.h>

#include <algorithm>
#include <cmath>

namespace taut
{
  namespace
  {
    /// A vector is a combination of others if less than this part of it remains: far above
    /// rounding. An elastic support with less than this part of the stiffness of the body counts as
    /// none.
    constexpr double dependent = 1e-10;

    using Modes = std::vector<std::vector<double>>;

    /// Takes the mode and the DoF of the largest value out of the list and makes the other modes
    /// zero there. Returns false if no value exceeds the bound.
    bool eliminate(Modes &list, const std::vector<unsigned int> &dofs, unsigned int &dof,
                   std::vector<double> &pivot_mode)
    {
      double largest = dependent;
      std::size_t mode = list.size();
      for (std::size_t m = 0; m < list.size(); ++m)
        for (const unsigned int i : dofs)
          if (std::fabs(list[m][i]) > largest)
          {
            largest = std::fabs(list[m][i]);
            mode = m;
            dof = i;
          }
      if (mode == list.size())
        return false;
      pivot_mode = list[mode];
      list.erase(list.begin() + mode);
      for (std::vector<double> &other : list)
      {
        const double factor = other[dof] / pivot_mode[dof];
        for (std::size_t i = 0; i < other.size(); ++i)
          other[i] -= factor * pivot_mode[i];
        other[dof] = 0.;
      }
      return true;
    }

    /// Appends to each mode the relative work on it of the forces K u of each mode u. Returns the
    /// positions of these values.
    std::vector<unsigned int> append_work(const SymmetricMatrix &K, const std::size_t n_rows,
                                          Modes &modes)
    {
      std::vector<double> diagonal(n_rows, 0.);
      K.visit(
          [&](const unsigned int i, const unsigned int j, const double value)
          {
            if (i == j)
              diagonal[i] = value;
          });
      const Modes all = modes;
      std::vector<unsigned int> work;
      for (const std::vector<double> &mode : all)
      {
        std::vector<double> force(mode.size(), 0.);
        K.vmult_add(1., mode.data(), force.data());
        double scale = 0.;
        for (std::size_t i = 0; i < mode.size(); ++i)
          scale += diagonal[i] * mode[i] * mode[i];
        work.push_back(n_rows + work.size());
        for (std::size_t m = 0; m < all.size(); ++m)
          modes[m].push_back(scale > 0. ? dot(all[m], force) / scale : 0.);
      }
      return work;
    }
  } // namespace

  /// Motions without energy before the constraints.
  template <int dim>
  std::vector<std::vector<double>> FEBody<dim>::candidates(const Options &options) const
  {
    Modes modes;
    for (const dealii::Vector<double> &given : options.null_space)
    {
      check_size(given.size(), "null space");
      modes.emplace_back(given.begin(), given.end());
    }
    const dealii::FiniteElement<dim> &element = handler.get_fe();
    if (!options.null_space.empty() || !options.rigid_body_modes || !element.has_support_points())
      return modes;
    const unsigned int n_components = element.n_components();
    if (n_components != 1 && n_components != dim)
      return modes;
    std::vector<dealii::Point<dim>> points(n_rows);
    std::vector<unsigned int> component(n_rows, n_components);
    std::vector<dealii::types::global_dof_index> on_cell(element.n_dofs_per_cell());
    std::size_t n_known = 0;
    const auto note = [&](const Cell &cell)
    {
      cell->get_dof_indices(on_cell);
      for (unsigned int c = 0; c < on_cell.size(); ++c)
      {
        const unsigned int i = has_dof(on_cell[c]) ? index(on_cell[c]) : component.size();
        if (i == component.size() || component[i] != n_components)
          continue;
        ++n_known;
        component[i] = element.system_to_component_index(c).first;
        points[i] = mapping.transform_unit_to_real_cell(cell, element.unit_support_point(c));
      }
    };
    for (const Cell &cell : own_cells)
      note(cell);
    // Hanging nodes of a part depend on nodes of cells beside it.
    if (n_known < n_rows)
      for (const auto &cell : handler.active_cell_iterators())
        if (!cell->is_artificial())
          note(cell);
    for (unsigned int c = 0; c < n_components; ++c)
      modes.emplace_back(n_rows, 0.);
    for (unsigned int i = 0; i < n_rows; ++i)
      modes[component[i]][i] = 1.;
    if (n_components == 1)
      return modes;
    // Rotations about the middle, with the size of the body as the unit of length.
    dealii::Point<dim> middle;
    for (const auto &point : points)
      middle += point / static_cast<double>(points.size());
    double size = 0.;
    for (const auto &point : points)
      size = std::max(size, point.distance(middle));
    for (unsigned int a = 0; a < dim; ++a)
      for (unsigned int b = a + 1; b < dim; ++b)
      {
        modes.emplace_back(n_rows, 0.);
        for (unsigned int i = 0; i < n_rows; ++i)
          if (component[i] == a)
            modes.back()[i] = -(points[i] - middle)[b] / size;
          else if (component[i] == b)
            modes.back()[i] = (points[i] - middle)[a] / size;
      }
    return modes;
  }

  /**
   * Finds the combinations of the candidates that vanish on all prescribed DoFs and cost no energy,
   * and DoFs that fix them. The candidates are reduced by their values on prescribed DoFs and by
   * the work of K on them, largest pivots first (a rank-revealing LU of a few columns). The
   * remaining candidates have neither values nor work.
   */
  template <int dim>
  void FEBody<dim>::find_null_space(const Options &options)
  {
    Modes modes = candidates(options);
    std::vector<char> is_constrained(n_rows, 0);
    for (const ConstrainedDof &constraint : constrained)
      is_constrained[constraint.dof] = 1;
    std::vector<unsigned int> prescribed, kept;
    for (unsigned int i = 0; i < n_rows; ++i)
      if (!is_constrained[i])
        kept.push_back(i);
      else if (dependences.count(i) == 0)
        prescribed.push_back(i);

    unsigned int dof = 0;
    std::vector<double> pivot;
    while (eliminate(modes, prescribed, dof, pivot))
      ;
    for (std::vector<double> &mode : modes)
      for (unsigned int i = 0; i < mode.size(); ++i)
        if (is_constrained[i])
          mode[i] = 0.;
    // Keeps only combinations that K does not resist: their forces do no work on any combination.
    const std::vector<unsigned int> work = append_work(*K, n_rows, modes);
    while (eliminate(modes, work, dof, pivot))
      ;
    for (std::vector<double> &mode : modes)
      mode.resize(n_rows);
    while (eliminate(modes, kept, dof, pivot))
    {
      own_null_space.vectors.push_back(pivot);
      own_null_space.fixing_dofs.push_back(dof);
    }
  }

  template std::vector<std::vector<double>> FEBody<1>::candidates(const Options &) const;
  template std::vector<std::vector<double>> FEBody<2>::candidates(const Options &) const;
  template std::vector<std::vector<double>> FEBody<3>::candidates(const Options &) const;
  template void FEBody<1>::find_null_space(const Options &);
  template void FEBody<2>::find_null_space(const Options &);
  template void FEBody<3>::find_null_space(const Options &);
} // namespace taut
