// SPDX-License-Identifier: LGPL-2.1-or-later
// Iterations of conjugate gradients on the interface problem of a railway overhead line of EN 50318
// spans, cut by METIS into n parts: all droppers, the sliding contact and the cuts closed, own
// weight as load, relative residual 1e-9 in rows of unit diagonal. One table a step (backward
// Euler) and one for statics; a row each for preconditioner and coarse space. Usage:
// interface_table [spans] [largest n] [folder prm].
#include <taut/interface/schur_complement.h>
#include <taut/partition/make_partition.h>
#include <taut/simulation/parameters.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

namespace
{
  struct Line
  {
    taut::Scene scene;
    taut::Structure structure;
    taut::ContactRows rows;

    Line(const taut::Parameters &parameters)
        : scene(parameters.scene()), structure(scene, make_partition(scene, parameters.partition)),
          rows(scene, structure)
    {
      rows.update(0.);
    }
  };

  struct Result
  {
    long iterations = 0, solves = 0;
    double seconds = 0.;
    bool solved = false;
  };

  /// F x = d, or with the kernels in statics (step 0).
  Result solve(const Line &line, const double step, const taut::InterfaceParameters &parameters)
  {
    taut::FactoredStructure solvers(line.structure, "block tridiagonal");
    std::vector<taut::Substructure::Kernel> kernels;
    if (step > 0.)
      solvers.factor(1. / (step * step), 1. / step);
    else
    {
      for (std::size_t k = 0; k < line.structure.size(); ++k)
        kernels.push_back(line.structure[k].kernel());
      solvers.factor_stiffness(kernels);
    }
    const std::size_t n = line.rows.size();
    std::vector<double> S(n);
    for (std::size_t i = 0; i < n; ++i)
      S[i] = 1. / (line.rows[i].stiffness + (step > 0. ? line.rows[i].damping / step : 0.));
    const auto schur = taut::make_schur_complement(parameters, solvers, line.rows);
    schur->setup(S);

    taut::BlockVector P(line.structure.size());
    for (std::size_t k = 0; k < P.size(); ++k)
      line.structure[k].external_force(0., P[k]);
    std::vector<taut::SparseVector> G;
    std::vector<double> load;
    for (std::size_t k = 0; k < kernels.size(); ++k)
      for (const std::vector<double> &R : kernels[k].vectors)
      {
        G.emplace_back();
        for (std::size_t i = 0; i < n; ++i)
          for (const taut::Term &term : line.rows[i].terms)
            if (term.substructure == k)
              G.back().add(i, term.form.dot(R));
        load.push_back(-std::inner_product(R.begin(), R.end(), P[k].begin(), 0.));
      }

    std::vector<double> d, N, alpha;
    std::vector<double> size;
    schur->free_motion(P, d, size);
    for (double &value : d)
      value = -value;
    std::vector<std::size_t> all(n);
    std::iota(all.begin(), all.end(), 0);
    taut::ComplementarityOperator &F = schur->matrix();
    F.set_tolerance(1e-9);
    Result result;
    const auto begin = std::chrono::steady_clock::now();
    result.solved =
        G.empty() ? F.solve(all, d, 0., N) : F.solve_with_kernel(all, d, G, load, 0., N, alpha);
    result.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    const taut::InterfaceStatistics statistics = schur->statistics();
    result.iterations = statistics.n_iterations;
    result.solves =
        statistics.n_applications > 0 ? statistics.n_local_solves / statistics.n_applications : 0;
    return result;
  }
} // namespace

int main(int argc, char **argv)
{
  const std::string spans = argc > 1 ? argv[1] : "100";
  const unsigned int largest = argc > 2 ? std::atoi(argv[2]) : 1024;
  const std::string folder = argc > 3 ? argv[3] : "prm";
  std::vector<unsigned int> numbers;
  for (unsigned int n = 4; n <= largest; n *= 4)
    numbers.push_back(n);

  std::vector<std::unique_ptr<Line>> lines;
  std::printf("%s spans\n| n | bodies | rows | DoFs |\n|---|---|---|---|\n", spans.c_str());
  for (const unsigned int n : numbers)
  {
    taut::Parameters parameters;
    parameters.read(folder + "/en50318_2002_250.prm",
                    {"Catenary.Number of spans=" + spans,
                     "Partition.Number of substructures=" + std::to_string(n)});
    lines.push_back(std::make_unique<Line>(parameters));
    const Line &line = *lines.back();
    std::printf("| %u | %zu | %zu | %zu |\n", n, line.structure.size(), line.rows.size(),
                line.structure.n_dofs());
  }
  for (const double step : {1e-3, 1e-1, 10., 0.})
  {
    if (step > 0.)
      std::printf("\nstep %g s\n|", step);
    else
      std::printf("\nstatics\n|");
    std::printf(" iterations (s), n = |");
    for (const unsigned int n : numbers)
      std::printf(" %u |", n);
    std::printf("\n|---|");
    for (std::size_t i = 0; i < numbers.size(); ++i)
      std::printf("---|");
    std::printf("\n");
    for (const char *coarse_space : {"none", "kernels"})
      for (const char *preconditioner : {"diagonal", "lumped", "Dirichlet"})
      {
        // In statics the kernels belong to the problem.
        if (step == 0. && std::string(coarse_space) == "none")
          continue;
        std::printf("| %s, %s |", preconditioner, coarse_space);
        for (const auto &line : lines)
        {
          const Result r = solve(*line, step, {"matrix-free", preconditioner, coarse_space});
          std::printf(" %ld%s (%.2g) |", r.iterations, r.solved ? "" : "!", r.seconds);
          std::fflush(stdout);
        }
        std::printf("\n");
      }
  }
}
