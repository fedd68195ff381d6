// SPDX-License-Identifier: LGPL-2.1-or-later
// Iterations of conjugate gradients on the interface problem of a railway overhead line of EN 50318
// spans, cut by METIS into n parts: all droppers, the sliding contact and the cuts closed, own
// weight as load, relative residual 1e-9 in constraints of unit diagonal. One table a step
// (backward Euler) and one for statics; a constraint each for preconditioner and coarse space.
// Usage: interface_table [spans] [largest n] [folder prm].
#include "verification/interface_problem.h"

#include <taut/simulation/parameters.h>

#include <chrono>

using verification::InterfaceProblem;

int main(int argc, char **argv)
{
  const std::string spans = argc > 1 ? argv[1] : "100";
  const unsigned int largest = argc > 2 ? std::atoi(argv[2]) : 1024;
  const std::string folder = argc > 3 ? argv[3] : "prm";
  std::vector<unsigned int> numbers;
  for (unsigned int n = 4; n <= largest; n *= 4)
    numbers.push_back(n);

  std::vector<std::unique_ptr<InterfaceProblem>> lines;
  std::printf("%s spans\n| n | bodies | DoFs |\n|---|---|---|\n", spans.c_str());
  for (const unsigned int n : numbers)
  {
    taut::Parameters parameters;
    parameters.read(folder + "/en50318_2002_250.prm", {"Catenary.Number of spans=" + spans});
    lines.push_back(std::make_unique<InterfaceProblem>(parameters.scene(), n));
    std::printf("| %u | %zu | %zu |\n", n, lines.back()->structure.size(),
                lines.back()->structure.n_dofs());
  }
  for (const double step : {1e-3, 1e-1, 10., 0.})
  {
    if (step > 0.)
      std::printf("\nstep %g s\n\n", step);
    else
      std::printf("\nstatics\n\n");
    std::printf("| iterations (seconds), n = |");
    for (const unsigned int n : numbers)
      std::printf(" %u |", n);
    std::printf("\n|---|");
    for (std::size_t i = 0; i < numbers.size(); ++i)
      std::printf("---|");
    std::printf("\n");
    for (const char *coarse_space : {"none", "rigid body modes"})
      for (const char *preconditioner : {"diagonal", "lumped", "Dirichlet"})
      {
        std::printf("| %s, %s |", preconditioner, coarse_space);
        for (const auto &line : lines)
        {
          // Statics without the coarse problem is a system for each null space vector: only where
          // that ends.
          if (step == 0. && std::string(coarse_space) == "none" && line->structure.size() > 50)
          {
            std::printf(" - |");
            continue;
          }
          const auto begin = std::chrono::steady_clock::now();
          const auto solution =
              line->solve(step, {"matrix-free", preconditioner, coarse_space}, 1e-9);
          const double seconds =
              std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
          std::printf(" %ld%s (%.2g) |", solution.statistics.n_iterations,
                      solution.is_solved ? "" : " unsolved", seconds);
          std::fflush(stdout);
        }
        std::printf("\n");
      }
  }
}
