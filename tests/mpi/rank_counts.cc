// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: messages and bytes of a rank in an iteration of conjugate gradients on a cut solid, and
// the sums over the ranks, are bounded whatever the number of ranks, and so are the cuts that a
// rank has; the numbers that are summed are the modes of the coarse problem and some more. Source:
// MPI's own calls, counted in front of it, in two solutions to different residuals; a part has
// eight neighbours. Environment: TAUT_ELEMENTS, of a side of a part (8).
#include "solid/box_in_parts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numeric>

namespace
{
  /// Messages and bytes of this rank, sums over the ranks and the numbers in them, and calls of
  /// MPI_Barrier, MPI_Bcast, MPI_Allgather, MPI_Allgatherv, MPI_Rsend and MPI_Send, of which there
  /// are none.
  struct Counts
  {
    double messages = 0., bytes = 0., sums = 0., summed = 0., others = 0.;
  };
  Counts counts;

  int size_of(const MPI_Datatype type)
  {
    int size = 0;
    MPI_Type_size(type, &size);
    return size;
  }

  /// A square of equal parts in a step of implicit Euler of a
  /// hundred passages of a wave through an element.
  class SquareInParts
  {
  public:
    SquareInParts(const unsigned int n, const unsigned int elements)
        : type(std::make_shared<const box_in_parts::BoxType<2>>(box_in_parts::Box{n, elements})),
          model(box_in_parts::scene<2>(type)), structure(model, cuts(n), processes),
          constraints(distributed(taut::scene_constraints(model, structure))),
          solvers(structure, "sparse direct"),
          F(taut::make_schur_complement({"matrix-free", "Dirichlet", "rigid body modes"}, solvers,
                                        constraints))
    {
      constexpr double step = 100.;
      solvers.factor(1. / (step * step), 1. / step);
      F->setup(std::vector<double>(constraints.size(), 0.));
    }

    /// Iterations, and their counts, to a relative residual.
    std::pair<double, Counts> solve(const double tolerance)
    {
      const std::size_t n = constraints.size();
      std::vector<std::size_t> all(n);
      std::iota(all.begin(), all.end(), 0);
      std::vector<double> gaps(n), x;
      for (std::size_t i = 0; i < n; ++i)
        gaps[i] = std::cos(1. + 2. * constraints.number(i));
      F->matrix().set_tolerance(tolerance);
      const double before = F->statistics().n_iterations;
      counts = {};
      EXPECT_TRUE(F->matrix().solve(all, gaps, 0., x));
      return {F->statistics().n_iterations - before, counts};
    }

    const taut::Communicator processes = taut::Communicator(MPI_COMM_WORLD);

  private:
    static taut::Constraints distributed(taut::Constraints constraints)
    {
      constraints.distribute(true);
      return constraints;
    }

    taut::Partition cuts(const unsigned int n) const
    {
      taut::Partition partition;
      partition.n_parts = n * n;
      partition.bodies = {{type->division({}), type->boxes}};
      return partition;
    }

    std::shared_ptr<const box_in_parts::BoxType<2>> type;
    const taut::Scene model;

  public:
    const taut::SceneBodies structure;
    const taut::Constraints constraints;

  private:
    taut::FactoredStructure solvers;
    std::unique_ptr<taut::SchurComplement> F;
  };
} // namespace

extern "C" int MPI_Allreduce(const void *in, void *out, int n, MPI_Datatype type, MPI_Op how,
                             MPI_Comm processes)
{
  ++counts.sums;
  counts.summed += n;
  return PMPI_Allreduce(in, out, n, type, how, processes);
}

extern "C" int MPI_Isend(const void *data, int n, MPI_Datatype type, int to, int tag,
                         MPI_Comm processes, MPI_Request *request)
{
  ++counts.messages;
  counts.bytes += static_cast<double>(n) * size_of(type);
  return PMPI_Isend(data, n, type, to, tag, processes, request);
}

extern "C" int MPI_Barrier(MPI_Comm processes)
{
  ++counts.others;
  return PMPI_Barrier(processes);
}

extern "C" int MPI_Bcast(void *data, int n, MPI_Datatype type, int root, MPI_Comm processes)
{
  ++counts.others;
  return PMPI_Bcast(data, n, type, root, processes);
}

extern "C" int MPI_Allgather(const void *in, int n_in, MPI_Datatype of_in, void *out, int n_out,
                             MPI_Datatype of_out, MPI_Comm processes)
{
  ++counts.others;
  return PMPI_Allgather(in, n_in, of_in, out, n_out, of_out, processes);
}

extern "C" int MPI_Allgatherv(const void *in, int n_in, MPI_Datatype of_in, void *out,
                              const int *n_out, const int *first, MPI_Datatype of_out,
                              MPI_Comm processes)
{
  ++counts.others;
  return PMPI_Allgatherv(in, n_in, of_in, out, n_out, first, of_out, processes);
}

extern "C" int MPI_Rsend(const void *data, int n, MPI_Datatype type, int to, int tag,
                         MPI_Comm processes)
{
  ++counts.others;
  return PMPI_Rsend(data, n, type, to, tag, processes);
}

extern "C" int MPI_Send(const void *data, int n, MPI_Datatype type, int to, int tag,
                        MPI_Comm processes)
{
  ++counts.others;
  return PMPI_Send(data, n, type, to, tag, processes);
}

TEST(RankCounts, an_iteration_is_bounded_on_any_number_of_ranks)
{
  const char *const given = std::getenv("TAUT_ELEMENTS");
  const unsigned int elements = given ? std::atoi(given) : 8;
  const taut::Communicator world(MPI_COMM_WORLD);
  // 4 parts a rank where that makes a square, as for 4 and 16 ranks, else 8, as for 2, 8 and 32.
  const auto root_of = [](const double area)
  { return static_cast<unsigned int>(std::lround(std::sqrt(area))); };
  const unsigned int p = world.size(), n = root_of((root_of(p) * root_of(p) == p ? 4. : 8.) * p);
  SquareInParts square(n, elements);
  square.solve(1e-4); // sets up
  const auto [few, rough] = square.solve(1e-4);
  const auto [many, exact] = square.solve(1e-10);
  ASSERT_GT(many, few + 5.);
  const double iterations = many - few;
  const auto each = [&](const double now, const double before)
  { return world.max((now - before) / iterations); };
  const double messages = each(exact.messages, rough.messages),
               bytes = each(exact.bytes, rough.bytes), sums = each(exact.sums, rough.sums),
               summed = each(exact.summed, rough.summed), others = each(exact.others, rough.others),
               modes = 3. * n * n, // of the parts
      rows = world.max(static_cast<double>(square.constraints.size()));
  if (world.is_root())
    std::printf("| %u | %u | %zu | %.0f | %.0f | %.1f | %.0f | %.1f | %.0f |\n", world.size(),
                n * n, square.constraints.n_of_all(), rows, many, messages, bytes, sums, summed);
  // F, the preconditioner and the coarse space exchange values or shares some ten times.
  constexpr double exchanges = 10., neighbours = 8. * 4.;
  EXPECT_LE(messages, world.size() > 1 ? exchanges * std::min(neighbours, world.size() - 1.) : 0.);
  // Two numbers at each node on the boundaries of eight parts, of 8 bytes.
  // At most eight parts a rank, each with nodes on four sides and up to two cuts of each of its
  // two DoFs there.
  EXPECT_LE(rows, 8. * 4. * (elements + 1.) * 2. * 2.);
  EXPECT_LE(bytes, exchanges * 8. * 2. * 8. * 4. * (elements + 1.));
  EXPECT_LE(sums, 12.);
  EXPECT_LE(summed, 2. * modes + 30.);
  EXPECT_EQ(others, 0.);
}

// Claim: the ranks make their bodies at the same time. Expected: the set-up has as many sums over
// the ranks for 64 bodies as for 16.
TEST(RankCounts, the_ranks_make_their_bodies_at_the_same_time)
{
  const auto sums_of_setup = [](const unsigned int n)
  {
    counts = {};
    const SquareInParts square(n, 2);
    return counts.sums;
  };
  EXPECT_EQ(sums_of_setup(8), sums_of_setup(4));
}
