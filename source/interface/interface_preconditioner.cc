// SPDX-License-Identifier: LGPL-2.1-or-later
#include "interface/interface_preconditioner.h"
#include "base/gather_entries.h"
#include "base/groups.h"
#include "base/pivots.h"

#include <taut/base/exceptions.h>

#include <boost/pending/disjoint_sets.hpp>

#include <algorithm>
#include <numeric>
#include <utility>

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

  InterfacePreconditioner::InterfacePreconditioner(const std::string &name,
                                                   const FactoredStructure &solvers,
                                                   const BodyConstraints &body_constraints)
      : is_diagonal(name == "diagonal"), constraints(body_constraints.all()),
        T(solvers, body_constraints)
  {
    if (!is_diagonal && name != "Dirichlet")
      throw UserError("unknown preconditioner '" + name +
                      "'; known are: diagonal, Dirichlet. Correct the name");
  }

  void InterfacePreconditioner::setup(const RowMap &rows, const std::vector<char> &active,
                                      const std::vector<char> &is_changed,
                                      const std::vector<double> &own_compliance,
                                      const std::vector<double> &own_diagonal)
  {
    owners = &rows;
    std::vector<double> is_active, compliance, diagonal;
    constraints.gather({active.begin(), active.end()}, is_active);
    constraints.gather(own_compliance, compliance);
    constraints.gather(own_diagonal, diagonal);
    other.assign(is_active.size(), 0.);
    for (std::size_t i = 0; i < other.size(); ++i)
      other[i] = is_active[i] > 0. && diagonal[i] > 0. ? 1. / diagonal[i] : 0.;
    own = other;
    own_rows.reset();
    if (is_diagonal)
    {
      kept = rows.owned();
      Q_entries = {};
      return;
    }
    set_stiffness(is_active, diagonal, compliance);
    T.setup(active, is_changed, has_springs);
    if (has_springs)
      add_springs();
    set_scaling(rows);
  }

  /// Which rows are elastic.
  void InterfacePreconditioner::set_stiffness(const std::vector<double> &active,
                                              const std::vector<double> &diagonal,
                                              const std::vector<double> &compliance)
  {
    has_springs = false;
    stiffness.assign(active.size(), 0.);
    for (std::size_t i = 0; i < active.size(); ++i)
      if (active[i] > 0. && compliance[i] > smallest_compliance * diagonal[i])
      {
        stiffness[i] = 1. / compliance[i];
        has_springs = true;
      }
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
    inverse_T.factor(T.n_dofs(), shifted, 0.);
  }

  /// Computes D^-1 B_r, and Q from rows with a common DoF.
  void InterfacePreconditioner::set_scaling(const RowMap &rows)
  {
    const bool is_shared = rows.communicator().size() > 1 && !has_springs;
    const MatrixEntries &B = T.constraints();
    const std::vector<double> D = T.diagonal();
    scaled_B = B;
    std::vector<std::vector<std::size_t>> at_dof(D.size());
    for (std::size_t e = 0; e < B.size(); ++e)
    {
      const double d = D[B.column[e]];
      scaled_B.value[e] = d > 0. && stiffness[B.row[e]] == 0. ? B.value[e] / d : 0.;
      if (scaled_B.value[e] != 0.)
        at_dof[B.column[e]].push_back(e);
    }
    SymmetricEntries products;
    for (const auto &at : at_dof)
      for (std::size_t a = 0; a < at.size(); ++a)
        for (std::size_t b = 0; b <= a; ++b)
          products.add(B.row[at[a]], B.row[at[b]], scaled_B.value[at[a]] * B.value[at[b]]);
    if (is_shared)
      gather(rows.communicator(), products);
    Q_entries = {};
    std::vector<double> diagonal(other.size(), 0.);
    is_rigid.assign(other.size(), 0);
    for (std::size_t e = 0; e < products.size(); ++e)
      if (products.row[e] == products.column[e])
        diagonal[products.row[e]] += products.value[e];
      else
        Q_entries.add(products.row[e], products.column[e], products.value[e]);
    for (std::size_t i = 0; i < diagonal.size(); ++i)
    {
      // Q is singular for dependent rigid constraints.
      Q_entries.add(i, i, diagonal[i] > 0. ? diagonal[i] * (1. + dependence_shift) : 1.);
      is_rigid[i] = diagonal[i] > 0.;
      if (is_rigid[i])
        other[i] = 0.;
      own[i] = stiffness[i] == 0. ? other[i] : 0.;
    }
    if (is_shared)
      keep_own_blocks(rows);
    else
    {
      kept.resize(diagonal.size());
      std::iota(kept.begin(), kept.end(), std::size_t(0));
    }
    Q_entries.compress();
    rows.communicator().agree([&] { Q.factor(kept.size(), Q_entries, 0.); });
  }

  RowBlocks InterfacePreconditioner::blocks() const
  {
    Groups groups(kept.size());
    for (std::size_t e = 0; e < Q_entries.size(); ++e)
      groups.join(Q_entries.row[e], Q_entries.column[e]);
    return {kept, groups.numbers()};
  }

  /// Keeps the blocks of Q that the bodies of this rank see, in @p entries and D^-1 B_r.
  void InterfacePreconditioner::keep_own_blocks(const RowMap &rows)
  {
    boost::disjoint_sets_with_storage<> blocks(is_rigid.size());
    for (std::size_t e = 0; e < Q_entries.size(); ++e)
      blocks.union_set(static_cast<std::size_t>(Q_entries.row[e]),
                       static_cast<std::size_t>(Q_entries.column[e]));
    std::vector<char> is_seen(is_rigid.size(), 0);
    for (const std::size_t i : rows.owned())
      is_seen[blocks.find_set(i)] = 1;
    for (std::size_t e = 0; e < scaled_B.size(); ++e)
      if (scaled_B.value[e] != 0.)
        is_seen[blocks.find_set(static_cast<std::size_t>(scaled_B.row[e]))] = 1;
    kept.clear();
    std::vector<std::size_t> position(is_rigid.size(), 0);
    for (std::size_t i = 0; i < is_rigid.size(); ++i)
      if (is_seen[blocks.find_set(i)])
      {
        position[i] = kept.size();
        kept.push_back(i);
      }
    MatrixEntries of_B;
    for (std::size_t e = 0; e < scaled_B.size(); ++e)
      if (scaled_B.value[e] != 0.)
        of_B.add(position[scaled_B.row[e]], scaled_B.column[e], scaled_B.value[e]);
    scaled_B = std::move(of_B);
    SymmetricEntries of_kept;
    for (std::size_t e = 0; e < Q_entries.size(); ++e)
      if (is_seen[blocks.find_set(static_cast<std::size_t>(Q_entries.row[e]))])
        of_kept.add(position[Q_entries.row[e]], position[Q_entries.column[e]], Q_entries.value[e]);
    Q_entries = std::move(of_kept);
    place.clear();
    for (const std::size_t i : rows.owned())
      place.push_back(position[i]);
    own_rows = std::make_unique<const RowMap>(rows, kept);
  }

  void InterfacePreconditioner::scale(std::vector<double> &r) const
  {
    if (is_diagonal)
    {
      for (std::size_t p = 0; p < r.size(); ++p)
        r[p] *= other[kept[p]];
      return;
    }
    jump = r;
    Q.solve(jump);
    for (std::size_t p = 0; p < r.size(); ++p)
      r[p] = is_rigid[kept[p]] ? jump[p] : other[kept[p]] * r[p];
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
      z[p] = own[owners->owned()[p]] * r[p];
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
      if (is_rigid[owners->owned()[p]])
        z[p] += jump[place[p]];
  }

  void InterfacePreconditioner::apply_to_all(const std::vector<double> &r,
                                             std::vector<double> &z) const
  {
    z.resize(r.size());
    for (std::size_t i = 0; i < r.size(); ++i)
      z[i] = own[i] * r[i];

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
