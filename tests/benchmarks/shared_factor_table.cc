// SPDX-License-Identifier: LGPL-2.1-or-later
// The factor of the coarse problem of a cube in n^3 parts, six motions each that meet those of the
// parts around: whole on each rank, or shared by all ranks. Prints rows, seconds of the factor and
// of a solve, and the peak memory of a rank [GB]. Arguments: n, and 'whole' or 'shared'.
#include "interface/shared_factor.h"

#include <mpi.h>

#include <sys/resource.h>

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <string>

namespace
{
  double seconds()
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
  }
} // namespace

int main(int argc, char **argv)
{
  MPI_Init(&argc, &argv);
  {
    if (argc != 3)
      return EXIT_FAILURE;
    const taut::Communicator processes(MPI_COMM_WORLD);
    const int n = std::atoi(argv[1]);
    constexpr int n_modes = 6;
    const std::size_t rows = static_cast<std::size_t>(n * n * n) * n_modes;
    taut::SymmetricEntries share; // of a stretch of parts
    int part = 0;
    for (int z = 0; z < n; ++z)
      for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x, ++part)
        {
          if (static_cast<std::size_t>(part) * processes.size() / (rows / n_modes) !=
              processes.rank())
            continue;
          for (int dz = -1; dz <= 1; ++dz)
            for (int dy = -1; dy <= 1; ++dy)
              for (int dx = -1; dx <= 1; ++dx)
              {
                const int a = x + dx, b = y + dy, c = z + dz, other = (c * n + b) * n + a;
                if (a < 0 || b < 0 || c < 0 || a >= n || b >= n || c >= n || other > part)
                  continue;
                for (int i = 0; i < n_modes; ++i)
                  for (int j = 0; j < n_modes; ++j)
                    if (other != part)
                      share.add(n_modes * part + i, n_modes * other + j, i == j ? -1. : .1);
                    else if (j <= i)
                      share.add(n_modes * part + i, n_modes * part + j, i == j ? 45. : .1);
              }
        }
    constexpr std::size_t largest = std::numeric_limits<std::size_t>::max();
    taut::SharedFactor factor(processes, argv[2] == std::string("whole") ? largest : 0);
    const double begin = seconds();
    const bool is_definite = factor.factor(factor.even_share(rows), share, 1e-12);
    const double factored = seconds();
    std::vector<double> x(rows, 1.);
    constexpr int n_solves = 5;
    for (int i = 0; i < n_solves; ++i)
      factor.solve(x);
    const double solved = seconds();
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    if (processes.is_root())
      std::cout << rows << ' ' << argv[2] << (is_definite ? " factor " : " not definite ")
                << factored - begin << " s, solve " << (solved - factored) / n_solves << " s, "
                << usage.ru_maxrss / 1e6 << " GB\n";
  }
  MPI_Finalize();
}
