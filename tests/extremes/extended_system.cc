// SPDX-License-Identifier: LGPL-2.1-or-later
#include "extended_system.h"

#include "extended_complementarity.h"

namespace extremes
{
  namespace
  {
    const Number held_by("1e-45"), shared_by("1e-30"), no_share("1e-15");
  } // namespace

  ExtendedSystem::ExtendedSystem(const taut::Scene &scene, const ExtendedModel &model,
                                 const bool as_double)
      : scene(scene), model(model), as_double(as_double), motions_of_forces(scene.links.size())
  {
    for (std::size_t i = 0; i < model.n_dofs(); ++i)
      if (!model.held[i])
        free_dofs.push_back(i);
  }

  void ExtendedSystem::factor(const Matrix &full, const bool is_static)
  {
    A_full = full;
    const std::size_t n = free_dofs.size();
    Matrix A(n);
    spring.resize(n);
    Number largest[2] = {0, 0};
    for (std::size_t i = 0; i < n; ++i)
    {
      for (std::size_t j = 0; j < n; ++j)
        A(i, j) = full(free_dofs[i], free_dofs[j]);
      Number &m = largest[int(model.is_rotation[free_dofs[i]])];
      m = std::max(m, A(i, i));
    }
    Matrix heavy = A;
    for (std::size_t i = 0; i < n; ++i)
    {
      const Number typical = A(i, i) > 0 ? A(i, i)
                             : largest[int(model.is_rotation[free_dofs[i]])] > 0
                                 ? largest[int(model.is_rotation[free_dofs[i]])]
                                 : Number(1);
      heavy(i, i) += typical;
      if (is_static || A(i, i) == 0)
        spring[i] = held_by * typical;
      A(i, i) += spring[i];
    }
    Cholesky of_heavy;
    if (!factor_of_A.factor(A) || !of_heavy.factor(heavy))
      throw std::runtime_error("not held: the matrix is singular");
    flexibilities.resize(scene.links.size());
    for (std::size_t k = 0; k < scene.links.size(); ++k)
    {
      const Vector constraint = free_part(model.constraint(scene.links[k], Number(0)));
      flexibilities[k] = dot(constraint, of_heavy.solve(constraint));
      if (flexibilities[k] == 0)
        flexibilities[k] = n > 0 ? 1 / heavy(0, 0) : Number(1);
    }
  }

  void ExtendedSystem::solve(const Vector &full_rhs, const Number &t, const std::vector<Form> &B,
                             const Vector &past,
                             const std::vector<std::optional<ConservingLaw>> &laws, Vector &N,
                             Vector &D, Vector &result)
  {
    const std::size_t n = free_dofs.size(), m = B.size();
    Vector held_U(Number(0), model.n_dofs());
    for (std::size_t i = 0; i < held_U.size(); ++i)
      if (model.held[i])
        held_U[i] = model.given[i];
    const Vector all = full_rhs - A_full.times(held_U);
    Vector rhs(n);
    for (std::size_t i = 0; i < n; ++i)
      rhs[i] = all[free_dofs[i]];
    std::vector<Vector> constraints, columns;
    for (const Form &form : B)
    {
      constraints.push_back(free_part(form));
      columns.push_back(factor_of_A.solve(constraints.back()));
    }
    const auto own_gap = [&](const taut::Link &link)
    {
      const auto s = static_cast<double>(Number(link.to.position) + Number(link.speed) * t);
      return Number(link.gap) + (link.moving() ? Number(link.profile(s, 0.)) : Number(0));
    };
    const Vector U_free = factor_of_A.solve(rhs);
    Matrix F(m);
    Vector d(m);
    for (std::size_t k = 0; k < m; ++k)
    {
      const taut::Link &link = scene.links[k];
      for (std::size_t l = 0; l < m; ++l)
        F(k, l) = dot(constraints[k], columns[l]);
      motions_of_forces[k] = F(k, k);
      F(k, k) += shared_by * flexibilities[k];
      if (!link.rigid() && !laws[k])
        F(k, k) += 1 / Number(link.stiffness);
      d[k] = own_gap(link) + dot(B[k], held_U) + past[k] + dot(constraints[k], U_free);
    }
    if (as_double)
      for (std::size_t k = 0; k < m; ++k)
        F(k, k) *= 1 + last_place(k);
    std::vector<char> unilateral, closed;
    for (std::size_t k = 0; k < m; ++k)
    {
      unilateral.push_back(scene.links[k].unilateral());
      closed.push_back(!unilateral[k] || N[k] > 0);
    }
    N = solve_with_laws(F, d, unilateral, closed, laws);
    if (as_double)
      for (std::size_t k = 0; k < m; ++k)
        N[k] *= 1 + last_place(k + 1);

    result = held_U;
    Vector U = U_free;
    for (std::size_t k = 0; k < m; ++k)
      U += columns[k] * N[k];
    for (std::size_t i = 0; i < n; ++i)
      result[free_dofs[i]] = U[i];
    check_answer(rhs, B, N, result);
    for (std::size_t k = 0; k < m; ++k)
      D[k] = dot(B[k], result) + own_gap(scene.links[k]);
  }

  Vector ExtendedSystem::free_part(const Form &form) const
  {
    Vector full(Number(0), model.n_dofs()), result(free_dofs.size());
    for (const auto &[i, v] : form)
      full[i] += v;
    for (std::size_t i = 0; i < free_dofs.size(); ++i)
      result[i] = full[free_dofs[i]];
    return result;
  }

  void ExtendedSystem::check_answer(const Vector &rhs, const std::vector<Form> &B, const Vector &N,
                                    const Vector &U) const
  {
    Number load = 0, in_springs = 0;
    for (const Number &P : rhs)
      load = std::max(load, Number(abs(P)));
    Number force = load;
    for (std::size_t k = 0; k < N.size(); ++k)
      for (const auto &[i, v] : B[k])
        force = std::max(force, Number(abs(v * N[k])));
    for (std::size_t i = 0; i < spring.size(); ++i)
      in_springs = std::max(in_springs, Number(abs(spring[i] * U[free_dofs[i]])));
    if (in_springs > no_share * force)
      throw std::runtime_error("not held: nothing balances the loads");
    for (std::size_t k = 0; k < N.size(); ++k)
    {
      Number terms = std::max(Number(abs(Number(scene.links[k].gap))), flexibilities[k] * load);
      for (const auto &[i, v] : B[k])
        terms = std::max(terms, Number(abs(v * U[i])));
      if (abs(shared_by * flexibilities[k] * N[k]) > no_share * terms)
        throw std::runtime_error("contradictory: link " + scene.links[k].name);
    }
  }
} // namespace extremes
