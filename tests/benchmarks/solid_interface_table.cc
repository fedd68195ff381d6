// SPDX-License-Identifier: LGPL-2.1-or-later
// Iterations of conjugate gradients on the interface problem of a square or cube of Q1 elements in
// equal boxes, fixed on one side, its weight as load, relative residual 1e-9 in constraints of unit
// diagonal: statics, and steps by backward Euler with c tau / h as given.
// Usage: solid_interface_table [largest n in the plane] [largest n in space].
#include "solid/box_in_parts.h"

#include <chrono>

namespace
{
  using box_in_parts::Box;

  template <int dim>
  void run(const char *title, const Box &box, const double step, const char *preconditioner,
           const char *coarse_space = "rigid body modes")
  {
    const auto problem = box_in_parts::problem<dim>(box);
    const auto begin = std::chrono::steady_clock::now();
    const auto solution = problem->solve(step, {"matrix-free", preconditioner, coarse_space}, 1e-9);
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    std::printf("| %s | %d | %zu | %u | %zu | %g | %s, %s | %ld%s | %.2g |\n", title, dim,
                problem->structure.size(), box.elements, problem->structure.n_dofs(), step,
                preconditioner, coarse_space, solution.statistics.n_iterations,
                solution.is_solved ? "" : " unsolved", seconds);
    std::fflush(stdout);
  }

  template <int dim>
  void tables(const unsigned int most)
  {
    const auto n_parts = [](const unsigned int n) { return dim == 2 ? n * n : n * n * n; };
    for (unsigned int n = 2; n_parts(n) <= most; n *= 2)
    {
      for (const unsigned int elements : {4u, 8u, 16u})
        if (dim == 2 || n_parts(n) * elements * elements * elements <= 40000)
          run<dim>("statics", {n, elements}, 0., "Dirichlet");
      run<dim>("statics", {n, 8}, 0., "lumped");
      run<dim>("METIS", {n, 8, 1., n_parts(n)}, 0., "Dirichlet");
      for (const double jump : {1e3, 1e6})
        run<dim>("jump", {n, 8, jump}, 0., "Dirichlet");
      for (const double step : {1., 10., 100., 1e4})
        for (const char *coarse_space : {"none", "rigid body modes"})
          run<dim>("step", {n, 8}, step, "Dirichlet", coarse_space);
    }
  }
} // namespace

int main(int argc, char **argv)
{
  std::printf(
      "| load | dim | parts | H/h | DoFs | c tau/h | preconditioner | iterations | seconds |\n"
      "|---|---|---|---|---|---|---|---|---|\n");
  tables<2>(argc > 1 ? std::atoi(argv[1]) : 256);
  tables<3>(argc > 2 ? std::atoi(argv[2]) : 64);
}
