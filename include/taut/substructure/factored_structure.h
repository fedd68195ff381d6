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
  /// The local solvers of all substructures of a Structure, each for its matrix A_k: of a step, of
  /// statics, or the mass matrix.
  class FactoredStructure
  {
  public:
    /// @p solver_name as for make_local_solver().
    FactoredStructure(const Structure &structure, const std::string &solver_name);

    /**
     * Factors A_k = mass M_k + damping C_k + K_k, mass in 1/s^2, damping in 1/s. If A_k is so close
     * to singular that motions lose their sixth digit, rigid_body_modes() has these motions apart
     * from the factor. An EntryError names the body and the remedy if the body has no rigid body
     * modes, or without @p use_amplitudes. BodyNotHeld names a body that nothing holds.
     */
    void factor(double mass, double damping, bool use_amplitudes = true);

    /**
     * The rigid body modes of a body whose inertia J = mass M_k + damping C_k is lost in the
     * rounding of K_k. The factor has a spring s as stiff as the diagonal on each fixing DoF, A_f =
     * A + s. A_f^-1 takes the place of A^-1 everywhere else, with
     *
     *     A^-1 = A_f^-1 + R' E^-1 R'^T,    R' = R - A_f^-1 J R,    E = R^T J R',
     *
     * the formula of Sherman, Morrison and Woodbury with K R = 0, which has no springs. The vectors
     * are chosen so that E is diagonal. The formula is used only if E is at least half of R^T J R,
     * so that E does not cancel: the inertia is then smaller than the elastic resistance.
     */
    struct RigidBodyModes
    {
      std::vector<std::vector<double>> vectors; ///< R'
      std::vector<double> resistance;           ///< diagonal of E [N/m, N m/rad]; 0 without inertia
      std::vector<std::vector<double>> rigid;   ///< R; empty without inertia
      std::vector<unsigned int> fixing_dofs;
      /// Force on each fixing DoF that balances a load of 1 on each vector of R; one row per DoF.
      std::vector<std::vector<double>> fixing_forces;
    };

    /// The rigid body modes of each body; without vectors if A_k is factored as it is. After
    /// factor_stiffness() they are the null space of K_k.
    const std::vector<RigidBodyModes> &rigid_body_modes() const { return motions; }

    /// True if a body of some rank has rigid body modes. Called by all ranks together.
    bool has_rigid_body_modes() const;

    /**
     * The force K_k U of a body is balanced on its rigid body modes, except for rounding of |K||U|,
     * which may exceed the inertia. Subtracts this rounding from the forces on the fixing DoFs of
     * @p KU, and adds it to those of @p balance, in which K_k U is subtracted.
     */
    void remove_rounding(std::size_t k, std::vector<double> &KU,
                         std::vector<double> &balance) const;

    /**
     * Factors A_k = K_k for statics, with a spring as stiff as the diagonal on each DoF that fixes
     * the null space. The inverse is a generalised inverse of K_k, exact for forces that are
     * balanced on the null space: the springs then carry no force.
     */
    void factor_stiffness();

    const LocalSolver &operator[](std::size_t k) const { return *solvers[k]; }

    /// K_k: the stiffness of the body, or the tangent that was set last.
    const SymmetricMatrix &stiffness(std::size_t k) const
    {
      return tangents[k] ? *tangents[k] : bodies[k].stiffness();
    }

    /// Sets another K_k, for a body that is not linear. The factor of A_k is kept until the next
    /// factor().
    void set_tangent(std::size_t k, std::unique_ptr<SymmetricMatrix> tangent);

    /// Factors A_k of one body again, with the factors of the last factor().
    void factor_again(std::size_t k) { factor_body(k, use_amplitudes); }

    /// X_k = A_k^-1 X_k for all k.
    void solve(BodyVectors &X) const;

    /// Factors A_k = M_k, with DoFs without mass held at zero. BodyNotHeld names a body with a
    /// singular mass matrix.
    void factor_mass();

    /// True after factor_stiffness().
    bool is_generalised_inverse() const { return kind == Kind::stiffness; }

    /// Calls the visitor for the entries of A_k, without the springs of factor_stiffness().
    void visit(std::size_t k, const SymmetricMatrix::Visitor &visitor) const;

    /// y = A_k x, without the springs of factor_stiffness(); y is resized.
    void multiply(std::size_t k, const std::vector<double> &x, std::vector<double> &y) const;

    /**
     * A solver for A_k with more DoFs held at zero. In statics springs hold the body, as in
     * factor_stiffness(), only if a null space vector remains that moves none of these DoFs.
     */
    std::unique_ptr<LocalSolver> solver_with_held(std::size_t k,
                                                  const std::vector<unsigned int> &held) const;

    const Structure &structure() const { return bodies; }

  private:
    std::unique_ptr<LocalSolver> solver_of(const Substructure &body) const;
    void copy_summands(std::size_t k, std::vector<ScaledMatrix> &A) const;
    std::vector<ScaledMatrix> summands(std::size_t k) const;
    void factor(std::size_t k, LocalSolver &solver, const std::vector<ScaledMatrix> &summands,
                const std::vector<unsigned int> &held) const;
    double lost_digits(std::size_t k, const LocalSolver &solver,
                       const std::vector<ScaledMatrix> &summands) const;
    void check_digits(std::size_t k, double loss) const;
    void factor_body(std::size_t k, bool use_amplitudes);
    bool free_motions_apart(std::size_t k, bool use_amplitudes);
    bool set_rigid_body_modes(std::size_t k);

    const Structure &bodies;
    const std::string solver_name;
    /// The meaning of A_k.
    enum class Kind
    {
      step,
      stiffness,
      mass
    };
    Kind kind = Kind::step;
    double mass_factor = 0., damping_factor = 0.;           ///< of A_k in a step
    bool use_amplitudes = true;                             ///< of rigid body modes, in a step
    std::vector<std::unique_ptr<SymmetricMatrix>> tangents; ///< of bodies that are not linear
    std::vector<std::unique_ptr<LocalSolver>> solvers;
    std::vector<RigidBodyModes> motions;
    std::vector<std::vector<unsigned int>> constrained; ///< DoFs of each body
    std::vector<ScaledMatrix> its_summands;             ///< in factor_body()
    mutable std::vector<double> translation, image;     ///< in lost_digits()
  };
} // namespace taut

#endif
