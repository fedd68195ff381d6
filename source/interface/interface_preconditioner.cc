// SPDX-License-Identifier: LGPL-2.1-or-later
#include "interface_preconditioner.h"

#include <taut/base/exceptions.h>
#include <taut/base/gather_entries.h>

#include <algorithm>
#include <numeric>

namespace taut
{
  namespace
  {
    /// Part of F_ii below which the compliance of an elastic row counts as rigid.
    constexpr double smallest_compliance = 1e-9;

    /// Relative shift of T, which is singular for a floating group of bodies in statics. Springs
    /// within the group do not excite its rigid body modes.
    constexpr double null_space_shift = 1e-9;

    /// Relative shift of Q, which is singular for dependent rigid constraints.
    constexpr double dependence_shift = 1e-12;
  } // namespace

  InterfacePreconditioner::InterfacePreconditioner(const std::string &name,
                                                   const FactoredStructure &solvers,
                                                   const BodyConstraints &body_constraints)
      : solvers(solvers), body_constraints(body_constraints), is_diagonal(name == "diagonal"),
        is_dirichlet(name == "Dirichlet"), blocks(body_constraints.size())
  {
    if (!is_diagonal && !is_dirichlet && name != "lumped")
      throw UserError("unknown preconditioner '" + name +
                      "'; known are: diagonal, lumped, Dirichlet. Correct the name");
  }

  void InterfacePreconditioner::setup(const std::vector<char> &active,
                                      const std::vector<char> &is_changed,
                                      const std::vector<double> &compliance,
                                      const std::vector<double> &diagonal)
  {
    other.assign(active.size(), 0.);
    for (std::size_t i = 0; i < active.size(); ++i)
      other[i] = active[i] && diagonal[i] > 0. ? 1. / diagonal[i] : 0.;
    own = other;
    if (is_diagonal)
      return;
    solvers.structure().communicator().agree(
        [&]
        {
          for (std::size_t k = 0; k < body_constraints.size(); ++k)
            if (is_changed[k])
              compute_block(k, active);
        });
    gather_blocks(active);
    add_springs(active, diagonal, compliance);
    set_scaling();
  }

  /// Gathers T without springs, and B, over all ranks.
  void InterfacePreconditioner::gather_blocks(const std::vector<char> &active)
  {
    const Communicator &processes = solvers.structure().communicator();
    std::size_t n_own = 0;
    for (const Block &block : blocks)
      n_own += block.dofs.size();
    const std::vector<std::size_t> sizes = processes.gather(n_own);
    std::size_t first =
        std::accumulate(sizes.begin(), sizes.begin() + processes.rank(), std::size_t(0));
    n_dofs = std::accumulate(sizes.begin(), sizes.end(), std::size_t(0));

    T = {};
    B = {};
    substitute = {};
    for (std::size_t k = 0; k < blocks.size(); ++k)
    {
      Block &block = blocks[k];
      block.first = first;
      SymmetricEntries &to = block.interior ? substitute : T;
      for (std::size_t e = 0; e < block.entries.size(); ++e)
        to.add(first + block.entries.row[e], first + block.entries.column[e],
               block.entries.value[e]);
      for (const BodyConstraints::Entry &entry : body_constraints[k])
        for (std::size_t e = 0; active[entry.constraint] && e < entry.form.index.size(); ++e)
        {
          const auto at =
              std::lower_bound(block.dofs.begin(), block.dofs.end(), entry.form.index[e]);
          if (at != block.dofs.end() && *at == entry.form.index[e])
            B.add(entry.constraint, first + (at - block.dofs.begin()), entry.form.value[e]);
        }
      first += block.dofs.size();
    }
    gather(processes, T);
    gather(processes, substitute);
    gather(processes, B);
    B.compress();
    has_substitute = substitute.size() > 0;
  }

  /// Adds the elastic rows as springs between DoFs, and factors T with them.
  void InterfacePreconditioner::add_springs(const std::vector<char> &active,
                                            const std::vector<double> &diagonal,
                                            const std::vector<double> &compliance)
  {
    has_springs = false;
    stiffness.assign(active.size(), 0.);
    for (std::size_t i = 0; i < active.size(); ++i)
      if (active[i] && compliance[i] > smallest_compliance * diagonal[i])
      {
        stiffness[i] = 1. / compliance[i];
        has_springs = true;
      }
    for (std::size_t first = 0, end = 0; first < B.size(); first = end)
    {
      const int i = B.row[first];
      while (end < B.size() && B.row[end] == i)
        ++end;
      for (std::size_t e = first; stiffness[i] > 0. && e < end; ++e)
        for (std::size_t f = first; f <= e; ++f)
          T.add(B.column[e], B.column[f], stiffness[i] * B.value[e] * B.value[f]);
    }
    T.compress();
    if (!has_springs)
      return;
    SymmetricEntries shifted = T;
    for (std::size_t e = 0; e < substitute.size(); ++e)
      shifted.add(substitute.row[e], substitute.column[e], substitute.value[e]);
    shifted.compress();
    std::vector<char> has_diagonal(n_dofs, 0);
    for (std::size_t e = 0; e < shifted.size(); ++e)
      if (shifted.row[e] == shifted.column[e] && shifted.value[e] > 0.)
      {
        shifted.value[e] *= 1. + null_space_shift;
        has_diagonal[shifted.row[e]] = 1;
      }
    for (std::size_t p = 0; p < n_dofs; ++p)
      if (!has_diagonal[p])
        shifted.add(p, p, 1.);
    inverse_T.factor(n_dofs, shifted, 0.);
  }

  /// Computes D^-1 B_r, and Q from rows with a common DoF.
  void InterfacePreconditioner::set_scaling()
  {
    std::vector<double> D(n_dofs, 0.);
    for (const SymmetricEntries *matrix : {&T, &substitute})
      for (std::size_t e = 0; e < matrix->size(); ++e)
        if (matrix->row[e] == matrix->column[e])
          D[matrix->row[e]] += matrix->value[e];
    scaled_B = B;
    std::vector<std::vector<std::size_t>> at_dof(n_dofs);
    for (std::size_t e = 0; e < B.size(); ++e)
    {
      const double d = D[B.column[e]];
      scaled_B.value[e] = d > 0. && stiffness[B.row[e]] == 0. ? B.value[e] / d : 0.;
      if (scaled_B.value[e] != 0.)
        at_dof[B.column[e]].push_back(e);
    }
    SymmetricEntries entries;
    std::vector<double> diagonal(other.size(), 0.);
    is_rigid.assign(other.size(), 0);
    for (const auto &rows : at_dof)
      for (std::size_t a = 0; a < rows.size(); ++a)
      {
        for (std::size_t b = 0; b < a; ++b)
          entries.add(B.row[rows[a]], B.row[rows[b]], scaled_B.value[rows[a]] * B.value[rows[b]]);
        diagonal[B.row[rows[a]]] += scaled_B.value[rows[a]] * B.value[rows[a]];
      }
    for (std::size_t i = 0; i < diagonal.size(); ++i)
    {
      entries.add(i, i, diagonal[i] > 0. ? diagonal[i] * (1. + dependence_shift) : 1.);
      is_rigid[i] = diagonal[i] > 0.;
      if (is_rigid[i])
        other[i] = 0.;
      own[i] = stiffness[i] == 0. ? other[i] : 0.;
    }
    entries.compress();
    Q.factor(diagonal.size(), entries, 0.);
  }

  void InterfacePreconditioner::scale(std::vector<double> &r) const
  {
    if (is_diagonal)
    {
      for (std::size_t i = 0; i < r.size(); ++i)
        r[i] *= other[i];
      return;
    }
    scaled = r;
    Q.solve(scaled);
    for (std::size_t i = 0; i < r.size(); ++i)
      r[i] = is_rigid[i] ? scaled[i] : other[i] * r[i];
  }

  /// f = (T + sum of the applied Schur complements) u.
  void InterfacePreconditioner::multiply(const std::vector<double> &u, std::vector<double> &f) const
  {
    f.assign(n_dofs, 0.);
    if (has_substitute)
    {
      for (std::size_t k = 0; k < blocks.size(); ++k)
      {
        const Block &block = blocks[k];
        if (!block.interior)
          continue;
        const std::size_t n = block.dofs.size();
        whole.assign(solvers.structure()[k].n_dofs(), 0.);
        for (std::size_t p = 0; p < n; ++p)
          whole[block.dofs[p]] = u[block.first + p];
        solvers.multiply(k, whole, image);
        for (std::size_t p = 0; p < n; ++p)
          f[block.first + p] = image[block.dofs[p]];
        block.interior->solve(image);
        solvers.multiply(k, image, whole);
        for (std::size_t p = 0; p < n; ++p)
          f[block.first + p] -= whole[block.dofs[p]];
      }
      solvers.structure().communicator().sum(f);
    }
    T.vmult_add(u, f);
  }

  void InterfacePreconditioner::apply(const std::vector<double> &r, std::vector<double> &z) const
  {
    z.resize(r.size());
    for (std::size_t i = 0; i < r.size(); ++i)
      z[i] = own[i] * r[i];
    if (is_diagonal)
      return;

    // Solves T u = B_c S_c^-1 r_c for the motion with the elastic rows.
    force.assign(n_dofs, 0.);
    for (std::size_t e = 0; e < B.size(); ++e)
      force[B.column[e]] += B.value[e] * stiffness[B.row[e]] * r[B.row[e]];
    if (has_springs)
      inverse_T.solve(force);

    // Applies the rigid rows.
    jump = r;
    for (std::size_t e = 0; e < B.size(); ++e)
      jump[B.row[e]] -= B.value[e] * force[B.column[e]];
    Q.solve(jump);
    motion.assign(n_dofs, 0.);
    for (std::size_t e = 0; e < B.size(); ++e)
      motion[B.column[e]] += scaled_B.value[e] * jump[B.row[e]];
    multiply(motion, force);
    jump.assign(r.size(), 0.);
    for (std::size_t e = 0; e < B.size(); ++e)
      jump[B.row[e]] += scaled_B.value[e] * force[B.column[e]];
    Q.solve(jump);
    for (std::size_t i = 0; i < r.size(); ++i)
      if (is_rigid[i])
        z[i] += jump[i];
    if (!has_springs)
      return;

    // Applies the elastic rows with the motion of the rigid rows.
    force.assign(n_dofs, 0.);
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
