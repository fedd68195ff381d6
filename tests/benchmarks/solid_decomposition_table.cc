// SPDX-License-Identifier: LGPL-2.1-or-later
// A solid in n parts against one sparse direct factorisation (CHOLMOD): a square or cube of Q1
// elements, fixed on one side, its weight as load, in equilibrium; METIS parts, Dirichlet
// preconditioner, relative residual 1e-9. Seconds of processor time: factors and interface
// operator, the same with the first solution, a further one; memory [MB]. One line for each call,
// as memory is that of the process. Usage: solid_decomposition_table DIMENSION
// ELEMENTS_IN_EACH_DIRECTION PARTS; 1 part is the direct one.
#include "solid/box_in_parts.h"

namespace
{
  using verification::seconds_since;

  /// VmRSS or VmHWM of this process [MB].
  double memory(const std::string &name)
  {
    std::ifstream file("/proc/self/status");
    for (std::string line; std::getline(file, line);)
      if (line.compare(0, name.size(), name) == 0)
        return std::atof(line.c_str() + name.size() + 1) / 1024.;
    return 0.;
  }

  template <int dim>
  void run(const unsigned int elements, const unsigned int n_parts)
  {
    box_in_parts::Box box;
    box.n = 1;
    box.elements = elements;
    box.metis_parts = n_parts;
    if (n_parts == 1)
    {
      const box_in_parts::BoxType<dim> type(box);
      taut::Structure structure;
      structure.add("box", 0, [&] { return type.make({}); });
      const double before = memory("VmRSS:");
      std::clock_t begin = std::clock();
      taut::FactoredStructure solvers(structure, "sparse direct");
      solvers.factor_stiffness();
      const double factor = seconds_since(begin);
      taut::BodyVectors P(1);
      structure[0].external_force(0., P[0]);
      begin = std::clock();
      solvers.solve(P);
      const double solve = seconds_since(begin);
      std::printf("| %d-D | %zu | 1 | - | %.3g | %.3g | %.3g | %.0f |\n", dim, structure.n_dofs(),
                  factor, factor + solve, solve, memory("VmHWM:") - before);
      return;
    }
    const auto problem = box_in_parts::problem<dim>(box);
    const double before = memory("VmRSS:");
    const auto s = problem->solve(0., {"matrix-free", "Dirichlet", "rigid body modes"}, 1e-9, true);
    std::size_t n_dofs = elements + 1;
    for (int d = 1; d < dim; ++d)
      n_dofs *= elements + 1;
    std::printf("| %d-D | %zu | %zu | %ld%s | %.3g | %.3g | %.3g | %.0f |\n", dim, dim * n_dofs,
                problem->structure.size(), s.statistics.n_iterations / 2,
                s.is_solved ? "" : " unsolved", s.set_up, s.set_up + s.first, s.further,
                memory("VmHWM:") - before);
  }
} // namespace

int main(int argc, char **argv)
{
  if (argc != 4)
  {
    std::fprintf(stderr, "usage: solid_decomposition_table DIMENSION ELEMENTS PARTS\n");
    return 1;
  }
  if (std::atoi(argv[1]) == 2)
    run<2>(std::atoi(argv[2]), std::atoi(argv[3]));
  else
    run<3>(std::atoi(argv[2]), std::atoi(argv[3]));
}
