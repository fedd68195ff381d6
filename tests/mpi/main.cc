// SPDX-License-Identifier: LGPL-2.1-or-later
// Runs the same tests on all ranks; only the root prints.
#include <taut/base/communicator.h>

#include <gtest/gtest.h>

#include <cstdio>

int main(int argc, char **argv)
{
  testing::InitGoogleTest(&argc, argv);
  taut::start_mpi();
  const taut::Communicator processes(MPI_COMM_WORLD);
  if (!processes.is_root() && !std::freopen("/dev/null", "w", stdout))
    return 1;
  return processes.max(RUN_ALL_TESTS()) > 0.;
}
