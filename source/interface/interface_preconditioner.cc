// SPDX-License-Identifier: LGPL-2.1-or-later
#include "interface/interface_preconditioner.h"
#include "base/gather_entries.h"
#include "base/groups.h"
#include "base/pivots.h"

#include <taut/base/exceptions.h>

#include <algorithm>
#include <numeric>
#include <set>

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

    void sort_unique(std::vector<std::size_t> &values)
    {
      std::sort(values.begin(), values.end());
      values.erase(std::unique(values.begin(), values.end()), values.end());
    }
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
    if (own_rows)
      own_rows->copy_to_holders(of_owned.data(), result.data());
    else if (is_diagonal)
      result = of_owned;
    else
      owners->gather(of_owned, result);
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
    else if (!is_diagonal)
      gather(owners->communicator(), of_owned);
  }

  void InterfacePreconditioner::setup(const RowMap &rows, const std::vector<char> &active,
                                      const std::vector<char> &is_changed,
                                      const std::vector<double> &own_compliance,
                                      const std::vector<double> &own_diagonal)
  {
    owners = &rows;
    const auto is_elastic = [&](const std::size_t number)
    {
      const std::size_t i = constraints.index(number);
      return active[i] && own_compliance[i] > smallest_compliance * own_diagonal[i];
    };
    has_springs =
        !is_diagonal &&
        rows.communicator().any(std::any_of(rows.owned().begin(), rows.owned().end(), is_elastic));
    if (is_diagonal)
    {
      kept = rows.owned();
      set_rows(active, own_diagonal, own_compliance);
      return;
    }
    T.setup(active, is_changed, has_springs);
    if (rows.communicator().size() > 1 && !has_springs)
    {
      stiffness.clear();
      const MatrixEntries products = scale_by_stiffness();
      keep_blocks(products);
      set_rows(active, own_diagonal, own_compliance);
      MatrixEntries of_kept;
      for (std::size_t e = 0; e < scaled_B.size(); ++e)
        if (scaled_B.value[e] != 0.)
          of_kept.add(position(scaled_B.row[e]), scaled_B.column[e], scaled_B.value[e]);
      scaled_B = std::move(of_kept);
      set_scaling(products);
      return;
    }
    own_rows.reset();
    kept.resize(constraints.n_of_all());
    std::iota(kept.begin(), kept.end(), std::size_t(0));
    set_rows(active, own_diagonal, own_compliance);
    if (has_springs)
      add_springs();
    set_scaling(scale_by_stiffness());
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

  /// The elastic rows as springs between the DoFs, and the factor of T with them.
  void InterfacePreconditioner::add_springs()
  {
    T.add_springs(stiffness);
    SymmetricEntries shifted = T.entries();
    std::vector<char> has_diagonal(T.n_dofs(), 0);
    for (std::size_t e = 0; e < shifted.size(); ++e)
      if (shifted.row[e] == shifted.column[e] && shifted.value[e] > 0.)
      {
        shifted.value[e] *= 1. + null_space_shift;
        has_diagonal[shifted.row[e]] = 1;
      }
    for (std::size_t p = 0; p < T.n_dofs(); ++p)
      if (!has_diagonal[p])
        shifted.add(p, p, 1.);
    inverse_T.factor_of_all(T.n_dofs(), shifted, 0.);
  }

  /// Sets D^-1 B_r, and returns its products with rows that have a DoF in common, by the numbers of
  /// the rows.
  MatrixEntries InterfacePreconditioner::scale_by_stiffness()
  {
    const MatrixEntries &B = T.constraints();
    const std::vector<double> D = T.diagonal();
    scaled_B = B;
    std::vector<std::vector<std::size_t>> at_dof(D.size());
    for (std::size_t e = 0; e < B.size(); ++e)
    {
      const double d = D[B.column[e]];
      const bool is_elastic = has_springs && stiffness[B.row[e]] != 0.;
      scaled_B.value[e] = d > 0. && !is_elastic ? B.value[e] / d : 0.;
      if (scaled_B.value[e] != 0.)
        at_dof[B.column[e]].push_back(e);
    }
    MatrixEntries products;
    for (const auto &at : at_dof)
      for (std::size_t a = 0; a < at.size(); ++a)
        for (std::size_t b = 0; b <= a; ++b)
          products.add(B.row[at[a]], B.row[at[b]], scaled_B.value[at[a]] * B.value[at[b]]);
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

  /**
   * Keeps the rows of the blocks of Q that the bodies of this rank see, and its owned rows. Rows of
   * a block may be on ranks that do not know each other: the ranks first agree on the smallest
   * number of each block, and its owner then tells them all rows.
   */
  void InterfacePreconditioner::keep_blocks(const MatrixEntries &products)
  {
    const Communicator &processes = owners->communicator();
    const bool is_same = own_rows && pattern.row == products.row &&
                         pattern.column == products.column && owned == owners->owned();
    if (!processes.any(!is_same))
      return;
    const std::vector<std::size_t> &held = owners->held();
    const auto position = [&](const int number)
    {
      return std::lower_bound(held.begin(), held.end(), static_cast<std::size_t>(number)) -
             held.begin();
    };
    Groups groups(held.size());
    std::vector<char> is_seen(held.size(), 0);
    for (std::size_t e = 0; e < products.size(); ++e)
    {
      const auto row = position(products.row[e]), column = position(products.column[e]);
      groups.join(row, column);
      is_seen[row] = is_seen[column] = 1;
    }
    const std::vector<std::vector<std::size_t>> members = groups.members();
    std::vector<double> block(held.begin(), held.end());
    for (bool is_changed = true; is_changed;)
    {
      const std::vector<double> before = block;
      for (const std::vector<std::size_t> &rows : members)
      {
        double smallest = block[rows.front()];
        for (const std::size_t p : rows)
          smallest = std::min(smallest, block[p]);
        for (const std::size_t p : rows)
          block[p] = smallest;
      }
      owners->take_smallest(block);
      is_changed = processes.any(block != before);
    }

    MatrixEntries rows_of_blocks;
    std::vector<std::size_t> wanted = owners->owned();
    for (std::size_t p = 0; p < owners->owned().size(); ++p)
    {
      const std::size_t at = owners->position_of_owned(p);
      is_seen[at] = 1;
      rows_of_blocks.add(static_cast<std::size_t>(block[at]), held[at], 1.);
    }
    std::set<std::size_t> seen;
    for (std::size_t p = 0; p < held.size(); ++p)
      if (is_seen[p])
        seen.insert(static_cast<std::size_t>(block[p]));
    wanted.insert(wanted.end(), seen.begin(), seen.end());
    sort_unique(wanted);
    RowMap(*owners, wanted).sum_entries(rows_of_blocks, constraints.n_of_all());
    own_rows.reset(); // until all are new
    kept = owners->owned();
    for (std::size_t e = 0; e < rows_of_blocks.size(); ++e)
      if (seen.count(rows_of_blocks.row[e]) > 0)
        kept.push_back(rows_of_blocks.column[e]);
    sort_unique(kept);
    own_rows = std::make_unique<const RowMap>(*owners, kept);
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

  void InterfacePreconditioner::apply(const std::vector<double> &r, std::vector<double> &z) const
  {
    if (!is_diagonal && !own_rows)
    {
      owners->gather(r, all);
      apply_to_all(all, image);
      owners->pick(image, z);
      return;
    }
    z.resize(r.size());
    for (std::size_t p = 0; p < r.size(); ++p)
      z[p] = other[place[p]] * r[p];
    if (own_rows)
      apply_by_owners(r, z);
  }

  /// Without springs: adds the rigid rows to z, on owned rows.
  void InterfacePreconditioner::apply_by_owners(const std::vector<double> &r,
                                                std::vector<double> &z) const
  {
    jump.resize(kept.size());
    own_rows->copy_to_holders(r.data(), jump.data());
    Q.solve(jump);
    motion.assign(T.n_dofs(), 0.);
    for (std::size_t e = 0; e < scaled_B.size(); ++e)
      motion[scaled_B.column[e]] += scaled_B.value[e] * jump[scaled_B.row[e]];
    T.multiply(motion, force);
    std::fill(jump.begin(), jump.end(), 0.);
    for (std::size_t e = 0; e < scaled_B.size(); ++e)
      jump[scaled_B.row[e]] += scaled_B.value[e] * force[scaled_B.column[e]];
    image.resize(r.size());
    own_rows->add_shares(jump.data(), image.data());
    own_rows->copy_to_holders(image.data(), jump.data());
    Q.solve(jump);
    for (std::size_t p = 0; p < r.size(); ++p)
      if (is_rigid[place[p]])
        z[p] += jump[place[p]];
  }

  void InterfacePreconditioner::apply_to_all(const std::vector<double> &r,
                                             std::vector<double> &z) const
  {
    z.resize(r.size());
    for (std::size_t i = 0; i < r.size(); ++i)
      z[i] = stiffness[i] == 0. ? other[i] * r[i] : 0.;

    const MatrixEntries &B = T.constraints();
    // T u = B_c S_c^-1 r_c, the motion that the elastic rows leave.
    force.assign(T.n_dofs(), 0.);
    for (std::size_t e = 0; e < B.size(); ++e)
      force[B.column[e]] += B.value[e] * stiffness[B.row[e]] * r[B.row[e]];
    if (has_springs)
      inverse_T.solve(force);

    // Applies the rigid rows.
    jump = r;
    for (std::size_t e = 0; e < B.size(); ++e)
      jump[B.row[e]] -= B.value[e] * force[B.column[e]];
    Q.solve(jump);
    motion.assign(T.n_dofs(), 0.);
    for (std::size_t e = 0; e < B.size(); ++e)
      motion[B.column[e]] += scaled_B.value[e] * jump[B.row[e]];
    T.multiply(motion, force);
    jump.assign(r.size(), 0.);
    for (std::size_t e = 0; e < B.size(); ++e)
      jump[B.row[e]] += scaled_B.value[e] * force[B.column[e]];
    Q.solve(jump);
    for (std::size_t i = 0; i < r.size(); ++i)
      if (is_rigid[i])
        z[i] += jump[i];
    if (!has_springs)
      return;

    // And the elastic ones, with what the rigid ones move.
    force.assign(T.n_dofs(), 0.);
    for (std::size_t e = 0; e < B.size(); ++e)
    {
      const int i = B.row[e];
      force[B.column[e]] += B.value[e] * (stiffness[i] > 0. ? stiffness[i] * r[i] : z[i]);
    }
    inverse_T.solve(force);
    for (std::size_t i = 0; i < r.size(); ++i)
      z[i] += stiffness[i] * r[i];
    for (std::size_t e = 0; e < B.size(); ++e)
      z[B.row[e]] -= stiffness[B.row[e]] * B.value[e] * force[B.column[e]];
  }
} // namespace taut
