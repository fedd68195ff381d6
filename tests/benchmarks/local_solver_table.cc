// SPDX-License-Identifier: LGPL-2.1-or-later
// Factors and solves with A = m M + K of elastic squares, cubes and strips clamped at one side, by
// CHOLMOD simplicial, CHOLMOD supernodal and UMFPACK as deal.II calls it, as a Markdown table.
// Seconds are processor time, the least of the runs. Usage: local_solver_table [runs] [largest
// number of DoFs] [strip|square|cube].
#include <taut/base/sparse_cholesky.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/full_matrix.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <stdexcept>
#include <string>
#include <umfpack.h>
#include <vector>

namespace
{
  /// Work that takes longer is run once; the factorisation is then that of the set-up.
  constexpr double longest_repeated = 1.; // s

  struct Matrix
  {
    std::size_t n = 0;
    taut::SymmetricEntries entries; ///< each position once
  };

  struct Costs
  {
    double set_up = 0.;   ///< seconds for order, pattern and numbers
    double factor = 0.;   ///< seconds for the numbers again
    double solve = 0.;    ///< seconds for one right-hand side
    double residual = 0.; ///< largest |A x - b| over largest |b|
    std::size_t n_entries = 0, bytes = 0;
  };

  /// Steel, with the mass of a step in which a wave passes an element.
  template <int dim>
  Matrix elastic(const unsigned int degree, const std::vector<unsigned int> &cells)
  {
    const double E = 2.1e11, nu = .3, rho = 7850.;
    const double lambda = E * nu / ((1. + nu) * (1. - 2. * nu)), mu = E / (2. * (1. + nu));
    dealii::Triangulation<dim> mesh;
    dealii::Point<dim> far;
    for (unsigned int d = 0; d < dim; ++d)
      far[d] = cells[d];
    dealii::GridGenerator::subdivided_hyper_rectangle(mesh, cells, dealii::Point<dim>(), far, true);
    const dealii::FESystem<dim> fe(dealii::FE_Q<dim>(degree), dim);
    dealii::DoFHandler<dim> dofs(mesh);
    dofs.distribute_dofs(fe);

    const double step = std::sqrt(rho / (lambda + 2. * mu));
    const dealii::QGauss<dim> quadrature(degree + 1);
    dealii::FEValues<dim> values(fe, quadrature,
                                 dealii::update_values | dealii::update_gradients |
                                     dealii::update_JxW_values);
    const unsigned int n_local = fe.n_dofs_per_cell();
    dealii::FullMatrix<double> A(n_local, n_local); // one for all cells, which are equal
    values.reinit(dofs.begin_active());
    for (unsigned int i = 0; i < n_local; ++i)
      for (unsigned int j = 0; j < n_local; ++j)
      {
        const unsigned int a = fe.system_to_component_index(i).first,
                           b = fe.system_to_component_index(j).first;
        for (const unsigned int q : values.quadrature_point_indices())
        {
          const auto &u = values.shape_grad(i, q), &v = values.shape_grad(j, q);
          double sum = lambda * u[a] * v[b] + mu * u[b] * v[a];
          if (a == b)
            sum += mu * (u * v) +
                   4. * rho / (step * step) * values.shape_value(i, q) * values.shape_value(j, q);
          A(i, j) += sum * values.JxW(q);
        }
      }

    const auto clamped =
        dealii::DoFTools::extract_boundary_dofs(dofs, dealii::ComponentMask(), {0});
    Matrix matrix;
    matrix.n = dofs.n_dofs();
    std::vector<dealii::types::global_dof_index> index(n_local);
    for (const auto &cell : dofs.active_cell_iterators())
    {
      cell->get_dof_indices(index);
      for (unsigned int i = 0; i < n_local; ++i)
        for (unsigned int j = 0; j < n_local; ++j)
          if (index[j] <= index[i] && !clamped.is_element(index[i]) &&
              !clamped.is_element(index[j]))
            matrix.entries.add(index[i], index[j], A(i, j));
    }
    for (const auto dof : clamped)
      matrix.entries.add(dof, dof, 1.);
    matrix.entries.compress();
    return matrix;
  }

  std::vector<double> right_hand_side(const std::size_t n)
  {
    std::vector<double> b(n);
    for (std::size_t i = 0; i < n; ++i)
      b[i] = std::sin(1. + 7. * i);
    return b;
  }

  double residual(const Matrix &matrix, const std::vector<double> &x)
  {
    std::vector<double> b = right_hand_side(matrix.n), product(matrix.n, 0.);
    matrix.entries.vmult_add(x, product);
    double worst = 0.;
    for (std::size_t i = 0; i < matrix.n; ++i)
      worst = std::max(worst, std::fabs(product[i] - b[i]));
    return worst;
  }

  /// Processor time of one of some runs.
  template <typename Work>
  double seconds_of(const int times, const Work &work)
  {
    const std::clock_t begin = std::clock();
    for (int i = 0; i < times; ++i)
      work();
    return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC / times;
  }

  /// The least of @p first, the time of a run before, and those of more runs, each repeated for a
  /// millisecond or more.
  template <typename Work>
  double least_seconds(const int runs, const double first, const Work &work)
  {
    double least = first;
    const int times = static_cast<int>(std::clamp(1e-3 / std::max(first, 1e-6), 1., 1000.));
    for (int i = 1; i < runs && first < longest_repeated; ++i)
      least = std::min(least, seconds_of(times, work));
    return least;
  }

  Costs cholmod(const Matrix &matrix, const taut::CholeskyMethod method, const int runs,
                double &flops_per_entry)
  {
    Costs costs;
    taut::SparseCholesky factors(method);
    const auto factor = [&](taut::SparseCholesky &solver)
    {
      if (solver.factor(matrix.n, matrix.entries, 1e-15) != matrix.n)
        throw std::runtime_error("the matrix is not definite");
    };
    const double first = seconds_of(1, [&] { factor(factors); });
    costs.set_up = least_seconds(runs, first,
                                 [&]
                                 {
                                   taut::SparseCholesky own(method);
                                   factor(own);
                                 });
    costs.factor = least_seconds(runs, first, [&] { factor(factors); });
    const std::vector<double> b = right_hand_side(matrix.n);
    std::vector<double> x;
    const auto solve = [&]
    {
      x = b;
      factors.solve(x);
    };
    costs.solve = least_seconds(4 * runs, seconds_of(1, solve), solve);
    costs.residual = residual(matrix, x);
    costs.n_entries = factors.n_entries();
    costs.bytes = factors.memory_consumption();
    flops_per_entry = factors.flops_per_entry();
    return costs;
  }

  /// What dealii::SparseDirectUMFPACK calls, with its options, which are the default ones.
  Costs umfpack(const Matrix &matrix, const int runs)
  {
    const auto check = [](const int status)
    {
      if (status != UMFPACK_OK)
        throw std::runtime_error("UMFPACK failed: " + std::to_string(status));
    };
    // Compressed columns of both triangles.
    taut::MatrixEntries full;
    for (std::size_t k = 0; k < matrix.entries.size(); ++k)
    {
      const int i = matrix.entries.row[k], j = matrix.entries.column[k];
      full.add(i, j, matrix.entries.value[k]);
      if (i != j)
        full.add(j, i, matrix.entries.value[k]);
    }
    full.compress();
    const auto n = static_cast<SuiteSparse_long>(matrix.n);
    std::vector<SuiteSparse_long> start(matrix.n + 1, 0),
        row(full.column.begin(), full.column.end());
    for (const int i : full.row)
      ++start[i + 1];
    for (std::size_t i = 0; i < matrix.n; ++i)
      start[i + 1] += start[i];

    double control[UMFPACK_CONTROL], info[UMFPACK_INFO];
    umfpack_dl_defaults(control);
    void *symbolic = nullptr, *numeric = nullptr;
    const auto analyse = [&]
    {
      umfpack_dl_free_symbolic(&symbolic);
      check(umfpack_dl_symbolic(n, n, start.data(), row.data(), full.value.data(), &symbolic,
                                control, info));
    };
    const auto factor = [&]
    {
      umfpack_dl_free_numeric(&numeric);
      check(umfpack_dl_numeric(start.data(), row.data(), full.value.data(), symbolic, &numeric,
                               control, info));
    };
    Costs costs;
    const auto set_up = [&]
    {
      analyse();
      factor();
    };
    const double first = seconds_of(1, set_up);
    costs.set_up = least_seconds(runs, first, set_up);
    costs.factor = least_seconds(runs, first, factor);
    costs.n_entries = static_cast<std::size_t>(info[UMFPACK_LNZ] + info[UMFPACK_UNZ]);
    costs.bytes = static_cast<std::size_t>(info[UMFPACK_NUMERIC_SIZE] * info[UMFPACK_SIZE_OF_UNIT]);
    const std::vector<double> b = right_hand_side(matrix.n);
    std::vector<double> x(matrix.n);
    const auto solve = [&]
    {
      check(umfpack_dl_solve(UMFPACK_A, start.data(), row.data(), full.value.data(), x.data(),
                             b.data(), numeric, control, info));
    };
    costs.solve = least_seconds(4 * runs, seconds_of(1, solve), solve);
    costs.residual = residual(matrix, x);
    umfpack_dl_free_symbolic(&symbolic);
    umfpack_dl_free_numeric(&numeric);
    return costs;
  }

  void print(const std::string &name, const Matrix &matrix, const int runs)
  {
    double flops = 0.;
    const Costs costs[] = {cholmod(matrix, taut::CholeskyMethod::simplicial, runs, flops),
                           cholmod(matrix, taut::CholeskyMethod::supernodal, runs, flops),
                           umfpack(matrix, runs)};
    std::printf("| %s | %zu | %.0f", name.c_str(), matrix.n, flops);
    const auto print_costs = [&](const auto &value)
    {
      std::printf(" | ");
      for (const Costs &c : costs)
        std::printf("%s%.2g", &c == costs ? "" : " / ", static_cast<double>(value(c)));
    };
    print_costs([](const Costs &c) { return c.set_up; });
    print_costs([](const Costs &c) { return c.factor; });
    print_costs([](const Costs &c) { return c.solve; });
    print_costs([](const Costs &c) { return c.n_entries; });
    print_costs([](const Costs &c) { return c.bytes / 1048576.; });
    print_costs([](const Costs &c) { return c.residual; });
    std::printf(" |\n");
    std::fflush(stdout);
  }
} // namespace

int main(int argc, char **argv)
{
  const int runs = argc > 1 ? std::atoi(argv[1]) : 5;
  const double largest = argc > 2 ? std::atof(argv[2]) : 1.1e5;
  const std::string only = argc > 3 ? argv[3] : "";
  std::printf(
      "Each cell: CHOLMOD simplicial / CHOLMOD supernodal / UMFPACK\n\n"
      "| body | DoFs | flops per entry | set-up [s] | factor [s] | solve [s] | entries | MiB "
      "| residual |\n|---|---|---|---|---|---|---|---|---|\n");
  for (const unsigned int degree : {1u, 2u})
  {
    const std::string element = degree == 1 ? " Q1" : " Q2";
    if (only.empty() || only == "strip")
      for (const unsigned int width : {1u, 2u, 4u, 8u}) // cells across
      {
        const unsigned int length = 4000 / width / degree;
        if (2. * (degree * length + 1) * (degree * width + 1) <= largest)
          print("strip " + std::to_string(length) + ":" + std::to_string(width) + element,
                elastic<2>(degree, {length, width}), runs);
      }
    if (only.empty() || only == "square")
      for (const unsigned int nodes : {7u, 11u, 23u, 39u, 71u, 125u, 223u})
        if (2. * nodes * nodes <= largest)
        {
          const unsigned int n = (nodes - 1) / degree;
          print("square" + element, elastic<2>(degree, {n, n}), runs);
        }
    if (only.empty() || only == "cube")
      for (const unsigned int nodes : {5u, 7u, 9u, 11u, 15u, 25u})
        if (3. * nodes * nodes * nodes <= largest)
        {
          const unsigned int n = (nodes - 1) / degree;
          print("cube" + element, elastic<3>(degree, {n, n, n}), runs);
        }
  }
}
