// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/substructure/factored_structure.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace taut
{
  namespace
  {
    /// K with a spring as stiff as the diagonal on each of the DoFs.
    std::unique_ptr<SymmetricMatrix> with_springs(const SymmetricMatrix &stiffness,
                                                  const std::vector<unsigned int> &dofs)
    {
      auto held = stiffness.clone();
      std::vector<double> diagonal(stiffness.size(), 0.);
      double largest = 0.;
      held->visit(
          [&](unsigned int i, unsigned int j, double value)
          {
            if (i == j)
              largest = std::max(largest, diagonal[i] = value);
          });
      for (const unsigned int dof : dofs)
        held->add(dof, dof, diagonal[dof] > 0. ? diagonal[dof] : largest > 0. ? largest : 1.);
      return held;
    }

    /// True if no combination of the vectors is zero, to working precision, on all of the DoFs.
    bool are_held(std::vector<std::vector<double>> vectors, const std::vector<unsigned int> &dofs)
    {
      const auto norm = [&](const std::vector<double> &v)
      {
        double sum = 0.;
        for (const unsigned int dof : dofs)
          sum += v[dof] * v[dof];
        return std::sqrt(sum);
      };
      for (std::size_t i = 0; i < vectors.size(); ++i)
      {
        const double before = norm(vectors[i]);
        for (std::size_t j = 0; j < i; ++j)
        {
          double product = 0.;
          for (const unsigned int dof : dofs)
            product += vectors[i][dof] * vectors[j][dof];
          for (const unsigned int dof : dofs)
            vectors[i][dof] -= product * vectors[j][dof];
        }
        const double after = norm(vectors[i]);
        if (!(after > 1e-8 * before))
          return false;
        for (const unsigned int dof : dofs)
          vectors[i][dof] /= after;
      }
      return true;
    }

    /// Part of a motion that rounding may lose.
    constexpr double largest_loss = 1e-6;
  } // namespace

  FactoredStructure::FactoredStructure(const Structure &structure, const std::string &solver_name)
      : bodies(structure), solver_name(solver_name)
  {
    for (std::size_t k = 0; k < structure.size(); ++k)
      solvers.push_back(make_local_solver(solver_name, structure[k].stiffness()));
  }

  std::vector<ScaledMatrix> FactoredStructure::summands(const std::size_t k) const
  {
    if (is_static)
      return {{1., &bodies[k].stiffness()}};
    return {{mass_factor, &bodies[k].mass()},
            {damping_factor, &bodies[k].damping()},
            {1., &bodies[k].stiffness()}};
  }

  void FactoredStructure::factor(const std::size_t k, LocalSolver &solver,
                                 const std::vector<ScaledMatrix> &summands,
                                 const std::vector<unsigned int> &held) const
  {
    try
    {
      solver.factor(summands, held);
    }
    catch (const BodyNotHeld &e)
    {
      throw BodyNotHeld("body '" + bodies[k].name() + "': " + e.what() +
                            ". Give it mass, stiffness or a support there.",
                        {}, bodies[k].origin());
    }
  }

  /// A^-1 A x = x for a rigid translation x: springs inside the body cost nothing then, but round
  /// by their size, and what resists the motion has to stand out against that.
  void FactoredStructure::check_digits(const std::size_t k,
                                       const std::vector<ScaledMatrix> &summands) const
  {
    const Substructure &body = bodies[k];
    std::vector<double> rigid(body.n_dofs()), x(body.n_dofs(), 0.);
    for (std::size_t i = 0; i < rigid.size(); ++i)
      rigid[i] = body.kind(i) == 0;
    for (const ConstrainedDof &constraint : body.constraints())
      rigid[constraint.dof] = 0.;
    for (const auto &[factor, matrix] : summands)
      matrix->vmult_add(factor, rigid.data(), x.data());
    solvers[k]->solve(x);
    double loss = 0.;
    for (std::size_t i = 0; i < rigid.size(); ++i)
      if (body.kind(i) == 0 && !(std::fabs(x[i] - rigid[i]) <= loss))
        loss = std::fabs(x[i] - rigid[i]);
    if (loss <= largest_loss)
      return;
    std::ostringstream out;
    out << "body '" << body.name()
        << "': what resists its motion, supports and inertia in one step, "
        << "is lost in the rounding of its stiffness, which changes a motion by " << loss
        << " of itself. Take a smaller step, fewer substructures, more equal elements or springs, "
        << "or hold it by a support";
    throw EntryError(body.origin(), out.str());
  }

  void FactoredStructure::factor(const double mass, const double damping)
  {
    mass_factor = mass;
    damping_factor = damping;
    is_static = false;
    for (std::size_t k = 0; k < solvers.size(); ++k)
    {
      factor(k, *solvers[k], summands(k), bodies[k].constrained_dofs());
      check_digits(k, summands(k));
    }
  }

  void FactoredStructure::factor_stiffness(const std::vector<Substructure::Kernel> &kernels)
  {
    is_static = true;
    for (std::size_t k = 0; k < solvers.size(); ++k)
    {
      const auto held = with_springs(bodies[k].stiffness(), kernels[k].fixing_dofs);
      factor(k, *solvers[k], {{1., held.get()}}, bodies[k].constrained_dofs());
      check_digits(k, {{1., held.get()}});
    }
  }

  void FactoredStructure::visit(const std::size_t k, const SymmetricMatrix::Visitor &visitor) const
  {
    for (const auto &[factor, matrix] : summands(k))
      matrix->visit([&, factor = factor](unsigned int i, unsigned int j, double value)
                    { visitor(i, j, factor * value); });
  }

  std::unique_ptr<LocalSolver>
  FactoredStructure::solver_with_held(const std::size_t k,
                                      const std::vector<unsigned int> &held) const
  {
    std::vector<unsigned int> all = bodies[k].constrained_dofs();
    all.insert(all.end(), held.begin(), held.end());
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    auto solver = make_local_solver(solver_name, bodies[k].stiffness());
    if (is_static)
    {
      const Substructure::Kernel kernel = bodies[k].kernel();
      if (!are_held(kernel.vectors, held))
      {
        const auto sprung = with_springs(bodies[k].stiffness(), kernel.fixing_dofs);
        factor(k, *solver, {{1., sprung.get()}}, all);
        return solver;
      }
    }
    factor(k, *solver, summands(k), all);
    return solver;
  }

  void FactoredStructure::solve(BlockVector &X) const
  {
    for (std::size_t k = 0; k < solvers.size(); ++k)
      solvers[k]->solve(X[k]);
  }
} // namespace taut
