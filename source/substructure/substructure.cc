// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/substructure/local_solver.h>
#include <taut/substructure/substructure.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace taut
{
  namespace
  {
    /// Rows that are zero in all matrices.
    std::vector<unsigned int> zero_rows(const std::vector<const SymmetricMatrix *> &matrices)
    {
      std::vector<char> is_zero(matrices.front()->size(), 1);
      for (const SymmetricMatrix *matrix : matrices)
        matrix->visit(
            [&](const unsigned int i, const unsigned int j, const double value)
            {
              if (value != 0.)
                is_zero[i] = is_zero[j] = 0;
            });
      std::vector<unsigned int> result;
      for (unsigned int i = 0; i < is_zero.size(); ++i)
        if (is_zero[i])
          result.push_back(i);
      return result;
    }

    [[noreturn]] void refuse(const Substructure &body, const std::string &message)
    {
      throw EntryError(body.origin(), "body '" + body.name() + "': " + message);
    }

    void check_load(const Substructure &body, const std::string &fault)
    {
      if (!fault.empty())
        refuse(body, "a force on it " + fault);
    }
  } // namespace

  std::vector<unsigned int> Substructure::dofs_without_mass() const
  {
    return zero_rows({M.get()});
  }

  std::vector<unsigned int> Substructure::quasi_static_dofs() const
  {
    return zero_rows({M.get(), C.get()});
  }

  std::vector<unsigned int> Substructure::constrained_dofs() const
  {
    std::vector<unsigned int> dofs;
    for (const ConstrainedDof &constraint : constrained)
      dofs.push_back(constraint.dof);
    return dofs;
  }

  LinearForm Substructure::displacement(const Coordinates &, const Coordinates &) const
  {
    throw UserError("body '" + name() + "' has no places that a constraint could act on");
  }

  LinearForm Substructure::node_displacement(unsigned int, const Coordinates &) const
  {
    throw UserError("body '" + name() + "' has no surface that contacts could act on");
  }

  std::unique_ptr<LocalSolver> Substructure::make_solver() const
  {
    return nullptr;
  }

  void Substructure::write_vtu(const std::string &, const std::vector<double> &) const {}

  void Substructure::initial_state(std::vector<double> &U, std::vector<double> &V) const
  {
    U.assign(n_dofs(), 0.);
    V.assign(n_dofs(), 0.);
  }

  void Substructure::require_linear(const char *const function) const
  {
    if (!is_linear())
      throw UserError("body '" + name() + "' says that it is not linear, and does not override " +
                      function + "(); what Substructure has is for linear bodies");
  }

  double Substructure::strain_energy(const std::vector<double> &U) const
  {
    require_linear("strain_energy");
    std::vector<double> f(U.size(), 0.);
    K->vmult_add(.5, U.data(), f.data());
    return std::inner_product(U.begin(), U.end(), f.begin(), 0.);
  }

  void Substructure::internal_force(const std::vector<double> &U, const std::vector<double> &,
                                    std::vector<double> &f) const
  {
    require_linear("internal_force");
    f.assign(U.size(), 0.);
    K->vmult_add(1., U.data(), f.data());
  }

  void Substructure::mean_internal_force(const std::vector<double> &U0,
                                         const std::vector<double> &U1, double,
                                         std::vector<double> &f) const
  {
    require_linear("mean_internal_force");
    f.assign(U0.size(), 0.);
    K->vmult_add(.5, U0.data(), f.data());
    K->vmult_add(.5, U1.data(), f.data());
  }

  std::unique_ptr<SymmetricMatrix> Substructure::tangent(const std::vector<double> &,
                                                         const std::vector<double> &, double,
                                                         bool) const
  {
    require_linear("tangent");
    return K->clone();
  }

  std::unique_ptr<SymmetricMatrix> Substructure::mean_tangent(const std::vector<double> &U0,
                                                              const std::vector<double> &U1,
                                                              const double rate,
                                                              const bool definite) const
  {
    std::vector<double> U = U0, V = U0;
    for (std::size_t i = 0; i < U.size(); ++i)
    {
      U[i] = .5 * (U0[i] + U1[i]);
      V[i] = .5 * rate * (U1[i] - U0[i]);
    }
    return tangent(U, V, rate, definite);
  }

  void Substructure::external_force(const double t, std::vector<double> &P) const
  {
    P = constant_force;
    for (const auto &load : time_loads)
      load->add(t, P);
  }

  void Substructure::add_force(const LinearForm &form, const double magnitude)
  {
    check_load(*this, form.fault(constant_force.size()));
    check_load(*this, std::isfinite(magnitude) ? "" : "has no finite magnitude");
    form.add_to(magnitude, constant_force);
  }

  void Substructure::add_force(const LinearForm &form, std::function<double(double)> magnitude)
  {
    auto load = std::make_unique<PointLoad>(form, std::move(magnitude));
    check_load(*this, load->fault(constant_force.size()));
    time_loads.push_back(std::move(load));
  }

  /// Checks sizes of the members that a derived class fills.
  void Substructure::check_sizes() const
  {
    const std::pair<const char *, const SymmetricMatrix *> matrices[] = {
        {"M", M.get()}, {"C", C.get()}, {"K", K.get()}};
    for (const auto &[letter, matrix] : matrices)
      if (!matrix)
        refuse(*this, std::string("it has no matrix ") + letter + "; make one before finish()");
    const std::size_t n = n_dofs();
    if (n == 0)
      refuse(*this, "it has no DoF; leave it out");
    for (const auto &[letter, matrix] : matrices)
      if (matrix->size() != n)
        refuse(*this, std::string("its matrix ") + letter + " has " +
                          std::to_string(matrix->size()) + " rows, and K has " + std::to_string(n));
    if (constant_force.size() != n)
      refuse(*this, "its constant force has " + std::to_string(constant_force.size()) +
                        " entries, and it has " + std::to_string(n) + " DoFs");
    if (kinds.empty() || *std::max_element(kinds.begin(), kinds.end()) > 1)
      refuse(*this, "its kinds of DoFs are 0, a displacement, or 1, a rotation, and at least one");
    for (const ConstrainedDof &constraint : constrained)
      if (constraint.dof >= n)
        refuse(*this, "it prescribes DoF " + std::to_string(constraint.dof) + ", and has " +
                          std::to_string(n) + ", counted from 0");
    for (const auto &load : time_loads)
    {
      if (!load)
        refuse(*this, "one of its loads in time is nullptr; leave it out");
      if (const auto *const point = dynamic_cast<const PointLoad *>(load.get()))
        check_load(*this, point->fault(n));
    }
  }

  void Substructure::check_numbers() const
  {
    bool finite = true;
    for (const SymmetricMatrix *matrix : {M.get(), C.get(), K.get()})
      matrix->visit([&](unsigned int, unsigned int, double value)
                    { finite = finite && std::isfinite(value); });
    for (const double force : constant_force)
      finite = finite && std::isfinite(force);
    if (!finite)
      refuse(*this, "its mass, damping, stiffness or load is beyond the range "
                    "of numbers; take less extreme values");
    M->visit(
        [&](const unsigned int i, const unsigned int j, const double value)
        {
          if (i == j && value < 0.)
            refuse(*this, "the mass of DoF " + std::to_string(i) +
                              " is negative; take a positive one, or zero");
        });
  }

  void Substructure::check_consistency() const
  {
    if (!is_finished)
      refuse(*this, "it is not finished; call finish() at the end of its constructor");
    const NullSpace motions = null_space();
    const std::size_t n = n_dofs();
    std::vector<char> is_fixing(n, 0);
    if (motions.fixing_dofs.size() != motions.vectors.size())
      refuse(*this, "its null space has " + std::to_string(motions.vectors.size()) +
                        " vectors and " + std::to_string(motions.fixing_dofs.size()) +
                        " DoFs that fix them; give as many");
    for (std::size_t v = 0; v < motions.vectors.size(); ++v)
    {
      const std::vector<double> &R = motions.vectors[v];
      if (R.size() != n)
        refuse(*this, "a vector of its null space has " + std::to_string(R.size()) +
                          " entries, and it has " + std::to_string(n) + " DoFs");
      if (!std::all_of(R.begin(), R.end(), [](const double x) { return std::isfinite(x); }))
        refuse(*this, "a vector of its null space has an entry that is no finite number");
      const unsigned int dof = motions.fixing_dofs[v];
      if (dof >= n || is_fixing[dof])
        refuse(*this, "DoF " + std::to_string(dof) +
                          " cannot fix its null space: it has no such DoF, or it is named twice");
      is_fixing[dof] = 1;
    }
  }

  void Substructure::finish()
  {
    check_sizes();
    std::sort(constrained.begin(), constrained.end(),
              [](const auto &p, const auto &q) { return p.dof < q.dof; });
    for (std::size_t i = 0; i < constrained.size(); ++i)
    {
      if (i > 0 && constrained[i].dof == constrained[i - 1].dof)
        throw EntryError(
            origin(), name() + ": two supports hold the same motion of the same point; remove one");
      moving_constraints = moving_constraints || constrained[i].motion;
      displaced_constraints =
          displaced_constraints || constrained[i].motion || constrained[i].displacement != 0.;
    }

    check_numbers();
    for (SymmetricMatrix *matrix : {M.get(), C.get(), K.get()})
      matrix->find_repetitions();
    is_finished = true;
  }
} // namespace taut
