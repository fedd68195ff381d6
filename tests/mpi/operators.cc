// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: the interface operator is F = sum_k B_k^T A_k^-1 B_k for whoever applies it, AztecOO among
// them, and setting F up takes as many exchanges whatever its size. Source: a row of masses on
// springs, for which A_k are numbers and F has three diagonals.
#include "common.h"
#include "fuzz/library_bodies.h"

#include "interface/schur_complement.h"
#include "interface/shared_factor.h"
#include <taut/base/communicator.h>
#include <taut/interface/contact_schur_operator.h>
#include <taut/interface/system.h>

#include <AztecOO.h>
#include <Epetra_LinearProblem.h>
#include <Epetra_Vector.h>

#include <numeric>

namespace
{
  /// Sums over ranks, their numbers, bytes in messages between two ranks, and barriers.
  long n_exchanges = 0, n_summed = 0, n_sent = 0, n_barriers = 0;

  constexpr double mass_factor = 1e4; ///< [1/s^2]

  double mass(const std::size_t i)
  {
    return 1. + .3 * i;
  }
  double stiffness(const std::size_t i)
  {
    return 200. + 40. * i;
  }

  /// Masses beside each other, on all ranks in turn or each rank a stretch of them, each with a
  /// stop to the next one.
  struct Row
  {
    explicit Row(const std::size_t n_constraints, const bool in_stretches = false)
        : n(n_constraints), in_stretches(in_stretches), structure((build(), system.structure())),
          constraints(system.constraints(structure)), solvers(structure, "sparse direct")
    {
      solvers.factor(mass_factor, 0.);
    }

    void build()
    {
      for (std::size_t i = 0; i <= n; ++i)
        system.add("mass " + std::to_string(i),
                   in_stretches ? i * processes.size() / (n + 1) : i % processes.size(),
                   [i] { return library::chain_of("mass", {mass(i)}, {stiffness(i)}); });
      for (std::size_t i = 0; i < n; ++i)
        system.add(taut::Constraint::unilateral("stop " + std::to_string(i), up(i), up(i + 1)));
    }
    taut::Displacement up(const std::size_t i) const
    {
      return system.displacement(i, {}, {0., 1., 0.});
    }

    /// F x by its three diagonals.
    std::vector<double> product(const std::vector<double> &x) const
    {
      const auto flexibility = [](const std::size_t i)
      { return 1. / (mass_factor * mass(i) + stiffness(i)); };
      std::vector<double> y(n);
      for (std::size_t i = 0; i < n; ++i)
      {
        y[i] = (flexibility(i) + flexibility(i + 1)) * x[i];
        if (i > 0)
          y[i] -= flexibility(i) * x[i - 1];
        if (i + 1 < n)
          y[i] -= flexibility(i + 1) * x[i + 1];
      }
      return y;
    }

    const std::size_t n;
    const bool in_stretches;
    const taut::Communicator processes = taut::Communicator(MPI_COMM_WORLD);
    taut::System system = taut::System(processes);
    taut::Structure structure;
    taut::Constraints constraints;
    taut::FactoredStructure solvers;
  };

  void expect_close(const double *found, const std::vector<double> &expected)
  {
    for (std::size_t i = 0; i < expected.size(); ++i)
      EXPECT_NEAR(found[i], expected[i], 1e-10 * std::fabs(expected[i])) << i;
  }

  /// On the rows that this rank owns.
  void expect_close(const taut::RowMap &rows, const double *found,
                    const std::vector<double> &expected)
  {
    std::vector<double> own;
    rows.pick(expected, own);
    expect_close(found, own);
  }

  std::vector<double> some_multipliers(const std::size_t n)
  {
    std::vector<double> result(n);
    for (std::size_t i = 0; i < n; ++i)
      result[i] = std::cos(1. + 2. * i);
    return result;
  }
} // namespace

/// Counts the sums over ranks of the library, which calls this function in place of MPI's.
extern "C" int MPI_Allreduce(const void *in, void *out, int n, MPI_Datatype type, MPI_Op how,
                             MPI_Comm processes)
{
  ++n_exchanges;
  n_summed += n;
  return PMPI_Allreduce(in, out, n, type, how, processes);
}

/// And what ranks gather.
extern "C" int MPI_Allgatherv(const void *in, int n_in, MPI_Datatype of_in, void *out,
                              const int *n_out, const int *first, MPI_Datatype of_out,
                              MPI_Comm processes)
{
  ++n_exchanges;
  return PMPI_Allgatherv(in, n_in, of_in, out, n_out, first, of_out, processes);
}

/// Counts the bytes between neighbours.
extern "C" int MPI_Isend(const void *data, int n, MPI_Datatype type, int to, int tag,
                         MPI_Comm processes, MPI_Request *request)
{
  int size = 0;
  MPI_Type_size(type, &size);
  n_sent += static_cast<long>(size) * n;
  return PMPI_Isend(data, n, type, to, tag, processes, request);
}

/// Counts where all ranks wait for each other.
extern "C" int MPI_Barrier(MPI_Comm processes)
{
  ++n_barriers;
  return PMPI_Barrier(processes);
}

TEST(Operators, each_row_has_one_owner_and_its_holders)
{
  const Row row(23);
  const taut::BodyConstraints of_bodies(row.structure, row.constraints);
  const taut::RowMap rows(row.processes, of_bodies.rows(), row.n + 2); // two that nobody holds
  const std::vector<std::size_t> &owned = rows.owned(), &held = rows.held();
  EXPECT_TRUE(std::is_sorted(owned.begin(), owned.end()));
  EXPECT_TRUE(std::includes(held.begin(), held.end(), owned.begin(), owned.end()));
  std::vector<double> n_owners(row.n + 2, 0.), values, on_held(held.size()), sums(owned.size()),
      all;
  for (const std::size_t i : owned)
    ++n_owners[i];
  row.processes.sum(n_owners);
  EXPECT_EQ(n_owners, std::vector<double>(row.n + 2, 1.));

  for (const std::size_t i : owned)
    values.push_back(std::cos(i));
  rows.copy_to_holders(values.data(), on_held.data());
  for (std::size_t p = 0; p < held.size(); ++p)
    EXPECT_EQ(on_held[p], std::cos(held[p]));
  std::vector<double> n_holders(row.n + 2, 0.);
  for (const std::size_t i : held)
    ++n_holders[i];
  row.processes.sum(n_holders);
  rows.add_shares(on_held.data(), sums.data());
  for (std::size_t p = 0; p < owned.size(); ++p)
    EXPECT_NEAR(sums[p], n_holders[owned[p]] * values[p], 1e-15);
  rows.gather(values, all);
  for (std::size_t i = 0; i < all.size(); ++i)
    EXPECT_EQ(all[i], std::cos(i));
}

// A product takes no sum over ranks. Of a row in stretches, neighbours share one constraint, whose
// multiplier one of them sends and whose motion the other.
TEST(Operators, a_product_sends_what_ranks_share)
{
  for (const std::size_t n : {8, 40, 400})
  {
    const Row row(n, true);
    const taut::BodyConstraints of_bodies(row.structure, row.constraints);
    taut::ContactSchurOperator F(row.solvers, of_bodies);
    const std::vector<double> known = some_multipliers(n);
    Epetra_Vector x(F.OperatorDomainMap()), y(F.OperatorRangeMap());
    for (int p = 0; p < x.MyLength(); ++p)
      x[p] = known[F.rows().owned()[p]];
    const long exchanges = n_exchanges, before = n_sent;
    ASSERT_EQ(F.Apply(x, y), 0);
    EXPECT_EQ(n_exchanges, exchanges);
    std::vector<double> sent = {static_cast<double>(n_sent - before)};
    row.processes.sum(sent);
    // A stop between masses of two ranks: its multiplier, and a share of its motion.
    const double n_between = std::min(row.processes.size() - 1., static_cast<double>(n));
    EXPECT_EQ(sent[0], 2. * sizeof(double) * n_between) << n;
    expect_close(F.rows(), y.Values(), row.product(known));
  }
}

// A system takes one sum of the length of all constraints, for its solution. Its iterations sum the
// norms and products of conjugate gradients, and neighbours send what they share: a row in a
// product, and the same twice to precondition it.
TEST(Operators, an_iteration_has_nothing_of_the_length_of_all_constraints)
{
  taut::Communicator processes(MPI_COMM_WORLD);
  for (const std::string preconditioner : {"diagonal", "Dirichlet"})
    for (const std::size_t n : {40, 400})
    {
      taut::System system(processes);
      for (std::size_t i = 0; i <= n; ++i)
        system.add("pair", i * processes.size() / (n + 1),
                   [i] {
                     return library::chain_of("pair", {mass(i), mass(i)},
                                              {stiffness(i), 1e6 * stiffness(i)});
                   });
      for (std::size_t i = 0; i < n; ++i)
        system.add(
            taut::Constraint::unilateral("stop", system.displacement(i, {1., 0., 0.}, {0., 1., 0.}),
                                         system.displacement(i + 1, {0., 0., 0.}, {0., 1., 0.})));
      taut::Structure structure = system.structure();
      const taut::Constraints constraints = system.constraints(structure);
      taut::FactoredStructure solvers(structure, "sparse direct");
      solvers.factor(mass_factor, 0.);
      taut::InterfaceParameters parameters;
      parameters.form = "matrix-free";
      parameters.preconditioner = preconditioner;
      parameters.coarse_space = "none";
      const auto F = taut::make_schur_complement(parameters, solvers, constraints);
      F->setup(std::vector<double>(n, 0.));
      std::vector<std::size_t> set(n);
      std::iota(set.begin(), set.end(), 0);
      const std::vector<double> gaps = some_multipliers(n);
      std::vector<double> x, y;
      for (const bool sets_up : {true, false}) // preconditioner and coarse space
      {
        const long summed = n_summed, sent = n_sent, barriers = n_barriers,
                   iterations = F->statistics().n_iterations;
        ASSERT_TRUE(F->matrix().solve(set, gaps, 0., x));
        const long n_iterations = F->statistics().n_iterations - iterations;
        EXPECT_GT(n_iterations, 0);
        if (processes.size() == 1)
          continue;
        EXPECT_LE(n_summed - summed, static_cast<long>(n) + 6 * n_iterations + 100);
        if (sets_up)
          continue;
        EXPECT_LE(n_sent - sent, 8 * static_cast<long>(sizeof(double)) * (n_iterations + 8))
            << preconditioner << " " << n;
        EXPECT_EQ(n_barriers, barriers);
      }
      F->matrix().apply(x, y);
      for (std::size_t i = 0; i < n; ++i)
        EXPECT_NEAR(y[i], gaps[i], 1e-10);
    }
}

// Each mass has stops to both neighbours, so that all rows are one block of Q, on ranks that do not
// know each other. Source: for bodies of one DoF the preconditioner is the inverse of F.
TEST(Operators, a_block_of_rows_on_all_ranks_is_inverted)
{
  for (const bool in_stretches : {true, false})
  {
    const Row row(23, in_stretches);
    const auto F = taut::make_schur_complement({"matrix-free", "Dirichlet", "none"}, row.solvers,
                                               row.constraints);
    F->setup(std::vector<double>(row.n, 0.));
    std::vector<std::size_t> set(row.n);
    std::iota(set.begin(), set.end(), 0);
    const std::vector<double> known = some_multipliers(row.n);
    std::vector<double> x;
    ASSERT_TRUE(F->matrix().solve(set, row.product(known), 0., x));
    expect_close(x.data(), known);
    EXPECT_LE(F->statistics().n_iterations, 2);
  }
}

// A factor that the ranks share solves as one that each of them has whole, and tells a matrix that
// is not definite to working precision. Source: a chain of springs c_i between masses, held by the
// first one, u_i = sum of 1 / c_j up to i under a force at its end.
TEST(Operators, factors_that_ranks_share_are_those_of_one)
{
  constexpr std::size_t n = 50;
  const taut::Communicator processes(MPI_COMM_WORLD);
  const auto spring = [](const std::size_t i) { return 1e3 * (1. + .1 * i); };
  const auto share = [&](const bool is_held)
  {
    taut::SymmetricEntries entries;
    for (std::size_t i = 0; i < n; ++i)
      if (i % processes.size() == processes.rank())
      {
        const double c = i > 0 || is_held ? spring(i) : 0.;
        entries.add(i, i, c);
        if (i == 0)
          continue;
        entries.add(i, i - 1, -c);
        entries.add(i - 1, i - 1, c);
      }
    entries.compress();
    return entries;
  };
  for (const std::size_t largest_whole : {n * n, std::size_t(0)})
  {
    taut::SharedFactor factor(processes, largest_whole);
    ASSERT_TRUE(factor.factor(factor.even_share(n), share(true), 1e-12));
    std::vector<double> x(n, 0.), expected;
    x.back() = 7.;
    factor.solve(x);
    double u = 0.;
    for (std::size_t i = 0; i < n; ++i)
      expected.push_back(u += 7. / spring(i));
    expect_close(x.data(), expected);
    EXPECT_FALSE(factor.factor(factor.even_share(n), share(false), 1e-12));
    // On rows that are not shared evenly: none is on the last of several ranks.
    const bool has_none = processes.size() > 1 && processes.rank() + 1 == processes.size();
    const std::size_t n_own = has_none                ? 0
                              : processes.rank() == 0 ? n - 2 * (processes.size() - 2)
                                                      : 2;
    ASSERT_TRUE(factor.factor(processes.size() == 1 ? n : n_own, share(true), 1e-12));
    std::vector<double> own(processes.size() == 1 ? n : n_own, 0.);
    for (std::size_t i = 0; i < own.size(); ++i)
      own[i] = factor.first_row() + i + 1 == n ? 7. : 0.;
    factor.solve_own(own);
    for (std::size_t i = 0; i < own.size(); ++i)
      EXPECT_NEAR(own[i], expected[factor.first_row() + i], 1e-12 * expected.back());
  }
}

// A factor with fill is found too large only once the matrix is gathered and ordered. Expected: the
// solution that the right-hand side is made of, of a square grid of springs held at each point.
TEST(Operators, factors_with_fill_are_those_of_one)
{
  constexpr std::size_t m = 16, n = m * m;
  const taut::Communicator processes(MPI_COMM_WORLD);
  taut::SymmetricEntries share, all;
  std::vector<double> known(n), product(n, 0.);
  for (std::size_t i = 0; i < n; ++i)
  {
    known[i] = std::cos(1. + 3. * i);
    const auto add = [&](const std::size_t row, const std::size_t column, const double value)
    {
      all.add(row, column, value);
      if (row * processes.size() / n == processes.rank())
        share.add(row, column, value);
    };
    add(i, i, 5.);
    if (i % m > 0)
      add(i, i - 1, -1.);
    if (i >= m)
      add(i, i - m, -1.);
  }
  all.vmult_add(known, product);
  const std::size_t n_of_factor = taut::SparseCholesky().order(n, all);
  ASSERT_GT(n_of_factor, all.size() + 1);
  for (const std::size_t largest_whole : {n_of_factor, n_of_factor - 1})
  {
    taut::SharedFactor factor(processes, largest_whole);
    for (int repeat = 0; repeat < 2; ++repeat)
    {
      ASSERT_TRUE(factor.factor(factor.even_share(n), share, 1e-12));
      std::vector<double> x = product;
      factor.solve(x);
      expect_close(x.data(), known);
    }
  }
}

TEST(Operators, apply_and_aztecoo)
{
  const Row row(7);
  const taut::BodyConstraints of_bodies(row.structure, row.constraints);
  taut::ContactSchurOperator F(row.solvers, of_bodies);
  const std::vector<double> known = some_multipliers(row.n), expected = row.product(known);
  Epetra_Vector x(F.OperatorDomainMap()), y(F.OperatorRangeMap());
  for (int p = 0; p < x.MyLength(); ++p)
    x[p] = known[F.rows().owned()[p]];
  ASSERT_EQ(F.Apply(x, y), 0);
  expect_close(F.rows(), y.Values(), expected);

  Epetra_Vector solution(F.OperatorDomainMap());
  Epetra_LinearProblem problem(&F, &solution, &y);
  AztecOO solver(problem);
  solver.SetAztecOption(AZ_solver, AZ_cg);
  solver.SetAztecOption(AZ_precond, AZ_none);
  solver.SetAztecOption(AZ_output, AZ_none);
  ASSERT_EQ(solver.Iterate(100, 1e-14), 0);
  expect_close(F.rows(), solution.Values(), known);
}

TEST(Operators, setting_up_takes_as_many_exchanges_whatever_the_size)
{
  for (const char *form : {"assembled dense", "assembled sparse", "matrix-free"})
  {
    std::vector<long> exchanges;
    for (const std::size_t n : {8, 40})
    {
      const Row row(n);
      taut::InterfaceParameters parameters;
      parameters.form = form;
      const auto F = taut::make_schur_complement(parameters, row.solvers, row.constraints);
      const long before = n_exchanges;
      F->setup(std::vector<double>(n, 0.));
      exchanges.push_back(n_exchanges - before);
      const std::vector<double> x = some_multipliers(n);
      std::vector<double> y(n);
      F->matrix().apply(x, y);
      expect_close(y.data(), row.product(x));
    }
    EXPECT_EQ(exchanges[0], exchanges[1]) << form;
    EXPECT_EQ(exchanges[0] > 0, taut::Communicator(MPI_COMM_WORLD).size() > 1) << form;
  }
}

// A solid with more constraints than the dense form keeps columns for: the block of the fixed
// constraints is made of half columns. Both ends of a constraint are on one body here, where an
// entry of the body counts twice. Source: F x by solves of the bodies, matrix-free.
TEST(Operators, half_columns_are_those_of_solves)
{
  constexpr std::size_t n_masses = 23, n = 170;
  taut::Communicator processes(MPI_COMM_WORLD);
  taut::System system(processes);
  std::vector<double> masses, springs;
  for (std::size_t i = 0; i < n_masses; ++i)
  {
    masses.push_back(mass(i));
    springs.push_back(1e6 * stiffness(i));
  }
  for (const std::size_t rank : {std::size_t(0), processes.size() - std::size_t(1)})
    system.add("chain", rank, [&] { return library::chain_of("chain", masses, springs); });
  const auto up = [&](const std::size_t body, const std::size_t i) {
    return system.displacement(body, {static_cast<double>(i % n_masses), 0., 0.}, {0., 1., 0.});
  };
  for (std::size_t i = 0; i < n; ++i)
    system.add(taut::Constraint::unilateral("stop " + std::to_string(i), up(i % 2, i),
                                            up(i % 3 == 0 ? 1 - i % 2 : i % 2, 5 * i + 1)));
  taut::Structure structure = system.structure();
  const taut::Constraints constraints = system.constraints(structure);
  taut::FactoredStructure solvers(structure, "sparse direct");
  solvers.factor(mass_factor, 0.);
  const std::vector<double> x = some_multipliers(n);
  std::vector<double> dense(n), free(n);
  for (const auto &[form, y] : {std::pair("assembled dense", &dense), {"matrix-free", &free}})
  {
    taut::InterfaceParameters parameters;
    parameters.form = form;
    const auto F = taut::make_schur_complement(parameters, solvers, constraints);
    F->setup(std::vector<double>(n, 0.));
    F->matrix().apply(x, *y);
    EXPECT_EQ(F->description().find("by half columns") != std::string::npos, y == &dense);
  }
  const double largest = std::fabs(*std::max_element(
      free.begin(), free.end(), [](double a, double b) { return std::fabs(a) < std::fabs(b); }));
  ASSERT_GT(largest, 0.);
  for (std::size_t i = 0; i < n; ++i)
    EXPECT_NEAR(dense[i], free[i], 1e-12 * largest) << i;
}
