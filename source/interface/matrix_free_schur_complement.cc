// SPDX-License-Identifier: LGPL-2.1-or-later
#include "interface/matrix_free_schur_complement.h"
#include <taut/base/exceptions.h>
#include <taut/interface/constraint_operator.h>

#include <BelosEpetraAdapter.hpp>
#include <BelosPseudoBlockCGSolMgr.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace taut
{
  /**
   * Solves A x = b from x = 0 with preconditioned conjugate gradients of Belos. They end if the
   * recursive residual is below @p tolerance times the norm of b, or after @p bound iterations.
   * They end early with the present x at a direction along which A is not positive. Returns the
   * number of iterations. Vectors are those of the rows that a rank owns.
   */
  int conjugate_gradients(const ConstraintOperator &A, ConstraintOperator &preconditioner,
                          const std::vector<double> &b, double tolerance, int bound,
                          std::vector<double> &x);

  int conjugate_gradients(const ConstraintOperator &A, ConstraintOperator &preconditioner,
                          const std::vector<double> &b, const double tolerance, const int bound,
                          std::vector<double> &x)
  {
    const Epetra_Map &map = A.OperatorDomainMap();
    Epetra_MultiVector solution(map, 1), rhs(map, 1);
    std::copy(b.begin(), b.end(), rhs[0]);

    using Problem = Belos::LinearProblem<double, Epetra_MultiVector, Epetra_Operator>;
    Problem problem(Teuchos::rcpFromRef<const Epetra_Operator>(A), Teuchos::rcpFromRef(solution),
                    Teuchos::rcpFromRef<const Epetra_MultiVector>(rhs));
    problem.setLeftPrec(Teuchos::rcp(
        new Belos::EpetraPrecOp(Teuchos::rcpFromRef<Epetra_Operator>(preconditioner))));
    problem.setProblem();
    const auto parameters = Teuchos::parameterList();
    parameters->set("Convergence Tolerance", tolerance);
    parameters->set("Maximum Iterations", bound);
    parameters->set("Residual Scaling", "Norm of Initial Residual");
    parameters->set("Verbosity", 0);
    Belos::PseudoBlockCGSolMgr<double, Epetra_MultiVector, Epetra_Operator> solver(
        Teuchos::rcpFromRef(problem), parameters);
    const int before = A.n_products();
    try
    {
      solver.solve();
    }
    catch (const Belos::CGIterateFailure &)
    {
      // A is not positive: constraints are dependent, or only rounding remains. The present
      // solution is kept.
    }
    catch (const Belos::StatusTestError &)
    {
      // The residual is not a number: the preconditioned one was zero, or numbers are out of range.
    }
    x.assign(solution[0], solution[0] + b.size());
    if (A.rows().communicator().any(
            !std::all_of(x.begin(), x.end(), [](const double v) { return std::isfinite(v); })))
      x.assign(b.size(), 0.);
    return A.n_products() - before;
  }

  namespace
  {
    /// Least relative residual that ends a solve, a hundred roundings, and the excess that still
    /// counts as solved: exact_part of an active set asks for 1e-3 of the gaps that it needs.
    constexpr double smallest_residual = 1e-14, accepted_excess = 1e3;

    /// Number of restarts of conjugate gradients from the true residual.
    constexpr int most_restarts = 4;

    /// Reduction down to which the recursive residual follows the true one. Beyond it, conjugate
    /// gradients iterate thousands of times on rounding; a restart takes a few iterations.
    constexpr double least_reduction = 1e-11;
    constexpr int least_bound = 10; ///< of the iterations in a restart

    /// Bound of the iterations of a system, over the most that one took so far, and beside these. A
    /// right-hand side that is rounding may be no image of dependent rows: conjugate gradients then
    /// iterate without an end. Systems of the same bodies take similar numbers otherwise; an
    /// exact solution takes at most some ten times those of a rough one.
    constexpr int times_the_last_ones = 10, room = 1000;

    /// Iterations that cost as much as a factor of a body, with two solutions each: 16 of a plate
    /// of 10 000 DoFs, 30 and 50 of blocks of 15 000 and 46 000 DoFs in space.
    constexpr int worth_a_factor = 30;

    std::vector<char> cuts(const Constraints &constraints)
    {
      std::vector<char> result;
      for (std::size_t i = 0; i < constraints.size(); ++i)
        result.push_back(constraints[i].cone.is_free() && constraints.is_fixed(i) &&
                         constraints[i].spring.is_rigid());
      return result;
    }

    /// The larger number; not-a-number if one is.
    double larger(const double a, const double b)
    {
      return a > b || std::isnan(a) ? a : b;
    }

    double largest(const std::vector<double> &x)
    {
      double result = 0.;
      for (const double value : x)
        result = larger(std::fabs(value), result);
      return result;
    }
  } // namespace

  class MatrixFreeSchurComplement::Inverse : public ConstraintOperator
  {
  public:
    Inverse(MatrixFreeSchurComplement &of, const NaturalCoarseProblem *projector)
        : ConstraintOperator(of.F.shared_rows()), of(of), projector(projector)
    {
    }

  private:
    void multiply(const std::vector<double> &r, std::vector<double> &z) const override
    {
      if (!projector)
        return of.scaled_precondition(r, z);
      projected = r;
      projector->project_residual(projected);
      of.scaled_precondition(projected, z);
      projector->project(z);
    }

    MatrixFreeSchurComplement &of;
    const NaturalCoarseProblem *projector;
    mutable std::vector<double> projected;
  };

  MatrixFreeSchurComplement::MatrixFreeSchurComplement(const InterfaceParameters &parameters,
                                                       const FactoredStructure &solvers,
                                                       const Constraints &constraints)
      : parameters(parameters), solvers(solvers), constraints(constraints),
        body_constraints(solvers.structure(), constraints), F(solvers, body_constraints),
        preconditioner(parameters, solvers, body_constraints),
        flexibilities(solvers, body_constraints, cuts(constraints)), tolerance(smallest_residual),
        work(solvers.structure().zero())
  {
    if (parameters.coarse_space != "rigid body modes" && parameters.coarse_space != "none")
      throw UserError("unknown coarse space '" + parameters.coarse_space +
                      "'; known are: rigid body modes, none. Correct the name");
    F.set_scale(scale());
  }

  void MatrixFreeSchurComplement::set_tolerance(const double wanted)
  {
    tolerance = wanted > smallest_residual ? wanted : smallest_residual; // also for not-a-number
  }

  void MatrixFreeSchurComplement::setup(const std::vector<double> &S)
  {
    compliance = S;
    F.set_compliance(S);
    if (parameters.coarse_space == "rigid body modes" && !solvers.is_generalised_inverse())
      coarse_space =
          std::make_unique<CoarseSpace>(solvers, body_constraints, parameters.largest_whole_factor);
    preconditioner.reset();
    preconditioner.follow_sets(false);
    follows_sets = follows_in_vain = false;
    most_iterations = 0;
    is_changed.assign(body_constraints.size(), 1);
    is_stale = true;
    body_constraints.update();
    F.update_rows();
    flexibilities.setup(S);
  }

  void MatrixFreeSchurComplement::update_moving()
  {
    if (constraints.varying_rows().empty())
      return;
    is_stale = true;
    std::set<std::size_t> touched; // before or after the move
    const auto mark = [&]
    {
      for (std::size_t k = 0; k < body_constraints.size(); ++k)
        if (!body_constraints[k].empty() && body_constraints[k].back().varies)
          touched.insert(k);
    };
    mark();
    body_constraints.update();
    mark();
    for (const std::size_t k : touched)
      is_changed[k] = 1;
    F.update_rows();
    flexibilities.update(touched);
  }

  void MatrixFreeSchurComplement::set_compliance(const std::vector<double> &S)
  {
    compliance = S;
    F.set_compliance(S);
    flexibilities.set_compliance(S);
    is_stale = true;
  }

  void MatrixFreeSchurComplement::contact_free_predictor(const BodyVectors &P,
                                                         std::vector<double> &d,
                                                         std::vector<double> &terms_size) const
  {
    work = P;
    solvers.solve(work);
    d.resize(constraints.size());
    terms_size.resize(constraints.size());
    constraints.share_of_motions(work, d, terms_size);
  }

  std::string MatrixFreeSchurComplement::description() const
  {
    return "matrix-free, " + std::to_string(constraints.n_of_all()) +
           " constraints, preconditioner " + parameters.preconditioner + ", coarse space " +
           parameters.coarse_space +
           (coarse_space ? " (" + std::to_string(coarse_space->size()) + ")" : "");
  }

  InterfaceStatistics MatrixFreeSchurComplement::statistics() const
  {
    InterfaceStatistics result = counts;
    result.n_applications = F.n_applications();
    result.n_local_solves = F.n_local_solves();
    return result;
  }

  void MatrixFreeSchurComplement::apply(const std::vector<double> &x, std::vector<double> &y) const
  {
    F.apply(x, y);
  }

  /// Preconditioner and coarse space for a set, as far as it is new.
  void MatrixFreeSchurComplement::prepare(const std::vector<std::size_t> &set, const double shift)
  {
    std::vector<char> wanted(constraints.size(), 0);
    for (const std::size_t i : set)
      wanted[i] = 1;
    if (constraints.any(is_stale || active != wanted))
    {
      for (std::size_t k = 0; k < body_constraints.size(); ++k)
        for (const BodyConstraints::Entry &entry : body_constraints[k])
          if (!active.empty() && active[entry.constraint] != wanted[entry.constraint])
            is_changed[k] = 1;
      is_stale = true; // until both are ready
      preconditioner.setup(rows(), wanted, is_changed, compliance, flexibilities.diagonal());
      if (coarse_space)
        coarse_space->setup(rows(), wanted, is_changed, compliance);
      active = wanted;
      is_stale = false;
      std::fill(is_changed.begin(), is_changed.end(), 0);
    }
    F.restrict_to(wanted);
    F.set_shift(shift, flexibilities.diagonal());
  }

  void MatrixFreeSchurComplement::divide_by_scale(std::vector<double> &x) const
  {
    const std::vector<std::size_t> &owned = F.owned();
    for (std::size_t p = 0; p < x.size(); ++p)
      x[p] = active[owned[p]] ? x[p] / scale()[owned[p]] : 0.;
  }

  /// Applies the preconditioner, balanced by the coarse space.
  void MatrixFreeSchurComplement::scaled_precondition(const std::vector<double> &r,
                                                      std::vector<double> &z)
  {
    constraint_work = r;
    divide_by_scale(constraint_work);
    if (coarse_space)
    {
      coarse_space->solve(rows(), constraint_work, coarse_part, coarse_motion);
      for (std::size_t p = 0; p < r.size(); ++p)
        constraint_work[p] -= coarse_motion[p];
    }
    preconditioner.apply(constraint_work, z);
    if (coarse_space)
    {
      coarse_space->project(rows(), z);
      for (std::size_t p = 0; p < r.size(); ++p)
        z[p] += coarse_part[p];
    }
    const std::vector<std::size_t> &owned = F.owned();
    for (std::size_t p = 0; p < r.size(); ++p)
      z[p] = active[owned[p]] ? z[p] / scale()[owned[p]] : r[p];
  }

  /// The right-hand side of the active rows that this rank owns, scaled.
  std::vector<double> MatrixFreeSchurComplement::scaled(const std::vector<double> &rhs) const
  {
    std::vector<double> result;
    for (const std::size_t i : F.owned())
      result.push_back(active[i] ? scale()[i] * rhs[i] : 0.);
    return result;
  }

  /// The multipliers of the rows of this rank.
  void MatrixFreeSchurComplement::set_solution(const std::vector<double> &scaled_x,
                                               std::vector<double> &x) const
  {
    x.assign(constraints.size(), 0.);
    for (std::size_t p = 0; p < scaled_x.size(); ++p)
      x[F.owned()[p]] = scaled_x[p];
    constraints.sum(x);
    for (std::size_t i = 0; i < x.size(); ++i)
      if (active[i])
        x[i] *= scale()[i];
  }

  bool MatrixFreeSchurComplement::solve(const std::vector<std::size_t> &set,
                                        const std::vector<double> &rhs, const double shift,
                                        std::vector<double> &x)
  {
    x.assign(constraints.size(), 0.);
    if (!constraints.any(
            std::any_of(set.begin(), set.end(), [&](const std::size_t i) { return rhs[i] != 0.; })))
      return true;
    prepare(set, shift);
    std::vector<double> b = scaled(rhs), scaled_x(b.size(), 0.);
    const bool is_solved = refine(nullptr, b, scaled_x);
    set_solution(scaled_x, x);
    F.unrestrict();
    F.set_shift(0., flexibilities.diagonal());
    return is_solved;
  }

  /// The motions of the rows of the preconditioner's blocks, by their positions there.
  std::vector<LinearForm>
  MatrixFreeSchurComplement::on_blocks(const std::vector<LinearForm> &null_space,
                                       const std::vector<std::size_t> &rows_of_blocks) const
  {
    if (preconditioner.has_all_rows())
      return null_space;
    std::vector<char> is_own(constraints.size(), 0);
    for (const std::size_t i : F.owned())
      is_own[i] = 1;
    MatrixEntries entries;
    for (std::size_t k = 0; k < null_space.size(); ++k)
      for (std::size_t e = 0; e < null_space[k].index.size(); ++e)
        if (const unsigned int i = null_space[k].index[e]; is_own[i])
          entries.add(constraints.number(i), k, null_space[k].value[e]);
    preconditioner.copy_to_blocks(entries, null_space.size());
    entries.compress();
    std::vector<LinearForm> result(null_space.size());
    std::size_t p = 0;
    for (std::size_t e = 0; e < entries.size(); ++e)
    {
      while (rows_of_blocks[p] != static_cast<std::size_t>(entries.row[e]))
        ++p;
      result[entries.column[e]].add(static_cast<unsigned int>(p), entries.value[e]);
    }
    return result;
  }

  bool MatrixFreeSchurComplement::solve_with_null_space(const std::vector<std::size_t> &set,
                                                        const std::vector<double> &rhs,
                                                        const std::vector<LinearForm> &null_space,
                                                        const std::vector<double> &load,
                                                        const double shift, std::vector<double> &x,
                                                        std::vector<double> &alpha)
  {
    prepare(set, shift);
    const RowBlocks blocks = preconditioner.blocks();
    const std::vector<double> scales = preconditioner.on_blocks(scale()),
                              is_active = preconditioner.on_blocks({active.begin(), active.end()});
    const auto divide = [&](std::vector<double> &values)
    {
      for (std::size_t p = 0; p < values.size(); ++p)
        values[p] = is_active[p] > 0. ? values[p] / scales[p] : 0.;
    };
    const NaturalCoarseProblem coarse_problem(
        on_blocks(null_space, blocks.rows), scales, is_active, rows(), blocks,
        [&](std::vector<double> &values)
        {
          divide(values);
          preconditioner.scale(values);
          divide(values);
        },
        parameters.largest_whole_factor);
    x.assign(constraints.size(), 0.);
    bool is_solved = coarse_problem.holds_the_bodies();
    if (is_solved)
    {
      std::vector<double> b = scaled(rhs), scaled_x(b.size(), 0.), image;
      coarse_problem.balance(load, scaled_x);
      is_solved = refine(&coarse_problem, b, scaled_x);
      F.scaled_apply(scaled_x, image);
      for (std::size_t p = 0; p < b.size(); ++p)
        image[p] = b[p] - image[p];
      alpha = coarse_problem.amplitudes(image);
      set_solution(scaled_x, x);
    }
    F.unrestrict();
    F.set_shift(0., flexibilities.diagonal());
    return is_solved;
  }

  /// In statics, where sets change much, few are solved with, and no checkpoint lies between them.
  void MatrixFreeSchurComplement::follow_sets_if_worth(const int n_iterations)
  {
    if (is_stale || !solvers.is_generalised_inverse() || follows_in_vain ||
        n_iterations <= worth_a_factor)
      return;
    const std::vector<std::size_t> bodies = preconditioner.applied_bodies(active, !follows_sets);
    if (!rows().communicator().any(!bodies.empty()))
      return;
    follows_in_vain = follows_sets;
    follows_sets = !follows_sets;
    preconditioner.follow_sets(follows_sets);
    for (const std::size_t k : bodies)
      is_changed[k] = 1;
    is_stale = true;
  }

  /// Solves for scaled constraints from x, by the true residual and not the recursive one.
  bool MatrixFreeSchurComplement::refine(const NaturalCoarseProblem *null_space,
                                         const std::vector<double> &b, std::vector<double> &x)
  {
    const auto project = [&](std::vector<double> &v)
    {
      if (null_space)
        null_space->project(v);
    };
    const auto project_residual = [&](std::vector<double> &v)
    {
      if (null_space)
        null_space->project_residual(v);
    };
    const auto largest_of_all = [&](const std::vector<double> &v)
    { return rows().communicator().max(largest(v)); };
    F.set_projector(null_space);
    Inverse inverse(*this, null_space);
    std::vector<double> r, step, image, candidate = x;
    const auto residual = [&]
    {
      F.scaled_apply(candidate, image);
      r.resize(b.size());
      for (std::size_t i = 0; i < b.size(); ++i)
        r[i] = b[i] - image[i];
      project_residual(r);
      return largest_of_all(r);
    };
    ++counts.n_systems;
    int n_of_system = 0;
    int bound = room + times_the_last_ones * (most_iterations > 0
                                                  ? most_iterations
                                                  : static_cast<int>(constraints.n_of_all()));
    double best = residual(), size = larger(largest_of_all(b), largest_of_all(x));
    for (int restart = 0; restart < most_restarts && best > tolerance * size; ++restart)
    {
      const double reduction =
          std::min(.1, std::max(least_reduction, .3 * tolerance * size / largest_of_all(r)));
      const int n = conjugate_gradients(F, inverse, r, reduction, bound, step);
      counts.n_iterations += n;
      n_of_system += n;
      follow_sets_if_worth(n);
      bound = std::max(n, least_bound); // a restart reduces less; more iterations mean rounding
      project(step);
      for (std::size_t i = 0; i < x.size(); ++i)
        candidate[i] = x[i] + step[i];
      const double error = residual();
      size = larger(largest_of_all(b), largest_of_all(candidate));
      if (!(error < .5 * best))
        break;
      best = error;
      x = candidate;
    }
    F.set_projector(nullptr);
    const bool is_solved = std::isfinite(best) && best <= accepted_excess * tolerance * size;
    if (is_solved)
      most_iterations = std::max(most_iterations, n_of_system);
    return is_solved;
  }
} // namespace taut
