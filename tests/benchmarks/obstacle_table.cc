// SPDX-License-Identifier: LGPL-2.1-or-later
// A body with thousands of candidates for contact, at rest: Taut beside a primal-dual active-set
// method that factors the matrix without the closed DoFs by UMFPACK for each set.
#include "solid/obstacle_problem.h"

#include <deal.II/base/multithread_info.h>

#include <ctime>

namespace
{
  template <typename Work>
  double seconds(const Work &work)
  {
    const std::clock_t begin = std::clock();
    work();
    return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  }

  void print(const std::string &name, const obstacle::Problem &problem, const std::string &form)
  {
    obstacle::Problem::Solution ours, theirs;
    const double taut = seconds([&] { ours = problem.by_taut(form); }),
                 elimination = seconds([&] { theirs = problem.by_elimination(); });
    std::printf("| %s | %zu | %zu | %zu | %.2f | %u | %.2f | %u | %.2f |\n", name.c_str(),
                problem.n_dofs(), problem.n_candidates(),
                static_cast<std::size_t>(std::count(theirs.closed.begin(), theirs.closed.end(), 1)),
                taut, ours.n_sets, elimination, theirs.n_sets, taut / elimination);
    if (ours.closed != theirs.closed)
      std::printf("the active sets differ\n");
  }
} // namespace

int main(const int argc, char **argv)
{
  dealii::MultithreadInfo::set_thread_limit(1);
  const std::string form = argc > 1 ? argv[1] : "automatic";
  std::printf(
      "| body | DoFs | candidates | closed | Taut [s] | sets | elimination [s] | sets | ratio "
      "|\n|---|---|---|---|---|---|---|---|---|\n");
  for (const unsigned int refinements : {5u, 6u, 7u})
    print("membrane", *obstacle::Problem::membrane(refinements), form);
  for (const unsigned int n : {2u, 4u, 5u})
    print("plate", *obstacle::Problem::plate(n), form);
}
