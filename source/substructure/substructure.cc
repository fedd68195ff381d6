// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/substructure/local_solver.h>
#include <taut/substructure/substructure.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace taut
{
  namespace
  {
    /// Rows that are zero in all of the matrices.
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

  double Substructure::strain_energy(const std::vector<double> &U) const
  {
    std::vector<double> f(U.size(), 0.);
    K->vmult_add(.5, U.data(), f.data());
    return std::inner_product(U.begin(), U.end(), f.begin(), 0.);
  }

  void Substructure::internal_force(const std::vector<double> &U, const std::vector<double> &,
                                    std::vector<double> &f) const
  {
    f.assign(U.size(), 0.);
    K->vmult_add(1., U.data(), f.data());
  }

  void Substructure::mean_internal_force(const std::vector<double> &U0,
                                         const std::vector<double> &U1, double,
                                         std::vector<double> &f) const
  {
    f.assign(U0.size(), 0.);
    K->vmult_add(.5, U0.data(), f.data());
    K->vmult_add(.5, U1.data(), f.data());
  }

  std::unique_ptr<SymmetricMatrix> Substructure::tangent(const std::vector<double> &, double,
                                                         bool) const
  {
    return K->clone();
  }

  std::unique_ptr<SymmetricMatrix> Substructure::mean_tangent(const std::vector<double> &U0,
                                                              const std::vector<double> &U1,
                                                              const double rate,
                                                              const bool definite) const
  {
    std::vector<double> U = U0;
    for (std::size_t i = 0; i < U.size(); ++i)
      U[i] = .5 * (U0[i] + U1[i]);
    return tangent(U, rate, definite);
  }

  void Substructure::external_force(const double t, std::vector<double> &P) const
  {
    P = constant_force;
    for (const auto &load : time_loads)
      load->add(t, P);
  }

  void Substructure::add_force(const LinearForm &form, const double magnitude)
  {
    form.add_to(magnitude, constant_force);
  }

  void Substructure::add_force(LinearForm form, std::function<double(double)> magnitude)
  {
    time_loads.push_back(std::make_unique<PointLoad>(std::move(form), std::move(magnitude)));
  }

  void Substructure::finish()
  {
    std::sort(constrained.begin(), constrained.end(),
              [](const auto &p, const auto &q) { return p.dof < q.dof; });
    for (std::size_t i = 0; i < constrained.size(); ++i)
    {
      if (i > 0 && constrained[i].dof == constrained[i - 1].dof)
        throw EntryError(
            origin(), name() + ": two supports hold the same motion of the same point; remove one");
      moving_constraints = moving_constraints || constrained[i].motion;
    }

    bool finite = true;
    for (const SymmetricMatrix *matrix : {M.get(), C.get(), K.get()})
      matrix->visit([&](unsigned int, unsigned int, double value)
                    { finite = finite && std::isfinite(value); });
    for (const double force : constant_force)
      finite = finite && std::isfinite(force);
    if (!finite)
      throw EntryError(origin(), "body '" + name() +
                                     "': its mass, damping, stiffness or load is beyond the range "
                                     "of numbers; take less extreme values");
    for (SymmetricMatrix *matrix : {M.get(), C.get(), K.get()})
      matrix->find_repetitions();
  }
} // namespace taut
