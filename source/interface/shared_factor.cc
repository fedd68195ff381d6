// SPDX-License-Identifier: LGPL-2.1-or-later
#include "interface/shared_factor.h"
#include "base/gather_entries.h"

#include <Amesos_config.h>
#ifdef HAVE_AMESOS_MUMPS
#include <Amesos_Mumps.h>
#include <Epetra_FECrsMatrix.h>
#include <Epetra_LinearProblem.h>
#include <Epetra_Map.h>
#include <Epetra_MpiComm.h>
#include <Epetra_Vector.h>
#include <Teuchos_ParameterList.hpp>
#endif

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <stdexcept>
#include <string>

namespace taut
{
#ifdef HAVE_AMESOS_MUMPS
  constexpr bool has_mumps = true;

  /// Rows and factor LU of a matrix, scaled to a diagonal of 1, of which each rank has a share.
  /// Amesos hands MUMPS no symmetric matrices.
  class SharedFactor::Shares
  {
  public:
    Shares(const Communicator &processes, const std::size_t n, const std::size_t n_own,
           const SymmetricEntries &entries, const double smallest_pivot)
        : processes(processes), comm(processes.of_mpi()),
          map(static_cast<int>(n), static_cast<int>(n_own), 0, comm), A(::Copy, map, 0), x(map),
          b(map), problem(&A, &x, &b), scale(n, 0.)
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
      parameters.set("MaxProcs", -3); // all
      solver->SetParameters(parameters);
      // ScaLAPACK, which would factor the last front, finds no null pivots.
      constexpr int finds_null_pivots = 24, last_front_without_scalapack = 13, more_memory = 14,
                    least_pivot = 3;
      solver->SetICNTL(finds_null_pivots, 1);
      solver->SetICNTL(last_front_without_scalapack, 1);
      solver->SetCNTL(least_pivot, -smallest_pivot); // negative: not times a norm
      check(solver->SymbolicFactorization(), "order");
      // Room above the estimate [%], for pivots that are delayed.
      constexpr int first_room = 50, most_room = 800, too_little[] = {-8, -9}, singular = -10;
      int error = 0;
      for (int room = first_room; room <= most_room; room *= 2)
      {
        solver->SetICNTL(more_memory, room);
        error = solver->NumericFactorization();
        if (std::find(std::begin(too_little), std::end(too_little), status()) ==
            std::end(too_little))
          break;
      }
      if (status() != singular)
        check(error, "factor");
      constexpr int n_null_pivots = 28 - 1;
      is_definite = status() >= 0 && solver->GetINFOG()[n_null_pivots] == 0;
    }

    /// On the rows of this rank.
    void solve(double *const values) const
    {
      for (int i = 0; i < map.NumMyElements(); ++i)
        b[i] = values[i] * scale[map.GID(i)];
      solver->Solve(); // which returns no error
      check(std::min(status(), 0), "solve");
      for (int i = 0; i < map.NumMyElements(); ++i)
        values[i] = x[i] * scale[map.GID(i)];
    }

    std::size_t n_own() const { return static_cast<std::size_t>(map.NumMyElements()); }

    bool is_definite = false;

  private:
    /// That of the last call of MUMPS, on all ranks; negative: an error.
    int status() const { return solver->GetINFOG()[0]; }

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

#else
  constexpr bool has_mumps = false;

  /// No matrix is shared.
  class SharedFactor::Shares
  {
  public:
    Shares(const Communicator &, std::size_t, std::size_t, const SymmetricEntries &, double) {}
    void solve(double *) const {}
    std::size_t n_own() const { return 0; }
    bool is_definite = false;
  };
#endif

  SharedFactor::SharedFactor(const Communicator &processes, const std::size_t largest_whole)
      : processes(processes), largest_whole(largest_whole), most_gathered(largest_whole)
  {
  }

  SharedFactor::SharedFactor(SharedFactor &&) noexcept = default;
  SharedFactor &SharedFactor::operator=(SharedFactor &&) noexcept = default;
  SharedFactor::~SharedFactor() = default;

  bool SharedFactor::may_share() const
  {
    if (!has_mumps || processes.size() == 1)
      return false;
    int same = MPI_UNEQUAL;
    MPI_Comm_compare(processes.of_mpi(), MPI_COMM_WORLD, &same);
    return same == MPI_IDENT || same == MPI_CONGRUENT;
  }

  bool SharedFactor::factor(const std::size_t n_own, SymmetricEntries entries,
                            const double smallest_pivot)
  {
    std::vector<std::size_t> sizes;
    processes.gather(n_own, sizes);
    first = std::accumulate(sizes.begin(), sizes.begin() + processes.rank(), std::size_t(0));
    n = std::accumulate(sizes.begin(), sizes.end(), std::size_t(0));
    processes.gather(entries.size(), sizes);
    const std::size_t n_entries = std::accumulate(sizes.begin(), sizes.end(), std::size_t(0));
    shares.reset();
    if (!may_share() || n_entries <= most_gathered)
    {
      SymmetricEntries all_entries = may_share() ? entries : std::move(entries);
      gather(processes, all_entries);
      all_entries.compress();
      if (!may_share() || whole.order(n, all_entries) <= largest_whole)
        return whole.factor(n, all_entries, smallest_pivot) == n;
      most_gathered = n_entries - 1;
      whole = SparseCholesky(CholeskyMethod::automatic);
    }
    shares = std::make_unique<Shares>(processes, n, n_own, entries, smallest_pivot);
    return shares->is_definite;
  }

  void SharedFactor::solve(std::vector<double> &x) const
  {
    if (!shares)
      return whole.solve(x);
    const std::size_t n_own = shares->n_own();
    std::fill(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(first), 0.);
    std::fill(x.begin() + static_cast<std::ptrdiff_t>(first + n_own), x.end(), 0.);
    shares->solve(x.data() + first);
    processes.sum(x);
  }

  void SharedFactor::solve_own(std::vector<double> &x) const
  {
    if (shares)
      return shares->solve(x.data());
    all.assign(n, 0.);
    std::copy(x.begin(), x.end(), all.begin() + static_cast<std::ptrdiff_t>(first));
    processes.sum(all);
    whole.solve(all);
    std::copy_n(all.begin() + static_cast<std::ptrdiff_t>(first), x.size(), x.begin());
  }
} // namespace taut
