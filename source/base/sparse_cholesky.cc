// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/instruction_set.h"
#include <taut/base/sparse_cholesky.h>

#include <cholmod.h>

#include <cmath>
#include <new>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

namespace taut
{
  void MatrixEntries::compress()
  {
    std::vector<std::size_t> order(size());
    std::iota(order.begin(), order.end(), 0);
    const auto position = [&](const std::size_t k) { return std::make_pair(row[k], column[k]); };
    std::stable_sort(order.begin(), order.end(),
                     [&](const std::size_t a, const std::size_t b)
                     { return position(a) < position(b); });
    const auto is_next = [&](const std::size_t k)
    { return k == 0 || position(order[k]) != position(order[k - 1]); };
    std::size_t n = 0;
    for (std::size_t k = 0; k < order.size(); ++k)
      n += is_next(k);
    MatrixEntries sorted;
    sorted.row.reserve(n);
    sorted.column.reserve(n);
    sorted.value.reserve(n);
    for (std::size_t k = 0; k < order.size(); ++k)
      if (is_next(k))
        sorted.add(row[order[k]], column[order[k]], value[order[k]]);
      else
        sorted.value.back() += value[order[k]];
    *this = std::move(sorted);
  }

  void SymmetricEntries::vmult_add(const std::vector<double> &x, std::vector<double> &y) const
  {
    for (std::size_t k = 0; k < size(); ++k)
    {
      y[row[k]] += value[k] * x[column[k]];
      if (row[k] != column[k])
        y[column[k]] += value[k] * x[row[k]];
    }
  }

  namespace
  {
    /// Throws what a failure of CHOLMOD is: a lack of memory, or a call that it does not take.
    [[noreturn]] void fail(const cholmod_common &common, const char *const what)
    {
      if (common.status == CHOLMOD_OUT_OF_MEMORY || common.status == CHOLMOD_TOO_LARGE)
        throw std::bad_alloc();
      throw std::runtime_error(std::string("CHOLMOD failed to ") + what + ": status " +
                               std::to_string(common.status));
    }
  } // namespace

  struct SparseCholesky::Workspace
  {
    explicit Workspace(const CholeskyMethod method)
    {
      cholmod_start(&common);
      common.supernodal = method == CholeskyMethod::simplicial   ? CHOLMOD_SIMPLICIAL
                          : method == CholeskyMethod::supernodal ? CHOLMOD_SUPERNODAL
                                                                 : CHOLMOD_AUTO;
      common.supernodal_switch = least_supernodal_flops;
      common.final_ll = 0;
      common.print = 0;
    }
    Workspace(const Workspace &) = delete;
    Workspace &operator=(const Workspace &) = delete;
    ~Workspace()
    {
      cholmod_free_sparse(&matrix, &common);
      cholmod_free_dense(&result, &common);
      cholmod_free_dense(&workspace_y, &common);
      cholmod_free_dense(&workspace_e, &common);
      cholmod_free_factor(&factors, &common);
      cholmod_finish(&common);
    }

    /// A matrix of @p n rows, of the caller.
    cholmod_sparse *compressed(const std::size_t n, const SymmetricEntries &entries)
    {
      cholmod_triplet triplet{};
      triplet.nrow = triplet.ncol = n;
      triplet.nzmax = triplet.nnz = entries.size();
      triplet.i = const_cast<int *>(entries.row.data()); // CHOLMOD reads them only
      triplet.j = const_cast<int *>(entries.column.data());
      triplet.x = const_cast<double *>(entries.value.data());
      triplet.stype = -1; // lower triangle
      triplet.itype = CHOLMOD_INT;
      triplet.xtype = CHOLMOD_REAL;
      triplet.dtype = CHOLMOD_DOUBLE;
      cholmod_sparse *result = cholmod_triplet_to_sparse(&triplet, entries.size(), &common);
      if (!result)
        fail(common, "sort a matrix");
      return result;
    }

    /// Takes a matrix, and orders it unless it has the pattern of the last one.
    void order(const std::size_t n, const SymmetricEntries &entries)
    {
      cholmod_sparse *const next = compressed(n, entries);
      const bool is_new = !factors || !has_pattern_of(*next);
      cholmod_free_sparse(&matrix, &common);
      matrix = next;
      if (!is_new)
        return;
      cholmod_free_factor(&factors, &common);
      factors = cholmod_analyze(matrix, &common);
      if (!factors)
        fail(common, "order a matrix");
      n_of_factor = static_cast<std::size_t>(common.lnz);
    }

    /// True if @p other has the pattern of the last matrix.
    bool has_pattern_of(const cholmod_sparse &other) const
    {
      if (!matrix || matrix->nrow != other.nrow)
        return false;
      const auto *p = static_cast<const int *>(matrix->p), *q = static_cast<const int *>(other.p);
      const auto *i = static_cast<const int *>(matrix->i), *j = static_cast<const int *>(other.i);
      return std::equal(p, p + matrix->nrow + 1, q) && std::equal(i, i + p[matrix->nrow], j);
    }

    /// A simplicial solve transposes its workspace, and CHOLMOD would allocate another one for the
    /// next solve: its memory is that of four rows.
    void restore_workspace()
    {
      if (!workspace_y || factors->is_super)
        return;
      workspace_y->nrow = workspace_y->d = 4;
      workspace_y->ncol = workspace_y->nzmax / 4;
    }

    /// The row of the first pivot that is too small, or the number of rows.
    std::size_t first_bad_pivot(const double smallest_pivot) const
    {
      const auto *permutation = static_cast<const int *>(factors->Perm);
      std::size_t k = 0;
      const auto is_bad = [&](const double pivot)
      { return k >= factors->minor || !(pivot > smallest_pivot * diagonal[permutation[k]]); };
      const auto *value = static_cast<const double *>(factors->x);
      if (factors->is_super)
      {
        // Each block has its columns one after another, with L on its diagonal; pivots are squares.
        const auto *first = static_cast<const int *>(factors->super);
        const auto *row = static_cast<const int *>(factors->pi);
        const auto *start = static_cast<const int *>(factors->px);
        for (std::size_t s = 0; s < factors->nsuper; ++s)
        {
          const std::size_t n_rows = row[s + 1] - row[s];
          const double *entry = value + start[s];
          for (; k < static_cast<std::size_t>(first[s + 1]); ++k, entry += n_rows + 1)
            if (is_bad(*entry * *entry))
              return permutation[k];
        }
        return factors->n;
      }
      const auto *start = static_cast<const int *>(factors->p);
      for (; k < factors->n; ++k)
        if (is_bad(value[start[k]])) // D is the first entry of a column
          return permutation[k];
      return factors->n;
    }

    /// The elimination tree of the factor: of its columns, or of its blocks of columns.
    void set_tree()
    {
      const std::size_t n = factors->n;
      const auto *permutation = static_cast<const int *>(factors->Perm);
      position.resize(n);
      for (std::size_t k = 0; k < n; ++k)
        position[permutation[k]] = static_cast<int>(k);
      node_of.resize(n);
      std::iota(node_of.begin(), node_of.end(), 0);
      parent.assign(factors->is_super ? factors->nsuper : n, -1);
      if (factors->is_super)
      {
        const auto *first = static_cast<const int *>(factors->super);
        const auto *start = static_cast<const int *>(factors->pi);
        const auto *row = static_cast<const int *>(factors->s);
        for (std::size_t s = 0; s < factors->nsuper; ++s)
          std::fill(node_of.begin() + first[s], node_of.begin() + first[s + 1],
                    static_cast<int>(s));
        for (std::size_t s = 0; s < factors->nsuper; ++s)
          if (const int n_columns = first[s + 1] - first[s]; start[s + 1] - start[s] > n_columns)
            parent[s] = node_of[row[start[s] + n_columns]];
      }
      else
      {
        const auto *start = static_cast<const int *>(factors->p);
        const auto *length = static_cast<const int *>(factors->nz);
        const auto *row = static_cast<const int *>(factors->i);
        for (std::size_t k = 0; k < n; ++k)
          if (length[k] > 1)
            parent[k] = row[start[k] + 1];
      }
      is_on_path.assign(parent.size(), 0);
      rest.assign(n * lanes, 0.);
      has_tree = true;
    }

    /// Eliminates column k of a factor from the rows below.
    void eliminate(const int *const row, const double *const entry, const int n, double *const from)
    {
      for (int e = 0; e < n; ++e)
      {
        double *const to = rest.data() + lanes * row[e];
#pragma omp simd
        for (std::size_t l = 0; l < lanes; ++l)
          to[l] -= entry[e] * from[l];
      }
    }

    /// Column k of LDL^T: its entries of y, and the elimination from the rows below.
    void eliminate_column(const int k, SparseHalves &y)
    {
      const int begin = static_cast<const int *>(factors->p)[k];
      const double *const value = static_cast<const double *>(factors->x) + begin;
      double from[lanes];
      take(k, 1., from);
      eliminate(static_cast<const int *>(factors->i) + begin + 1, value + 1,
                static_cast<const int *>(factors->nz)[k] - 1, from);
      add(k, 1. / std::sqrt(*value), from, y);
    }

    /// Block s of LL^T: its entries of y, and the elimination from the rows below.
    void eliminate_block(const int s, SparseHalves &y)
    {
      const auto *first = static_cast<const int *>(factors->super);
      const auto *start = static_cast<const int *>(factors->pi);
      const int *const row = static_cast<const int *>(factors->s) + start[s];
      const auto *value =
          static_cast<const double *>(factors->x) + static_cast<const int *>(factors->px)[s];
      const int n_rows = start[s + 1] - start[s];
      for (int k = first[s], c = 0; k < first[s + 1]; ++k, ++c, value += n_rows)
      {
        double from[lanes];
        take(k, 1. / value[c], from);
        eliminate(row + c + 1, value + c + 1, n_rows - c - 1, from);
        add(k, 1., from, y);
      }
    }

    /// Takes row k out of the remaining right-hand sides.
    void take(const int k, const double factor, double *const to)
    {
      double *const from = rest.data() + lanes * k;
      for (std::size_t l = 0; l < lanes; ++l)
      {
        to[l] = factor * from[l];
        from[l] = 0.;
      }
    }

    static void add(const int k, const double factor, const double *const from, SparseHalves &y)
    {
      y.index.push_back(k);
      for (std::size_t l = 0; l < lanes; ++l)
        y.value.push_back(factor * from[l]);
    }

    static constexpr std::size_t lanes = SparseHalves::lanes;
    cholmod_common common;
    cholmod_sparse *matrix = nullptr; ///< pattern of the lower triangle factored last
    cholmod_factor *factors = nullptr;
    std::size_t n_of_factor = 0; ///< entries
    cholmod_dense *result = nullptr, *workspace_y = nullptr, *workspace_e = nullptr;
    std::vector<double> diagonal;

    bool has_tree = false;        ///< of the factor at hand
    std::vector<int> position;    ///< of each row in the order of the factor
    std::vector<int> node_of;     ///< of the tree, of each column
    std::vector<int> parent;      ///< of each node; -1: a root
    std::vector<int> path;        ///< nodes
    std::vector<char> is_on_path; ///< of each node; 0 but within half_solutions()
    std::vector<double> rest;     ///< of right-hand sides; 0 but within half_solutions()
  };

  SparseCholesky::SparseCholesky(const CholeskyMethod method)
      : work(std::make_unique<Workspace>(method))
  {
  }

  SparseCholesky::SparseCholesky(SparseCholesky &&) noexcept = default;
  SparseCholesky &SparseCholesky::operator=(SparseCholesky &&) noexcept = default;
  SparseCholesky::~SparseCholesky() = default;

  std::size_t SparseCholesky::factor(const std::size_t n, const SymmetricEntries &entries,
                                     const double smallest_pivot)
  {
    Workspace &w = *work;
    w.has_tree = false;
    w.diagonal.assign(n, 0.);
    for (std::size_t k = 0; k < entries.size(); ++k)
      if (entries.row[k] == entries.column[k])
        w.diagonal[entries.row[k]] += entries.value[k];

    // CHOLMOD takes no matrix without entries.
    if (n == 0 || entries.size() == 0)
    {
      cholmod_free_factor(&w.factors, &w.common);
      cholmod_free_sparse(&w.matrix, &w.common);
      return 0;
    }
    w.order(n, entries);
    if (!cholmod_factorize(w.matrix, w.factors, &w.common) || w.common.status < CHOLMOD_OK)
      fail(w.common, "factor a matrix");
    cholmod_sparse_xtype(CHOLMOD_PATTERN, w.matrix, &w.common);
    return w.first_bad_pivot(smallest_pivot);
  }

  std::size_t SparseCholesky::order(const std::size_t n, const SymmetricEntries &positions)
  {
    if (n == 0)
      return 0;
    Workspace &w = *work;
    w.order(n, positions);
    cholmod_sparse_xtype(CHOLMOD_PATTERN, w.matrix, &w.common);
    return w.n_of_factor;
  }

  void SparseCholesky::solve(std::vector<double> &x) const
  {
    if (x.empty())
      return;
    Workspace &w = *work;
    cholmod_dense rhs{};
    rhs.nrow = rhs.d = rhs.nzmax = x.size();
    rhs.ncol = 1;
    rhs.x = x.data();
    rhs.xtype = CHOLMOD_REAL;
    rhs.dtype = CHOLMOD_DOUBLE;
    w.restore_workspace();
    if (!cholmod_solve2(CHOLMOD_A, w.factors, &rhs, nullptr, &w.result, nullptr, &w.workspace_y,
                        &w.workspace_e, &w.common))
      fail(w.common, "solve");
    const auto *solution = static_cast<const double *>(w.result->x);
    std::copy(solution, solution + x.size(), x.begin());
  }

  void SparseCholesky::half_solutions(const std::vector<const LinearForm *> &b,
                                      SparseHalves &y) const
  {
    Workspace &w = *work;
    if (!w.has_tree)
      w.set_tree();
    w.path.clear();
    for (std::size_t l = 0; l < b.size(); ++l)
      for (std::size_t e = 0; e < b[l]->index.size(); ++e)
      {
        const int k = w.position[b[l]->index[e]];
        w.rest[Workspace::lanes * k + l] += b[l]->value[e];
        for (int node = w.node_of[k]; node >= 0 && !w.is_on_path[node]; node = w.parent[node])
        {
          w.is_on_path[node] = 1;
          w.path.push_back(node);
        }
      }
    std::sort(w.path.begin(), w.path.end());
    y.index.clear();
    y.value.clear();
    vectorised(
        [&w, &y]
        {
          for (const int node : w.path)
          {
            w.is_on_path[node] = 0;
            if (w.factors->is_super)
              w.eliminate_block(node, y);
            else
              w.eliminate_column(node, y);
          }
        });
  }

  bool SparseCholesky::is_supernodal() const
  {
    return work->factors && work->factors->is_super;
  }

  double SparseCholesky::flops_per_entry() const
  {
    return work->factors ? work->common.fl / work->common.lnz : 0.;
  }

  std::size_t SparseCholesky::n_entries() const
  {
    if (!work->factors)
      return 0;
    return work->factors->is_super ? work->factors->xsize : work->factors->nzmax;
  }

  std::vector<unsigned int> fill_reducing_order(const std::size_t n,
                                                const SymmetricEntries &positions)
  {
    if (positions.size() == 0)
    {
      std::vector<unsigned int> as_given(n);
      std::iota(as_given.begin(), as_given.end(), 0);
      return as_given;
    }
    SparseCholesky::Workspace w(CholeskyMethod::simplicial);
    w.order(n, positions);
    const auto *order = static_cast<const int *>(w.factors->Perm);
    return std::vector<unsigned int>(order, order + n);
  }

  std::size_t SparseCholesky::memory_consumption() const
  {
    if (!work->factors)
      return 0;
    const cholmod_factor &f = *work->factors;
    if (f.is_super)
      return f.xsize * sizeof(double) + (f.ssize + 2 * f.n + 3 * (f.nsuper + 1)) * sizeof(int);
    return f.nzmax * (sizeof(double) + sizeof(int)) + 6 * f.n * sizeof(int);
  }
} // namespace taut
