// SPDX-License-Identifier: LGPL-2.1-or-later
#include "interface/interface_preconditioner.h"
#include "base/groups.h"
#include "base/pivots.h"
#include "interface/rows_of_blocks.h"

#include <taut/base/exceptions.h>

#include <algorithm>
#include <numeric>

namespace taut
{
  namespace
  {
    /// Part of F_ii below which the compliance of an elastic row counts as rigid: its spring would
    /// cost the factor of T nine of sixteen digits.
    constexpr double smallest_compliance = 1e-9;

    /// Relative shift of T, which is singular for a floating group of bodies in statics. Springs
    /// within the group do not excite its rigid body modes. It is well above rounding, and
    /// solutions do not depend on a preconditioner.
    constexpr double null_space_shift = 1e-9;
  } // namespace

  InterfacePreconditioner::InterfacePreconditioner(const InterfaceParameters &parameters,
                                                   const FactoredStructure &solvers,
                                                   const BodyConstraints &body_constraints)
      : is_diagonal(parameters.preconditioner == "diagonal"), constraints(body_constraints.all()),
        T(solvers, body_constraints),
        inverse_T(solvers.structure().communicator(), parameters.largest_whole_factor)
  {
    if (!is_diagonal && parameters.preconditioner != "Dirichlet")
      throw UserError("unknown preconditioner '" + parameters.preconditioner +
                      "'; known are: diagonal, Dirichlet. Correct the name");
  }

  template <typename Values>
  std::vector<double> InterfacePreconditioner::on_blocks_of(const Values &of_constraints) const
  {
    if (has_all_rows())
      return {of_constraints.begin(), of_constraints.end()};
    std::vector<double> of_owned, result(kept.size());
    for (const std::size_t number : owners->owned())
      of_owned.push_back(of_constraints[constraints.index(number)]);
    if (!own_rows)
      return of_owned;
    own_rows->copy_to_holders(of_owned.data(), result.data());
    return result;
  }

  std::vector<double>
  InterfacePreconditioner::on_blocks(const std::vector<double> &of_constraints) const
  {
    return on_blocks_of(of_constraints);
  }

  void InterfacePreconditioner::copy_to_blocks(MatrixEntries &of_owned,
                                               const std::size_t n_columns) const
  {
    if (own_rows)
      own_rows->sum_entries(of_owned, n_columns);
  }

  void InterfacePreconditioner::setup(const RowMap &rows, const std::vector<char> &active,
                                      const std::vector<char> &is_changed,
                                      const std::vector<double> &own_compliance,
                                      const std::vector<double> &own_diagonal)
  {
    owners = &rows;
    if (is_diagonal)
    {
      kept = rows.owned();
      set_rows(active, own_diagonal, own_compliance);
      return;
    }
    T.setup(active, is_changed);
    set_springs(active, own_compliance, own_diagonal);
    const MatrixEntries products = scale_by_stiffness();
    if (rows.communicator().size() > 1)
      keep_blocks(products);
    else
    {
      kept.resize(constraints.n_of_all());
      std::iota(kept.begin(), kept.end(), std::size_t(0));
    }
    set_rows(active, own_diagonal, own_compliance);
    set_scaling(products);
    set_forms();
    if (has_springs)
      factor_with_springs();
  }

  /// Of a row among those of blocks().
  std::size_t InterfacePreconditioner::position(const int number) const
  {
    const auto i = static_cast<std::size_t>(number);
    return own_rows ? std::lower_bound(kept.begin(), kept.end(), i) - kept.begin() : i;
  }

  /// Which rows are active, and which of them are elastic.
  void InterfacePreconditioner::set_rows(const std::vector<char> &active,
                                         const std::vector<double> &own_diagonal,
                                         const std::vector<double> &own_compliance)
  {
    const std::vector<double> is_active = on_blocks_of(active), diagonal = on_blocks(own_diagonal),
                              compliance = on_blocks(own_compliance);
    other.assign(kept.size(), 0.);
    stiffness.assign(kept.size(), 0.);
    is_rigid.assign(kept.size(), 0);
    for (std::size_t p = 0; p < kept.size(); ++p)
    {
      if (is_active[p] > 0. && diagonal[p] > 0.)
        other[p] = 1. / diagonal[p];
      if (has_springs && is_active[p] > 0. && compliance[p] > smallest_compliance * diagonal[p])
        stiffness[p] = 1. / compliance[p];
    }
    place.clear();
    for (std::size_t p = 0; p < kept.size() && place.size() < owners->owned().size(); ++p)
      if (kept[p] == owners->owned()[place.size()])
        place.push_back(p);
    Q_entries = {};
  }

  /// Stiffnesses of elastic rows that this rank holds, and the diagonal of T with them.
  void InterfacePreconditioner::set_springs(const std::vector<char> &active,
                                            const std::vector<double> &own_compliance,
                                            const std::vector<double> &own_diagonal)
  {
    springs.assign(owners->held().size(), 0.);
    D = T.diagonal();
    std::vector<double> of_owned;
    for (const std::size_t number : owners->owned())
    {
      const std::size_t i = constraints.index(number);
      const bool is_spring = active[i] && own_compliance[i] > smallest_compliance * own_diagonal[i];
      of_owned.push_back(is_spring ? 1. / own_compliance[i] : 0.);
    }
    has_springs = owners->communicator().any(std::any_of(
        of_owned.begin(), of_owned.end(), [](const double spring) { return spring > 0.; }));
    if (!has_springs)
      return;
    owners->copy_to_holders(of_owned.data(), springs.data());
    const MatrixEntries &forms = T.constraints();
    for (std::size_t e = 0; e < forms.size(); ++e)
      D[forms.column[e]] += spring(forms.row[e]) * forms.value[e] * forms.value[e];
  }

  /// Stiffness of a held row; 0 if it is not elastic.
  double InterfacePreconditioner::spring(const int number) const
  {
    const std::vector<std::size_t> &held = owners->held();
    const auto at = std::lower_bound(held.begin(), held.end(), static_cast<std::size_t>(number));
    return at != held.end() && *at == static_cast<std::size_t>(number) ? springs[at - held.begin()]
                                                                       : 0.;
  }

  /// B and D^-1 B_r on the rows of blocks().
  void InterfacePreconditioner::set_forms()
  {
    B = {};
    scaled_B.clear();
    const MatrixEntries &forms = T.constraints();
    for (std::size_t e = 0; e < forms.size(); ++e)
    {
      const std::size_t p = position(forms.row[e]);
      if (p >= kept.size() || kept[p] != static_cast<std::size_t>(forms.row[e]) ||
          (!is_rigid[p] && stiffness[p] == 0.))
        continue;
      const double d = D[forms.column[e]];
      B.add(p, forms.column[e], forms.value[e]);
      scaled_B.push_back(is_rigid[p] && d > 0. ? forms.value[e] / d : 0.);
    }
  }

  /// The factor of T with the elastic rows as springs between the DoFs, which may be of two ranks:
  /// the owner of a row adds its spring.
  void InterfacePreconditioner::factor_with_springs()
  {
    const Communicator &processes = owners->communicator();
    const std::size_t n = T.n_dofs();
    std::vector<std::size_t> sizes;
    processes.gather(n, sizes);
    const auto own = sizes.begin() + processes.rank();
    const std::size_t first = std::accumulate(sizes.begin(), own, std::size_t(0)),
                      all = std::accumulate(own, sizes.end(), first);
    SymmetricEntries shifted = T.entries();
    for (std::size_t e = 0; e < shifted.size(); ++e)
    {
      shifted.row[e] += static_cast<int>(first);
      shifted.column[e] += static_cast<int>(first);
    }
    for (std::size_t p = 0; p < n; ++p)
      shifted.add(first + p, first + p, D[p] > 0. ? null_space_shift * D[p] : 1.);
    MatrixEntries elastic;
    for (std::size_t e = 0; e < B.size(); ++e)
      if (stiffness[B.row[e]] > 0.)
        elastic.add(kept[B.row[e]], first + B.column[e], B.value[e]);
    if (own_rows)
      own_rows->sum_entries(elastic, all);
    for (std::size_t begin = 0, end = 0; begin < elastic.size(); begin = end)
    {
      const int number = elastic.row[begin];
      while (end < elastic.size() && elastic.row[end] == number)
        ++end;
      if (!std::binary_search(owners->owned().begin(), owners->owned().end(),
                              static_cast<std::size_t>(number)))
        continue;
      const double s = spring(number);
      for (std::size_t e = begin; e < end; ++e)
        for (std::size_t f = begin; f <= e; ++f)
          shifted.add(elastic.column[e], elastic.column[f],
                      s * elastic.value[e] * elastic.value[f]);
    }
    shifted.compress();
    inverse_T.factor(n, std::move(shifted), 0.);
  }

  /// Products of D^-1 B_r with rows that have a DoF in common, by the numbers of the rows.
  MatrixEntries InterfacePreconditioner::scale_by_stiffness()
  {
    const MatrixEntries &forms = T.constraints();
    std::vector<std::vector<std::size_t>> at_dof(D.size());
    for (std::size_t e = 0; e < forms.size(); ++e)
      if (D[forms.column[e]] > 0. && spring(forms.row[e]) == 0.)
        at_dof[forms.column[e]].push_back(e);
    MatrixEntries products;
    for (std::size_t dof = 0; dof < at_dof.size(); ++dof)
      for (std::size_t a = 0; a < at_dof[dof].size(); ++a)
        for (std::size_t b = 0; b <= a; ++b)
        {
          const std::size_t e = at_dof[dof][a], f = at_dof[dof][b];
          products.add(forms.row[e], forms.row[f], forms.value[e] * forms.value[f] / D[dof]);
        }
    products.compress();
    return products;
  }

  /// Q from the shares that the ranks have of its entries.
  void InterfacePreconditioner::set_scaling(const MatrixEntries &products)
  {
    MatrixEntries sums = products;
    if (own_rows)
      own_rows->sum_entries(sums, constraints.n_of_all());
    std::vector<double> diagonal(kept.size(), 0.);
    for (std::size_t e = 0; e < sums.size(); ++e)
    {
      const std::size_t row = position(sums.row[e]), column = position(sums.column[e]);
      if (row == column)
        diagonal[row] += sums.value[e];
      else
        Q_entries.add(row, column, sums.value[e]);
    }
    for (std::size_t p = 0; p < diagonal.size(); ++p)
    {
      // Q is singular for dependent rigid constraints.
      Q_entries.add(p, p, diagonal[p] > 0. ? diagonal[p] * (1. + dependence_shift) : 1.);
      is_rigid[p] = diagonal[p] > 0.;
      if (is_rigid[p])
        other[p] = 0.;
    }
    Q_entries.compress();
    owners->communicator().agree([&] { Q.factor(kept.size(), Q_entries, 0.); });
  }

  RowBlocks InterfacePreconditioner::blocks() const
  {
    Groups groups(kept.size());
    for (std::size_t e = 0; e < Q_entries.size(); ++e)
      groups.join(Q_entries.row[e], Q_entries.column[e]);
    return {kept, groups.numbers()};
  }

  /// Keeps the rows of the blocks of Q that the bodies of this rank see, and its owned rows.
  void InterfacePreconditioner::keep_blocks(const MatrixEntries &products)
  {
    const Communicator &processes = owners->communicator();
    const std::vector<std::size_t> &held = owners->held();
    std::vector<std::size_t> elastic;
    for (std::size_t p = 0; p < held.size(); ++p)
      if (springs[p] > 0.)
        elastic.push_back(held[p]);
    const bool is_same = own_rows && pattern.row == products.row &&
                         pattern.column == products.column && owned == owners->owned() &&
                         with_springs == elastic;
    if (!processes.any(!is_same))
      return;
    own_rows.reset(); // until all are new
    kept = rows_of_blocks(*owners, products, constraints.n_of_all());
    kept.insert(kept.end(), elastic.begin(), elastic.end());
    std::sort(kept.begin(), kept.end());
    kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
    own_rows = std::make_unique<const RowMap>(*owners, kept);
    with_springs = std::move(elastic);
    pattern = products;
    owned = owners->owned();
  }

  void InterfacePreconditioner::scale(std::vector<double> &r) const
  {
    if (is_diagonal)
    {
      for (std::size_t p = 0; p < r.size(); ++p)
        r[p] *= other[p];
      return;
    }
    jump = r;
    Q.solve(jump);
    for (std::size_t p = 0; p < r.size(); ++p)
      r[p] = is_rigid[p] ? jump[p] : other[p] * r[p];
  }

  /// Sums the shares in @p jump on the owned rows.
  void InterfacePreconditioner::sum_shares() const
  {
    if (!own_rows)
    {
      sums = jump;
      return;
    }
    sums.resize(place.size());
    own_rows->add_shares(jump.data(), sums.data());
  }

  /// Sums the shares in @p jump on the rows of blocks().
  void InterfacePreconditioner::take_shares() const
  {
    if (!own_rows)
      return;
    sum_shares();
    own_rows->copy_to_holders(sums.data(), jump.data());
  }

  /// force = (T + B_c S_c^-1 B_c^T)^-1 force.
  void InterfacePreconditioner::solve_springs() const
  {
    inverse_T.solve_own(force);
  }

  /// force = (T + B_c S_c^-1 B_c^T) motion.
  void InterfacePreconditioner::multiply_with_springs() const
  {
    T.multiply(motion, force);
    if (!has_springs)
      return;
    jump.assign(kept.size(), 0.);
    for (std::size_t e = 0; e < B.size(); ++e)
      jump[B.row[e]] += stiffness[B.row[e]] * B.value[e] * motion[B.column[e]];
    take_shares();
    for (std::size_t e = 0; e < B.size(); ++e)
      if (stiffness[B.row[e]] > 0.)
        force[B.column[e]] += B.value[e] * jump[B.row[e]];
  }

  void InterfacePreconditioner::apply(const std::vector<double> &r, std::vector<double> &z) const
  {
    z.resize(r.size());
    for (std::size_t p = 0; p < r.size(); ++p)
      z[p] = stiffness[place[p]] == 0. ? other[place[p]] * r[p] : 0.;
    if (is_diagonal)
      return;
    residual.resize(kept.size());
    if (own_rows)
      own_rows->copy_to_holders(r.data(), residual.data());
    else
      residual = r;
    jump = residual;
    if (has_springs)
    {
      // T u = B_c S_c^-1 r_c, the motion that the elastic rows leave to the rigid ones.
      force.assign(T.n_dofs(), 0.);
      for (std::size_t e = 0; e < B.size(); ++e)
        force[B.column[e]] += B.value[e] * stiffness[B.row[e]] * residual[B.row[e]];
      solve_springs();
      jump.assign(kept.size(), 0.);
      for (std::size_t e = 0; e < B.size(); ++e)
        jump[B.row[e]] -= B.value[e] * force[B.column[e]];
      take_shares();
      for (std::size_t p = 0; p < kept.size(); ++p)
        jump[p] += residual[p];
    }

    // Applies the rigid rows.
    Q.solve(jump);
    motion.assign(T.n_dofs(), 0.);
    for (std::size_t e = 0; e < B.size(); ++e)
      motion[B.column[e]] += scaled_B[e] * jump[B.row[e]];
    multiply_with_springs();
    jump.assign(kept.size(), 0.);
    for (std::size_t e = 0; e < B.size(); ++e)
      jump[B.row[e]] += scaled_B[e] * force[B.column[e]];
    take_shares();
    Q.solve(jump);
    for (std::size_t p = 0; p < r.size(); ++p)
      if (is_rigid[place[p]])
        z[p] += jump[place[p]];
    if (!has_springs)
      return;

    // And the elastic ones, with what the rigid ones move.
    force.assign(T.n_dofs(), 0.);
    for (std::size_t e = 0; e < B.size(); ++e)
    {
      const std::size_t p = B.row[e];
      force[B.column[e]] += B.value[e] * (stiffness[p] > 0. ? stiffness[p] * residual[p] : jump[p]);
    }
    solve_springs();
    jump.assign(kept.size(), 0.);
    for (std::size_t e = 0; e < B.size(); ++e)
      jump[B.row[e]] -= stiffness[B.row[e]] * B.value[e] * force[B.column[e]];
    sum_shares();
    for (std::size_t p = 0; p < r.size(); ++p)
      z[p] += stiffness[place[p]] * r[p] + sums[p];
  }
} // namespace taut
