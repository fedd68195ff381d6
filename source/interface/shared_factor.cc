// SPDX-License-Identifier: LGPL-2.1-or-later
#include "interface/shared_factor.h"
#include "base/dealt_numbers.h"
#include "base/gather_entries.h"

#include <Amesos_Mumps.h>
#include <Epetra_FECrsMatrix.h>
#include <Epetra_LinearProblem.h>
#include <Epetra_Map.h>
#include <Epetra_MpiComm.h>
#include <Epetra_Vector.h>
#include <Teuchos_ParameterList.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace taut
{
  /// Rows and factor of a matrix, scaled to a diagonal of 1, of which each rank has a share.
  class SharedFactor::Shares
  {
  public:
    Shares(const Communicator &processes, const std::size_t n, const SymmetricEntries &entries,
           const double smallest_pivot)
        : processes(processes), comm(processes.of_mpi()), map(static_cast<int>(n), 0, comm),
          A(::Copy, map, 0), x(map), b(map), problem(&A, &x, &b), scale(n, 0.)
    {
      for (std::size_t e = 0; e < entries.size(); ++e)
        if (entries.row[e] == entries.column[e])
          scale[entries.row[e]] += entries.value[e];
      processes.sum(scale);
      for (double &s : scale)
        s = s > 0. ? 1. / std::sqrt(s) : 1.;
      for (std::size_t e = 0; e < entries.size(); ++e)
      {
        int i = entries.row[e], j = entries.column[e];
        double value = entries.value[e] * scale[i] * scale[j];
        A.InsertGlobalValues(1, &i, 1, &j, &value);
        if (i != j)
          A.InsertGlobalValues(1, &j, 1, &i, &value);
      }
      check(A.GlobalAssemble(), "gather rows for");
      solver = std::make_unique<Amesos_Mumps>(problem);
      Teuchos::ParameterList parameters;
      parameters.set("MaxProcs", -1); // all
      parameters.set("MatrixProperty", "symmetric");
      solver->SetParameters(parameters);
      constexpr int finds_null_pivots = 24, more_memory = 14, least_pivot = 3;
      solver->SetICNTL(finds_null_pivots, 1);
      solver->SetICNTL(more_memory, 50); // per cent above the estimate, for pivots that are delayed
      solver->SetCNTL(least_pivot, -smallest_pivot); // negative: not times a norm
      check(solver->SymbolicFactorization(), "order");
      check(solver->NumericFactorization(), "factor");
      constexpr int n_null_pivots = 28 - 1;
      is_definite = !processes.any(processes.is_root() && solver->GetINFOG()[n_null_pivots] > 0);
    }

    void solve(std::vector<double> &values) const
    {
      const int first = map.MinMyGID();
      for (int i = 0; i < map.NumMyElements(); ++i)
        b[i] = values[first + i] * scale[first + i];
      check(solver->Solve(), "solve");
      std::fill(values.begin(), values.end(), 0.);
      for (int i = 0; i < map.NumMyElements(); ++i)
        values[first + i] = x[i] * scale[first + i];
      processes.sum(values);
    }

    bool is_definite = false;

  private:
    static void check(const int error, const char *const what)
    {
      if (error != 0)
        throw std::runtime_error(std::string("MUMPS failed to ") + what +
                                 " a matrix of the interface: error " + std::to_string(error));
    }

    const Communicator processes;
    const Epetra_MpiComm comm;
    const Epetra_Map map;
    Epetra_FECrsMatrix A;
    mutable Epetra_Vector x, b;
    Epetra_LinearProblem problem;
    std::unique_ptr<Amesos_Mumps> solver;
    std::vector<double> scale;
  };

  SharedFactor::SharedFactor(const Communicator &processes, const std::size_t largest_whole)
      : processes(processes), largest_whole(largest_whole)
  {
  }

  SharedFactor::SharedFactor(SharedFactor &&) noexcept = default;
  SharedFactor &SharedFactor::operator=(SharedFactor &&) noexcept = default;
  SharedFactor::~SharedFactor() = default;

  bool SharedFactor::is_shared(const std::size_t n) const
  {
    if (processes.size() == 1 || n <= largest_whole)
      return false;
    int same = MPI_UNEQUAL;
    MPI_Comm_compare(processes.of_mpi(), MPI_COMM_WORLD, &same);
    return same == MPI_IDENT || same == MPI_CONGRUENT;
  }

  bool SharedFactor::factor(const std::size_t n, SymmetricEntries entries,
                            const double smallest_pivot)
  {
    shares.reset();
    if (is_shared(n))
    {
      shares = std::make_unique<Shares>(processes, n, entries, smallest_pivot);
      return shares->is_definite;
    }
    gather(processes, entries);
    entries.compress();
    return whole.factor(n, entries, smallest_pivot) == n;
  }

  bool SharedFactor::factor_of_all(const std::size_t n, const SymmetricEntries &entries,
                                   const double smallest_pivot)
  {
    if (!is_shared(n))
    {
      shares.reset();
      return whole.factor(n, entries, smallest_pivot) == n;
    }
    const DealtNumbers dealt(processes, n);
    SymmetricEntries own;
    for (std::size_t e = 0; e < entries.size(); ++e)
      if (dealt.rank_of(entries.row[e]) == processes.rank())
        own.add(entries.row[e], entries.column[e], entries.value[e]);
    return factor(n, std::move(own), smallest_pivot);
  }

  void SharedFactor::solve(std::vector<double> &x) const
  {
    if (shares)
      shares->solve(x);
    else
      whole.solve(x);
  }
} // namespace taut
