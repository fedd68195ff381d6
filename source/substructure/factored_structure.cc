// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/dot.h"
#include <taut/base/exceptions.h>
#include <taut/substructure/factored_structure.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>

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

    /// Smallest singular value of independent vectors, for columns of length 1: the stiffness that
    /// holds a motion goes with the square, which is 1e-16 here.
    constexpr double independent = 1e-8;

    /// True if no combination of the vectors is zero, to working precision, on all of the DoFs. The
    /// singular values are those of R in QR, of which the vectors are few; an SVD of all rows has a
    /// matrix of the length of the DoFs squared.
    bool are_held(const std::vector<std::vector<double>> &vectors,
                  const std::vector<unsigned int> &dofs)
    {
      const std::size_t n = vectors.size();
      if (n > dofs.size())
        return false;
      if (n == 0)
        return true;
      std::vector<std::vector<double>> Q(n, std::vector<double>(dofs.size()));
      dealii::LAPACKFullMatrix<double> R(n, n);
      const auto normalise = [](std::vector<double> &v)
      {
        const double size = std::sqrt(dot_in_lanes(v, v));
        for (double &x : v)
          x = size > 0. ? x / size : 0.;
        return size;
      };
      for (std::size_t j = 0; j < n; ++j)
      {
        for (std::size_t i = 0; i < dofs.size(); ++i)
          Q[j][i] = vectors[j][dofs[i]];
        normalise(Q[j]);
        // Two passes of Gram-Schmidt, as one leaves the rounding of the removed part.
        for (int pass = 0; pass < 2; ++pass)
          for (std::size_t i = 0; i < j; ++i)
          {
            const double part = dot_in_lanes(Q[i], Q[j]);
            R(i, j) += part;
            for (std::size_t d = 0; d < dofs.size(); ++d)
              Q[j][d] -= part * Q[i][d];
          }
        R(j, j) = normalise(Q[j]);
      }
      R.compute_svd();
      return R.singular_value(n - 1) > independent;
    }

    /// Rows of the inverse of the matrix of values of the vectors on the DoFs; one row per vector.
    std::vector<std::vector<double>> inverse_on(const std::vector<unsigned int> &dofs,
                                                const std::vector<std::vector<double>> &vectors)
    {
      const std::size_t n = vectors.size();
      dealii::FullMatrix<double> matrix(n, n);
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
          matrix(i, j) = vectors[i][dofs[j]];
      matrix.gauss_jordan();
      std::vector<std::vector<double>> rows(n, std::vector<double>(n));
      for (std::size_t i = 0; i < n; ++i)
        std::copy(matrix.begin(i), matrix.end(i), rows[i].begin());
      return rows;
    }

    void add(std::vector<double> &y, const double factor, const std::vector<double> &x)
    {
      for (std::size_t i = 0; i < y.size(); ++i)
        y[i] += factor * x[i];
    }

    /// Largest part of a motion that rounding may lose: refinement gains six digits from each
    /// repetition then, and two of them give twelve.
    constexpr double largest_loss = 1e-6;

    /// Largest part for a nonlinear body: the next iteration of Newton's method corrects the loss,
    /// so that each still gains two digits.
    constexpr double largest_loss_of_iteration = 1e-2;

    /// Largest part for a body whose rigid body modes can be unknowns: these lose nothing, so they
    /// are taken from half of the sixteen digits on.
    constexpr double largest_loss_beside_amplitudes = 1e-8;

    /// Smallest E over R^T J R for which rigid body modes are separate from elastic motions: E is a
    /// difference, which has lost one bit there.
    constexpr double least_part_of_inertia = .5;
  } // namespace

  FactoredStructure::FactoredStructure(const Structure &structure, const std::string &solver_name)
      : bodies(structure), solver_name(solver_name), tangents(structure.size()),
        motions(structure.size())
  {
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      solvers.push_back(solver_of(structure[k]));
      constrained.push_back(structure[k].constrained_dofs());
    }
  }

  std::unique_ptr<LocalSolver> FactoredStructure::solver_of(const Substructure &body) const
  {
    std::unique_ptr<LocalSolver> own = body.make_solver();
    return own ? std::move(own) : make_local_solver(solver_name, body.stiffness());
  }

  void FactoredStructure::set_tangent(const std::size_t k, std::unique_ptr<SymmetricMatrix> tangent)
  {
    if (tangents[k].swap(tangent); tangent)
      bodies[k].take_back(std::move(tangent));
  }

  /// Sets the summands of A_k.
  void FactoredStructure::copy_summands(const std::size_t k, std::vector<ScaledMatrix> &A) const
  {
    A.clear();
    if (kind == Kind::step)
      A = {{mass_factor, &bodies[k].mass()}, {damping_factor, &bodies[k].damping()}};
    A.emplace_back(1., kind == Kind::mass && !tangents[k] ? &bodies[k].mass() : &stiffness(k));
  }

  std::vector<ScaledMatrix> FactoredStructure::summands(const std::size_t k) const
  {
    std::vector<ScaledMatrix> A;
    copy_summands(k, A);
    return A;
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

  /// Measures the error of A^-1 A x = x for a rigid translation x. Inner springs have no force
  /// then, but round by their size, and the resistance to the motion must exceed this rounding.
  double FactoredStructure::lost_digits(const std::size_t k, const LocalSolver &solver,
                                        const std::vector<ScaledMatrix> &summands) const
  {
    const Substructure &body = bodies[k];
    translation.resize(body.n_dofs());
    image.assign(body.n_dofs(), 0.);
    for (std::size_t i = 0; i < translation.size(); ++i)
      translation[i] = body.kind(i) == 0;
    for (const unsigned int dof : constrained[k])
      translation[dof] = 0.;
    for (const auto &[factor, matrix] : summands)
      matrix->vmult_add(factor, translation.data(), image.data());
    solver.solve(image);
    double loss = 0.;
    for (std::size_t i = 0; i < translation.size(); ++i)
      if (body.kind(i) == 0 && !(std::fabs(image[i] - translation[i]) <= loss))
        loss = std::fabs(image[i] - translation[i]);
    return loss;
  }

  void FactoredStructure::check_digits(const std::size_t k, const double loss) const
  {
    const Substructure &body = bodies[k];
    if (loss <= (body.is_linear() ? largest_loss : largest_loss_of_iteration))
      return;
    std::ostringstream out;
    const std::string uneven = body.uneven_elements();
    if (!uneven.empty())
      out << "body '" << body.name() << "': " << uneven << " (the stiffness of so short an element "
          << "rounds by more than what holds the body: a motion changes by " << loss
          << " of itself)";
    else
      out << "body '" << body.name()
          << "': what resists its motion, supports and inertia in one step, "
          << "is lost in the rounding of its stiffness, which changes a motion by " << loss
          << " of itself. Take a smaller step, fewer substructures, more equal elements or "
             "springs, "
          << "or hold it by a support";
    throw EntryError(body.origin(), out.str());
  }

  void FactoredStructure::factor(const double mass, const double damping,
                                 const bool may_use_amplitudes)
  {
    use_amplitudes = may_use_amplitudes;
    mass_factor = mass;
    damping_factor = damping;
    kind = Kind::step;
    for (std::size_t k = 0; k < solvers.size(); ++k)
      factor_body(k, use_amplitudes);
  }

  void FactoredStructure::factor_body(const std::size_t k, const bool use_amplitudes)
  {
    copy_summands(k, its_summands);
    double loss = 0.;
    motions[k] = {};
    try
    {
      factor(k, *solvers[k], its_summands, constrained[k]);
      loss = lost_digits(k, *solvers[k], its_summands);
    }
    catch (const BodyNotHeld &)
    {
      if (!free_motions_apart(k, use_amplitudes))
        throw;
      return;
    }
    if (loss > (use_amplitudes ? largest_loss_beside_amplitudes : largest_loss) &&
        free_motions_apart(k, use_amplitudes))
      return;
    check_digits(k, loss);
  }

  /// Returns false if the rigid body modes cannot be unknowns. Returns false, too, if the next
  /// iteration of Newton's method corrects their rounding. If only the representation of F forbids
  /// them, throws an error that names the remedy.
  bool FactoredStructure::free_motions_apart(const std::size_t k, const bool use_amplitudes)
  {
    const Substructure &body = bodies[k];
    if (!body.is_linear() || body.null_space().vectors.empty() || !set_rigid_body_modes(k))
      return false;
    if (!use_amplitudes)
      throw EntryError(body.origin(),
                       "body '" + body.name() +
                           "': what resists its motion, inertia in one step, is lost in the "
                           "rounding of its stiffness. Only the assembled forms solve for its free "
                           "motions apart from that: set Solver/Interface operator = assembled "
                           "sparse (or assembled dense), or take a smaller step");
    return true;
  }

  /// Returns false if elastic motions resist the inertia less than rigid body modes, so that E
  /// would cancel.
  bool FactoredStructure::set_rigid_body_modes(const std::size_t k)
  {
    const Substructure &body = bodies[k];
    const Substructure::NullSpace null_space = body.null_space();
    const auto held = with_springs(stiffness(k), null_space.fixing_dofs);
    std::vector<ScaledMatrix> A = summands(k);
    A.back().second = held.get();
    auto solver = solver_of(body);
    factor(k, *solver, A, constrained[k]);

    RigidBodyModes own;
    own.fixing_dofs = null_space.fixing_dofs;
    for (std::vector<double> R : null_space.vectors)
    {
      const auto inertia = [&](const std::vector<double> &x)
      {
        std::vector<double> J(x.size(), 0.);
        body.mass().vmult_add(mass_factor, x.data(), J.data());
        body.damping().vmult_add(damping_factor, x.data(), J.data());
        return J;
      };
      // Gram-Schmidt with E as scalar product.
      for (int pass = 0; pass < 2; ++pass)
        for (std::size_t l = 0; l < own.vectors.size(); ++l)
          add(R, -dot(inertia(R), own.vectors[l]) / own.resistance[l], own.rigid[l]);
      const std::vector<double> J = inertia(R);
      std::vector<double> response = J;
      solver->solve(response);
      std::vector<double> modified = R;
      add(modified, -1., response);
      const double inertia_of_R = dot(J, R), resistance = dot(J, modified);
      if (!(inertia_of_R > 0.))
        throw BodyNotHeld("body '" + body.name() +
                              "': nothing holds one of its motions, neither inertia nor stiffness. "
                              "Give it mass, stiffness or a support there.",
                          {}, body.origin());
      if (!(resistance >= least_part_of_inertia * inertia_of_R))
        return false;
      own.resistance.push_back(resistance);
      own.vectors.push_back(std::move(modified));
      own.rigid.push_back(std::move(R));
    }
    check_digits(k, lost_digits(k, *solver, A));
    own.fixing_forces = inverse_on(own.fixing_dofs, own.rigid);
    solvers[k] = std::move(solver);
    motions[k] = std::move(own);
    return true;
  }

  bool FactoredStructure::has_rigid_body_modes() const
  {
    return bodies.communicator().any(std::any_of(motions.begin(), motions.end(),
                                                 [](const RigidBodyModes &own)
                                                 { return !own.vectors.empty(); }));
  }

  void FactoredStructure::remove_rounding(const std::size_t k, std::vector<double> &KU,
                                          std::vector<double> &balance) const
  {
    const RigidBodyModes &own = motions[k];
    const std::size_t n = own.rigid.size();
    if (n == 0)
      return;
    // Forces f on the fixing DoFs with R^T f = R^T K U.
    std::vector<double> load(n);
    for (std::size_t i = 0; i < n; ++i)
      load[i] = dot(own.rigid[i], KU);
    for (std::size_t j = 0; j < n; ++j)
    {
      const double f = dot(own.fixing_forces[j], load);
      KU[own.fixing_dofs[j]] -= f;
      balance[own.fixing_dofs[j]] += f;
    }
  }

  void FactoredStructure::factor_stiffness()
  {
    kind = Kind::stiffness;
    motions.assign(solvers.size(), {});
    for (std::size_t k = 0; k < solvers.size(); ++k)
    {
      Substructure::NullSpace null_space = bodies[k].null_space();
      const auto held = with_springs(stiffness(k), null_space.fixing_dofs);
      motions[k].resistance.assign(null_space.vectors.size(), 0.);
      motions[k].vectors = std::move(null_space.vectors);
      motions[k].fixing_dofs = std::move(null_space.fixing_dofs);
      factor(k, *solvers[k], {{1., held.get()}}, constrained[k]);
      check_digits(k, lost_digits(k, *solvers[k], {{1., held.get()}}));
    }
  }

  /// A matrix that was set takes the place of M_k, with all DoFs.
  void FactoredStructure::factor_mass()
  {
    kind = Kind::mass;
    motions.assign(solvers.size(), {});
    for (std::size_t k = 0; k < solvers.size(); ++k)
    {
      std::vector<unsigned int> held = constrained[k];
      if (!tangents[k])
      {
        const std::vector<unsigned int> without_mass = bodies[k].dofs_without_mass();
        held.insert(held.end(), without_mass.begin(), without_mass.end());
      }
      std::sort(held.begin(), held.end());
      held.erase(std::unique(held.begin(), held.end()), held.end());
      factor(k, *solvers[k], summands(k), held);
    }
  }

  void FactoredStructure::visit(const std::size_t k, const SymmetricMatrix::Visitor &visitor) const
  {
    for (const auto &[factor, matrix] : summands(k))
      matrix->visit([&, factor = factor](unsigned int i, unsigned int j, double value)
                    { visitor(i, j, factor * value); });
  }

  void FactoredStructure::multiply(const std::size_t k, const std::vector<double> &x,
                                   std::vector<double> &y) const
  {
    y.assign(x.size(), 0.);
    for (const auto &[factor, matrix] : summands(k))
      matrix->vmult_add(factor, x.data(), y.data());
  }

  std::unique_ptr<LocalSolver>
  FactoredStructure::solver_with_held(const std::size_t k,
                                      const std::vector<unsigned int> &held) const
  {
    std::vector<unsigned int> all = constrained[k];
    all.insert(all.end(), held.begin(), held.end());
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    std::vector<ScaledMatrix> A = summands(k);
    std::unique_ptr<SymmetricMatrix> sprung;
    if (kind == Kind::stiffness || !motions[k].vectors.empty())
      if (const auto null_space = bodies[k].null_space(); !are_held(null_space.vectors, held))
      {
        sprung = with_springs(stiffness(k), null_space.fixing_dofs);
        A.back().second = sprung.get();
      }
    auto solver = solver_of(bodies[k]);
    factor(k, *solver, A, all);
    return solver;
  }

  void FactoredStructure::solve(BodyVectors &X) const
  {
    for (std::size_t k = 0; k < solvers.size(); ++k)
      solvers[k]->solve(X[k]);
  }
} // namespace taut
