// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_factored_structure_h
#define taut_factored_structure_h

#include <taut/substructure/local_solver.h>
#include <taut/substructure/structure.h>

#include <memory>
#include <string>
#include <vector>

namespace taut
{
  /// The local solvers of all substructures, for one matrix A_k each.
  class FactoredStructure
  {
  public:
    /// @p solver_name as for make_local_solver().
    FactoredStructure(const Structure &structure, const std::string &solver_name);

    /// A_k = mass M_k + damping C_k + K_k, mass in 1/s^2, damping in 1/s. BodyNotHeld names the
    /// body; an EntryError does if A_k is so close to singular that motions lose their sixth digit.
    void factor(double mass, double damping);

    /**
     * A_k = K_k, with a spring as stiff as the diagonal on each DoF that holds a kernel vector: its
     * inverse is a generalised inverse of K_k, exact for forces that are balanced on the kernel
     * (the springs then carry nothing).
     */
    void factor_stiffness(const std::vector<Substructure::Kernel> &kernels);

    const LocalSolver &operator[](std::size_t k) const { return *solvers[k]; }

    /// X_k = A_k^-1 X_k for all k.
    void solve(BlockVector &X) const;

    /// True after factor_stiffness().
    bool is_generalised_inverse() const { return is_static; }

    /// Calls the visitor for the entries of A_k, without the springs of factor_stiffness().
    void visit(std::size_t k, const SymmetricMatrix::Visitor &visitor) const;

    /**
     * A solver for A_k with more DoFs held at zero. In statics springs hold it, as in
     * factor_stiffness(), only if a kernel vector is left that moves none of these DoFs.
     */
    std::unique_ptr<LocalSolver> solver_with_held(std::size_t k,
                                                  const std::vector<unsigned int> &held) const;

    const Structure &structure() const { return bodies; }

  private:
    std::vector<ScaledMatrix> summands(std::size_t k) const;
    void factor(std::size_t k, LocalSolver &solver, const std::vector<ScaledMatrix> &summands,
                const std::vector<unsigned int> &held) const;
    void check_digits(std::size_t k, const std::vector<ScaledMatrix> &summands) const;

    const Structure &bodies;
    const std::string solver_name;
    double mass_factor = 0., damping_factor = 0.; ///< of A_k; both 0 in statics
    bool is_static = false;
    std::vector<std::unique_ptr<LocalSolver>> solvers;
  };
} // namespace taut

#endif
