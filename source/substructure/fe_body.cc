// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/dot.h>
#include <taut/base/exceptions.h>
#include <taut/base/memory.h>
#include <taut/base/write_file.h>
#include <taut/substructure/fe_body.h>

#include <deal.II/dofs/dof_tools.h>

#include <deal.II/fe/fe.h>
#include <deal.II/fe/mapping_q1.h>

#include <deal.II/grid/grid_tools.h>

#include <deal.II/numerics/data_out.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace taut
{
  namespace
  {
    /// Part of itself below which a vector is a combination of others.
    constexpr double dependent = 1e-10;
  } // namespace

  /// A load that changes in time, on the DoFs that are kept.
  template <int dim>
  class FEBody<dim>::Load : public TimeLoad
  {
  public:
    Load(const FEBody<dim> &body, std::function<void(double, dealii::Vector<double> &)> add)
        : body(body), add_load(std::move(add))
    {
    }
    void add(const double t, std::vector<double> &P) const override
    {
      dealii::Vector<double> own(P.size());
      add_load(t, own);
      body.condense(own, P);
    }

  private:
    const FEBody<dim> &body;
    const std::function<void(double, dealii::Vector<double> &)> add_load;
  };

  template <int dim>
  FEBody<dim>::FEBody(const std::string &name, const dealii::DoFHandler<dim> &dof_handler,
                      const dealii::SparseMatrix<double> &mass,
                      const dealii::SparseMatrix<double> &damping,
                      const dealii::SparseMatrix<double> &stiffness,
                      const dealii::AffineConstraints<double> &constraints,
                      const dealii::Vector<double> &load, const Options &options)
      : Substructure(name, options.origin), handler(dof_handler),
        mapping(options.mapping ? *options.mapping : dealii::StaticMappingQ1<dim>::mapping),
        scalar_direction(options.direction)
  {
    const unsigned int n = handler.n_dofs();
    check_size(mass.m(), "mass matrix");
    check_size(stiffness.m(), "stiffness matrix");
    if (!damping.empty())
      check_size(damping.m(), "damping matrix");
    if (load.size() != 0)
      check_size(load.size(), "load");
    if (!options.kinds.empty())
    {
      check_size(options.kinds.size(), "list of kinds");
      kinds = options.kinds;
    }

    forms.resize(n);
    for (unsigned int i = 0; i < n; ++i)
    {
      const auto *entries =
          constraints.is_constrained(i) ? constraints.get_constraint_entries(i) : nullptr;
      if (!entries || entries->empty())
        forms[i].add(i, 1.);
      else
        for (const auto &[j, weight] : *entries)
          forms[i].add(j, weight);
      if (!constraints.is_constrained(i))
        continue;
      const double value = constraints.get_inhomogeneity(i);
      if (value != 0. && entries && !entries->empty())
        throw UserError("body '" + name + "': DoF " + std::to_string(i) +
                        " depends on others and has an inhomogeneity; prescribe those others");
      constrained.push_back({i});
      if (value != 0.)
        constrained.back().motion = [value](double) { return value; };
    }

    M = std::make_unique<CompressedMatrix>(n);
    C = std::make_unique<CompressedMatrix>(n);
    K = std::make_unique<CompressedMatrix>(n);
    set_matrix(mass, *M);
    set_matrix(stiffness, *K);
    if (!damping.empty())
      set_matrix(damping, *C);
    constant_force.assign(n, 0.);
    if (load.size() != 0)
      condense(load, constant_force);
    finish();
    find_null_space(options);
  }

  template <int dim>
  void FEBody<dim>::check_size(const std::size_t size, const std::string &what) const
  {
    if (size != handler.n_dofs())
      throw UserError("body '" + name() + "': its " + what + " has size " + std::to_string(size) +
                      ", and its DoFHandler " + std::to_string(handler.n_dofs()) + " DoFs");
  }

  /// T^T A T with the rows of T in `forms`, lower triangle.
  template <int dim>
  void FEBody<dim>::set_matrix(const dealii::SparseMatrix<double> &source,
                               SymmetricMatrix &target) const
  {
    for (unsigned int i = 0; i < source.m(); ++i)
      for (auto entry = source.begin(i); entry != source.end(i); ++entry)
      {
        const LinearForm &a = forms[i], &b = forms[entry->column()];
        for (std::size_t p = 0; p < a.index.size(); ++p)
          for (std::size_t q = 0; q < b.index.size(); ++q)
            if (a.index[p] >= b.index[q])
              target.add(a.index[p], b.index[q], a.value[p] * b.value[q] * entry->value());
      }
  }

  /// result += T^T P.
  template <int dim>
  void FEBody<dim>::condense(const dealii::Vector<double> &P, std::vector<double> &result) const
  {
    for (std::size_t i = 0; i < forms.size(); ++i)
      if (P[i] != 0.)
        forms[i].add_to(P[i], result);
  }

  template <int dim>
  void FEBody<dim>::add_load(std::function<void(double, dealii::Vector<double> &)> add)
  {
    time_loads.push_back(std::make_unique<Load>(*this, std::move(add)));
  }

  template <int dim>
  void FEBody<dim>::add_constant_load(const dealii::Vector<double> &P)
  {
    check_size(P.size(), "load");
    condense(P, constant_force);
  }

  template <int dim>
  void FEBody<dim>::prescribe(
      const std::map<dealii::types::global_dof_index, std::function<double(double)>> &motions)
  {
    for (const auto &[dof, motion] : motions)
    {
      const auto found =
          std::lower_bound(constrained.begin(), constrained.end(), dof,
                           [](const ConstrainedDof &c, const auto i) { return c.dof < i; });
      if (found == constrained.end() || found->dof != dof ||
          forms[dof].index != std::vector<unsigned int>{static_cast<unsigned int>(dof)})
        throw UserError("body '" + name() + "': no constraint prescribes DoF " +
                        std::to_string(dof));
      found->motion = motion;
    }
    finish();
  }

  template <int dim>
  void FEBody<dim>::set_initial_state(const dealii::Vector<double> &displacement,
                                      const dealii::Vector<double> &velocity)
  {
    check_size(displacement.size(), "initial displacement");
    check_size(velocity.size(), "initial velocity");
    U0 = displacement;
    V0 = velocity;
  }

  template <int dim>
  void FEBody<dim>::initial_state(std::vector<double> &U, std::vector<double> &V) const
  {
    Substructure::initial_state(U, V);
    if (U0.size() == 0)
      return;
    std::copy(U0.begin(), U0.end(), U.begin());
    std::copy(V0.begin(), V0.end(), V.begin());
    for (const ConstrainedDof &constraint : constrained)
      U[constraint.dof] = V[constraint.dof] = 0.;
  }

  template <int dim>
  LinearForm FEBody<dim>::displacement(const Coordinates &place, const Coordinates &direction) const
  {
    const dealii::FiniteElement<dim> &element = handler.get_fe();
    if (element.n_components() != 1 && element.n_components() != dim)
      throw UserError("body '" + name() + "': an element of " +
                      std::to_string(element.n_components()) +
                      " components says of no place how it is displaced; override displacement()");
    dealii::Point<dim> point;
    for (unsigned int d = 0; d < dim; ++d)
      point[d] = place[d];
    typename dealii::DoFHandler<dim>::active_cell_iterator cell = handler.end();
    dealii::Point<dim> unit;
    try
    {
      std::tie(cell, unit) =
          dealii::GridTools::find_active_cell_around_point(mapping, handler, point);
    }
    catch (const dealii::ExceptionBase &)
    {
    }
    if (cell == handler.end())
    {
      std::ostringstream out;
      out << "body '" << name() << "': the point " << point << " is not on it";
      throw UserError(out.str());
    }
    std::vector<dealii::types::global_dof_index> dofs(element.n_dofs_per_cell());
    cell->get_dof_indices(dofs);
    double along = 0.;
    for (int d = 0; d < 3; ++d)
      along += direction[d] * scalar_direction[d];
    LinearForm result;
    for (unsigned int i = 0; i < dofs.size(); ++i)
      for (unsigned int c = 0; c < element.n_components(); ++c)
      {
        const double value = element.shape_value_component(i, unit, c) *
                             (element.n_components() == 1 ? along : direction[c]);
        if (value != 0.)
          for (std::size_t p = 0; p < forms[dofs[i]].index.size(); ++p)
            result.add(forms[dofs[i]].index[p], value * forms[dofs[i]].value[p]);
      }
    return result;
  }

  template <int dim>
  LinearForm FEBody<dim>::displacement_of_dof(const dealii::types::global_dof_index dof) const
  {
    return forms[dof];
  }

  template <int dim>
  dealii::Vector<double> FEBody<dim>::all_dofs(const std::vector<double> &U) const
  {
    dealii::Vector<double> result(U.size());
    for (std::size_t i = 0; i < U.size(); ++i)
      result[i] = forms[i].dot(U);
    return result;
  }

  template <int dim>
  void FEBody<dim>::write_vtu(const std::string &path, const std::vector<double> &U) const
  {
    const bool is_vector = handler.get_fe().n_components() == dim && dim > 1;
    using Data = dealii::DataComponentInterpretation::DataComponentInterpretation;
    dealii::DataOut<dim> data;
    data.attach_dof_handler(handler);
    const dealii::Vector<double> all = all_dofs(U);
    data.add_data_vector(
        all, std::vector<std::string>(handler.get_fe().n_components(), "displacement"),
        dealii::DataOut<dim>::type_dof_data,
        std::vector<Data>(handler.get_fe().n_components(),
                          is_vector
                              ? dealii::DataComponentInterpretation::component_is_part_of_vector
                              : dealii::DataComponentInterpretation::component_is_scalar));
    data.build_patches(mapping, handler.get_fe().degree);
    dealii::DataOutBase::VtkFlags flags;
    flags.print_date_and_time = false; // the same bytes from run to run
    data.set_flags(flags);
    std::ostringstream file;
    data.write_vtu(file);
    check_memory();
    write_file(path, file.str());
  }

  /// Motions without energy before the constraints.
  template <int dim>
  std::vector<std::vector<double>> FEBody<dim>::candidates(const Options &options) const
  {
    std::vector<std::vector<double>> modes;
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
    std::vector<dealii::Point<dim>> points(handler.n_dofs());
    dealii::DoFTools::map_dofs_to_support_points(mapping, handler, points);
    std::vector<unsigned int> component(handler.n_dofs(), 0);
    for (unsigned int c = 0; c < n_components; ++c)
    {
      dealii::ComponentMask mask(n_components, false);
      mask.set(c, true);
      for (const auto dof : dealii::DoFTools::extract_dofs(handler, mask))
        component[dof] = c;
      modes.emplace_back(handler.n_dofs(), 0.);
    }
    for (unsigned int i = 0; i < handler.n_dofs(); ++i)
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
        modes.emplace_back(handler.n_dofs(), 0.);
        for (unsigned int i = 0; i < handler.n_dofs(); ++i)
          if (component[i] == a)
            modes.back()[i] = -(points[i] - middle)[b] / size;
          else if (component[i] == b)
            modes.back()[i] = (points[i] - middle)[a] / size;
      }
    return modes;
  }

  /**
   * The combinations of the candidates that vanish on all prescribed DoFs, and DoFs that fix them.
   * The candidates are reduced by their values there, largest pivots first (a rank-revealing LU of
   * a few columns); those that are left have none.
   */
  template <int dim>
  void FEBody<dim>::find_null_space(const Options &options)
  {
    std::vector<std::vector<double>> modes = candidates(options);
    std::vector<char> is_constrained(handler.n_dofs(), 0);
    for (const ConstrainedDof &constraint : constrained)
      is_constrained[constraint.dof] = 1;
    std::vector<unsigned int> prescribed, kept;
    for (unsigned int i = 0; i < handler.n_dofs(); ++i)
      if (!is_constrained[i])
        kept.push_back(i);
      else if (forms[i].index == std::vector<unsigned int>{i})
        prescribed.push_back(i);

    /// Takes the mode and the DoF of the largest value out of the list; none above the bound:
    /// false.
    const auto eliminate = [](std::vector<std::vector<double>> &list,
                              const std::vector<unsigned int> &dofs, unsigned int &dof,
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
    };
    unsigned int dof = 0;
    std::vector<double> pivot;
    while (eliminate(modes, prescribed, dof, pivot))
      ;
    for (std::vector<double> &mode : modes)
      for (unsigned int i = 0; i < mode.size(); ++i)
        if (is_constrained[i])
          mode[i] = 0.;
    // Only those that K does not resist.
    std::vector<double> diagonal(handler.n_dofs(), 0.);
    K->visit(
        [&](const unsigned int i, const unsigned int j, const double value)
        {
          if (i == j)
            diagonal[i] = value;
        });
    modes.erase(std::remove_if(modes.begin(), modes.end(),
                               [&](const std::vector<double> &mode)
                               {
                                 std::vector<double> force(mode.size(), 0.);
                                 K->vmult_add(1., mode.data(), force.data());
                                 double scale = 0.;
                                 for (std::size_t i = 0; i < mode.size(); ++i)
                                   scale += diagonal[i] * mode[i] * mode[i];
                                 return std::fabs(dot(force, mode)) > dependent * scale;
                               }),
                modes.end());
    own_null_space = {};
    std::vector<std::vector<double>> rest = modes;
    while (eliminate(rest, kept, dof, pivot))
    {
      own_null_space.vectors.push_back(pivot);
      own_null_space.fixing_dofs.push_back(dof);
    }
  }

  template class FEBody<1>;
  template class FEBody<2>;
  template class FEBody<3>;
} // namespace taut
