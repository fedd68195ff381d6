// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: the matrix-free interface solve needs memory of the size of the bodies' vectors and
// factors, at 1e6 DoFs and 1e4 constraints: nothing in it is dense in the constraints (F alone
// would be 0.8 GB, and its factor as much). Expected: the peak of the process below 10 times the 17
// vectors of a run and the factors, what the solve adds below 4 times the factors and its 4
// vectors; an equilibrium of strings with thousands of droppers at their nodes adds no more than
// 14 kB a dropper, where anything of their number squared would add as much again.
#include "common.h"
#include "interface_problem.h"
#include "scene_tests.h"

#include <taut/simulation/parameters.h>

#include <malloc.h>

namespace
{
  /// An entry of /proc/self/status in bytes: VmRSS, what is in memory, or VmHWM, the most so far.
  double status(const std::string &entry)
  {
    std::ifstream file("/proc/self/status");
    for (std::string name; file >> name;)
      if (name == entry + ":")
      {
        double kilobytes = 0.;
        file >> kilobytes;
        return 1024. * kilobytes;
      }
    return -1.;
  }
} // namespace

TEST(InterfaceMemory, of_the_size_of_vectors_and_factors)
{
  taut::Parameters parameters;
  parameters.read(std::string(TAUT_PRM_FOLDER) + "/en50318_2002_250.prm",
                  {"Catenary.Number of spans=1040", "Catenary.Uplift positions=",
                   "Statistics.Window=", "Catenary/Contact wire/Element size=0.25",
                   "Catenary/Messenger wire/Element size=0.25"});
  const verification::InterfaceProblem problem(parameters.scene(), 256);
  const double n_dofs = problem.structure.n_dofs(), before = status("VmRSS");
  ASSERT_GT(n_dofs, 9.9e5);
  ASSERT_GT(before, 0.);

  const auto solution = problem.solve(10., {"matrix-free", "Dirichlet", "rigid body modes"}, 1e-9);
  const double peak = status("VmHWM");
  EXPECT_TRUE(solution.is_solved);
  EXPECT_GE(solution.multiplier.size(), 10000u);

  // Block-tridiagonal: D and L, and pivots, their inverses and multipliers from either end, 2 x 2 a
  // node of 2 DoFs.
  const double vector = 8. * n_dofs, factors = 16. * vector;
  std::cout << "figure | constraints | " << solution.multiplier.size() << " 1\n"
            << "figure | iterations | " << solution.statistics.n_iterations << " 1\n"
            << "figure | peak over 17 vectors and factors | " << peak / (17. * vector + factors)
            << " 1\nfigure | added by the solve over factors and 4 vectors | "
            << (peak - before) / (4. * vector + factors) << " 1\n";
  EXPECT_LT(peak, 10. * (17. * vector + factors));
  EXPECT_LT(peak - before, 4. * (4. * vector + factors));
}

TEST(InterfaceMemory, of_many_droppers_on_strings_at_rest)
{
  constexpr int n_spans = 800, n_droppers = 9 * n_spans;
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << 5; // VmHWM begins anew
  const double before = status("VmRSS");
  std::size_t n_links = 0;
  verification::run_scene(
      verification::scene_file("en50318_2002_string"),
      {"Catenary/Number of spans=" + std::to_string(n_spans),
       "Catenary/Contact wire/Element size=60", "Catenary/Messenger wire/Element size=60",
       "Solver/Interface operator=matrix-free", "Partition/Number of substructures=4"},
      [&](const taut::StepView &view) { n_links = view.scene.links.size(); });
  EXPECT_EQ(n_links, static_cast<std::size_t>(n_droppers));
  const double added = (status("VmHWM") - before) / n_droppers;
  std::cout << "figure | added by an equilibrium [bytes a dropper] | " << added << " 1\n";
  EXPECT_LT(added, 14e3);
  EXPECT_GT(added, 1e3);
}
