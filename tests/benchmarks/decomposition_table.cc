// SPDX-License-Identifier: LGPL-2.1-or-later
// The table of G. N. Kolesnikov and D. A. Kuvshinov: seconds to solve one step of a model of N0
// equations, cut into n substructures with bilateral links only, one after another on one core.
// Beside the printed table stand (a) dense blocks by factor-and-solve, (b) dense blocks by explicit
// inverse (n >= 2) against one factorisation (n = 1), (c) Taut's own local solvers. Medians of the
// runs. Usage: decomposition_table [runs] [largest N0 of the dense blocks].
#include "complementarity/solver.h"
#include "interface/schur_complement.h"
#include "model/scene_constraints.h"
#include "partition/make_partition.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <numeric>
#include <stdexcept>
#include <vector>

extern "C"
{
  void dpotrf_(const char *uplo, const int *n, double *a, const int *lda, int *info);
  void dpotri_(const char *uplo, const int *n, double *a, const int *lda, int *info);
  void dpotrs_(const char *uplo, const int *n, const int *nrhs, const double *a, const int *lda,
               double *b, const int *ldb, int *info);
  void dsymv_(const char *uplo, const int *n, const double *alpha, const double *a, const int *lda,
              const double *x, const int *incx, const double *beta, double *y, const int *incy);
}

namespace
{
  /// Seconds of the source, for N0 = 1000, 2000, 3000 and n = 1..7 (Core 2 Duo E8400, 2008).
  const double source[3][7] = {{.36, .26, .15, .11, .10, .09, .09},
                               {2.21, 1.98, .81, .57, .41, .34, .29},
                               {6.52, 9.08, 3.14, 1.51, 1.11, .91, .72}};

  void check(const int info)
  {
    if (info != 0)
      throw std::runtime_error("LAPACK failed on a block");
  }

  /// A dense symmetric matrix of a block, its factor or its inverse.
  class DenseBlock
  {
  public:
    /// Definite, with every entry far from zero: what a library skips for zeros would not count.
    explicit DenseBlock(const int n) : n(n), a(static_cast<std::size_t>(n) * n, 0.)
    {
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
        {
          const double distance = i - j;
          a[static_cast<std::size_t>(i) * n + j] = i == j ? 6. : -1. / (1. + distance * distance);
        }
    }
    void factor()
    {
      int info = 0;
      dpotrf_("L", &n, a.data(), &n, &info);
      check(info);
    }
    void invert()
    {
      factor();
      int info = 0;
      dpotri_("L", &n, a.data(), &n, &info);
      check(info);
      inverted = true;
    }
    void apply_inverse(std::vector<double> &x) const
    {
      if (inverted)
      {
        const double one = 1., zero = 0.;
        const int step = 1;
        std::vector<double> y(n);
        dsymv_("L", &n, &one, a.data(), &n, x.data(), &step, &zero, y.data(), &step);
        x.swap(y);
        return;
      }
      const int one = 1;
      int info = 0;
      dpotrs_("L", &n, &one, a.data(), &n, x.data(), &n, &info);
      check(info);
    }
    const int n;

  private:
    std::vector<double> a;
    bool inverted = false;
  };

  /// [5] and [6] on a chain of n dense blocks; the end of each is linked to the start of the next.
  void solve_dense(const int N0, const int n, const bool explicit_inverse)
  {
    std::vector<DenseBlock> blocks;
    for (int k = 0; k < n; ++k)
      blocks.emplace_back(N0 * (k + 1) / n - N0 * k / n);
    std::vector<std::vector<double>> U;
    for (DenseBlock &block : blocks)
    {
      if (explicit_inverse)
        block.invert();
      else
        block.factor();
      U.emplace_back(block.n, 1.);
      block.apply_inverse(U.back());
    }
    if (n == 1)
      return;
    // Columns A^-1 C of the two ends of each block make F, tridiagonal in the links.
    taut::DenseOperator F(n - 1);
    std::vector<std::vector<double>> first(n), last(n);
    for (int k = 0; k < n; ++k)
    {
      first[k].assign(blocks[k].n, 0.);
      first[k].front() = 1.;
      blocks[k].apply_inverse(first[k]);
      last[k].assign(blocks[k].n, 0.);
      last[k].back() = 1.;
      blocks[k].apply_inverse(last[k]);
    }
    std::vector<double> d(n - 1), N;
    std::vector<std::size_t> all(n - 1);
    std::iota(all.begin(), all.end(), 0);
    for (int k = 0; k + 1 < n; ++k)
    {
      F.set(k, k, last[k].back() + first[k + 1].front());
      if (k > 0)
        F.set(k, k - 1, -first[k].back());
      d[k] = -(U[k].back() - U[k + 1].front());
    }
    if (!F.solve(all, d, 0., N))
      throw std::runtime_error("the links of the chain are dependent");
    for (int k = 0; k < n; ++k)
      for (int i = 0; i < blocks[k].n; ++i)
        U[k][i] += (k + 1 < n ? N[k] * last[k][i] : 0.) - (k > 0 ? N[k - 1] * first[k][i] : 0.);
  }

  /// The same work with Taut: a string of N0 linear elements cut by METIS, factors, columns,
  /// multipliers, displacements.
  void solve_taut(const taut::Scene &scene, const taut::SceneBodies &structure)
  {
    const taut::Constraints constraints = taut::scene_constraints(scene, structure);
    taut::FactoredStructure solvers(structure, "block tridiagonal");
    solvers.factor(1e4, 0.);
    taut::BodyVectors U = structure.zero();
    for (auto &block : U)
      std::fill(block.begin(), block.end(), 1.);
    if (constraints.size() > 0)
    {
      const auto schur = taut::make_schur_complement({}, solvers, constraints);
      schur->setup(std::vector<double>(constraints.size(), 0.));
      taut::MixedComplementarityProblem problem;
      problem.cones.assign(constraints.size(), taut::Cone::free());
      schur->contact_free_predictor(U, problem.free_gap, problem.gap_scale);
      taut::ComplementaritySolver solver;
      constraints.add_forces(solver.solve(problem, schur->matrix()).solution.multiplier, U);
    }
    solvers.solve(U);
  }

  taut::Scene string_scene(const int N0)
  {
    taut::Scene scene;
    taut::Wire wire;
    wire.name = "string";
    wire.b = {static_cast<double>(N0), 0.};
    wire.mass_per_length = 1.;
    wire.tension = 1e4;
    wire.transverse = taut::TransverseKind::string;
    wire.degree = 1;
    scene.wires.push_back(wire);
    return scene;
  }

  double median_seconds(const int runs, const std::function<void()> &work)
  {
    std::vector<double> seconds;
    for (int i = 0; i < runs; ++i)
    {
      const auto begin = std::chrono::steady_clock::now();
      work();
      seconds.push_back(
          std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    }
    std::sort(seconds.begin(), seconds.end());
    return seconds[seconds.size() / 2];
  }

  void print(const char *name, const std::vector<double> &seconds)
  {
    std::printf("| %-28s |", name);
    for (const double s : seconds)
      std::printf(" %9.3g (%5.2f) |", s, s / seconds[0]);
    std::printf("\n");
    std::fflush(stdout);
  }

  double taut_seconds(const int runs, const int N0, const unsigned int n)
  {
    const taut::Scene scene = string_scene(N0);
    taut::PartitionParameters parameters;
    parameters.n_substructures = std::to_string(n);
    const taut::SceneBodies structure(scene, make_partition(scene, parameters));
    return median_seconds(runs, [&] { solve_taut(scene, structure); });
  }
} // namespace

int main(int argc, char **argv)
{
  const int runs = argc > 1 ? std::atoi(argv[1]) : 5;
  const int largest = argc > 2 ? std::atoi(argv[2]) : 3000;
  std::printf("Seconds, in brackets the ratio to n = 1; medians of %d runs\n", runs);
  for (int constraint = 0; constraint < 3; ++constraint)
  {
    const int N0 = 1000 * (constraint + 1);
    std::printf("\nN0 = %d\n| n                            |", N0);
    for (int n = 1; n <= 7; ++n)
      std::printf(" %17d |", n);
    std::printf("\n");
    print("source (2008)", std::vector<double>(source[constraint], source[constraint] + 7));
    std::vector<double> a, b, c;
    for (int n = 1; n <= 7; ++n)
    {
      if (N0 <= largest)
      {
        a.push_back(median_seconds(runs, [&] { solve_dense(N0, n, false); }));
        b.push_back(median_seconds(runs, [&] { solve_dense(N0, n, n > 1); }));
      }
      c.push_back(taut_seconds(std::max(runs, 20), N0, n));
    }
    if (!a.empty())
    {
      print("(a) factor and solve", a);
      print("(b) explicit inverse, n >= 2", b);
    }
    print("(c) Taut", c);
  }
  for (const int N0 : {10000, 100000, 1000000})
  {
    std::printf("\nN0 = %d\n| n                            |", N0);
    const std::vector<unsigned int> numbers = {1, 4, 16, 64, 256, 1024};
    std::vector<double> c;
    for (const unsigned int n : numbers)
    {
      std::printf(" %17u |", n);
      c.push_back(taut_seconds(runs, N0, n));
    }
    std::printf("\n");
    print("(c) Taut", c);
  }
}
